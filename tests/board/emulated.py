#!/usr/bin/env python3
"""The kiosk on an emulated board, from power-on: what a visitor, a cleaner and the mains do to it.

emulated.py --tree DIR --payload DIR --pack FILE --host CARYATID --out DIR [--steps LIST]

Steps, of which all are run unless --steps names some (comma separated):
  picture    the first picture on the screen shows the person as this PC draws her
  gpio       the board's power key, a GPIO line, changes her expression
  keyboard   a USB keyboard does too, and again after it was unplugged
  sound      a key lets her speak; what the board's sound device played is what this PC makes of it
  screen     unplugged and plugged in, absent at the start, dark when nobody is there, turned,
             without atomic mode setting; the text console is there again when the kiosk ends
  restart    killed, stopped, without page flips, after a GPU reset: she comes back
  watchdog   PID 1 stops: the hardware watchdog resets the board
  soak       minutes of life: memory, late frames, allocations, reaction times
  power      the power is cut ten times while the kiosk writes its state
Seconds are the board's own (cross/board/machine.py) but where the text says otherwise.
"""

import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../cross/board"))
sys.path.insert(0, os.path.dirname(__file__))

import sound  # noqa: E402
import tree  # noqa: E402
from host_pictures import CONFIG, HEIGHT, MOUTH, VIEW, WIDTH, HostPictures  # noqa: E402
from machine import ANSWER_S, Machine, Timeout, wait_for  # noqa: E402
from power_cuts import PowerCuts  # noqa: E402
from session import METRICS, Failure, Session, check, say  # noqa: E402

STEPS = ["picture", "gpio", "keyboard", "sound", "screen", "restart", "watchdog", "soak", "power"]
TARGET_FPS = 5  # What llvmpipe on the emulated board keeps up with.
SCREEN = "/sys/class/drm/card0-Virtual-1"

UNIT = f"""[Service]
ExecStart=
ExecStart=/usr/bin/caryatid --config /etc/caryatid/kiosk.toml \
--pack /usr/share/caryatid/woman.pack --display drm {" ".join(VIEW)} \
--target-fps {TARGET_FPS} --metrics {METRICS} --test-faults $STEP_OPTIONS
# The very first start compiles all shaders for a GPU that is emulated too.
TimeoutStartSec=120
"""


