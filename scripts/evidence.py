#!/usr/bin/env python3
"""Evidence for the paper's claims (M41): nine captured clips × three styles × wisps off, isotropic, as in the paper.

Simulates every cell with the scenes as they are, has `mane check` judge it, and writes docs/evidence.md and its plots. One more run
per style and mode stops the motion, for the decay of energy. Cells that are done are not run again (--fresh runs them anew).
Needs Python 3.11 and, for the plots, matplotlib.
"""

import argparse
import json
import subprocess
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean

from evidence_report import write_report

ROOT = Path(__file__).resolve().parent.parent
MOCAP = ROOT / "../shared/data/mocap"
STYLES = ("short", "medium", "long")
MODES = ("anisotropic", "off", "isotropic")
FRAME_RATE = 30
MOST_FRAMES = 264
SETTLING = {"clip": "55_01", "freeze": 2, "frames": 8 * FRAME_RATE}  # 2 s of the whirl, then 6 s at rest


def load_clips() -> dict[str, dict]:
    table = tomllib.loads((ROOT / "scripts/clips.toml").read_text())
    return {clip["name"]: clip for clip in table["clip"]}


def frames_of(clip: dict) -> int:
    seconds = (clip["last"] - clip["first"]) / clip["fps"]
    return min(MOST_FRAMES, int(seconds * FRAME_RATE + 1e-6) + 1)


@dataclass(frozen=True)
class Cell:
    style: str
    clip: str
    mode: str
    settling: bool = False

    @property
    def name(self) -> str:
        return f"{self.style}-{self.clip}-{self.mode}" + ("-settling" if self.settling else "")

    def settings(self, clip: dict) -> list[str]:
        motion = {key: clip[key] for key in ("unit", "fps", "lowpass", "earliest", "first")}
        if self.settling:
            motion["freeze"] = SETTLING["freeze"]
        return [
            f"motion.clip={MOCAP / clip['file']}",
            *(f"motion.{key}={value}" for key, value in motion.items()),
            f"schedule.frame_rate={FRAME_RATE}",
            f"schedule.frames={SETTLING['frames'] if self.settling else frames_of(clip)}",
            f"wisps.mode={self.mode}",
        ]


def all_cells(clips: dict[str, dict]) -> list[Cell]:
    cells = [Cell(style, clip, "anisotropic") for clip in clips for style in STYLES]
    cells += [Cell(style, SETTLING["clip"], mode, True) for style in STYLES for mode in MODES]
    return cells + [Cell(style, clip, mode) for clip in clips for mode in MODES[1:] for style in STYLES]


def measure(mane: Path, cell: Cell, clip: dict, out: Path, run_kept: bool) -> dict:
    """Simulates (unless the run is kept) and judges one cell. A cell that does not run says why under "error"."""
    scene, cache, stats = ROOT / f"scenes/{cell.style}.toml", out / f"{cell.name}.mane", out / f"{cell.name}.stats.json"
    settings = [word for setting in cell.settings(clip) for word in ("--set", setting)]
    command = [mane, "simulate", scene, "-o", cache, "--threads", "1", "--stats", stats, *settings]
    if not run_kept:
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode != 0:
            return {"error": f"simulate: {run.stderr.strip()}"}
    judged = subprocess.run([mane, "check", cache, "--json"], capture_output=True, text=True)
    if judged.returncode not in (0, 1):
        return {"error": f"check: {judged.stderr.strip()}"}
    report, statistics = json.loads(judged.stdout), json.loads(stats.read_text())
    criteria = {criterion.pop("name"): criterion for criterion in report["criteria"]}
    kept = ("state_hash", "real_time_ratio")
    return {"passed": report["passed"], "criteria": criteria, **{key: statistics.get(key) for key in kept}}


def identity(cell: Cell, clip: dict) -> list[str]:
    """What a result depends on besides the program."""
    return [(ROOT / f"scenes/{cell.style}.toml").read_text(), *(s for s in cell.settings(clip) if "clip=" not in s)]


def finished(result_file: Path, cell: Cell, clip: dict) -> dict | None:
    if not result_file.exists():
        return None
    result = json.loads(result_file.read_text())
    return result if result["identity"] == identity(cell, clip) else None


def line(cell: Cell, result: dict) -> str:
    if "error" in result:
        return f"{cell.name:34} ERROR {result['error']}"
    failing = [f"{name} {c['value']:.4g} {c['worst']}" for name, c in result["criteria"].items() if c["verdict"] == "fail"]
    return f"{cell.name:34} {'pass' if result['passed'] else 'FAIL'}  {'; '.join(failing)}"


def print_summary(results: dict[Cell, dict]) -> None:
    for mode in MODES:
        of_mode = [r for c, r in results.items() if c.mode == mode and not c.settling and "error" not in r]
        if of_mode:
            passages = fmean(r["criteria"]["passages"]["value"] for r in of_mode)
            print(f"{mode:12} {sum(r['passed'] for r in of_mode)} of {len(of_mode)} pass, {passages:.3f} passages per wisp and second")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mane", type=Path, default=ROOT / "build/release/tools/mane", help="the command")
    parser.add_argument("--out", type=Path, default=ROOT / "out/evidence", help="where runs and their figures are kept")
    parser.add_argument("--only", nargs="+", default=[""], metavar="WORD", help="cells whose name contains one of these")
    parser.add_argument("--fresh", action="store_true", help="run cells again that are done")
    parser.add_argument("--judge", action="store_true", help="judge the kept runs anew, with what `mane check` measures now")
    parser.add_argument("--report", action="store_true", help="run nothing, write the report from what is done")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)

    clips, results = load_clips(), {}
    for cell in all_cells(clips):
        clip, result_file = clips[cell.clip], options.out / f"{cell.name}.json"
        wanted = not options.report and any(word in cell.name for word in options.only)
        result = kept = None if options.fresh and wanted else finished(result_file, cell, clip)
        if wanted and (result is None or options.judge):
            start = time.monotonic()
            result = {"identity": identity(cell, clip), **measure(options.mane, cell, clip, options.out, kept is not None)}
            result["seconds"] = time.monotonic() - start
            result_file.write_text(json.dumps(result, indent=1))
        if result is not None:
            results[cell] = result
            print(line(cell, result), flush=True)
    print_summary(results)
    write_report(ROOT / "docs", clips, results, SETTLING | {"seconds": SETTLING["frames"] // FRAME_RATE})


if __name__ == "__main__":
    main()
