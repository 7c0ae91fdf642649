#!/usr/bin/env python3
"""Measures error against time of spectrel and of Mitsuba 3 on the same scenes, one after the other in one run.

    cargo build --release
    python3 benches/peers/speed.py             # all scenes, about 20 minutes on two free cores, 12 once there are references
    python3 benches/peers/speed.py --quick     # whether everything runs; the figures are none
    python3 benches/peers/speed.py metals      # one scene
    python3 benches/peers/speed.py own         # what ways of rendering with spectrel cost against each other
    python3 benches/peers/speed.py --write     # renders nothing: writes its part of README.md from the last results

References are kept below `target/peers/`, so that a second run is quicker and an interrupted one goes on.
"""

import argparse
import json
import os

import environment
from environment import WORK

# Of pictures: about 128² and 512² pixels, in the scene's shape.
SMALL, LARGE = 128**2, 512**2
# Renders of a renderer and count, with seeds of their own; the raw rate is the median of fewer.
REPEATS, RAW_REPEATS = 5, 7
SCENES = ["metals", "diamond", "cornell", "mesh"]
OWN = "own"


def arguments():
    parser = argparse.ArgumentParser(description="Error against time of spectrel and Mitsuba 3.")
    parser.add_argument(
        "scenes",
        nargs="*",
        metavar="SCENE",
        help=f"of {', '.join(SCENES)}, glass, {OWN}; the first {len(SCENES)} and {OWN} unless given",
    )
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="of both renderers (default: all cores)")
    parser.add_argument("--quick", action="store_true", help="few samples, to see whether everything runs")
    parser.add_argument("--fresh", action="store_true", help="render references anew")
    parser.add_argument("--write", action="store_true", help="render nothing, write README.md from the last results")
    options = parser.parse_args()
    options.scenes = options.scenes or [*SCENES, OWN]
    for name in options.scenes:
        if name not in [*SCENES, "glass", OWN]:
            parser.error(f"no scene is called {name}")
    options.pixels = [SMALL // 16, LARGE // 16] if options.quick else [SMALL, LARGE]
    options.repeats = 2 if options.quick else REPEATS
    options.raw_repeats = 1 if options.quick else RAW_REPEATS
    options.share = 64 if options.quick else 1
    options.work = WORK / ("quick" if options.quick else "speed")
    return options


def main():
    environment.enter()
    options = arguments()

    import mitsuba as mi

    mi.set_variant("scalar_spectral")

    import machine
    import page
    import race
    import renderers
    import results
    import spectra

    options.work.mkdir(parents=True, exist_ok=True)
    paths = {name: options.work / f"{name}.json" for name in [*SCENES, "glass", OWN]}
    if options.write:
        found = [json.loads(path.read_text()) for path in paths.values() if path.exists()]
        page.replace("speed", results.section(found))
        return
    spectra.write_observer(WORK / "library", *renderers.observer())
    found = []
    for name in options.scenes:
        before = machine.state(options.threads)
        print(f"{name}: {before['machine']}, load {before['load']:.2f}", flush=True)
        result = race.measure_own(options) if name == OWN else race.measure(name, options)
        found.append(result | before)
        paths[name].write_text(json.dumps(found[-1]))
        print(results.table(found[-1]), flush=True)
    print(results.bars(found), flush=True)


if __name__ == "__main__":
    main()
