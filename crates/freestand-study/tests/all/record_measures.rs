//! Measures and spectra of real records against facts that were found by other means (`records/index.json` of the shared
//! folder). Files of a format that is not read are named and passed over; the records are not shipped with the project.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

use freestand_records::formats::ReadOptions;
use freestand_records::processing::Processing;
use freestand_study::inspect::{
    InfoReport, InfoRequest, MotionInfo, SpectrumRequest, info, spectrum,
};
use freestand_study::recorded::{MotionFiles, read_all};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// What the files leave open is known from where they came.
fn options(name: &str, folder: &Path) -> ReadOptions {
    let (unit, dt_s) = match name {
        "tabasFN.txt" => (Some("g"), Some(0.02)),
        _ if name.ends_with(".sac") => (Some("g"), None),
        _ => (None, None),
    };
    let station_xml = name.ends_with(".mseed").then(|| folder.join("CI.CLC.xml"));
    ReadOptions {
        unit: unit.map(str::to_owned),
        dt_s,
        station_xml,
        ..ReadOptions::default()
    }
}

/// The folder, the records of the index, and how they are read.
fn records() -> Option<(PathBuf, Vec<(Value, ReadOptions)>)> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let shared = std::env::var_os("FREESTAND_SHARED")
        .map_or_else(|| workspace.join("../shared"), PathBuf::from);
    let folder = shared.join("records");
    let Ok(text) = std::fs::read(folder.join("index.json")) else {
        println!("skipped: recorded motions are not in $FREESTAND_SHARED/records (../shared)");
        return None;
    };
    let index: Value = serde_json::from_slice(&text).unwrap();
    let records: Vec<(Value, ReadOptions)> = index["records"]
        .as_array()
        .unwrap()
        .iter()
        .map(|record| {
            (
                record.clone(),
                options(record["file"].as_str().unwrap(), &folder),
            )
        })
        .collect();
    assert_eq!(records.len(), 15);
    Some((folder, records))
}

fn files(path: PathBuf, read: ReadOptions, component: Option<String>) -> MotionFiles {
    MotionFiles {
        paths: vec![path],
        read,
        component,
        second: freestand_study::recorded::Second::None,
        vertical: freestand_study::recorded::Upward::Itself("component"),
        processing: Processing::default(),
    }
}

#[track_caller]
fn assert_close(what: &str, found: f64, fact: &Value, relative: f64) {
    let fact = fact.as_f64().expect("a number");
    assert!(
        (found - fact).abs() <= relative * fact.abs(),
        "{what}: {found} is not {fact}"
    );
}

/// The facts have 7 significant digits: half of 1e-6 of the leading digit, and a few roundings.
const DIGITS: f64 = 6e-7;

#[test]
fn measures_of_real_records() {
    let Some((folder, all)) = records() else {
        return;
    };
    for (record, options) in all {
        let name = record["file"].as_str().unwrap();
        let request = InfoRequest {
            files: files(folder.join(name), options, None),
            block: None,
            keep_motions: false,
        };
        let InfoReport { motions, .. } = info(&request).unwrap();
        let channels = record["channels"].as_array().unwrap();
        assert_eq!(motions.len(), channels.len(), "{name}");
        for (one, fact) in motions.iter().zip(channels) {
            check(&format!("{name}, {}", one.contents.component), one, fact);
        }
        println!("{name}: measures of {} components", motions.len());
    }
}

fn check(what: &str, one: &MotionInfo, fact: &Value) {
    let one = serde_json::to_value(one).unwrap();
    let number = |name: &str| one[name].as_f64().unwrap();
    let mean_removed = fact["pga_basis"].as_str().unwrap().contains("mean removed");
    assert_eq!(
        (
            one["is_raw"].as_bool(),
            one["processing"].as_array().map(Vec::len)
        ),
        (Some(mean_removed), Some(usize::from(mean_removed))),
        "{what}"
    );
    let index = if mean_removed {
        &fact["pga_mean_removed_index"]
    } else {
        &fact["pga_as_given_index"]
    };
    assert_eq!(one["pga_index"].as_u64(), index.as_u64(), "{what}");
    assert_eq!(one["npts"].as_u64(), fact["npts"].as_u64(), "{what}");
    assert_close(
        what,
        number("pga_signed_m_s2"),
        &fact["pga_m_per_s2"],
        DIGITS,
    );
    let unit_m_s2 = fact["to_m_per_s2"].as_f64().unwrap();
    assert_close(
        what,
        number("sum_abs_m_s2") / unit_m_s2,
        &fact["sum_abs"],
        DIGITS,
    );
    // A mean may be nothing but round-off of the sum.
    let mean = fact["mean"].as_f64().unwrap();
    assert!(
        (number("mean_m_s2") / unit_m_s2 - mean).abs()
            <= DIGITS * mean.abs() + 1e-12 * number("pga_m_s2"),
        "{what}"
    );
    let first = fact["first4"]
        .as_array()
        .unwrap()
        .iter()
        .zip(one["first_values_m_s2"].as_array().unwrap());
    let last = fact["last2"]
        .as_array()
        .unwrap()
        .iter()
        .zip(one["last_values_m_s2"].as_array().unwrap());
    for (fact, value) in first.chain(last) {
        assert_close(what, value.as_f64().unwrap() / unit_m_s2, fact, DIGITS);
    }
    let im = &fact["im"];
    assert_close(what, number("arias_m_s"), &im["arias_m_per_s"], DIGITS);
    assert_close(what, number("cav_m_s"), &im["cav_m_per_s"], DIGITS);
    assert_close(what, number("d5_75_s"), &im["d5_75_s"], DIGITS);
    assert_close(what, number("d5_95_s"), &im["d5_95_s"], DIGITS);
    assert_close(
        what,
        number("pgv_m_s"),
        &im["pgv_m_per_s_trapz_no_correction"],
        DIGITS,
    );
    // Where every second counts they are two sums of the same terms, in another order.
    assert!(
        number("cav_std_m_s") <= number("cav_m_s") * (1.0 + 1e-12),
        "{what}"
    );
    assert!(
        number("uniform_duration_s") <= number("bracketed_duration_s") * (1.0 + 1e-12),
        "{what}"
    );
}

#[test]
fn spectra_of_real_records() {
    let Some((folder, all)) = records() else {
        return;
    };
    for (record, options) in all {
        let name = record["file"].as_str().unwrap();
        let channels = record["channels"].as_array().unwrap();
        for (i, fact) in channels.iter().enumerate() {
            let component = (channels.len() > 1).then(|| (i + 1).to_string());
            let read = read_all(&files(folder.join(name), options.clone(), component)).unwrap();
            let facts = fact["psa_5pct_m_per_s2"].as_object().unwrap();
            let periods_s: Vec<f64> = facts.keys().map(|period| period.parse().unwrap()).collect();
            let request = SpectrumRequest {
                damping_ratios: vec![0.05],
                periods_s,
                upsample: 1,
            };
            let report = spectrum(&read[0], &request).unwrap();
            for (psa_g, fact) in report.first.psa_g.iter().zip(facts.values()) {
                assert_close(name, psa_g * freestand::G0_M_S2, fact, DIGITS);
            }
        }
        println!("{name}: spectra of {} components", channels.len());
    }
}
