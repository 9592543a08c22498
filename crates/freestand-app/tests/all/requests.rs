//! Bad requests, one table for all shells: `requests.jsonl` has each with its problems. The command line, the page
//! and Python read it too, and tell the same problems under the same keys.

use std::fmt::Write as _;

use freestand_app::assess::Assess;
use freestand_app::check_list::CheckList;
use freestand_app::code_spectrum::CodeSpectrum;
use freestand_app::cushion_curve::CushionCurve;
use freestand_app::drop_test::DropTests;
use freestand_app::files::Files;
use freestand_app::floor::Floor;
use freestand_app::fragility::Fragility;
use freestand_app::inventory::{InventoryConvert, InventoryTemplate};
use freestand_app::library::{Cushions, List, Search, Show, Tolerances};
use freestand_app::motion::{MotionConvert, MotionInfo, MotionSpectrum};
use freestand_app::object::Object;
use freestand_app::pair::{Rotate, Rotd};
use freestand_app::places::{PlaceList, PlaceShow};
use freestand_app::recovery::Recovery;
use freestand_app::request::{Question, from_entries, keys};
use freestand_app::restrain::Restrain;
use freestand_app::risk::Risk;
use freestand_app::rock::Rock;
use freestand_app::run::{CheckStudy, Run};
use freestand_app::shard::{ShardMerge, ShardPlan, ShardRun};
use freestand_app::shock::Shock;
use freestand_app::shock_spectrum::ShockSpectrum;
use freestand_app::simulate::Simulate;
use freestand_app::spectrum::Spectrum;
use freestand_app::static_test::StaticTests;
use freestand_app::synth::{Match, Synth};
use freestand_app::validate::Validate;
use freestand_app::virtual_test::VirtualTests;
use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, Problems};
use serde_json::{Map, Value, json};

const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/requests.jsonl");

