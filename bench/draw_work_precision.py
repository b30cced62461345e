"""Draws bench/results/work_precision.jsonl: one picture per model, microseconds per return against
errors of state and time, wrong outcomes and drift, one line per method. Usage: draw_work_precision.py [RESULTS.jsonl] [FOLDER]"""
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

SMALLEST = 1e-33  # errors of zero are drawn here


def read(path):
    cases = {}
    for line in path.read_text().splitlines():
        row = json.loads(line)
        if row.get("benchmark") != "work_precision" or row.get("error_median") is None:
            continue
        cases.setdefault(row["model"], {}).setdefault((row["case"], row["method"]), []).append(row)
    return cases


PANELS = [
    ("error_median", "median error of the state after one return"),
    ("time_error_median", "median error of the return's time"),
    ("wrong_share", "share of wrong outcomes"),
    ("drift_worst", "largest drift of what is conserved"),
]


def draw(model, lines, folder):
    shown = [
        panel
        for panel in PANELS
        if any(row.get(panel[0]) is not None for rows in lines.values() for row in rows)
    ]
    figure, all_axes = plt.subplots(
        1, len(shown), figsize=(6 * len(shown), 6), layout="constrained", sharey=True, squeeze=False
    )
    for axes, (key, title) in zip(all_axes[0], shown):
        for (case, method), rows in sorted(lines.items()):
            points = sorted(
                (row[key] if key == "wrong_share" else max(row[key], SMALLEST), row["us_per_return"])
                for row in rows
                if row.get(key) is not None and math.isfinite(row[key])
            )
            if points:
                axes.plot(*zip(*points), marker="o", label=f"{case}, {method}")
        axes.set_yscale("log")
        if key != "wrong_share":
            axes.set_xscale("log")
        axes.set_xlabel(title)
        axes.grid(alpha=0.3)
    all_axes[0][0].set_ylabel("microseconds per return, one core")
    all_axes[0][0].legend(fontsize=7)
    figure.suptitle(model)
    target = folder / f"work_precision_{model}.png"
    figure.savefig(target, dpi=120)
    plt.close(figure)
    print(target)


def main():
    here = pathlib.Path(__file__).parent
    source = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "results/work_precision.jsonl"
    folder = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else pathlib.Path(".")
    for model, lines in sorted(read(source).items()):
        draw(model, lines, folder)


main()
