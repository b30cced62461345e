"""One stride of the clock-driven hopper in scaled units (Y = w^2 y, V = w v, times w t) from the closed forms of its
page, events by scanning: knows nothing of the program."""
import cmath
import math

import numpy

w, zeta = 30.0, 0.2
damped = math.sqrt(1 - zeta * zeta)


def on_ground(y, v, force, t):
    """The damped oscillator about force - 1."""
    x = y - (force - 1)
    scale, c, s = math.exp(-zeta * t), math.cos(damped * t), math.sin(damped * t) / damped
    return scale * ((c + zeta * s) * x + s * v) + force - 1, scale * (-s * x + (c - zeta * s) * v)


def stride(y, v, thrust, on, period):
    """(Y, V) one stride later, from activation to activation, and the highest Y on the way."""
    on, period = w * on, w * period
    t, highest = 0.0, y
    in_air = y > 0 or (y == 0 and v > 0)
    while t < period:
        end, force = (on, thrust) if t < on else (period, 0.0)
        if in_air:
            fall = v + math.sqrt(v * v + 2 * y)
            in_air = t + fall >= end
            time = end - t if in_air else fall
            if v > 0:
                highest = max(highest, y + v * v / 2 if time > v else y + v * time - time * time / 2)
            y, v = (y + v * time - time * time / 2 if in_air else 0.0), v - time
            t = end if in_air else t + time
            continue
        steps = 120
        for i in range(1, steps + 1):
            time = (end - t) * i / steps
            if on_ground(y, v, force, time)[0] > 0:
                low, high = (end - t) * (i - 1) / steps, time
                for _ in range(60):
                    middle = 0.5 * (low + high)
                    if on_ground(y, v, force, middle)[0] > 0:
                        high = middle
                    else:
                        low = middle
                y, v = 0.0, on_ground(y, v, force, high)[1]
                t, in_air = t + high, True
                break
            highest = max(highest, on_ground(y, v, force, time)[0])
        else:
            y, v = on_ground(y, v, force, end - t)
            t = end
    return y, v, highest


def multipliers(jacobian):
    half, det = numpy.trace(jacobian) / 2, numpy.linalg.det(jacobian)
    root = cmath.sqrt(half * half - det)
    return half + root, half - root


def periodic_point(guess, thrust, on, period):
    """Newton's method on the stride; the point and its Jacobian by differences."""
    x = numpy.array(guess, float)
    for _ in range(12):
        image = numpy.array(stride(*x, thrust, on, period)[:2])
        jacobian = numpy.empty((2, 2))
        for c in range(2):
            h = numpy.zeros(2)
            h[c] = 1e-6
            jacobian[:, c] = (numpy.array(stride(*(x + h), thrust, on, period)[:2]) -
                              numpy.array(stride(*(x - h), thrust, on, period)[:2])) / 2e-6
        x = x - numpy.linalg.solve(jacobian - numpy.eye(2), image - x)
    return x, jacobian
