#!/usr/bin/env python3
"""Writes scenes/environments/studio.hdr: a photographer's studio as a latitude–longitude picture.

A dark room, lighter above, with a large soft box, a strip and a small lamp; linear sRGB, Radiance HDR without runs. The
picture's middle is where `rotate = 0` puts it (see the reference), its top row is straight up.
"""

import math
import pathlib

WIDTH, HEIGHT = 256, 128
TARGET = pathlib.Path(__file__).parent.parent / "scenes" / "environments" / "studio.hdr"

# Azimuth and elevation of the middle, half sizes (degrees), how far the edge fades (degrees), colour.
LAMPS = [
    (-60, 38, 32, 20, 5, (14.0, 13.2, 12.2)),
    (70, 18, 7, 30, 3, (11.0, 11.6, 12.6)),
    (165, 55, 9, 9, 4, (20.0, 19.0, 17.5)),
    (10, 80, 40, 8, 6, (5.0, 5.0, 5.2)),
]


def room(elevation):
    share = 0.5 + 0.5 * math.sin(math.radians(elevation))
    return [0.02 + 0.5 * share**2 * tone for tone in (0.9, 0.95, 1.05)]


def inside(distance, half, fade):
    return min(max((half - distance) / fade + 0.5, 0.0), 1.0)


def radiance(azimuth, elevation):
    colour = room(elevation)
    for middle, height, half_width, half_height, fade, lamp in LAMPS:
        across = abs((azimuth - middle + 180) % 360 - 180) * max(math.cos(math.radians(elevation)), 0.2)
        share = inside(across, half_width, fade) * inside(abs(elevation - height), half_height, fade)
        colour = [(1 - share) * a + share * b for a, b in zip(colour, lamp)]
    return colour


def rgbe(colour):
    mantissa, exponent = math.frexp(max(colour))
    return bytes([int(channel * mantissa * 256 / max(colour)) for channel in colour] + [exponent + 128])


def main():
    rows = bytearray(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (HEIGHT, WIDTH))
    for y in range(HEIGHT):
        for x in range(WIDTH):
            rows += rgbe(radiance((x + 0.5) / WIDTH * 360 - 180, 90 - (y + 0.5) / HEIGHT * 180))
    TARGET.parent.mkdir(exist_ok=True)
    TARGET.write_bytes(rows)


if __name__ == "__main__":
    main()
