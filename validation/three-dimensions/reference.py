#!/usr/bin/env python3
"""An independent program for objects on cushions in three dimensions, and the cases made with it.

    python3 reference.py            writes cases.json and rolling.json beside it (some minutes)
    python3 reference.py walls      writes walls.json (some minutes)

It shares no code and no method with freestand: the rotation is a matrix (nine numbers, brought back
to a rotation after every step), the integration Runge-Kutta 4 with a fixed step, and a contact that
begins or ends inside a step is not looked for; only the place where a foot touches down is found by
a straight line. Needs nothing but Python.

Model: a uniform body, undamped linear cushions k/2 under each corner (2k/48 under each point of a
rim), springs of the same stiffness along the floor while a foot is loaded, from the place where it
touched down; no slip. A wall at x = -t/2 - gap is smooth and taller than the body; every corner of a
prism that is behind it, of the base and of the top, presses on it with k_w/2 and c_w/2, and so do the
points of the two rims of a cylinder that are farthest behind it, with k_w and c_w. x along the thickness, y along the width, z upward.
"""
import json
import math
import os
import random
import sys

G = 9.80665


def pulse(part, dt, duration):
    """a g sin(2 pi (t - t0)/T) for t0 <= t <= t0 + T, sampled."""
    a, period, start = part
    n = round(duration / dt)
    times = [i * dt - start for i in range(n + 1)]
    return [a * G * math.sin(2 * math.pi * t / period) if 0 <= t <= period else 0.0 for t in times]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def gyration(shape, t, w, h):
    if shape == "cylinder":
        r = t / 2
        return ((3 * r * r + h * h) / 12,) * 2 + (r * r / 2,)
    return ((w * w + h * h) / 12, (t * t + h * h) / 12, (t * t + w * w) / 12)


def feet(shape, t, w, h):
    if shape == "cylinder":
        ring = [2 * math.pi * i / 48 for i in range(48)]
        return [(t / 2 * math.cos(a), t / 2 * math.sin(a), -h / 2) for a in ring], 2 / 48
    return [(sx * t / 2, sy * w / 2, -h / 2) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))], 0.5


def orthonormal(R):
    """The rows of a matrix that is almost a rotation: one Newton step towards the nearest one."""
    T = [sum(R[3 * i + k] * R[3 * j + k] for k in range(3)) for i in range(3) for j in range(3)]
    C = [(1.5 if i == j else 0.0) - 0.5 * T[3 * i + j] for i in range(3) for j in range(3)]
    return [sum(C[3 * i + k] * R[3 * k + j] for k in range(3)) for i in range(3) for j in range(3)]


