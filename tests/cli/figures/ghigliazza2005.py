"""Figures of Ghigliazza, Altendorfer, Holmes and Koditschek (2005), the spring-mass runner, without gravity in stance:
against the closed forms of its page; branches against its reproduced numbers."""
import math

import numpy

from checks import different, finish, holds, layers, near, no_audit, run, special
from runner_strides import Runner

figure_3 = Runner("linear", 100.0, 1.25, 1.5)
figure_7 = Runner("linear", 10.0, math.pi / 4, 1.5)
figure_11 = Runner("air", 23.0, 1.25, 1.25)
figure_12 = Runner("air", 0.01839, 0.961, 0.173)
attracted, budget = 1, 22
flips_12 = (1.657765, 1.705457, 1.710989)


def maps():
    few = ("grid.axis.0.cells=60", "grid.axis.1.cells=60")
    # well below speed eta0 sqrt(k / m), where the closed form loses digits to the short spring
    run("run", "ghigliazza2005_fig3", no_audit, *few)
    angle, speed, sweep = layers("ghigliazza2005_fig3", "angle", "speed", "sweep_angle")
    for k, v in enumerate(speed):
        met = numpy.isfinite(sweep[:, k])
        near(f"Fig. 3: sweeps at speed {v:.4g}", sweep[met, k], figure_3.sweep(angle[met], v), 1e-12)
    run("run", "ghigliazza2005_fig3", no_audit, "grid.axis.1.cells=4", "grid.axis.1.min=1.75",
        "grid.axis.1.max=6.0", "grid.axis.1.edges=true")
    sweep, = layers("ghigliazza2005_fig3", "sweep_angle")
    near("the widest sweeps of the leg at speeds 1.75 and 6", numpy.nanmax(sweep, axis=0)[[0, -1]], (0.2970, 0.8652),
         2e-4)

    for scene, runner, fastest in (("6", figure_3, 15.0), ("7_map", figure_7, 4.5), ("11", figure_11, 99.0)):
        scene = f"ghigliazza2005_fig{scene}"
        run("run", scene, no_audit, *few)
        angle, speed, image, outcome = layers(scene, "angle", "speed", "last_angle", "outcome")
        n_gaps = 0
        for k, v in enumerate(speed):
            if v > fastest:
                continue
            expected = runner.stride(angle, v)
            completed = outcome[:, k] == 0
            holds(f"{scene}: who falls at speed {v:.4g}", completed == numpy.isfinite(expected))
            # next to the gap the next angle is the root of a small difference
            steep = 1e-14 / numpy.maximum(expected[completed], 1e-6) + 1e-12
            near(f"{scene}: strides at speed {v:.4g}", image[completed, k], expected[completed], steep)
            n_gaps += not completed.all()
        holds(f"{scene}: with and without a gap", 0 < n_gaps)


def falls():
    # strides before the fall, cell by cell
    run("run", "ghigliazza2005_fig7", no_audit, "grid.axis.0.cells=36", "grid.axis.1.cells=36", "question.returns=40")
    angle, speed, strides = layers("ghigliazza2005_fig7", "angle", "speed", "returns")
    wrong = 0
    for k, v in enumerate(speed):
        at, count = angle.copy(), numpy.zeros(len(angle), int)
        for _ in range(40):
            at = figure_3.stride(at, v)
            count += numpy.isfinite(at)
        wrong += (count != strides[:, k]).sum()
    holds("strides to fall are the closed form's", wrong == 0)

    run("run", "ghigliazza2005_basins", no_audit, "grid.axis.0.cells=60", "grid.axis.1.cells=200")
    angle, speed, label = layers("ghigliazza2005_basins", "angle", "speed", "label")
    near("stable gaits begin with the saddle-node", speed[(label > 0).any(axis=0)].min(), 4.2325, 7.0 / 200)
    holds("the gap of falling starts opens at 5.356",
          speed[(label[:30] > 0).all(axis=0)].max() < 5.356 + 7.0 / 200)
    for k, v in enumerate(speed):
        if 4.25 < v < 5.3:
            holds(f"at speed {v:.4g} the basin ends at the unstable gait",
                  (label[:, k] > 0) == (angle < figure_3.gaits(v)[1]))

    run("run", "ghigliazza2005_fig13", no_audit, "grid.axis.0.cells=64", "grid.axis.1.cells=64")
    speed, angle, label, outcome = layers("ghigliazza2005_fig13", "speed", "angle", "label", "outcome")
    wrong, n_basin = 0, 0
    for i, v in enumerate(speed):
        if v > flips_12[2] or abs(v - 1.5128) < 2e-3:
            continue  # chaos; next to the fold a ghost holds runners up for thousands of strides
        at = angle.copy()
        for _ in range(1000):
            at = figure_12.stride(at, v)
        stays = (outcome[i] == attracted) | (outcome[i] == budget)  # the latter next to doublings
        wrong += (numpy.isfinite(at) != stays).sum()
        n_basin += (label[i] > 0).sum()
        gaits = figure_12.gaits(v)
        holds(f"Fig. 13: no start beyond the unstable gait stays at speed {v:.4g}",
              label[i][angle > (gaits[1] if gaits else 0)] == 0)
    holds("Fig. 13: the basin is the closed form's, cell by cell", wrong == 0 and n_basin > 1000)


