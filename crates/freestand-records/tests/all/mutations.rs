//! Damaged records: every seed of the fuzz targets, altered in ways in which files do get damaged.
//! Nothing may panic, hang, or be read into something that is no motion.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

#[path = "../../../../fuzz/src/check.rs"]
#[allow(unreachable_pub, reason = "the fuzz targets use it from another crate")]
mod check;
#[path = "../../../../fuzz/src/damage.rs"]
#[allow(unreachable_pub, reason = "other crates use it")]
mod damage;

use check::{check_hazard, check_record};
use damage::{Chance, mutations, split_lines};
use freestand_records::formats::{Component, ReadOptions, parse_motions};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

/// What each seed is read as.
const READ: &[(&str, &str, &str)] = &[
    ("at2", "crlf.at2", "PEER AT2"),
    ("at2", "nga1.at2", "PEER AT2"),
    ("at2", "nga2.at2", "PEER AT2"),
    ("bhrc", "vol1.v1", "BHRC volume 1"),
    ("columns", "blanks.txt", "columns"),
    ("columns", "comma.csv", "CSV"),
    ("columns", "comments.txt", "columns"),
    ("columns", "one.txt", "columns"),
    ("columns", "semicolon.csv", "CSV"),
    ("columns", "series.txt", "columns"),
    ("columns", "uneven.csv", "CSV"),
    ("cosmos", "corrected.v2c", "COSMOS V2"),
    ("csmip", "pairs.v1", "CSMIP V1"),
    ("csmip", "renadic.v1", "RENADIC"),
    ("csmip", "uncorrected.v1", "CSMIP V1"),
    ("csmip_v2", "corrected.v2", "CSMIP V2"),
    ("cwa", "quake.txt", "CWA"),
    ("cwa", "station.txt", "CWA"),
    ("esm", "afad.asc", "DYNA"),
    ("esm", "dyna.asc", "DYNA"),
    ("geonet", "corrected.v2a", "GeoNet V2A"),
    ("geonet", "uncorrected.v1a", "GeoNet V1A"),
    ("knet", "borehole.UD1", "K-NET"),
    ("knet", "surface.NS", "K-NET"),
    ("long_table", "etabs.csv", "ETABS/SAP2000 table"),
    ("mseed", "int32.mseed", "miniSEED 2"),
    ("mseed", "steim1.mseed", "miniSEED 2"),
    ("mseed", "three.mseed", "miniSEED 3"),
    ("mseed", "three_steim.mseed", "miniSEED 3"),
    ("mseed", "two.mseed", "miniSEED 2"),
    ("nsmn", "old.txt", "AFAD/NSMN text"),
    ("sac", "big.sac", "SAC"),
    ("sac", "little.sac", "SAC"),
    ("sigma", "fused.cor.acc", "SIGMA/RESORCE"),
    ("smc", "corrected.smc", "SMC, corrected"),
    ("unam", "three.asa", "ASA"),
    ("usc", "corrected.v2", "USC V2"),
    ("usc", "uncorrected.v1", "USC V1"),
];

/// Families in which a part may be a whole: rows without a number that counts them, and records
/// that end one another.
const WITHOUT_COUNT: &[&str] = &["columns", "long_table"];
/// Families whose last lines are no acceleration, or that have no lines.
const OTHER_ENDS: &[&str] = &[
    "columns",
    "csmip_v2",
    "geonet",
    "long_table",
    "mseed",
    "sac",
    "usc",
];

fn seeds() -> Vec<(String, PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    let mut seeds = Vec::new();
    for family in std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
    {
        let name = family.file_name().unwrap().to_str().unwrap().to_owned();
        // These are no records.
        let others = [
            "hazard",
            "inventory_csv",
            "inventory_xlsx",
            "processing",
            "quantity",
            "station_xml",
            "study_toml",
        ];
        if others.contains(&name.as_str()) {
            continue;
        }
        for path in std::fs::read_dir(&family)
            .unwrap()
            .map(|entry| entry.unwrap().path())
        {
            let bytes = std::fs::read(&path).unwrap();
            seeds.push((name.clone(), path, bytes));
        }
    }
    seeds.sort();
    seeds
}

/// As a file is; with the unit and the time step that columns and counts may leave open; and resampled.
fn ways() -> [ReadOptions; 3] {
    let told = ReadOptions {
        unit: Some("g".to_owned()),
        dt_s: Some(0.01),
        ..ReadOptions::default()
    };
    let resampled = ReadOptions {
        uneven_dt_s: Some(0.01),
        ..ReadOptions::default()
    };
    [ReadOptions::default(), told, resampled]
}

#[test]
fn every_seed_is_read_as_its_format() {
    let named = |(family, path, bytes): (String, PathBuf, Vec<u8>)| {
        let read = |options: &ReadOptions| {
            parse_motions(bytes.clone(), Path::new("/nowhere/record.dat"), options)
        };
        let [plain, told, resampled] = ways();
        let file = read(&plain)
            .or_else(|_| read(&told))
            .or_else(|_| read(&resampled));
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let format = file.map_or_else(|error| error.to_string(), |file| file.format.to_owned());
        (family, name, format)
    };
    let expected = READ.iter().map(|(family, name, format)| {
        let [family, name, format] = [family, name, format].map(|text| (*text).to_owned());
        (family, name, format)
    });
    assert_eq!(
        seeds().into_iter().map(named).collect::<Vec<_>>(),
        expected.collect::<Vec<_>>()
    );
}