def follow(case, substeps, scale=1.0):
    """Largest tilt, its time and both tilts at the end."""
    t, w, h, m, k = (case[key] for key in ("thickness", "width", "height", "mass", "stiffness"))
    gap = case.get("wall_gap")
    k_wall = case.get("wall_stiffness", 0.0)
    c_wall = 2 * case.get("wall_damping", 0.0) * math.sqrt(k_wall * m)
    corners = [(sx * t / 2, sy * w / 2, sz * h / 2) for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]
    # How often the base and the top begin to press on the wall.
    struck, pressing = [0, 0], set()
    points, share = feet(case["shape"], t, w, h)
    ke = share * k
    J = [m * g2 for g2 in gyration(case["shape"], t, w, h)]
    dt_rec, duration = case["dt"], case["duration"]
    record = [[scale * a for a in pulse(case[axis], dt_rec, duration)] if case.get(axis) else None for axis in "xyz"]
    dt = dt_rec / substeps
    steps = round(duration / dt_rec) * substeps
    # State: place and velocity of the centre of gravity, R row by row, spin in body axes.
    y = [0.0, 0.0, h / 2 - m * G / (2 * k)] + [0.0] * 3 + [1.0, 0, 0, 0, 1.0, 0, 0, 0, 1.0] + [0.0] * 3
    anchor = [(px, py) for px, py, _ in points]

    def place(y, p):
        return [y[i] + y[6 + 3 * i] * p[0] + y[7 + 3 * i] * p[1] + y[8 + 3 * i] * p[2] for i in range(3)]

    def behind(y):
        """The points that may be behind the wall: number, from the centre of gravity, depth, share of k_w."""
        if gap is None:
            return []
        if case["shape"] == "cylinder":
            # The rim reaches farthest to -x in the direction of the part of x across the axis.
            axis = (y[8], y[11], y[14])
            across = [(1.0 if i == 0 else 0.0) - axis[0] * axis[i] for i in range(3)]
            size = math.sqrt(sum(v * v for v in across))
            arms = [[s * h / 2 * axis[i] - t / 2 * across[i] / size for i in range(3)] for s in (-1, 1)]
            share = 1.0
        else:
            arms = [[y[6 + 3 * i] * p[0] + y[7 + 3 * i] * p[1] + y[8 + 3 * i] * p[2] for i in range(3)]
                    for p in corners]
            share = 0.5
        return [(i, arm, -t / 2 - gap - y[0] - arm[0], share) for i, arm in enumerate(arms)]

    def rate(y, accel):
        R, spin = y[6:15], y[15:18]
        F, M = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
        for index, p in enumerate(points):
            at = place(y, p)
            if at[2] >= 0 or anchor[index] is None:
                # A foot that has just touched down has its anchor from the end of this step on.
                n = -ke * at[2] if at[2] < 0 else 0.0
                f = (0.0, 0.0, n)
            else:
                ax, ay = anchor[index]
                f = (-ke * (at[0] - ax), -ke * (at[1] - ay), -ke * at[2])
            if f[2] or f[0] or f[1]:
                arm = (at[0] - y[0], at[1] - y[1], at[2] - y[2])
                torque = cross(arm, f)
                for i in range(3):
                    F[i] += f[i]
                    M[i] += torque[i]
        # Angular velocity in floor axes, for the speed of the points at the wall.
        omega = [R[3 * i] * spin[0] + R[3 * i + 1] * spin[1] + R[3 * i + 2] * spin[2] for i in range(3)]
        for _, arm, depth, share in behind(y):
            if depth > 0:
                nearing = -(y[3] + omega[1] * arm[2] - omega[2] * arm[1])
                f = (max(0.0, share * (k_wall * depth + c_wall * nearing)), 0.0, 0.0)
                torque = cross(arm, f)
                F[0] += f[0]
                M = [M[i] + torque[i] for i in range(3)]
        body = [R[i] * M[0] + R[3 + i] * M[1] + R[6 + i] * M[2] for i in range(3)]
        Js = (J[0] * spin[0], J[1] * spin[1], J[2] * spin[2])
        gyro = cross(spin, Js)
        out = list(y[3:6]) + [F[0] / m - accel[0], F[1] / m - accel[1], F[2] / m - G - accel[2]]
        for i in range(3):
            row = R[3 * i : 3 * i + 3]
            # R' = R [spin]x
            out += [row[1] * spin[2] - row[2] * spin[1], row[2] * spin[0] - row[0] * spin[2],
                    row[0] * spin[1] - row[1] * spin[0]]
        return out + [(body[i] - gyro[i]) / J[i] for i in range(3)]

    def accel_at(step, part):
        index, inside = divmod(step, substeps)
        s = (inside + part) / substeps
        return [0.0 if one is None else one[index] + s * (one[min(index + 1, len(one) - 1)] - one[index])
                for one in record]

    def tilt(y):
        return math.atan2(math.hypot(y[8], y[11]), y[14])

    peak, peak_time = 0.0, 0.0
    height = [place(y, p)[2] for p in points]
    for step in range(steps):
        a0, a1, a2 = accel_at(step, 0.0), accel_at(step, 0.5), accel_at(step, 1.0)
        k1 = rate(y, a0)
        k2 = rate([v + 0.5 * dt * r for v, r in zip(y, k1)], a1)
        k3 = rate([v + 0.5 * dt * r for v, r in zip(y, k2)], a1)
        k4 = rate([v + dt * r for v, r in zip(y, k3)], a2)
        before = y
        y = [v + dt / 6 * (p + 2 * q + 2 * r + s) for v, p, q, r, s in zip(y, k1, k2, k3, k4)]
        y[6:15] = orthonormal(y[6:15])
        for index, p in enumerate(points):
            at = place(y, p)
            if at[2] >= 0:
                anchor[index] = None
            elif anchor[index] is None:
                was = place(before, p)
                part = was[2] / (was[2] - at[2]) if was[2] > 0 else 1.0
                anchor[index] = (was[0] + part * (at[0] - was[0]), was[1] + part * (at[1] - was[1]))
        for index, arm, depth, _ in behind(y):
            if depth <= 0:
                pressing.discard(index)
            elif index not in pressing:
                pressing.add(index)
                struck[0 if (index % 2 == 0) else 1] += 1
        now = tilt(y)
        if now > peak:
            peak, peak_time = now, (step + 1) * dt
    return {
        "peak_tilt_rad": peak,
        "peak_tilt_time_s": peak_time,
        "final_tilt_x_rad": math.atan2(y[8], y[14]),
        "final_tilt_y_rad": math.atan2(y[11], y[14]),
        "struck": struck,
    }


