#!/usr/bin/env python3
"""Rays a second against Embree: one mesh, the same rays, one thread each, in turns.

    python3 benches/peers/embree/compare.py [--rounds 7] [--rows 509] [--quality medium|high]

Needs g++ and Debian's libembree-dev (Embree 3.13). Builds both sides, writes mesh and rays to target/embree/ and runs the two one
after the other in each round. Times are processor time of the thread, in each run the fastest of three passes; the table shows
medians over the rounds, and the median of the ratios within a round. Embree builds with RTC_SCENE_FLAG_ROBUST and traces by
rtcIntersect1 and rtcOccluded1. Ours are `World::first`, which tells distance, side and triangle; Embree also gives two weights and a normal
of any length. `+surface` is `World::closest`, which puts the point onto the surface in double precision and gives unit normals besides.

Of the million camera rays 17 are told another triangle, all at edges. By exact arithmetic on the same numbers (Python's fractions) ours alone
is crossed by 12 of them, Embree's alone by 4, both by one. That is the one whose distances differ, 2.86965 here and 2.88860 there: it crosses
both triangles, ours is the nearer one, and Embree lets the ray through.

`leaving` are the diffuse rays as the renderer asks for them, from the hit itself; Embree knows no such question.
"""

import argparse
import array
import json
import statistics
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
OUTPUT = ROOT / "target" / "embree"
KINDS = ["camera", "diffuse", "random", "shadow"]


def build():
    """The two programs."""
    peer = OUTPUT / "embree"
    subprocess.run(["g++", "-O3", "-march=native", HERE / "embree.cpp", "-o", peer, "-lembree3"], check=True)
    cargo = ["cargo", "bench", "--bench", "rays", "--no-run", "--message-format", "json"]
    messages = subprocess.run(cargo, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    found = (json.loads(line) for line in messages.splitlines() if line.startswith("{"))
    ours = [m["executable"] for m in found if m.get("target", {}).get("name") == "rays" and m.get("executable")]
    return ours[-1], peer


def run(*command):
    """Nanoseconds a ray, by kind."""
    lines = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.split("\n")
    return {kind: float(value) for kind, value in (line.split() for line in lines if line)}


def hits(path):
    """Distances and triangles of each kind."""
    words = path.read_bytes()
    distances, triangles = array.array("f", words), array.array("I", words)
    count = len(distances) // 2 // len(KINDS)
    for kind in range(len(KINDS)):
        part = slice(2 * count * kind, 2 * count * (kind + 1))
        yield distances[part][::2], triangles[part][1::2]


def differences(ours, theirs):
    """How many rays are told differently: met or not; another triangle at another distance."""
    rows = []
    for (t, triangle), (peer_t, peer_triangle) in zip(hits(ours), hits(theirs)):
        met = sum((a < 0) != (b < 0) for a, b in zip(t, peer_t))
        apart = sum(
            a >= 0 and b >= 0 and m != n and abs(a - b) > 1e-5 * (1 + a)
            for a, b, m, n in zip(t, peer_t, triangle, peer_triangle)
        )
        rows.append((len(t), sum(a >= 0 for a in t), met, apart))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--rows", type=int, default=509, help="the ball has about 4 ROWS² triangles")
    parser.add_argument("--quality", choices=["medium", "high"], default="medium", help="of Embree's tree")
    options = parser.parse_args()
    OUTPUT.mkdir(parents=True, exist_ok=True)
    ours, peer = build()
    ball, mine, its = OUTPUT / "ball.bin", OUTPUT / "ours.bin", OUTPUT / "theirs.bin"
    subprocess.run([ours, "write", ball, str(options.rows)], check=True)
    rounds = [(run(ours, "time", ball, mine), run(peer, ball, its, options.quality)) for _ in range(options.rounds)]

    print(f"{options.rounds} rounds, Embree's tree of {options.quality} quality; million rays a second, one thread")
    print(f"{'rays':<10}{'hit, %':>8}{'spectrel':>10}{'Embree':>8}{'ratio':>7}{'  least … largest':<18}{'differ: met':>12}{'triangle':>10}")
    for kind, (count, met, differ, apart) in zip(KINDS, differences(mine, its)):
        own = statistics.median(a[kind] for a, _ in rounds)
        other = statistics.median(b[kind] for _, b in rounds)
        ratios = sorted(b[kind] / a[kind] for a, b in rounds)
        spread = f"  {ratios[0]:.2f} … {ratios[-1]:.2f}"
        print(
            f"{kind:<10}{100 * met / count:8.1f}{1e3 / own:10.2f}{1e3 / other:8.2f}"
            f"{statistics.median(ratios):7.2f}{spread:<18}{differ:12}{apart:10}"
        )
    for kind in KINDS[:3]:
        kind += "+surface"
        own = statistics.median(a[kind] for a, _ in rounds)
        ratio = statistics.median(b[kind.split("+")[0]] / a[kind] for a, b in rounds)
        print(f"{kind:<18}{1e3 / own:10.2f}{'':8}{ratio:7.2f}")
    leaving = statistics.median(a["leaving"] for a, _ in rounds)
    print(f"{'leaving':<10}{'':8}{1e3 / leaving:10.2f}")


if __name__ == "__main__":
    main()