/// A command, and what it is asked.
type Asked = (&'static str, Value);

/// One request of each kind, which would be answered but for a motion that is missing.
fn good() -> Vec<Asked> {
    let pad = json!({"height": "2 m", "thickness": "0.5 m", "base": "compliant", "mass": "100 kg",
        "stiffness": "1000 N/mm"});
    let with = |more: Value| {
        let mut request = pad.clone();
        for (key, value) in more.as_object().into_iter().flatten() {
            request[key] = value.clone();
        }
        request
    };
    vec![
        (
            "rock",
            json!({"height": "2 m", "thickness": "0.5 m", "initial_rotation": "2 deg"}),
        ),
        (
            "rock",
            json!({"height": "1.2 m", "thickness": "0.6 m", "casters": true, "clearance_left": "20 mm"}),
        ),
        (
            "rock",
            json!({"height": "2 m", "thickness": "0.5 m", "casters": true, "brakes": true,
            "initial_rotation": "2 deg"}),
        ),
        ("rock", with(json!({"initial_velocity": "0.1 rad/s"}))),
        ("rock", with(json!({"width": "0.7 m", "duration": "1 s"}))),
        (
            "rock",
            with(json!({"shape": "cylinder", "duration": "1 s"})),
        ),
        (
            "rock",
            with(
                json!({"upper_height": "0.5 m", "upper_thickness": "0.2 m", "upper_mass": "5 kg",
            "duration": "1 s"}),
            ),
        ),
        (
            "shock",
            json!({"height": "2.3 m", "thickness": "0.6 m", "mass": "140 kg", "stiffness": "4380 N/mm",
            "cg_rise": "16 mm"}),
        ),
        (
            "shock-spectrum",
            json!({"pulse": "half-sine", "peak_acceleration": "30 g", "duration": "11 ms"}),
        ),
        (
            "motion code-spectrum",
            json!({"place": "Melbourne", "site": "De", "parts": true, "building_height": "96 m"}),
        ),
        (
            "motion synth",
            json!({"place": "Melbourne", "count": "3", "time_step": "10 ms", "match_pga": true}),
        ),
        (
            "motion simulate",
            json!({"magnitude": "6", "distance": "30 km", "preset": "se-australia", "stress_drop": "50 MPa",
            "hard_rock": true}),
        ),
        (
            "motion simulate",
            json!({"city": "Adelaide", "return_period_years": "500", "site": "De", "window": "lam"}),
        ),
        (
            "object",
            json!({"height": "1.8 m", "thickness": "0.4 m", "width": "0.9 m", "place": "Melbourne", "floor": "2",
            "storeys": "6", "wall_gap": "20 mm"}),
        ),
        (
            "object",
            json!({"height": "1.8 m", "thickness": "0.6 m", "mass": "150 kg", "on": "4380 N/mm", "tolerance": "10 g 11 ms",
            "pga": "0.3 g", "friction": "0.3 to 0.5"}),
        ),
        (
            "restrain",
            json!({"mass": "360 kg", "height": "1.8 m", "thickness": "0.6 m", "width": "0.9 m", "place": "Wellington",
            "level_ratio": "1", "anchor_inset": "75 mm", "pivot": "feet", "anchor": "M10", "anchor_capacity": "6 kN",
            "anchor_shear_capacity": "4 kN", "compare": true}),
        ),
        (
            "restrain",
            json!({"mass": "360 kg", "height": "1.8 m", "thickness": "0.6 m", "code": "asce7", "edition": "2022", "sds": "1 g",
            "importance": "1.5", "strength": "1.5"}),
        ),
        (
            "spectrum",
            json!({"heights": "1 m, 2 m", "thicknesses": "0.4 m", "place": "Melbourne"}),
        ),
        (
            "spectrum",
            json!({"heights": "1 m, 2 m", "thicknesses": "0.9 m", "place": "Lisbon", "sliding": true,
            "friction": "0.2"}),
        ),
        (
            "cushion recovery",
            json!({"drops": "10", "samples_per_contact": "25, 50", "noise": "0, 2 %", "bias": "1 g"}),
        ),
        (
            "cushion simulate",
            json!({"stiffness": "2190 N/mm", "mass": "0.365 kg", "height": "100 mm", "noise": "0.5 %", "bounces": "0"}),
        ),
        (
            "cushion simulate",
            json!({"static": true, "stiffness": "1100 N/mm", "load": "1 kN", "hysteresis": "15 %"}),
        ),
        ("place list", json!({"word": "greece"})),
        ("place show", json!({"name": "Salt Lake City"})),
    ]
}

/// What would be answered but for its files.
fn without_files() -> Vec<Asked> {
    vec![
        (
            "cushion drop",
            json!({"mass": "0.365 kg", "height": "100 mm"}),
        ),
        (
            "cushion curve",
            json!({"drop_height": "600 mm", "mass": "70 kg", "area": "0.02 m2", "limit": "40 g"}),
        ),
        (
            "cushion curve",
            json!({"static_stress": "3 kPa", "drop_height": "600 mm", "thickness": "50 mm"}),
        ),
        ("cushion static", json!({"load": "350 N"})),
        (
            "motion info",
            json!({"height": "2 m", "thickness": "0.5 m"}),
        ),
        ("motion spectrum", json!({"damping": "2 %, 5 %"})),
        ("motion convert", json!({"to": "csv"})),
        (
            "motion rotate",
            json!({"to": "30 deg", "azimuths": "0 deg, 90 deg", "format": "at2"}),
        ),
        (
            "motion rotd",
            json!({"percentiles": "0, 50 %, 100", "damping": "2 %", "periods": "0 s, 1 s"}),
        ),
        (
            "motion match",
            json!({"place": "Lisbon", "method": "fft", "match_pga": true}),
        ),
        (
            "inventory check",
            json!({"sheet": "Ward 3", "storeys": "6", "strict": true, "edit": "D7=900 mm"}),
        ),
        ("inventory check", json!({"headings": true})),
        ("check", json!({"place": "Wellington", "site": "D"})),
        (
            "run",
            json!({"place": "Wellington", "vary": "damping = 2 %, 10 %", "parquet": true, "rotation_step": "10 deg"}),
        ),
        (
            "assess",
            json!({"place": "Christchurch", "storeys": "7", "format": "csv,parquet", "fail_on": "restrain", "pages": "10",
            "edit": "D7=900 mm"}),
        ),
        (
            "assess",
            json!({"budget": "15,000 NZD", "horizon_years": "50 yr", "discount": "3 %"}),
        ),
        ("tolerance search", json!({})),
        ("tolerance show", json!({})),
        ("inventory convert", json!({"to": "csv", "sheet": "Ward 3"})),
        ("cushion search", json!({"library": "ours.csv"})),
        (
            "fragility",
            json!({"height": "1.8 m", "thickness": "0.5 m", "mass": "150 kg", "stiffness": "4380 N/mm", "tolerance": "5 g",
            "im": "pfv, sa(0.5)", "method": "stripes", "scales": "0.1 m/s:2 m/s:5", "format": "openquake", "demand": "1 m/s"}),
        ),
        (
            "fragility",
            json!({"tolerance": "5 g", "ceiling": "22 g", "fit": "two-stage", "bootstrap": "0", "format": "pelicun",
            "demand": "1 m/s", "realizations": "100"}),
        ),
        (
            "risk",
            json!({"hazard_code": "as1170.4", "hazard_im": "pga", "site": "De", "hazard_factor": "0.12", "years": "50 yr",
            "accepted": "1e-4 /yr"}),
        ),
        (
            "risk",
            json!({"hazard_power": "k0=1e-4 /yr, k=2.5, reference=1 m/s", "hazard_im": "pgv", "budget": "20000 AUD",
            "horizon_years": "40 yr", "discount": "3 %"}),
        ),
        (
            "shard plan",
            json!({"place": "Wellington", "storeys": "7", "shards": "4", "outcomes": true, "pages": "10"}),
        ),
        ("shard run", json!({"shard": "3"})),
        ("shard merge", json!({})),
        (
            "floor",
            json!({"storeys": "12", "storey_height": "3 m", "spectra": true, "levels": "0.5, 1"}),
        ),
    ]
}

/// A command that is asked by a struct.
struct Command {
    name: &'static str,
    keys: fn() -> Vec<String>,
    ask: fn(&Map<String, Value>) -> Result<(), Problems>,
}

const fn command<Q: Question>(name: &'static str) -> Command {
    Command {
        name,
        keys: keys::<Q>,
        ask: |entries| {
            let request: Q = from_entries(entries)?;
            request.resolve(&Files::Sent(Vec::new())).map(drop)
        },
    }
}

const COMMANDS: [Command; 41] = [
    command::<Fragility>("fragility"),
    command::<Risk>("risk"),
    command::<ShardMerge>("shard merge"),
    command::<ShardPlan>("shard plan"),
    command::<ShardRun>("shard run"),
    command::<DropTests>("cushion drop"),
    command::<CushionCurve>("cushion curve"),
    command::<Recovery>("cushion recovery"),
    command::<VirtualTests>("cushion simulate"),
    command::<StaticTests>("cushion static"),
    command::<Floor>("floor"),
    command::<CodeSpectrum>("motion code-spectrum"),
    command::<MotionConvert>("motion convert"),
    command::<MotionInfo>("motion info"),
    command::<MotionSpectrum>("motion spectrum"),
    command::<Match>("motion match"),
    command::<Rotate>("motion rotate"),
    command::<Rotd>("motion rotd"),
    command::<Synth>("motion synth"),
    command::<Simulate>("motion simulate"),
    command::<Assess>("assess"),
    command::<CheckStudy>("check"),
    command::<Run>("run"),
    command::<CheckList>("inventory check"),
    command::<InventoryConvert>("inventory convert"),
    command::<InventoryTemplate>("inventory template"),
    command::<List<Tolerances>>("tolerance list"),
    command::<Show<Tolerances>>("tolerance show"),
    command::<Search<Tolerances>>("tolerance search"),
    command::<List<Cushions>>("cushion list"),
    command::<Show<Cushions>>("cushion show"),
    command::<Search<Cushions>>("cushion search"),
    command::<PlaceList>("place list"),
    command::<PlaceShow>("place show"),
    command::<Validate>("validate"),
    command::<Object>("object"),
    command::<Restrain>("restrain"),
    command::<Rock>("rock"),
    command::<Shock>("shock"),
    command::<ShockSpectrum>("shock-spectrum"),
    command::<Spectrum>("spectrum"),
];

fn of(name: &str) -> Option<&'static Command> {
    COMMANDS.iter().find(|one| one.name == name)
}

