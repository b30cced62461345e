"""Draws error against distance to the limit for the families of tests/hard, from what their test
prints. Usage: test_hard --gtest_filter='*hard_family*' | draw_hard_families.py [FILE.png]"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def main():
    families = {}
    for line in sys.stdin:
        words = line.split()
        if len(words) == 7 and words[0] == "family":
            families.setdefault(words[1], []).append((float(words[3]), float(words[6])))
    if not families:
        sys.exit("no line of a family on standard input")
    figure, axes = plt.subplots(figsize=(9, 6), layout="constrained")
    for name, points in sorted(families.items()):
        axes.loglog(*zip(*sorted(points)), marker=".", label=name)
    axes.set_xlabel("distance to the limit, or the number that goes there")
    axes.set_ylabel("error over the conditioning bound (roundings)")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=7)
    target = sys.argv[1] if len(sys.argv) > 1 else "hard_families.png"
    figure.savefig(target, dpi=120)
    print(target)


main()
