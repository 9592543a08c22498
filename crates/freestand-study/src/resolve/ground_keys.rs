//! Keys of `[ground]` that belong together, with their lines, and why one excludes another.

use super::line;
use crate::options::GroundOptions;

/// Keys of `processing` that scale records to a target of their own.
pub(super) const SCALES_TO: [&str; 3] = ["scale_to", "scale_to_sa", "scale_to_spectrum"];

/// Where a point source is written.
pub(super) fn source_line(written: &GroundOptions) -> Option<usize> {
    written.point_source.as_ref().map(|source| source.line)
}

/// Why a key excludes another one, and the usual remedy.
pub(super) fn other(why: &'static str) -> (&'static str, &'static str) {
    (why, "keep one of them")
}

/// The keys of `[ground]` that describe motions other than records, with their lines.
pub(super) fn synthetic_keys(written: &GroundOptions) -> Vec<(&'static str, Option<usize>)> {
    let others = [
        ("count", line(&written.count)),
        ("seed", line(&written.seed)),
        ("point_source", source_line(written)),
    ];
    written.target.lines().chain(others).collect()
}

/// The keys that say how files are read, with their lines.
pub(super) fn reading_keys(
    written: &GroundOptions,
) -> impl Iterator<Item = (&'static str, Option<usize>)> {
    let others = [
        ("across", line(&written.across)),
        ("components", line(&written.components)),
        ("rotation_step", line(&written.rotation_step_rad)),
        ("processing", written.processing),
    ];
    let files = ["unit", "dt", "component", "station_xml", "scale"]
        .map(|key| (key, written.reading.line_of(&[key])));
    files.into_iter().chain(others)
}

/// The keys that belong to `suite`, with their lines.
pub(super) fn suite_keys(written: &GroundOptions) -> [(&'static str, Option<usize>); 2] {
    [
        ("suite_count", line(&written.suite_count)),
        ("suite_scale", line(&written.suite_scale)),
    ]
}