/// What a person can type.
fn typed() -> Vec<Asked> {
    let values = ["abc", "-3 parsec", ""];
    let each = good()
        .into_iter()
        .chain(without_files())
        .enumerate()
        .flat_map(|(index, (command, request))| {
            let value = values[index % values.len()];
            let keys = of(command).into_iter().flat_map(|one| (one.keys)());
            keys.map(move |key| {
                let mut changed = request.clone();
                changed[key] = value.into();
                (command, changed)
            })
        });
    each.filter(|asked| problems(asked).is_some()).collect()
}

/// What only a program can ask.
fn of_programs() -> Vec<Asked> {
    let rock = [
        json!({"height": [1], "thickness": {"a": 1}, "nope": 3, "hight": "2 m", "initial_rotation": 0.1}),
        json!({"height": "2 m", "height_m": 2, "thickness": 0.5}),
        json!({"height": 2, "thickness": true, "initial_rotation": 0.1}),
        json!({"height": -2, "thickness": 0.5, "initial_rotation_rad": 0.1, "out": "/tmp/x", "history": "a.csv"}),
        json!({"height": 2, "thickness": 0.5, "initial_rotation": 0.1, "motion": "/etc/passwd"}),
        json!({"height": 2, "thickness": 0.5, "mass": 100, "cushion": "/etc/passwd", "pads_per_edge": 2}),
        json!({"height": 2, "thickness": 0.5, "sliding": "maybe"}),
        json!({"height": 2, "thickness": 0.5, "initial_rotation_deg": 2, "mass_g": 3}),
        json!({"height_kg": "2 m", "thickness": 0.5, "initial_rotation": 0.1, "friction_m": 0.3}),
        json!({"height": 2, "thickness": 0.5, "initial_rotation": 0.1, "wall_gap": 0.1, "wall_gap_left": 0.1}),
        json!({"height": 2, "thickness": 0.5, "initial_rotation": 0.1, "friction": false, "model": false}),
        json!({"height": 2, "thickness": 0.5, "base": "compliant", "mass": 100, "stiffness": 1e6, "width": 0.5,
            "motion": "/etc/passwd", "motion_y": "/etc/passwd", "vertical": ["/etc/passwd", "a"]}),
        json!({"height": 2, "thickness": 0.5, "initial_rotation": 0.1, "vertical": "a", "vertical_scale": 0}),
        json!({"shape": "ball", "height": 2, "diameter": 0.5}),
        json!({"shape": "sphere", "height": 2, "diameter": 0.5, "initial_rotation": 0.1}),
        json!({"shape": "box", "height": 2, "diameter": 0.5, "contact_damping": 2, "contact_sinking": "20 mm"}),
        json!({"shape": "polygon:2", "height": 2, "diameter": 0.5, "restitution": 0.9, "wall_gap_left": 0.1}),
        json!({"shape": "polygon:8", "height": 2, "thickness": 0.5, "base": "compliant", "mass": 100, "stiffness": 1e6,
            "scan_unit": "mm"}),
        json!({"shape": "cylinder", "height": 2, "diameter": 0.5, "thickness": 0.5, "friction": -1, "stand_on": 0}),
        json!({"shape": "cylinder", "height": 0.5, "thickness": 0.5, "sliding": true, "feet": "0.1 m, 0.1 m"}),
        json!({"height": 0.5, "thickness": 0.5, "width": 0.1, "sliding": true, "friction": 0.3, "motion": "/etc/passwd",
            "motion_y": "/etc/passwd", "components": "both", "orientation": "1 m"}),
        json!({"height": 0.5, "thickness": 0.5, "width": 0.1, "sliding": true, "friction": 0.3, "motion": "/etc/passwd"}),
        json!({"feet": "0.1 m; 0.2 m, 0.3 m", "height": 2, "thickness": 0.5, "width": 0.5}),
        json!({"feet": "0.1 m, 0.1 m; 0.2 m, 0.3 m", "height": 2, "thickness": 0.5, "cg_height": 2.5}),
        json!({"feet": "0.1 m, 0.1 m; 0.2 m, 0.3 m; 0.2 m, 0.1 m", "height": 2, "thickness": 0.5, "width": 0.5}),
        json!({"height": 2, "thickness": 0.5, "width": 0.5, "contact_sinking": "0.1 mm", "initial_rotation": 0.1}),
        json!({"scan": "/etc/passwd", "scan_unit": "mm", "stand_on": 2}),
        json!({"scan": "", "scan_unit": "km", "scan_base": "round", "scan_error": -1, "scan_hull": "maybe"}),
        json!({"scan": "a", "shape": "box", "height": 2, "scan_base": "measured", "feet": "0 m, 0 m"}),
    ];
    let others = [
        (
            "shock",
            json!({"height": 2.3, "thickness": 0.6, "mass_kg": 140, "damage_boundary": "/etc/passwd"}),
        ),
        (
            "shock",
            json!({"height": [2.3], "thickness": 0.6, "nope": 1, "tolerance_g": "x"}),
        ),
        (
            "shock-spectrum",
            json!({"files": "/etc/passwd", "column": 2, "q": 0.4, "frequencies_hz": [0, 20], "csv": "/tmp/x"}),
        ),
        (
            "cushion drop",
            json!({"file": ["a.csv", "/etc/passwd"], "height_m": 0.1, "impact_velocity_m_s": 1.4, "velocity_error": 0.6}),
        ),
        (
            "cushion simulate",
            json!({"static": true, "stiffness_n_m": 4e6, "hysteresis": 1.5, "noise": 5}),
        ),
        (
            "motion simulate",
            json!({"magnitude": 6, "distance_m": 20e3, "kappa_s": 30}),
        ),
        (
            "restrain",
            json!({"mass_kg": 1e308, "height": 1.8, "thickness": 0.5, "place": "Wellington"}),
        ),
        (
            "cushion static",
            json!({"load_n": 0, "sensitivity": ["2 mV/N", 3], "toe": true, "out": "/tmp/x"}),
        ),
        (
            "motion code-spectrum",
            json!({"spectrum": "/etc/passwd", "building_height_m": 30, "sds": 1, "out": "/tmp/x"}),
        ),
        (
            "motion synth",
            json!({"time_step_s": 0.02, "shaking_s": 5, "envelope_s": 0.5, "count": 1001, "seed": -1, "match_pga": "yes",
                "out": "/tmp/x"}),
        ),
        (
            "motion match",
            json!({"file": ["a", "b"], "spectrum": "/etc/passwd", "method": "phase", "match_pga": "yes", "seed": 1}),
        ),
        (
            "motion rotate",
            json!({"files": ["a", "b", "/etc/passwd"], "azimuths": [0, 1, 2], "components": "N", "component": 1, "azimuth": "north",
                "out": "/tmp/x"}),
        ),
        (
            "motion rotd",
            json!({"percentiles": [50, 150], "damping": 1, "periods_s": [0, -1], "scale_to_g": 0.3, "components": ["1", "2"]}),
        ),
        (
            "motion rotd",
            json!({"motion": "a", "percentiles": "50, 50 %"}),
        ),
        (
            "motion simulate",
            json!({"magnitude": 9, "distance_m": 5e6, "time_step_s": 0.02, "low_cut_hz": 3, "return_period_years": 500, "count": 0}),
        ),
        (
            "motion simulate",
            json!({"preset": "mars", "distance_m": -1, "hard_rock": "yes", "site": "X", "out": "/tmp/x"}),
        ),
        (
            "motion simulate",
            json!({"place": "Lisbon", "distance_m": 3e4, "return_period": 7}),
        ),
        (
            "floor",
            json!({"motion": "/etc/passwd", "vertical": ["a", "b"], "across": "c", "components": "both", "levels": [0.5, 2],
                "mode_table": "/etc/passwd", "periods_s": [0.1], "vertical_amplification": 1.5, "out": "/tmp/x"}),
        ),
        (
            "object",
            json!({"height": 1.8, "thickness_m": 0.4, "place": "Melborne", "pga_g": 0.3, "study": "/etc/passwd",
                "friction": [0.5, 0.3], "casters": true, "level_ratio": 2, "floor": 3, "storeys": 0, "out": "/tmp/x"}),
        ),
        (
            "object",
            json!({"height": 1.8, "thickness": 0.4, "stiffness_n_m": 4e6, "cushion": "rubber-foot", "motion": ["/etc/passwd"]}),
        ),
        (
            "object",
            json!({"shape": "box", "height": 1.8, "diameter": 0.4, "place": "Lisbon"}),
        ),
        (
            "object",
            json!({"height": 0.4, "thickness": 1.8, "tolerance": "15 g 11 ms", "tolerance_duration_s": 0.01, "worlds": 0,
                "motion": ["/etc/passwd"], "upper_mass_kg": 3, "wall_height": 2, "scales": [0.5, "x"]}),
        ),
        (
            "restrain",
            json!({"height": 1.8, "thickness_m": 0.6, "study": "/etc/passwd", "floor_acceleration_g": 0.5, "code": "asce7",
                "anchors_per_edge": 0, "pivot": "corner", "anchor_shear_capacity_n": -1, "edit": ["D7=900 mm"], "sheet": "A"}),
        ),
        (
            "restrain",
            json!({"list": "/etc/passwd", "mass_kg": 3, "compare": true, "edits": [["D7", "1"], ["D7"], "D"],
                "columns": "/etc/passwd", "level_ratio": -1}),
        ),
        (
            "inventory check",
            json!({"file": "/etc/passwd", "edits": [["D7", "1"], ["D7"], "D"], "columns": "/etc/passwd", "storeys": 0,
                "study": "/etc/passwd", "write_columns": "/tmp/x", "library": "/etc/passwd", "strict": "yes"}),
        ),
        (
            "assess",
            json!({"study": "/etc/passwd", "inventory": "/etc/passwd", "format": ["csv", "pdf"], "fail_on": ["fall"], "threads": 8,
                "storeys": 0, "pages": -1, "edits": [["D7", "1"], ["D7"], "D"], "columns": "/etc/passwd", "force": true, "seed": "x"}),
        ),
        (
            "assess",
            json!({"budget": "15000", "restraints": "/etc/passwd", "horizon_years": -1, "discount": "much"}),
        ),
        ("assess", json!({"budget": "-5 NZD", "discount": 1})),
        ("assess", json!({"budget": "5 NZD", "discount": "300 %"})),
        (
            "assess",
            json!({"restraints": "ours.csv", "horizon_years": "50 yr", "discount": "3 %"}),
        ),
        (
            "run",
            json!({"study": "/etc/passwd", "motion": ["/etc/passwd"], "components": "both", "across": ["/etc/passwd", "b"],
                "vary": ["damping", "nope = 3", 5], "rotation_step_deg": 0, "parquet": "yes", "out": "/tmp/x", "dump_study": true}),
        ),
        ("check", json!({"study": ["a"], "seed": -1, "threads": 2})),
        (
            "fragility",
            json!({"outcomes": "/etc/passwd", "height_m": 2, "motion": ["a"], "place": "Wellington", "ceiling_g": 9,
                "inventory": "/etc/passwd", "hazard": "/etc/passwd", "worlds": 3, "unit": "g", "fit": 3, "out": "/tmp/x"}),
        ),
        (
            "fragility",
            json!({"inventory": "/etc/passwd", "height_m": 2, "motion": ["a"], "vertical": ["b"], "unit": "g", "ceiling_g": 9,
                "worlds": 1, "bootstrap": 1e9, "im": ["pfv", "pgx"], "site_deg": [1], "beta": 0, "options": ["a", "b"]}),
        ),
        (
            "fragility",
            json!({"height_m": 2, "thickness_m": 0.5, "motion": ["a", "b"], "vertical": "c", "stiffness_n_m": 4e6,
                "tolerance_duration_s": 0.01, "resume": true, "options": "d", "strict": true, "sheet": "S", "hazard_im": "pgv",
                "scales": [0, 1], "restitution": 0.9, "restitution_factor": 0.9, "inertia_kg_m2": 3}),
        ),
        (
            "risk",
            json!({"fragility": "/etc/passwd", "outcomes": "/etc/passwd", "hazard": "/etc/passwd", "hazard_power": "a",
                "hazard_code": "as1170.4", "hazard_im": "pga", "fault_distance_m": 3000, "fit": "ordered", "horizon_years": -1,
                "accepted_rate": 0, "years": 0, "budget": 5, "edits": [["D7", "1"], ["D7"]], "csv": "/tmp/x"}),
        ),
        (
            "risk",
            json!({"site": "De", "hazard_factor": 0.1, "site_deg": [151.2, -33.9], "discount_ratio": 0.03, "sheet": "A"}),
        ),
        (
            "risk",
            json!({"outcomes": "/etc/passwd", "hazard_code": "nzs1170.5", "site_deg": [151.2, 91]}),
        ),
        (
            "shard plan",
            json!({"shards": 200000, "study": "/etc/passwd", "out": "/tmp/x", "seed": -1}),
        ),
        ("shard run", json!({"dir": "/etc/passwd", "shard": -1})),
        ("shard merge", json!({"dir": ["a", "b"], "out": "/tmp/x"})),
        ("validate", json!({"table": 1})),
        (
            "place list",
            json!({"word": ["greece", "nz"], "name": "Athens"}),
        ),
        (
            "cushion curve",
            json!({"file": "/etc/passwd", "thickness_m": 0, "limit_g": -1, "static_stress": 3000, "area": 0.02}),
        ),
        (
            "cushion curve",
            json!({"file": "/etc/passwd", "limit_g": 40}),
        ),
        (
            "cushion curve",
            json!({"file": "/etc/passwd", "static_stress": 3000, "drop_height_m": 0.6}),
        ),
        (
            "cushion curve",
            json!({"file": "/etc/passwd", "mass_kg": 3, "area": 0.02, "thickness_m": 0.05}),
        ),
        (
            "cushion simulate",
            json!({"static": true, "stiffness_n_m": 1e6, "mass_kg": 3}),
        ),
        (
            "cushion simulate",
            json!({"static": true, "stiffness_n_m": 1e6, "law": "foo"}),
        ),
        (
            "motion code-spectrum",
            json!({"place": "Melbourne", "parts": true, "building_height_m": 30, "building_period_s": 1}),
        ),
        ("motion simulate", json!({"city": "Wellington"})),
        ("motion simulate", json!({"city": "Atlantis"})),
        (
            "spectrum",
            json!({"heights": [1], "thicknesses": [0.3], "place": "Nowhere"}),
        ),
        (
            "spectrum",
            json!({"heights": [1], "thicknesses": [0.3], "place": "Lisbon", "return_period_years": 50}),
        ),
        (
            "restrain",
            json!({"mass_kg": 3, "height": 1.8, "thickness": 0.5, "code": "foo"}),
        ),
        (
            "cushion recovery",
            json!({"drops": 10001, "samples_per_contact": [1, 25], "noise": 2, "bias": ["x", 1], "seed": -1}),
        ),
        (
            "cushion simulate",
            json!({"mass": -1, "height_m": 1100, "law": "kelvin-voigt", "count": 0, "bounces": 21}),
        ),
        (
            "cushion simulate",
            json!({"static": true, "stiffness": 1e6, "mass": -1, "law": "kelvin-voigt", "damping": "5 %", "height": 1,
                "out": "/tmp/x"}),
        ),
        (
            "cushion simulate",
            json!({"static": "yes", "cushion": "/etc/passwd", "pads_per_edge": 2, "load_n": 1000, "seed": "x"}),
        ),
        ("place show", json!({})),
        (
            "tolerance search",
            json!({"words": "disk", "library": "/etc/passwd"}),
        ),
        (
            "tolerance list",
            json!({"library": "/etc/passwd", "words": "disk"}),
        ),
        ("cushion list", json!({"library": ["/etc/passwd"]})),
        ("cushion show", json!({"id": ["a", "b"], "library_m": 3})),
        (
            "shock-spectrum",
            json!({"motion": ["a"], "record": "b", "damping_ratio": 2}),
        ),
        (
            "spectrum",
            json!({"heights": [1, "x"], "thicknesses": 0.4, "motion": ["/etc/passwd"]}),
        ),
        (
            "spectrum",
            json!({"heights": [], "thicknesses_m": [0.3, 0.4], "csv": "/tmp/x", "place": "Melbourne"}),
        ),
        (
            "spectrum",
            json!({"heights": [1, 2], "thicknesses": [0.3], "pairs": true, "place": "Melbourne", "count": 0}),
        ),
    ];
    rock.map(|request| ("rock", request))
        .into_iter()
        .chain(others)
        .collect()
}

