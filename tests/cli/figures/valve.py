"""The impacting relief valve's scenes against its equilibrium, x sqrt(x + 10) = q, and its Hopf point in closed
form."""
import math

import numpy

from checks import attractors, bisect, finish, holds, layers, near, no_audit, run

damping, offset, gain = 1.25, 10.0, 20.0


def routh_hurwitz(x):
    """Positive where the equilibrium with the disc at x is stable: its cubic's second determinant."""
    root = math.sqrt(x + offset)
    leak = gain * x / (2 * root)
    return (damping + leak) * (1 + damping * leak) - leak - gain * root


hopf_x = bisect(routh_hurwitz, 0.1, 6.0)
hopf = hopf_x * math.sqrt(hopf_x + offset)

run("run", "relief_valve", no_audit, "grid.axis.0.cells=49", "grid.axis.0.edges=true", "grid.axis.1.cells=6")
flow, x, p, outcome = layers("relief_valve", "flow_rate", "last_x", "p", "outcome")
equilibrium = numpy.array([bisect(lambda at, q=q: at * math.sqrt(at + offset) - q, 1e-9, 9.0) for q in flow])[:, None]
swings = (flow > 1.4) & (flow < hopf - 0.1)  # chaotic below, with maxima on either side
holds("before the Hopf point the disc swings higher than its equilibrium", x[swings] > equilibrium[swings] + 0.01)
rest, settled = outcome == 3, numpy.broadcast_to((flow > hopf + 0.1)[:, None], x.shape)
holds("beyond it the disc comes to rest", rest[settled & (flow > 8.9)[:, None]])
holds("and nowhere else", settled[rest])
near("or is about to", x[settled & ~rest], numpy.broadcast_to(equilibrium, x.shape)[settled & ~rest], 2e-2)
near("with its pressure", p[settled & ~rest], numpy.broadcast_to(equilibrium, x.shape)[settled & ~rest] + offset, 2e-1)

run("run", "relief_valve_basins", no_audit, "grid.axis.0.cells=8", "grid.axis.1.cells=16", "question.samples=8")
flow, label = layers("relief_valve_basins", "flow_rate", "label")
names = dict(zip(*attractors("relief_valve_basins", "label", "name")))
rests = numpy.array([[names.get(value) == b"rest" for value in row] for row in label])
holds("rest attracts beyond the Hopf point and only there", rests == (flow > hopf)[:, None])
finish()
