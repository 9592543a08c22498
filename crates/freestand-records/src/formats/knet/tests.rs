use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};
use std::fmt::Write;

/// A file as NIED's description of the format has it (kyoshin.bosai.go.jp, "About K-NET ASCII
/// format"): a name in 18 columns and a value, 17 times; then eight counts a line, each in eight
/// columns with a blank after it.
fn file(dir: &str, counts: &[i64], peak_gal: f64) -> String {
    let mut text = String::new();
    let duration = counts.len() as f64 / 100.0;
    for (name, value) in [
        ("Origin Time", "2006/01/18 23:25:00"),
        ("Lat.", "37.798"),
        ("Long.", "142.200"),
        ("Depth. (km)", "36"),
        ("Mag.", "5.7"),
        ("Station Code", "ABC001"),
        ("Station Lat.", "38.7262"),
        ("Station Long.", "141.5109"),
        ("Station Height(m)", "-9999"),
        ("Record Time", "2006/01/18 23:25:46"),
        ("Sampling Freq(Hz)", "100Hz"),
        ("Duration Time(s)", &duration.to_string()),
        ("Dir.", dir),
        ("Scale Factor", "2000(gal)/1000000"),
        ("Max. Acc. (gal)", &format!("{peak_gal:.3}")),
        ("Last Correction", "2006/01/18 23:25:31"),
        ("Memo.", ""),
    ] {
        let _ = writeln!(text, "{name:<18}{value}");
    }
    for row in counts.chunks(8) {
        for count in row {
            let _ = write!(text, "{count:>8} ");
        }
        text.push('\n');
    }
    text
}

/// 200 counts about 8000, so 16 gal; the largest is 8500, 1 gal above them, the mean 8002.5.
fn counts() -> Vec<i64> {
    (0..200)
        .map(|i| if i == 50 { 8500 } else { 8000 })
        .collect()
}

fn read(text: &str) -> Result<MotionFile, String> {
    parse_motions(
        text.as_bytes().to_vec(),
        "x.NS".as_ref(),
        &ReadOptions::default(),
    )
    .map_err(|error| error.problems[0].to_string())
}

#[test]
fn counts_become_gal_and_keep_their_offset() {
    // About the mean: (8500 - 8002.5) counts of 0.002 gal.
    let found = read(&file("N-S", &counts(), 0.995)).unwrap();
    let one = &found.components[0];
    assert_eq!(
        (found.format, one.name.as_str(), one.unit, one.is_raw),
        ("K-NET", "N-S", "gal", true)
    );
    assert_eq!(one.station.as_deref(), Some("ABC001"));
    assert_eq!(
        (one.direction, one.motion.dt_s()),
        (Some(Direction::Azimuth(0.0)), 0.01)
    );
    assert_eq!(
        (one.line_of_first_value, one.motion.accel_m_s2().len()),
        (18, 200)
    );
    // 8000 and 8500 counts of 0.002 gal; three roundings of 1.1e-16 each.
    assert!(
        (one.motion.accel_m_s2()[0] - 0.16).abs() < 1e-15
            && (one.motion.peak_m_s2() - 0.17).abs() < 1e-15
    );
    assert_eq!(
        found.notes, [""; 0],
        "the header's peak is the one about the mean"
    );
    let other = read(&file("N-S", &counts(), 17.0)).unwrap();
    assert!(
        other.notes[0]
            .to_string()
            .contains("header states a peak of 0.17"),
        "{:?}",
        other.notes
    );
}

#[test]
fn directions_by_name_and_by_number() {
    for (dir, name, direction, borehole) in [
        ("N-S", "N-S", Some(Direction::Azimuth(0.0)), false),
        ("E-W", "E-W", Some(Direction::Azimuth(90.0)), false),
        ("U-D", "U-D", Some(Direction::Up), false),
        ("1", "NS1", Some(Direction::Azimuth(0.0)), true),
        ("2", "EW1", Some(Direction::Azimuth(90.0)), true),
        ("3", "UD1", Some(Direction::Up), true),
        ("4", "NS2", Some(Direction::Azimuth(0.0)), false),
        ("5", "EW2", Some(Direction::Azimuth(90.0)), false),
        ("6", "UD2", Some(Direction::Up), false),
        ("EW1", "EW1", Some(Direction::Azimuth(90.0)), true),
        ("7", "7", None, false),
        ("", "x", None, false),
    ] {
        let found = read(&file(dir, &counts(), 0.995)).unwrap();
        let one = &found.components[0];
        assert_eq!(
            (one.name.as_str(), one.direction),
            (name, direction),
            "{dir}"
        );
        assert_eq!(
            found
                .notes
                .iter()
                .any(|note| note.to_string().contains("borehole")),
            borehole,
            "{dir}"
        );
    }
}

