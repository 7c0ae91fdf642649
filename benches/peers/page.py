"""README.md, whose parts are written by the scripts that find their figures: each stands between two comments of its name."""

from environment import HERE

PATH = HERE / "README.md"


def replace(part, text):
    begin, end = f"<!-- {part} -->\n", f"<!-- end of {part} -->\n"
    before, _, rest = PATH.read_text().partition(begin)
    _, found, after = rest.partition(end)
    if not found:
        raise SystemExit(f"{PATH} has no part between {begin.strip()} and {end.strip()}")
    PATH.write_text(before + begin + text.strip("\n") + "\n" + end + after)
