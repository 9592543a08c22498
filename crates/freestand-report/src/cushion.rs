//! Laboratory tests of cushions.

use freestand::impact::ValidityWarning;
use freestand_output::answer::Answer;
use freestand_output::answer_of;
use freestand_study::cushion::EdgeCushion;
use freestand_study::laboratory::drop_test::{DropReport, DropsReport, PooledReport};
use freestand_study::laboratory::static_curve::StaticsReport;
use freestand_study::laboratory::virtual_laboratory::AssumedDamping;
use freestand_study::recorded::Failed;

mod doubts;

pub use self::doubts::{curve_doubt, drops_doubts, statics_doubt};
use self::doubts::{no_pad, no_stiffness};
use crate::doubts::{cushion_note, model_limit};
use crate::table::{Column, facts_table, failed_lines, lines};

answer_of!(
    /// Drop tests, and why some give no stiffness.
    pub struct DropsAnswer<'r>(pub &'r DropsReport) as report {
    tests: Vec<OfDrop<'_>> = report.0.tests.iter().map(OfDrop).collect();
    pooled: OfPad<'_> = OfPad(&report.0.pooled);
    /// Files that could not be read.
    failed: Vec<&Failed> = report.0.failed.iter().collect();
});

answer_of!(
    /// A drop.
    struct OfDrop<'r>(&'r DropReport) as one {
    drop: &DropReport = one.0 => flat;
    reason: Option<String> = no_stiffness(one.0) => "no stiffness";
});

answer_of!(
    /// All drops as one pad.
    struct OfPad<'r>(&'r PooledReport) as one {
    pooled: &PooledReport = one.0 => flat;
    /// Why there is no pad although each drop has a stiffness.
    reason: Option<String> = no_pad(one.0);
});

/// The table of several tests.
const DROPS: [Column; 14] = [
    ("path", "file", 0),
    ("drop", "drop", 0),
    ("impact_velocity_m_s", "impact velocity [m/s]", 4),
    ("peak_acceleration_g", "peak [g]", 4),
    ("contact_time_s", "contact time [ms]", 4),
    ("max_compression_m", "compression [mm]", 4),
    ("restitution_ratio", "restitution", 3),
    ("fit", "stiffness [N/mm]", 5),
    ("integrated", "integrated [N/mm]", 4),
    ("spread_ratio", "spread [%]", 2),
    ("law", "law", 0),
    ("exponent", "exponent", 3),
    ("damping_ratio", "damping", 2),
    ("flags", "flags", 0),
];

/// Where no file has several drops, their number says nothing.
fn columns(report: &DropsReport) -> Vec<Column> {
    let is_shown = report.tests.iter().any(|test| test.drop > 1);
    DROPS
        .into_iter()
        .filter(|(key, ..)| is_shown || *key != "drop")
        .collect()
}

/// What drop tests say about a cushion.
pub fn drops_text(report: &DropsReport) -> String {
    let mut out = if let [one] = report.tests.as_slice() {
        lines(&OfDrop(one).facts())
    } else {
        facts_table(report.tests.iter().map(Answer::facts), &columns(report))
    };
    if report.pooled.pad.is_some() {
        out += &format!("\n{}", lines(&report.pooled.facts()));
    }
    out + &failed_lines(&report.failed)
}

const STATICS: [Column; 10] = [
    ("path", "file", 0),
    ("impactor", "impactor", 0),
    ("boundary", "boundary", 0),
    ("load_n", "load [N]", 4),
    ("tangent_stiffness_n_m", "tangent [N/mm]", 4),
    ("secant_stiffness_n_m", "secant [N/mm]", 4),
    ("hysteresis_ratio", "hysteresis [%]", 3),
    ("toe_m", "toe [mm]", 3),
    ("exponent", "exponent", 3),
    ("dynamic_over_static_ratio", "dynamic/static", 3),
];

/// What static tests say about a cushion.
pub fn statics_text(report: &StaticsReport) -> String {
    facts_table(report.tests.iter().map(Answer::facts), &STATICS) + &failed_lines(&report.failed)
}

/// How a virtual pad was read, and what is doubtful about it.
pub fn virtual_pad_notes(
    edge: &EdgeCushion,
    assumed: Option<AssumedDamping>,
    doubts: &[ValidityWarning],
) -> Vec<String> {
    let assumed = assumed.map(|AssumedDamping { law, key, value }| {
        format!("the {key} of the {law} pad is not given; {value} is assumed")
    });
    let doubts = doubts.iter().map(model_limit);
    let read = edge.notes.iter().map(cushion_note);
    read.chain(assumed).chain(doubts).collect()
}

/// The table of tests that were made up.
pub const SIMULATED: [Column; 5] = [
    ("path", "test", 0),
    ("peak_acceleration_g", "peak [g]", 5),
    ("contact_time_s", "contact time [ms]", 5),
    ("samples_per_contact", "samples per contact", 4),
    ("restitution_ratio", "restitution", 4),
];

/// The table of laws that were found again.
pub const RECOVERED: [Column; 12] = [
    ("law", "law", 0),
    ("samples_per_contact", "samples", 0),
    ("noise_ratio", "noise [%]", 0),
    ("bias_g", "bias [g]", 0),
    ("zero_shift_ratio", "zero shift [%]", 0),
    ("given", "given", 0),
    ("flagged", "flagged", 0),
    ("stiffness_bias_ratio", "stiffness bias [%]", 2),
    ("stiffness_rms_ratio", "stiffness rms [%]", 2),
    ("coverage_ratio", "coverage [%]", 3),
    ("exponent_bias", "exponent bias", 2),
    ("damping_bias", "damping bias", 2),
];