#[test]
fn headers_of_other_hands() {
    let text = file("N-S", &counts(), 0.995);
    let accel = read(&text).unwrap().components[0].motion.clone();
    for (from, to) in [
        ("2000(gal)/1000000", "2000(GAL)/1000000"),
        ("2000(gal)/1000000", "2000.0 gal / 1.0E6"),
        ("2000(gal)/1000000", "2000(cm/s/s)/1000000"),
        ("2000(gal)/1000000", "0.002(gal)"),
        ("2000(gal)/1000000", ".002 gal"),
        ("100Hz", "100"),
        ("100Hz", "100 hz"),
        ("Max. Acc. (gal)", "Max Acc. (gal)"),
        ("Scale Factor", "SCALE FACTOR"),
        ("Memo.  ", "Memo.   shaken, 1 2 3"),
        ("Memo.             \n", ""),
        ("Memo.             \n", "Memo.\n\n"),
        ("Last Correction   2006/01/18 23:25:31\n", ""),
        ("\n", "\r\n"),
        ("\n", "\r\r\n"),
    ] {
        assert!(text.contains(from), "{from}");
        let found =
            read(&text.replace(from, to)).unwrap_or_else(|problem| panic!("{to}: {problem}"));
        let relative = accel
            .accel_m_s2()
            .iter()
            .zip(found.components[0].motion.accel_m_s2());
        // 2000/1000000 and 0.002 are rounded differently, by one part in 1e16 each.
        assert!(
            relative.clone().all(|(a, b)| (a - b).abs() < 1e-15) && relative.len() == 200,
            "{to}"
        );
    }
    let blank_end = format!("{text}\n  \n\x1A");
    assert_eq!(read(&blank_end).unwrap().components[0].motion, accel);
}

#[test]
fn markers_of_missing_values_are_counts_like_others() {
    let mut counts = counts();
    (counts[3], counts[4], counts[5]) = (-999, -9999, -32768);
    let found = read(&file("N-S", &counts, 0.0)).unwrap();
    // -32768 counts of 0.002 gal.
    assert!((found.components[0].motion.accel_m_s2()[5] + 0.65536).abs() < 1e-15);
}

#[test]
fn one_value_more_or_less_is_said() {
    let text = file("N-S", &counts(), 0.995);
    let found = read(&text.replace("Duration Time(s)  2\n", "Duration Time(s)  2.01\n")).unwrap();
    assert_eq!(
        found.notes,
        ["200 values were read, but 2.01 s at 100 Hz would be 201"]
    );
}

#[test]
fn what_is_wrong_names_its_line() {
    let text = file("N-S", &counts(), 0.995);
    for (from, to, line, message) in [
        (
            "Duration Time(s)  2",
            "Duration Time(s)  3",
            "x.NS:12:",
            "300 values, but the file has 200",
        ),
        (
            "Duration Time(s)  2",
            "Duration Time(s)  two",
            "x.NS:12:",
            "\"two\" is not a number for \"duration time\"",
        ),
        (
            "Duration Time(s)  2\n",
            "",
            "x.NS:16:",
            "no line \"duration time\"",
        ),
        ("100Hz", "0Hz", "x.NS:11:", "sampling rate is 0"),
        ("100Hz", "1E300Hz", "x.NS:11:", "sampling rate is"),
        (
            "2000(gal)/1000000",
            "2000(gal)/0",
            "x.NS:14:",
            "scale factor is",
        ),
        (
            "2000(gal)/1000000",
            "2000/1000000",
            "x.NS:14:",
            "scale factor is",
        ),
        (
            "2000(gal)/1000000",
            "2000(cm)/1000000",
            "x.NS:14:",
            "scale factor is",
        ),
        (
            "2000(gal)/1000000",
            "-2000(gal)/1000000",
            "x.NS:14:",
            "scale factor is",
        ),
        (
            "    8500 ",
            "    85x0 ",
            "x.NS:24:",
            "\"85x0\" is not a number",
        ),
        ("    8500 ", "     NaN ", "x.NS:24:", "missing value"),
        ("    8500 ", "   1.7E38 ", "x.NS:24:", "missing value"),
        ("    8500 ", "", "x.NS:12:", "anything"),
    ] {
        assert!(text.contains(from), "{from}");
        match read(&text.replacen(from, to, 1)) {
            Err(problem) => assert!(
                problem.starts_with(line) && problem.contains(message),
                "{problem}"
            ),
            // One value less only makes a note.
            Ok(found) => assert!(
                message == "anything" && found.notes[0].to_string().starts_with("199 values"),
                "{to}"
            ),
        }
    }
    let header_only: String = text
        .lines()
        .take(17)
        .map(|line| format!("{line}\n"))
        .collect();
    assert!(read(&header_only).unwrap_err().contains("the file has 0"));
}

#[test]
fn the_unit_and_the_step_are_the_files() {
    let text = file("N-S", &counts(), 0.995).into_bytes();
    for (unit, dt_s, good) in [
        (Some("gal"), None, true),
        (Some("cm/s2"), Some(0.01), true),
        (Some("g"), None, false),
        (None, Some(0.02), false),
    ] {
        let options = ReadOptions {
            unit: unit.map(str::to_owned),
            dt_s,
            ..ReadOptions::default()
        };
        assert_eq!(
            parse_motions(text.clone(), "x".as_ref(), &options).is_ok(),
            good,
            "{unit:?} {dt_s:?}"
        );
    }
}
