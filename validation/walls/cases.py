#!/usr/bin/env python3
"""Makes wall_cases.json: objects between walls, drawn from a seed and solved in 160-bit arithmetic.

    python3 cases.py path/to/objects_ref.py > wall_cases.json      # needs gmpy2; a minute

objects_ref.py is the independent reference of the project (README.md); this file only draws cases, runs it twice for
each (the second time with a motion or a start that is larger by 1e-6) and writes what it says."""
import importlib.util
import json
import math
import os
import random
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
RECORDS = os.path.join(HERE, "..", "rocking", "records")
CHANGE = 1e-6
# One cycle, a decaying sine, sums of sines; those with a second column serve with vertical motion.
PLAIN = ["onesine_T0.4", "onesine_T1.0", "onecosine_T0.8", "decsine_f1.25", "synthfloor", "bench4000"]
BOTH = ["synthfloor_hv"]


def draw(group, rng):
    """The arguments of a case, as flags with numbers in SI."""
    h = round(10 ** rng.uniform(-0.3, 0.5), 3)
    slender = rng.uniform(1.5, 7.0)
    t = round(h / slender, 4)
    alpha = math.atan(t / h)
    case = {"height": h, "thickness": t}
    gap = round(h * rng.uniform(0.05, 1.3) * math.sin(alpha), 4)
    if group in ("left", "low", "elastic", "vertical", "own-r"):
        case["wall-gap-left"] = gap
    if group == "right":
        case["wall-gap-right"] = gap
    if group == "both":
        case["wall-gap-left"] = gap
        case["wall-gap-right"] = round(h * rng.uniform(0.05, 0.9) * math.sin(alpha), 4)
    if group == "touch":
        case["wall-gap-left" if rng.random() < 0.5 else "wall-gap-right"] = 0.0
    if group == "touch-and-near":
        case["wall-gap-left"] = 0.0
        case["wall-gap-right"] = round(h * rng.uniform(0.05, 0.5) * math.sin(alpha), 4)
    if group == "touch-both":
        case["wall-gap-left"] = case["wall-gap-right"] = 0.0
    if group == "tiny":
        case["wall-gap-left"] = 10 ** rng.uniform(-12, -4)
        if rng.random() < 0.5:
            case["wall-gap-right"] = 10 ** rng.uniform(-12, -4)
    if group == "lean":
        for side in ("left", "right"):
            case["wall-gap-" + side] = round(h * rng.uniform(1.05, 1.6) * math.sin(alpha), 4)
        case["wall-restitution"] = round(rng.choice([0.0, rng.uniform(0.0, 0.5)]), 3)
    if group == "low":
        case["wall-height"] = round(h * rng.uniform(0.05, 0.9), 3)
    if group == "elastic":
        case["wall-restitution"] = round(rng.uniform(0.9, 0.99), 4)
    elif "wall-restitution" not in case:
        case["wall-restitution"] = round(rng.choice([0.0, 0.5, rng.uniform(0.0, 0.6)]), 3)
    if group == "own-r":
        case["restitution"] = round(rng.uniform(0.3, 1.0), 4)
    if group == "free":
        case["wall-gap-left"] = gap
        case["wall-gap-right"] = round(gap * rng.uniform(0.3, 1.5), 4)
        reach = min(math.asin(min(case["wall-gap-" + side] / h, 1.0)) for side in ("left", "right"))
        case["initial-rotation"] = round(reach * rng.uniform(-0.95, 0.95), 4)
        case["initial-velocity"] = round(rng.uniform(-1.5, 1.5) * math.sqrt(9.8 / h) * alpha, 4)
        case["duration"] = 8.0
        return case, None
    record = rng.choice(BOTH if group == "vertical" else PLAIN)
    dt, columns = REF.load_csv(os.path.join(RECORDS, record + ".csv"))
    peak = max(abs(a) for a in columns[0])
    strength = rng.uniform(2.5, 6.0) if group == "lean" else rng.uniform(1.1, 2.8)
    case["scale"] = round(strength * 9.80665 * t / h / peak, 4)
    if group == "vertical":
        case["vertical-scale"] = round(rng.uniform(0.2, 0.6) * 9.80665 / max(abs(a) for a in columns[1]), 4)
    return case, record


def solve(case, record, factor):
    h, t = case["height"], case["thickness"]
    walls = dict(gap_left=case.get("wall-gap-left"), gap_right=case.get("wall-gap-right"),
                 hw=case.get("wall-height"), ew=case["wall-restitution"], r=case.get("restitution"))
    if record is None:
        # The base does not move: intervals of 10 ms.
        n = round(case["duration"] / 0.01)
        return REF.simulate(0.01, [0.0] * (n + 1), h, t, theta0=case["initial-rotation"] * factor,
                            w0=case["initial-velocity"] * factor, **walls)
    dt, columns = REF.load_csv(os.path.join(RECORDS, record + ".csv"))
    av = None
    if "vertical-scale" in case:
        av = [a * case["vertical-scale"] for a in columns[1]]
    return REF.simulate(dt, columns[0], h, t, scale=case["scale"] * factor, av=av, **walls)


def number(x):
    return None if x is None else float(x)


