"""Draws bench/results/work_precision.jsonl: one picture per model, microseconds per return against
the median error, one line per method. Usage: draw_work_precision.py [RESULTS.jsonl] [FOLDER]"""
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


def draw(model, lines, folder):
    figure, axes = plt.subplots(figsize=(8, 6), layout="constrained")
    for (case, method), rows in sorted(lines.items()):
        rows.sort(key=lambda row: row["error_median"])
        points = [
            (max(row["error_median"], SMALLEST), row["us_per_return"])
            for row in rows
            if math.isfinite(row["error_median"])
        ]
        if points:
            axes.loglog(*zip(*points), marker="o", label=f"{case}, {method}")
    axes.set_xlabel("median error of the state after one return (against 50 digits)")
    axes.set_ylabel("microseconds per return, one core")
    axes.set_title(model)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=7)
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
