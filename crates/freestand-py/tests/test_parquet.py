"""Parquet files of the commands: read by pyarrow, they hold what the CSV files hold."""

import csv
import json

import freestand as fs
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from conftest import CABINET, FLOOR, ROOT, told

RISK = ROOT / "examples" / "risk"
BUILDING = ["--storeys", 5, "--storey-height", "3 m"]


def check(folder, name, schema):
    """A table beside its CSV: the same values to the last bit, types and units by column."""
    table = pq.read_table(folder / f"{name}.parquet")
    with open(folder / f"{name}.csv", newline="", encoding="utf-8") as file:
        head, *rows = list(csv.reader(file))
    metadata = {key.decode(): value.decode() for key, value in table.schema.metadata.items()}
    assert metadata["freestand.schema"] == schema
    assert metadata["freestand.version"] == fs.__version__
    units = json.loads(metadata["freestand.columns"])
    assert table.num_rows == len(rows) > 0
    for index, column in enumerate(head):
        values, cells = table.column(column), [row[index] for row in rows]
        if pa.types.is_floating(values.type):
            read = [float(cell) if cell not in ("", "overturned") else None for cell in cells]
        elif pa.types.is_integer(values.type):
            read = [int(cell) if cell else None for cell in cells]
        elif pa.types.is_boolean(values.type):
            read = [cell == "true" if cell else None for cell in cells]
        else:
            read = [cell or None for cell in cells]
        assert values.to_pylist() == read, column
        if column.endswith("_m_s"):
            assert units[column]["unit"] == "m/s"
        elif column.endswith("_g"):
            assert units[column]["unit"] == "g"
    return table, metadata


@pytest.mark.parametrize(
    ("command", "names", "schema"),
    [
        (["motion", "info", FLOOR, ROOT / "validation/rocking/records/onesine_T0.4.csv"], ["measures"], "motion-info"),
        (["motion", "spectrum", FLOOR], ["spectrum"], "motion-spectrum"),
        (["motion", "code-spectrum"], ["spectrum"], "code-spectrum"),
        (["motion", "rotd", FLOOR, ROOT / "validation/rocking/records/onesine_T0.4.csv", "--periods", "0.2 s, 1 s"],
         ["rotd"], "motion-rotd"),
        (["motion", "simulate", "--magnitude", 6, "--distance", "30 km", "--count", 1], ["fourier_amplitude"],
         "motion-simulate"),
        (["floor", "--motion", FLOOR, *BUILDING, "--spectra"], ["profile", "spectra"], "floor"),
        (["shock-spectrum", FLOOR], ["shock_spectrum"], "shock-spectrum"),
        (["rock", "--motion", FLOOR, "--scale", 3.5, *CABINET], ["history"], "rock"),
        (["cushion", "static", "press.csv", "--load", "400 N"], ["curve-001"], "cushion-static"),
        (["cushion", "drop", ROOT / "validation/cushion/drop-001.csv"], ["loop-001"], "cushion-drop"),
        (["fragility", "--outcomes", RISK / "outcomes.csv", "--bootstrap", 20], ["fragility", "empirical"], "fragility"),
        (["risk", "--fragility", RISK / "curves.csv", "--hazard", RISK / "hazard.csv"], ["risk"], "risk"),
    ],
    ids=lambda value: value if isinstance(value, str) else None,
)
def test_tables_of_a_folder(command, names, schema, tmp_path):
    out, press = tmp_path / "out", tmp_path / "press.csv"
    force = "".join(f"{d / 100:.2f},{2000 * d / 100:.1f}\n" for d in range(60))
    press.write_text("displacement [mm],force [N]\n" + force)
    told(*[press if word == "press.csv" else word for word in command], "--parquet", "--out", out)
    for name in names:
        _, metadata = check(out, name, f"freestand.{schema}/1")
        files = [one["name"] for one in json.loads(metadata["freestand.inputs"])]
        assert all(str(FLOOR) not in one for one in files)
        if "--seed" in command or schema == "fragility":
            assert metadata["freestand.seed"] == "1"
    listed = json.loads((out / "manifest.json").read_text())["files"]
    assert {f"{name}.parquet" for name in names} <= set(listed)


def test_history_alone(tmp_path):
    place = tmp_path / "h.parquet"
    told("rock", "--motion", FLOOR, "--scale", 3.5, *CABINET, "--history", place)
    ours = fs.Block(2.3, 0.6, 140, stiffness_n_m=4.38e6).rock(fs.read_motion(FLOOR, scale=3.5), history=True)
    found = pq.read_table(place)
    assert found.column_names == list(ours.history)
    for name in found.column_names:
        assert found.column(name).to_pylist() == ours.history[name].tolist()


STUDY = {
    "ground": {"code": "eurocode8", "spectrum_type": 1, "site": "C", "ground_acceleration": "0.2 g", "count": 3},
    "building": {"storeys": 5},
    "objects": {"heights": "1 m, 2 m", "thicknesses": "0.2 m, 0.6 m"},
    "outputs": {"figures": False, "report": False},
}


def test_study(tmp_path):
    """Numbers that are "overturned" are null, with a Boolean column beside them."""
    fs.run(STUDY, tmp_path / "run", parquet=True)
    for name in ("urs", "srs", "floor_profile"):
        check(tmp_path / "run", name, "freestand.run/1")
    table, metadata = check(tmp_path / "run", "statistics", "freestand.run/1")
    assert metadata["freestand.seed"] == "1"
    fallen, value = table.column("uplift_m_p84_overturned").to_pylist(), table.column("uplift_m_p84").to_pylist()
    assert any(fallen) and not all(fallen)
    assert [one is None for one in value] == fallen
    plain = fs.run({**STUDY, "outputs": {**STUDY["outputs"], "parquet": False}}, tmp_path / "plain")
    assert not list((tmp_path / "plain").glob("*.parquet")) and plain.rows.num_rows == 24


def test_the_flag_needs_a_folder():
    with pytest.raises(AssertionError, match="--parquet writes tables to a folder"):
        told("motion", "spectrum", FLOOR, "--parquet")
