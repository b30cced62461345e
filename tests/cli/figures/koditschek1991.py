"""Figures of Koditschek and Buehler (1991), Raibert's hopper, against printed numbers and the closed forms of its
page (sections 5, 6 and 9)."""
import math

import numpy

import pneumatic_leg
from checks import (cells_around, crossing, different, finish, holds, layers, near, no_audit, run, special)

flips = (math.exp(2), 12.50924193, 14.24424927)  # of the map alpha E exp(-E)


def return_maps():
    run("run", "koditschek1991_fig5", no_audit)
    energy, image = layers("koditschek1991_fig5", "energy", "last_energy")
    near("Fig. 5 is the map 6 E exp(-E)", image, 6 * energy * numpy.exp(-energy), 1e-14)
    run("run", "koditschek1991_fig3", no_audit)
    height, image = layers("koditschek1991_fig3", "bottom_height", "last_bottom_height")
    near("Fig. 3 is the map exp(-6 x ln(1 / x))", image, numpy.exp(6 * height * numpy.log(height)), 1e-14)
    run("run", "koditschek1991_fig2", no_audit)
    energy, image = layers("koditschek1991_fig2", "energy", "last_energy")
    w, b, tau, delta = 20.0, 0.2, 1.0, 0.01
    z, q = 2 * w * b * delta, math.sqrt(1 + b * b)
    moved = tau / (4 * w * w * b * b) * (z + math.expm1(-z))  # corrected (24) and (25)
    velocity = -tau / (2 * w * b) * math.expm1(-z)
    psi, rate = w * q * moved + b * velocity / q, velocity / q
    root = numpy.sqrt(energy)
    valid = root > psi - b * rate
    phase = numpy.arctan2(rate, psi - root)
    map_17 = ((psi - root) ** 2 + rate ** 2) * numpy.exp(-2 * b * phase)
    near("Fig. 2 is the map (17)", image[valid] * 1e5, map_17[valid] * 1e5, 1e-13)

    # fixed points, by interpolation between cells: the error is the spacing squared
    for scene, column, fixed_point, tolerance in (
            ("koditschek1991_fig2", "energy", 4.767e-5, 1e-8), ("koditschek1991_fig3", "bottom_height", 1 / 6, 1e-6),
            ("koditschek1991_fig8", "apex_height", 0.95572, 6e-6),
            ("koditschek1991_fig9", "bottom_height", -0.375, 6e-4),
            ("koditschek1991_fig10", "bottom_height", -0.167585, 1e-6)):
        run("run", scene, no_audit)
        near(f"the fixed point of {scene}", crossing(*layers(scene, column, f"last_{column}")), fixed_point, tolerance)
    run("run", "koditschek1991_fig11", no_audit)
    speed, image = layers("koditschek1991_fig11", "touchdown_speed", "last_touchdown_speed")
    energy = speed ** 2 / (2 * 5.81)
    near("Fig. 11 is the Ricker map", image ** 2 / (2 * 5.81), 3.60240963855 * energy * numpy.exp(-energy), 1e-11)
    near("all orbits of Fig. 11 settle at one apex", 0.5 + crossing(speed, image) ** 2 / 20, 1.24461, 1e-5)


def gains():
    # labels by the gain alone: periods are lost at 1, e^2, 12.509242, 14.244249 (section 6 of the page)
    run("run", "koditschek1991_fig13", no_audit, "grid.axis.0.cells=320", "grid.axis.1.cells=8",
        "output.layers=['period', 'label']")
    gain, period = layers("koditschek1991_fig13", "gain", "period")
    for low, high, expected in ((1, flips[0], 1), (flips[0], flips[1], 2), (flips[1], flips[2], 4)):
        inside = (gain > low) & (gain < high)
        holds(f"period {expected} between gains {low:.4g} and {high:.4g}", period[inside] == expected)
    run("run", "koditschek1991_fig13", no_audit, *cells_around(0, 8.98283, 1e-9), "grid.axis.1.cells=8",
        "output.layers=['period', 'label']")
    period, = layers("koditschek1991_fig13", "period")
    holds("the limping gait of Fig. 13 has period two from every start", period == 2)

    run("run", "koditschek1991_cascade", no_audit, "grid.axis.0.cells=480")
    gain, energy = layers("koditschek1991_cascade", "gain", "energy")
    energy = energy[:, -1, :]  # from the critical point
    calm = (gain > 1.2) & (gain < 7.2)
    near("until e^2 the energy is the gain's logarithm", energy[calm], numpy.log(gain[calm])[:, None], 1e-9)
    n_states = numpy.array([different(row, 1e-6) for row in energy])
    for low, high, expected in ((1.2, 7.3, 1), (7.5, 12.4, 2), (12.6, 14.2, 4), (14.3, 14.6, 8)):
        inside = (gain > low) & (gain < high)
        holds(f"{expected} energies between gains {low} and {high}", n_states[inside] == expected)
    top = gain / math.e  # images of the critical point bound the attractor
    bottom = gain * top * numpy.exp(-top)
    holds("attractors lie between f(f(1)) and f(1)",
          (energy <= top[:, None] * (1 + 1e-12)) & (energy >= numpy.where(gain > math.e, bottom, 0)[:, None] *
                                                     (1 - 1e-9)))
    # chaos fills that hull: at gain 25 bands have merged, and 250 energies come close to both ends
    run("run", "koditschek1991_cascade", no_audit, *cells_around(0, 22.0, 1e-9), "question.returns=4000")
    energy, = layers("koditschek1991_cascade", "energy")
    near("the attractor's upper end at gain 22", energy.max(), 22 / math.e, 1e-3)

    run("run", "koditschek1991_lyapunov", no_audit, "grid.axis.0.cells=40", "grid.axis.1.cells=40",
        "question.returns=4000", "question.transient=500", "output.layers=['motion', 'lyapunov']")
    thrust, stiffness, exponent = layers("koditschek1991_lyapunov", "thrust", "stiffness", "lyapunov")
    gain = thrust[:, None] * 0.5 / stiffness[None, :]
    holds("no chaos before the cascade ends", exponent[(gain < 14.7) & (gain > 1)] <= 1e-6)
    settled = (gain > 1.1) & (gain < 7.3)
    near("at fixed points the exponent is log |1 - log gain|", exponent[settled],
         numpy.log(abs(1 - numpy.log(gain[settled]))), 1e-6)

    run("branch", "koditschek1991_cascade_branch", "question.doublings=2")
    for period, flip, tolerance in ((1, flips[0], 1e-10), (2, flips[1], 6e-9), (4, flips[2], 6e-9)):
        near(f"period {period} doubles", special("koditschek1991_cascade_branch", "flip", "gain", period)[0],
             flip, tolerance)