def solved(case, keys, substeps, is_wanted):
    """Answers with half the step, how far they are from those of the step, and the amplification."""
    coarse = follow(case, substeps)
    if not is_wanted(coarse):
        return None
    fine = follow(case, 2 * substeps)
    by = 1e-4
    moved = follow(case, substeps, 1 + by)
    largest = max(abs(fine[key]) for key in keys)
    converged = max(abs(fine[key] - coarse[key]) for key in keys) / largest
    amplification = max(abs(moved[key] - coarse[key]) for key in keys) / largest / by
    return fine, converged, amplification


def args(case):
    number = lambda key, unit: f"{case[key]} {unit}"
    given = ["rock", "--base", "compliant", "--height", number("height", "m"), "--thickness", number("thickness", "m")]
    given += ["--shape", "cylinder"] if case["shape"] == "cylinder" else ["--width", number("width", "m")]
    given += ["--mass", number("mass", "kg"), "--stiffness", number("stiffness", "N/m"), "--motion", "{x}"]
    given += ["--motion-y", "{y}"] if case.get("y") else []
    given += ["--vertical", "{z}"] if case.get("z") else []
    if "wall_gap" in case:
        given += ["--wall-gap-left", number("wall_gap", "m"), "--wall-stiffness", number("wall_stiffness", "N/m")]
        given += ["--wall-damping", str(case["wall_damping"])]
    return given + ["--unit", "m/s2", "--dt", f"{case['dt']} s", "--accuracy", "tight"]


def histories():
    random.seed(20260)
    draw = lambda low, high, digits: round(random.uniform(low, high), digits)
    for number, group in enumerate(["plane", "diagonal", "oblique", "rectangle", "rectangle", "two periods", "vertical", "cylinder"]):
        while True:
            height, ratio = draw(1.2, 2.2, 2), draw(0.22, 0.32, 2)
            t = round(ratio * height, 3)
            w = t if group in ("diagonal", "oblique", "cylinder") else round(draw(1.1, 1.6, 2) * t, 3)
            mass = draw(100, 500, 1)
            # Cushions of 25 to 40 Hz under the weight.
            stiffness = round(mass / 2 * (2 * math.pi * draw(25, 40, 1)) ** 2, -3)
            period = draw(0.35, 0.55, 2)
            over = lambda: draw(1.3, 1.7, 3)
            x = [round(over() * t / height, 4), period, 0.0]
            y = [round(over() * w / height, 4), draw(0.35, 0.55, 2) if group == "two periods" else period, 0.0]
            if group == "two periods":
                y[2] = 0.1
            if group == "diagonal":
                y = list(x)
            if group in ("oblique", "cylinder"):
                y[0] = round(0.7 * x[0], 4)
            case = {"shape": "cylinder" if group == "cylinder" else "prism", "height": height, "thickness": t,
                    "width": w, "mass": mass, "stiffness": stiffness, "dt": 0.005,
                    "duration": round(0.2 * round((period + 0.25) / 0.2), 3), "x": x}
            if group != "plane":
                case["y"] = y
            if group == "vertical":
                case["z"] = [0.3, 0.25, 0.0]
            keys = ("peak_tilt_rad", "final_tilt_x_rad", "final_tilt_y_rad")
            substeps = 40 if group == "cylinder" else 80
            # It rocks, is far from falling, and two steps agree five times better than the test asks.
            is_wanted = lambda found: 0.02 < found["peak_tilt_rad"] < 0.8 * math.atan(t / height)
            answer = solved(case, keys, substeps, is_wanted)
            if answer and answer[1] < 6e-5 and answer[2] < 30:
                break
        found, converged, amplification = answer
        found.pop("struck")
        pulses = {"dt": case["dt"], "duration_s": case["duration"]} | {a: case[a] for a in "xyz" if case.get(a)}
        expect = {"outcome": "rocked"} | found | {"threshold_x_g": t / height, "threshold_y_g": w / height}
        print(group, found["peak_tilt_rad"], converged, amplification, flush=True)
        yield {"id": number, "group": group, "args": args(case), "pulses": pulses, "expect": expect,
               "amplification": amplification, "converged": converged}


