"""scipy.integrate.solve_ivp (RK45) with events for landings and overturning; rest is skipped."""

import time

import numpy as np
from case import REST, read, write
from scipy.integrate import solve_ivp

RTOL, ATOL = 1e-8, 1e-11


def peak(p2, alpha, tan_a, r, u, dt):
    times = dt * np.arange(len(u))
    end, t, best = times[-1], 0.0, 0.0
    landing = lambda _, state: state[0]
    landing.terminal, landing.direction = True, -1
    fallen = lambda _, state: state[0] - np.pi / 2
    fallen.terminal, fallen.direction = True, 1
    turning = lambda _, state: state[1]
    turning.direction = -1
    state, s = None, 1.0
    while t < end:
        if state is None:  # the next crossing of the threshold
            now = np.interp(t, times, u)
            if abs(now) > tan_a:
                s = -np.sign(now)
            else:
                k = np.flatnonzero((np.abs(u) > tan_a) & (times > t))
                if len(k) == 0:
                    break
                k = k[0]
                s = -np.sign(u[k])
                from_t, from_u = max(times[k - 1], t), max(k - 1, 0)
                from_u = np.interp(from_t, times, u)
                t = from_t + (times[k] - from_t) * (-s * tan_a - from_u) / (u[k] - from_u)
            # A start on the floor, a little above it so that the landing is not seen at once.
            state = [1e-14, 0.0]

        def slope(at, state):
            phi = alpha - state[0]
            return [state[1], -p2 * (np.sin(phi) + s * np.interp(at, times, u) * np.cos(phi))]

        done = solve_ivp(
            slope, (t, end), state, rtol=RTOL, atol=ATOL, max_step=dt, events=(landing, fallen, turning)
        )
        best = max([best, *done.y[0], *(y[0] for y in done.y_events[2])])
        if len(done.t_events[1]):
            return np.pi / 2
        t = done.t[-1]
        if len(done.t_events[0]) == 0:
            break
        speed = -done.y[1, -1] * r
        state = [1e-14, speed] if speed > max(REST, 1e-4) else None
        s = -s
        if state is None and t == done.t[0]:
            t += 1e-9
    return best


dt, u, p2, alpha, tan_a, r = read()
start = time.perf_counter()
found = [peak(*block, u, dt) for block in zip(p2, alpha, tan_a, r)]
write(time.perf_counter() - start, found)
