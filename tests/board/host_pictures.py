"""What this PC draws of the same person at the same level of detail."""

import glob
import os
import shutil
import subprocess

import pictures

WIDTH, HEIGHT = 320, 240
VIEW = ["--view", "head", "--lod", "2500"]
CONFIG = os.path.join(os.path.dirname(__file__), "programme/kiosk.toml")
# Where her mouth is, as shares of the picture: there a feeling shows most.
MOUTH = {"box": (0.39, 0.47, 0.63, 0.64), "size": 4}


class HostPictures:
    """Sets of pictures by what they show: calm, a feeling, rotated."""

    def __init__(self, program, pack, folder):
        self.program, self.pack, self.folder = program, pack, folder
        self.known = {}

    def pictures(self, what):
        if what not in self.known:
            self.known[what] = self._draw(what)
        return self.known[what]

    def run(self, what, seconds, options):
        """The same programme on this PC by a virtual clock; `what` names its folder."""
        out = os.path.join(self.folder, "host", what)
        shutil.rmtree(out, ignore_errors=True)
        os.makedirs(out)
        script = os.path.join(out, "script")
        with open(script, "w", encoding="utf-8") as file:
            if what not in ("calm", "rotated"):
                file.write(f"0 {what} down\n0.2 {what} up\n")
        subprocess.run([self.program, "--config", CONFIG, *VIEW, "--virtual-clock",
                        "--target-fps", "10", "--duration", str(seconds), "--script", script,
                        *[o.replace("OUT", out) for o in options]],
                       check=True, stdout=subprocess.DEVNULL)
        return out

    def _draw(self, what):
        options = ["--display", "surfaceless", "--size", f"{WIDTH}x{HEIGHT}",
                   "--frames-every", "4", "--frames-out", "OUT",
                   "--pack", self.pack]
        options += ["--rotate", "90"] if what == "rotated" else []
        out = self.run(what, 4, options)
        frames = sorted(glob.glob(os.path.join(out, "frame_*.png")))
        # A feeling takes a second to come.
        frames = frames if what in ("calm", "rotated") else frames[3:]
        return [pictures.read_png(f) for f in frames]

    def sound(self, button):
        """The WAV of what is said when `button` is pressed."""
        return os.path.join(
            self.run(button, 8, ["--display", "none", "--audio", "file:OUT/said.wav"]), "said.wav")

    def distance(self, picture, what, **part):
        """From a picture of the board to the most similar moment here, 0..255."""
        wanted = [p.blocks(**part) for p in self.pictures(what)]
        return min(pictures.distance(view, blocks) for view in picture.views(**part)
                   for blocks in wanted)
