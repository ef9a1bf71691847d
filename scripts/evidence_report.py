"""The page and the plots of scripts/evidence.py."""

from pathlib import Path
from statistics import fmean

STYLES = ("short", "medium", "long")
MODES = ("off", "isotropic", "anisotropic")
MODE_NAMES = {"off": "off", "isotropic": "isotropic", "anisotropic": "as in the paper"}
COLOURS = {"off": "#c8c8c8", "isotropic": "#d99a4e", "anisotropic": "#3a6ea5"}

# name of the criterion, heading, format; each has a plot
FIGURES = (
    ("area_mean", "area kept, mean", "{:.3f}"),
    ("area", "area kept, least", "{:.3f}"),
    ("crossings", "crossings per segment", "{:.2f}"),
    ("passages", "passages per wisp and second", "{:.3f}"),
    ("partings", "partings", "{:.2f}"),
    ("partings_last", "partings that last", "{:.2f}"),
    ("tips_range", "tips' range [m]", "{:.2f}"),
)
SETTLING_FIGURES = (
    ("energy_decay", "energy under 1 % after [s]", "{:.2f}"),
    ("energy_falls", "energy, second to second", "{:.2f}"),
    ("rest_speed", "fastest after 3 s [mm/s]", "{:.2f}"),
    ("rest_jitter", "over 10 Hz after 3 s [mm/s]", "{:.3f}"),
)

INTRODUCTION = """# Evidence

Made by `scripts/evidence.py`, not by hand. The scenes of the three styles as they are, on {clips} captured clips (`scripts/clips.toml`), with interactions
between wisps off, isotropic (every contact a dissipative collision), and as in the paper (M41); nothing else differs. Every run is judged by
`mane check`, which measures the figures here from the stored frames with its own geometry ([check.md](check.md)).

- **Area kept**: of all sections over the design's; mean over frames, and the least of any frame. The paper's *volume*.
- **Crossings**: other segments that a segment intersects and that lie across it by more than 30°.
- **Passages**: times per wisp and second that its axis goes through another's that lies across it. Wisps of different orientation stay apart where there are few.
- **Partings**: neighbours are wisps whose outer halves touch in the design; there is a parting where their outer halves intersect nowhere. Given is the share of
  neighbours with a parting, and the share of partings that are there half a second later. If partings came and went by chance, the second would equal the first.
- **Tips' range**: the widest along one of the head's axes, mean over wisps.
"""


def value(result: dict, name: str) -> float | None:
    return None if "error" in result else result["criteria"][name]["value"]


def shown(x: float | None, form: str, scale: float = 1) -> str:
    return "–" if x is None else form.format(x * scale)


def offender(worst: dict | None) -> str:
    return "" if worst is None else ", ".join(f"{key} {worst[key]}" for key in ("wisp", "section", "frame") if key in worst)


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(row) + " |" for row in lines) + "\n"


def means(results: dict) -> str:
    rows = []
    for style in STYLES:
        for mode in MODES:
            cells = [r for c, r in results.items() if (c.style, c.mode, c.settling) == (style, mode, False)]
            known = {name: [v for r in cells if (v := value(r, name)) is not None] for name, _, _ in FIGURES}
            row = [shown(fmean(known[name]) if known[name] else None, form) for name, _, form in FIGURES]
            rows.append([style, MODE_NAMES[mode], str(len(cells)), *row])
    return "## Means over the clips\n\n" + table(["style", "wisps", "cells", *(h for _, h, _ in FIGURES)], rows)


def settling(results: dict, what: dict) -> str:
    rows = []
    for style in STYLES:
        for mode in MODES:
            for cell, r in results.items():
                if (cell.style, cell.mode, cell.settling) == (style, mode, True):
                    figures = [
                        shown(value(r, name), form, 1000 if "mm/s" in heading else 1) for name, heading, form in SETTLING_FIGURES
                    ]
                    rows.append([style, MODE_NAMES[mode], *figures])
    text = (
        "## After the motion stops\n\nThe motion of {clip} stops after {freeze} s; the run goes on to {seconds} s. *Second to second*: the largest "
        "kinetic energy of a second over that of the second before, at worst.\n\n"
    ).format(clip=what["clip"], freeze=what["freeze"], seconds=what["seconds"])
    return text + table(["style", "wisps", *(heading for _, heading, _ in SETTLING_FIGURES)], rows)


