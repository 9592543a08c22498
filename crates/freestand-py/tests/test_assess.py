"""Inventories and studies: the same files and rows as the command."""

import csv

import freestand as fs
import numpy as np
import pytest
from conftest import ROOT, program, same, told

SERVERS = ROOT / "examples" / "server-room" / "inventory.xlsx"
LIST = "id,item,level_ratio,height [mm],thickness [mm]\na,shelf,1,2000,300\nb,chest,0,800,900\n"
#: A few worlds of short motions: seconds also where nothing is optimised.
STUDY = {"ground": {"count": 3}, "building": {"storeys": 3}, "worlds": {"most": 20, "shares": False}}


def test_check_inventory_equals_the_command():
    same(fs.check_inventory(SERVERS, storeys=5).to_dict(), told("inventory", "check", SERVERS, "--storeys", 5))


def test_check_inventory_takes_tables(tmp_path):
    pandas = pytest.importorskip("pandas")
    (tmp_path / "list.csv").write_text(LIST)
    frame = pandas.read_csv(tmp_path / "list.csv")
    expected = fs.check_inventory(tmp_path / "list.csv")
    found = fs.check_inventory(frame)
    assert found.objects == expected.objects and found.ok
    assert list(found.table["height_m"]) == [2.0, 0.8]
    pyarrow = pytest.importorskip("pyarrow")
    assert fs.check_inventory(frame.set_index("id")).objects == expected.objects
    assert fs.check_inventory(pyarrow.Table.from_pandas(frame)).objects == expected.objects
    polars = pytest.importorskip("polars", reason="polars is not installed")
    assert fs.check_inventory(polars.read_csv(tmp_path / "list.csv")).objects == expected.objects


def test_edits_are_those_of_the_command(tmp_path):
    (tmp_path / "list.csv").write_text(LIST)
    ours = fs.check_inventory(tmp_path / "list.csv", edits=["D2=1500 mm"])
    same(ours.to_dict(), told("inventory", "check", tmp_path / "list.csv", "--edit", "D2=1500 mm"))
    assert ours.table["height_m"][0] == 1.5
    # One text is one edit, not an edit for each of its letters.
    same(fs.check_inventory(tmp_path / "list.csv", edits="D2=1500 mm").to_dict(), ours.to_dict())
    for wrong in ([1], ["D2"], "D2"):
        with pytest.raises(fs.BadValue, match="edit|no ="):
            fs.check_inventory(tmp_path / "list.csv", edits=wrong)


def test_a_doubtful_cell_is_a_problem_with_its_cell(tmp_path):
    (tmp_path / "list.csv").write_text(LIST.replace("2000", "-2000"))
    found = fs.check_inventory(tmp_path / "list.csv")
    assert not found.ok and any("D2" in problem["cells"] for problem in found.problems)


def test_the_marked_copy_is_that_of_the_command(tmp_path):
    import zipfile

    (tmp_path / "list.csv").write_text(LIST.replace("2000", "-2000"))
    told("inventory", "check", tmp_path / "list.csv", "--out", tmp_path / "theirs")
    found = fs.check_inventory(tmp_path / "list.csv", marked_copy=tmp_path / "ours.xlsx")
    assert found.marked_copy == str(tmp_path / "ours.xlsx")

    def sheet(path):
        with zipfile.ZipFile(path) as book:
            return book.read("xl/worksheets/sheet1.xml"), book.read("xl/comments1.xml")

    assert sheet(tmp_path / "ours.xlsx") == sheet(tmp_path / "theirs" / "checked.xlsx")
    with pytest.raises(fs.FreestandError, match="list.csv"):
        fs.check_inventory(tmp_path / "list.csv", marked_copy=tmp_path / "list.csv")


@pytest.fixture(scope="module")
def assessed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("assessed")
    (folder / "list.csv").write_text(LIST)
    steps = []
    result = fs.assess(STUDY, folder / "list.csv", seed=5, threads=2, progress=lambda *step: steps.append(step))
    return folder, result, steps


def test_assess_equals_the_command(assessed):
    folder, result, steps = assessed
    from freestand._convert import toml

    (folder / "study.toml").write_text(toml(STUDY))
    theirs = told("assess", folder / "study.toml", "--inventory", folder / "list.csv", "--seed", 5, "--out", folder / "out")
    assert result.to_dict()["rows"] == theirs["rows"]
    saved = result.save(folder / "saved")
    assert (saved / "objects.csv").read_bytes() == (folder / "out" / "objects.csv").read_bytes()
    assert (saved / "worlds.csv").read_bytes() == (folder / "out" / "worlds.csv").read_bytes()
    assert "<html" in result.report_html()
    assert all(len(step) == 3 and isinstance(step[0], str) for step in steps)
    with pytest.raises(fs.BadValue, match="empty"):
        result.save(saved)


def test_objects_are_a_table(assessed):
    _, result, _ = assessed
    table = result.objects
    assert len(table) == 2 and list(table["id"]) == ["a", "b"]
    assert table["height_m"].tolist() == [2.0, 0.8]
    frame = table.to_pandas()
    assert set(frame["decision"]) <= {"leave", "lock", "restrain", "soften", "no-verdict"}
    assert (frame["p_overturn"] >= 0).all()


def test_a_progress_that_raises_stops_the_work(tmp_path):
    (tmp_path / "list.csv").write_text(LIST)

    def progress(stage, done, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        fs.assess(STUDY, tmp_path / "list.csv", progress=progress)


def test_run_equals_the_command(tmp_path):
    study = {
        "ground": {"count": 2},
        "building": {"storeys": 3},
        "objects": {"heights": "1 m, 2 m", "thicknesses": "200 mm, 400 mm"},
        "outputs": {"report": False},
    }
    from freestand._convert import toml

    (tmp_path / "study.toml").write_text(toml(study))
    theirs = told("run", tmp_path / "study.toml", "--out", tmp_path / "theirs")
    ours = fs.run(study, tmp_path / "ours")
    assert ours.levels == theirs["levels"]
    assert (tmp_path / "ours" / "srs.csv").read_bytes() == (tmp_path / "theirs" / "srs.csv").read_bytes()
    with open(tmp_path / "theirs" / "srs.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(ours.rows) == len(rows)
    uplift = [float(row["uplift_m"]) if row["uplift_m"] else np.nan for row in rows]
    np.testing.assert_array_equal(ours.rows["uplift_m"], uplift)


def test_dictionaries_become_the_toml_that_they_mean():
    tomllib = pytest.importorskip("tomllib")
    from freestand._convert import toml

    tables = {"a": {"b": 1, "c": "x\"\\\n", "d": [1.5, 2], "e": True}, "f": {"g": {"h": "é"}}, "i": [{"j": 1}, {"j": 2}], "k k": {"l": 1}}
    assert tomllib.loads(toml(tables)) == tables


def test_the_program_is_in_the_wheel():
    import subprocess

    done = subprocess.run([program(), "--version"], capture_output=True, text=True)
    assert done.stdout.split() == ["freestand", fs.__version__]
