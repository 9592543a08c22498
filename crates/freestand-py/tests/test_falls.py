"""A fall ranks above every number, in tables, in incremental dynamic analyses and in their fits."""

import json
import subprocess

import freestand as fs
import numpy as np
import pytest
from conftest import FLOOR, ROOT, program

FACTORS = (0.7, 0.9, 1.0, 1.1, 1.4)


@pytest.fixture(scope="module")
def motions():
    motion = fs.read_motion(FLOOR, scale=3.5)
    return [fs.Motion(factor * motion.accel_m_s2, motion.dt_s) for factor in FACTORS]


def test_the_median_of_a_spectrum_ranks_a_fall_above_every_number(motions):
    table = fs.spectrum(motions, [1.2, 1.8], [0.3, 0.5, 0.7], mass_kg=150, stiffness_n_m=4.38e6)
    fallen = (table.column("outcome") == "overturned").reshape(5, 2, 3)
    shock = table.column("edge_acceleration_g").reshape(5, 2, 3)
    # The same by NumPy with infinite shocks, where no rank between a number and a fall is needed.
    ranked = np.sort(np.where(fallen, np.inf, shock), axis=0)
    assert fallen.any() and not fallen.all()
    np.testing.assert_array_equal(table.quantile("edge_acceleration_g"), ranked[2])
    # Over only those that stand, the cabinet that falls under three of five would have a shock.
    survivors = shock[:, 0, 0][~fallen[:, 0, 0]]
    assert fallen[:, 0, 0].sum() == 3 and np.isfinite(np.median(survivors))
    assert np.isinf(table.quantile("edge_acceleration_g")[0, 0])
    # Between a number and a fall there is no number.
    assert np.isinf(table.quantile("uplift_m", 1.0)[fallen.any(axis=0)]).all()


@pytest.mark.parametrize("q", [0.0, 0.16, 0.5, 0.84, 1.0])
def test_quantiles_are_those_of_the_program(q):
    """Linear between the ranks; the examples are those of the test of `freestand run`."""
    for values, expected in (
        ([0.0, 1, 2, 3, 4] + [np.inf] * 5, {0.5: np.inf, 0.16: 1.44}),
        ([0.0, 1, 2, 3, 4] + [np.inf] * 4, {0.5: 4.0, 0.84: np.inf}),
    ):
        table = of_outcomes(values, ["overturned" if np.isinf(value) else "rocked" for value in values])
        if q in expected:
            assert table.quantile("uplift_m", q)[0] == pytest.approx(expected[q], rel=1e-12)


def of_outcomes(values, outcomes):
    rows = [{"motion": f"m{i}", "outcome": outcome, "uplift_m": None if np.isinf(value) else float(value)}
            for i, (value, outcome) in enumerate(zip(values, outcomes))]  # fmt: skip
    table = fs.Table._from_rows(rows)
    return fs.Table(table._columns, ("motion", "object"), (len(rows), 1))


def test_what_is_not_known_is_not_a_number():
    standing = ["rocked"] * 4
    assert of_outcomes([1, 2, 3, 4, 5], [*standing, "leaned"]).quantile("uplift_m", 1.0)[0] == np.inf
    # The unresolved run may be anything: the median lies between 2 and 3, the largest is unknown.
    table = of_outcomes([1, 2, 3, 4, 5], [*standing, "unresolved"])
    assert np.isnan(table.quantile("uplift_m", 1.0)[0]) and np.isnan(table.quantile("uplift_m")[0])
    # Where the others agree, it changes nothing.
    table = of_outcomes([2, 2, 2, 2, 5], [*standing, "unresolved"])
    assert table.quantile("uplift_m")[0] == 2
    for wrong, said in ((("outcome",), "not a number"), (("uplift_m", 1.5), "no share"), (("nothing",), "no column")):
        with pytest.raises(fs.BadValue, match=said):
            table.quantile(*wrong)
    with pytest.raises(fs.BadValue, match="no motions"):
        fs.Table._from_rows([{"id": "a"}]).quantile("id")