def walls():
    """Histories at a wall: its top strikes it, in a plane its base too."""
    random.seed(20261)
    draw = lambda low, high, digits: round(random.uniform(low, high), digits)
    groups = [("plane", 0.0), ("plane", 0.2), ("oblique", 0.2), ("cylinder", 0.2), ("cylinder", 0.2)]
    before = "plane"
    for number, (group, damping) in enumerate(groups):
        if group != before:
            random.seed(1)
            before = group
        while True:
            height, ratio = draw(1.2, 2.2, 2), draw(0.22, 0.32, 2)
            t = round(ratio * height, 3)
            w = t if group == "cylinder" else round(draw(1.1, 1.6, 2) * t, 3)
            mass = draw(100, 500, 1)
            stiffness = round(mass / 2 * (2 * math.pi * draw(25, 40, 1)) ** 2, -3)
            period = draw(0.35, 0.55, 2)
            # The first half throws it against the wall.
            x = [round(draw(1.3, 1.7, 3) * t / height, 4), period, 0.0]
            case = {"shape": "cylinder" if group == "cylinder" else "prism", "height": height, "thickness": t,
                    "width": w, "mass": mass, "stiffness": stiffness, "dt": 0.005,
                    "duration": round(0.2 * round((period + 0.25) / 0.2), 3), "x": x,
                    "wall_gap": draw(0.0, 0.02 if group == "plane" else 0.01, 4), "wall_damping": damping,
                    "wall_stiffness": round(draw(1, 3, 1) * stiffness, -3)}
            if group in ("oblique", "cylinder"):
                case["y"] = [round(0.6 * x[0] * w / t, 4), period, 0.0]
            keys = ("peak_tilt_rad", "final_tilt_x_rad", "final_tilt_y_rad")
            substeps = 40 if case["shape"] == "cylinder" else 80
            # Under two components the top alone strikes it in almost all that were drawn.
            struck_by = min if group == "plane" else max
            is_wanted = lambda found: (0.01 < found["peak_tilt_rad"] < 0.8 * math.atan(t / height)
                                       and struck_by(found["struck"]) > 0)
            # Coarse steps tell most of those that are not wanted.
            if not is_wanted(follow(case, 10)):
                continue
            answer = solved(case, keys, substeps, is_wanted)
            if answer and answer[1] < 6e-5 and answer[2] < 30:
                break
        found, converged, amplification = answer
        struck = found.pop("struck")
        pulses = {"dt": case["dt"], "duration_s": case["duration"]} | {a: case[a] for a in "xy" if case.get(a)}
        print(group, found["peak_tilt_rad"], struck, converged, amplification, flush=True)
        yield {"id": number, "group": f"{group}, damping {damping}", "args": args(case), "pulses": pulses,
               "expect": {"outcome": "rocked"} | found, "struck": struck,
               "amplification": amplification, "converged": converged}


def rolling_rates(a, h, theta):
    """Steady rolling of a cylinder at the tilt theta: round its rim with the centre of gravity at rest,
    and wobbling in place. The equation of moments with rho = 0, n = W (c/a) sin(theta), and with
    n = -W (1 - cos(theta)), rho = a (1 - cos(theta)) + c sin(theta), solved for W (per unit mass)."""
    c, s, co = h / 2, math.sin(theta), math.cos(theta)
    axial, across = a * a / 2, (3 * a * a + h * h) / 12
    moment = G * (a * co - c * s)
    still = moment / (s * (across * co - axial * (c / a) * s))
    rho = a * (1 - co) + c * s
    wobble = moment / (s * (axial * (1 - co) + across * co) + rho * (c * co + a * s))
    return math.sqrt(still), math.sqrt(wobble)


