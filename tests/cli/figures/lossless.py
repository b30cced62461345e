"""The passive hopper with plastic impacts, straight from its page's closed forms (sections 3 and 5): every flight has
one unknown, half its time, on a bracket on which the equation is monotone."""
import math

import numpy

from checks import bisect

points = [0.0] + [bisect(lambda x, k=k: x - k * math.pi - math.atan(x), k * math.pi + 1, (k + 0.5) * math.pi)
                  for k in range(1, 6)]  # alpha*_k


def terms(x):
    sine, cosine = numpy.sin(x), numpy.cos(x)
    return sine, x * cosine - sine, x - sine * cosine


def half_time(eta, speed):
    """x of the first contact after a launch with y1 = 1 + eta."""
    m = math.floor(speed / math.pi)
    lossless = points[m] if m > 0 else 0.0
    if m < 1:
        low, high = 1e-5, math.pi
    elif speed >= lossless or not speed / math.tan(speed) >= 1 + eta:
        low, high = lossless, (m + 1) * math.pi
    else:
        low, high = m * math.pi, speed

    def excess(x):
        sine, _, q = terms(x)
        return (x * x - (1 + eta) * sine * sine) - speed * q
    return bisect(excess, low, high)


def hop(alpha, mass_ratio):
    """Lift-off speed after one return (NaN: stuck) and the number of bounces."""
    mu = mass_ratio / (1 + mass_ratio)
    kappa = mu / (1 + mass_ratio)
    eta, speed, loss, bounces = 0.0, alpha, 0.0, 0
    while True:
        x = half_time(eta, speed)
        sine, p, q = terms(x)
        r = p - eta * sine
        loss += kappa * (2 * p * r / q) ** 2
        eta, speed = eta + 2 * x * sine * r / q, speed - 2 * x + 2 * mu * p * r / q
        if eta <= 0:
            squared = alpha * alpha - loss
            return (math.sqrt(squared) if squared > 0 else math.nan), bounces
        bounces += 1


def branch_slope(alpha, mass_ratio):
    """f and f' on a single-impact branch."""
    kappa = mass_ratio / (1 + mass_ratio) ** 2
    x = half_time(0.0, alpha)
    sine, p, q = terms(x)
    speed = math.sqrt(alpha * alpha - kappa * 4 * p ** 4 / q ** 2)
    return speed, (alpha + 4 * kappa * sine * p * (x + sine * p / q)) / speed


def local_coefficient(k, mass_ratio):
    """C_R of the law beta' = beta - C_R beta^(4/3) to the right; to the left it is ten times that."""
    square = points[k] ** 2
    return mass_ratio / (1 + mass_ratio) ** 2 * points[k] / 8 * (12 * square / (1 + square)) ** (4 / 3)
