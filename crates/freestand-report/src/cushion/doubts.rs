//! What may be wrong in laboratory tests, as sentences.

use freestand::identify::{FittedLaw, Flag};
use freestand_input::words::{counted, number, shortest, significant};
use freestand_study::laboratory::cushion_curve::{CurveDoubt, CurvePart};
use freestand_study::laboratory::drop_test::doubt::{
    Difference, DropDoubt, DropsDoubt, PooledDoubt,
};
use freestand_study::laboratory::drop_test::{DropReport, DropsReport, PooledReport};
use freestand_study::laboratory::static_curve::StaticsDoubt;

/// What may be wrong in drop tests.
pub fn drops_doubts(report: &DropsReport) -> Vec<String> {
    let pooled = &report.pooled;
    let of_files = report.doubts.iter().map(of_drops);
    of_files
        .chain(no_pad(pooled))
        .chain(pooled.doubts.iter().map(of_pad))
        .collect()
}

fn of_drops(of: &DropsDoubt) -> String {
    let drop = of
        .drop
        .map_or_else(String::new, |drop| format!(", drop {drop}"));
    format!("{}{drop}: {}", of.path, of_drop(&of.doubt))
}

fn of_drop(doubt: &DropDoubt) -> String {
    match doubt {
        DropDoubt::OtherHeight => {
            "the drop height in the file contradicts the `impact_velocity` that was given, which is used".to_owned()
        }
        DropDoubt::OtherVelocity => {
            "the impact velocity in the file contradicts the `height` that was given, which is used".to_owned()
        }
        DropDoubt::OtherNumber {
            key,
            unit,
            said,
            given,
        } => {
            let [given, said] = [*given, *said].map(shortest);
            format!("the file says {key} {said} {unit}; the `{key}` that was given, {given} {unit}, is used")
        }
        DropDoubt::OtherWord { key, said, given } => {
            format!("the file says {key} {said}; the `{key}` that was given, {given}, is used")
        }
        DropDoubt::Record(note) => note.to_string(),
        DropDoubt::EvenlySpaced(dt_s) => format!(
            "`resample` has no effect: the samples are evenly spaced already, by {} s",
            number(*dt_s, 4)
        ),
        DropDoubt::VelocityErrorUnused => {
            "`velocity_error` has no effect: neither `height` nor `impact_velocity` is given, so the impact velocity is \
             found from the pulse"
                .to_owned()
        }
        DropDoubt::Several(drops) => format!(
            "the record has {}, each evaluated by itself",
            counted(*drops, "drop")
        ),
        DropDoubt::Flag(flag) => format!("{}: {}", flag.name(), remedy(*flag)),
        DropDoubt::FewSamples(samples) => format!(
            "{} samples per contact: 50 or more are better",
            significant(*samples, 3)
        ),
        DropDoubt::TooStiff => {
            "no pad is stiffer than 1e6 N/mm: check the mass, the unit of the acceleration and the time step".to_owned()
        }
        DropDoubt::WideSpread(spread_ratio) => format!(
            "the four estimates differ by {} %, although the pulse is that of a linear pad: check mass, height and \
             zero line",
            significant(100.0 * spread_ratio, 2)
        ),
        DropDoubt::Filtered(corner_hz) => format!(
            "the pulse looks like one behind a low-pass filter of about {} Hz, and the stiffness is the one behind it: \
             give `corner` if the instrument has one; the interval includes the stiffness without a filter",
            significant(*corner_hz, 2)
        ),
        DropDoubt::Curved(compression_m) => format!(
            "the pad hardens or softens: its stiffness is F/d at {} mm, the largest compression of this drop, and \
             holds for this compression alone; the law in the cushion file is a table up to it",
            significant(1e3 * compression_m, 3)
        ),
        DropDoubt::NoGravity => {
            "the pulse fits a contact without gravity: the zero line is not that of a free fall".to_owned()
        }
        DropDoubt::Thin => no_half_space("its thickness"),
        DropDoubt::SmallSphere => no_half_space("the sphere's radius"),
    }
}

fn no_half_space(length: &str) -> String {
    format!(
        "the pad is compressed by more than a quarter of {length}: Hertz's half space (n = 1.5) does not apply"
    )
}

