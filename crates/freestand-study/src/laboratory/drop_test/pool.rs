//! Repeated drops of one pad as one law, and why some drops are no repeats.

use std::fmt::Write;

use freestand::identify::{Pooled, PooledDrop, pool_drops};
use serde::Serialize;

use super::DropReport;
use freestand_input::words::significant;

/// Masses further apart than this are not those of one plate.
const MASS_SHARE: f64 = 0.01;
/// Impact velocities further apart than this are of other heights: two errors of 1 %, and somewhat.
const SPEED_SHARE: f64 = 0.03;

/// All drops of one pad.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct PooledReport {
    pub stiffness_n_m: Option<f64>,
    pub ci95_n_m: Option<[f64; 2]>,
    pub exponent: Option<f64>,
    pub scatter_ratio: Option<f64>,
    pub count: usize,
    pub law: Option<&'static str>,
    pub coefficient_n_mn: Option<f64>,
    pub damping_ratio: Option<f64>,
    pub damping_n_s_m: Option<f64>,
    pub dissipation_s_m: Option<f64>,
    pub restitution_ratio: Option<f64>,
    /// Why there is no stiffness of all, where the drops have one each.
    pub reason: Option<String>,
}

/// Pools the drops that have a stiffness and the law of most of them; none where they are no repeats of each other.
pub(super) fn pooled(tests: &[DropReport], seed: u64, warnings: &mut Vec<String>) -> PooledReport {
    let given: Vec<&DropReport> = tests.iter().filter(|test| test.stiffness_n_m.is_some()).collect();
    let differences = differences(&given);
    if !differences.is_empty() {
        let reason =
            format!("the drops are no repeats, they differ in {}: run one command for each", differences.join(" and "));
        warnings.push(reason.clone());
        return PooledReport::none(Some(reason));
    }
    let Some(law) = most_common(&given) else { return PooledReport::none(None) };
    let alike: Vec<&DropReport> = given.iter().copied().filter(|test| test.law == Some(law)).collect();
    if alike.len() < given.len() {
        let laws: Vec<&str> = given.iter().filter_map(|test| test.law).collect();
        warnings.push(format!(
            "the drops fit different laws ({}): pooled from the {} of {law} alone; --law takes one for all",
            laws.join(", "),
            alike.len()
        ));
    }
    if !matches!(law, "linear" | "kelvin-voigt") && are_of_other_heights(&alike) {
        warnings.push(
            "the drops are of different heights and the pad is curved: their stiffnesses are secants at different depths, \
             and the pooled one is of none of them; run one command for each height"
                .to_owned(),
        );
    }
    of_repeats(&alike, law, seed)
}

