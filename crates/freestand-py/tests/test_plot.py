"""Figures: what is drawn is what the results say."""

import subprocess
import sys

import freestand as fs
import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import RECORDS, ROOT
from freestand import plot


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def test_rock(cabinet, floor_motion):
    result = cabinet.rock(floor_motion, history=True)
    ax = result.plot()
    drawn = {line.get_label(): line for line in ax.get_lines()}
    np.testing.assert_array_equal(drawn["rotation / α"].get_ydata(), result.history["theta_rad"] / result.slenderness_angle_rad)
    assert len(drawn[f"impacts ({result.impact_count})"].get_xdata()) == result.impact_count
    assert ax.get_title() == result.outcome
    assert plot.rock(cabinet.rock(floor_motion), ax=ax) is ax


def test_spectra_of_uplift_and_shock():
    motions = fs.read_motions([RECORDS / "synthfloor.csv", RECORDS / "onesine_T0.4.csv"], scale=3)
    table = fs.spectrum(motions, np.linspace(0.5, 3, 9), [0.2, 0.4, 0.8], mass_kg=150, stiffness_n_m=4.38e6)
    ax = plot.srs(table, motion="synthfloor")
    lines = [line for line in ax.get_lines() if line.get_label().endswith(" mm")]
    one = table.to_xarray()["edge_acceleration_g"].sel(motion="synthfloor", thickness_m=0.4).values
    np.testing.assert_array_equal(lines[1].get_ydata(), one)
    assert ax.get_ylabel() == "shock of the edge [g]"
    assert plot.urs(table).get_ylabel() == "uplift [mm]"
    with pytest.raises(fs.BadValue, match="no motion"):
        plot.urs(table, motion="other")
    with pytest.raises(fs.BadValue, match="grid"):
        plot.urs(fs.spectrum(motions, [1], [0.3], pairs=True))


def test_fragility():
    result = fs.fragility(ROOT / "examples/risk/outcomes.csv", bootstrap=0)
    ax = result.plot("cabinet")
    drawn = {line.get_label(): line for line in ax.get_lines() if not line.get_label().startswith("_")}
    curve = result.curve("cabinet", "overturns")
    x, y = drawn["overturns"].get_data()
    # Φ(0) is one half.
    assert np.interp(curve["median"], x, y) == pytest.approx(0.5, abs=2e-3)  # 200 straight pieces
    assert result.probability("cabinet", "overturns", curve["median"])[0] == pytest.approx(0.5, abs=1e-12)
    assert ax.get_xlabel() == "pgv [m/s] of the ground" and ax.get_title() == "cabinet"
    assert plot.fragility(result).get_title() == result.objects[0]["id"]
    with pytest.raises(fs.BadValue, match="no object"):
        plot.fragility(result, "none")


def test_loop_and_response_spectra(floor_motion):
    pad = fs.drop_test([ROOT / "validation/cushion/drop-001.csv"])
    assert "N/mm" in pad.plot().get_legend().get_texts()[-1].get_text()
    spectrum = floor_motion.spectrum()
    np.testing.assert_array_equal(plot.spectrum(spectrum).get_lines()[0].get_ydata(), spectrum.psa_g)
    assert plot.spectrum(floor_motion).get_title() == "synthfloor"
    assert plot.spectrum(fs.code_spectrum()).get_xlabel() == "period [s]"
    assert plot.spectrum(fs.shock_spectrum(floor_motion)).get_xscale() == "log"
    assert floor_motion.plot().get_ylabel() == "acceleration [g]"


def test_plot_needs_no_import_of_its_own():
    """`freestand.plot.urs`, as in the docs, in a process that imports only freestand."""
    subprocess.run([sys.executable, "-c", "import freestand as fs; fs.plot.urs"], check=True)
    with pytest.raises(AttributeError, match="plots"):
        fs.plots
