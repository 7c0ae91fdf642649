"""Where the scripts work, and the Python packages that they work with: an environment of its own below `target/`."""

import os
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
WORK = HERE.parents[1] / "target" / "peers"


def enter():
    """Starts the script anew with the pinned packages, which are installed the first time."""
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