def verdicts(results: dict) -> str:
    text, rows = "## What `mane check` says\n\n", []
    for mode in MODES:
        cells = [(c, r) for c, r in results.items() if c.mode == mode and not c.settling]
        passing = sum(r.get("passed", False) for _, r in cells)
        text += f"- {MODE_NAMES[mode]}: {passing} of {len(cells)} cells pass\n"
    for cell, r in results.items():
        name = [cell.style, cell.clip + (", stopped" if cell.settling else ""), MODE_NAMES[cell.mode]]
        if "error" in r:
            rows.append([*name, "does not run", r["error"], "", ""])
            continue
        for criterion, c in r["criteria"].items():
            if c["verdict"] == "fail":
                rows.append([*name, f"`{criterion}`", f"{c['value']:.4g}", f"{c['bound']:g}", offender(c["worst"])])
    head = ["style", "clip", "wisps", "criterion", "value", "bound", "worst"]
    return text + "\nEvery criterion that fails:\n\n" + (table(head, rows) if rows else "none.\n")


def every_cell(clips: dict, results: dict) -> str:
    rows = []
    for clip in clips:
        for style in STYLES:
            for mode in MODES:
                r = next((r for c, r in results.items() if (c.clip, c.style, c.mode, c.settling) == (clip, style, mode, False)), None)
                if r is None or "error" in r:
                    rows.append([clip, style, MODE_NAMES[mode], "not run" if r is None else "error", *["–"] * (len(FIGURES) + 1)])
                    continue
                figures = [shown(value(r, name), form) for name, _, form in FIGURES]
                verdict = "pass" if r["passed"] else "**fail**"
                rows.append([clip, style, MODE_NAMES[mode], verdict, *figures, shown(value(r, "stretch"), "{:.3f}")])
    head = ["clip", "style", "wisps", "check", *(heading for _, heading, _ in FIGURES), "most stretch"]
    return "## Every cell\n\n" + table(head, rows)


def plot(file: Path, clips: dict, results: dict, name: str, heading: str) -> None:
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "mane"  # the same figures make the same file
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(STYLES), figsize=(11, 2.8), sharey=True, layout="constrained")
    for axis, style in zip(axes, STYLES):
        for i, mode in enumerate(MODES):
            of_clip = {c.clip: value(r, name) for c, r in results.items() if (c.style, c.mode, c.settling) == (style, mode, False)}
            heights = [of_clip.get(clip) or 0 for clip in clips]
            axis.bar([x + 0.27 * (i - 1) for x in range(len(clips))], heights, 0.27, color=COLOURS[mode], label=MODE_NAMES[mode])
        axis.set_title(style, fontsize=10)
        axis.set_xticks(range(len(clips)), list(clips), fontsize=7, rotation=45)
        axis.spines[["top", "right"]].set_visible(False)
    axes[0].set_ylabel(heading)
    axes[-1].legend(fontsize=7, frameon=False, loc="upper left", bbox_to_anchor=(1, 1))
    figure.savefig(file, metadata={"Date": None})
    plt.close(figure)


def plots(folder: Path, clips: dict, results: dict) -> str:
    folder.mkdir(parents=True, exist_ok=True)
    for name, heading, _ in FIGURES:
        plot(folder / f"{name}.svg", clips, results, name, heading)
    return "## Plots\n\n" + "\n".join(f"![{heading}]({folder.name}/{name}.svg)" for name, heading, _ in FIGURES) + "\n"


def write_report(docs: Path, clips: dict, results: dict, settling_run: dict) -> None:
    parts = [
        INTRODUCTION.format(clips=len(clips)),
        verdicts(results),
        means(results),
        settling(results, settling_run),
        plots(docs / "evidence", clips, results),
        every_cell(clips, results),
    ]
    (docs / "evidence.md").write_text("\n".join(parts))
