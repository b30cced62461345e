"""The planar juggler's solvable law for arrays of apexes, from the explicit map of its page (section 4) and the order
of tests of its section 2."""
import numpy

restitution, gravity, gain_offset, energy_gain = 0.75, 9.81, 1 / 7, 0.05824959953
target_x, target_height, position_gain, velocity_gain = 0.5, 0.5, 0.1, 0.08


def cycles(bx, bz, vx, most, shoulder=0.05, bar=1.5, floor=-1.0):
    """Completed cycles of every start, up to `most`."""
    bx, bz, vx = (numpy.array(numpy.broadcast_to(a, numpy.broadcast_shapes(*map(numpy.shape, (bx, bz, vx)))), float)
                  for a in (bx, bz, vx))
    count, alive = numpy.zeros(bx.shape, int), numpy.ones(bx.shape, bool)
    with numpy.errstate(all="ignore"):
        for _ in range(most):
            k = gain_offset + energy_gain * gravity * (target_height - bz)
            level = position_gain * (bx - target_x) + velocity_gain * vx
            alive &= (bx > shoulder) & (k > -1) & (bz - level > 0)
            s = level / bx
            q = numpy.sqrt(s * s * vx * vx + 2 * gravity * (bz - level))
            c = (1 + restitution) * (1 + k) * q / (1 + s * s)
            tau = numpy.where(s * vx >= 0, 2 * (bz - level) / (q + s * vx), (q - s * vx) / gravity)
            to_shoulder = numpy.where(vx < 0, (shoulder - bx) / vx, numpy.inf)
            alive &= (tau <= numpy.minimum(to_shoulder, numpy.sqrt(2 * (bz - floor) / gravity)))
            contact = bx + vx * tau
            alive &= numpy.hypot(contact, s * contact) <= bar
            after, climb = vx - s * c, s * vx - q + c
            alive &= climb > 0
            bx, bz, vx = contact + after * climb / gravity, s * contact + climb ** 2 / (2 * gravity), after
            alive &= bx > shoulder
            count += alive
    return count
