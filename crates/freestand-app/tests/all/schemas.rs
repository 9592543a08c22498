//! The schemas in docs/schema are those of the structs.

use std::path::PathBuf;

use freestand_app::assess::Assess;
use freestand_app::check_list::CheckList;
use freestand_app::code_spectrum::CodeSpectrum;
use freestand_app::cushion_curve::CushionCurve;
use freestand_app::drop_test::DropTests;
use freestand_app::floor::Floor;
use freestand_app::fragility::{self, Fragility};
use freestand_app::inventory::{InventoryConvert, InventoryTemplate};
use freestand_app::library::{Cushions, List, Search, Show, Tolerances};
use freestand_app::motion::{MotionConvert, MotionInfo, MotionSpectrum};
use freestand_app::object::Object;
use freestand_app::pair::{Rotate, Rotd};
use freestand_app::places::{PlaceList, PlaceShow};
use freestand_app::recovery::Recovery;
use freestand_app::restrain::Restrain;
use freestand_app::risk::{self, Risk};
use freestand_app::rock::{Results, Rock, SCHEMA};
use freestand_app::run::{CheckStudy, Run};
use freestand_app::schema::{of_request, of_response};
use freestand_app::shard::{ShardMerge, ShardPlan, ShardRun};
use freestand_app::shock::{self, Shock};
use freestand_app::shock_spectrum::ShockSpectrum;
use freestand_app::simulate::Simulate;
use freestand_app::spectrum::Spectrum;
use freestand_app::static_test::StaticTests;
use freestand_app::synth::{Match, Synth};
use freestand_app::virtual_test::VirtualTests;
use freestand_assess::fragility::{FragilityReport, RunsReport};
use freestand_assess::risk::RiskReport;
use freestand_output::answer::Answer;
use freestand_study::shock::ShockAnswer;

#[test]
fn the_schemas_are_those_of_the_structs() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/schema");
    let schemas = [
        (
            "fragility.request.json",
            of_request::<Fragility>("fragility", &["seed"]),
        ),
        (
            "fragility.response.json",
            of_response(
                "fragility",
                fragility::SCHEMA,
                &[FragilityReport::properties(), RunsReport::properties()],
            ),
        ),
        (
            "risk.response.json",
            of_response("risk", risk::SCHEMA, &[RiskReport::properties()]),
        ),
        ("risk.request.json", of_request::<Risk>("risk", &["seed"])),
        (
            "shard-plan.request.json",
            of_request::<ShardPlan>("shard plan", &["seed"]),
        ),
        (
            "shard-run.request.json",
            of_request::<ShardRun>("shard run", &[]),
        ),
        (
            "shard-merge.request.json",
            of_request::<ShardMerge>("shard merge", &[]),
        ),
        ("shock.request.json", of_request::<Shock>("shock", &[])),
        (
            "spectrum.request.json",
            of_request::<Spectrum>("spectrum", &["seed"]),
        ),
        (
            "shock.response.json",
            of_response("shock", shock::SCHEMA, &[ShockAnswer::properties()]),
        ),
        (
            "shock-spectrum.request.json",
            of_request::<ShockSpectrum>("shock-spectrum", &[]),
        ),
        (
            "cushion-drop.request.json",
            of_request::<DropTests>("cushion drop", &["seed"]),
        ),
        (
            "cushion-curve.request.json",
            of_request::<CushionCurve>("cushion curve", &[]),
        ),
        (
            "cushion-recovery.request.json",
            of_request::<Recovery>("cushion recovery", &["seed"]),
        ),
        (
            "cushion-simulate.request.json",
            of_request::<VirtualTests>("cushion simulate", &["seed"]),
        ),
        (
            "cushion-static.request.json",
            of_request::<StaticTests>("cushion static", &[]),
        ),
        (
            "motion-info.request.json",
            of_request::<MotionInfo>("motion info", &[]),
        ),
        (
            "motion-spectrum.request.json",
            of_request::<MotionSpectrum>("motion spectrum", &[]),
        ),
        (
            "motion-convert.request.json",
            of_request::<MotionConvert>("motion convert", &[]),
        ),
        (
            "motion-rotate.request.json",
            of_request::<Rotate>("motion rotate", &[]),
        ),
        (
            "motion-rotd.request.json",
            of_request::<Rotd>("motion rotd", &[]),
        ),
        (
            "motion-synth.request.json",
            of_request::<Synth>("motion synth", &["seed"]),
        ),
        (
            "motion-match.request.json",
            of_request::<Match>("motion match", &[]),
        ),
        (
            "motion-simulate.request.json",
            of_request::<Simulate>("motion simulate", &["seed"]),
        ),
        (
            "code-spectrum.request.json",
            of_request::<CodeSpectrum>("motion code-spectrum", &[]),
        ),
        ("floor.request.json", of_request::<Floor>("floor", &[])),
        (
            "object.request.json",
            of_request::<Object>("object", &["seed"]),
        ),
        (
            "assess.request.json",
            of_request::<Assess>("assess", &["seed"]),
        ),
        ("run.request.json", of_request::<Run>("run", &["seed"])),
        (
            "check.request.json",
            of_request::<CheckStudy>("check", &["seed"]),
        ),
        (
            "inventory-check.request.json",
            of_request::<CheckList>("inventory check", &[]),
        ),
        (
            "inventory-convert.request.json",
            of_request::<InventoryConvert>("inventory convert", &[]),
        ),
        (
            "inventory-template.request.json",
            of_request::<InventoryTemplate>("inventory template", &[]),
        ),
        (
            "tolerance-list.request.json",
            of_request::<List<Tolerances>>("tolerance list", &[]),
        ),
        (
            "tolerance-show.request.json",
            of_request::<Show<Tolerances>>("tolerance show", &[]),
        ),
        (
            "tolerance-search.request.json",
            of_request::<Search<Tolerances>>("tolerance search", &[]),
        ),
        (
            "cushion-list.request.json",
            of_request::<List<Cushions>>("cushion list", &[]),
        ),
        (
            "cushion-show.request.json",
            of_request::<Show<Cushions>>("cushion show", &[]),
        ),
        (
            "cushion-search.request.json",
            of_request::<Search<Cushions>>("cushion search", &[]),
        ),
        (
            "place-list.request.json",
            of_request::<PlaceList>("place list", &[]),
        ),
        (
            "place-show.request.json",
            of_request::<PlaceShow>("place show", &[]),
        ),
        (
            "restrain.request.json",
            of_request::<Restrain>("restrain", &[]),
        ),
        ("rock.request.json", of_request::<Rock>("rock", &[])),
        (
            "rock.response.json",
            of_response("rock", SCHEMA, &Results::kinds()),
        ),
    ];
    for (name, schema) in schemas {
        let text = serde_json::to_string_pretty(&schema).unwrap() + "\n";
        if std::env::var_os("FREESTAND_WRITE").is_some() {
            std::fs::write(folder.join(name), &text).unwrap();
        }
        let kept = std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(
            kept == text,
            "{name}: `cargo xtask generate` writes it anew"
        );
    }
}
