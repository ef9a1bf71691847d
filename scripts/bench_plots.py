#!/usr/bin/env python3
"""Draws docs/images/bench-*.png from the CSV files of `mane bench --csv`. Needs matplotlib.

    scripts/bench_plots.py [bench/results [docs/images]]
"""

import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402

STAGES = ["forces", "wisp detection", "character detection", "velocities", "positions", "other"]
COLOURS = ["#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#bbbbbb"]
FRAME_MS = 1000 / 24


def read(file):
    """The rows of a file, and its first line, which says where and when."""
    with open(file, encoding="utf-8") as lines:
        where = next(lines).lstrip("# ").strip()
        return list(csv.DictReader(lines)), where


def save(figure, where, file):
    figure.text(0.01, 0.01, where, fontsize=6, color="#666666")
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    figure.savefig(file, dpi=150)
    plt.close(figure)
    print(file)


def plot_series(rows, where, file):
    """Time of a frame, and of a wisp in it, against the number of wisps."""
    figure, (whole, each) = plt.subplots(1, 2, figsize=(9, 4))
    curves = {}
    for row in rows:
        width = row["case"].split("/")[1].rsplit("-", 1)[0]
        curves.setdefault((width, int(row["threads"])), []).append((int(row["wisps"]), float(row["frame_ms"])))
    for (width, threads), points in sorted(curves.items(), reverse=True):
        points.sort()
        wisps, ms = zip(*points)
        style = {"marker": "o", "linestyle": "--" if threads == 1 else "-", "color": COLOURS[0 if width == "wide" else 1]}
        label = f"{width}, {threads} thread{'s' if threads > 1 else ''}"
        whole.loglog(wisps, ms, label=label, **style)
        each.semilogx(wisps, [1e3 * m / n for n, m in points], label=label, **style)
    whole.axhline(FRAME_MS, color="#666666", linewidth=0.8)
    whole.annotate("real time at 24 Hz", (0.98, FRAME_MS), xycoords=("axes fraction", "data"), ha="right", va="bottom", fontsize=7, color="#666666")
    whole.set(xlabel="wisps", ylabel="ms per frame")
    each.set(xlabel="wisps", ylabel="µs per wisp and frame", ylim=(0, None))
    whole.legend(fontsize=7, handlelength=4)
    for axis in (whole.xaxis, whole.yaxis, each.xaxis):
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:,g}"))
        axis.set_minor_formatter(NullFormatter())
    save(figure, where, file)


def plot_stages(rows, where, file):
    """How a frame's time is shared among the stages."""
    figure, axis = plt.subplots(figsize=(9, 0.35 * len(rows) + 1.5))
    names = [row["case"].split("/", 1)[1] for row in rows]
    left = [0.0] * len(rows)
    for stage, colour in zip(STAGES, COLOURS):
        share = [100 * float(row[f"stage_ms.{stage}"]) / float(row["frame_ms"]) for row in rows]
        axis.barh(names, share, left=left, color=colour, label=stage)
        left = [a + b for a, b in zip(left, share)]
    for y, row in enumerate(rows):
        axis.text(101, y, f"{float(row['times_real_time']):.3g} × real time", va="center", fontsize=7)
    axis.invert_yaxis()
    axis.set(xlim=(0, 118), xlabel="% of a frame")
    axis.legend(fontsize=7, ncols=len(STAGES), loc="lower center", bbox_to_anchor=(0.5, 1.0))
    save(figure, where, file)


def plot_core(rows, where, file):
    """How many times longer forces, and a step without detection, take than with the first row's instruction set."""
    figure, axis = plt.subplots(figsize=(6, 4))
    names = [row["case"].split("/")[1] for row in rows]
    for offset, (key, label) in enumerate([("stage_ms.forces", "forces"), ("step_ms", "step without detection")]):
        first = float(rows[0][key])
        bars = [(i, float(row[key]) / first) for i, row in enumerate(rows) if row.get(key)]
        places = [i + 0.4 * offset - 0.2 for i, _ in bars]
        drawn = axis.bar(places, [ratio for _, ratio in bars], 0.4, color=COLOURS[offset], label=label)
        axis.bar_label(drawn, [f"{ratio:.3g}" for _, ratio in bars], fontsize=7)
    axis.set_xticks(range(len(names)), names)
    axis.set(yscale="log", ylabel=f"times the time of {names[0]}")
    axis.legend(fontsize=8)
    save(figure, where, file)


def main():
    results = Path(sys.argv[1] if len(sys.argv) > 1 else "bench/results")
    images = Path(sys.argv[2] if len(sys.argv) > 2 else "docs/images")
    images.mkdir(parents=True, exist_ok=True)
    for group, plot, name in [
        ("series", plot_series, "bench-series.png"),
        ("styles", plot_stages, "bench-stages.png"),
        ("core", plot_core, "bench-core.png"),
    ]:
        file = results / f"{group}.csv"
        if file.exists():
            plot(*read(file), images / name)
        else:
            print(f"{file}: missing, {name} is not drawn", file=sys.stderr)


if __name__ == "__main__":
    main()
