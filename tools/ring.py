#!/usr/bin/env python3
"""Writes scenes/meshes/ring.obj: a wedding band with a comfortable inside, as one closed surface of quads.

The profile is a superellipse, 4.4 mm wide and 1.7 mm thick, turned around z at a radius of 9.3 mm. Lengths are
millimetres; normals are left to the renderer (`crease_angle`).
"""

import math
import pathlib

AROUND, ACROSS = 96, 24
RADIUS, HALF_WIDTH, HALF_THICKNESS, EXPONENT = 9.3, 2.2, 0.85, 2.6

TARGET = pathlib.Path(__file__).parent.parent / "scenes" / "meshes" / "ring.obj"


def profile(angle):
    """Distance from the middle of the band, outwards and along the axis."""
    bend = lambda x: math.copysign(abs(x) ** (2 / EXPONENT), x)
    return HALF_THICKNESS * bend(math.cos(angle)), HALF_WIDTH * bend(math.sin(angle))


def corners():
    for i in range(AROUND):
        turn = 2 * math.pi * i / AROUND
        for j in range(ACROSS):
            out, along = profile(2 * math.pi * j / ACROSS)
            yield (RADIUS + out) * math.cos(turn), (RADIUS + out) * math.sin(turn), along


def quads():
    at = lambda i, j: i % AROUND * ACROSS + j % ACROSS + 1
    for i in range(AROUND):
        for j in range(ACROSS):
            yield at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)


def main():
    lines = ["# A wedding band, written by tools/ring.py; millimetres.", "o Band", "usemtl Ring"]
    lines += ["v {:.4f} {:.4f} {:.4f}".format(*corner) for corner in corners()]
    lines += ["f {} {} {} {}".format(*quad) for quad in quads()]
    TARGET.parent.mkdir(exist_ok=True)
    TARGET.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