fn of_repeats(tests: &[&DropReport], law: &'static str, seed: u64) -> PooledReport {
    let drops: Vec<PooledDrop> = tests
        .iter()
        .filter_map(|test| test.test.as_ref().and_then(|test| test.identified.as_ref()))
        .map(|f| PooledDrop { stiffness_n_m: f.stiffness.fit_n_m, error_ratio: f.error_ratio, exponent: f.exponent })
        .collect();
    let Some(pooled) = pool_drops(&drops, seed) else { return PooledReport::none(None) };
    let mean = |of: fn(&DropReport) -> Option<f64>| {
        let values: Vec<f64> = tests.iter().filter_map(|test| of(test)).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    PooledReport {
        stiffness_n_m: Some(pooled.stiffness_n_m),
        ci95_n_m: Some([pooled.ci95_n_m.0, pooled.ci95_n_m.1]),
        exponent: Some(pooled.exponent),
        scatter_ratio: pooled.scatter_ratio,
        count: drops.len(),
        law: Some(law),
        coefficient_n_mn: Some(coefficient(tests, law, &pooled)),
        damping_ratio: mean(|test| test.damping_ratio),
        damping_n_s_m: mean(|test| test.damping_n_s_m),
        dissipation_s_m: mean(|test| test.dissipation_s_m),
        restitution_ratio: mean(|test| test.restitution_ratio),
        reason: None,
    }
}

impl PooledReport {
    fn none(reason: Option<String>) -> Self {
        Self {
            stiffness_n_m: None,
            ci95_n_m: None,
            exponent: None,
            scatter_ratio: None,
            count: 0,
            law: None,
            coefficient_n_mn: None,
            damping_ratio: None,
            damping_n_s_m: None,
            dissipation_s_m: None,
            restitution_ratio: None,
            reason,
        }
    }
}

/// What makes drops tests of different things, with their values. What a file does not say differs from nothing.
fn differences(tests: &[&DropReport]) -> Vec<String> {
    let words = |name: &str, of: fn(&DropReport) -> Option<&str>| {
        let mut said: Vec<String> =
            tests.iter().filter_map(|test| of(test)).map(|text| text.trim().to_lowercase()).collect();
        said.sort_unstable();
        said.dedup();
        (said.len() > 1).then(|| format!("{name} ({})", said.join(", ")))
    };
    let lengths = |name: &str, unit: &str, scale: f64, of: fn(&DropReport) -> Option<f64>| {
        let (least, most) = range(tests.iter().filter_map(|test| of(test)))?;
        let [low, high] = [least, most].map(|value| significant(scale * value, 4));
        (most > (1.0 + MASS_SHARE) * least).then(|| format!("{name} ({low} to {high} {unit})"))
    };
    [
        words("impactor", |test| test.impactor.as_deref()),
        lengths("sphere radius", "mm", 1e3, |test| test.sphere_radius_m),
        words("boundary", |test| test.boundary.as_deref()),
        lengths("mass", "kg", 1.0, |test| Some(test.mass_kg)),
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
    let speeds = tests.iter().filter_map(|test| test.impact_velocity_m_s);
    range(speeds).is_some_and(|(least, most)| most > (1.0 + SPEED_SHARE) * least)
}

/// K with the pooled exponent, so that F/d at the mean compression is the pooled stiffness.
fn coefficient(tests: &[&DropReport], law: &str, pooled: &Pooled) -> f64 {
    if matches!(law, "linear" | "kelvin-voigt") {
        return pooled.stiffness_n_m;
    }
    let depths: Vec<f64> = tests.iter().filter_map(|t| t.max_compression_m).collect();
    let depth_m = (depths.iter().map(|d| d.ln()).sum::<f64>() / depths.len().max(1) as f64).exp();
    pooled.stiffness_n_m * depth_m.powf(1.0 - pooled.exponent)
}

/// The law of most; of several the first.
fn most_common(tests: &[&DropReport]) -> Option<&'static str> {
    let laws: Vec<&'static str> = tests.iter().filter_map(|test| test.law).collect();
    let count = |law: &str| laws.iter().filter(|other| **other == law).count();
    // Of equal ones `max_by_key` takes the last.
    laws.iter().rev().copied().max_by_key(|law| count(law))
}

/// The pooled law as a file that later commands read; `None` without one.
pub fn cushion_toml(pooled: &PooledReport) -> Option<String> {
    let (law, coefficient) = (pooled.law?, pooled.coefficient_n_mn?);
    let mut text = String::from("# One pad, from drop tests; --pads-per-edge says how many carry an edge.\n");
    let is_linear = matches!(law, "linear" | "kelvin-voigt");
    // Writing to a String cannot fail.
    let _ = writeln!(text, "law = \"{law}\"");
    let _ = match pooled.exponent.filter(|_| !is_linear) {
        Some(n) => writeln!(text, "stiffness = \"{coefficient} N/m^{n}\"\nexponent = {n}"),
        None => writeln!(text, "stiffness = \"{} N/mm\"", coefficient / 1e3),
    };
    if let Some(damping) = pooled.damping_n_s_m {
        let _ = writeln!(text, "damping = \"{damping} N s/m\"");
    }
    if let Some(dissipation) = pooled.dissipation_s_m {
        let _ = writeln!(text, "dissipation = \"{dissipation} s/m\"");
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use freestand::G0_M_S2;
    use freestand::cushion::{ContactLaw, Cushion};
    use freestand::identify::VirtualDropOptions;

    use crate::laboratory::drop_test::{DropRequest, DropsReport, cushion_toml, drop_tests};
    use crate::laboratory::virtual_test::drop_file;

    /// A drop of 0.365 kg by `height_m`, of 60 samples per contact, with lines of comment before it.
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
        std::fs::write(&path, format!("{said}{}", drop_file(cushion, &options).unwrap().0)).unwrap();
        path
    }

    fn of(files: Vec<PathBuf>) -> DropsReport {
        let request = DropRequest { files, velocity_error_ratio: 0.01, gravity_m_s2: G0_M_S2, ..Default::default() };
        drop_tests(&request).unwrap()
    }

    #[test]
    fn drops_that_are_no_repeats_are_not_pooled() {
        let folder = tempfile::tempdir().unwrap();
        let pad = Cushion::linear(2.19e6).unwrap();
        let file = |name: &str, said: &str| write(folder.path(), name, &pad, 0.1, said);
        let [plain, glued, unglued, sphere] = [
            file("plain.csv", ""),
            file("glued.csv", "# boundary: glued\n# impactor: flat\n"),
            file("unglued.csv", "# boundary: unglued\n# impactor: Flat\n"),
            file("sphere.csv", "# impactor: sphere\n"),
        ];
        let report = of(vec![plain.clone(), glued.clone()]);
        assert!(report.all_gave() && report.pooled.count == 2 && report.pooled.reason.is_none());
        for (files, word) in
            [([glued.clone(), unglued], "boundary (glued, unglued)"), ([glued, sphere], "impactor (flat, sphere)")]
        {
            let report = of(files.to_vec());
            assert!(report.tests.iter().all(|test| test.stiffness_n_m.is_some()));
            assert!(!report.all_gave() && report.pooled.stiffness_n_m.is_none(), "{:?}", report.pooled);
            assert_eq!(cushion_toml(&report.pooled), None);
            let said = report.warnings.join("; ");
            assert!(said.contains(word) && said.contains("run one command for each"), "{said}");
            assert!(!said.contains(" and "), "one tag alone differs: {said}");
        }
    }

    /// Secants of a Hertz pad at 50 and 200 mm differ by 4^(1/5) = 1.32 and are no repeats; of a linear pad they are.
    #[test]
    fn other_heights_matter_where_the_pad_is_curved() {
        let folder = tempfile::tempdir().unwrap();
        let hertz = Cushion::new(ContactLaw::Power { coefficient_n_mn: 2e7, exponent: 1.5 }).unwrap();
        for (pad, is_warned) in [(Cushion::linear(2.19e6).unwrap(), false), (hertz, true)] {
            let files = [0.05, 0.2].map(|h| write(folder.path(), &format!("{h}.csv"), &pad, h, ""));
            let report = of(files.to_vec());
            assert_eq!(report.warnings.iter().any(|text| text.contains("different heights")), is_warned);
            assert_eq!(report.pooled.count, 2);
        }
    }

    /// Two drops on a Hertz pad and one on a linear one: every pooled number is of the two.
    #[test]
    fn all_pooled_numbers_are_of_the_same_drops() {
        let folder = tempfile::tempdir().unwrap();
        let hertz = Cushion::new(ContactLaw::Power { coefficient_n_mn: 2e7, exponent: 1.5 }).unwrap();
        let linear = write(folder.path(), "linear.csv", &Cushion::linear(2.19e6).unwrap(), 0.1, "");
        let curved = write(folder.path(), "hertz.csv", &hertz, 0.1, "");
        let (mixed, two) =
            (of(vec![linear.clone(), curved.clone(), curved.clone()]), of(vec![curved.clone(), curved.clone()]));
        assert_eq!(mixed.pooled, two.pooled);
        assert_eq!((mixed.pooled.law, mixed.pooled.count), (Some("power"), 2));
        assert!(mixed.warnings.iter().any(|text| text.contains("the 2 of power alone")), "{:?}", mixed.warnings);
        // Of as many of each law, the first counts.
        assert_eq!(of(vec![linear, curved]).pooled.law, Some("linear"));
    }
}
