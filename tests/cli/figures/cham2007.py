"""Figures of Cham and Cutkosky (2007), the clock-driven hopper, against printed numbers and a stride written from the
closed forms of its page."""
import json
import math

import h5py
import numpy

import clocked_hopper
from checks import cells_around, different, finish, holds, layers, near, no_audit, run, special

long_thrust, short_thrust = (1.55, 0.08), (3.8, 0.02)  # thrust over weight, thrust time
long_folds, short_flips = (0.24865, 0.27511), (0.1235, 0.1560)


def branches():
    # one unit of the last printed digit
    run("branch", "cham2007_fig5_branch")
    near("long thrust: the folds", special("cham2007_fig5_branch", "fold", "stride_period"), long_folds, 5e-6)
    run("branch", "cham2007_fig6_branch", "question.doublings=0")
    flips = special("cham2007_fig6_branch", "flip", "stride_period")
    near("short thrust: period 2 begins and ends", flips[:2], short_flips, 5e-5)
    near("short thrust: thrust-off meets take-off",
         special("cham2007_fig6_branch", "border collision", "stride_period")[-1], 0.3472, 5e-5)
    near("short thrust: the branch turns back",
         special("cham2007_fig6_branch", "fold", "stride_period")[0], 0.2793, 5e-5)
    with open("cham2007_fig6_branch.csv") as file:
        names = file.readline().strip().split(",")
        rows = [dict(zip(names, line.strip().split(","))) for line in file]
    unstable = [float(row["stride_period"]) for row in rows if row["stable"] == "0" and row["period"] == "1"]
    holds("the unstable part between the flips is drawn", any(0.13 < period < 0.15 for period in unstable))


def settled_states():
    """Figs. 5 and 6: states after 1000 strides lie on orbits of the closed forms, as many as the page says."""
    run("run", "cham2007_fig5", no_audit, "grid.axis.0.cells=75", "grid.axis.1.cells=16")
    period, height, velocity = layers("cham2007_fig5", "stride_period", "height", "last_velocity")
    far = 0.0
    for tau, y, v in zip(period, height * 900, velocity * 30):
        if min(abs(tau - fold) for fold in long_folds) < 2e-3:
            continue  # next to a fold orbits settle slowly
        for i in (0, 5, 10, 15):
            image = clocked_hopper.stride(y[i], v[i], *long_thrust, tau)
            far = max(far, abs(image[0] - y[i]) + abs(image[1] - v[i]))
        n = different(y, 1e-4)
        if not long_folds[0] - 2e-3 < tau < long_folds[1] + 2e-3:
            holds(f"one state at {tau:.4g} s", n == 1)
        elif long_folds[0] + 5e-3 < tau < long_folds[1] - 2e-3:
            holds(f"two states at {tau:.4g} s", n == 2)
    near("Fig. 5: states are the closed forms' own orbits", far, 0, 1e-6)

    # short thrust: hops over one stride, from 123.5 to 156.0 ms over two; beside them hops that take two strides, which
    # the figure does not show
    run("run", "cham2007_fig6", no_audit, "grid.axis.0.cells=75", "grid.axis.1.cells=16")
    period, height, velocity = layers("cham2007_fig6", "stride_period", "height", "last_velocity")
    far, point, counts = 0.0, (-0.2, -0.9), [0, 0]
    for tau, y, v in zip(period, height * 900, velocity * 30):
        if tau > 0.275 or tau < 0.1:
            continue
        point, _ = clocked_hopper.periodic_point(point, *short_thrust, tau)
        if min(abs(tau - flip) for flip in short_flips) < 3e-3:
            continue
        for i in (1, 6, 11):
            once = clocked_hopper.stride(y[i], v[i], *short_thrust, tau)
            again = clocked_hopper.stride(*once[:2], *short_thrust, tau)
            far = max(far, min(abs(image[0] - y[i]) + abs(image[1] - v[i]) for image in (once, again)))
        distance = numpy.hypot(y - point[0], v - point[1])
        if short_flips[0] < tau < short_flips[1]:
            holds(f"no state on the unstable orbit at {tau:.4g} s", distance > 1e-2)
            counts[0] += 1
        else:
            holds(f"states on the orbit of one stride at {tau:.4g} s", (distance < 1e-6).any())
            counts[1] += 1
    near("Fig. 6: states are the closed forms' own orbits", far, 0, 1e-6)
    holds("both kinds of stride periods were met", counts[0] > 4 and counts[1] > 20)

    run("run", "cham2007_fig5_orbits", "grid.axis.0.cells=121", "grid.axis.1.cells=2")
    period, height = layers("cham2007_fig5_orbits", "stride_period", "height")
    apart = period[abs(height[:, 0, -1] - height[:, 1, -1]) * 900 > 0.1]
    spacing = period[1] - period[0]
    near("sweeps part at the lower fold", apart.min(), long_folds[0] + spacing / 2, spacing / 2 + 1e-4)
    near("and join at the upper one", apart.max(), long_folds[1] - spacing / 2, spacing / 2 + 1e-4)


