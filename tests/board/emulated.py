#!/usr/bin/env python3
"""The kiosk on an emulated board, from power-on: what a visitor, a cleaner and the mains do to it.

emulated.py --tree DIR --payload DIR --pack FILE --host CARYATID --out DIR [--steps LIST]

Steps, of which all are run unless --steps names some (comma separated):
  picture    the first picture on the screen shows the person as this PC draws her
  gpio       the board's power key, a GPIO line, changes her expression
  keyboard   a USB keyboard does too, and again after it was unplugged
  restart    killed, stopped, without page flips, after a GPU reset: she comes back
  watchdog   PID 1 stops: the hardware watchdog resets the board
  soak       minutes of life: memory, late frames, allocations, reaction times
  power      the power is cut ten times while the kiosk writes its state
"""

import argparse
import glob
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../cross/board"))
sys.path.insert(0, os.path.dirname(__file__))

import image  # noqa: E402
import pictures  # noqa: E402
from machine import Machine, Timeout, wait_for  # noqa: E402

WIDTH, HEIGHT = 320, 240
VIEW = ["--view", "head", "--lod", "2500"]
# Emulated, llvmpipe draws a few frames a second; what is compared is not how fast but what.
TARGET_FPS = 5
METRICS = "/run/caryatid/metrics.jsonl"
CONFIG = os.path.join(os.path.dirname(__file__), "kiosk.toml")
# Where her mouth is, as shares of the picture: there a feeling shows most.
MOUTH = {"box": (0.39, 0.47, 0.63, 0.64), "size": 4}
STEPS = ["picture", "gpio", "keyboard", "restart", "watchdog", "soak", "power"]
# A machine that is shared stretches every wait by this.
PATIENCE = float(os.environ.get("CARYATID_BOARD_PATIENCE", "1"))

DROP_IN = f"""[Service]
ExecStart=
ExecStart=/usr/bin/caryatid --config /etc/caryatid/kiosk.toml \
--pack /usr/share/caryatid/woman.pack --display drm {" ".join(VIEW)} \
--target-fps {TARGET_FPS} --metrics {METRICS} --test-faults
# Compiling shaders for llvmpipe by emulation takes minutes where nothing is cached, with the first
# picture and again when her finest textures have come.
TimeoutStartSec=1800
WatchdogSec=900
"""


class Failure(Exception):
    """The board did not do what it must."""


def check(holds, what):
    print(f"    {'ok  ' if holds else 'FAIL'} {what}", flush=True)
    if not holds:
        raise Failure(what)


def say(text):
    print(f"    {text}", flush=True)


class HostPictures:
    """What this PC draws of the same person at the same level of detail, by mood."""

    def __init__(self, program, pack, folder):
        self.program, self.pack, self.folder = program, pack, folder
        self.known = {}

    def pictures(self, mood):
        if mood not in self.known:
            self.known[mood] = self._draw(mood)
        return self.known[mood]

    def _draw(self, mood):
        out = os.path.join(self.folder, "host", mood)
        shutil.rmtree(out, ignore_errors=True)
        os.makedirs(out)
        pack, script = ["--pack", self.pack], os.path.join(out, "script")
        with open(script, "w", encoding="utf-8") as file:
            if mood not in ("calm", "builtin"):
                file.write(f"0 {mood} down\n0.2 {mood} up\n")
        if mood == "builtin":
            pack = []
        subprocess.run([self.program, *pack, "--config", CONFIG,
                        "--display", "surfaceless", "--size",
                        f"{WIDTH}x{HEIGHT}", *VIEW, "--virtual-clock", "--target-fps", "10",
                        "--duration", "4", "--frames-every", "4", "--frames-out", out, "--script",
                        script], check=True, stdout=subprocess.DEVNULL)
        frames = sorted(glob.glob(os.path.join(out, "frame_*.png")))
        # A feeling takes a second to come.
        frames = frames if mood in ("calm", "builtin") else frames[3:]
        return [pictures.read_png(f) for f in frames]

    def distance(self, picture, mood, **part):
        """From a picture of the board to the most similar moment of that mood."""
        views = picture.views(**part)
        return min(pictures.distance(v, p.blocks(**part)) for p in self.pictures(mood)
                   for v in views)


