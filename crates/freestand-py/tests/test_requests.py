"""The other requests: the documents of their commands."""

import freestand as fs
import numpy as np
import pytest
from conftest import CABINET, FLOOR, ROOT, same, told

DROPS = [ROOT / "validation/cushion" / f"drop-00{i}.csv" for i in (1, 2, 3)]


@pytest.fixture(scope="module")
def pad():
    return fs.drop_test(DROPS)


@pytest.mark.parametrize(
    ("flags", "options"),
    [
        (["--cg-rise", "27 mm"], {"cg_rise_m": 0.027}),
        (["--uplift", "30 mm", "--tolerance", "5 g", "--tolerance-duration", "11 ms"],
         {"uplift_m": 0.03, "tolerance_g": 5, "tolerance_duration_s": 0.011}),
        (["--rotation", "0.05 rad", "--model", "halted", "--at", "0.3 m, 1.2 m"],
         {"rotation_rad": 0.05, "model": "halted", "at_m": (0.3, 1.2)}),
        (["--scenario", "overturn-floor", "--contact-stiffness", "2000 N/mm"],
         {"scenario": "overturn-floor", "contact_stiffness_n_m": 2e6}),
    ],
)  # fmt: skip
def test_shock(cabinet, flags, options):
    same(cabinet.shock(**options).to_dict(), told("shock", *CABINET, *flags))


def test_table_one_of_the_paper():
    cabinet = fs.Block(2.3, 0.6, 140, stiffness_n_m=4.38e6)
    # Tests 3 and 4 of Table I by Eq. (5) with g = 9.81 m/s²: 5.88 g, as `freestand validate` has it.
    assert cabinet.shock(cg_rise_m=0.027, gravity_m_s2=9.81).edge_acceleration_g == pytest.approx(5.882, abs=2e-3)


def test_drop_test_gives_a_pad(pad, cabinet, tmp_path):
    same(pad.to_dict(), told("cushion", "drop", *DROPS))
    assert pad.ci95_n_m[0] < pad.stiffness_n_m < pad.ci95_n_m[1]
    assert len(pad.loops) == 3 and set(pad.loops[0]) >= {"compression_m", "force_n"}
    pad.save(tmp_path / "pad.toml")
    flags = ["--height", "2.3 m", "--thickness", "600 mm", "--mass", "140 kg", "--pads-per-edge", "2", "--cg-rise", "16 mm"]
    theirs = told("shock", *flags, "--cushion", tmp_path / "pad.toml")
    bare = fs.Block(2.3, 0.6, 140)
    for cushion in (pad, tmp_path / "pad.toml", str(tmp_path / "pad.toml")):
        same(bare.shock(cushion=cushion, pads_per_edge=2, cg_rise_m=0.016).to_dict(), theirs)
    held = fs.Block(2.3, 0.6, 140, cushion=fs.Cushion(pad=pad, pads_per_edge=2))
    same(held.shock(cg_rise_m=0.016).to_dict(), theirs)
    with pytest.raises(fs.BadValue, match="pads_per_edge"):
        bare.shock(cushion=pad, cg_rise_m=0.016)


def test_laws_of_cushions():
    power = fs.Block(2.3, 0.6, 140, cushion=fs.Cushion(stiffness_n_m="3e8 N/m^1.5", law="power", exponent=1.5))
    flags = ["--stiffness", "3e8 N/m^1.5", "--law", "power", "--exponent", "1.5", "--cg-rise", "16 mm"]
    same(power.shock(cg_rise_m=0.016).to_dict(), told("shock", *CABINET[:6], *flags))
    layers = fs.Cushion(pad_stiffness_n_m=2.19e6, pads_per_edge=2, series_stiffness_n_m=(9e6, 2e7))
    flags = ["--pad-stiffness", "2190 N/mm", "--pads-per-edge", 2, "--series-stiffness", "9000 N/mm",
             "--series-stiffness", "20000 N/mm", "--cg-rise", "16 mm"]  # fmt: skip
    ours = fs.Block(2.3, 0.6, 140, cushion=layers).shock(cg_rise_m=0.016)
    theirs = told("shock", *CABINET[:6], *flags)
    assert ours.edge_acceleration_g == theirs["edge_acceleration_g"]
    with pytest.raises(fs.BadValue, match="exclude"):
        fs.Block(2.3, 0.6, 140, stiffness_n_m=1e6, cushion=layers)


