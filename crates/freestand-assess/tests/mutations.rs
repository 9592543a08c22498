//! Damaged records: every seed of the fuzz targets, altered in ways in which files do get damaged.
//! Nothing may panic, hang, or be read into something that is no motion.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

#[path = "../../../fuzz/src/check.rs"]
#[allow(unreachable_pub, reason = "the fuzz targets use it from another crate")]
mod check;
#[path = "../../../fuzz/src/inventory.rs"]
#[allow(unreachable_pub, reason = "the fuzz targets use it from another crate")]
mod inventory;

use check::check_record;
use freestand_records::formats::{ReadOptions, parse_motions};
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
const WITHOUT_COUNT: &[&str] = &["columns"];
/// Families whose last lines are no acceleration, or that have no lines.
const OTHER_ENDS: &[&str] = &["columns", "csmip_v2", "geonet", "mseed", "sac", "usc"];

fn seeds() -> Vec<(String, PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    let mut seeds = Vec::new();
    for family in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = family.file_name().unwrap().to_str().unwrap().to_owned();
        // These are no records.
        let others = ["inventory_csv", "inventory_xlsx", "processing", "quantity", "station_xml", "study_toml"];
        if others.contains(&name.as_str()) {
            continue;
        }
        for path in std::fs::read_dir(&family).unwrap().map(|entry| entry.unwrap().path()) {
            let bytes = std::fs::read(&path).unwrap();
            seeds.push((name.clone(), path, bytes));
        }
    }
    seeds.sort();
    seeds
}

/// The same mutations in every run: Knuth's linear congruential generator (TAOCP 2, MMIX), its
/// upper bits.
struct Chance(u64);

impl Chance {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound.max(1)
    }
}

fn split_lines(bytes: &[u8]) -> Vec<&[u8]> {
    bytes.split_inclusive(|&b| b == b'\n').collect()
}

/// One line in place of itself `count` times: 0 loses it, 2 doubles it.
fn repeat_line(bytes: &[u8], at: usize, count: usize) -> Vec<u8> {
    let lines = split_lines(bytes);
    let each = lines.iter().enumerate().map(|(i, line)| if i == at { line.repeat(count) } else { line.to_vec() });
    each.collect::<Vec<_>>().concat()
}

/// `bytes` with `with` in place of what stands at `at`.
fn overwrite(bytes: &[u8], at: usize, with: &[u8]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    out.splice(at..(at + with.len()).min(bytes.len()), with.iter().copied());
    out
}

/// What a transfer, an editor or a program makes of a file.
fn mutations(bytes: &[u8], chance: &mut Chance) -> Vec<Vec<u8>> {
    let mut out = Vec::new();
    let (length, lines) = (bytes.len(), split_lines(bytes).len());
    // Cut off, at even distances and at the very ends.
    out.extend((0..40).map(|i| bytes[..length * i / 40].to_vec()));
    out.extend((1..12).map(|i| bytes[..length.saturating_sub(i)].to_vec()));
    out.extend((1..8).map(|i| bytes[i.min(length)..].to_vec()));
    // Lines lost or doubled.
    out.extend((0..lines.min(25)).map(|at| repeat_line(bytes, at, 0)));
    out.extend((0..25).map(|_| repeat_line(bytes, chance.below(lines), 0)));
    out.extend((0..15).map(|_| repeat_line(bytes, chance.below(lines), 2)));
    // Single bits.
    for _ in 0..80 {
        let mut flipped = bytes.to_vec();
        flipped[chance.below(length)] ^= 1 << chance.below(8);
        out.push(flipped);
    }
    // Numbers that say something else: each digit of the head, and some others.
    let digits: Vec<usize> = (0..length).filter(|&i| bytes[i].is_ascii_digit()).collect();
    for &at in digits.iter().take(60) {
        out.push(overwrite(bytes, at, b"9"));
        out.push(overwrite(bytes, at, b"-"));
    }
    for with in ["99999999999999999999", "1E400", "-1", "NaN", "-999", "1.7E38", "0", ".", "\u{fffd}", "\0", "\t", "#"]
    {
        for _ in 0..4 {
            out.push(overwrite(bytes, chance.below(length), with.as_bytes()));
            out.extend(digits.get(chance.below(digits.len())).map(|&at| overwrite(bytes, at, with.as_bytes())));
        }
    }
    // Line ends of other systems, blank lines, all on one line, and what editors put around a text.
    let replaced = |from: &[u8], to: &[u8]| {
        split_lines(bytes)
            .iter()
            .flat_map(|line| {
                [line.strip_suffix(from).unwrap_or(line), if line.ends_with(from) { to } else { b"" }].concat()
            })
            .collect::<Vec<u8>>()
    };
    out.extend([b"\r\n".as_slice(), b"\r\r\n", b"\r", b"\n\n", b" \n", b" "].map(|to| replaced(b"\n", to)));
    let mixed =
        split_lines(&replaced(b"\n", b"\r\n")).iter().enumerate().fold(Vec::new(), |mut text: Vec<u8>, (i, line)| {
            text.extend_from_slice(line);
            if i % 3 == 0 {
                text.truncate(text.len().saturating_sub(1));
            }
            text
        });
    out.push(mixed);
    out.push([b"\xEF\xBB\xBF", bytes].concat());
    out.push([bytes, b"\n\n \n\x1A"].concat());
    out.push([bytes, bytes].concat());
    // Bytes that are no UTF-8.
    out.extend((0..15).map(|_| overwrite(bytes, chance.below(length), &[0x80 + chance.below(128) as u8])));
    out.push(bytes.to_ascii_lowercase());
    out.push(bytes.to_ascii_uppercase());
    out
}