/// What a flag means and how to remove its cause.
fn remedy(flag: Flag) -> &'static str {
    match flag {
        Flag::NoPulse => "no pulse exceeds the noise: check the column, the unit and the trigger",
        Flag::UpsideDown => {
            "the pulse points down: change its sign if the sensor is mounted upside down"
        }
        Flag::NoPreTrigger => {
            "too few samples before the contact for a zero line: use a longer pre-trigger"
        }
        Flag::CutOff => "the record ends before the contact does: record for longer",
        Flag::Clipped => "the top of the pulse is flat: use a larger sensor range or a lower drop",
        Flag::FewSamples => "fewer than 25 samples per contact: sample at a higher rate",
        Flag::ZeroShift => {
            "the zero line shifts during the contact: check the cable and the mounting of the sensor"
        }
        Flag::Drift => {
            "the zero line drifts: let the sensor settle, or check its coupling and temperature"
        }
        Flag::Filter => {
            "the low-pass corner is below 6 divided by the contact time, so the pulse shows the filter as well \
             as the pad: raise the corner, and state it as `corner`"
        }
        Flag::Impulse => {
            "the impulse of the pulse does not agree with the mass and its velocity: check the unit, the mass \
             and the drop height"
        }
        Flag::Velocity => {
            "the pulse fits an impact velocity that differs from the stated one: check the height and the guides"
        }
        Flag::Damping => {
            "the pulse returns more energy than it took, so no damping is reported: check the zero line and the \
             velocity, or try another law"
        }
        Flag::PoorFit => {
            "no law fits the samples: check in the loop whether the pad bottoms or the plate tilts"
        }
        Flag::Integration => {
            "the stiffness from the integrated samples differs from that of the fit: check the velocity, the zero \
             line and the filter"
        }
    }
}

/// What to do so that a drop gives a stiffness; `None`: it does.
pub(super) fn no_stiffness(report: &DropReport) -> Option<String> {
    if report.test.identified.is_some() {
        return None;
    }
    let remedies: Vec<&str> = report.test.flags.iter().copied().map(remedy).collect();
    Some(match remedies.as_slice() {
        [] => "no law could be fitted".to_owned(),
        some => some.join("; "),
    })
}

/// Why drops give no pad although each has a stiffness.
pub(super) fn no_pad(pooled: &PooledReport) -> Option<String> {
    let words = |name: &str, said: &[String]| format!("{name} ({})", said.join(", "));
    let sizes = |name: &str, range: [f64; 2], unit: &str| {
        let [low, high] = range.map(|value| significant(value, 4));
        format!("{name} ({low} to {high} {unit})")
    };
    let difference = |difference: &Difference| match difference {
        Difference::Impactor(said) => words("impactor", said),
        Difference::SphereRadius(range_m) => sizes(
            "sphere radius",
            range_m.map(|radius_m| 1e3 * radius_m),
            "mm",
        ),
        Difference::Boundary(said) => words("boundary", said),
        Difference::Mass(range_kg) => sizes("mass", *range_kg, "kg"),
    };
    let differences: Vec<String> = pooled.differences.iter().map(difference).collect();
    (!differences.is_empty()).then(|| {
        format!(
            "the drops are not repeats: they differ in {}; evaluate each set on its own",
            differences.join(" and ")
        )
    })
}

fn of_pad(doubt: &PooledDoubt) -> String {
    match doubt {
        PooledDoubt::OtherLaws { laws, law, pooled } => {
            let names: Vec<&str> = laws.iter().copied().map(FittedLaw::name).collect();
            format!(
                "the drops fit different laws ({}): only those that fit {} are pooled ({pooled} of {}); `law` sets one \
                 for all",
                names.join(", "),
                law.name(),
                laws.len()
            )
        }
        PooledDoubt::UndampedTable => {
            "the pad is damped, and the table in its cushion file is not".to_owned()
        }
        PooledDoubt::OtherHeights => {
            "the drops are from different heights and the stiffness of the pad depends on the compression: the pooled \
             stiffness is valid for no height; evaluate each height on its own"
                .to_owned()
        }
    }
}

/// What may be wrong in static tests.
pub fn statics_doubt(doubt: &StaticsDoubt) -> String {
    match doubt {
        StaticsDoubt::RatioOfTheseTests => {
            "the ratio of dynamic to static stiffness is valid for these tests only, not for another pad, boundary or \
             impactor"
                .to_owned()
        }
        StaticsDoubt::UnloadsAbove(path) => format!(
            "{path}: the unloading curve is above the loading curve: check the signs and the order of the points"
        ),
        StaticsDoubt::OtherCycles { path, cycles } => {
            let others = if *cycles == 1 { "cycle is" } else { "cycles are" };
            format!("{path}: {cycles} other {others} left out: the last full one is evaluated")
        }
        StaticsDoubt::NegativeToe { path, before_m } => format!(
            "{path}: the tangent meets zero force {} mm before the first point: this indicates a preload or a pad that \
             softens; with `toe = \"keep\"` the secant starts at the first point",
            significant(1e3 * before_m, 3)
        ),
    }
}

/// What may be wrong about a cushion curve.
pub fn curve_doubt(doubt: &CurveDoubt) -> String {
    let idle = |key: &str, needs: &str| {
        format!("`{key}` has no effect: all tests state theirs, and a design also needs {needs}")
    };
    match doubt {
        CurveDoubt::Extrapolated {
            part,
            energy_j_m3,
            tested_j_m3: (least, most),
        } => {
            let what = match part {
                CurvePart::BestStress => "the best static stress",
                CurvePart::Peak => "the peak",
                CurvePart::Thickness => "the thickness",
                CurvePart::Optimum => "the optimum thickness",
            };
            format!(
                "{what} needs the curve at {energy_j_m3:.4e} J/m³, but the tests cover {least:.4e} to {most:.4e}: it is \
                 extrapolated"
            )
        }
        CurveDoubt::TooLight => {
            "no thickness keeps the peak within the limit at this static stress: the load is too light for this \
             cushion; reduce the area of the cushion"
                .to_owned()
        }
        CurveDoubt::Scatter(r_squared_ratio) => format!(
            "the tests scatter about the stress-energy curve (R² = {r_squared_ratio:.3}): one curve may not apply to \
             all heights and thicknesses"
        ),
        CurveDoubt::DropHeightUnused => idle("drop_height", "`thickness` or `limit`"),
        CurveDoubt::ThicknessUnused => idle("thickness", "`drop_height`"),
    }
}