def road_to_chaos():
    run("run", "ghigliazza2005_fig12", no_audit, "grid.axis.0.cells=60", "grid.axis.1.cells=8")
    speed, angle = layers("ghigliazza2005_fig12", "speed", "last_angle")
    calm = (speed > 1.54) & (speed < 1.65)
    settled = [numpy.nanmax(abs(row - figure_12.gaits(v)[0])) for v, row in zip(speed[calm], angle[calm])]
    near("before the first doubling the gait sweeps pi - 2 beta", settled, 0, 1e-9)

    run("run", "ghigliazza2005_fig12_orbits", no_audit, "grid.axis.0.cells=201", "grid.axis.0.edges=true")
    speed, angle = layers("ghigliazza2005_fig12_orbits", "speed", "angle")
    angle = angle[:, -1, :]
    n_states = numpy.array([different(row, 1e-5) for row in angle])
    for low, high, expected in ((1.62, flips_12[0], 1), (flips_12[0], flips_12[1], 2), (flips_12[1], flips_12[2], 4)):
        inside = (speed > low + 1e-3) & (speed < high - 5e-4)
        holds(f"{expected} angles between speeds {low} and {high}", n_states[inside] == expected)
    chaotic = (speed > 1.7124) & (speed < 1.71549)
    holds("bands before the gap", (n_states[chaotic] > 16).mean() > 0.5)
    holds("beyond the gap's opening runners fall", numpy.isnan(angle[speed > 1.7160]).any(axis=1))

    # (2.24) at the gait
    run("run", "ghigliazza2005_fig12_lyapunov", no_audit, "grid.axis.0.cells=200", "question.transient=1000")
    speed, exponent, of_speed, motion = layers("ghigliazza2005_fig12_lyapunov", "speed", "lyapunov", "lyapunov_2", "motion")
    expected = []
    calm = (speed > 1.53) & (speed < 1.65)
    for v in speed[calm]:
        angle = figure_12.gaits(v)[0]
        alpha, stiffness, gravity = 0.961 - angle, 0.01839 / (v * 0.173) ** 2, 9.81 * 0.173 / v ** 2
        s, c = math.sin(alpha), math.cos(alpha)
        q = math.sqrt(stiffness + s * s)
        by_alpha = 2 * (stiffness * c / q ** 3 * math.atan(c / q) - s * s / q ** 2)
        expected.append(math.log(abs(1 + (1 + gravity * math.cos(0.961) / math.tan(angle)) * by_alpha)))
    near("exponents of gaits are their multiplier's", exponent[calm], expected, 1e-6)
    near("exponents of the conserved speed are 0", of_speed[calm], 0.0, 1e-12)
    holds("gaits are periodic motions", motion[calm] == 1)
    holds("positive before the gap only", exponent[(speed < 1.7122) & (speed > 1.53)] < 1e-3)
    chaotic = (speed > 1.7127) & (speed < 1.71545)
    holds("chaos from 1.7124 on", (exponent[chaotic] > 0.03).mean() > 0.6)


def branches():
    # one unit of the last digit of the page
    for scene, fold, tolerance in (("ghigliazza2005_fig8a_branch", 8.13883, 5e-6),
                                   ("ghigliazza2005_fig8b_branch", 3.94185, 5e-6)):
        run("branch", scene)
        near(f"{scene}: the gaits' fold", special(scene, "fold", "speed")[0], fold, tolerance)
    run("branch", "ghigliazza2005_fig12_branch", "question.doublings=2")
    near("air spring: the fold of Fig. 12", special("ghigliazza2005_fig12_branch", "fold", "speed")[0], 1.512797, 5e-7)
    for period, flip in zip((1, 2, 4), flips_12):
        near(f"period {period} doubles", special("ghigliazza2005_fig12_branch", "flip", "speed", period)[0], flip, 1e-6)


maps()
falls()
road_to_chaos()
branches()
finish()