class Steps(Session):
    """The steps, on one running board."""

    def __init__(self, board, options):
        super().__init__(board, options.out)
        self.options = options
        self.host = HostPictures(options.host, options.pack, self.out)

    def expect_person(self, name, what="calm", most=3.0):
        """The best of a few dumps: her face never rests."""
        best = 255.0
        for n in range(4):
            best = min(best, self.host.distance(self.dump(f"{name}_{n}"), what))
            if best < most:
                break
            self.pass_time(0.5)
        check(best < most, f"{name}: as this PC draws her, {best:.2f} of 255 apart")

    def picture(self):
        built_in_s = self.wait_told("built-in face on the screen", 60, 0.0)
        self.expect_person("built_in", most=4.0)
        early = not self.journal("person on the screen")
        person_s = self.wait_told("person on the screen", 150, 0.0)
        check(built_in_s < person_s,
              f"the built-in face stood {built_in_s:.1f} s after power-on, the person "
              f"{person_s:.1f} s{'; seen before she came' if early else ''}")
        self.wait_running()
        self.wait_frames(20)  # Her finest textures come while she is already there.
        shown = [self.dump(f"first_{n}") for n in range(3)]
        near = min(self.host.distance(p, "calm") for p in shown)
        others = {"upside down": self.host.distance(shown[0].upside_down(), "calm"),
                  "red and blue changed": self.host.distance(shown[0].blue_for_red(), "calm")}
        check(near < 3.0 and all(near < 0.6 * far for far in others.values()),
              f"the screen shows her as this PC draws her: {near:.2f} of 255 apart; " +
              ", ".join(f"{name} {far:.2f}" for name, far in others.items()))

    def gpio(self):
        self.wait_calm()
        before = self.dump("before_press")
        self.board.press_button()
        self.wait_feeling("joy")
        self.pass_time(1.5)
        after = self.dump("after_press")
        self.expect_mood(before, "calm", "joy")
        self.expect_mood(after, "joy", "calm")
        self.expect_reaction()

    def expect_mood(self, picture, mood, other):
        apart = {name: round(self.host.distance(picture, name, **MOUTH), 2)
                 for name in (mood, other)}
        check(apart[mood] < apart[other], f"the picture shows {mood}: {apart}")

    def expect_reaction(self):
        last = self.wait("a reaction time", 20, self.reactions)[-1]
        frame_ms = 1000.0 / TARGET_FPS
        check(last["reaction_ms"] <= 2 * frame_ms,
              f"reaction: {last['reaction_ms']:.0f} ms from the edge's stamp in the kernel to the "
              f"page flip, frames of {frame_ms:.0f} ms")

    def keyboard(self):
        self.wait_calm()
        self.board.type_key("s")
        self.wait_feeling("sadness")
        self.pass_time(1.5)
        self.expect_mood(self.dump("key_sadness"), "sadness", "calm")
        since_s = self.now_s()
        self.board.unplug_keyboard()
        gone_s = self.wait_told("USB button device is not there", 20, since_s)
        say(f"unplugged: noticed after {gone_s - since_s:.1f} s")
        self.wait_calm()
        since_s = self.now_s()
        self.board.plug_keyboard()
        back_s = self.wait_told("USB button device is there", 30, since_s)
        say(f"plugged in: in use after {back_s - since_s:.1f} s")
        self.pass_time(0.5)  # What a keyboard says at once is its state, not a press.
        self.board.type_key("p")
        self.wait_feeling("surprise")
        check(True, "a key works again after the keyboard was unplugged and plugged in")

    def sound(self):
        self.wait_calm()  # A feeling would be heard.
        self.board.type_key("t")
        self.wait("speech in the metrics", 20, lambda: "speech" in self.metrics()[0])
        self.dump("speaking")
        self.wait("the end of her speech", 30, lambda: "speech" not in self.metrics()[0])
        self.pass_time(1.0)
        wanted, played = sound.read(self.host.sound("greeting")), sound.read(self.board.sound)
        like, unlike = sound.likeness(played, wanted), sound.likeness(played, wanted[::-1])
        check(like > 0.9 and unlike < 0.5,
              f"played {len(played) / sound.RATE_HZ:.1f} s, this PC's file "
              f"{len(wanted) / sound.RATE_HZ:.1f} s: correlation {like:.3f}, with the file "
              f"backwards {unlike:.3f}")

    # The screen.

    def screen(self):
        self.replug()
        self.absent_at_start()
        self.console()
        self.dark()
        self.restart_with("--rotate 90")
        self.wait_running()
        self.wait_frames(20)
        self.expect_person("rotated", "rotated")
        since_s = self.now_s()
        self.restart_with("--display drm-legacy")
        self.wait_told("in use (legacy calls)", 30, since_s)
        self.wait_running()
        self.wait_frames(20)
        self.expect_person("legacy")
        self.restart_with("")
        self.wait_running()

    def replug(self):
        process, since_s = self.unit("MainPID"), self.now_s()
        self.board.plug_screen(False)
        gone_s = self.wait_told("not connected", 10, since_s)
        self.pass_time(12)  # Longer than the service's watchdog waits.
        since_back_s = self.now_s()
        self.board.plug_screen(True)
        back_s = self.wait_told("in use (atomic)", 10, since_back_s)
        check(self.unit("MainPID") == process,
              f"screen unplugged: noticed after {gone_s - since_s:.1f} s; plugged in: in use after "
              f"{back_s - since_back_s:.1f} s, by the same process")
        self.wait_frames(5)
        self.expect_person("replugged")

    def absent_at_start(self):
        self.board.plug_screen(False)
        since_s = self.now_s()
        self.restart_with("")
        self.wait_told("not connected", 30, since_s)
        self.wait_running()
        self.pass_time(12)
        process = self.unit("MainPID")
        self.board.plug_screen(True)
        self.wait_told("in use (atomic)", 10, since_s)
        self.wait_frames(20)
        check(self.unit("MainPID") == process, "started without a screen: the kiosk waited for it")
        self.expect_person("screen_came")

    def console(self):
        """The text console stands behind the picture, and in its place when the kiosk ends."""
        self.board.run("for n in 1 2 3 4 5 6; do echo The text console, line $n. >/dev/tty1; done")
        self.expect_person("before_stop")
        since_s = self.now_s()
        self.board.run("systemctl stop caryatid")
        begun = self.journal("Stopping caryatid", since_s)[0]
        ended_s = self.wait_told("Deactivated successfully", 10, since_s) - begun
        check(ended_s < 1.0, f"SIGTERM: ended {ended_s:.2f} s later")
        self.board.run("echo And after it. >/dev/tty1")
        text = self.dump("console")
        share = sum(b > 100 for b in text.rgb) / len(text.rgb)
        check(0.005 < share < 0.2, f"the text console is back: {share:.1%} of it is lit")

    def dark(self):
        self.board.run("sed 's/off_after_s = 0/off_after_s = 4/' /etc/caryatid/kiosk.toml "
                       ">/etc/caryatid/dark.toml")
        self.restart_with("--config /etc/caryatid/dark.toml")
        self.wait("a dark screen", 30, lambda: self.board.run(f"cat {SCREEN}/dpms") == "Off")
        self.pass_time(12)
        self.wait_running(1)
        self.board.press_button()
        self.wait("a lit screen", 10, lambda: self.board.run(f"cat {SCREEN}/dpms") == "On")
        self.wait_feeling("joy")
        self.pass_time(1.5)
        self.expect_mood(self.dump("woken"), "joy", "calm")
        check(True, "dark when nobody is there, woken by the button, no restart by the watchdog")

    # What ends her, and what brings her back.

    def restart(self):
        self.hard_kill()
        self.expect_watchdog("SIGSTOP: the service's watchdog restarts it", "STOP")
        self.expect_watchdog("page flips stop: the service's watchdog restarts it", "USR1")
        process, since_s = self.unit("MainPID"), self.now_s()
        self.board.run(f"kill -USR2 {process}")
        self.wait_told("opening it again", 30, since_s)
        self.wait_frames(20)
        check(self.unit("MainPID") == process, "a GPU reset: the same process draws on")
        self.expect_person("after_gpu_reset")

    def hard_kill(self):
        self.wait_frames(20)
        since_s = self.now_s()
        self.board.run("kill -9 " + self.unit("MainPID"))
        shown = []
        while not self.journal("person on the screen", since_s):
            shown.append(self.dump(f"killed_{len(shown)}"))
            if self.now_s() > since_s + 60:
                raise Timeout("no person within 60 s of a hard kill")
        shown.append(self.dump(f"killed_{len(shown)}"))
        back_s = self.journal("built-in face on the screen", since_s)[0] - since_s
        person_s = self.journal("person on the screen", since_s)[0] - since_s
        check(back_s < 5.0, f"killed: the built-in face is back {back_s:.1f} s later, the person "
                            f"{person_s:.1f} s")
        # The kernel shows the text console when a program dies; after that she stays.
        hers = [p.brightness() > 40.0 for p in shown]
        first = hers.index(True, hers.index(False)) if False in hers else 0
        near = self.host.distance(shown[first], "calm")
        check(near < 4.0 and all(hers[first:]),
              f"the first picture then is hers, {near:.2f} of 255 apart; none after it is black")
        self.wait_running()

    def expect_watchdog(self, what, signal_name):
        self.forgive()
        restarts, since_s = int(self.unit("NRestarts")), self.now_s()
        self.board.run(f"kill -{signal_name} " + self.unit("MainPID"))
        bitten_s = self.wait_told("Watchdog timeout", 60, since_s) - since_s
        self.wait_told("person on the screen", 60, since_s)
        self.wait_running()
        check(int(self.unit("NRestarts")) == restarts + 1, f"{what} after {bitten_s:.0f} s")

    def watchdog(self):
        self.board.run("sync")
        before = self.board.events_of("RESET")
        since_s = self.now_s()
        # A signal does not stop PID 1, its freezer does. The console tells how long the rest lives.
        self.board.run("(while cut -d' ' -f1 /proc/uptime | sed 's/^/alive /'; do sleep 0.5; done "
                       ">/dev/ttyAMA0) & echo 1 >/sys/fs/cgroup/init.scope/cgroup.freeze")
        wait_for("the hardware watchdog", ANSWER_S, lambda: self.board.happened("WATCHDOG"))
        wait_for("the reset", ANSWER_S, lambda: self.board.events_of("RESET") > before)
        alive_s = float(re.findall(r"alive ([0-9.]+)", self.board.console())[-1])
        check(True, f"PID 1 stopped: reset by the hardware {alive_s - since_s:.0f} s later")
        self.board.shell_ready(ANSWER_S)
        self.wait_running(150)
        self.wait_frames(20)
        self.expect_person("after_reset")

    # Life.

    def soak(self):
        self.restart_with("")  # Its metrics begin anew.
        self.wait_running()
        self.wait_frames(20)
        memory, process, end_s = [], self.unit("MainPID"), self.now_s() + self.options.soak_s
        while self.now_s() < end_s:
            self.board.press_button()
            self.pass_time(min(20, self.options.soak_s / 4))
            memory.append(int(self.board.run(f"awk '/VmRSS/{{print $2}}' /proc/{process}/status")))
        frames = self.all_metrics()
        frames = [f for f in frames if f["time_s"] > 5.0]  # Without the end of her loading.
        half = len(frames) // 2
        late = [sum(f["late"] for f in part) / len(part)
                for part in (frames[:half], frames[half:])]
        presses = [f["reaction_ms"] for f in frames if "reaction_ms" in f]
        span_s = frames[-1]["time_s"] - frames[0]["time_s"]
        say(f"{len(frames)} frames in {span_s:.0f} s, {len(frames) / span_s:.2f} a second, "
            f"{sum(f['cpu_ms'] for f in frames) / len(frames):.0f} ms of work each")
        say(f"RSS {memory} KiB")
        say(f"reaction times {[round(p) for p in presses]} ms")
        check(self.unit("MainPID") == process, "one process all the time")
        check(frames[-1]["allocations_since_seal"] == 0, "no allocation after the seal")
        check(late[1] <= late[0] + 0.02,
              f"late frames don't grow: {late[0]:.1%} of the first half, then {late[1]:.1%}")
        check(len(presses) >= len(memory) - 1, f"{len(presses)} of {len(memory)} presses answered")
        check(max(presses) <= 2000.0 / TARGET_FPS, "each within two frames")
        # In its first minute the driver still compiles what it meets for the first time.
        settled = memory[len(memory) // 5:]
        check(max(settled) - min(settled) <= 1024 and settled[-1] - memory[0] <= 16384,
              f"memory is constant: within {max(settled) - min(settled)} KiB after a fifth of it, "
              f"{settled[-1] - memory[0]} KiB more than at its start")


def make_payload(options):
    """What the package holds, and the little that makes this board a test's."""
    payload = options.payload
    for path in ("usr/bin/caryatid", "usr/bin/caryatid-voice", "usr/share/caryatid/woman.pack"):
        if not os.path.exists(os.path.join(payload, path)):
            raise Failure(f"{payload}/{path} is missing")
    tree.write(payload, "etc/systemd/system/caryatid.service.d/emulated.conf", UNIT)
    wants = os.path.join(payload, "etc/systemd/system/multi-user.target.wants")
    os.makedirs(wants, exist_ok=True)
    link = os.path.join(wants, "caryatid.service")
    if not os.path.lexists(link):
        os.symlink("/lib/systemd/system/caryatid.service", link)
    shutil.copy(os.path.join(os.path.dirname(__file__), "small_init.sh"),
                os.path.join(payload, "etc/small-init"))
    shutil.rmtree(os.path.join(payload, "etc/caryatid"), ignore_errors=True)
    shutil.copytree(os.path.dirname(CONFIG), os.path.join(payload, "etc/caryatid"))


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, what in (("tree", "the board's prepared tree"),
                       ("payload", "files of the package, as on the board"),
                       ("pack", "the character's pack"), ("host", "this PC's caryatid"),
                       ("out", "folder for pictures and logs")):
        parser.add_argument("--" + name, required=True, help=what)
    parser.add_argument("--steps", default=",".join(STEPS))
    parser.add_argument("--soak-s", type=float, default=300)
    options = parser.parse_args()
    options.steps = options.steps.split(",")
    unknown = set(options.steps) - set(STEPS)
    if unknown:
        parser.error(f"no such step: {', '.join(unknown)}")
    return options


def run(options, disk):
    """The names of the steps that failed; one does not keep the others from being tried."""
    began, failed = time.monotonic(), []

    def attempt(name, step):
        print(f"{name}  ({time.monotonic() - began:.0f} s of this PC's time)", flush=True)
        try:
            step()
        except (Failure, Timeout) as error:
            say(f"failed: {error}")
            failed.append(name)

    boot = os.path.join(options.tree, "boot")
    live = [step for step in options.steps if step != "power"]
    if live:
        with Machine(options.out, os.path.join(boot, "vmlinuz"), os.path.join(boot, "initramfs"),
                     disk, (WIDTH, HEIGHT)) as board:
            board.shell_ready(ANSWER_S)
            steps = Steps(board, options)
            if live[0] != "picture":
                steps.wait_running(200)
            for step in live:
                attempt(step, getattr(steps, step))
                if step in failed:
                    steps.restart_with("")  # The next one begins as if nothing had been.
    if "power" in options.steps:
        attempt("power", PowerCuts(boot, disk, options.out).run)
    return failed


def main():
    options = parse()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    began = time.monotonic()
    try:
        os.makedirs(options.out, exist_ok=True)
        make_payload(options)
        disk = os.path.join(options.out, "disk.ext4")
        tree.disk(options.tree, options.payload, disk)
        print("power on", flush=True)
        failed = run(options, disk)
    except (Failure, Timeout, OSError, subprocess.CalledProcessError) as error:
        print(f"emulated board: {error}; see {options.out}", flush=True)
        return 1
    what = f"failed: {', '.join(failed)}" if failed else "all well"
    print(f"emulated board: {what} after {time.monotonic() - began:.0f} s; pictures in "
          f"{options.out}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
