#!/usr/bin/env python3
"""Renders the scenes beside this file with spectrel and with Mitsuba 3 and compares means of regions.

    cargo build --release
    python3 benches/peers/compare.py                         # all scenes, about a quarter of an hour on two cores
    python3 benches/peers/compare.py --samples 64 glass      # a quick look at one
    python3 benches/peers/compare.py --write                 # also writes the README.md beside this file
    python3 benches/peers/compare.py --time                  # also error against CPU time

The Python packages go into an environment of their own below `target/`.
"""

import argparse
import os
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
WORK = HERE.parents[1] / "target" / "peers"
SCENES = ["metals", "cornell", "glass"]


def enter_environment():
    """Starts this script anew with the pinned packages, which are installed the first time."""
    folder = WORK / "venv"
    python = folder / "bin" / "python"
    pins = HERE / "requirements.txt"
    installed = folder / "requirements.txt"
    if not installed.exists() or installed.read_text() != pins.read_text():
        venv.create(folder, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "-q", "-r", pins], check=True)
        installed.write_text(pins.read_text())
    if Path(sys.prefix).resolve() != folder.resolve():
        os.execv(python, [python, *sys.argv])


def arguments():
    parser = argparse.ArgumentParser(description="Compares spectrel with Mitsuba 3.")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"of {', '.join(SCENES)}; all unless given")
    parser.add_argument("--samples", type=int, default=1024, help="a pixel and replicate (default: 1024)")
    parser.add_argument("--replicates", type=int, default=8, help="renders with seeds of their own (default: 8)")
    parser.add_argument("--write", action="store_true", help="write README.md")
    parser.add_argument("--pictures", action="store_true", help=f"write PNGs of both and their difference")
    parser.add_argument("--time", action="store_true", help="also error against CPU time")
    options = parser.parse_args()
    options.scenes = options.scenes or SCENES
    for name in options.scenes:
        if name not in SCENES:
            parser.error(f"no scene is called {name}")
    if options.write and options.scenes != SCENES:
        parser.error("--write needs all scenes")
    if options.replicates < 4:
        parser.error("confidence intervals need at least 4 replicates")
    return options


def compare(name, options):
    """Pairs of a title and rows of (region, pixels, deviations), and both mean pictures."""
    import measure
    import regions
    import translate
    from renderers import Mitsuba, Spectrel

    path = HERE / f"{name}.toml"
    description = translate.load(path)
    rough = any("roughness" in material.get("conductor", {}) for material in description["materials"].values())
    peers = {name: Mitsuba(description)}
    if rough:
        peers = {
            f"{name}, masking term exchanged in Mitsuba": Mitsuba(description, correlated=True),
            f"{name}, Mitsuba as it is": peers[name],
        }
    masks = regions.of(next(iter(peers.values())).scene, description)

    def replicates(renderer, first):
        return [renderer.render(options.samples, first + i)[0] for i in range(options.replicates)]

    # Seeds apart: the generators differ, but nothing is lost by not sharing them.
    ours = replicates(Spectrel(path), 1000)
    sections, pictures = [], []
    for number, (title, peer) in enumerate(peers.items()):
        theirs = replicates(peer, 2000 + 1000 * number)
        rows = [
            (region, int(mask.sum()), measure.deviations(measure.means(ours, mask), measure.means(theirs, mask)))
            for region, mask in masks.items()
        ]
        sections.append((title, rows))
        pictures.append((ours, theirs))
    return sections, pictures[0]


def main():
    enter_environment()
    options = arguments()

    import mitsuba as mi

    mi.set_variant("scalar_spectral")

    import report
    import timing
    import translate

    translate.register()
    sections, timed = [], []
    for name in options.scenes:
        found, pictures = compare(name, options)
        sections += found
        print(report.tables(found), flush=True)
        if options.pictures:
            report.write_pictures(WORK / f"{name}.png", *pictures)
        if options.time:
            timed.append((name, timing.measure(HERE / f"{name}.toml", *pictures)))
            print(timing.table(timed[-1:]), flush=True)
    print(report.summary(sections))
    if options.write:
        (HERE / "README.md").write_text(report.page(sections, options))


if __name__ == "__main__":
    main()
