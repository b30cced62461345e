"""The runner's return map without gravity in stance from the closed forms of its page (section 4), for arrays of
touchdown angles: the air spring's exactly, the linear spring's by Gauss-Legendre quadrature."""
import math

import numpy

from checks import bisect

nodes, weights = numpy.polynomial.legendre.leggauss(48)
g = 9.81


def air_sweep(alpha, stiffness):
    """Sweep of the leg; stiffness c / (m v^2 leg^2), alpha = beta - delta."""
    sine, q = numpy.sin(alpha), numpy.sqrt(stiffness + numpy.sin(alpha) ** 2)
    return 2 * sine / q * numpy.arctan(numpy.cos(alpha) / q)


def linear_sweep(alpha, stiffness):
    """Stiffness k leg^2 / (m v^2) > 1: the turning point by bisection, then an analytic even integrand."""
    alpha = numpy.asarray(alpha, float)
    size, cosine = numpy.sin(abs(alpha)), numpy.cos(alpha)
    low, high = numpy.zeros_like(alpha), numpy.ones_like(alpha)
    for _ in range(60):
        z = 0.5 * (low + high)
        below = z * (2 - z) + stiffness * z ** 2 * (1 - z) ** 2 < cosine ** 2
        low, high = numpy.where(below, z, low), numpy.where(below, high, z)
    zb, xb = 0.5 * (low + high), 1 - 0.5 * (low + high)
    end = 2 * numpy.arcsinh(numpy.sqrt(zb / (2 * xb)))
    u = 0.5 * end[..., None] * (1 + nodes)
    x = xb[..., None] * numpy.cosh(u)
    z = 2 * xb[..., None] * numpy.sinh((end[..., None] + u) / 2) * numpy.sinh((end[..., None] - u) / 2)
    root = size[..., None] ** 2 + stiffness * (xb[..., None] * x) ** 2 * (z + zb[..., None]) / (x + xb[..., None])
    integral = (weights * size[..., None] / (numpy.cosh(u) * numpy.sqrt(root))).sum(-1) * 0.5 * end
    return numpy.sign(alpha) * 2 * integral


class Runner:
    def __init__(self, spring, stiffness, beta, leg):
        self.spring, self.stiffness, self.beta, self.leg = spring, stiffness, beta, leg

    def sweep(self, angle, speed):
        if self.spring == "air":
            return air_sweep(self.beta - angle, self.stiffness / (speed * self.leg) ** 2)
        return linear_sweep(self.beta - angle, self.stiffness * (self.leg / speed) ** 2)

    def stride(self, angle, speed):
        """Next touchdown angle; NaN where the physical rule of section 4 has none, or the body turns back."""
        gravity, sweep = g * self.leg / speed ** 2, self.sweep(angle, speed)
        rise = numpy.sin(self.beta + sweep) - math.sin(self.beta)
        w = 1 - 2 * gravity * rise
        liftoff = angle + math.pi - 2 * self.beta - sweep
        d = w * numpy.sin(liftoff) ** 2 + 2 * gravity * rise
        falls = (w <= 0) | (d < 0) | (numpy.sin(self.beta + sweep) <= 0) | ((rise < 0) & (liftoff <= 0))
        with numpy.errstate(invalid="ignore"):
            forward = numpy.sqrt(w) * numpy.cos(liftoff)
            return numpy.where(falls | (forward <= 0), math.nan, numpy.arctan2(numpy.sqrt(d), forward))

    def gaits(self, speed):
        """(stable candidate, unstable) touchdown angles: where the sweep is pi - 2 beta; () below the fold."""
        angles = numpy.linspace(1e-4, self.beta - 1e-4, 4000)
        excess = self.sweep(angles, speed) - (math.pi - 2 * self.beta)
        change = numpy.flatnonzero(excess[:-1] * excess[1:] < 0)
        return tuple(bisect(lambda a: float(self.sweep(numpy.array([a]), speed)[0]) - (math.pi - 2 * self.beta),
                            angles[i], angles[i + 1]) for i in change)
