"""Draws error against distance to the limit for the families of tests/hard, in double and in
double-double, from what their test prints.
Usage: test_hard --gtest_filter='*hard_family*' | draw_hard_families.py [FILE.png]"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# where a line of a family has its error: "family NAME distance D conditioned error E double-double E"
PRECISIONS = {"double (roundings of 2^-52)": 6, "double-double (roundings of 2^-104)": 8}


def main():
    families = {}
    for line in sys.stdin:
        words = line.split()
        if len(words) == 9 and words[0] == "family":
            families.setdefault(words[1], []).append(words)
    if not families:
        sys.exit("no line of a family on standard input")
    figure, panels = plt.subplots(1, 2, figsize=(14, 7), sharex=True, sharey=True, layout="constrained")
    colours = plt.get_cmap("tab20").colors
    for panel, (precision, place) in zip(panels, PRECISIONS.items()):
        for i, (name, lines) in enumerate(sorted(families.items())):
            points = sorted((float(words[3]), float(words[place])) for words in lines)
            panel.loglog(
                *zip(*points),
                marker="os^"[i // 20],
                markersize=3,
                linewidth=0.8,
                color=colours[i % 20],
                label=name.replace("_", " "),
            )
        panel.set_title(precision)
        panel.set_xlabel("distance to the limit, or the number that goes there")
        panel.grid(alpha=0.3)
    panels[0].set_ylim(bottom=1e-6)  # short hops end far below it
    panels[0].set_ylabel("error against 50 digits, over the conditioning bound")
    panels[1].legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=7)
    target = sys.argv[1] if len(sys.argv) > 1 else "hard_families.png"
    figure.savefig(target, dpi=120)
    print(target)


main()
