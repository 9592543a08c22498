"""Exported fragilities in the programs that they are for: pelicun 3.10.0 and the OpenQuake engine 3.26.2.

    python compare.py PATH_TO_FREESTAND [SEED]

It fits made-up outcomes, exports the curves, runs both programs on the folders as they are, and compares numbers of
damaged objects, losses and probabilities in 50 years with the closed forms. `cargo xtask risk-tools` fetches both
programs and runs it. Another seed makes other outcomes; the seed is printed.
"""

import csv
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

# Both programs evaluate the same functions of the same numbers. pelicun samples each capacity by 10,000 strata, so that
# a share is off by 0.0001 at most; OpenQuake keeps 7 digits, and its sum over a hazard is off by 0.05 %.
TOLERANCE = 0.001

YEARS = 50
SITE = "151.2,-33.9"
ROOT = Path(__file__).resolve().parents[2]


def phi(x, median, beta):
    return 0.5 * math.erfc(-math.log(x / median) / beta / math.sqrt(2.0))


def run(arguments, folder, environment=None):
    done = subprocess.run(arguments, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, arguments))}: status {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Case:
    """One export: its folder, its curves, its objects."""

    def __init__(self, program, folder, name, outcomes, demand, flags=()):
        self.name, self.demand = name, demand
        self.folder = folder / name
        base = [program, "fragility", "--outcomes", outcomes, "--bootstrap", "0", "--demand", demand]
        run([*base, *flags, "--site-coordinates", SITE, "--out", self.folder], folder)
        self.curves = {}
        for row in rows(self.folder / "fragility.csv"):
            curve = (float(row["median"]), float(row["beta"])) if row["kind"] == "lognormal" else None
            self.curves.setdefault(row["id"], {})[row["limit_state"]] = curve

    def closed_form(self, ident):
        """Probabilities of no damage, of exceeding the tolerance only, of overturning."""
        x = float(self.demand.split()[0])
        curves = self.curves[ident]
        overturns = phi(x, *curves["overturns"])
        exceeds = phi(x, *curves["exceeds"]) if "exceeds" in curves else overturns
        return (1.0 - exceeds, exceeds - overturns, overturns)

    def objects(self, tool):
        return json.loads((self.folder / tool / "metadata.json").read_text(encoding="utf-8"))["objects"]


class Checks:
    def __init__(self):
        self.made, self.failed = 0, 0

    def __call__(self, what, found, expected, tolerance=TOLERANCE):
        worst = max(abs(a - b) for a, b in zip(found, expected, strict=True))
        fine = worst <= tolerance
        self.made += 1
        self.failed += not fine
        words = [" ".join(f"{value:.6g}" for value in values) for values in (found, expected)]
        print(f"{'ok    ' if fine else 'FAILED'}  {what}: {words[0]}; closed form {words[1]}")


def pelicun(case):
    """Shares of objects by damage state, and the row of means of the losses."""
    folder = case.folder / "pelicun"
    run([sys.executable, "-m", "pelicun.tools.DL_calculation", "-c", "config.json", "--dirnameOutput", "out"], folder)
    mean = next(row for row in rows(folder / "out/DMG_stats.csv") if row["cmp-loc-dir-ds"] == "mean")
    shares = {}
    for item in case.objects("pelicun"):
        counts = {}
        for name, value in mean.items():
            parts = name.split("-")
            if parts[0] == item["exported_id"]:
                counts[int(parts[3])] = float(value) / item["quantity"]
        # Without a tolerance, overturning is the first damage state.
        has_exceeds = "exceeds" in item["limit_states"]
        exceeds, overturns = (counts.get(1, 0.0), counts.get(2, 0.0)) if has_exceeds else (0.0, counts.get(1, 0.0))
        shares[item["id"]] = (counts.get(0, 0.0), exceeds, overturns)
    summary = folder / "out/DL_summary_stats.csv"
    return shares, next(row for row in rows(summary) if row[""] == "mean")


def openquake(case, job, scratch):
    """Shares of objects by damage state."""
    folder = case.folder / "openquake"
    out = folder / f"out-{job}"
    out.mkdir()
    # OpenQuake keeps a database in its home and looks for updates.
    environment = {**os.environ, "HOME": str(scratch), "OQ_DATADIR": str(scratch), "OQ_DISTRIBUTE": "no"}
    tool = Path(sys.executable).with_name("oq")
    run([tool, "engine", "--run", f"{job}.ini", "--exports", "csv", "-p", f"export_dir={out}"], folder, environment)
    (path,) = (path for path in out.glob("*damages-rlz-*.csv") if "agg" not in path.name)
    items = {item["exported_id"]: item for item in case.objects("openquake")}
    shares = {}
    for row in rows(path):
        item = items[row["asset_id"]]
        names = [f"contents-{state}" for state in ("no_damage", "exceeds", "overturns")]
        shares[item["id"]] = tuple(float(row[name]) / item["quantity"] for name in names)
    return shares


def outcomes(random_, path, heading, centre, objects, motions=30, levels=12, has_tolerance=True):
    """A table of outcomes: in each motion an object has one lognormal capacity for each limit state."""
    lines = [["object", "motion", heading, "outcome"]]
    for ident in objects:
        beta = random_.uniform(0.2, 0.5)
        medians = sorted(centre * math.exp(random_.uniform(-0.8, 0.8)) for _ in range(2))
        for motion in range(motions):
            z = math.exp(beta * random_.gauss(0.0, 1.0))
            for level in range(levels):
                x = centre * 0.15 * (40.0 ** (level / (levels - 1)))
                outcome = "rocked"
                if has_tolerance and x >= medians[0] * z:
                    outcome = "exceeded"
                if x >= medians[1] * z:
                    outcome = "overturned"
                lines.append([ident, f"m{motion}", f"{x:.9g}", outcome])
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(lines)
    return path


def example(program, folder, scratch, check):
    """The tables of examples/risk, with quantities, costs and a hazard curve."""
    tables = ROOT / "examples/risk"
    hazard, inventory = tables / "hazard.csv", tables / "costs.csv"
    flags = ["--format", "pelicun", "--format", "openquake", "--inventory", inventory, "--hazard", hazard]
    case = Case(program, folder, "example", tables / "outcomes.csv", "0.4 m/s", flags)
    shares, losses = pelicun(case)
    scenario = openquake(case, "job_scenario_damage", scratch)
    classical = openquake(case, "job_classical_damage", scratch)
    text = run([program, "risk", "--fragility", case.folder / "fragility.csv", "--hazard", hazard, "--json"], folder)
    rates = {
        one["id"]: {state["limit_state"]: state["annual_rate"] for state in one["limit_states"]}
        for one in json.loads(text)["objects"]
    }
    cost = 0.0
    for row in rows(inventory):
        ident = row["id"]
        expected = case.closed_form(ident)
        check(f"pelicun, example, {ident}", shares[ident], expected)
        check(f"OpenQuake scenario, example, {ident}", scenario[ident], expected)
        chance = [1.0 - math.exp(-YEARS * rates[ident][state]) for state in ("exceeds", "overturns")]
        in_years = (1.0 - chance[0], chance[0] - chance[1], chance[1])
        check(f"OpenQuake classical, example, {ident}, {YEARS} years", classical[ident], in_years)
        prices = float(row["repair_cost [AUD]"]), float(row["replacement_cost [AUD]"])
        cost += float(row["quantity"]) * (expected[1] * prices[0] + expected[2] * prices[1])
    # Relative: the mean of the losses has the errors of the shares.
    check("pelicun, example, repair cost over that of the closed form", [float(losses["repair_cost-"]) / cost], [1.0])


def floors(program, folder, random_, check):
    """Peak floor velocities, one object on the ground floor and two on the third, one without a tolerance."""
    first = outcomes(random_, folder / "pfv.csv", "pfv [m/s]", 0.4, ["a-1", "b/2"])
    second = outcomes(random_, folder / "pfv2.csv", "pfv [m/s]", 0.4, ["rack Ä"], has_tolerance=False)
    with open(first, "a", encoding="utf-8") as file:
        file.writelines(second.read_text(encoding="utf-8").splitlines(keepends=True)[1:])
    inventory = folder / "floors.csv"
    inventory.write_text("id,quantity,floor\na-1,3,0\nb/2,1,3\nrack Ä,20,3\n", encoding="utf-8")
    case = Case(program, folder, "floors", first, "0.35 m/s", ["--format", "pelicun", "--inventory", inventory])
    shares, _ = pelicun(case)
    for ident in case.curves:
        check(f"pelicun, floors, {ident}", shares[ident], case.closed_form(ident))


def ratios(program, folder, random_, check):
    table = outcomes(random_, folder / "ratio.csv", "velocity_ratio", 1.5, ["a", "b"])
    case = Case(program, folder, "ratio", table, "1.4", ["--format", "pelicun"])
    shares, _ = pelicun(case)
    for ident in case.curves:
        check(f"pelicun, velocity_ratio, {ident}", shares[ident], case.closed_form(ident))


def accelerations(program, folder, scratch, random_, check):
    """Peak ground and spectral accelerations, with a power law of the former."""
    both = ["--format", "pelicun", "--format", "openquake"]
    law = ["--hazard-power", "k0=1e-4 /yr, k=2.5, reference=1 g"]
    pga = outcomes(random_, folder / "pga.csv", "pga [g]", 0.4, ["a", "b"])
    sa = outcomes(random_, folder / "sa.csv", "sa(0.5) [g]", 0.8, ["a", "b"])
    cases = [
        Case(program, folder, "pga", pga, "0.5 g", [*both, *law]),
        Case(program, folder, "sa", sa, "0.9 g", both),
    ]
    average = outcomes(random_, folder / "average.csv", "sa_avg(0.2:2) [g]", 0.8, ["a"])
    case = Case(program, folder, "average", average, "0.7 g", ["--format", "openquake"])
    check("OpenQuake scenario, sa_avg, a", openquake(case, "job_scenario_damage", scratch)["a"], case.closed_form("a"))
    for case in cases:
        shares, _ = pelicun(case)
        scenario = openquake(case, "job_scenario_damage", scratch)
        for ident in case.curves:
            expected = case.closed_form(ident)
            check(f"pelicun, {case.name}, {ident}", shares[ident], expected)
            check(f"OpenQuake scenario, {case.name}, {ident}", scenario[ident], expected)
    classical = openquake(cases[0], "job_classical_damage", scratch)
    for ident, curves in cases[0].curves.items():
        # Cornell's closed form.
        both_curves = (curves.get("exceeds", curves["overturns"]), curves["overturns"])
        rates = [1e-4 * m**-2.5 * math.exp(0.5 * (2.5 * b) ** 2) for m, b in both_curves]
        chance = [1.0 - math.exp(-YEARS * rate) for rate in rates]
        expected = (1.0 - chance[0], chance[0] - chance[1], chance[1])
        check(f"OpenQuake classical, pga, {ident}, {YEARS} years", classical[ident], expected)


def points(program, folder, scratch, random_, check):
    """Shares of runs as points, at a level of the table."""
    table = outcomes(random_, folder / "discrete.csv", "pgv [m/s]", 0.4, ["a", "b"])
    listed = rows(table)
    level = sorted({float(row["pgv [m/s]"]) for row in listed})[6]
    flags = ["--format", "pelicun", "--format", "openquake", "--discrete"]
    case = Case(program, folder, "discrete", table, f"{level:.9g} m/s", flags)
    shares, _ = pelicun(case)
    scenario = openquake(case, "job_scenario_damage", scratch)
    for ident in case.curves:
        seen = [row["outcome"] for row in listed if row["object"] == ident and float(row["pgv [m/s]"]) == level]
        # One capacity for each motion: the shares rise.
        shares_seen = [sum(one == name for one in seen) / len(seen) for name in ("rocked", "exceeded", "overturned")]
        check(f"pelicun, points, {ident}", shares[ident], shares_seen)
        check(f"OpenQuake scenario, points, {ident}", scenario[ident], shares_seen)


# Ids as people write them: with spaces, umlauts, slashes, quotation marks, commas or digits at the
# beginning, words that a table reader may take for a missing value or a number, ids of more than 50
# characters that differ only at their end, and ids that become equal when characters are replaced.
UGLY = ["2 racks/Ä", "2_racks__", 'it\'s "new", see #3', "x" * 60, "x" * 60 + "y", "007", "NA", "1e5", "-1", "a.b|c"]


def ugly(program, folder, scratch, random_, check):
    """Ids that one of the programs would refuse, cut off or misread."""
    table = outcomes(random_, folder / "ugly.csv", "pgv [m/s]", 0.4, UGLY)
    case = Case(program, folder, "ugly", table, "0.45 m/s", ["--format", "pelicun", "--format", "openquake"])
    shares, _ = pelicun(case)
    scenario = openquake(case, "job_scenario_damage", scratch)
    for tool in ("pelicun", "openquake"):
        listed = {row["id"]: row["exported_id"] for row in rows(case.folder / tool / "ids.csv")}
        known = {item["id"]: item["exported_id"] for item in case.objects(tool)}
        if listed != known or set(known) != set(UGLY):
            raise SystemExit(f"{tool}: ids.csv has {listed}, metadata.json has {known}")
    for ident in UGLY:
        check(f"pelicun, ugly ids, {ident[:20]}", shares[ident], case.closed_form(ident))
        check(f"OpenQuake scenario, ugly ids, {ident[:20]}", scenario[ident], case.closed_form(ident))


def main():
    program = str(Path(sys.argv[1]).resolve())
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else random.SystemRandom().randrange(2**32)
    print(f"pelicun and OpenQuake compared with the closed forms; seed {seed}")
    random_ = random.Random(seed)
    check = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder, scratch = Path(name), Path(name) / "oqdata"
        scratch.mkdir()
        example(program, folder, scratch, check)
        floors(program, folder, random_, check)
        ratios(program, folder, random_, check)
        accelerations(program, folder, scratch, random_, check)
        points(program, folder, scratch, random_, check)
        ugly(program, folder, scratch, random_, check)
    if check.failed:
        raise SystemExit(f"{check.failed} of {check.made} comparisons failed")
    print(f"{check.made} comparisons, none failed")


if __name__ == "__main__":
    main()
