"""Pictures as lists of bytes, with the standard library alone: read, written, compared."""

import struct
import zlib


class Picture:
    """Rows of RGB bytes, first row on top."""

    def __init__(self, width, height, rgb):
        self.width, self.height, self.rgb = width, height, rgb

    def blocks(self, box=(0.03, 0.04, 0.97, 0.96), across=0, down=0, size=8):
        """Mean colours of squares of `size` pixels: what is seen, without how edges are sampled.
        Of the part `box` (left, top, right, bottom as shares), moved by `across` and `down`."""
        left, right = (int(self.width * box[i]) + across for i in (0, 2))
        top, bottom = (int(self.height * box[i]) + down for i in (1, 3))
        sums = []
        for y in range(top, bottom - size + 1, size):
            rows = [self.rgb[3 * self.width * r:3 * self.width * (r + 1)]
                    for r in range(y, y + size)]
            for x in range(left, right - size + 1, size):
                for channel in range(3):
                    first, last = 3 * x + channel, 3 * (x + size) + channel
                    sums.append(sum(sum(row[first:last:3]) for row in rows) / (size * size))
        return sums

    def views(self, **what):
        """The blocks as they would be if she swayed a little to any side."""
        return [self.blocks(across=across, down=down, **what) for across in (-6, -3, 0, 3, 6)
                for down in (-3, 0, 3)]

    def brightness(self):
        return sum(self.rgb) / len(self.rgb)

    def upside_down(self):
        stride = 3 * self.width
        rows = [self.rgb[y * stride:(y + 1) * stride] for y in reversed(range(self.height))]
        return Picture(self.width, self.height, b"".join(rows))

    def blue_for_red(self):
        rgb = bytearray(self.rgb)
        rgb[0::3], rgb[2::3] = self.rgb[2::3], self.rgb[0::3]
        return Picture(self.width, self.height, bytes(rgb))

    def write_png(self, path):
        stride = 3 * self.width
        rows = b"".join(b"\0" + self.rgb[y * stride:(y + 1) * stride] for y in range(self.height))

        def chunk(kind, data):
            body = kind + data
            return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
        head = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) +
                       chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def read_ppm(path):
    """A binary PPM as QEMU writes it: no comments."""
    with open(path, "rb") as file:
        data = file.read()
    magic, width, height, _ = data.split(None, 4)[:4]
    if magic != b"P6":
        raise ValueError(f"{path}: no PPM")
    size = 3 * int(width) * int(height)
    return Picture(int(width), int(height), data[-size:])


def read_png(path):
    """An RGB PNG without interlace, as caryatid writes it."""
    with open(path, "rb") as file:
        data = file.read()
    width, height, depth, colour = struct.unpack(">IIBB", data[16:26])
    if (depth, colour) != (8, 2):
        raise ValueError(f"{path}: not 8-bit RGB")
    packed, at = b"", 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    lines, stride, rows = zlib.decompress(packed), 3 * width, []
    above = bytearray(stride)
    for y in range(height):
        start = y * (stride + 1)
        above = unfilter(lines[start], bytearray(lines[start + 1:start + 1 + stride]), above)
        rows.append(bytes(above))
    return Picture(width, height, b"".join(rows))


def unfilter(kind, row, above):
    """Undoes a PNG filter (PNG 1.2, section 6) of one row of RGB pixels."""
    for x in range(len(row) if kind else 0):
        left, up = row[x - 3] if x >= 3 else 0, above[x]
        corner = above[x - 3] if x >= 3 else 0
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = up
        elif kind == 3:
            guess = (left + up) // 2
        else:
            estimate = left + up - corner
            guess = min((left, up, corner), key=lambda v: abs(estimate - v))
        row[x] = (row[x] + guess) & 255
    return row


def distance(a, b):
    """Mean difference of two lists of blocks, 0..255."""
    if len(a) != len(b):
        return 255.0
    return sum(abs(x - y) for x, y in zip(a, b)) / len(a)
