"""Times mane and its peers on the same grooms and motion, taking turns (README.md)."""

import argparse
import csv
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from grooms import FRAME_RATE, GROOMS, write_scene
from quality import measure
from scene import read_run

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
# How each is started: its worker and its variant. mane is a program of its own.
SYSTEMS = {
    "mane": None,
    "blender": ("blender_hair.py", ""),
    "blender-grid": ("blender_hair.py", "grid"),
    "newton-xpbd": ("newton_hair.py", "xpbd"),
    "newton-vbd": ("newton_hair.py", "vbd"),
}
SET_UP_LIMIT = 600  # [s] beyond the limit on stepping


@dataclass
class Sample:
    """One run: mean time per frame, and where the hair went."""

    milliseconds: float
    megabytes: float
    lines: np.ndarray
    note: str = ""


@dataclass
class Series:
    """All runs of a system on a groom."""

    groom: str
    system: str
    milliseconds: list = field(default_factory=list)
    quality: dict = field(default_factory=dict)
    megabytes: float = 0
    note: str = ""
    over: bool = False  # no more runs: it failed, or takes too long


class Failure(Exception):
    """A peer that could not run, and why."""


def run_child(command):
    """Runs a program to its end; the most memory that it had [MB]."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise subprocess.CalledProcessError(child.returncode, command)
    return usage.ru_maxrss / 1024


def run_mane(arguments, groom, folder):
    """mane's sample, and the scene for the others."""
    scene_file = write_scene(groom, folder, arguments.frames)
    cache, stats = folder / "run.mane", folder / "stats.json"
    megabytes = run_child([arguments.mane, "simulate", scene_file, "-o", cache, "--rates", "default", "--threads", "2",
                           "--stats", stats])
    report = json.loads(stats.read_text())
    scene, lines = read_run(cache, groom.points)
    frames = report["simulated_seconds"] * FRAME_RATE
    seconds = report["wall_seconds"] - report["writing_seconds"]
    note = f"{report['intersections_per_segment']:.0f} intersections per segment, {report['instruction_set']}"
    return Sample(1000 * seconds / frames, megabytes, lines, note), scene


def run_peer(arguments, system, scene_file, folder):
    worker, variant = SYSTEMS[system]
    result = folder / f"{system}.npz"
    result.unlink(missing_ok=True)
    log = folder / f"{system}.log"
    memory = int(arguments.memory * 2**30)
    with open(log, "w") as out:
        try:
            code = subprocess.run(
                [sys.executable, HERE / worker, scene_file, result, "--limit", str(arguments.limit),
                 "--variant", variant], stdout=out, stderr=subprocess.STDOUT,
                timeout=arguments.limit + SET_UP_LIMIT,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))).returncode
        except subprocess.TimeoutExpired:
            raise Failure(f"not a frame within {arguments.limit + SET_UP_LIMIT:.0f} s, set-up included") from None
    if code != 0:
        lines = log.read_text(errors="replace").strip().splitlines()
        raise Failure(f"exit code {code}: {lines[-1] if lines else 'no output'}")
    with np.load(result) as found:
        seconds, lines = found["seconds"], found["lines"]
        # The first frame loads code and allocates; where there is no other, it is all there is.
        counted = seconds[1:] if len(seconds) > 1 else seconds
        note = "" if len(lines) == arguments.frames else f"stopped after {len(seconds)} frames, over {arguments.limit:.0f} s"
        return Sample(1000 * float(counted.mean()), float(found["resident"]) / 2**20, lines, note)


def add(series, sample, scene):
    if not series.milliseconds:
        series.quality = measure(scene, sample.lines)
        series.megabytes, series.note = sample.megabytes, sample.note
    series.milliseconds.append(sample.milliseconds)


def run_groom(arguments, groom, results, folder):
    """One turn: mane, then each peer."""
    def of(system):
        return results.setdefault((groom.name, system), Series(groom.name, system))

    sample, scene = run_mane(arguments, groom, folder)
    add(of("mane"), sample, scene)
    scene_file = folder / "scene.npz"
    scene.save(scene_file)
    for system in arguments.peers:
        series = of(system)
        if series.over:
            continue
        try:
            sample = run_peer(arguments, system, scene_file, folder)
            add(series, sample, scene)
            series.over = bool(sample.note)
        except Failure as failure:
            series.note, series.over = str(failure), True
        print(f"  {groom.name} {system}: {series.milliseconds[-1]:.1f} ms" if series.milliseconds else
              f"  {groom.name} {system}: {series.note}", flush=True)


def row(series, mane):
    """A line of the table; times relative to mane's are medians of pairs of the same turn."""
    q, times = series.quality, series.milliseconds
    made = {"groom": series.groom, "system": series.system, "runs": len(times)}
    if times:
        made |= {"ms_per_frame": f"{statistics.median(times):.2f}", "ms_least": f"{min(times):.2f}",
                 "ms_most": f"{max(times):.2f}",
                 "times_mane": f"{statistics.median(t / m for t, m in zip(times, mane.milliseconds)):.1f}",
                 "stretch_max": f"{q['stretch_max']:.4f}", "stretch_mean": f"{q['stretch_mean']:.5f}",
                 "deepest_mm": f"{1000 * q['deepest']:.2f}", "share_inside": f"{q['share_inside']:.5f}",
                 "lost": q["lost"], "resident_mb": f"{series.megabytes:.0f}"}
    return made | {"note": series.note}


COLUMNS = ["groom", "system", "runs", "ms_per_frame", "ms_least", "ms_most", "times_mane", "stretch_max", "stretch_mean",
           "deepest_mm", "share_inside", "lost", "resident_mb", "note"]


def write_results(arguments, results):
    rows = [row(series, results[series.groom, "mane"]) for series in results.values()]
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    with open(arguments.output, "w", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    widths = [max(len(c), *(len(str(r.get(c, ""))) for r in rows)) for c in COLUMNS]
    for r in [{c: c for c in COLUMNS}, *rows]:
        print("  ".join(str(r.get(c, "")).ljust(w) for c, w in zip(COLUMNS, widths)).rstrip())


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=5, help="turns, of which medians are taken")
    parser.add_argument("--frames", type=int, default=48, help="frames of 1/24 s")
    parser.add_argument("--only", nargs="+", default=[], metavar="NAME", help="grooms (200x5 …) and systems (blender …)")
    parser.add_argument("--limit", type=float, default=600, help="seconds of stepping that a run may take")
    parser.add_argument("--memory", type=float, default=12, help="GB that a peer may take")
    parser.add_argument("--mane", type=Path, default=PROJECT / "build/release/tools/mane")
    parser.add_argument("--output", type=Path, default=PROJECT / "bench/results/peers.csv")
    arguments = parser.parse_args()
    grooms, peers = {g.name: g for g in GROOMS}, [s for s in SYSTEMS if s != "mane"]
    unknown = [name for name in arguments.only if name not in grooms and name not in SYSTEMS]
    if unknown:
        parser.error(f"found {unknown[0]}, expected some of {', '.join([*grooms, *SYSTEMS])}")
    arguments.grooms = [g for g in GROOMS if g.name in arguments.only] or GROOMS
    arguments.peers = [p for p in peers if p in arguments.only] or ([] if "mane" in arguments.only else peers)
    return arguments


def main():
    arguments, results = parse(), {}
    with tempfile.TemporaryDirectory() as folder:
        for turn in range(arguments.runs):
            print(f"turn {turn + 1} of {arguments.runs}", flush=True)
            for groom in arguments.grooms:
                run_groom(arguments, groom, results, Path(folder))
    write_results(arguments, results)


if __name__ == "__main__":
    main()