def test_static_test(tmp_path):
    press = tmp_path / "press.csv"
    force = [f"{d / 100:.2f},{2000 * d / 100:.1f}" for d in range(60)]
    press.write_text("displacement [mm],force [N]\n" + "\n".join(force) + "\n")
    ours = fs.static_test(press, load_n=400)
    same(ours.to_dict(), told("cushion", "static", press, "--load", "400 N"))
    assert ours.tests[0]["tangent_stiffness_n_m"] == pytest.approx(2e6, rel=1e-6)  # a straight line
    press.write_text(press.read_text().replace("force [N]", "force [mV]"))
    volts = fs.static_test(press, load_n=400, sensitivity="1 mV/N")
    assert volts.tests[0]["tangent_stiffness_n_m"] == pytest.approx(2e6, rel=1e-6)
    with pytest.raises(fs.FreestandError, match="sensitivity"):
        fs.static_test(press, load_n=400)


def test_shock_spectrum(floor_motion):
    theirs = told("shock-spectrum", FLOOR, "--scale", 3.5, "--frequencies", "1 Hz, 5 Hz, 20 Hz", "--damping", "3 %")
    ours = fs.shock_spectrum(floor_motion, frequencies_hz=[1, 5, 20], damping_ratio=0.03)
    np.testing.assert_array_equal(ours.values, theirs["spectra"][0]["values"])
    again = fs.shock_spectrum(floor_motion.accel_m_s2, floor_motion.dt_s, [1, 5, 20], damping_ratio=0.03)
    np.testing.assert_array_equal(again.values, ours.values)
    default = fs.shock_spectrum(floor_motion)
    assert len(default.frequencies_hz) == len(told("shock-spectrum", FLOOR)["spectra"][0]["frequencies_hz"])


@pytest.mark.parametrize(
    ("flags", "options"),
    [
        ([], {}),
        (["--site", "Ce", "--hazard-factor", 0.11, "--return-period", 2500],
         {"site": "Ce", "hazard_factor": 0.11, "return_period_years": 2500}),
        (["--place", "Wellington"], {"place": "Wellington"}),
        (["--code", "asce7", "--sds", "1 g", "--sd1", "0.6 g", "--long-period", "8 s"],
         {"code": "asce7", "sds_g": 1, "sd1_g": 0.6, "long_period_s": 8}),
        (["--code", "eurocode8", "--spectrum-type", 2, "--site", "B", "--ground-acceleration", "0.1 g",
          "--corner-periods", "0.15 s, 0.5 s, 2 s", "--soil-factor", 1.2],
         {"code": "eurocode8", "spectrum_type": 2, "site": "B", "ground_acceleration_g": 0.1,
          "corner_periods_s": [0.15, 0.5, 2], "soil_factor": 1.2}),
    ],
)  # fmt: skip
def test_code_spectrum(flags, options):
    theirs = told("motion", "code-spectrum", *flags, "--periods", "0 s, 0.2 s, 1 s")
    same(fs.code_spectrum([0, 0.2, 1], **options).to_dict(), theirs)


def test_synth_and_floor(tmp_path):
    ours = fs.synth(2, seed=7, site="Ce", shaking_s=20)
    flags = ["--count", 2, "--seed", 7, "--site", "Ce", "--shaking", "20 s"]
    theirs = told("motion", "synth", *flags, "--out", tmp_path / "motions")
    bare = [{**motion, "path": None} for motion in theirs["motions"]]
    same(ours.to_dict(), {**theirs, "motions": bare})
    again = fs.read_motion(tmp_path / "motions" / "synthetic-01.csv")
    np.testing.assert_array_equal(again.accel_m_s2, ours.records[0].accel_m_s2)

    building = {"storeys": 5, "storey_height_m": 3.0, "period_s": 0.6, "damping_ratio": 0.03}
    flags = ["--storeys", 5, "--storey-height", "3 m", "--period", "0.6 s", "--damping", "3 %", "--levels", "0.4, 1"]
    ours = fs.floor(again, levels=[0.4, 1], **building)
    theirs = told("floor", "--motion", tmp_path / "motions" / "synthetic-01.csv", *flags)
    same(ours.to_dict(), theirs)
    assert ours.floors[0][1].pga_g == pytest.approx(theirs["levels"][1]["pfa_g"], rel=1e-12)
    assert len(fs.floor(again, every_floor=True, **building).floors[0]) == 6


