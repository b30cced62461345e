"""A ball on a sinusoidal paddle, contacts by scanning and bisection, chatter by the certificate of its page
(sections 2 and 3)."""
import math


def gap(theta, speed, amplitude, t):
    return (speed * t - t * t / 2 +
            amplitude * (2 * math.sin(theta) * math.sin(t / 2) ** 2 + math.cos(theta) * (t - math.sin(t))))


def contact(theta, speed, amplitude):
    """Time of the first contact: the scan's step is far below every flight met here."""
    step = min(0.02, 0.2 * speed) if speed > 0 else 0.02
    t = step if speed > 0 else 0.3  # a release leaves with a triple zero
    while gap(theta, speed, amplitude, t) > 0:
        t += step
        step = min(0.02, 1.5 * step)
    low, high = t - step, t
    for _ in range(60):
        middle = 0.5 * (low + high)
        if gap(theta, speed, amplitude, middle) > 0:
            low = middle
        else:
            high = middle
    return high


def caught_after(theta, speed, amplitude, restitution, most):
    """Impacts until the certificate holds and the time they take; None where it does not within `most`."""
    time = 0.0
    for n in range(1, most + 1):
        t = contact(theta, speed, amplitude)
        rate = (speed - t + amplitude * (math.sin(theta) * math.sin(t) + 2 * math.cos(theta) * math.sin(t / 2) ** 2))
        theta, speed, time = theta + t, max(-restitution * rate, 0.0), time + t
        weight = 1 - amplitude * math.sin(theta)
        if weight > 0 and 16 * amplitude * speed <= ((1 - restitution) * weight) ** 2:
            return n, time
    return None
