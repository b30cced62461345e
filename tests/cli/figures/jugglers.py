"""Figures and scenes of jugglers: Rizzi and Koditschek (1994), Schaal and Atkeson (1993), Shannon's juggler, against
the closed forms of their pages."""
import math

import numpy

import bouncing_ball
import planar_juggler
from checks import attractors, curve_points, finish, holds, layers, near, no_audit, run, special


def mirror_laws():
    # a = (1 + restitution) (kappa0 + 1 + kappa1 g b*) - 1 doubles at 2, its cycle at sqrt 5
    run("branch", "rizzi1994_line_branch", "question.doublings=1")
    near("the line juggler's apex doubles", special("rizzi1994_line_branch", "flip", "energy_gain")[0],
         1 / 8.58375, 1e-10)
    near("its 2-cycle doubles", special("rizzi1994_line_branch", "flip", "energy_gain", 2)[0],
         (math.sqrt(5) - 1) / 8.58375, 1e-10)
    run("run", "rizzi1994_line", no_audit, "grid.axis.0.cells=100", "grid.axis.1.cells=24",
        "output.layers=['period', 'label']")
    gain, height, period = layers("rizzi1994_line", "energy_gain", "apex_height", "period")
    inner = period[:, 4:12]
    below = gain < 1 / 8.58375
    doubled = (gain > 1 / 8.58375) & (gain < (math.sqrt(5) - 1) / 8.58375)
    holds("the target height attracts until a = 2", inner[below] == 1)
    holds("then a 2-cycle until a = sqrt 5", inner[doubled] == 2)

    # the vertical period is 2 sqrt(2 b / g); k11 = T/2 k10 and k11 = T/4 of that period bound the triangle
    run("branch", "rizzi1994_gains_curves")
    flight = 2 * math.sqrt(2 * 0.5 / 9.81)
    points = curve_points("rizzi1994_gains_curves")
    near("the triangle's oblique side", [gain - flight / 2 * other for kind, gain, other in points
                                         if kind == "neimark-sacker"], 0, 1e-9)
    near("the triangle's upright side", [gain for kind, gain, _ in points if kind == "flip"], flight / 4, 1e-9)

    # all cells of the planar map against the explicit map of the page
    run("run", "rizzi1994_planar_basin", no_audit, "grid.axis.0.cells=120", "grid.axis.1.cells=120")
    bx, vx, cycles = layers("rizzi1994_planar_basin", "bx", "vx", "returns")
    expected = planar_juggler.cycles(bx[:, None], 0.5, vx[None, :], 200)
    holds("completed cycles are the explicit map's", cycles == expected)
    holds("some starts stay and some are lost", (cycles == 200).any() and (cycles == 0).any())

    # spatial: mirror images in the plane of the target; in that plane the planar juggler
    run("run", "rizzi1994_spatial_basin", no_audit, "grid.axis.0.cells=61", "grid.axis.1.cells=60")
    vy, vx, cycles = layers("rizzi1994_spatial_basin", "vy", "vx", "returns")
    near("the middle row moves in the plane of the target", vy[30], 0, 1e-15)
    holds("mirror images last as long", cycles == cycles[::-1])
    holds("in the plane the planar juggler", cycles[30] == planar_juggler.cycles(0.5, 0.5, vx, 200))


def paddle():
    # e = 1/2: w = pi m / 3, D = 2 (1 + e^2) / (1 + e)^2 = 10 / 9
    run("branch", "schaal1993_branch", "question.doublings=0")
    folds = special("schaal1993_branch", "fold", "amplitude")
    flips = special("schaal1993_branch", "flip", "amplitude")
    for m in (1, 2):
        w = math.pi * m / 3
        near(f"saddle-node of {m} periods", min(folds, key=lambda f, w=w: abs(f - w)), w, 1e-9)
        near(f"period doubling of {m} periods",
             min(flips, key=lambda f, w=w: abs(f - math.hypot(w, 10 / 9))), math.hypot(w, 10 / 9), 1e-9)
    run("branch", "schaal1993_curves")
    points = curve_points("schaal1993_curves")
    def distance(kind, amplitude, e):  # to the nearer of the curves of one and of two periods
        edges = [math.pi * m * (1 - e) / (1 + e) for m in (1, 2)]
        if kind == "flip":
            edges = [math.hypot(w, 2 * (1 + e * e) / (1 + e) ** 2) for w in edges]
        return min(abs(amplitude - edge) for edge in edges)
    near("points of the curves lie on the closed forms", [distance(*point) for point in points], 0, 1e-8)
    holds("both curves were drawn", {kind for kind, _, _ in points} >= {"fold", "flip"})

    run("run", "schaal1993_lyapunov", no_audit, "grid.axis.0.cells=40", "grid.axis.1.cells=40")
    amplitude, e, first, second = layers("schaal1993_lyapunov", "amplitude", "restitution", "lyapunov", "lyapunov_2")
    finite = numpy.isfinite(first) & numpy.isfinite(second)
    both = (first + second)[finite]
    # e^2n U_0 / U_n: speeds within a factor of e^3 of each other over at least 1000 impacts
    near("exponents sum to 2 ln e", both, numpy.broadcast_to(2 * numpy.log(e), first.shape)[finite], 3e-3)
    with numpy.errstate(invalid="ignore"):
        pair = finite & (abs(first - second) < 1e-3)
    near("where multipliers are a pair both are ln e", first[pair],
         numpy.broadcast_to(numpy.log(e), first.shape)[pair], 3e-3)
    holds("a caught ball's exponent is minus infinity, some balls are", numpy.isneginf(first).any())
    holds("chaos, pairs and finite exponents in plenty", (first[finite] > 0.1).sum() > 50 and pair.sum() > 50)

    # restitution 0: caught every period up to sqrt(pi^2 + 1), bouncing to 3.85685, then every second one
    run("run", "shannon_juggler", no_audit, "grid.axis.0.cells=160", "grid.axis.1.cells=12")
    amplitude, label = layers("shannon_juggler", "amplitude", "label")
    label_of = {name.decode(): value for value, name in zip(*attractors("shannon_juggler", "label", "name"))}
    low, high = math.sqrt(math.pi ** 2 + 1), 3.85685
    holds("caught once a period below the range", label[amplitude < low] == label_of["stick 1"])
    holds("bouncing within it", label[(amplitude > low) & (amplitude < high)] == 0)
    holds("caught every second period above", label[amplitude > high] == label_of["stick 2"])

    run("run", "paddle_sticking", no_audit, "grid.axis.0.cells=9", "grid.axis.1.cells=9")
    phase, speed, label = layers("paddle_sticking", "phase", "relative_velocity", "label")
    names = dict(zip(*attractors("paddle_sticking", "label", "name")))
    release = math.asin(1 / 1.7)
    n, time = bouncing_ball.caught_after(release, 0.0, 1.7, 0.5, 1000)
    # it rides from where it is caught to the next release
    periods = math.ceil(time / (2 * math.pi))
    stick = f"stick {periods}".encode()
    caught = [[bouncing_ball.caught_after(theta, u, 1.7, 0.5, 300) is not None for u in speed] for theta in phase]
    near("who is caught", [[names.get(value) == stick for value in row] for row in label], caught, 0)
    holds("some are and some are not", 0 < numpy.sum(caught) < label.size)


mirror_laws()
paddle()
finish()
