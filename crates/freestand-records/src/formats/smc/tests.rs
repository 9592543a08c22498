use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};
use std::fmt::Write;

/// A file as the format's description has it: Seekins et al. (1992), USGS Open-File Report
/// 91-441-A.
fn file(values: &[f64], peaks: (f64, f64)) -> String {
    let mut text = String::from("2 CORRECTED ACCELEROGRAM\n*\nABC0A\n");
    text.push_str("     1989  10  18    0004 Somewhere\nMoment Mag=      7.1\n");
    text.push_str("station = A Town, 12 Main St, F  component=    S16W\n*\n*\n*\n*\n*\n");
    for i in 0..48 {
        let value = match i {
            15 => 2,
            16 => values.len() as i64,
            _ => -32768,
        };
        let _ = write!(text, "{value:>10}{}", if i % 8 == 7 { "\n" } else { "" });
    }
    for i in 0..50 {
        let value = match i {
            1 => "  0.2000000E+03".to_owned(),
            29 => format!("{:>15}", format!("{:.7E}", peaks.0)),
            31 => format!("{:>15}", format!("{:.7E}", peaks.1)),
            _ => "  0.1700000E+39".to_owned(),
        };
        let _ = write!(text, "{value}{}", if i % 5 == 4 { "\n" } else { "" });
    }
    text.push_str("|  a comment 1 2 3\n|\n");
    for row in values.chunks(8) {
        for value in row {
            let _ = write!(text, "{:>10}", printed(*value));
        }
        text.push('\n');
    }
    text
}

/// E10.4 with one digit of exponent, as the archive's files have it.
fn printed(value: f64) -> String {
    let text = format!("{value:.4E}");
    if text.contains("E-") {
        text
    } else {
        text.replace('E', "E+")
    }
}

fn read(text: &str) -> Result<MotionFile, String> {
    parse_motions(
        text.as_bytes().to_vec(),
        "x.txt".as_ref(),
        &ReadOptions::default(),
    )
    .map_err(|error| error.problems[0].to_string())
}

fn values() -> Vec<f64> {
    (0..21)
        .map(|i| f64::from((i * 7919) % 20_001 - 10_000) * 0.01)
        .collect()
}

#[test]
fn values_that_touch_are_read_by_column() {
    let text = file(&values(), (0.0, 0.0));
    assert!(text.contains("E+1-"), "negative values touch");
    let found = read(&text).unwrap();
    let one = &found.components[0];
    assert_eq!(
        (found.format, one.name.as_str(), one.unit),
        ("SMC, corrected", "S16W", "cm/s2")
    );
    assert_eq!(one.station.as_deref(), Some("A Town, 12 Main St, F"));
    assert_eq!(
        (one.direction, one.motion.dt_s()),
        (Some(Direction::Azimuth(196.0)), 0.005)
    );
    assert_eq!((one.line_of_first_value, one.is_raw), (30, false));
    // Exact: the printed numbers have five digits, as have these.
    let expected: Vec<f64> = values()
        .iter()
        .map(|v| printed(*v).parse::<f64>().unwrap() / 100.0)
        .collect();
    assert_eq!(one.motion.accel_m_s2(), expected);
}

#[test]
fn a_peak_that_differs_from_the_header_is_said_and_its_sign_does_not_matter() {
    let peak = values().iter().fold(0.0f64, |a, b| a.max(b.abs()));
    assert_eq!(read(&file(&values(), (-peak, 0.1))).unwrap().notes, [""; 0]);
    assert!(
        read(&file(&values(), (2.0 * peak, 0.1))).unwrap().notes[0]
            .to_string()
            .contains("header states a peak")
    );
}

#[test]
fn what_is_wrong_names_its_line() {
    let text = file(&values(), (0.0, 0.0));
    for (from, to, line, message) in [
        (
            "2 CORRECTED",
            "3 VELOCITY",
            "x.txt:1:",
            "acceleration record is expected",
        ),
        (
            "  0.2000000E+03",
            "  0.1700000E+39",
            "x.txt:18:",
            "sampling rate",
        ),
        (
            "        21",
            "        29",
            "x.txt:32:",
            "ends after 21 of 29",
        ),
        (
            "        21",
            "    -32768",
            "x.txt:14:",
            "number of values is -32768",
        ),
        // Reading each of them would take hours.
        (
            "         2\n",
            " 999999999\n",
            "x.txt:13:",
            "declares 999999999 comment lines, but 5 lines follow",
        ),
        (
            "         2\n",
            "    -32768\n",
            "x.txt:13:",
            "number of comment lines is -32768",
        ),
        ("-1.0000E+2", "    1.7E38", "x.txt:30:", "missing value"),
    ] {
        let problem = read(&text.replacen(from, to, 1)).expect_err(message);
        assert!(
            problem.starts_with(line) && problem.contains(message),
            "{problem}"
        );
    }
}

#[test]
fn what_stands_behind_the_values_is_refused_or_said() {
    let text = file(&values(), (0.0, 0.0));
    assert!(read(&format!("{text}\n\n")).unwrap().notes.is_empty());
    assert!(
        read(&format!("{text}1.0 2.0 3.0\n"))
            .unwrap_err()
            .contains("x.txt:33: there are more values")
    );
    // One value less than there are: 17, of which the last is on a line of its own.
    let short = file(&values()[..17], (0.0, 0.0)).replacen("        17", "        16", 1);
    assert!(
        read(&short)
            .unwrap_err()
            .contains("more values than the header declares")
    );
    let twice = read(&format!("{text}{text}")).unwrap();
    assert_eq!(
        twice.notes,
        ["line 33 follows the last value and was ignored"]
    );
}

/// Cut off within the last number, and a character lost: the columns show it.
#[test]
fn numbers_that_lost_a_character_are_refused() {
    let text = file(&[values(), values()].concat()[2..39], (0.0, 0.0));
    let cut = &text[..text.trim_end().len() - 3];
    assert!(read(cut).unwrap_err().contains("x.txt:34: "), "cut off");
    let at = text.rfind('.').unwrap();
    let lost = format!("{}{}", &text[..at], &text[at + 1..]);
    assert!(
        read(&lost)
            .unwrap_err()
            .contains("x.txt:34: the line has 49 characters, but its numbers need 50")
    );
}
