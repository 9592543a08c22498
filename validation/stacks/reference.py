#!/usr/bin/env python3
"""An independent program for a stack of two bodies on cushions, and the cases made with it.

    python3 reference.py            writes cases.json beside it (about a minute)

It shares no code and no method with freestand: two bodies with an angle each, Runge-Kutta 4 with a
fixed step, and a contact that begins or ends inside a step is not looked for. Needs nothing but
Python.

Model: uniform bodies in the plane; undamped linear cushions k under both corners of the lower body,
and k_i under both corners of the upper one, which is the narrower, normal to the top face of the
lower body; springs of the same stiffness along both faces while a corner is loaded, from the place
where it touched down; no slip. Rotations are positive to the right.
"""
import json
import math
import os
import random

G = 9.80665


def pulse(part, dt, duration):
    """a g sin(2 pi (t - t0)/T) for t0 <= t <= t0 + T, sampled."""
    a, period, start = part
    times = [i * dt - start for i in range(round(duration / dt) + 1)]
    return [a * G * math.sin(2 * math.pi * t / period) if 0 <= t <= period else 0.0 for t in times]


def point(y, body, u, v):
    """A point (u, v) from the centre of gravity, in body axes. Positive rotations turn clockwise."""
    x, z, th = y[6 * body : 6 * body + 3]
    s, c = math.sin(th), math.cos(th)
    return x + u * c + v * s, z - u * s + v * c


def follow(case, substeps, scale=1.0):
    """Largest rotations of both bodies, and of the upper one relative to the lower one."""
    b1, h1, m1, b2, h2, m2 = (case[key] for key in ("b1", "h1", "m1", "b2", "h2", "m2"))
    k, ki = case["k"], case["ki"]
    inertia = (m1 * (b1 * b1 + h1 * h1) / 12, m2 * (b2 * b2 + h2 * h2) / 12)
    record = [scale * a for a in pulse(case["x"], case["dt"], case["duration"])] + [0.0]
    dt = case["dt"] / substeps
    sunk = (m1 + m2) * G / (2 * k)
    y = [0.0, h1 / 2 - sunk, 0.0, 0.0, 0.0, 0.0]
    y += [0.0, h1 + h2 / 2 - sunk - m2 * G / (2 * ki), 0.0, 0.0, 0.0, 0.0]
    base = [(-b1 / 2, -h1 / 2), (b1 / 2, -h1 / 2)]
    top = [(-b2 / 2, -h2 / 2), (b2 / 2, -h2 / 2)]
    anchor = [-b1 / 2, b1 / 2, -b2 / 2, b2 / 2]

    def on_face(y, corner):
        """Place of a corner of the upper body along the top face of the lower one, and its height."""
        x, z = point(y, 1, *corner)
        dx, dz, th = x - y[0], z - y[1], y[2]
        s, c = math.sin(th), math.cos(th)
        return dx * c - dz * s, dx * s + dz * c - h1 / 2

    def rate(y, accel):
        F = [[0.0, -m1 * G, 0.0], [0.0, -m2 * G, 0.0]]

        def push(body, x, z, fx, fz):
            F[body][0] += fx
            F[body][1] += fz
            # Clockwise moment of a force at (x, z).
            F[body][2] += (z - y[6 * body + 1]) * fx - (x - y[6 * body]) * fz

        for index, corner in enumerate(base):
            x, z = point(y, 0, *corner)
            if z < 0:
                push(0, x, z, 0.0 if anchor[index] is None else -k * (x - anchor[index]), -k * z)
        for index, corner in enumerate(top):
            u, v = on_face(y, corner)
            if v < 0:
                fu = 0.0 if anchor[2 + index] is None else -ki * (u - anchor[2 + index])
                fv = -ki * v
                s, c = math.sin(y[2]), math.cos(y[2])
                fx, fz = fu * c + fv * s, -fu * s + fv * c
                x, z = point(y, 1, *corner)
                push(1, x, z, fx, fz)
                push(0, x, z, -fx, -fz)
        out = []
        for body, m in enumerate((m1, m2)):
            out += y[6 * body + 3 : 6 * body + 6]
            out += [F[body][0] / m - accel, F[body][1] / m, F[body][2] / inertia[body]]
        return out

    def places(y):
        below = [point(y, 0, *corner) for corner in base]
        return below + [on_face(y, corner) for corner in top]

    peaks = [0.0, 0.0, 0.0]
    was = places(y)
    for step in range(round(case["duration"] / case["dt"]) * substeps):
        index, inside = divmod(step, substeps)
        a, b = record[index], record[index + 1]
        at = lambda part: a + (inside + part) / substeps * (b - a)
        k1 = rate(y, at(0.0))
        k2 = rate([v + 0.5 * dt * r for v, r in zip(y, k1)], at(0.5))
        k3 = rate([v + 0.5 * dt * r for v, r in zip(y, k2)], at(0.5))
        k4 = rate([v + dt * r for v, r in zip(y, k3)], at(1.0))
        y = [v + dt / 6 * (p + 2 * q + 2 * r + s) for v, p, q, r, s in zip(y, k1, k2, k3, k4)]
        now = places(y)
        for i, ((u0, v0), (u1, v1)) in enumerate(zip(was, now)):
            if v1 >= 0:
                anchor[i] = None
            elif anchor[i] is None:
                part = v0 / (v0 - v1) if v0 > 0 else 1.0
                anchor[i] = u0 + part * (u1 - u0)
        was = now
        peaks = [max(peak, abs(value)) for peak, value in zip(peaks, (y[2], y[8], y[8] - y[2]))]
    return {
        "lower.peak_rotation_rad": peaks[0],
        "upper.peak_rotation_rad": peaks[1],
        "upper.peak_relative_rotation_rad": peaks[2],
    }


