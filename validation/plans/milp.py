"""The plan of `freestand risk --budget` for made-up lists against a mixed-integer program (HiGHS, in scipy).

    pip install scipy
    python3 milp.py path/to/freestand

Each object has a lognormal fragility, a cost of its fall and up to five options. What each option costs and is worth is
taken from the document of the program, so that only the choice is compared: at most one option for each object, the costs
within the budget, the largest net present value.
"""

import csv
import json
import pathlib
import random
import subprocess
import sys
import tempfile

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp

# freestand counts costs in the cents of the file and HiGHS stops at a gap of 1e-9 here: what is left is rounding.
TOLERANCE = 1e-6


def write(path, head, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(head)
        writer.writerows(rows)


def case(program, objects, options, share, seed):
    draw = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        ids = [f"o{i}" for i in range(objects)]
        write(
            folder / "curves.csv",
            ["id", "im", "im_unit", "at", "limit_state", "kind", "median", "beta"],
            [[one, "pga", "g", "ground", "overturns", "lognormal", round(draw.uniform(0.1, 0.8), 3), 0.4] for one in ids],
        )
        write(folder / "hazard.csv", ["pga [g]", "annual_rate"], [[0.02, 0.05], [0.1, 0.01], [0.4, 0.001], [1.0, 1e-4]])
        write(
            folder / "costs.csv",
            ["id", "replacement_cost [EUR]"],
            [[one, draw.randrange(500, 200_000)] for one in ids],
        )
        rows = []
        for one in ids:
            for number in range(draw.randrange(1, options + 1)):
                rows.append([one, f"option {number}", draw.randrange(40, 3000), round(draw.uniform(1.1, 4.0), 2)])
        write(folder / "options.csv", ["id", "option", "cost [EUR]", "median_factor"], rows)
        budget = int(share * sum(row[2] for row in rows))
        asked = [program, "risk", "--fragility", "curves.csv", "--hazard", "hazard.csv", "--inventory", "costs.csv",
                 "--options", "options.csv", "--budget", f"{budget} EUR", "--horizon", "40 yr", "--discount", "3 %", "--json", "-q"]
        told = json.loads(subprocess.run(asked, cwd=folder, capture_output=True, text=True).stdout)
    ranking, plan = told["ranking"], told["plan"]
    value = np.array([row["net_present_value"] for row in ranking])
    cost = np.array([row["cost"] for row in ranking])
    one_each = np.array([[row["id"] == one for row in ranking] for one in ids], dtype=float)
    found = milp(
        -value,
        constraints=[LinearConstraint(cost[None, :], ub=budget), LinearConstraint(one_each, ub=1)],
        integrality=np.ones(len(value)),
        bounds=Bounds(0, 1),
        options={"mip_rel_gap": 1e-9},
    )
    best, own = -found.fun, plan["net_present_value"]
    spent = sum(row["cost"] for row in plan["chosen"])
    assert spent <= budget + TOLERANCE, (spent, budget)
    assert len({row["id"] for row in plan["chosen"]}) == len(plan["chosen"])
    print(f"{objects:4} objects, {len(rows):4} options, budget {budget:7} EUR: {own:14.2f} by freestand, {best:14.2f} by HiGHS")
    assert abs(own - best) <= TOLERANCE * best, (own, best)


def main():
    for objects, options, share, seed in [
        (10, 3, 0.2, 1), (50, 5, 0.05, 2), (100, 5, 0.1, 3), (200, 5, 0.02, 4), (300, 4, 0.15, 5), (500, 3, 0.1, 6), (1000, 3, 0.05, 7),
    ]:
        case(sys.argv[1], objects, options, share, seed)


main()