class Test:
    """The steps, on one running board."""

    def __init__(self, options):
        self.options = options
        self.out = options.out
        self.host = HostPictures(options.host, options.pack, self.out)
        self.board = None

    def boot(self, disk):
        boot = os.path.join(self.options.tree, "boot")
        return Machine(self.out, os.path.join(boot, "vmlinuz"), os.path.join(boot, "initramfs"),
                       disk, (WIDTH, HEIGHT))

    # Looking inside.

    def unit(self, what):
        return self.board.run(f"systemctl show -p {what} --value caryatid")

    def wait_running(self, seconds):
        wait_for("the service", seconds * PATIENCE,
                 lambda: self.board.run("systemctl is-active caryatid") == "active", 3)

    def metrics(self, lines=1):
        text = self.board.run(f"tail -n {lines + 1} {METRICS} 2>/dev/null")
        found = []
        for line in text.splitlines():
            try:
                found.append(json.loads(line))
            except ValueError:
                pass  # Cut by the flush, or the shell's.
        return found[-lines:]

    def wait_feeling(self, mood, seconds=60):
        def felt():
            return [m for m in self.metrics(20) if m["emotion"] == mood]
        wait_for(f"{mood} in the metrics", seconds * PATIENCE, felt, 1)

    def wait_calm(self):
        self.wait_feeling("calm", 120)

    def journal(self, text, since=0.0):
        """Board's times of the service's messages that hold `text`, after `since`."""
        lines = self.board.run("journalctl -q -o short-monotonic -u caryatid --no-pager | "
                               f"grep -F '{text}'")
        times = [float(t) for t in re.findall(r"^\[ *([0-9.]+)\]", lines, re.M)]
        return [t for t in times if t > since]

    def now_s(self):
        return float(self.board.run("cut -d' ' -f1 /proc/uptime"))

    def dump(self, name):
        ppm = self.board.picture(name)
        picture = pictures.read_ppm(ppm)
        os.remove(ppm)
        picture.write_png(os.path.join(self.out, name + ".png"))
        return picture

    def reactions(self):
        text = self.board.run(f"grep reaction_ms {METRICS}")
        return [json.loads(line) for line in text.splitlines() if line.endswith("}")]

    # The steps.

    def picture(self):
        built_in = self.journal("built-in face on the screen")
        check(built_in, "the built-in face came first, %.1f s after power-on by the board's clock"
              % (built_in or [0])[0])
        person = wait_for("the person", 60 * PATIENCE,
                          lambda: self.journal("person on the screen"), 2)
        say("the person stood %.1f s after power-on" % person[0])
        # Her finest textures come while she is already there.
        wait_for("twelve frames", 300 * PATIENCE, lambda: self.frame_count() > 12, 3)
        shown = [self.dump(f"first_{n}") for n in range(3)]
        near = min(self.host.distance(p, "calm") for p in shown)
        face = min(self.host.distance(p, "builtin") for p in shown)
        check(near < 3.0 and near < 0.6 * face,
              f"the screen shows her as this PC draws her: {near:.2f} of 255 apart, the built-in "
              f"face {face:.2f}")

    def frame_count(self):
        return int(self.board.run(f"wc -l < {METRICS} || echo 0").split()[-1])

    def gpio(self):
        self.wait_calm()
        before = self.dump("before_press")
        self.board.press_button()
        self.wait_feeling("joy")
        time.sleep(2)
        after = self.dump("after_press")
        self.expect_mood(before, "calm", "joy")
        self.expect_mood(after, "joy", "calm")
        self.expect_reaction()

    def expect_mood(self, picture, mood, other):
        apart = {name: round(self.host.distance(picture, name, **MOUTH), 2)
                 for name in (mood, other)}
        check(apart[mood] < apart[other], f"the picture shows {mood}: {apart}")

    def expect_reaction(self):
        last = wait_for("a reaction time", 20 * PATIENCE, self.reactions, 1)[-1]
        frame_ms = max(m["frame_ms"] for m in self.metrics(20))
        check(last["reaction_ms"] <= 2 * frame_ms,
              f"reaction: {last['reaction_ms']:.0f} ms, frames of up to {frame_ms:.0f} ms")

    def keyboard(self):
        self.wait_calm()
        self.board.type_key("s")
        self.wait_feeling("sadness")
        time.sleep(2)
        self.expect_mood(self.dump("key_sadness"), "sadness", "calm")
        since = self.now_s()
        self.board.unplug_keyboard()
        gone = wait_for("word of the lost keyboard", 30 * PATIENCE,
                        lambda: self.journal("USB button device is not there", since), 1)
        say(f"unplugged: noticed after {gone[0] - since:.1f} s")
        self.wait_calm()
        since = self.now_s()
        self.board.plug_keyboard()
        back = wait_for("word of the keyboard", 60 * PATIENCE,
                        lambda: self.journal("USB button device is there", since), 1)
        say(f"plugged in: in use after {back[0] - since:.1f} s")
        self.board.type_key("p")
        self.wait_feeling("surprise")
        check(True, "a key works again after the keyboard was unplugged and plugged in")

    def shorten_watchdog(self):
        """All that is drawn has been compiled by now."""
        self.board.run("mkdir -p /run/systemd/system/caryatid.service.d; "
                       "printf '[Service]\\nWatchdogSec=40\\n' "
                       "> /run/systemd/system/caryatid.service.d/zz-watchdog.conf; "
                       "systemctl daemon-reload")

    def restart(self):
        self.shorten_watchdog()
        self.hard_kill()
        self.expect_watchdog("SIGSTOP: the service's watchdog restarts it", "STOP")
        self.expect_watchdog("page flips stop: the service's watchdog restarts it", "USR1")
        process, since = self.unit("MainPID"), self.now_s()
        self.board.run(f"kill -USR2 {process}")
        wait_for("the screen opened again", 120 * PATIENCE,
                 lambda: self.journal("opening it again", since), 2)
        at = self.metrics()[0]["time_s"]
        wait_for("frames after the GPU reset", 120 * PATIENCE,
                 lambda: self.metrics()[0]["time_s"] > at + 3.0, 2)
        check(self.unit("MainPID") == process, "a GPU reset: the same process draws on")
        near = self.host.distance(self.dump("after_gpu_reset"), "calm")
        check(near < 4.0, f"and she looks as before, {near:.2f} apart")

    def hard_kill(self):
        since = self.now_s()
        self.board.run("kill -9 " + self.unit("MainPID"))
        back = wait_for("the built-in face", 120 * PATIENCE,
                        lambda: self.journal("built-in face on the screen", since), 1)[0]
        check(back - since < 5.0,  # What is promised, on a busy machine too.
              f"killed: the built-in face is back {back - since:.1f} s later")
        self.wait_running(300)

    def expect_watchdog(self, what, signal_name):
        restarts, since = int(self.unit("NRestarts")), self.now_s()
        self.board.run(f"kill -{signal_name} " + self.unit("MainPID"))
        wait_for("the service's watchdog", 90 * PATIENCE,
                 lambda: self.journal("Watchdog timeout", since), 2)
        self.wait_running(300)
        check(int(self.unit("NRestarts")) == restarts + 1, what)

    def watchdog(self):
        self.board.run("sync")
        before = self.board.events_of("RESET")
        # A signal does not stop PID 1, its freezer does.
        self.board.run("echo 1 > /sys/fs/cgroup/init.scope/cgroup.freeze")
        froze = time.monotonic()
        wait_for("the hardware watchdog", 120 * PATIENCE,
                 lambda: self.board.happened("WATCHDOG"))
        wait_for("the reset", 10, lambda: self.board.events_of("RESET") > before)
        check(True, f"PID 1 stopped: reset by the hardware {time.monotonic() - froze:.0f} s later")
        self.board.shell_ready(300 * PATIENCE)
        self.wait_running(600)
        check(True, "and the kiosk is up again by itself")

    def soak(self):
        seconds = self.options.soak_s
        memory, end = [], time.monotonic() + seconds
        start = len(self.reactions())
        while time.monotonic() < end:
            self.board.press_button()
            time.sleep(min(20, seconds / 3))
            process = self.unit("MainPID")
            memory.append(int(self.board.run(f"awk '/VmRSS/{{print $2}}' /proc/{process}/status")))
        text = self.board.run(f"cat {METRICS}", 120)
        frames = [json.loads(line) for line in text.splitlines() if line.endswith("}")]
        half = len(frames) // 2
        late = [sum(f["late"] for f in part) / len(part)
                for part in (frames[:half], frames[half:])]
        presses = [f["reaction_ms"] for f in frames if "reaction_ms" in f][start:]
        say(f"{len(frames)} frames, {1000 / (sum(f['frame_ms'] for f in frames) / len(frames)):.1f}"
            f" a second; RSS {memory} KiB")
        say(f"reaction times {[round(p) for p in presses]} ms")
        check(frames[-1]["allocations_since_seal"] == 0, "no allocation after the seal")
        check(max(memory[1:]) - min(memory[1:]) <= 1024, "memory stays within 1 MiB")
        check(late[1] <= late[0] + 0.1,
              f"late frames don't grow: {late[0]:.0%} of the first half, then {late[1]:.0%}")
        check(len(presses) >= 2, f"{len(presses)} presses were answered")


