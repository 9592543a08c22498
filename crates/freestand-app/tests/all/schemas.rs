//! The schemas in docs/schema are those of the structs.

use std::path::PathBuf;

use freestand_app::assess::{self, Assess};
use freestand_app::check_list::{self, CheckList, HeadingsReport};
use freestand_app::code_spectrum::{self, CodeSpectrum};
use freestand_app::cushion_curve::{self, CushionCurve};
use freestand_app::drop_test::{self, DropTests};
use freestand_app::floor::{self, Floor};
use freestand_app::fragility::{self, Fragility};
use freestand_app::inventory::{self, InventoryConvert, InventoryTemplate};
use freestand_app::job::{PLAN_SCHEMA, SHARD_SCHEMA, ShardReport};
use freestand_app::library::{Cushions, Library as _, List, Listed, Search, Show, Tolerances};
use freestand_app::motion::{self, MotionConvert, MotionInfo, MotionSpectrum};
use freestand_app::object::{self, Object};
use freestand_app::pair::{self, Rotate, RotateReport, Rotd};
use freestand_app::places::{self, Found, PlaceList, PlaceShow};
use freestand_app::recovery::{self, Recovery};
use freestand_app::restrain::{self, Restrain};
use freestand_app::risk::{self, Risk};
use freestand_app::rock::{Results, Rock, SCHEMA};
use freestand_app::run::{self, CheckStudy, Run};
use freestand_app::schema::{of_fields, of_request, of_response, of_responses, with_rows};
use freestand_app::shard::{MERGE_SCHEMA, MissingShards, ShardMerge, ShardPlan, ShardRun};
use freestand_app::shock::{self, Shock};
use freestand_app::shock_spectrum::{self, ShockSpectrum};
use freestand_app::simulate::{self, Simulate};
use freestand_app::spectrum::{self, Others, Spectrum};
use freestand_app::static_test::{self, StaticTests};
use freestand_app::synth::{self, Match, Synth};
use freestand_app::validate;
use freestand_app::virtual_test::{self, VirtualTests};
use freestand_inventory::CheckReport;
use freestand_inventory::library::{CushionEntry, ToleranceEntry};
use freestand_output::answer::{Answer, Described as _, object};
use freestand_report::assessment::{JobReport, PlanReport, row_schema};
use freestand_report::cushion::DropsAnswer;
use freestand_report::fragility::{FragilityAnswer, RunsAnswer};
use freestand_report::ground::SimulatedAnswer;
use freestand_report::object::ObjectReport;
use freestand_report::restraint::{RestrainListReport, RestrainReport};
use freestand_report::risk::RiskAnswer;
use freestand_report::shock::LandingReport;
use freestand_report::study::check::Check;
use freestand_report::study::summary::{self, RunAnswer};
use freestand_report::target::{CodeSpectrumAnswer, FitAnswer};
use freestand_study::floor::FloorReport;
use freestand_study::inspect::{InfoReport, RotdReport};
use freestand_study::laboratory::cushion_curve::CurveReport;
use freestand_study::laboratory::static_curve::StaticsReport;
use freestand_study::laboratory::virtual_laboratory::{RecoveryReport, SimulatedTests};
use freestand_study::shock_spectrum::ShockSpectrumReport;
use freestand_study::spectrum::SpectrumRow;
use freestand_study::validate::Validation;
use schemars::JsonSchema;
use serde_json::{Map, Value};

/// The schema of a response of one kind.
fn of_answer<A: Answer>(command: &str, schema: &str) -> Value {
    of_response(command, schema, &[A::schema()])
}

/// The schema of a response whose keys are the fields of its struct.
fn of_struct<T: JsonSchema>(command: &str, schema: &str) -> Value {
    of_response(command, schema, &[of_fields::<T>()])
}