def vector_field(scene, cells):
    run("run", scene, no_audit, f"grid.axis.0.cells={cells}", f"grid.axis.1.cells={cells}")
    y, v, to_y, to_v = layers(scene, "height", "velocity", "last_height", "last_velocity")
    return y * 900, v * 30, to_y * 900, to_v * 30


def winding(field, centre, half_width):
    """Turns of P(x) - x along the cells of a square around a point: +1 at sinks and sources, -1 at saddles."""
    y, v, to_y, to_v = field
    i, k = numpy.argmin(abs(y - centre[0])), numpy.argmin(abs(v - centre[1]))
    n = half_width
    ring = ([(i + n, k + j) for j in range(-n, n)] + [(i - j, k + n) for j in range(-n, n)] +
            [(i - n, k - j) for j in range(-n, n)] + [(i + j, k - n) for j in range(-n, n)])
    angles = numpy.unwrap([math.atan2(to_v[c] - v[c[1]], to_y[c] - y[c[0]]) for c in ring + ring[:1]])
    return (angles[-1] - angles[0]) / (2 * math.pi)


def grid_jacobian(field, centre):
    y, v, to_y, to_v = field
    i, k = numpy.argmin(abs(y - centre[0])), numpy.argmin(abs(v - centre[1]))
    h, u = y[i + 1] - y[i - 1], v[k + 1] - v[k - 1]
    return numpy.array([[(to_y[i + 1, k] - to_y[i - 1, k]) / h, (to_y[i, k + 1] - to_y[i, k - 1]) / u],
                        [(to_v[i + 1, k] - to_v[i - 1, k]) / h, (to_v[i, k + 1] - to_v[i, k - 1]) / u]])


def maps():
    """Figs. 8 and 10: every 23rd row and column against the stride in closed form, indices, multipliers."""
    for scene, thrust, tau, orbits in (
            ("cham2007_fig8", long_thrust, 0.26, (((-2.448, -0.725), 1), ((-1.705, 0.931), -1), ((-0.677, 0.265), 1))),
            ("cham2007_fig10", short_thrust, 0.15, (((-1.3675, -0.6939), 1),))):
        field = vector_field(scene, 256)
        y, v, to_y, to_v = field
        far = 0.0
        for i in range(3, 256, 23):
            for k in range(3, 256, 23):
                expected = clocked_hopper.stride(y[i], v[k], *thrust, tau)
                far = max(far, abs(expected[0] - to_y[i, k]) + abs(expected[1] - to_v[i, k]))
        near(f"{scene}: one stride of the closed forms", far, 0, 1e-9)
        for point, index in orbits:
            near(f"{scene}: index of the orbit at {point}", winding(field, point, 6), index, 1e-9)
    # multipliers by differences of a window of three by three cells
    for scene, point, expected in (("cham2007_fig8", (-1.70526775, 0.93098952), (1.536, 0.126)),
                                   ("cham2007_fig10", (-1.36752609, -0.69385551), (-0.307, -1.014))):
        run("run", scene, no_audit, *cells_around(0, point[0] / 900, 3e-6, 3), *cells_around(1, point[1] / 30, 1e-4, 3))
        y, v, to_y, to_v = layers(scene, "height", "velocity", "last_height", "last_velocity")
        jacobian = grid_jacobian((y * 900, v * 30, to_y * 900, to_v * 30), point)
        near(f"{scene}: multipliers", [m.real for m in clocked_hopper.multipliers(jacobian)], expected, 6e-4)


