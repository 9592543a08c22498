//! Large files that hold nothing, and records of many samples: read or refused in bounded time and
//! memory. What it took is printed; a limit on time would fail on a busy machine, so a reader that
//! does not end is what fails. Where time grows as the square of the size, 5 MB take hours as well.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

use freestand_input::problem::Problems;
use freestand_records::formats::{MotionFile, ReadOptions, parse_motions};
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

/// Of a file, in the quick tests and in the long ones.
const BYTES: [usize; 2] = [5_000_000, 100_000_000];
const DIGITS: &[u8] = b"0123456789.-+eE \n";

fn read(title: &str, bytes: Vec<u8>, options: &ReadOptions) -> Result<MotionFile, Problems> {
    let megabytes = bytes.len() / 1_000_000;
    let start = Instant::now();
    let read = parse_motions(bytes, Path::new("/nowhere/record.dat"), options);
    let outcome = match &read {
        Ok(file) => format!("{} values", file.components[0].motion.accel_m_s2().len()),
        Err(error) => error.problems[0].message.clone(),
    };
    let elapsed = start.elapsed().as_secs_f64();
    println!(
        "{title}, {megabytes} MB: {elapsed:.2} s, at most {} MB so far; {outcome}",
        peak_megabytes()
    );
    read
}

/// The most memory that this process has had, where the system tells.
fn peak_megabytes() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| {
        line.strip_prefix("VmHWM:")?
            .trim()
            .strip_suffix(" kB")?
            .parse()
            .ok()
    });
    peak.map_or_else(
        || "?".to_owned(),
        |kilobytes: u64| (kilobytes / 1000).to_string(),
    )
}

/// Knuth's linear congruential generator (TAOCP 2, MMIX), its upper bits.
fn random_bytes(alphabet: &[u8], count: usize) -> Vec<u8> {
    let mut state = 1u64;
    let next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        alphabet[(state >> 33) as usize % alphabet.len()]
    };
    std::iter::repeat_with(next).take(count).collect()
}

fn seed(name: &str) -> Vec<u8> {
    std::fs::read(
        Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../fuzz/seeds")
            .join(name),
    )
    .unwrap()
}

#[test]
fn large_files_end() {
    files_end(BYTES[0]);
}

#[test]
#[ignore = "half a minute: files of 100 MB"]
fn files_of_100_mb_end() {
    files_end(BYTES[1]);
}

fn files_end(count: usize) {
    let told = ReadOptions {
        unit: Some("g".to_owned()),
        dt_s: Some(0.01),
        ..ReadOptions::default()
    };
    // Made one at a time: together they would take more memory than any reader.
    type Kind = (&'static str, fn(usize) -> Vec<u8>, &'static str);
    let kinds: [Kind; 8] = [
        ("zeros", |count| vec![0; count], "binary file"),
        (
            "random bytes",
            |count| random_bytes(&Vec::from_iter(0..=255), count),
            "binary file",
        ),
        (
            "random digits and line ends",
            |count| random_bytes(DIGITS, count),
            "is not a number",
        ),
        (
            "one line of digits",
            |count| vec![b'7'; count],
            "not a row of a table",
        ),
        (
            "one line of numbers",
            |count| b" 1.25".repeat(count / 5),
            "not a row of a table",
        ),
        (
            "one line of letters",
            |count| vec![b'x'; count],
            "not a row of a table",
        ),
        ("line ends", |count| vec![b'\n'; count], "empty"),
        (
            "comments",
            |count| b"#\n".repeat(count / 2),
            "no row of numbers",
        ),
    ];
    for (title, bytes, message) in kinds {
        let error = read(title, bytes(count), &told).expect_err(title);
        assert!(
            error.problems[0].message.contains(message),
            "{title}: {error}"
        );
    }
    let digits = random_bytes(DIGITS, count - 4096);
    for name in [
        "at2/nga2.at2",
        "bhrc/vol1.v1",
        "columns/comma.csv",
        "cosmos/corrected.v2c",
        "csmip/pairs.v1",
        "csmip_v2/corrected.v2",
        "cwa/quake.txt",
        "esm/dyna.asc",
        "geonet/corrected.v2a",
        "knet/surface.NS",
        "mseed/int32.mseed",
        "nsmn/old.txt",
        "sac/little.sac",
        "sigma/fused.cor.acc",
        "smc/corrected.smc",
        "unam/three.asa",
    ] {
        let bytes = [seed(name), digits.clone()].concat();
        let options = if name.starts_with("sac") {
            &told
        } else {
            &ReadOptions::default()
        };
        assert!(read(name, bytes, options).is_err(), "{name}");
    }
    // What a header promises, the file does not hold: 2e9 samples of SAC.
    let mut bytes = seed("sac/little.sac");
    bytes[316..320].copy_from_slice(&2_000_000_000_i32.to_le_bytes());
    assert!(read("SAC of 2e9 samples", bytes, &told).is_err());
}