class PowerCuts:
    """A board of its own, with a small init that lets the kiosk write its state all the time."""

    CUTS = 10

    def __init__(self, options, disk):
        self.options, self.disk = options, disk
        self.random = random.Random(1)

    def run(self):
        boot, known = os.path.join(self.options.tree, "boot"), 0
        for cut in range(self.CUTS + 1):
            out = os.path.join(self.options.out, "power")
            os.makedirs(out, exist_ok=True)
            with Machine(out, os.path.join(boot, "vmlinuz"), os.path.join(boot, "initramfs-small"),
                         self.disk, (WIDTH, HEIGHT)) as board:
                found = self.starts(board, "found", 1)[0]
                check(found >= known, f"power-on {cut + 1}: the state knows of {found} starts; "
                                      f"{known} were safe before the cut")
                known = self.starts(board, "wrote", 2)[-1]
                # Somewhere in the next start, its writing, or its end.
                time.sleep(self.random.uniform(0.0, 2.0))
                known = max(known, *self.told(board, "wrote"))
        check(True, f"{self.CUTS} cuts of power, and the state was whole each time")

    @staticmethod
    def told(board, word):
        """Counts of starts on lines that begin with `word`; -1 for a state that is not whole."""
        lines = re.findall(rf"^{word} (.*?)\r?$", board.console(), re.M)
        counts = []
        for line in lines:
            match = re.search(r"caryatid-state 1 starts (\d+) .*crc [0-9a-f]{8}", line)
            # Nothing at all: the first power-on of a new board.
            counts.append(int(match.group(1)) if match else 0 if not line.strip() else -1)
        return counts

    def starts(self, board, word, least):
        def enough():
            counts = self.told(board, word)
            return counts if len(counts) >= least else None
        counts = wait_for(f"'{word}' on the console", 300 * PATIENCE, enough, 0.2)
        if -1 in counts:
            check(False, f"every state told as {word!r} is whole")
        return counts