def expect(found, case):
    alpha = found["par"]["alpha"]
    final, given = found["final"], "initial-rotation" in case
    if found["overturned"]:
        outcome = "overturned"
    elif found["leaned"]:
        outcome = "leaned"
    else:
        outcome = "rocked" if given or found["t_first_uplift"] is not None else "no-uplift"
    up = found["theta_max"] > 0
    strong = lambda impacts: [dict(time_s=float(t), omega_before_rad_s=float(a), omega_after_rad_s=float(b))
                              for t, a, b in impacts if abs(a) >= 1e-2]
    # Past the balance point and in motion: whether it leans is not defined by the reference.
    open_ = not found["overturned"] and not final["at_wall"] and abs(final["theta"]) >= alpha
    return open_, dict(
        outcome=outcome, peak_rotation_rad=float(found["theta_max"]),
        peak_rotation_time_s=number(found["t_theta_max"]) if up else None,
        overturn_time_s=number(found["t_overturn"]), passed_alpha_time_s=number(found["t_exceed_alpha"]),
        first_uplift_time_s=number(found["t_first_uplift"]),
        wall_angle_left_rad=number(found["wall_angle"][-1]), wall_angle_right_rad=number(found["wall_angle"][1]),
        restitution_ratio=float(found["par"]["r"]), final_rotation_rad=float(final["theta"]),
        impacts_over={"0.01": found["counts"][1e-2]}, wall_impacts_over={"0.01": found["wall_counts"][1e-2]},
        impacts=strong(found["impacts"]), wall_impacts=strong(found["wall_impacts"]))


def amplifications(a, b):
    """The largest relative change of a rotation or velocity, and change of a time [s], over CHANGE; None: another answer."""
    if a["outcome"] != b["outcome"]:
        return None
    peak = max(a["peak_rotation_rad"], 1e-300)
    number_, time = [abs(a["peak_rotation_rad"] - b["peak_rotation_rad"]) / peak,
                     abs(a["final_rotation_rad"] - b["final_rotation_rad"]) / peak], [0.0]
    for key in ("overturn_time_s", "passed_alpha_time_s", "first_uplift_time_s"):
        if (a[key] is None) != (b[key] is None):
            return None
        if a[key] is not None:
            time.append(abs(a[key] - b[key]))
    for key in ("impacts", "wall_impacts"):
        if len(a[key]) != len(b[key]):
            return None
        fastest = max([abs(i["omega_before_rad_s"]) for i in a[key]], default=1.0)
        for x, y in zip(a[key], b[key]):
            time.append(abs(x["time_s"] - y["time_s"]))
            number_.append(abs(x["omega_before_rad_s"] - y["omega_before_rad_s"]) / fastest)
    return max(number_) / CHANGE, max(time) / CHANGE


def args(case, record):
    units = {"height": " m", "thickness": " m", "wall-gap-left": " m", "wall-gap-right": " m", "wall-height": " m",
             "initial-rotation": " rad", "initial-velocity": " rad/s", "duration": " s"}
    out = ["rock"]
    for key, value in case.items():
        out.append(f"--{key}={value!r}{units.get(key, '')}")
    return out + ([] if record is None else ["--motion", "{horizontal}"])


def main():
    rng = random.Random(20261122)
    groups = ["left", "right", "both", "touch", "touch-and-near", "touch-both", "tiny", "lean", "low", "elastic",
              "vertical", "own-r", "free"]
    cases, tries = [], 0
    for group in groups:
        want, made, fallen = (2 if group == "touch-both" else 5), 0, 0
        while made < want and tries < 2000:
            tries += 1
            case, record = draw(group, rng)
            try:
                open_, first = expect(solve(case, record, 1.0), case)
                _, second = expect(solve(case, record, 1.0 + CHANGE), case)
            except RuntimeError as error:
                print(group, case, record, error, file=sys.stderr)
                continue
            found = amplifications(first, second)
            moves = group == "touch-both" or first["wall_impacts_over"]["0.01"] > 0
            # Cases without a wall impact, and those whose answer changes by more than 1e-4, test nothing.
            if open_ or not moves or found is None or found[0] > 100:
                continue
            # Histories that end early test less.
            fallen += first["outcome"] == "overturned"
            if first["outcome"] == "overturned" and fallen > 1:
                continue
            made += 1
            cases.append(dict(id=len(cases), kind="wall", group=group, record=record, args=args(case, record),
                              expect=first, amplification=found[0], time_amplification=found[1], sensitive=False,
                              counts_change=first["impacts_over"] != second["impacts_over"]
                              or first["wall_impacts_over"] != second["wall_impacts_over"]))
            print(len(cases), group, record, first["outcome"], file=sys.stderr)
    readme = dict(
        args="the command line of `freestand`; {horizontal}: column 1 of ../rocking/records/<record>.csv (with "
             "vertical-scale also column 2), in m/s2",
        expect="values in SI. impacts, wall_impacts: those of the first ten whose speed before is 1e-2 rad/s or more; "
               "_over counts all of them by that speed",
        amplification="relative change of rotations and velocities over that of the motion (or of the start)",
        time_amplification="the same for times, in s",
        model="walls at rest with the floor; g = 9.80665 m/s2")
    print(json.dumps(dict(readme=readme, cases=cases), indent=1))


if __name__ == "__main__":
    spec = importlib.util.spec_from_file_location("objects_ref", sys.argv[1])
    REF = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(REF)
    main()
