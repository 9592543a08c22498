"""rk4.c in Numba, line by line; timed without its compilation."""

import time
from math import cos, fabs, pi, sin

import numba
import numpy as np
from case import REST, read, write

jit = numba.njit(fastmath=False, cache=False)


@jit
def accel(p2, alpha, s, y, u):
    return -p2 * (sin(alpha - y) + s * u * cos(alpha - y))


@jit
def rk4(p2, alpha, s, y, w, u0, u1, h):
    um, half = 0.5 * (u0 + u1), 0.5 * h
    k1 = accel(p2, alpha, s, y, u0)
    w2 = w + half * k1
    k2 = accel(p2, alpha, s, y + half * w, um)
    w3 = w + half * k2
    k3 = accel(p2, alpha, s, y + half * w2, um)
    w4 = w + h * k3
    k4 = accel(p2, alpha, s, y + h * w3, u1)
    return y + h / 6 * (w + 2 * w2 + 2 * w3 + w4), w + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


@jit
def peak(p2, alpha, tan_a, r, u, dt):
    y, w, s, best, moving = 0.0, 0.0, 1.0, 0.0, False
    for k in range(len(u) - 1):
        t, du = 0.0, u[k + 1] - u[k]
        if not moving:
            if fabs(u[k]) > tan_a:
                s = 1.0 if u[k] < 0 else -1.0
            elif fabs(u[k + 1]) > tan_a:
                s = 1.0 if u[k + 1] < 0 else -1.0
                t = (-s * tan_a - u[k]) / du
            else:
                continue
            moving, y, w = True, 0.0, 0.0
        for _ in range(50):
            if not (moving and t < 1):
                break
            y0, w0, u0, h = y, w, u[k] + t * du, (1 - t) * dt
            y, w = rk4(p2, alpha, s, y, w, u0, u[k + 1], h)
            if y >= pi / 2:
                return pi / 2
            best = max(best, y)
            if w0 > 0 and w < 0:
                x = w0 / (w0 - w)
                ux = u0 + x * (u[k + 1] - u0)
                ym, wm = rk4(p2, alpha, s, y0, w0, u0, ux, x * h)
                best = max(best, ym + 0.5 * wm * wm / fabs(accel(p2, alpha, s, ym, ux)))
            if y > 0 or (y == 0 and w >= 0):
                t = 1.0
                break
            lo, hi, x = 0.0, 1.0, y0 / (y0 - y) if y0 > 0 else 0.5
            for _ in range(40):
                y, w = rk4(p2, alpha, s, y0, w0, u0, u0 + x * (u[k + 1] - u0), x * h)
                if y > 0:
                    lo = x
                else:
                    hi = x
                following = x - y / (w * h)
                if not lo < following < hi:
                    following = 0.5 * (lo + hi)
                if fabs(following - x) < 1e-14:
                    break
                x = following
            t += x * (1 - t)
            speed, un = -w * r, u[k] + t * du
            y, s, w = 0.0, -s, speed
            if speed < REST:
                if fabs(un) > tan_a:
                    s, w = (1.0 if un < 0 else -1.0), 0.0
                else:
                    moving = False
        if moving and t < 1:
            moving = False
    return best


@jit
def peaks(p2, alpha, tan_a, r, u, dt):
    out = np.empty(len(p2))
    for i in range(len(p2)):
        out[i] = peak(p2[i], alpha[i], tan_a[i], r[i], u, dt)
    return out


dt, u, p2, alpha, tan_a, r = read()
peaks(p2[:1], alpha[:1], tan_a[:1], r[:1], u[:10], dt)
start = time.perf_counter()
found = peaks(p2, alpha, tan_a, r, u, dt)
write(time.perf_counter() - start, found)