#[test]
fn every_seed_is_read_as_its_format() {
    let named = |(family, path, bytes): (String, PathBuf, Vec<u8>)| {
        // Columns may leave the unit open, and counts do.
        let told = ReadOptions { unit: Some("g".to_owned()), dt_s: Some(0.01), ..ReadOptions::default() };
        let resampled = ReadOptions { uneven_dt_s: Some(0.01), ..ReadOptions::default() };
        let read = |options: &ReadOptions| parse_motions(bytes.clone(), Path::new("/nowhere/record.dat"), options);
        let file = read(&ReadOptions::default()).or_else(|_| read(&told)).or_else(|_| read(&resampled));
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let format = file.map_or_else(|error| error.to_string(), |file| file.format.to_owned());
        (family, name, format)
    };
    let expected = READ.iter().map(|(family, name, format)| {
        let [family, name, format] = [family, name, format].map(|text| (*text).to_owned());
        (family, name, format)
    });
    assert_eq!(seeds().into_iter().map(named).collect::<Vec<_>>(), expected.collect::<Vec<_>>());
}

/// Formats that state how many values they have, or how long they last, tell that some of it is
/// missing.
#[test]
fn part_of_a_file_is_refused() {
    for (family, path, bytes) in seeds() {
        // Less than half: the half of a file of two components is a file.
        let is_counted = !WITHOUT_COUNT.contains(&family.as_str());
        assert!(!is_counted || !check_record(&bytes[..bytes.len() * 2 / 5]), "{}", path.display());
        if !OTHER_ENDS.contains(&family.as_str()) {
            let lines = split_lines(&bytes);
            assert!(!check_record(&lines[..lines.len() - 2].concat()), "{}", path.display());
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
    let options = ReadOptions { station_xml: Some(path.clone()), ..ReadOptions::default() };
    let read = |xml: &[u8]| {
        std::fs::write(&path, xml).unwrap();
        parse_motions(record.clone(), Path::new("/nowhere/record.mseed"), &options)
    };
    assert_eq!(read(&xml).unwrap().components[0].unit, "m/s2");
    let mutations = mutations(&xml, &mut Chance(1));
    let accels = mutations.iter().filter_map(|mutation| read(mutation).ok());
    let count = accels.filter(|file| file.components[0].motion.accel_m_s2().iter().all(|a| a.is_finite())).count();
    println!("station_xml: {} mutations, {count} of them read", mutations.len());
    // Most of the file is not looked at, and some of it cannot be left out.
    assert!(count > mutations.len() / 10 && count < mutations.len());
}

/// Inventories, damaged as records are, and converted where they are still read.
#[test]
fn damaged_inventories_are_refused_or_read_but_never_break() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    for (family, as_file) in [("inventory_csv", None), ("inventory_xlsx", Some(inventory::workbook))] {
        let mut total = 0;
        for path in std::fs::read_dir(folder.join(family)).unwrap().map(|entry| entry.unwrap().path()) {
            for mutation in mutations(&std::fs::read(&path).unwrap(), &mut Chance(1)) {
                inventory::check_inventory(as_file.map_or_else(|| mutation.clone(), |file| file(&mutation)));
                total += 1;
            }
        }
        println!("{family}: {total} mutations");
        assert!(total > 500);
    }
}

#[test]
fn damaged_files_are_refused_or_read_but_never_break() {
    let mut chance = Chance(1);
    let mut families: Vec<(String, [usize; 4])> = Vec::new();
    for (family, path, bytes) in seeds() {
        let is_read = check_record(&bytes);
        assert!(is_read, "{} is not read", path.display());
        let mutations = mutations(&bytes, &mut chance);
        let read = mutations
            .iter()
            .enumerate()
            .filter(|(i, mutation)| {
                // The bytes themselves, so that a failure can be looked into.
                catch_unwind(AssertUnwindSafe(|| check_record(mutation))).unwrap_or_else(|_| {
                    panic!("{}, mutation {i}: {:?}", path.display(), String::from_utf8_lossy(mutation))
                })
            })
            .count();
        if families.last().is_none_or(|(name, _)| *name != family) {
            families.push((family, [0; 4]));
        }
        if let Some((_, counts)) = families.last_mut() {
            let found = [1, usize::from(is_read), mutations.len(), read];
            counts.iter_mut().zip(found).for_each(|(count, more)| *count += more);
        }
    }
    let mut total = 0;
    for (family, [seeds, seeds_read, mutations, read]) in &families {
        println!("{family}: {seeds} seeds, {seeds_read} read; {mutations} mutations, {read} of them read");
        total += mutations;
    }
    println!("{total} mutations in all");
    assert!(total > 5000 && families.len() == 17);
}
