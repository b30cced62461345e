"""Runs scenes of published figures, small, and compares what they show with the printed numbers or with closed
forms. Usage: figures.py PROGRAM SOURCE_FOLDER branches|maps; started by test_figures_*.sh, which makes the folder."""
import json
import math
import subprocess
import sys

program, source, part = sys.argv[1:4]
failed = False


def run(command, scene, *overrides):
    arguments = [program, command, f"{source}/configs/scenes/{scene}.toml", *overrides, "-o"]
    arguments += [f"{scene}.h5", "--quiet", "--force"] if command == "run" else [scene]
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)


def near(claim, got, expected, tolerance):
    global failed
    if not abs(got - expected) <= tolerance:
        print(f"FAILED: {claim}: {got!r} instead of {expected!r} within {tolerance}")
        failed = True


def holds(claim, condition):
    near(claim, 1 if condition else 0, 1, 0)


def special(scene, kind, variable, period=1):
    """Values of the variable at the special points of that kind on branches of that period, rising."""
    branches = json.load(open(f"{scene}.json"))["branches"]
    return sorted(point[variable] for branch in branches if branch["period"] == period
                  for point in branch["special"] if point["kind"] == kind)


def branches():
    # one unit of the last printed digit, unless a closed form or the model page's 50 digits say more
    run("branch", "cham2007_fig5_branch")
    low, high = special("cham2007_fig5_branch", "fold", "stride_period")
    near("long thrust: the lower fold", low, 0.24865, 5e-6)
    near("long thrust: the upper fold", high, 0.27511, 5e-6)

    run("branch", "cham2007_fig6_branch", "question.doublings=0")
    flips = special("cham2007_fig6_branch", "flip", "stride_period")
    near("short thrust: period 2 begins", flips[0], 0.1235, 5e-5)
    near("short thrust: period 2 ends", flips[1], 0.1560, 5e-5)
    near("short thrust: thrust-off meets take-off",
         special("cham2007_fig6_branch", "border collision", "stride_period")[-1], 0.3472, 5e-5)
    near("short thrust: the branch turns back",
         special("cham2007_fig6_branch", "fold", "stride_period")[0], 0.2793, 5e-5)

    run("branch", "chatterjee2002_injection_branch", "question.doublings=0")
    near("the injected hop doubles its period",
         special("chatterjee2002_injection_branch", "flip", "speed_increment")[0], 0.0715873841, 1e-10)

    run("branch", "koditschek1991_cascade_branch", "question.doublings=2")
    near("the first flip lies at e^2", special("koditschek1991_cascade_branch", "flip", "gain")[0],
         math.exp(2), 1e-10)
    near("the second flip", special("koditschek1991_cascade_branch", "flip", "gain", 2)[0], 12.509242, 5e-7)
    near("the third flip", special("koditschek1991_cascade_branch", "flip", "gain", 4)[0], 14.244249, 5e-7)

    # a = (1 + restitution) (kappa0 + 1 + kappa1 g b*) - 1 doubles at 2, its cycle at sqrt 5
    run("branch", "rizzi1994_line_branch", "question.doublings=1")
    near("the line juggler's apex doubles", special("rizzi1994_line_branch", "flip", "energy_gain")[0],
         1 / 8.58375, 1e-10)
    near("its 2-cycle doubles", special("rizzi1994_line_branch", "flip", "energy_gain", 2)[0],
         (math.sqrt(5) - 1) / 8.58375, 1e-10)

    run("branch", "koditschek1991_fig12_branch")
    holds("the bubble of period 2 opens and closes as the spring softens",
          len([s for s in special("koditschek1991_fig12_branch", "flip", "stiffness") if 1.85 < s < 2.85]) == 2)

    run("branch", "ghigliazza2005_fig8a_branch")
    near("linear spring: the gaits' fold", special("ghigliazza2005_fig8a_branch", "fold", "speed")[0], 8.13883, 5e-6)
    run("branch", "ghigliazza2005_fig8b_branch")
    near("air spring: the gaits' fold", special("ghigliazza2005_fig8b_branch", "fold", "speed")[0], 3.94185, 5e-6)
    run("branch", "ghigliazza2005_gravity_branch")
    near("gravity in stance: the gaits' fold", special("ghigliazza2005_gravity_branch", "fold", "speed")[0],
         7.1153, 5e-5)
    run("branch", "ghigliazza2005_fig12_branch", "question.doublings=2")
    near("air spring: the fold of Fig. 12", special("ghigliazza2005_fig12_branch", "fold", "speed")[0], 1.512797, 5e-7)
    for period, flip in ((1, 1.657765), (2, 1.705457), (4, 1.710989)):
        near(f"period {period} doubles", special("ghigliazza2005_fig12_branch", "flip", "speed", period)[0],
             flip, 1e-6)

    run("branch", "ghigliazza2005_fig14_curves")
    rows = [line.split(",") for line in open("ghigliazza2005_fig14_curves_curves.csv")][1:]
    points = sorted((float(row[4]), float(row[3])) for row in rows)
    for gravity, stiffness in ((0.01, 12.653), (0.1, 13.499), (0.25, 14.960), (0.5, 17.568)):
        after = next(i for i, point in enumerate(points) if point[0] >= gravity)
        (g0, k0), (g1, k1) = points[after - 1], points[after]
        near(f"the gaits' birth at gravity {gravity}", k0 + (k1 - k0) * (gravity - g0) / (g1 - g0), stiffness, 1.5e-3)

    # the vertical period is 2 sqrt(2 b / g); k11 = T/2 k10 and k11 = T/4 of that period bound the triangle
    run("branch", "rizzi1994_gains_curves")
    period = 2 * math.sqrt(2 * 0.5 / 9.81)
    for line in open("rizzi1994_gains_curves_curves.csv"):
        row = line.split(",")
        if row[1] == "neimark-sacker":
            near("the triangle's oblique side", float(row[3]), period / 2 * float(row[4]), 1e-9)
        if row[1] == "flip":
            near("the triangle's upright side", float(row[3]), period / 4, 1e-9)


