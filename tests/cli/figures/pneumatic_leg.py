"""A hop of the pneumatic hopper by classical Runge-Kutta in the regularised time of its page (section 3), knowing
nothing of the program: touchdown speed to touchdown speed."""
import math

thrust, thrust_time, friction, gravity, height = 41.86, 0.01, 2.33, 10.0, 0.5  # Fig. 12


def step(log_height, speed, spring, h):
    def rate(l, v):
        u = math.exp(l)
        return v, spring - friction * u * v - gravity * u
    a = rate(log_height, speed)
    b = rate(log_height + h / 2 * a[0], speed + h / 2 * a[1])
    c = rate(log_height + h / 2 * b[0], speed + h / 2 * b[1])
    d = rate(log_height + h * c[0], speed + h * c[1])
    return (log_height + h / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0]),
            speed + h / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1]))


def advance(log_height, speed, spring, is_over, h=2e-3):
    """Steps until `is_over`, whose instant is found by shrinking the last step."""
    while True:
        there = step(log_height, speed, spring, h)
        if not is_over(*there):
            log_height, speed = there
            continue
        low, high = 0.0, h
        for _ in range(50):
            middle = 0.5 * (low + high)
            if is_over(*step(log_height, speed, spring, middle)):
                high = middle
            else:
                low = middle
        return step(log_height, speed, spring, high)


def hop(stiffness, speed):
    bottom, _ = advance(math.log(height), -speed, stiffness, lambda l, v: v >= 0)
    e1 = (1 - math.exp(-friction * thrust_time)) / friction
    chi = math.exp(bottom) + (thrust - gravity) * (thrust_time - e1) / friction
    log_height, speed = advance(math.log(chi), (thrust - gravity) * e1, thrust * chi,
                                lambda l, v: l >= math.log(height) or v <= 0)
    return speed if log_height >= math.log(height) else math.nan


def multiplier(stiffness, speed):
    """The map's slope at the fixed point next to a speed, and that point."""
    for _ in range(6):
        h = 1e-4
        slope = (hop(stiffness, speed + h) - hop(stiffness, speed - h)) / (2 * h)
        speed -= (hop(stiffness, speed) - speed) / (slope - 1)
    return slope, speed