def thresholds(case):
    """Upper alone: moments about its corner. Together: those of both about the lower edge."""
    b1, h1, m1, b2, h2, m2 = (case[key] for key in ("b1", "h1", "m1", "b2", "h2", "m2"))
    return min(b2, b1) / h2, (m1 + m2) * b1 / (m1 * h1 + m2 * (2 * h1 + h2))


def args(case):
    given = ["rock", "--base", "compliant"]
    names = [("height", "h1", "m"), ("thickness", "b1", "m"), ("mass", "m1", "kg"), ("stiffness", "k", "N/m"),
             ("upper-height", "h2", "m"), ("upper-thickness", "b2", "m"), ("upper-mass", "m2", "kg"),
             ("interface-stiffness", "ki", "N/m")]
    for flag, key, unit in names:
        given += [f"--{flag}", f"{case[key]} {unit}"]
    return given + ["--motion", "{x}", "--unit", "m/s2", "--dt", f"{case['dt']} s", "--accuracy", "tight"]


def histories():
    random.seed(20261)
    draw = lambda low, high, digits: round(random.uniform(low, high), digits)
    cases = []
    for group in ["upper", "upper", "together", "together", "both", "both", "light", "heavy pedestal"]:
        while True:
            if group in ("upper", "light", "heavy pedestal"):
                h1, b1, h2, b2 = draw(0.5, 0.7, 3), draw(0.6, 0.75, 3), draw(0.7, 1.0, 3), draw(0.2, 0.27, 3)
            elif group == "together":
                h1, b1, h2, b2 = draw(1.0, 1.3, 3), draw(0.3, 0.4, 3), draw(0.25, 0.35, 3), draw(0.24, 0.3, 3)
            else:
                h1, b1, h2, b2 = draw(0.9, 1.2, 3), draw(0.33, 0.4, 3), draw(0.7, 0.9, 3), draw(0.2, 0.26, 3)
            m1 = draw(2000, 4000, 0) if group == "heavy pedestal" else draw(150, 400, 1)
            m2 = round(1e-3 * m1, 4) if group == "light" else draw(30, 120, 1)
            stiffness = lambda m: round(m / 2 * (2 * math.pi * draw(25, 35, 1)) ** 2, -3 if m > 10 else 0)
            case = {"h1": h1, "b1": b1, "m1": m1, "h2": h2, "b2": b2, "m2": m2, "k": stiffness(m1 + m2),
                    "ki": stiffness(m2), "dt": 0.005, "duration": round(0.005 * round(draw(0.3, 0.5, 3) / 0.005), 3)}
            lowest = min(thresholds(case))
            case["x"] = [round(draw(1.3, 1.8, 3) * lowest, 4), draw(0.4, 0.7, 2), 0.0]
            found, coarse, moved = follow(case, 400), follow(case, 200), follow(case, 200, 1 + 1e-4)
            largest = max(found.values())
            converged = max(abs(found[key] - coarse[key]) for key in found) / largest
            amplification = max(abs(moved[key] - coarse[key]) for key in found) / largest / 1e-4
            if 0.01 < largest < 0.15 and converged < 3e-5 and amplification < 30:
                break
        alone, together = thresholds(case)
        expect = found | {"threshold_upper_g": alone, "threshold_together_g": together}
        print(group, found, converged, amplification, flush=True)
        cases.append({"id": len(cases), "group": group, "args": args(case),
                      "pulses": {"dt": case["dt"], "duration_s": case["duration"], "x": case["x"]},
                      "expect": expect, "amplification": amplification, "converged": converged})
    return cases


if __name__ == "__main__":
    here = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(here, "cases.json"), "w") as file:
        json.dump({"readme": "see README.md", "cases": histories()}, file, indent=1)
        file.write("\n")
