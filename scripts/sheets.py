#!/usr/bin/env python3
"""Contact sheets of the runs that scripts/evidence.py left: six frames each, face, profile and back, into docs/sheets/.

Small and with 96 colours each, so that all of them together stay under 12 MB. Needs Pillow."""

import argparse
import subprocess
from pathlib import Path

from PIL import Image

from evidence import ROOT, STYLES, Cell, frames_of, load_clips

FRAMES = 6
DRAWING = ["--view", "face", "profile", "back", "--size", "212", "150", "--height", "0.8", "--strands", "8000", "--samples", "6"]


def frames_shown(clip: dict) -> list[str]:
    """Evenly spread, the first and the last among them."""
    last = frames_of(clip) - 1
    return [str(round(i * last / (FRAMES - 1))) for i in range(FRAMES)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mane", type=Path, default=ROOT / "build/release/tools/mane", help="the command")
    parser.add_argument("--runs", type=Path, default=ROOT / "out/evidence", help="where scripts/evidence.py kept its runs")
    parser.add_argument("--out", type=Path, default=ROOT / "docs/sheets")
    parser.add_argument("--only", nargs="+", default=[""], metavar="WORD", help="sheets whose name contains one of these")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for name, clip in load_clips().items():
        for style in STYLES:
            if any(word in f"{style}-{name}" for word in options.only):
                run, sheet = options.runs / f"{Cell(style, name, 'anisotropic').name}.mane", options.out / f"{style}-{name}.png"
                command = [options.mane, "picture", run, "--frame", *frames_shown(clip), *DRAWING, "-o", sheet]
                subprocess.run(command, check=True)
                Image.open(sheet).convert("RGB").quantize(96).save(sheet, optimize=True)
                print(sheet, flush=True)


if __name__ == "__main__":
    main()
