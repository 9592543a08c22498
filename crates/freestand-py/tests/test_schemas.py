"""The documents of the command are those that docs/schema describes."""

import json
import shlex
from functools import cache

import pytest
from conftest import ROOT, told
from jsonschema import Draft202012Validator

SCHEMAS = ROOT / "docs" / "schema"
CABINET = "--height 1.8m --thickness 0.4m --mass 150kg --stiffness '4380 N/mm'"
SMALL = "crates/freestand-cli/tests/same_answer/study.toml --inventory crates/freestand-cli/tests/same_answer/list.csv"
RECORD = "validation/rocking/records/synthfloor.csv"
PAIR = "validation/rocking/records/synthfloor_hv.csv"
GRID = f"--motion {RECORD} --heights '1 m:2 m:3' --thicknesses '0.3 m, 0.4 m'"
SYNTHETIC = "[ground]\ncount = 2\n{source}[objects]\nheights = '1 m'\nthicknesses = '200 mm'\n[outputs]\nfigures = false\nreport = false\n"
#: One line for each kind of document: the name of its schema, then the arguments of the command.
ASKED = f"""
object | {CABINET} --place Wellington
assess | {SMALL} --out assessment
check | examples/hospital/study.toml
code-spectrum | motion code-spectrum --code as1170.4 --site De --hazard-factor 0.08
cushion-curve | drops.csv --limit 40g --drop-height '600 mm' --static-stress 4kPa
cushion-static | press.csv --load '350 N'
cushion-drop | validation/cushion/drop-001.csv validation/cushion/drop-002.csv
cushion-list |
cushion-search | rubber
cushion-show | rubber-foot
cushion-simulate | --law power --stiffness '4380 N/mm' --mass 0.4kg --height 100mm --count 2 --out drops
floor | --motion {RECORD} --storeys 7
fragility | {CABINET} --tolerance 2g --motion {RECORD} --scales '0.5:3:4' --bootstrap 20
fragility | --outcomes examples/risk/outcomes.csv --bootstrap 20
inventory-check | examples/hospital/inventory.csv
inventory-check | examples/hospital/inventory.csv --headings
inventory-convert | examples/hospital/inventory.csv --to csv
inventory-template |
motion-convert | {RECORD} --to at2
motion-info | {RECORD}
motion-match | {RECORD} --code as1170.4 --site De --hazard-factor 0.08
motion-rotate | {PAIR} --azimuths '0 deg, 90 deg' --to 30deg
motion-rotd | {PAIR} --periods '0.1 s:2 s:4'
motion-simulate | --magnitude 6.5 --distance 20km --count 2
motion-spectrum | {RECORD} --damping '2 %, 5 %'
motion-synth | --code as1170.4 --site De --hazard-factor 0.08 --count 2
place-list |
place-show | Melbourne
restrain | --height 1.8m --thickness 0.6m --width 0.9m --mass 360kg --place Wellington
restrain | examples/hospital/inventory.csv --study examples/hospital/study.toml
risk | --fragility examples/risk/curves.csv --hazard examples/risk/hazard.csv --inventory examples/risk/costs.csv --options examples/risk/options.csv --horizon '40 yr' --discount 3%
rock | --height 1.8m --thickness 0.4m --motion {RECORD} --scale 3
rock | {CABINET} --motion {RECORD} validation/rocking/records/onesine_T1.0.csv --scale 3
run | {SMALL.split()[0]} --out results
run | synthetic.toml --out results --vary damping
run | simulated.toml --out results
shock | --height 1.8m --thickness 0.4m --mass 150kg --stiffness '4380 N/mm' --uplift 20mm
shock-spectrum | {RECORD}
spectrum | {GRID}
spectrum | {GRID} --sensitivity --wall-gap 20mm
spectrum | {GRID} --mass 150kg --stiffness '4380 N/mm' --wall-gap 20mm --wall-stiffness '1000 N/mm'
spectrum | {GRID} --casters --brakes --friction 0.25
tolerance-list |
tolerance-search | server
tolerance-show | museum-fragile
validate |
"""
#: Files that some of them read.
FILES = {
    "drops.csv": "static stress [kPa],drop height [mm],thickness [mm],peak acceleration [g]\n"
    + "".join(f"{kpa},600,50,{peak}\n" for kpa, peak in ((1, 75), (2, 52), (4, 38), (6, 41), (8, 55))),
    "synthetic.toml": SYNTHETIC.format(source=""),
    "simulated.toml": SYNTHETIC.format(source="point_source = { magnitude = 6.0, distance = '30 km' }\n"),
    "press.csv": "displacement [mm],force [N]\n" + "".join(f"{n / 100},{9.0 * n}\n" for n in range(101)),
}
LINES = [line.split(" | ") for line in ASKED.replace(" |\n", " | \n").strip("\n").split("\n")]
#: Commands of two words; the name of their schema joins them with a hyphen.
TWO_WORDS = ("cushion", "inventory", "motion", "place", "shard", "tolerance")


def strict(schema):
    """A schema that refuses keys which it does not describe."""
    if not isinstance(schema, dict):
        return schema
    schema = {key: [strict(one) for one in value] if isinstance(value, list) else strict(value) for key, value in schema.items()}
    if "properties" in schema and "additionalProperties" not in schema:
        schema["unevaluatedProperties"] = False
    return schema


@cache
def validator(name):
    schema = strict(json.loads((SCHEMAS / f"{name}.response.json").read_text("utf-8")))
    # The keys of every document are beside those of its kind.
    for kind in schema["anyOf"]:
        kind.pop("unevaluatedProperties", None)
    return Draft202012Validator(schema)


def command(name, line):
    # The only schema without the first word of its command.
    if name == "code-spectrum":
        return shlex.split(line)
    words = name.split("-", 1) if name.startswith(TWO_WORDS) else [name]
    return words + shlex.split(line)


def check(name, line, folder):
    for file, text in FILES.items():
        (folder / file).write_text(text, "utf-8")
        line = line.replace(file, shlex.quote(str(folder / file)))
    line = line.replace("--out ", f"--out {shlex.quote(str(folder))}/")
    document = told(*command(name, line))
    problems = sorted(validator(name).iter_errors(document), key=str)
    assert not problems, problems[0]
    return document


@pytest.mark.parametrize(("name", "line"), LINES, ids=lambda text: text[:30])
def test_a_document_is_as_described(name, line, tmp_path):
    check(name, line, tmp_path)


def test_the_documents_of_shards_are_as_described(tmp_path):
    plan = str(tmp_path / "plan")
    check("shard-plan", f"{SMALL} --shards 2 --out plan", tmp_path)
    check("shard-run", f"{plan} --shard 0", tmp_path)
    assert check("shard-merge", f"{plan} --out merged", tmp_path)["missing"] == [1]
    check("shard-run", f"{plan} --shard 1", tmp_path)
    assert check("shard-merge", f"{plan} --out merged", tmp_path)["rows"]


def test_every_document_is_described():
    described = {path.name.split(".")[0] for path in SCHEMAS.glob("*.response.json")}
    asked = {path.name.split(".")[0] for path in SCHEMAS.glob("*.request.json")}
    tried = {name for name, _ in LINES}
    assert asked - described == set()
    # A recovery takes minutes.
    assert described - tried == {"cushion-recovery", "shard-plan", "shard-run", "shard-merge"}
