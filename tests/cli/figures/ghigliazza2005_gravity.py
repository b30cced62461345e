"""Figures of Ghigliazza, Altendorfer, Holmes and Koditschek (2005) with gravity in stance, and of the pitching runner,
against the reproduced numbers of their page (sections 5, 6 and 11)."""
import math

import numpy

from checks import (attractors, bisect, cells_around, curve_points, finish, holds, layers, near, no_audit, on_curve, run,
                    special)
from runner_strides import air_sweep

fold, gap = 7.1153, 8.4781  # speeds of k = 100, beta = 1


def air_fold(beta):
    """Stiffness below which the air spring has gaits without gravity: the largest sweep is pi - 2 beta."""
    alpha = numpy.linspace(1e-4, beta - 1e-4, 20001)
    return bisect(lambda c: float(air_sweep(alpha, c).max()) - (math.pi - 2 * beta), 1e-3, 5)


def maps():
    # strides to fall: no gait below the fold; in the gap starts fall that both neighbours survive
    run("run", "ghigliazza2005_gravity", no_audit, "grid.axis.0.cells=60", "grid.axis.1.cells=56",
        "question.returns=200")
    angle, speed, strides = layers("ghigliazza2005_gravity", "angle", "speed", "returns")
    stays = strides == 200
    near("runners stay from the fold on", speed[stays.any(axis=0)].min(), fold, 7 / 56)
    whole = [v for v, column in zip(speed, stays.T) if column.any() and column[:numpy.flatnonzero(column)[-1]].all()]
    near("until the gap opens", max(whole), gap, 7 / 56)

    for scene in ("ghigliazza2005_gravity_basins", "ghigliazza2005_refined_basins"):
        refined = ("grid.refine=2",) if "refined" in scene else ()
        run("run", scene, no_audit, "grid.axis.0.cells=64", "grid.axis.1.cells=128", *refined)
        speed, label = layers(scene, "speed", "label")
        stays = label > 0
        near(f"{scene}: stable gaits begin at the fold", speed[stays.any(axis=0)].min(), fold, 4 / 128)
        whole = [v for v, column in zip(speed, stays.T)
                 if column.any() and column[:numpy.flatnonzero(column)[-1]].all()]
        near(f"{scene}: the gap of falling starts opens", max(whole), gap, 4 / 128)
    # the gait of Fig. 4(d), found from a start that leads to it
    run("run", "ghigliazza2005_gravity_basins", no_audit, *cells_around(0, 0.14, 0.05), *cells_around(1, 8.0, 1e-9))
    near("the gait of Fig. 4(d)", attractors("ghigliazza2005_gravity_basins", "points")[0].ravel(), (8, 0.141161), 6e-7)


def pitching():
    # both gaits of Fig. 5(b) in the scene's own plane; slopes of up to 1500 enlarge the page's rounding of 5e-7
    for angle, pitch, rate, digits in ((0.124398, -0.318410, -3.04778, 5e-6), (0.115440, -0.522890, -5.39149, 5e-6)):
        plane = (*cells_around(0, rate, 1e-9), *cells_around(1, pitch, 1e-9), f"start.angle={angle}")
        run("run", "ghigliazza2005_fig5", no_audit, *plane, "question.kind=return_map", "question.returns=1")
        back = [layer.item() for layer in layers("ghigliazza2005_fig5", "angle", "last_pitch", "last_pitch_rate")]
        near("a gait of Fig. 5(b) comes back", back, (angle, pitch, rate), 1500 * digits)
        near("its angle to the digits that the mildest direction leaves", back[0], angle, 1e-3)
        # unstable (multipliers 4.88 and -11.96): left by a tenth after ln(0.1 / 5e-7) / ln |m| strides or more
        run("run", "ghigliazza2005_fig5", no_audit, *plane)
        strides, = layers("ghigliazza2005_fig5", "returns")
        holds("and lasts for some strides", (strides >= (6 if angle > 0.12 else 4)) & (strides < 100))


def branches():
    run("branch", "ghigliazza2005_gravity_branch")
    near("the gaits' fold", special("ghigliazza2005_gravity_branch", "fold", "speed")[0], fold, 5e-5)
    run("branch", "ghigliazza2005_fig14d_branch", "question.doublings=0")
    near("Fig. 14(d): the gaits' birth at gravity 0.5",
         special("ghigliazza2005_fig14d_branch", "fold", "stiffness")[0], 17.568, 6e-4)
    run("branch", "ghigliazza2005_fig14_curves")
    points = curve_points("ghigliazza2005_fig14_curves", "fold")
    for gravity, stiffness in ((0.01, 12.653), (0.1, 13.499), (0.25, 14.960), (0.5, 17.568)):
        near(f"Fig. 14(a): the gaits' birth at gravity {gravity}", on_curve(points, gravity), stiffness, 1.5e-3)
    # touchdown angle 1: k = 100, leg 1.5, v = 7.1153 in the map's three numbers
    run("branch", "ghigliazza2005_fig14b_curves")
    near("Fig. 14(b): the fold of the leg of Fig. 4(d)",
         on_curve(curve_points("ghigliazza2005_fig14b_curves", "fold"), 9.81 * 1.5 / 7.1153 ** 2),
         100 * 1.5 ** 2 / 7.1153 ** 2, 2e-3)
    # Fig. 15: as gravity goes, the fold of Fig. 8(b); doubling at gravity 1; one fold by two methods at 0.5
    run("branch", "ghigliazza2005_fig15_curves")
    folds = curve_points("ghigliazza2005_fig15_curves", "fold")
    less, more = on_curve(folds, 0.02), on_curve(folds, 0.04)
    near("Fig. 15(a): the fold without gravity", 2 * less - more, 23 / (3.94185 * 1.25) ** 2, 1e-3)
    near("Fig. 15(a): the period doubles at gravity 1",
         on_curve(curve_points("ghigliazza2005_fig15_curves", "flip"), 1.0), 1.33, 6e-3)
    run("branch", "ghigliazza2005_fig15b_curves")
    curve = curve_points("ghigliazza2005_fig15b_curves", "fold")
    near("Fig. 15(b): the fold without gravity", 2 * on_curve(curve, 0.02) - on_curve(curve, 0.04), air_fold(1.0), 2e-4)
    run("branch", "ghigliazza2005_fig15d_branch", "question.doublings=0")
    near("Fig. 15(d): the fold lies on the curve of (a)",
         special("ghigliazza2005_fig15d_branch", "fold", "stiffness")[0], on_curve(folds, 0.5), 1e-3)


maps()
pitching()
branches()
finish()
