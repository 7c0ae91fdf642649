#!/usr/bin/env python3
"""Run folders of meshes, pictures and data pages through the program, and list what it refuses and why.

    python tools/try_files.py FOLDER... [--program target/release/spectrel] [--render] [--list WHAT] [--csv FILE]

Each file becomes a scene of its own, as a user would write it first: a mesh in a grey room, a picture as surroundings or as a
texture, a page as the index of a metal. It is inspected, or with --render rendered with one sample. Nothing but Python is needed.
Exits with 1 if the program crashed, hung or wrote something that is no message.
"""

import argparse
import collections
import concurrent.futures
import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

MESHES = {".obj", ".ply", ".stl", ".gltf", ".glb"}
SURROUNDINGS = {".exr", ".hdr"}
TEXTURES = {".png", ".jpg", ".jpeg"}
PAGES = {".yml", ".yaml", ".csv", ".nk", ".txt", ".dat", ".spd"}
KINDS = [("mesh", MESHES), ("surroundings", SURROUNDINGS), ("texture", TEXTURES), ("page", PAGES)]

VIEW = """meters_per_unit = 0.001
render = { width = 16, height = 16, samples = 1 }
camera = { position = [0, -8, 3], look_at = [0, 0, 0], fov = 30 }
"""
SKY = 'environment.constant = { spectrum = "D65", luminance = 100 }\n'
GREY = "materials.m.diffuse.reflectance = 0.5\n"


def scene(kind, path):
    """Return the text of a scene that uses a file."""
    name = json.dumps(str(path), ensure_ascii=False)
    if kind == "mesh":
        return f'{VIEW}{SKY}{GREY}[[objects]]\nmaterial = "m"\nshape.mesh = {{ file = {name} }}\n'
    ball = '[[objects]]\nmaterial = "m"\nshape.sphere = { radius = 1 }\n'
    if kind == "surroundings":
        return f"{VIEW}{GREY}environment.image = {{ file = {name} }}\n{ball}"
    if kind == "texture":
        return f"{VIEW}{SKY}materials.m.diffuse.reflectance = {{ image = {name} }}\n{ball}"
    return f"{VIEW}{SKY}materials.m.conductor.ior = {name}\n{ball}"


def files(folders):
    """Yield (kind, path) of everything below the folders that some reader may know."""
    for folder in map(pathlib.Path, folders):
        below = sorted(folder.rglob("*")) if folder.is_dir() else [folder]
        for path in below:
            for kind, suffixes in KINDS:
                if path.suffix.lower() in suffixes and path.is_file():
                    yield kind, path.resolve()


def run(program, render, seconds, kind, path):
    """Return (outcome, messages) of one file; the outcome is read, refused, crashed or hung."""
    with tempfile.TemporaryDirectory() as folder:
        text = pathlib.Path(folder) / "scene.toml"
        text.write_text(scene(kind, path), encoding="utf-8")
        command = [program, "render", str(text), "-o", f"{folder}/out.png"] if render else [program, "inspect", str(text)]
        try:
            done = subprocess.run(command, capture_output=True, timeout=seconds, env={**os.environ, "NO_COLOR": "1"})
        except subprocess.TimeoutExpired:
            return "hung", [f"no answer after {seconds} s"]
    said = (done.stderr + done.stdout).decode("utf-8", "replace").splitlines()
    # Where the scene of this script stands tells nobody anything.
    said = [re.sub(rf"{re.escape(str(text))}(:\d+:\d+)?:? ?", "", line).replace(str(path), path.name) for line in said]
    found = [line for line in said if re.match(r"(error|warning|note)\b", line)]
    if done.returncode == 0:
        return "read", found
    well = done.returncode in (1, 2) and any(line.startswith("error") for line in found)
    return ("refused", found) if well else ("crashed", said[-3:] or [f"exit status {done.returncode}"])


def general(message, path):
    """Return a message without what differs from file to file, so that equal ones are counted together."""
    return re.sub(r"\d[\d.e+-]*", "#", re.sub(r"`[^`]*`", "`…`", message.replace(path.name, "FILE")))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--program", default="target/release/spectrel")
    parser.add_argument("--render", action="store_true", help="render one sample instead of inspecting")
    parser.add_argument("--seconds", type=float, default=60, help="time for one file")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", metavar="WHAT", help="list each file whose outcome or message contains this")
    parser.add_argument("--csv", metavar="FILE", help="write kind, file, outcome and messages of all")
    args = parser.parse_args()
    if not args.program.count(os.sep) or not os.access(args.program, os.X_OK):
        parser.error(f"no program at {args.program}: build it with `cargo build --release`, or name it with --program")

    everything = list(files(args.folders))
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        outcomes = pool.map(lambda entry: run(args.program, args.render, args.seconds, *entry), everything)
        rows = [(kind, path, *outcome) for (kind, path), outcome in zip(everything, outcomes)]

    for kind, _ in KINDS:
        of_kind = [row for row in rows if row[0] == kind]
        if not of_kind:
            continue
        counts = collections.Counter(row[2] for row in of_kind)
        print(f"{kind}: " + ", ".join(f"{count} {outcome}" for outcome, count in counts.most_common()))
        said = collections.defaultdict(list)
        for _, path, outcome, messages in of_kind:
            for message in messages:
                said[outcome, general(message, path)].append(path)
        for (outcome, message), paths in sorted(said.items(), key=lambda item: -len(item[1])):
            print(f"{len(paths):6}  {outcome:8} {message}\n{'':16} such as {paths[0]}")
    if args.list:
        for kind, path, outcome, messages in rows:
            if args.list in " ".join([outcome, *messages]):
                print(f"{kind} {outcome}: {path}", *messages, sep="\n    ")
    if args.csv:
        with open(args.csv, "w", newline="", encoding="utf-8") as out:
            writer = csv.writer(out)
            writer.writerow(["kind", "file", "outcome", "messages"])
            writer.writerows((kind, path, outcome, " | ".join(messages)) for kind, path, outcome, messages in rows)
    sys.exit(any(row[2] in ("crashed", "hung") for row in rows))


if __name__ == "__main__":
    main()
