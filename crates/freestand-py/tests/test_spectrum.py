"""Grids of objects: the rows of the command as Arrow, NumPy, pandas and xarray."""

import pickle

import freestand as fs
import numpy as np
import pyarrow
import pytest
from conftest import RECORDS, told

HEIGHTS = np.array([0.5, 0.9, 1.3, 1.7, 2.1, 2.5, 3.0])
THICKNESSES = np.array([0.15, 0.3, 0.45, 0.6, 0.8, 1.0])


def listed(lengths_m):
    return ", ".join(f"{length_m} m" for length_m in lengths_m.tolist())


FLAGS = ["--heights", listed(HEIGHTS), "--thicknesses", listed(THICKNESSES)]
SHOCK = {"mass_kg": 150, "stiffness_n_m": 4.38e6}


@pytest.fixture(scope="module")
def motions():
    return fs.read_motions([RECORDS / "synthfloor.csv", RECORDS / "onesine_T0.4.csv"], scale=3)


@pytest.fixture(scope="module")
def table(motions):
    return fs.spectrum(motions, HEIGHTS, THICKNESSES, **SHOCK)


@pytest.fixture(scope="module")
def document():
    records = ["--motion", RECORDS / "synthfloor.csv", RECORDS / "onesine_T0.4.csv", "--scale", 3]
    return told("spectrum", *records, *FLAGS, "--mass", "150 kg", "--stiffness", "4380 N/mm")


def test_rows_equal_the_command(table, document):
    assert list(table.rows()) == document["rows"]
    outcomes = set(table.column("outcome"))
    assert {"no-uplift", "rocked", "overturned"} <= outcomes
    assert table.warnings == document["warnings"][-len(table.warnings) :]
    assert table.timing["block_steps"] == document["timing"]["block_steps"]


def test_columns_are_views(table):
    uplift = table.column("uplift_m")
    assert uplift.dtype == np.float64 and uplift.shape == (len(table),) and not uplift.flags.owndata
    assert table["impact_count"].dtype == np.int64
    missing = np.isnan(table["edge_acceleration_g"])
    assert (missing == (table["outcome"] == "overturned")).all() and missing.any()
    with pytest.raises(fs.BadValue, match="no column"):
        table.column("uplift")


def test_arrow_takes_it_without_a_copy(table, document):
    taken = pyarrow.table(table)
    assert taken.to_pylist() == document["rows"]
    assert taken.column("edge_acceleration_g").null_count == int(np.isnan(table["edge_acceleration_g"]).sum())
    address = taken.column("uplift_m").chunk(0).buffers()[1].address
    assert address == table.column("uplift_m").ctypes.data
    # A second reader gets a stream of its own, and the data outlive the table.
    again = pyarrow.table(fs.spectrum(_wave(), [1.0], [0.3]))
    assert again.num_rows == 1 and again.to_pylist()[0]["height_m"] == 1.0


def _wave(name=None):
    return fs.Motion(6 * np.sin(np.arange(300) * 0.05), 0.01, name)


def test_pandas(table):
    frame = table.to_pandas()
    assert len(frame) == len(table) and frame["outcome"].dtype == "category"
    assert frame["uplift_m"].to_numpy() == pytest.approx(table["uplift_m"], abs=0)


def test_polars(table):
    polars = pytest.importorskip("polars", reason="polars is not installed")
    frame = polars.DataFrame(table)
    assert frame.columns == table.column_names
    assert frame["uplift_m"].to_list() == table["uplift_m"].tolist()
    assert frame["edge_acceleration_g"].null_count() == int(np.isnan(table["edge_acceleration_g"]).sum())


def test_duckdb(table):
    duckdb = pytest.importorskip("duckdb", reason="duckdb is not installed")
    rows = duckdb.connect().register("rows", table)
    rocked = rows.sql("SELECT count(*), max(uplift_m) FROM rows WHERE outcome = 'rocked'")
    is_rocked = table["outcome"] == "rocked"
    assert rocked.fetchall() == [(int(is_rocked.sum()), table["uplift_m"][is_rocked].max())]


def test_xarray_has_the_grid_and_the_units(table):
    dataset = table.to_xarray()
    assert dict(dataset.sizes) == {"motion": 2, "height_m": 7, "thickness_m": 6}
    assert dataset["edge_acceleration_g"].attrs["units"] == "g"
    one = dataset["uplift_m"].sel(motion="synthfloor").isel(height_m=3, thickness_m=2).item()
    row = next(r for r in table.rows() if r["motion"] == "synthfloor" and r["height_m"] == HEIGHTS[3] and r["thickness_m"] == THICKNESSES[2])
    assert one == row["uplift_m"]


def test_pairs_are_one_object_each(motions, table):
    heights, thicknesses = HEIGHTS[:6], THICKNESSES
    pairs = fs.spectrum(motions, heights, thicknesses, pairs=True, **SHOCK)
    assert len(pairs) == 12
    diagonal = table.to_xarray()["uplift_m"].values[:, range(6), range(6)]
    np.testing.assert_array_equal(pairs["uplift_m"].reshape(2, 6), diagonal)
    assert dict(pairs.to_xarray().sizes) == {"motion": 2, "object": 6}
    with pytest.raises(fs.BadValue, match="pairs"):
        fs.spectrum(motions, [1, 2], [0.3], pairs=True)


def test_results_do_not_depend_on_threads(motions, table):
    for threads in (1, 2, 3):
        again = fs.spectrum(motions, HEIGHTS, THICKNESSES, threads=threads, **SHOCK)
        assert list(again.rows()) == list(table.rows())
    for wrong in (0, -1, 1.5, "2", True):
        with pytest.raises(fs.BadValue, match="threads"):
            fs.spectrum(motions, HEIGHTS, THICKNESSES, threads=wrong)


def test_options_equal_flags(motions):
    records = ["--motion", RECORDS / "synthfloor.csv", RECORDS / "onesine_T0.4.csv", "--scale", 3]
    for flags, options in [
        (["--restitution", 0.7, "--accuracy", "fast"], {"restitution": 0.7, "accuracy": "fast"}),
        (["--sensitivity"], {"sensitivity": True}),
        (["--wall-gap-left", "20 mm"], {"walls": fs.Walls(left_m=0.02)}),
        (["--sliding", "--friction", 0.04], {"sliding": fs.Sliding(friction=0.04)}),
    ]:
        theirs = told("spectrum", *records, *FLAGS, *flags)
        assert list(fs.spectrum(motions, HEIGHTS, THICKNESSES, **options).rows()) == theirs["rows"]


def test_tables_pickle(table):
    again = pickle.loads(pickle.dumps(table))
    assert list(again.rows()) == list(table.rows())
    assert "84 rows" in repr(table) and "<table>" in table._repr_html_()


@pytest.mark.parametrize(
    ("arguments", "options"),
    [
        (([], [1], [0.3]), {}),
        ((None, [1], [0.3]), {}),
        ((_wave(), [1, -1], [0.3]), {}),
        ((_wave(), [1], [np.nan]), {}),
        ((_wave(), [1], [0.3]), {"mass_kg": 150}),
        ((_wave(), [1], [0.3]), {"accuracy": "best"}),
        ((_wave(), [1], [0.3]), {"restitution": 2}),
        (([_wave("a"), _wave("a")], [1], [0.3]), {}),
    ],
)
def test_wrong_grids_are_refused(arguments, options):
    with pytest.raises((fs.BadValue, TypeError)) as raised:
        fs.spectrum(*arguments, **options)
    assert "--" not in str(raised.value)