def stays(a, h, theta, rate, spin, time=0.3, dt=1e-3):
    """Largest change of the tilt of a rigid cylinder that rolls without slip from this state, by the
    equations of motion in axes that precess with it. They know nothing of steady motion: theta,
    precession and spin are integrated, and a steady state must stay."""
    c, axial, across = h / 2, a * a / 2, (3 * a * a + h * h) / 12

    def state_rate(y):
        th, dth, w, n = y
        s, co = math.sin(th), math.cos(th)
        # Axes along the node, across it in the plane of the base, and along the axis of the cylinder.
        # Body rates (dth, w s, n) with n the whole spin about the axis; v = omega x r with
        # r = (0, a, c) from the contact to the centre of gravity.
        # Newton: m(dv/dt + W x v) = F, dL/dt + W x L = -r x F, W = (dth, w s, w co) rotates the axes.
        # Solved for (ddth, d(w s), dn) as a linear system.
        p, q, r3 = dth, w * s, n
        v = (q * c - r3 * a, -p * c, p * a)
        W = (dth, w * s, w * co)
        g = (0.0, -G * s, -G * co)
        # Unknown x = (p', q', r'): dv/dt = (q' c - r' a, -p' c, p' a).
        Wv = cross(W, v)
        F0 = [Wv[i] - g[i] for i in range(3)]
        L = (across * p, across * q, axial * r3)
        WL = cross(W, L)
        r = (0.0, a, c)
        rF0 = cross(r, F0)
        # A: dL/dt + r x dv/dt.
        A11 = across + a * a + c * c
        A22, A23, A32, A33 = across + c * c, -a * c, -a * c, axial + a * a
        b = [-WL[i] - rF0[i] for i in range(3)]
        dp = b[0] / A11
        det = A22 * A33 - A23 * A32
        dq = (b[1] * A33 - A23 * b[2]) / det
        dn = (A22 * b[2] - A32 * b[1]) / det
        dw = (dq - w * co * dth) / s
        return [dth, dp, dw, dn]

    y, worst = [theta, 0.0, rate, spin], 0.0
    for _ in range(round(time / dt)):
        k1 = state_rate(y)
        k2 = state_rate([v + dt / 2 * k for v, k in zip(y, k1)])
        k3 = state_rate([v + dt / 2 * k for v, k in zip(y, k2)])
        k4 = state_rate([v + dt * k for v, k in zip(y, k3)])
        y = [v + dt / 6 * (p + 2 * q + 2 * r + s) for v, p, q, r, s in zip(y, k1, k2, k3, k4)]
        worst = max(worst, abs(y[0] - theta))
    return worst


def rolling():
    found = []
    for a, h, theta in [(0.2, 1.0, 0.15), (0.2, 1.0, 0.05), (0.15, 0.9, 0.15), (0.25, 1.0, 0.1), (0.3, 1.5, 0.05)]:
        still, wobble = rolling_rates(a, h, theta)
        spins = [still * (h / 2 / a) * math.sin(theta), -wobble * (1 - math.cos(theta))]
        drift = max(stays(a, h, theta, rate, spin) for rate, spin in zip((still, wobble), spins))
        assert drift < 1e-9, drift
        # A state that is not steady does not stay.
        assert stays(a, h, theta, 1.01 * still, spins[0]) > 1e-4
        row = {"radius_m": a, "height_m": h, "tilt_rad": theta, "still_rad_s": still, "wobble_rad_s": wobble}
        print(row, flush=True)
        found.append(row)
    return found


def write(name, found):
    """All cases so far, after each of them."""
    cases = []
    for case in found:
        cases.append(case)
        with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), name), "w") as file:
            json.dump({"readme": "see README.md", "cases": cases}, file, indent=1)
            file.write("\n")


if __name__ == "__main__":
    if sys.argv[1:] == ["walls"]:
        write("walls.json", walls())
        sys.exit()
    write("rolling.json", rolling())
    write("cases.json", histories())