def layers(scene, *names):
    import h5py
    with h5py.File(f"{scene}.h5") as file:
        return [file[name][...] for name in names]


def crossing(x, y, level=None):
    """Where y(x), sampled, first crosses x (or a level), by linear interpolation; from the right end."""
    for i in range(len(x) - 1, 0, -1):
        left = y[i - 1] - (x[i - 1] if level is None else level)
        right = y[i] - (x[i] if level is None else level)
        if left * right <= 0 and left != right:
            return x[i - 1] + (x[i] - x[i - 1]) * left / (left - right)
    return math.nan


def maps():
    import numpy
    no_audit = "accuracy.audit_cells=0"

    run("run", "koditschek1991_fig5", no_audit)
    energy, image = layers("koditschek1991_fig5", "energy", "last_energy")
    near("Fig. 5 is the map 6 E exp(-E)", abs(image - 6 * energy * numpy.exp(-energy)).max(), 0, 1e-14)
    # fixed points, by interpolation between cells: the error is the spacing squared
    for scene, column, fixed_point, tolerance in (
            ("koditschek1991_fig2", "energy", 4.767e-5, 1e-8), ("koditschek1991_fig3", "bottom_height", 1 / 6, 1e-6),
            ("koditschek1991_fig8", "apex_height", 0.9557, 5e-5),
            ("koditschek1991_fig10", "bottom_height", -0.1676, 5e-5)):
        run("run", scene, no_audit)
        near(f"the fixed point of {scene}", crossing(*layers(scene, column, f"last_{column}")), fixed_point, tolerance)
    run("run", "koditschek1991_fig11", no_audit)
    speed = crossing(*layers("koditschek1991_fig11", "touchdown_speed", "last_touchdown_speed"))
    near("all orbits of Fig. 11 settle at one apex", 0.5 + speed**2 / (2 * 10), 1.24461, 1e-5)

    # labels by the gain alone: periods are lost at 1, e^2, 12.509242, 14.244249 (sections of the page)
    run("run", "koditschek1991_fig13", no_audit, "grid.axis.0.cells=320", "grid.axis.1.cells=8",
        "output.layers=['period', 'label']")
    gain, period = layers("koditschek1991_fig13", "gain", "period")
    for low, high, expected in ((1, math.exp(2), 1), (math.exp(2), 12.509242, 2), (12.509242, 14.244249, 4)):
        inside = (gain > low) & (gain < high)
        holds(f"period {expected} between gains {low:.4g} and {high:.4g}", (period[inside] == expected).all())

    run("run", "koditschek1991_lyapunov", no_audit, "grid.axis.0.cells=40", "grid.axis.1.cells=40",
        "question.returns=4000", "question.transient=500", "output.layers=['motion', 'lyapunov']")
    thrust, stiffness, motion, exponent = layers("koditschek1991_lyapunov", "thrust", "stiffness", "motion", "lyapunov")
    gain = thrust[:, None] * 0.5 / stiffness[None, :]
    holds("no chaos before the cascade ends", (exponent[(gain < 14.7) & (gain > 1)] <= 1e-6).all())
    settled = (gain > 1.1) & (gain < 7.3)
    near("at fixed points the exponent is log |1 - log gain|",
         abs(exponent[settled] - numpy.log(abs(1 - numpy.log(gain[settled])))).max(), 0, 1e-6)

    # CPRR: lossless motions tan a = a map to themselves; (k + 1) pi maps by the closed form of one impact
    run("run", "chatterjee2002_fig5a", no_audit)
    alpha, image = layers("chatterjee2002_fig5a", "liftoff_speed", "last_liftoff_speed")
    rises = image[~numpy.isnan(image)] - alpha[~numpy.isnan(image)]
    holds("no lift-off speed rises by an ulp", rises.max() <= 0)
    for k, lossless in ((1, 4.493409457909064), (2, 7.725251836937707), (3, 10.904121659428899)):
        at = numpy.argmin(abs(alpha - lossless))
        near(f"the map touches the identity at lossless motion {k}", image[at] - alpha[at], 0, 2e-3)

    run("run", "chatterjee2002_fig8", no_audit, "grid.axis.0.cells=90", "grid.axis.1.cells=20")
    increment, label = layers("chatterjee2002_fig8", "speed_increment", "label")
    holds("where energy is taken away hopping dies", (label[increment < -1e-3] == 1).all())

    # the widest sweeps of the leg, cases (a) to (d), and the gait's own
    run("run", "ghigliazza2005_fig3", no_audit, "grid.axis.1.cells=4", "grid.axis.1.min=1.75",
        "grid.axis.1.max=6.0", "grid.axis.1.edges=true")
    speed, sweep = layers("ghigliazza2005_fig3", "speed", "sweep_angle")
    near("the widest sweep of the leg at speed 1.75", numpy.nanmax(sweep[:, 0]), 0.2970, 2e-4)
    near("the widest sweep of the leg at speed 6", numpy.nanmax(sweep[:, -1]), 0.8652, 2e-4)

    run("run", "ghigliazza2005_basins", no_audit, "grid.axis.0.cells=60", "grid.axis.1.cells=200")
    speed, label = layers("ghigliazza2005_basins", "speed", "label")
    gaits = speed[(label > 0).any(axis=0)]
    near("stable gaits begin with the saddle-node", gaits.min(), 4.2325, 7.0 / 200)
    full = speed[(label[: 30] > 0).all(axis=0)]
    holds("the gap of falling starts opens at 5.356", full.max() < 5.356 + 7.0 / 200)

    run("run", "rizzi1994_line", no_audit, "grid.axis.0.cells=100", "grid.axis.1.cells=12",
        "output.layers=['period', 'label']")
    gain, period = layers("rizzi1994_line", "energy_gain", "period")
    inner = period[:, 2:6]
    below = gain < 1 / 8.58375
    doubled = (gain > 1 / 8.58375) & (gain < (math.sqrt(5) - 1) / 8.58375)
    holds("the target height attracts until a = 2", (inner[below] == 1).all())
    holds("then a 2-cycle until a = sqrt 5", (inner[doubled] == 2).all())

    run("run", "cham2007_fig8_basins", no_audit, "grid.axis.0.cells=100", "grid.axis.1.cells=100")
    import h5py
    with h5py.File("cham2007_fig8_basins.h5") as file:
        shares = sorted(file["attractors/share"][...])
    holds("two hops share the window", len(shares) == 2)
    near("hop-settle-fire has 53 % of it", shares[-1], 0.53, 0.01)


{"branches": branches, "maps": maps}[part]()
sys.exit(1 if failed else 0)