#[cfg(test)]
mod tests {
    use freestand_records::notes::{Note, NoteKind};

    use super::*;
    use crate::doubts::tests::all;

    #[test]
    fn every_doubt_in_words() {
        let text = str::to_owned;
        let of_drops = [
            DropDoubt::OtherHeight,
            DropDoubt::OtherVelocity,
            DropDoubt::OtherNumber {
                key: "mass",
                unit: "kg",
                said: 0.365,
                given: 0.4,
            },
            DropDoubt::OtherWord {
                key: "boundary",
                said: text("glued"),
                given: text("unglued"),
            },
            DropDoubt::Record(Note::new(NoteKind::FarFactor, "a note of the record")),
            DropDoubt::EvenlySpaced(2e-5),
            DropDoubt::VelocityErrorUnused,
            DropDoubt::Several(3),
            DropDoubt::Flag(Flag::Clipped),
            DropDoubt::FewSamples(31.234),
            DropDoubt::TooStiff,
            DropDoubt::WideSpread(0.1234),
            DropDoubt::Filtered(4321.0),
            DropDoubt::Curved(1.2345e-3),
            DropDoubt::NoGravity,
            DropDoubt::Thin,
            DropDoubt::SmallSphere,
        ];
        all(&of_drops);
        let flags = [
            Flag::NoPulse,
            Flag::UpsideDown,
            Flag::NoPreTrigger,
            Flag::CutOff,
            Flag::Clipped,
            Flag::FewSamples,
            Flag::ZeroShift,
            Flag::Drift,
            Flag::Filter,
            Flag::Impulse,
            Flag::Velocity,
            Flag::Damping,
            Flag::PoorFit,
            Flag::Integration,
        ];
        let differences = vec![
            Difference::Impactor(vec![text("flat"), text("sphere")]),
            Difference::SphereRadius([0.02, 0.03]),
            Difference::Boundary(vec![text("glued"), text("unglued")]),
            Difference::Mass([0.365, 0.4]),
        ];
        all(&differences);
        let of_pads = [
            PooledDoubt::OtherLaws {
                laws: vec![FittedLaw::Linear, FittedLaw::Power, FittedLaw::Power],
                law: FittedLaw::Power,
                pooled: 2,
            },
            PooledDoubt::UndampedTable,
            PooledDoubt::OtherHeights,
        ];
        all(&of_pads);
        let report = DropsReport {
            tests: Vec::new(),
            pooled: PooledReport {
                pad: None,
                differences,
                doubts: of_pads.to_vec(),
            },
            failed: Vec::new(),
            doubts: vec![
                DropsDoubt {
                    path: text("a.csv"),
                    drop: None,
                    doubt: DropDoubt::Several(2),
                },
                DropsDoubt {
                    path: text("a.csv"),
                    drop: Some(2),
                    doubt: DropDoubt::TooStiff,
                },
            ],
        };
        let cycles = |cycles| StaticsDoubt::OtherCycles {
            path: text("a.csv"),
            cycles,
        };
        let of_statics = [
            StaticsDoubt::RatioOfTheseTests,
            StaticsDoubt::UnloadsAbove(text("a.csv")),
            cycles(1),
            cycles(2),
            StaticsDoubt::NegativeToe {
                path: text("a.csv"),
                before_m: 1.2345e-4,
            },
        ];
        all(&of_statics);
        let extrapolated = |part| CurveDoubt::Extrapolated {
            part,
            energy_j_m3: 1.5e5,
            tested_j_m3: (2e4, 8e4),
        };
        let of_curves = [
            extrapolated(CurvePart::BestStress),
            extrapolated(CurvePart::Peak),
            extrapolated(CurvePart::Thickness),
            extrapolated(CurvePart::Optimum),
            CurveDoubt::TooLight,
            CurveDoubt::Scatter(0.8765),
            CurveDoubt::DropHeightUnused,
            CurveDoubt::ThicknessUnused,
        ];
        all(&of_curves);
        let told = of_drops
            .iter()
            .map(of_drop)
            .chain(flags.map(|flag| remedy(flag).to_owned()))
            .chain(drops_doubts(&report))
            .chain(of_statics.iter().map(statics_doubt))
            .chain(of_curves.iter().map(curve_doubt));
        insta::assert_snapshot!(told.collect::<Vec<_>>().join("\n"));
    }
}
