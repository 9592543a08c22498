//! Repeated drops on one pad as one law, and why some drops are not repeats.

use std::fmt::Write;

use freestand::cushion::Cushion;
use freestand::identify::{FittedLaw, Pooled, PooledDrop, pool_drops};

use super::doubt::{Difference, PooledDoubt};
use super::{DropReport, numbers};
use freestand_output::answer_of;

/// Masses that differ by more than this are those of different plates.
const MASS_SHARE: f64 = 0.01;
/// Impact velocities that differ by more than this come from different heights: two errors of 1 %
/// and a margin.
const SPEED_SHARE: f64 = 0.03;

/// A pad with less restitution than this is damped: the shock of one that is not differs by a tenth.
const ELASTIC: f64 = 0.9;

/// The pooled result of all drops.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PooledReport {
    /// The pad; `None` where the drops give none.
    pub pad: Option<PooledPad>,
    /// Why there is none although each drop has a stiffness: they are no repeats.
    pub differences: Vec<Difference>,
    /// What is doubtful in all drops together.
    pub doubts: Vec<PooledDoubt>,
}

/// A pad as several drops give it; damping and restitution are means.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledPad {
    pub law: FittedLaw,
    pub stiffness: Pooled,
    /// K; `None` for a law without one.
    pub coefficient_n_mn: Option<f64>,
    /// Compressions \[m\] and forces \[N\] of a law without a formula of cushion files.
    pub table: Option<(Vec<f64>, Vec<f64>)>,
    pub damping_ratio: Option<f64>,
    pub damping_n_s_m: Option<f64>,
    pub dissipation_s_m: Option<f64>,
    pub restitution_ratio: Option<f64>,
}

/// Pools the drops that have a stiffness and the law of most of them, if they are repeats of each
/// other.
pub(super) fn pooled(tests: &[DropReport], seed: u64) -> PooledReport {
    let given: Vec<&DropReport> = tests.iter().filter(|test| test.found().is_some()).collect();
    let differences = differences(&given);
    if !differences.is_empty() {
        return PooledReport {
            differences,
            ..PooledReport::default()
        };
    }
    let Some(law) = most_common(&given) else {
        return PooledReport::default();
    };
    let alike: Vec<&DropReport> = given
        .iter()
        .copied()
        .filter(|test| law_of(test) == Some(law))
        .collect();
    let mut doubts = Vec::new();
    if alike.len() < given.len() {
        doubts.push(PooledDoubt::OtherLaws {
            laws: given.iter().filter_map(|test| law_of(test)).collect(),
            law,
            pooled: alike.len(),
        });
    }
    if is_curve(law)
        && alike
            .iter()
            .any(|test| test.test.restitution_ratio.is_some_and(|e| e < ELASTIC))
    {
        doubts.push(PooledDoubt::UndampedTable);
    }
    if !is_linear(law) && are_of_other_heights(&alike) {
        doubts.push(PooledDoubt::OtherHeights);
    }
    PooledReport {
        pad: of_repeats(&alike, law, seed),
        differences,
        doubts,
    }
}

fn law_of(test: &DropReport) -> Option<FittedLaw> {
    test.found().map(|found| found.chosen)
}

/// Whether the stiffness of a law does not depend on the compression.
fn is_linear(law: FittedLaw) -> bool {
    matches!(law, FittedLaw::Linear | FittedLaw::KelvinVoigt)
}

/// Whether a law is a table in cushion files.
fn is_curve(law: FittedLaw) -> bool {
    matches!(law, FittedLaw::Cubic | FittedLaw::Tabulated)
}

/// Points of a pooled table.
const POINTS: u32 = 32;

/// The mean force of the drops up to the compression that all of them reached, so that its secant there is the pooled
/// stiffness.
fn mean_curve(tests: &[&DropReport], pooled: &Pooled) -> (Vec<f64>, Vec<f64>) {
    let laws: Vec<Cushion> = tests
        .iter()
        .filter_map(|test| Cushion::new(test.found()?.law.clone()).ok())
        .collect();
    let depths = tests.iter().filter_map(|test| test.test.max_compression_m);
    let most_m = depths.fold(f64::INFINITY, f64::min);
    let mean =
        |d: f64| laws.iter().map(|law| law.force_n(d, 0.0)).sum::<f64>() / laws.len().max(1) as f64;
    let factor = pooled.stiffness_n_m * most_m / mean(most_m);
    (0..=POINTS)
        .map(|i| most_m * f64::from(i) / f64::from(POINTS))
        .map(|d| (d, factor * mean(d)))
        .unzip()
}