/// The problems of a request; `None` if there are none.
fn problems((command, request): &Asked) -> Option<Vec<Problem>> {
    let Value::Object(entries) = request else {
        return None;
    };
    (of(command)?.ask)(entries)
        .err()
        .map(|problems| problems.problems)
}

/// A line of the table.
fn line(asked: &Asked, is_typed: bool) -> Value {
    let told = |problem: Problem| {
        json!({
            "keys": problem.keys,
            "flag": KeyStyle::Flag.shown(&problem.message),
            "argument": KeyStyle::Argument.shown(&problem.message),
        })
    };
    let problems: Vec<Value> = problems(asked).into_iter().flatten().map(told).collect();
    let (command, request) = asked;
    json!({"command": command, "request": request, "typed": is_typed, "problems": problems})
}

#[test]
fn bad_requests_have_the_problems_of_the_table() {
    let (typed, of_programs) = (typed(), of_programs());
    assert!(typed.len() >= 290, "{} requests", typed.len());
    let mut table = String::new();
    let lines = typed.iter().map(|one| line(one, true));
    for line in lines.chain(of_programs.iter().map(|one| line(one, false))) {
        let problems = line["problems"].as_array().unwrap();
        assert!(!problems.is_empty(), "{line}");
        for problem in problems {
            assert!(
                !problem["keys"].as_array().unwrap().is_empty(),
                "{problem} of {line}"
            );
            assert!(
                !problem["flag"].as_str().unwrap().contains('`'),
                "{problem}"
            );
        }
        writeln!(table, "{line}").unwrap();
    }
    if std::env::var_os("FREESTAND_WRITE").is_some() {
        std::fs::write(TABLE, &table).unwrap();
    }
    let kept = std::fs::read_to_string(TABLE).unwrap();
    assert!(
        kept == table,
        "`cargo xtask generate` writes the table anew"
    );
}

