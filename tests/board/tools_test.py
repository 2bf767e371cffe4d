"""What judges the emulated board must itself be right: pictures and sound of known likeness."""

import array
import math
import os
import struct
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(__file__))

import pictures  # noqa: E402
import sound  # noqa: E402


def gradient(width=48, height=32):
    return pictures.Picture(width, height, bytes(
        value for y in range(height) for x in range(width) for value in (5 * x, 7 * y, 40)))


def tone_steps(seconds=2.0):
    """A voice of a kind: a tone that wanders, and its loudness too."""
    samples, phase = [], 0.0
    for i in range(int(seconds * sound.RATE_HZ)):
        time_s = i / sound.RATE_HZ
        phase += 2.0 * math.pi * (300.0 + 200.0 * math.sin(3.0 * time_s)) / sound.RATE_HZ
        samples.append(8000.0 * (1.2 + math.sin(7.0 * time_s)) * math.sin(phase))
    return samples


def write_wav(path, samples, channels):
    data = array.array("h", [int(s) for s in samples for _ in range(channels)]).tobytes()
    with open(path, "wb") as file:
        # As QEMU leaves it: no sizes.
        file.write(b"RIFF\0\0\0\0WAVEfmt " + struct.pack(
            "<IHHIIHH", 16, 1, channels, sound.RATE_HZ, 2 * channels * sound.RATE_HZ, 2 * channels,
            16) + b"data\0\0\0\0" + data)


class Pictures(unittest.TestCase):
    def test_a_png_is_read_as_it_was_written(self):
        with tempfile.TemporaryDirectory() as folder:
            gradient().write_png(os.path.join(folder, "a.png"))
            self.assertEqual(pictures.read_png(os.path.join(folder, "a.png")).rgb, gradient().rgb)

    def test_every_png_filter_is_undone(self):
        row, above = bytes(range(10, 22)), bytes(range(50, 62))
        guesses = {
            1: lambda left, up, corner: left,
            2: lambda left, up, corner: up,
            3: lambda left, up, corner: (left + up) // 2,
            4: lambda left, up, corner: min((left, up, corner),
                                            key=lambda v: abs(left + up - corner - v))}
        for kind, guess in guesses.items():
            packed = bytearray(
                (row[x] - guess(row[x - 3] if x > 2 else 0, above[x],
                                above[x - 3] if x > 2 else 0)) & 255 for x in range(len(row)))
            self.assertEqual(pictures.unfilter(kind, packed, above), row, kind)

    def test_only_the_same_picture_is_near(self):
        view = gradient()
        far = (view.upside_down(), view.blue_for_red())
        self.assertEqual(pictures.distance(view.blocks(), view.blocks()), 0.0)
        for other in far:
            self.assertGreater(pictures.distance(view.blocks(), other.blocks()), 20.0)

    def test_turned_twice_it_is_itself(self):
        self.assertEqual(gradient().upside_down().upside_down().rgb, gradient().rgb)
        self.assertEqual(gradient().blue_for_red().blue_for_red().rgb, gradient().rgb)


class Sound(unittest.TestCase):
    def test_silence_around_and_loudness_do_not_count(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.wav")
            write_wav(path, [0.0] * 900 + [0.5 * s for s in tone_steps()] + [0.0] * 50, 2)
            self.assertGreater(sound.likeness(sound.read(path), tone_steps()), 0.98)

    def test_a_gap_shifts_what_follows_and_no_more(self):
        whole = tone_steps()
        self.assertGreater(sound.likeness(whole[:7000] + [0.0] * 80 + whole[7000:], whole), 0.9)

    def test_another_sound_is_not_like_it(self):
        self.assertLess(sound.likeness(tone_steps()[::-1], tone_steps()), 0.6)
        self.assertEqual(sound.likeness([], tone_steps()), 0.0)

    def test_nothing_was_played(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.wav")
            write_wav(path, [0.0] * 900, 2)
            self.assertEqual(sound.read(path), [])


if __name__ == "__main__":
    unittest.main()
