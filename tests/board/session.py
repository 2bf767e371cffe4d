"""A running board seen from outside: waiting by its clock, its journal, metrics and screen.

The board's clock counts instructions (machine.py), so a promise in seconds means the same on a busy
PC as on an idle one.
"""

import json
import os
import re
import time

import pictures
from machine import Timeout

METRICS = "/run/caryatid/metrics.jsonl"
STEP_CONFIG = "/run/systemd/system/caryatid.service.d/zz-step.conf"


class Failure(Exception):
    """The board did not do what it must."""


def check(holds, what):
    print(f"    {'ok  ' if holds else 'FAIL'} {what}", flush=True)
    if not holds:
        raise Failure(what)


def say(text):
    print(f"    {text}", flush=True)


class Session:
    """One board that is up, until its machine ends."""

    def __init__(self, board, out):
        self.board, self.out = board, out

    # Time.

    def now_s(self):
        return float(self.board.run("cut -d' ' -f1 /proc/uptime"))

    def wait(self, what, seconds, probe, pause_s=0.5):
        """Calls `probe` until it gives something, for so many of the board's seconds."""
        end_s = self.now_s() + seconds
        while True:
            found = probe()
            if found:
                return found
            if self.now_s() > end_s:
                raise Timeout(f"{what}: not within {seconds} s of the board's time")
            time.sleep(pause_s)

    def pass_time(self, seconds):
        end_s = self.now_s() + seconds
        while self.now_s() < end_s:
            time.sleep(0.3)

    # The service.

    def unit(self, what):
        return self.board.run(f"systemctl show -p {what} --value caryatid")

    def wait_running(self, seconds=60):
        self.wait("the service", seconds,
                  lambda: self.board.run("systemctl is-active caryatid") == "active")

    def configure(self, lines):
        """More lines for the service's unit, from its next start on; those of before are gone."""
        text = "\\n".join(["[Service]"] + lines)
        self.board.run(f"mkdir -p {os.path.dirname(STEP_CONFIG)}; "
                       f"printf '{text}\\n' >{STEP_CONFIG}; systemctl daemon-reload")

    def restart_with(self, options):
        """The kiosk with these options beside its own."""
        self.configure([f"Environment=\"STEP_OPTIONS={options}\""])
        self.forgive()
        self.board.run("systemctl restart caryatid")

    def forgive(self):
        """A test starts it more often than the unit lets a crash loop do before it reboots."""
        self.board.run("systemctl reset-failed caryatid")

    def journal(self, text, since_s=0.0):
        """Board's times of the service's messages that hold `text`, after `since_s`."""
        lines = self.board.run("journalctl -q -o short-monotonic -u caryatid --no-pager | "
                               f"grep -F '{text}'")
        times = [float(t) for t in re.findall(r"^\[ *([0-9.]+)\]", lines, re.M)]
        return [t for t in times if t > since_s]

    def wait_told(self, text, seconds, since_s):
        """The board's time of a message after `since_s`."""
        return self.wait(f"'{text}' in the journal", seconds,
                         lambda: self.journal(text, since_s))[0]

    # The metrics.

    def metrics(self, lines=1):
        return self._parsed(f"tail -n {lines + 1} {METRICS} 2>/dev/null")[-lines:]

    def reactions(self):
        return self._parsed(f"grep reaction_ms {METRICS}")

    def all_metrics(self):
        return self._parsed(f"cat {METRICS}")

    def _parsed(self, command):
        found = []
        for line in self.board.run(command).splitlines():
            try:
                found.append(json.loads(line))
            except ValueError:
                pass  # Cut by the flush, or the shell's.
        return found

    def frame_count(self):
        return int(self.board.run(f"wc -l < {METRICS} || echo 0").split()[-1])

    def wait_frames(self, more, seconds=60):
        # The file begins anew with each start.
        seen = self.metrics()
        start = seen[0]["time_s"] if seen else 0.0

        def passed():
            last = self.metrics()
            return last and (self.frame_count() > more and last[0]["time_s"] < start or
                             last[0]["time_s"] >= start + more / 5.0)
        self.wait(f"{more} frames", seconds, passed)

    def wait_feeling(self, mood, seconds=20):
        self.wait(f"{mood} in the metrics", seconds,
                  lambda: [m for m in self.metrics(20) if m["emotion"] == mood])

    def wait_calm(self):
        self.wait("calm in the metrics", 90,
                  lambda: all(m["emotion"] == "calm" for m in self.metrics(10)))

    # The screen.

    def dump(self, name):
        """What is scanned out now; it stays beside the logs as NAME.png."""
        ppm = self.board.picture(name)
        picture = pictures.read_ppm(ppm)
        os.remove(ppm)
        picture.write_png(os.path.join(self.out, name + ".png"))
        return picture