def basins():
    run("run", "cham2007_fig8_basins", no_audit, "grid.axis.0.cells=100", "grid.axis.1.cells=100")
    with h5py.File("cham2007_fig8_basins.h5") as file:
        shares = sorted(file["attractors/share"][...])
    holds("two hops share the window", len(shares) == 2)
    near("hop-settle-fire has 53 % of it", shares[-1], 0.53, 0.01)

    # the same share over the stride period: 21, 53, 67 % (2000 samples: 1.1 %); it is the last label, the right-most
    run("run", "cham2007_stride_sweep", no_audit, "grid.axis.0.cells=64", "grid.axis.1.cells=64",
        "sweep.axis.0.min=0.25", "sweep.axis.0.max=0.27", "sweep.axis.0.points=3", "sweep.axis.1.values=[0.2]")
    with open("cham2007_stride_sweep.json") as file:
        maps_of_sweep = json.load(file)["maps"]
    shares = [one["basins"][-1]["share"] for one in maps_of_sweep]
    near("hop-settle-fire's share of each map", shares, (0.21, 0.53, 0.67), 0.02)

    # around each flip, from a start next to the orbit there
    for flip, guess, twice_above in ((short_flips[0], (-0.5, -1.2), True), (short_flips[1], (-1.6, -0.6), False)):
        point, _ = clocked_hopper.periodic_point(guess, *short_thrust, flip)
        run("run", "cham2007_periods", no_audit, *cells_around(0, flip, 16e-3, 66), *cells_around(1, 0.02, 1e-9),
            f"start.height={(point[0] + 0.02) / 900!r}", f"start.velocity={point[1] / 30!r}")
        tau, period = layers("cham2007_periods", "stride_period", "period")
        clear = abs(tau - flip) > 4e-3  # next to it orbits settle slowly
        near(f"the flip at {flip} s", period[clear, 0], numpy.where((tau > flip) == twice_above, 2, 1)[clear], 0)


def exponents():
    run("run", "cham2007_chaos", no_audit, "grid.axis.0.cells=30", "grid.axis.1.cells=30")
    tau, thrust, first, second, rate = layers("cham2007_chaos", "stride_period", "thrust", "lyapunov", "lyapunov_2",
                                              "lyapunov_rate")
    total = (first + second) / tau[:, None]
    holds("both exponents sum to the damping of the time on the ground", (total <= 1e-9) & (total >= -12 - 1e-9))
    on_ground = abs(total + 12) < 1e-6
    near("without hops the exponent is -zeta w", rate[on_ground], -6, 0.05)
    # such an orbit exists where the linear one stays below the rest length
    exists = []
    for i, k in zip(*numpy.nonzero(on_ground)):
        x = numpy.zeros(2)
        for _ in range(int(2 / tau[i])):
            highest = -1e9
            t_on, t = 30 * 0.02, 30 * tau[i]
            middle = clocked_hopper.on_ground(*x, thrust[k], t_on)
            for s in numpy.linspace(0, 1, 40):
                highest = max(highest, clocked_hopper.on_ground(*x, thrust[k], t_on * s)[0],
                              clocked_hopper.on_ground(*middle, 0.0, (t - t_on) * s)[0])
            x = clocked_hopper.on_ground(*middle, 0.0, t - t_on)
        exists.append(highest <= 1e-6)
    holds("and the linear orbit there stays on the ground", exists)
    holds("in enough cells", len(exists) > 60)
    run("run", "cham2007_chaos", no_audit, *cells_around(0, 0.09, 0.01, 5), *cells_around(1, 6.5, 1e-9))
    near("high stride rates: about 5 per second", layers("cham2007_chaos", "lyapunov_rate")[0], 5, 1.5)

    run("run", "cham2007_two_motions", no_audit, "grid.axis.0.cells=24", "grid.axis.1.cells=24")
    height, velocity, rate = layers("cham2007_two_motions", "height", "velocity", "lyapunov_rate")
    near("chaos of 3.6 per second", rate[rate > 0], 3.6, 0.35)
    i, k = numpy.argwhere(rate <= 0)[0]
    x = (height[i] * 900, velocity[k] * 30)
    for _ in range(300):
        x = clocked_hopper.stride(*x, 1.55, 0.2, 0.24)[:2]
    _, jacobian = clocked_hopper.periodic_point(x, 1.55, 0.2, 0.24)
    regular = math.log(max(abs(m) for m in clocked_hopper.multipliers(jacobian))) / 0.24
    near("beside the regular hop of the closed forms", rate[rate <= 0], regular, 0.02)
    holds("both from many starts", 40 < (rate > 0).sum() < rate.size - 40)


branches()
settled_states()
maps()
basins()
exponents()
finish()
