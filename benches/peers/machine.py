"""What the measurements were made on, and with."""

import datetime
import os
from pathlib import Path

import renderers


def state(threads):
    """With the load of the machine over the last minute: what is above 0 is other people's work, or our own of a moment ago."""
    ours, theirs = renderers.versions()
    return {
        "date": datetime.date.today().isoformat(),
        "machine": f"{processor()}, {os.cpu_count()} cores",
        "threads": threads,
        "load": os.getloadavg()[0],
        "versions": [ours, theirs.split(",")[0]],
    }


def processor():
    path = Path("/proc/cpuinfo")
    lines = path.read_text().splitlines() if path.exists() else []
    fields = dict(line.replace("\t", "").split(":", 1) for line in reversed(lines) if ":" in line)
    name = fields.get("model name", "unknown processor").strip()
    number = [fields[key].strip() for key in ("cpu family", "model") if key in fields]
    return f"{name} (family {number[0]}, model {number[1]})" if len(number) == 2 else name
