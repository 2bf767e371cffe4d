"""Recorded sound, with the standard library alone: is what was played what should have been?"""

import array
import math
import struct

RATE_HZ = 8000  # Speech has nearly all of its power below half of this.


def read(path):
    """A WAV's first channel at RATE_HZ, without the silence around it. Its sizes are not looked at:
    QEMU writes them when it ends."""
    with open(path, "rb") as file:
        data = file.read()
    channels, rate = struct.unpack("<HI", data[22:28])
    start = data.index(b"data") + 8
    samples = array.array("h", data[start:start + (len(data) - start) // 4 * 4])[::channels]
    loud = [i for i, s in enumerate(samples) if abs(s) > 300]
    if not loud:
        return []
    samples = samples[loud[0]:loud[-1] + 1]
    step, out = rate / RATE_HZ, []
    for i in range(int(len(samples) / step)):
        # The mean of what one new sample stands for: no tone above RATE_HZ / 2 folds down.
        part = samples[int(i * step):max(int((i + 1) * step), int(i * step) + 1)]
        out.append(sum(part) / len(part))
    return out


def correlation(a, b):
    power = math.sqrt(sum(x * x for x in a) * sum(y * y for y in b))
    return sum(x * y for x, y in zip(a, b)) / power if power > 0.0 else 0.0


def likeness(played, wanted, piece_s=0.25, lost_s=0.3, slack_s=0.02):
    """The mean, over the loud pieces of `wanted`, of each piece's best correlation with `played`
    near where the piece before it was found (while none was, in a wide range): 1 for the same
    sound, also when a device's clock runs a little off, near 0 for another."""
    size, slack, at, found = int(piece_s * RATE_HZ), int(lost_s * RATE_HZ), 0, []
    for start in range(0, len(wanted) - size, size):
        piece = wanted[start:start + size]
        if max(map(abs, piece)) < 1000:
            continue
        near = range(max(start + at - slack, 0), min(start + at + slack, len(played) - size))
        best, where = max(((correlation(piece, played[i:i + size]), i - start) for i in near),
                          default=(0.0, at))
        found.append(best)
        if best > 0.5:
            at, slack = where, int(slack_s * RATE_HZ)
    return sum(found) / len(found) if found else 0.0
