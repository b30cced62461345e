"""Draws bench/results/work_precision.jsonl, one picture per model. Above: cells per second of whole orbits against
the share of wrong answers; below: microseconds of one return against errors of state and time, wrong outcomes and
drift of what is conserved. One line per method. Usage: draw_work_precision.py [RESULTS.jsonl] [FOLDER]"""
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

SMALLEST = 1e-33  # errors of zero are drawn here

CELLS = [
    ("wrong_boundary", "wrong answers, cells 1e-15 to 1e-1 of an axis from boundaries"),
    ("wrong_grid", "wrong answers, cells of the whole grid"),
]
RETURNS = [
    ("error_median", "median error of the state after one return"),
    ("time_error_median", "median error of the return's time"),
    ("wrong_share", "share of wrong outcomes of one return"),
    ("drift_worst", "largest drift of what a return conserves"),
]
SHARES = {"wrong_boundary", "wrong_grid", "wrong_share"}
STYLES = {  # colour and marker of each method; cases differ by their lines
    "avx512": ("tab:red", "o"),
    "avx2": ("tab:orange", "s"),
    "scalar": ("tab:olive", "^"),
    "float32": ("black", ""),
    "double-double": ("tab:green", "D"),
    "Boost.odeint dopri5 dense output + bisection": ("tab:blue", "x"),
    "SUNDIALS CVODE Adams + rootfinding": ("tab:purple", "+"),
}
LINES = ["-", "--", ":", "-."]


def read(path):
    """{model: {speed's name: {(case, method): rows}}}"""
    models = {}
    for text in path.read_text().splitlines():
        row = json.loads(text)
        if row.get("benchmark") != "work_precision":
            continue
        speed = "cells_per_second" if "cells_per_second" in row else "us_per_return"
        kinds = models.setdefault(row["model"], {})
        kinds.setdefault(speed, {}).setdefault((row["case"], row["method"]), []).append(row)
    return models


def shown_panels(panels, lines):
    return [
        panel
        for panel in panels
        if any(row.get(panel[0]) is not None for rows in lines.values() for row in rows)
    ]


def points_of(rows, key, speed):
    return [
        (row[key] if key in SHARES else max(row[key], SMALLEST), row[speed])
        for row in sorted(rows, key=lambda row: row.get("tolerance") or 0.0)
        if row.get(speed) is not None
    ]


def draw_row(all_axes, panels, lines, speed):
    cases = sorted({case for case, _ in lines})
    for axes, (key, title) in zip(all_axes, panels):
        for (case, method), rows in sorted(lines.items()):
            colour, marker = STYLES.get(method, ("grey", "."))
            line = LINES[cases.index(case) % len(LINES)]
            known = [row for row in rows if row.get(key) is not None and math.isfinite(row[key])]
            points = points_of(known, key, speed)
            label = f"{case}: {method}"
            if points:
                axes.plot(*zip(*points), color=colour, marker=marker, ls=line, ms=5, lw=1, label=label)
            elif known:  # its speed is not known
                axes.axvline(known[0][key], ls=line, color=colour, lw=1, label=label + " (no speed)")
        axes.set_yscale("log")
        if key in SHARES:
            axes.set_xlim(left=-0.02, right=max(0.1, axes.get_xlim()[1]))
        else:
            axes.set_xscale("log")
        axes.set_xlabel(title, fontsize=8)
        axes.grid(alpha=0.3)
    label = "cells per second" if speed == "cells_per_second" else "microseconds per return"
    all_axes[0].set_ylabel(label + ", one core")
    handles = {}
    for axes in all_axes[: len(panels)]:
        handles.update({text: handle for handle, text in zip(*axes.get_legend_handles_labels())})
    all_axes[-1].axis("off")
    all_axes[-1].legend(handles.values(), handles.keys(), fontsize=7, loc="center left")
    for axes in all_axes[len(panels) : -1]:
        axes.axis("off")


def draw(model, kinds, folder):
    rows = [
        (speed, shown_panels(panels, kinds[speed]))
        for speed, panels in (("cells_per_second", CELLS), ("us_per_return", RETURNS))
        if speed in kinds
    ]
    n_columns = 1 + max(len(panels) for _, panels in rows)  # the last holds the legend
    figure, all_axes = plt.subplots(
        len(rows), n_columns, figsize=(4.5 * n_columns, 4.5 * len(rows)), layout="constrained", squeeze=False
    )
    for axes, (speed, panels) in zip(all_axes, rows):
        draw_row(axes, panels, kinds[speed], speed)
    figure.suptitle(model)
    target = folder / f"work_precision_{model}.png"
    figure.savefig(target, dpi=100)
    plt.close(figure)
    print(target)


def main():
    here = pathlib.Path(__file__).parent
    source = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "results/work_precision.jsonl"
    folder = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else pathlib.Path(".")
    for model, kinds in sorted(read(source).items()):
        draw(model, kinds, folder)


main()