fn of_repeats(tests: &[&DropReport], law: FittedLaw, seed: u64) -> Option<PooledPad> {
    let drops: Vec<PooledDrop> = tests
        .iter()
        .filter_map(|test| test.found())
        .map(|f| PooledDrop {
            stiffness_n_m: f.stiffness.fit_n_m,
            error_ratio: f.error_ratio,
            exponent: f.exponent,
        })
        .collect();
    let stiffness = pool_drops(&drops, seed)?;
    let mean = |of: fn(&DropReport) -> Option<f64>| {
        let values: Vec<f64> = tests.iter().filter_map(|test| of(test)).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    Some(PooledPad {
        law,
        stiffness,
        coefficient_n_mn: (!is_curve(law)).then(|| coefficient(tests, law, &stiffness)),
        table: is_curve(law).then(|| mean_curve(tests, &stiffness)),
        damping_ratio: mean(|test| test.found().map(|found| found.damping_ratio)),
        damping_n_s_m: mean(|test| numbers(test.found()).1),
        dissipation_s_m: mean(|test| numbers(test.found()).2),
        restitution_ratio: mean(|test| test.test.restitution_ratio),
    })
}

impl PooledReport {
    /// A number of the pad.
    fn of<T>(&self, value: impl Fn(&PooledPad) -> T) -> Option<T> {
        self.pad.as_ref().map(value)
    }
}

answer_of!(PooledReport as pooled {
    stiffness_n_m: Option<f64> = pooled.of(|pad| pad.stiffness.stiffness_n_m) => "stiffness of the pad";
    ci95_n_m: Option<[f64; 2]> = pooled.of(|pad| pad.stiffness.ci95_n_m.into()) => "  95 % interval";
    exponent: Option<f64> = pooled.of(|pad| pad.stiffness.exponent) => "  exponent";
    scatter_ratio: Option<f64> = pooled.of(|pad| pad.stiffness.scatter_ratio).flatten();
    count: usize = pooled.of(|pad| pad.stiffness.count).unwrap_or(0) => "  drops";
    law: Option<&'static str> = pooled.of(|pad| pad.law.name()) => "  law";
    coefficient_n_mn: Option<f64> = pooled.of(|pad| pad.coefficient_n_mn).flatten();
    damping_ratio: Option<f64> = pooled.of(|pad| pad.damping_ratio).flatten();
    damping_n_s_m: Option<f64> = pooled.of(|pad| pad.damping_n_s_m).flatten();
    dissipation_s_m: Option<f64> = pooled.of(|pad| pad.dissipation_s_m).flatten();
    restitution_ratio: Option<f64> = pooled.of(|pad| pad.restitution_ratio).flatten();
});

/// The properties in which the drops differ too much to be repeats, with their values. A value that
/// is not given counts as equal.
fn differences(tests: &[&DropReport]) -> Vec<Difference> {
    let words = |of: fn(&DropReport) -> Option<&str>| {
        let mut said: Vec<String> = tests
            .iter()
            .filter_map(|test| of(test))
            .map(|text| text.trim().to_lowercase())
            .collect();
        said.sort_unstable();
        said.dedup();
        (said.len() > 1).then_some(said)
    };
    let sizes = |of: fn(&DropReport) -> Option<f64>| {
        let (least, most) = range(tests.iter().filter_map(|test| of(test)))?;
        (most > (1.0 + MASS_SHARE) * least).then_some([least, most])
    };
    [
        words(|test| test.impactor.as_deref()).map(Difference::Impactor),
        sizes(|test| test.sphere_radius_m).map(Difference::SphereRadius),
        words(|test| test.boundary.as_deref()).map(Difference::Boundary),
        sizes(|test| Some(test.mass_kg)).map(Difference::Mass),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, value| {
        let (least, most) = range.unwrap_or((value, value));
        Some((value.min(least), value.max(most)))
    })
}

fn are_of_other_heights(tests: &[&DropReport]) -> bool {
    let speeds = tests
        .iter()
        .filter_map(|test| test.test.impact_velocity_m_s);
    range(speeds).is_some_and(|(least, most)| most > (1.0 + SPEED_SHARE) * least)
}

/// K with the pooled exponent, so that F/d at the mean compression is the pooled stiffness.
fn coefficient(tests: &[&DropReport], law: FittedLaw, pooled: &Pooled) -> f64 {
    if is_linear(law) {
        return pooled.stiffness_n_m;
    }
    let depths: Vec<f64> = tests
        .iter()
        .filter_map(|t| t.test.max_compression_m)
        .collect();
    let depth_m = (depths.iter().map(|d| d.ln()).sum::<f64>() / depths.len().max(1) as f64).exp();
    pooled.stiffness_n_m * depth_m.powf(1.0 - pooled.exponent)
}

/// The most common law; of several that are equally common, the first.
fn most_common(tests: &[&DropReport]) -> Option<FittedLaw> {
    let laws: Vec<FittedLaw> = tests.iter().filter_map(|test| law_of(test)).collect();
    let count = |law: FittedLaw| laws.iter().filter(|other| **other == law).count();
    // Of equal counts `max_by_key` takes the last.
    laws.iter().rev().copied().max_by_key(|law| count(*law))
}

/// The pooled law as a cushion file that later commands read; `None` without a pooled law.
pub fn cushion_toml(pooled: &PooledReport) -> Option<String> {
    let pad = pooled.pad.as_ref()?;
    if let Some((compressions_m, forces_n)) = &pad.table {
        return Some(table_toml(compressions_m, forces_n));
    }
    let (coefficient, n) = (pad.coefficient_n_mn?, pad.stiffness.exponent);
    let mut text = String::from(
        "# One pad, from drop tests; pads_per_edge is the number of pads under one edge.\n",
    );
    // Writing to a String cannot fail.
    let _ = writeln!(text, "law = \"{}\"", pad.law.name());
    let _ = if is_linear(pad.law) {
        writeln!(text, "stiffness = \"{} N/mm\"", coefficient / 1e3)
    } else {
        writeln!(
            text,
            "stiffness = \"{coefficient} N/m^{n}\"\nexponent = {n}"
        )
    };
    if let Some(damping) = pad.damping_n_s_m {
        let _ = writeln!(text, "damping = \"{damping} N s/m\"");
    }
    if let Some(dissipation) = pad.dissipation_s_m {
        let _ = writeln!(text, "dissipation = \"{dissipation} s/m\"");
    }
    Some(text)
}

fn table_toml(compressions_m: &[f64], forces_n: &[f64]) -> String {
    let list = |values: &[f64], scale: f64, unit: &str| {
        let cells: Vec<String> = values
            .iter()
            .map(|value| format!("\"{} {unit}\"", scale * value))
            .collect();
        format!("[{}]", cells.join(", "))
    };
    format!(
        "# One pad, from drop tests; pads_per_edge is the number of pads under one edge.\n# The pad hardens or softens: \
         the table ends at the largest compression of the tests, and its last line goes on beyond it.\nlaw = \
         \"tabulated\"\ncompressions = {}\nforces = {}\n",
        list(compressions_m, 1e3, "mm"),
        list(forces_n, 1.0, "N")
    )
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};
    use std::slice;

    use freestand::G0_M_S2;
    use freestand::cushion::{ContactLaw, Cushion};
    use freestand::identify::{FittedLaw, VirtualDropOptions};

    use crate::laboratory::drop_test::doubt::{Difference, PooledDoubt};
    use crate::laboratory::drop_test::{DropRequest, DropsReport, cushion_toml, drop_tests};
    use crate::laboratory::virtual_laboratory::drop_file;

    /// A drop of 0.365 kg by `height_m`, of 60 samples per contact, with lines of comment before
    /// it.
    fn write(folder: &Path, name: &str, cushion: &Cushion, height_m: f64, said: &str) -> PathBuf {
        let (mass_kg, speed_m_s) = (0.365, (2.0 * G0_M_S2 * height_m).sqrt());
        let contact_s = cushion.land(mass_kg, speed_m_s).duration_s;
        let options = VirtualDropOptions {
            mass_kg,
            speed_m_s,
            gravity_m_s2: G0_M_S2,
            sample_rate_hz: 60.0 / contact_s,
            pre_trigger_s: 3.0 * contact_s,
            after_s: 4.0 * contact_s,
            noise_ratio: 0.002,
            bias_m_s2: 0.0,
            zero_shift_ratio: 0.0,
            filter_corner_hz: None,
            bounces: 0,
            speed_error_ratio: 0.0,
            seed: 1,
            index: 0,
        };
        let path = folder.join(name);
        std::fs::write(
            &path,
            format!("{said}{}", drop_file(cushion, &options).unwrap().0),
        )
        .unwrap();
        path
    }

    fn of(files: Vec<PathBuf>) -> DropsReport {
        let request = DropRequest {
            files,
            velocity_error_ratio: Some(0.01),
            gravity_m_s2: G0_M_S2,
            ..Default::default()
        };
        drop_tests(&request).unwrap()
    }

    fn count(report: &DropsReport) -> usize {
        report.pooled.pad.as_ref().unwrap().stiffness.count
    }

    fn law(report: &DropsReport) -> FittedLaw {
        report.pooled.pad.as_ref().unwrap().law
    }

    #[test]
    #[ignore = "seconds: several drops"]
    fn drops_that_are_not_repeats_are_not_pooled() {
        not_pooled(&[("glued", "unglued", boundary())]);
    }

    #[test]
    #[ignore = "ten seconds: the same of every tag"]
    fn drops_that_differ_in_any_tag_are_not_pooled() {
        not_pooled(&[
            ("glued", "unglued", boundary()),
            (
                "glued",
                "sphere",
                Difference::Impactor(["flat", "sphere"].map(str::to_owned).to_vec()),
            ),
        ]);
    }

    fn boundary() -> Difference {
        Difference::Boundary(["glued", "unglued"].map(str::to_owned).to_vec())
    }

    /// Two drops that are repeats, and those that differ in one tag, which is told.
    fn not_pooled(different: &[(&str, &str, Difference)]) {
        let folder = tempfile::tempdir().unwrap();
        let pad = Cushion::linear(2.19e6).unwrap();
        let file = |name: &str, said: &str| write(folder.path(), name, &pad, 0.1, said);
        let tagged = |name: &str| match name {
            "glued" => file("glued.csv", "# boundary: glued\n# impactor: flat\n"),
            "unglued" => file("unglued.csv", "# boundary: unglued\n# impactor: Flat\n"),
            _ => file("sphere.csv", "# impactor: sphere\n"),
        };
        let report = of(vec![file("plain.csv", ""), tagged("glued")]);
        assert!(report.all_gave() && count(&report) == 2);
        assert!(report.pooled.differences.is_empty());
        for (one, other, difference) in different {
            let report = of(vec![tagged(one), tagged(other)]);
            assert!(report.tests.iter().all(|test| test.found().is_some()));
            assert!(
                !report.all_gave() && report.pooled.pad.is_none(),
                "{:?}",
                report.pooled
            );
            assert_eq!(cushion_toml(&report.pooled), None);
            assert_eq!(&report.pooled.differences[..], slice::from_ref(difference));
        }
    }

    /// Secants of a Hertz pad at 50 and 200 mm differ by 4^(1/5) = 1.32, so they are not
    /// repeats; those of a linear pad are.
    #[test]
    #[ignore = "seconds: drops from several heights"]
    fn other_heights_matter_where_the_pad_is_curved() {
        let folder = tempfile::tempdir().unwrap();
        let hertz = Cushion::new(ContactLaw::Power {
            coefficient_n_mn: 2e7,
            exponent: 1.5,
        })
        .unwrap();
        for (pad, is_warned) in [(Cushion::linear(2.19e6).unwrap(), false), (hertz, true)] {
            let files = [0.05, 0.2].map(|h| write(folder.path(), &format!("{h}.csv"), &pad, h, ""));
            let report = of(files.to_vec());
            let is_told = report.pooled.doubts == [PooledDoubt::OtherHeights];
            assert_eq!(is_told, is_warned, "{:?}", report.pooled.doubts);
            assert_eq!(count(&report), 2);
        }
    }

    /// Of as many drops of each law, those of the first count alone.
    #[test]
    #[ignore = "seconds: several drops"]
    fn drops_of_two_laws_are_not_pooled() {
        let folder = tempfile::tempdir().unwrap();
        let [linear, curved] = linear_and_curved(folder.path());
        let report = of(vec![linear, curved]);
        assert_eq!((law(&report), count(&report)), (FittedLaw::Linear, 1));
    }

    fn linear_and_curved(folder: &Path) -> [PathBuf; 2] {
        let hertz = Cushion::new(ContactLaw::Power {
            coefficient_n_mn: 2e7,
            exponent: 1.5,
        })
        .unwrap();
        [
            ("linear.csv", Cushion::linear(2.19e6).unwrap()),
            ("hertz.csv", hertz),
        ]
        .map(|(name, pad)| write(folder, name, &pad, 0.1, ""))
    }

    /// Two drops on a Hertz pad and one on a linear one: every pooled number is of the two.
    #[test]
    #[ignore = "ten seconds: seven drops"]
    fn all_pooled_numbers_are_of_the_same_drops() {
        let folder = tempfile::tempdir().unwrap();
        let [linear, curved] = linear_and_curved(folder.path());
        let (mixed, two) = (
            of(vec![linear, curved.clone(), curved.clone()]),
            of(vec![curved.clone(), curved]),
        );
        assert_eq!(mixed.pooled.pad, two.pooled.pad);
        assert_eq!((law(&mixed), count(&mixed)), (FittedLaw::Power, 2));
        let other = PooledDoubt::OtherLaws {
            laws: vec![FittedLaw::Linear, FittedLaw::Power, FittedLaw::Power],
            law: FittedLaw::Power,
            pooled: 2,
        };
        assert!(
            mixed.pooled.doubts.contains(&other),
            "{:?}",
            mixed.pooled.doubts
        );
    }
}