/// Formats that state how many values they have, or how long they last, tell that some of it is
/// missing.
#[test]
fn part_of_a_file_is_refused() {
    for (family, path, bytes) in seeds() {
        // Less than half: the half of a file of two components is a file.
        let is_counted = !WITHOUT_COUNT.contains(&family.as_str());
        assert!(
            !is_counted || !check_record(&bytes[..bytes.len() * 2 / 5]),
            "{}",
            path.display()
        );
        if !OTHER_ENDS.contains(&family.as_str()) {
            let lines = split_lines(&bytes);
            assert!(
                !check_record(&lines[..lines.len() - 2].concat()),
                "{}",
                path.display()
            );
        }
    }
}

/// The description of a station, damaged as records are.
#[test]
fn damaged_descriptions_are_refused_or_read_but_never_break() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    let record = std::fs::read(folder.join("mseed/int32.mseed")).unwrap();
    let xml = std::fs::read(folder.join("station_xml/one.xml")).unwrap();
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("damaged.xml");
    let options = ReadOptions {
        station_xml: Some(path.clone()),
        ..ReadOptions::default()
    };
    let read = |xml: &[u8]| {
        std::fs::write(&path, xml).unwrap();
        parse_motions(record.clone(), Path::new("/nowhere/record.mseed"), &options)
    };
    assert_eq!(read(&xml).unwrap().components[0].unit, "m/s2");
    let mutations = mutations(&xml, &mut Chance(1));
    let accels = mutations.iter().filter_map(|mutation| read(mutation).ok());
    let count = accels
        .filter(|file| {
            file.components[0]
                .motion
                .accel_m_s2()
                .iter()
                .all(|a| a.is_finite())
        })
        .count();
    println!(
        "station_xml: {} mutations, {count} of them read",
        mutations.len()
    );
    // Most of the file is not looked at, and some of it cannot be left out.
    assert!(count > mutations.len() / 10 && count < mutations.len());
}

/// Hazard files of every format, damaged as records are.
#[test]
fn damaged_hazard_files_are_refused_or_read_but_never_break() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds/hazard");
    let mut names: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    names.sort();
    assert_eq!(names.len(), 11);
    let mut chance = Chance(1);
    for path in names {
        let bytes = std::fs::read(&path).unwrap();
        assert!(check_hazard(&bytes), "{} is not read", path.display());
        let mutations = mutations(&bytes, &mut chance);
        let read = mutations.iter().filter(|one| check_hazard(one)).count();
        // Some damage cannot be told from another value, and some can.
        assert!(0 < read && read < mutations.len(), "{}", path.display());
    }
}

/// Every fifth mutation: some of each kind.
#[test]
#[ignore = "seconds: hundreds of damaged files"]
fn damaged_files_are_refused_or_read_but_never_break() {
    damage_all(5);
}

#[test]
#[ignore = "half a minute: thousands of damaged files"]
fn many_damaged_files_are_refused_or_read_but_never_break() {
    damage_all(1);
}

fn damage_all(step: usize) {
    let mut chance = Chance(1);
    let mut families: Vec<(String, [usize; 4])> = Vec::new();
    for (family, path, bytes) in seeds() {
        let is_read = check_record(&bytes);
        assert!(is_read, "{} is not read", path.display());
        let mutations = mutations(&bytes, &mut chance);
        let read = mutations
            .iter()
            .enumerate()
            .step_by(step)
            .filter(|(i, mutation)| {
                // The bytes themselves, so that a failure can be looked into.
                catch_unwind(AssertUnwindSafe(|| check_record(mutation))).unwrap_or_else(|_| {
                    panic!(
                        "{}, mutation {i}: {:?}",
                        path.display(),
                        String::from_utf8_lossy(mutation)
                    )
                })
            })
            .count();
        if families.last().is_none_or(|(name, _)| *name != family) {
            families.push((family, [0; 4]));
        }
        if let Some((_, counts)) = families.last_mut() {
            let found = [
                1,
                usize::from(is_read),
                mutations.len().div_ceil(step),
                read,
            ];
            counts
                .iter_mut()
                .zip(found)
                .for_each(|(count, more)| *count += more);
        }
    }
    let mut total = 0;
    for (family, [seeds, seeds_read, mutations, read]) in &families {
        println!(
            "{family}: {seeds} seeds, {seeds_read} read; {mutations} mutations, {read} of them read"
        );
        total += mutations;
    }
    println!("{total} mutations in all");
    assert!(total > 5000 / step && families.len() == 18);
}

/// A record that went through Windows has other ends of lines, and the same samples.
#[test]
fn the_ends_of_lines_do_not_matter() {
    let mut count = 0;
    for (family, path, bytes) in seeds() {
        let Ok(text) = String::from_utf8(bytes) else {
            continue;
        };
        if text.contains('\0') {
            continue;
        }
        let line_feeds = text.replace("\r\n", "\n");
        let read = |text: &str| {
            ways().map(|options| {
                parse_motions(
                    text.as_bytes().to_vec(),
                    Path::new("/nowhere/record.dat"),
                    &options,
                )
                .map(|file| {
                    let samples = |one: &Component| one.motion.accel_m_s2().to_vec();
                    let components: Vec<Vec<f64>> = file.components.iter().map(samples).collect();
                    (file.format, components)
                })
                .map_err(|problem| problem.to_string())
            })
        };
        let windows = line_feeds.replace('\n', "\r\n");
        assert_eq!(
            read(&line_feeds),
            read(&windows),
            "{family}: {}",
            path.display()
        );
        count += 1;
    }
    assert!(count > 25, "{count} seeds of text");
}