def test_ida(motions, tmp_path):
    block = fs.Block(1.8, 0.5, mass_kg=150, stiffness_n_m=4.38e6)
    scales = [0.5, 1, 1.5, 2, 3]
    found = fs.ida(block, motions, scales, tolerance_g=5)
    assert found.motions == [f"motion {i}" for i in range(1, 6)]
    # Each run is that of `rock`.
    row = list(found.runs.rows())[1 * 5 + 2]
    alone = fs.rock(block, motions[1].scale(1.5))
    assert (row["scale_ratio"], row["peak_rotation_rad"]) == (1.5, alone.peak_rotation_rad)
    assert row["intensity"] == pytest.approx(1.5 * motions[1].pga_g, rel=1e-12)
    # Motions that differ by a factor reach a limit state at nearly one intensity, if the scales are close.
    outcome = found.runs.column("outcome").reshape(5, 5)
    assert set(outcome.flat) >= {"no-uplift", "overturned"}
    first = [next((s for s, o in zip(scales, row) if o == "overturned"), np.inf) for row in outcome]
    expected = [s * motion.pga_g for s, motion in zip(first, motions)]
    np.testing.assert_allclose(found.capacities(), expected, rtol=1e-12)
    assert found.quantile("uplift_m")[-1] == np.inf
    # A tolerance divides the runs that rock.
    shock = found.runs.column("shock_g")
    assert (shock[found.runs.column("outcome") == "exceeded"] > 5).all()
    assert (shock[found.runs.column("outcome") == "rocked"] <= 5).all()
    # The fit is that of the command for the same table.
    fit = found.fragility(bootstrap=0)
    table = tmp_path / "outcomes.csv"
    lines = [f"object,{r['motion']},{r['intensity']!r},{r['outcome']}" for r in found.runs.rows()]
    table.write_text("object,motion,pfa [g],outcome\n" + "\n".join(lines) + "\n")
    done = subprocess.run([program(), "fragility", "--outcomes", table, "--bootstrap", "0", "--json", "--quiet"],
                          capture_output=True, text=True, cwd=ROOT, check=True)  # fmt: skip
    assert fit.objects == json.loads(done.stdout)["objects"]
    curve = fit.curve("object", "overturns")
    assert f"median {curve['median']:.4g} g" in repr(fit) and f"beta {curve['beta']:.4g}" in repr(fit)
    assert f"{curve['median']:.4g}" in fit._repr_html_()
    assert [row["median"] for row in fit.curves.rows() if row["limit_state"] == "overturns"] == [curve["median"]]
    assert found.plot().get_xlabel() == "pfa [g] of the floor"


def test_measures_of_ida(motions):
    block = fs.Block(1.8, 0.5)
    one = motions[0]
    bases = {
        "pfa": one.pga_g, "pfv": one.measures()["pgv_m_s"], "sa(0.5)": one.spectrum([0.5]).psa_g[0],
        "acceleration_ratio": one.pga_g / (0.5 / 1.8),
        "velocity_ratio": block.frequency_parameter_rad_s * one.measures()["pgv_m_s"] / (9.80665 * 0.5 / 1.8),
    }  # fmt: skip
    for im, base in bases.items():
        runs = fs.ida(block, one, [1, 2], im=im).runs
        np.testing.assert_allclose(runs.column("intensity"), [base, 2 * base], rtol=1e-12)
    for wrong in ({"im": "pga"}, {"scales": [2, 1]}, {"scales": [0, 1]}, {"tolerance_g": 1}, {"history": True}):
        with pytest.raises(fs.BadValue):
            fs.ida(block, motions, **{"scales": [1, 3], **wrong})


def test_the_cushion_of_ida_is_needed_for_a_tolerance(motions):
    with pytest.raises(fs.BadValue, match="mass_kg"):
        fs.ida(fs.Block(1.8, 0.5), motions, [1, 2], tolerance_g=1)
