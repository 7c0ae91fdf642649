#!/usr/bin/env python3
"""Renders the scenes beside this file with spectrel and with Mitsuba 3 and compares means of regions.

    cargo build --release
    python3 benches/peers/compare.py                         # all scenes, about a quarter of an hour on two free cores
    python3 benches/peers/compare.py --samples 64 glass      # a quick look at one
    python3 benches/peers/compare.py --write                 # renders nothing: writes its part of README.md from the last results

The Python packages go into an environment of their own below `target/`.
"""

import argparse
import json

import environment
from environment import HERE, WORK

# With the samples a pixel and replicate that bring the standard error of the larger regions below 0.05 %.
SCENES = {"metals": 1024, "cornell": 1024, "glass": 1024}

# The exchanged masking term is rendered with so many times fewer samples.
EXCHANGE = 16


def arguments():
    parser = argparse.ArgumentParser(description="Compares spectrel with Mitsuba 3.")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"of {', '.join(SCENES)}; all unless given")
    parser.add_argument("--samples", type=int, help="a pixel and replicate (default: by scene)")
    parser.add_argument("--replicates", type=int, default=8, help="renders with seeds of their own (default: 8)")
    parser.add_argument("--write", action="store_true", help="render nothing, write README.md from the last results")
    parser.add_argument("--pictures", action="store_true", help="write PNGs of both and their difference")
    options = parser.parse_args()
    options.scenes = options.scenes or list(SCENES)
    for name in options.scenes:
        if name not in SCENES:
            parser.error(f"no scene is called {name}")
    if options.replicates < 4:
        parser.error("confidence intervals need at least 4 replicates")
    return options


def compare(name, options):
    """Two sections of rows (region, pixels, deviations): alike, and each as it is; and the pictures of the first."""
    import measure
    import regions
    import renderers
    import spectra
    import translate

    path = HERE / f"{name}.toml"
    description = translate.load(path)
    library = WORK / "library"
    spectra.write_observer(library, *renderers.observer())
    samples = options.samples or SCENES[name]
    rough = any("roughness" in material.get("conductor", {}) for material in description["materials"].values())

    def replicates(renderer, first, samples):
        # Seeds apart: the generators differ, but nothing is lost by not sharing them.
        return [renderer.render(samples, first + 100 * i).picture for i in range(options.replicates)]

    peer = renderers.Mitsuba(description)
    masks = regions.of(peer.scene, description)
    ours_alike = replicates(renderers.Spectrel(path, library), 3, samples)
    ours = replicates(renderers.Spectrel(path), 4, samples)
    theirs = theirs_alike = replicates(peer, 1, samples)
    if rough:
        # What the exchange changes, with equal seeds: paths and noise are nearly the same, so that few samples do.
        few = max(samples // EXCHANGE, 1)
        exchanged = replicates(renderers.Mitsuba(description, correlated=True), 2, few)
        plain = replicates(peer, 2, few)
        theirs_alike = [a + b - c for a, b, c in zip(theirs, exchanged, plain)]

    def section(a, b):
        rows = []
        for region, mask in masks.items():
            found = measure.deviations(measure.means(a, mask), measure.means(b, mask))
            rows.append((region, int(mask.sum()), found))
        return rows

    alike, as_they_are = section(ours_alike, theirs_alike), section(ours, theirs)
    title = f"{name}, {options.replicates} × {samples} samples"
    return [(f"{title}, alike", alike), (f"{title}, as they are", as_they_are)], (ours_alike, theirs_alike)


def main():
    environment.enter()
    options = arguments()

    import mitsuba as mi

    mi.set_variant("scalar_spectral")

    import page
    import report
    import translate

    translate.register()
    WORK.mkdir(parents=True, exist_ok=True)
    if options.write:
        results = [json.loads((WORK / f"{name}.json").read_text()) for name in SCENES]
        page.replace("means", report.section([report.Result.from_json(result) for result in results]))
        return
    for name in options.scenes:
        sections, pictures = compare(name, options)
        result = report.Result(sections)
        if options.pictures:
            report.write_pictures(WORK / f"{name}.png", *pictures)
        print(result, flush=True)
        (WORK / f"{name}.json").write_text(json.dumps(result.to_json()))


if __name__ == "__main__":
    main()