/// A record repeated: every one of them is looked at, and all of them are one record that stands
/// there often.
#[test]
fn many_records_end() {
    records_end(BYTES[0]);
}

#[test]
#[ignore = "ten seconds: two hundred thousand records"]
fn two_hundred_thousand_records_end() {
    records_end(BYTES[1]);
}

fn records_end(count: usize) {
    let told = ReadOptions {
        unit: Some("g".to_owned()),
        ..ReadOptions::default()
    };
    let record = seed("mseed/int32.mseed");
    let file = read(
        "miniSEED of one record many times",
        record.repeat(count / 512),
        &told,
    )
    .unwrap();
    assert_eq!(file.components[0].motion.accel_m_s2().len(), 40);
    // As many channels as records, each with a station of its own; a quarter of the bytes, because
    // making them takes longer than reading them.
    let mut bytes = Vec::new();
    let channels = count / 4 / 512;
    for i in 0..channels {
        let mut record = record.clone();
        for (at, byte) in record[8..13].iter_mut().enumerate() {
            *byte = b'A' + (i / 26usize.pow(at as u32) % 26) as u8;
        }
        bytes.extend(record);
    }
    let file = read("miniSEED of as many channels as records", bytes, &told).unwrap();
    assert_eq!(file.components.len(), channels);
}

/// Of a record, in the quick tests and in the long ones.
const SAMPLES: [usize; 2] = [500_000, 10_000_000];

#[test]
fn half_a_million_counts_are_read() {
    read_counts(SAMPLES[0]);
}

#[test]
#[ignore = "ten seconds: ten million counts"]
fn ten_million_counts_are_read() {
    read_counts(SAMPLES[1]);
}

fn read_counts(count: usize) {
    let head = String::from_utf8(seed("knet/surface.NS")).unwrap();
    let (head, _) = head.split_once("Memo.").unwrap();
    let duration = format!("Duration Time(s)  {}\n", count / 100);
    let mut text = head.replace("Duration Time(s)  2\n", &duration) + "Memo.\n";
    for i in 0..count / 8 {
        let _ = writeln!(
            text,
            "{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} ",
            i, -5, 6, 7, 8, 9, 10, 11
        );
    }
    let file = read(
        &format!("K-NET of {count} counts"),
        text.into_bytes(),
        &ReadOptions::default(),
    )
    .unwrap();
    assert_eq!(file.components[0].motion.accel_m_s2().len(), count);
}

#[test]
fn half_a_million_rows_are_read() {
    read_rows(SAMPLES[0]);
}

#[test]
#[ignore = "half a minute: ten million rows, 150 MB"]
fn ten_million_rows_are_read() {
    read_rows(SAMPLES[1]);
}

fn read_rows(count: usize) {
    let mut text = String::from("time [s],a [g]\n");
    for i in 0..count {
        let _ = writeln!(text, "{}.{:02},0.{:03}", i / 100, i % 100, i % 997);
    }
    let file = read(
        &format!("CSV of {count} rows"),
        text.into_bytes(),
        &ReadOptions::default(),
    )
    .unwrap();
    assert_eq!(file.components[0].motion.accel_m_s2().len(), count);
}