def friction():
    # the bubble's ends by Runge-Kutta: the slope at the fixed point is -1 there (the page's "about 2.85 and 1.85" is
    # where orbits are seen to alternate for long)
    run("branch", "koditschek1991_fig12_branch")
    ends = [s for s in special("koditschek1991_fig12_branch", "flip", "stiffness") if 1.7 < s < 3]
    holds("the bubble of period 2 opens and closes as the spring softens", len(ends) == 2)
    low, high = ends
    for stiffness, speed in ((low, 1.01), (high, 1.73)):
        near(f"the slope at stiffness {stiffness:.6g}", pneumatic_leg.multiplier(stiffness, speed)[0], -1, 2e-7)

    run("run", "koditschek1991_bubble", no_audit, "grid.axis.0.cells=100", "grid.axis.1.cells=10",
        "question.transient=2000", "question.sweeps=0")
    stiffness, speed = layers("koditschek1991_bubble", "stiffness", "touchdown_speed")
    n_states = numpy.array([different(row[numpy.isfinite(row)], 1e-3) if numpy.isfinite(row).any() else 0
                            for row in speed])
    holds("one speed above the bubble", n_states[stiffness > high + 0.02] == 1)
    holds("two speeds inside", n_states[(stiffness > low + 0.02) & (stiffness < high - 0.02)] == 2)
    holds("one below it", n_states[(stiffness > 1.7) & (stiffness < low - 0.02)] == 1)
    holds("and none where the spring is too soft", n_states[stiffness < 1.6] == 0)

    # the fall edge v_e = 4.7779 of Fig. 12 and the end of hopping near 1.65
    run("run", "koditschek1991_fig12", no_audit, *cells_around(0, 5.81, 1e-9), *cells_around(1, 4.7779, 1e-3, 40))
    speed, hops = layers("koditschek1991_fig12", "touchdown_speed", "returns")
    holds("starts below the fall edge never fall", hops[0][speed < 4.7779 - 6e-5] == 100)
    holds("starts above it fall at once", hops[0][speed > 4.7779 + 6e-5] == 0)
    run("run", "koditschek1991_fig12", no_audit, "grid.axis.0.cells=70", "grid.axis.1.cells=24",
        "question.returns=2000")
    stiffness, hops = layers("koditschek1991_fig12", "stiffness", "returns")
    near("hopping ends near stiffness 1.65", stiffness[(hops == 2000).any(axis=1)].min(), 1.65, 0.11)

    # before the crisis the basin is (0, v_e), after it almost every start falls
    run("run", "koditschek1991_crisis", no_audit, "grid.axis.0.cells=12", "grid.axis.1.cells=60",
        "question.returns=2000")
    stiffness, hops = layers("koditschek1991_crisis", "stiffness", "returns")
    for eta, row in zip(stiffness, hops):
        if eta < 1.14375 - 0.02:
            holds(f"almost every start falls at stiffness {eta:.4g}", (row < 2000).mean() > 0.9)
        if eta > 1.14375:
            forever = row == 2000
            holds(f"the basin is an interval from 0 at stiffness {eta:.4g}",
                  forever[0] and different(numpy.flatnonzero(forever), 1) == 1 and (row[~forever] == 0).all())


return_maps()
gains()
friction()
finish()