def test_check_object(floor_motion):
    flags = ["--height", "1.8 m", "--thickness", "500 mm", "--mass", "150 kg", "--on", "4380 N/mm", "--tolerance", "10 g"]
    theirs = told("object", *flags, "--motion", FLOOR, "--scale", 3.5)
    ours = fs.check_object(1.8, 0.5, mass_kg=150, stiffness_n_m=4.38e6, tolerance_g=10, motions=floor_motion)
    same(ours.to_dict(), theirs)
    flags = ["--height", "2 m", "--thickness", "300 mm", "--place", "Melbourne", "--seed", 3, "--worlds", 8]
    same(fs.check_object(2, 0.3, place="Melbourne", seed=3, worlds=8).to_dict(), told("object", *flags))
    for wrong in ({}, {"pga_g": 0.3, "place": "Melbourne"}, {"pga_g": 0.3, "scales": [1]}, {"site": "De"}):
        with pytest.raises(fs.BadValue) as raised:
            fs.check_object(2, 0.3, **wrong)
        assert "--" not in str(raised.value)


def test_restrain(tmp_path):
    flags = ["--mass", "360 kg", "--height", "1.8 m", "--thickness", "0.6 m", "--width", "0.9 m"]
    theirs = told("restrain", *flags, "--place", "Wellington", "--level-ratio", 1, "--compare")
    ours = fs.restrain(360, 1.8, 0.6, width_m=0.9, place="Wellington", level_ratio=1, compare=True)
    same(ours.to_dict(), theirs)
    ours.save(tmp_path / "sheet.html")
    assert "<svg" in (tmp_path / "sheet.html").read_text()
    theirs = told("restrain", *flags, "--code", "asce7", "--edition", 2022, "--sds", "1 g", "--level-ratio", 0.5)
    same(fs.restrain(360, 1.8, 0.6, width_m=0.9, code="asce7", edition=2022, sds_g=1, level_ratio=0.5).to_dict(), theirs)


def test_restrain_a_list(tmp_path):
    """The rows are those of the command, as a table."""
    hospital = ROOT / "examples/hospital/inventory.csv"
    theirs = told("restrain", hospital, "--place", "Wellington", "--storeys", 4, "--units", "si")
    ours = fs.restrain_list(hospital, place="Wellington", storeys=4)
    same(ours.to_dict(), theirs)
    assert ours.table.num_rows == ours.objects and 0 < ours.held <= ours.objects
    ours.save(tmp_path / "sheets.html")
    assert (tmp_path / "sheets.html").read_text("utf-8").count('class="object"') == ours.held
    anchored = fs.restrain_list(hospital, floor_acceleration_g=0.5, pivot="feet", anchor="M10", anchor_capacity_n=6000)
    ratios = [row["demand_capacity_ratio"] for row in anchored.rows if row["force_n"]]
    assert ratios and all(ratio >= 0 for ratio in ratios)
    with pytest.raises(fs.BadValue):
        fs.restrain_list(None, floor_acceleration_g=0.5)


def test_check_object_with_a_study():
    """A path, its text and its tables are one study."""
    tables = {"ground": {"code": "eurocode8", "spectrum_type": 1, "site": "B", "ground_acceleration": "0.3 g", "count": 4}}
    text = '[ground]\ncode = "eurocode8"\nspectrum_type = 1\nsite = "B"\nground_acceleration = "0.3 g"\ncount = 4\n'
    by_text = fs.check_object(2, 0.3, study=text, worlds=8).to_dict()
    assert fs.check_object(2, 0.3, study=tables, worlds=8).to_dict() == by_text
    assert "the study" in by_text["answer"] or "the study" in by_text["earthquake"]
    with pytest.raises(fs.FreestandError, match="sitee"):
        fs.check_object(2, 0.3, study=text.replace("site =", "sitee ="))


@pytest.mark.long
def test_a_place_replaces_the_hazard_of_a_study(tmp_path):
    """As in the command: the answer names the place, and the built-in study supplies what a study does not state."""
    path = tmp_path / "s.toml"
    path.write_text('[ground]\ncode = "eurocode8"\nspectrum_type = 1\nsite = "B"\nground_acceleration = "0.3 g"\n'
                    '[building]\nstoreys = 5\n')  # fmt: skip
    flags = ["--height", "2 m", "--thickness", "300 mm", "--study", path, "--worlds", 8]
    alone = fs.check_object(2, 0.3, study=path, worlds=8)
    replaced = fs.check_object(2, 0.3, study=path, place="Wellington", worlds=8)
    same(replaced.to_dict(), told("object", *flags, "--place", "Wellington"))
    assert "Wellington" in replaced.answer and "Wellington" not in alone.answer
    unstated = fs.check_object(2, 0.3, study={"building": {"storeys": 5}}, worlds=8)
    assert "Melbourne" in unstated.answer and unstated.place_is_assumed and not alone.place_is_assumed
    with pytest.raises(fs.FreestandError, match="the study is empty"):
        fs.check_object(2, 0.3, study={}, worlds=8)
    round_one = fs.check_object(2, 0.3, shape="cylinder", study=path, worlds=8)
    assert round_one.is_round and round_one.decision == "restrain"
    with pytest.raises(fs.BadValue, match="place does not apply: the ground motions are records"):
        fs.check_object(2, 0.3, study={"ground": {"motions": [str(FLOOR)]}}, place="Wellington")


