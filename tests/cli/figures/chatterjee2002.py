"""Figures of Chatterjee, Pratap, Reddy and Ruina (2002), the passive hopper, against the closed forms of its page."""
import math

import numpy

import lossless
from checks import (attractors, bisect, cells_around, different, finish, holds, layers, near, no_audit, run,
                    special)


def return_maps():
    # every 61st cell against the closed forms; next to a grazing contact (unbounded slope) f is less certain
    for scene, mass_ratio in (("5a", 1.0), ("5b", 1.0), ("5c", 0.05), ("5d", 1000.0)):
        scene = f"chatterjee2002_fig{scene}"
        run("run", scene, no_audit)
        alpha, image, bounces = layers(scene, "liftoff_speed", "last_liftoff_speed", "bounces")
        with numpy.errstate(invalid="ignore"):
            holds(f"{scene}: no lift-off speed rises by an ulp", ~(image > alpha))
        far, stuck, other_bounces, n = 0.0, 0, 0, 0
        for i in range(5, len(alpha), 61):
            expected, n_bounces = lossless.hop(alpha[i], mass_ratio)
            n += 1
            other_bounces += n_bounces != bounces[i]
            stuck += math.isnan(expected) != math.isnan(image[i])
            if not math.isnan(expected) and n_bounces == bounces[i]:
                far = max(far, abs(expected - image[i]))
        near(f"{scene}: the map is the page's", far, 0, 1e-9)
        holds(f"{scene}: hopping stops where the page says", stuck == 0 and n > 60)
        holds(f"{scene}: bounces are the page's", other_bounces <= n // 100)
        for k, point in enumerate(lossless.points[1:4], 1):
            if not alpha[0] < point < alpha[-1]:
                continue
            at = numpy.argmin(abs(alpha - point))
            near(f"{scene}: the map touches the identity at lossless motion {k}", image[at], alpha[at], 2e-3)

    # (b): the law of the power 4/3, ten times stronger to the left
    alpha, image = layers("chatterjee2002_fig5b", "liftoff_speed", "last_liftoff_speed")
    beta = alpha - lossless.points[1]
    strength = (alpha - image) / abs(beta) ** (4 / 3)
    ratio = strength / lossless.local_coefficient(1, 1.0)
    # the next term of the law is 2 / alpha* (|beta| / K)^(1/3); terms beyond go with the square of that root
    root = (abs(beta) * 3 / 2 / (1 + lossless.points[1] ** -2)) ** (1 / 3)
    close = (abs(beta) < 1e-3) & (abs(beta) > 2e-4)
    right, left = close & (beta > 0), close & (beta < 0)
    near("to the right C_R", ratio[right], 1 + 2 / lossless.points[1] * root[right], 4 * root[right] ** 2)
    near("to the left ten times that", ratio[left] / 10, 1 - 2 / lossless.points[1] * root[left],
         4 * root[left] ** 2)

    # (d): each bounce takes 4 pi^2 kappa of alpha^2, so the second comes at once after pi
    alpha, bounces = layers("chatterjee2002_fig5d", "liftoff_speed", "bounces")
    jog = alpha[bounces > 1]
    near("the jog begins at pi", jog.min(), math.pi, 0.015)
    near("and ends where bouncing of period two does", jog.max(), 3.724959635385563, 0.02)
    near("bounces are a tenth of the mass ratio", bounces.max() / 1000, 0.101, 0.01)


def added_energy():
    run("run", "chatterjee2002_fig8", no_audit, "grid.axis.0.cells=90", "grid.axis.1.cells=20")
    increment, label = layers("chatterjee2002_fig8", "speed_increment", "label")
    holds("where energy is taken away hopping dies", label[increment < -1e-3] == 1)

    # the fixed point of the closed form, its two halves and the band's edges
    run("run", "chatterjee2002_chaos", no_audit, "grid.axis.0.cells=240")
    increment, speed = layers("chatterjee2002_chaos", "speed_increment", "liftoff_speed")
    calm = increment < 0.069
    fixed = [bisect(lambda a, e=e: lossless.branch_slope(a, 1.0)[0] + e - a, lossless.points[1] + 1e-9, 4.7)
             for e in increment[calm]]
    near("below eps_c the hop of the closed form", speed[calm][:, 2, -1], fixed, 1e-9)
    n_states = numpy.array([different(row[2], 1e-4) for row in speed])
    holds("one state below eps_c", n_states[increment < 0.069] == 1)
    holds("two states to about 0.11", n_states[(increment > 0.074) & (increment < 0.107)] == 2)
    holds("bands before the crisis", n_states[increment > 0.136] > 20)
    chaotic = increment > 0.12
    holds("orbits before the crisis stay in the basin of section 5",
          numpy.isfinite(speed[chaotic]).all() and speed[chaotic].min() > 4.45 and speed[chaotic].max() < 4.75)

    # ln|f'| at the fixed point, mass ratio by mass ratio
    run("run", "chatterjee2002_lyapunov", no_audit, "grid.axis.0.cells=24", "grid.axis.1.cells=40",
        "question.transient=3000")
    mass_ratio, increment, exponent = layers("chatterjee2002_lyapunov", "mass_ratio", "speed_increment", "lyapunov")
    expected, got = [], []
    for i, m in enumerate(mass_ratio):
        for k, e in enumerate(increment):
            def excess(a, m=m, e=e):
                return lossless.branch_slope(a, m)[0] + e - a
            end = 4.493409457909064 + 0.3
            started_inside = lossless.branch_slope(4.54, m)[0] + e > lossless.points[1]
            if e < 0.005 or not 1 / 3 < m < 3 or excess(end) > 0 or not started_inside:
                continue
            _, slope = lossless.branch_slope(bisect(excess, lossless.points[1] + 1e-9, end), m)
            if 0.05 < abs(slope) < 0.98 and math.isfinite(exponent[i, k]):
                expected.append(math.log(abs(slope)))
                got.append(exponent[i, k])
    near("at the hop above alpha*_1 the exponent is ln|f'|", got, expected, 5e-3)
    holds("of enough cells", len(got) > 100)

    run("branch", "chatterjee2002_injection_branch", "question.doublings=0")
    near("the injected hop doubles its period",
         special("chatterjee2002_injection_branch", "flip", "speed_increment")[0], 0.0715873841, 1e-10)


def labels():
    # Fig. 7, section 5: the lossless hop of a cubic spring, the page's eleven digits
    run("run", "chatterjee2002_nonlinear", no_audit, *cells_around(0, 4.20508972130, 1e-7, 2),
        *cells_around(1, 0.01, 1e-9), "question.returns=200000")
    label, = layers("chatterjee2002_nonlinear", "label")
    names, = attractors("chatterjee2002_nonlinear", "name")
    holds("to the right of the lossless hop of the cubic spring orbits stay", label[1, 0] > 1)
    holds("to its left they do not", label[0, 0] == 1 and names[0] == b"hopping dies")

    # r_1(1) = 0.0159187, the whole branch trapped beyond M = 9.66578 and below 0.103458
    run("run", "one_sided_hopper", no_audit, *cells_around(0, 4.493409457909 + 0.0159187, 1e-6, 4),
        *cells_around(1, 1.0, 1e-9))
    immediate, = layers("one_sided_hopper", "immediate")
    holds("the immediate basin of alpha*_1 ends at r_1(1)", immediate[:2, 0] == 2)
    holds("and not later", immediate[2:, 0] != 2)
    extent, kind = layers("one_sided_hopper_sides", "extent", "kind")
    near("its extent is r_1(1)", extent[0, 0, 1], 0.0159187, 5e-8)
    holds("it repels to the left and attracts to the right", kind[0, 0] == [2, 0])
    for mass_ratio, is_whole in ((0.1034, True), (0.1036, False), (9.66, False), (9.672, True)):
        run("run", "one_sided_hopper", no_audit, "grid.axis.0.min=4.4935", "grid.axis.0.max=6.2831",
            "grid.axis.0.cells=4000", *cells_around(1, mass_ratio, 1e-9))
        immediate, = layers("one_sided_hopper", "immediate")
        holds(f"the whole branch is trapped at M = {mass_ratio}: {is_whole}", (immediate == 2).all() == is_whole)
        extent, = layers("one_sided_hopper_sides", "extent")
        whole = 2 * math.pi - lossless.points[1]
        holds(f"so is its extent at M = {mass_ratio}", (abs(extent[0, 0, 1] - whole) < 1e-12) == is_whole)

    run("run", "quickstart", no_audit, "grid.axis.0.cells=300", "grid.axis.1.cells=31", "output.tile=[64, 64]")
    alpha, mass_ratio, label = layers("quickstart", "liftoff_speed", "mass_ratio", "label")
    for k, point in enumerate(lossless.points[1:4], 1):
        holds(f"no start below lossless motion {k} ends there, since speeds never rise",
              label[alpha < point] < k + 1)
        light = (mass_ratio < 0.01) | (mass_ratio > 100)
        cell = (alpha > point) & (alpha < (k + 1) * math.pi)
        holds(f"feet far from the body's mass are trapped on the whole branch {k}", label[cell][:, light] == k + 1)


return_maps()
added_energy()
labels()
finish()