/// The values of an assessment: a row for each object, and the summary.
fn assessed() -> Map<String, Value> {
    with_rows(row_schema(), JobReport::properties())
}

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
                &[FragilityAnswer::schema(), RunsAnswer::schema()],
            ),
        ),
        (
            "object.response.json",
            of_response("object", object::SCHEMA, &[ObjectReport::schema()]),
        ),
        (
            "restrain.response.json",
            of_response(
                "restrain",
                restrain::SCHEMA,
                &[RestrainReport::schema(), RestrainListReport::schema()],
            ),
        ),
        (
            "risk.response.json",
            of_answer::<RiskAnswer<'_>>("risk", risk::SCHEMA),
        ),
        ("risk.request.json", of_request::<Risk>("risk", &["seed"])),
        (
            "shard-plan.request.json",
            of_request::<ShardPlan>("shard plan", &["seed"]),
        ),
        (
            "shard-plan.response.json",
            of_answer::<PlanReport>("shard plan", PLAN_SCHEMA),
        ),
        (
            "shard-run.request.json",
            of_request::<ShardRun>("shard run", &[]),
        ),
        (
            "shard-run.response.json",
            of_answer::<ShardReport>("shard run", SHARD_SCHEMA),
        ),
        (
            "shard-merge.request.json",
            of_request::<ShardMerge>("shard merge", &[]),
        ),
        (
            "shard-merge.response.json",
            of_responses(
                "shard merge",
                [
                    (assess::SCHEMA, assessed()),
                    (MERGE_SCHEMA, MissingShards::properties()),
                ],
            ),
        ),
        ("shock.request.json", of_request::<Shock>("shock", &[])),
        (
            "spectrum.request.json",
            of_request::<Spectrum>("spectrum", &["seed"]),
        ),
        (
            "spectrum.response.json",
            of_response(
                "spectrum",
                spectrum::SCHEMA,
                &[object(with_rows(
                    SpectrumRow::schema(),
                    Others::properties(),
                ))],
            ),
        ),
        (
            "shock.response.json",
            of_answer::<LandingReport>("shock", shock::SCHEMA),
        ),
        (
            "shock-spectrum.request.json",
            of_request::<ShockSpectrum>("shock-spectrum", &[]),
        ),
        (
            "shock-spectrum.response.json",
            of_answer::<ShockSpectrumReport>("shock-spectrum", shock_spectrum::SCHEMA),
        ),
        (
            "cushion-drop.request.json",
            of_request::<DropTests>("cushion drop", &["seed"]),
        ),
        (
            "cushion-drop.response.json",
            of_answer::<DropsAnswer<'_>>("cushion drop", drop_test::SCHEMA),
        ),
        (
            "cushion-curve.request.json",
            of_request::<CushionCurve>("cushion curve", &[]),
        ),
        (
            "cushion-curve.response.json",
            of_answer::<CurveReport>("cushion curve", cushion_curve::SCHEMA),
        ),
        (
            "cushion-recovery.request.json",
            of_request::<Recovery>("cushion recovery", &["seed"]),
        ),
        (
            "cushion-recovery.response.json",
            of_answer::<RecoveryReport>("cushion recovery", recovery::SCHEMA),
        ),
        (
            "cushion-simulate.request.json",
            of_request::<VirtualTests>("cushion simulate", &["seed"]),
        ),
        (
            "cushion-simulate.response.json",
            of_answer::<SimulatedTests>("cushion simulate", virtual_test::SCHEMA),
        ),
        (
            "cushion-static.request.json",
            of_request::<StaticTests>("cushion static", &[]),
        ),
        (
            "cushion-static.response.json",
            of_answer::<StaticsReport>("cushion static", static_test::SCHEMA),
        ),
        (
            "motion-info.request.json",
            of_request::<MotionInfo>("motion info", &[]),
        ),
        (
            "motion-info.response.json",
            of_answer::<InfoReport>("motion info", motion::INFO),
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
            "motion-synth.response.json",
            of_answer::<FitAnswer<'_>>("motion synth", synth::SCHEMA),
        ),
        (
            "motion-match.request.json",
            of_request::<Match>("motion match", &[]),
        ),
        (
            "motion-match.response.json",
            of_answer::<FitAnswer<'_>>("motion match", synth::SCHEMA),
        ),
        (
            "motion-simulate.request.json",
            of_request::<Simulate>("motion simulate", &["seed"]),
        ),
        (
            "motion-simulate.response.json",
            of_answer::<SimulatedAnswer<'_>>("motion simulate", simulate::SCHEMA),
        ),
        (
            "code-spectrum.request.json",
            of_request::<CodeSpectrum>("motion code-spectrum", &[]),
        ),
        (
            "code-spectrum.response.json",
            of_answer::<CodeSpectrumAnswer<'_>>("motion code-spectrum", code_spectrum::SCHEMA),
        ),
        ("floor.request.json", of_request::<Floor>("floor", &[])),
        (
            "floor.response.json",
            of_answer::<FloorReport>("floor", floor::SCHEMA),
        ),
        (
            "object.request.json",
            of_request::<Object>("object", &["seed"]),
        ),
        (
            "assess.request.json",
            of_request::<Assess>("assess", &["seed"]),
        ),
        (
            "assess.response.json",
            of_response("assess", assess::SCHEMA, &[object(assessed())]),
        ),
        ("run.request.json", of_request::<Run>("run", &["seed"])),
        (
            "run.response.json",
            of_answer::<RunAnswer<'_>>("run", summary::SCHEMA),
        ),
        (
            "check.request.json",
            of_request::<CheckStudy>("check", &["seed"]),
        ),
        (
            "check.response.json",
            of_answer::<Check<'_>>("check", run::CHECK_SCHEMA),
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
        (
            "place-list.response.json",
            of_answer::<Found>("place list", places::SCHEMA),
        ),
        (
            "place-show.response.json",
            of_answer::<Found>("place show", places::SCHEMA),
        ),
        (
            "tolerance-list.response.json",
            of_struct::<Listed<'_, ToleranceEntry>>("tolerance list", Tolerances::SCHEMA),
        ),
        (
            "cushion-list.response.json",
            of_struct::<Listed<'_, CushionEntry>>("cushion list", Cushions::SCHEMA),
        ),
        (
            "tolerance-show.response.json",
            of_struct::<Listed<'_, ToleranceEntry>>("tolerance show", Tolerances::SCHEMA),
        ),
        (
            "cushion-show.response.json",
            of_struct::<Listed<'_, CushionEntry>>("cushion show", Cushions::SCHEMA),
        ),
        (
            "tolerance-search.response.json",
            of_struct::<Listed<'_, ToleranceEntry>>("tolerance search", Tolerances::SCHEMA),
        ),
        (
            "cushion-search.response.json",
            of_struct::<Listed<'_, CushionEntry>>("cushion search", Cushions::SCHEMA),
        ),
        (
            "inventory-check.response.json",
            of_response(
                "inventory check",
                check_list::SCHEMA,
                &[of_fields::<CheckReport>(), of_fields::<HeadingsReport>()],
            ),
        ),
        (
            "inventory-template.response.json",
            of_struct::<inventory::TemplateReport>("inventory template", check_list::SCHEMA),
        ),
        (
            "inventory-convert.response.json",
            of_struct::<inventory::ConvertReport>("inventory convert", check_list::SCHEMA),
        ),
        (
            "validate.response.json",
            of_struct::<Validation>("validate", validate::SCHEMA),
        ),
        (
            "motion-spectrum.response.json",
            of_struct::<motion::SpectrumAnswer<'_>>("motion spectrum", motion::SPECTRUM),
        ),
        (
            "motion-convert.response.json",
            of_struct::<motion::ConvertReport>("motion convert", motion::CONVERT),
        ),
        (
            "motion-rotate.response.json",
            of_struct::<RotateReport>("motion rotate", pair::ROTATE),
        ),
        (
            "motion-rotd.response.json",
            of_struct::<RotdReport>("motion rotd", pair::ROTD),
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