def test_check_object_with_the_file_of_a_study(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text('[ground]\ncount = 4\n')
    theirs = told("object", "--height", "2 m", "--thickness", "300 mm", "--study", path, "--worlds", 8)
    same(fs.check_object(2, 0.3, study=path, worlds=8).to_dict(), theirs)


RISK = ROOT / "examples" / "risk"


def test_fragility_and_risk():
    import pandas

    theirs = told("fragility", "--outcomes", RISK / "outcomes.csv", "--bootstrap", 50, "--seed", 3)
    ours = fs.fragility(RISK / "outcomes.csv", bootstrap=50, seed=3)
    same(ours.to_dict(), theirs)
    by_table = fs.fragility(pandas.read_csv(RISK / "outcomes.csv"), bootstrap=50, seed=3)
    assert by_table.objects == ours.objects
    assert set(ours.empirical.column("limit_state")) >= {"rocks", "overturns"}
    flags = ["--fragility", RISK / "curves.csv", "--hazard", RISK / "hazard.csv", "--inventory", RISK / "costs.csv"]
    theirs = told("risk", *flags, "--options", RISK / "options.csv", "--budget", "2000 AUD", "--horizon", "40 yr",
                  "--discount", "3 %")  # fmt: skip
    ours = fs.risk(RISK / "curves.csv", hazard=RISK / "hazard.csv", inventory=RISK / "costs.csv",
                   options=RISK / "options.csv", budget="2000 AUD", horizon_years=40, discount_ratio=0.03)  # fmt: skip
    same(ours.to_dict(), theirs)
    options = {"hazard": RISK / "hazard.csv", "inventory": RISK / "costs.csv", "edits": ["B2=20000"]}
    flags[-1:] = [RISK / "costs.csv", "--edit", "B2=20000"]
    same(fs.risk(RISK / "curves.csv", **options).to_dict(), told("risk", *flags))
    for wrong, said in (
        ({"hazard": RISK / "hazard.csv", "edits": ["B2=20000"]}, "there is no inventory"),
        ({}, "there is no hazard curve"), ({"hazard_code": "as1170.4"}, "site"),
        ({"hazard_code": "as1170.4", "hazard_im": "pgx"}, "pgx"),
    ):  # fmt: skip
        with pytest.raises(fs.BadValue, match=said) as raised:
            fs.risk(RISK / "curves.csv", **wrong)
        assert "--" not in str(raised.value)


def test_arguments_of_a_target_are_those_of_the_codes():
    with pytest.raises(TypeError, match="hazard_faktor"):
        fs.code_spectrum(hazard_faktor=0.1)


def test_validate():
    ours = fs.validate()
    same(ours.to_dict(), told("validate"))
    assert ours.ok and len(ours.checks) >= 15 and len(ours.table_one) == 5


@pytest.mark.parametrize(
    ("result", "make"),
    [
        ("ShockSpectrumResult", lambda m: fs.shock_spectrum(m)),
        ("MotionSpectrumResult", lambda m: m.spectrum()),
        ("FloorResult", lambda m: fs.floor(m)),
        ("ObjectResult", lambda m: fs.check_object(2, 0.3, motions=m)),
        ("RestrainResult", lambda m: fs.restrain(360, 1.8, 0.6, place="Wellington", level_ratio=1)),
        ("ShockResult", lambda m: fs.Block(2.3, 0.6, 140, stiffness_n_m=4.38e6).shock(cg_rise_m=0.016)),
        ("DropTestResult", lambda m: fs.drop_test(DROPS)),
        ("FragilityResult", lambda m: fs.fragility(RISK / "outcomes.csv", bootstrap=0)),
        ("RiskResult", lambda m: fs.risk(RISK / "curves.csv", hazard=RISK / "hazard.csv")),
    ],
)
def test_documented_attributes_are_those_of_the_document(result, make, floor_motion):
    found = make(floor_motion)
    documented = {name for name in getattr(fs, result).__annotations__ if not name.startswith("_")}
    assert documented | {"schema", "warnings"} == set(found.to_dict())
    assert result in found._repr_html_()
