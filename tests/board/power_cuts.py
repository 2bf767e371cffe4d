"""A board of its own, with a small init that lets the kiosk write its state all the time."""

import os
import random
import re
import time

from machine import Machine, wait_for
from session import check, say

CUTS = 10
# By this PC's clock: a power-on of the small board takes seconds, on a busy PC minutes.
PATIENCE_S = 900


class PowerCuts:
    def __init__(self, boot, disk, out):
        self.boot, self.disk, self.out = boot, disk, os.path.join(out, "power")
        self.random = random.Random(1)
        self.known = 0  # Starts that were safe on the disk.

    def run(self):
        os.makedirs(self.out, exist_ok=True)
        found = [self._power_on(cut + 1) for cut in range(CUTS + 1)]
        say(f"starts that the state knew of at each power-on: {found}")
        check(True, f"{CUTS} cuts of power, and the state was whole each time")

    def _power_on(self, number):
        with Machine(self.out, os.path.join(self.boot, "vmlinuz"),
                     os.path.join(self.boot, "initramfs-small"), self.disk) as board:
            found = self._starts(board, "found", 1)[0]
            check(found >= self.known, f"power-on {number}: the state knows of {found} starts; "
                                       f"{self.known} were safe before the cut")
            self.known = self._starts(board, "wrote", 2)[-1]
            # Somewhere in the next start, its writing, or its end.
            time.sleep(self.random.uniform(0.0, 3.0))
            self.known = max(self.known, *self._told(board, "wrote"))
        return found

    @staticmethod
    def _told(board, word):
        """Counts of starts on lines that begin with `word`; -1 for a state that is not whole."""
        lines = re.findall(rf"^{word} (.*?)\r?\n", board.console(), re.M)
        counts = []
        for line in lines:
            match = re.search(r"caryatid-state 1 starts (\d+) .*crc [0-9a-f]{8}", line)
            # Nothing at all: the first power-on of a new board.
            counts.append(int(match.group(1)) if match else 0 if not line.strip() else -1)
        return counts

    def _starts(self, board, word, least):
        def enough():
            counts = self._told(board, word)
            return counts if len(counts) >= least else None
        counts = wait_for(f"'{word}' on the console", PATIENCE_S, enough, 0.2)
        if -1 in counts:
            check(False, f"every state told as {word!r} is whole")
        return counts