def make_payload(options):
    """What the package holds, and the little that makes this board a test's."""
    payload = options.payload
    for path in ("usr/bin/caryatid", "usr/share/caryatid/woman.pack"):
        if not os.path.exists(os.path.join(payload, path)):
            raise Failure(f"{payload}/{path} is missing")
    units = os.path.join(payload, "etc/systemd/system")
    image.write(payload, "etc/systemd/system/caryatid.service.d/emulated.conf", DROP_IN)
    wants = os.path.join(units, "multi-user.target.wants")
    os.makedirs(wants, exist_ok=True)
    link = os.path.join(wants, "caryatid.service")
    if not os.path.lexists(link):
        os.symlink("/lib/systemd/system/caryatid.service", link)
    shutil.copy(os.path.join(os.path.dirname(__file__), "small_init.sh"),
                os.path.join(payload, "etc/small-init"))
    config = os.path.join(payload, "etc/caryatid")
    os.makedirs(config, exist_ok=True)
    shutil.copy(CONFIG, config)


def keep_shaders(disk, shaders):
    """Takes what llvmpipe compiled from the disk, so that the next test's board starts warm."""
    shutil.rmtree(shaders, ignore_errors=True)
    os.makedirs(shaders)
    subprocess.run(["debugfs", "-R", f"rdump /var/cache/caryatid {shaders}", disk],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, what in (("tree", "the board's prepared tree"),
                       ("payload", "files of the package, as on the board"),
                       ("pack", "the character's pack"), ("host", "this PC's caryatid"),
                       ("out", "folder for pictures and logs"),
                       ("shaders", "folder that keeps compiled shaders between runs")):
        parser.add_argument("--" + name, required=True, help=what)
    parser.add_argument("--steps", default=",".join(STEPS))
    parser.add_argument("--soak-s", type=float, default=300)
    return parser.parse_args()


def main():
    options = parse()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    os.makedirs(options.out, exist_ok=True)
    make_payload(options)
    disk = os.path.join(options.out, "disk.ext4")
    image.disk(options.tree, options.payload, disk, options.shaders)
    test = Test(options)
    began = time.monotonic()
    warm = os.path.isdir(os.path.join(options.shaders, "caryatid"))
    print(f"power on; compiled shaders: {'kept from another run' if warm else 'none'}", flush=True)
    steps = options.steps.split(",")
    try:
        if set(steps) != {"power"}:
            with test.boot(disk) as board:
                test.board = board
                board.shell_ready(300 * PATIENCE)
                test.wait_running(1200)
                for step in steps:
                    if step != "power":
                        print(f"{step}  ({time.monotonic() - began:.0f} s)", flush=True)
                        getattr(test, step)()
                board.run("sync")
        if "power" in steps:
            print(f"power  ({time.monotonic() - began:.0f} s)", flush=True)
            PowerCuts(options, disk).run()
    except (Failure, Timeout) as error:
        print(f"emulated board: {error}; see {options.out}", flush=True)
        return 1
    finally:
        keep_shaders(disk, options.shaders)
    print(f"emulated board: all well after {time.monotonic() - began:.0f} s; pictures in "
          f"{options.out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