/// The keys in backticks of a text.
fn named(text: &str) -> Vec<&str> {
    let quoted = text.split('`').skip(1).step_by(2);
    quoted
        .filter_map(|words| words.split(" = ").next())
        .collect()
}

#[test]
fn messages_and_hints_name_keys_that_the_command_has() {
    let mut strange = std::collections::BTreeSet::new();
    for asked in typed().iter().chain(&of_programs()) {
        let known = (of(asked.0).unwrap().keys)();
        for problem in problems(asked).into_iter().flatten() {
            let hint = problem.hint.clone().unwrap_or_default();
            assert!(!hint.is_empty(), "{}: {}", asked.0, problem.message);
            for key in named(&problem.message).into_iter().chain(named(&hint)) {
                let is_given = asked.1.get(key).is_some();
                if !known.iter().any(|one| one == key) && !is_given {
                    strange.insert(format!("{}: {key}: {} ({hint})", asked.0, problem.message));
                }
            }
        }
    }
    assert!(strange.is_empty(), "{strange:#?}");
}

/// No mass is needed for a damping that is not felt.
#[test]
fn a_static_test_of_a_damped_pad_needs_no_mass() {
    for (law, stiffness) in [
        ("Kelvin-Voigt", "1100 N/mm"),
        ("hunt-crossley", "2e7 N/m^1.5"),
    ] {
        let asked = json!({"static": true, "stiffness": stiffness, "law": law});
        assert_eq!(problems(&("cushion simulate", asked)), None, "{law}");
    }
}

/// `false` and `null` are what was not asked.
#[test]
fn what_is_not_asked_is_no_problem() {
    let request = json!({"height_m": 2, "height": null, "thickness": 0.5, "initial-rotation": 0.1, "sliding": false,
        "casters": false, "keep_mean": false, "motion": []});
    assert_eq!(problems(&("rock", request)), None);
}

/// What would be answered has no problem.
#[test]
fn good_requests_have_no_problem() {
    for asked in good() {
        let moved = asked.1.get("clearance_left").is_none();
        assert_eq!(
            problems(&asked).is_none(),
            moved,
            "{asked:?}: {:?}",
            problems(&asked)
        );
    }
}
