"""What the tests of published figures share: scenes are run small, and what they show is compared with printed
numbers or with closed forms. A paper's file is started as `PAPER.py PROGRAM SOURCE_FOLDER` by test_figures_*.sh, in
an empty folder; its last line is `finish()`."""
import json
import math
import subprocess
import sys

import h5py
import numpy

program, source = sys.argv[1:3]
no_audit = "accuracy.audit_cells=0"
failures = 0


def run(command, scene, *overrides):
    """Answers the scene's question into SCENE.h5 (run) or SCENE.json, SCENE.csv (branch)."""
    arguments = [program, command, f"{source}/configs/scenes/{scene}.toml", *overrides, "-o"]
    arguments += [f"{scene}.h5", "--quiet", "--force"] if command == "run" else [scene]
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)


def near(claim, got, expected, tolerance):
    """Of arrays every element counts; what is not a number fails."""
    global failures
    got, expected = numpy.broadcast_arrays(numpy.asarray(got, float), numpy.asarray(expected, float))
    wrong = ~(abs(got - expected) <= tolerance)
    if got.size == 0 or wrong.any():
        first = int(numpy.argmax(wrong)) if got.size else -1
        values = f"{got.flat[first]!r} instead of {expected.flat[first]!r}" if got.size else "nothing to compare"
        print(f"FAILED: {claim}: {values} within {tolerance} ({wrong.sum()} of {wrong.size})")
        failures += 1


def holds(claim, condition):
    """A condition, or one for each of at least one element."""
    near(claim, numpy.asarray(condition, float), 1.0, 0.0)


def finish():
    sys.exit(1 if failures else 0)


def layers(scene, *names):
    with h5py.File(f"{scene}.h5") as file:
        return [file[name][...] for name in names]


def attractors(scene, *names):
    return layers(scene, *(f"attractors/{name}" for name in names))


def cells_around(axis, value, half_width, cells=1):
    """Overrides that make an axis this narrow: what the scene shows at that value."""
    return (f"grid.axis.{axis}.min={value - half_width!r}", f"grid.axis.{axis}.max={value + half_width!r}",
            f"grid.axis.{axis}.cells={cells}")


def crossing(x, y, level=None):
    """Where y(x), sampled, first crosses x (or a level), by linear interpolation; from the right end."""
    for i in range(len(x) - 1, 0, -1):
        left = y[i - 1] - (x[i - 1] if level is None else level)
        right = y[i] - (x[i] if level is None else level)
        if left * right <= 0 and left != right:
            return x[i - 1] + (x[i] - x[i - 1]) * left / (left - right)
    return math.nan


def bisect(function, low, high):
    """A zero of a scalar function between two places of different sign."""
    rises = function(low) < 0
    for _ in range(200):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        if (function(middle) < 0) == rises:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def different(values, tolerance):
    """How many values there are that are not within a tolerance of their neighbour."""
    ordered = numpy.sort(numpy.asarray(values).ravel())
    return 1 + int((numpy.diff(ordered) > tolerance).sum())


def special(scene, kind, variable, period=1):
    """Values of the variable at the special points of that kind on branches of that period, rising."""
    with open(f"{scene}.json") as file:
        branches = json.load(file)["branches"]
    return sorted(point[variable] for branch in branches if branch["period"] == period
                  for point in branch["special"] if point["kind"] == kind)


def curve_points(scene, kind=None):
    """(kind, first parameter, second parameter) of the points of a scene's bifurcation curves."""
    with open(f"{scene}_curves.csv") as file:
        rows = [line.split(",") for line in file][1:]
    return [(row[1], float(row[3]), float(row[4])) for row in rows if kind in (None, row[1])]


def on_curve(points, second):
    """First parameter where a curve (its points in order of the second) has that second one."""
    points = sorted((p[2], p[1]) for p in points)
    return float(numpy.interp(second, [p[0] for p in points], [p[1] for p in points]))
