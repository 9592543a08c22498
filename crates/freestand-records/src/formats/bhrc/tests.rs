use super::*;
use crate::formats::{MotionFile, parse_motions};
use std::fmt::Write;

/// One component: the text lines as the network's files have them, then numbers that nobody needs.
fn part(name: &str, points: &str, values: &[f64]) -> String {
    let mut text = format!(
        "* VOL1DS FILE : 6013-1  /02\nINSTRUMENT TYPE = SSA-2\nNO 123\n\n {name}\n\nCOMP {name}\n"
    );
    text.push_str("A Town Station: 36.78N 49.40E   87 m, L= 355 T=  85\n1990/06/20 21:00:08\n");
    let _ = write!(
        text,
        "PERIOD = 0.02 DAMPING = 0.60\n{points}\nUNITS ARE SEC AND G/10\nEND\n"
    );
    text.push_str(&"    1    2    3\n".repeat(7));
    text.push_str(&"     1.500     2.500\n".repeat(7));
    for row in values.chunks(10) {
        for value in row {
            let _ = write!(text, "{:>13}", format!("{value:.5E}"));
        }
        text.push('\n');
    }
    text + "-END OF RECORD-\n"
}

pub(crate) fn sample() -> Vec<u8> {
    let points = "NO OF POINTS = 24  DURATION = 0.120 SEC";
    (part("L", points, &values()) + &part("V", points, &values())).into_bytes()
}

fn read(text: &str) -> Result<MotionFile, String> {
    parse_motions(
        text.as_bytes().to_vec(),
        "x.v1".as_ref(),
        &ReadOptions::default(),
    )
    .map_err(|error| error.problems[0].to_string())
}

fn values() -> Vec<f64> {
    (0..24)
        .map(|i| f64::from((i * 7919) % 2001 - 1000) * 1e-3)
        .collect()
}

#[test]
fn three_components_in_tenths_of_g() {
    let points = "NO OF POINTS = 24  DURATION = 0.120 SEC";
    let text: String = ["L", "V", "T"]
        .iter()
        .map(|name| part(name, points, &values()))
        .collect();
    for text in [
        text.clone(),
        text.replace('\n', "\r\n"),
        format!("\n{text}\n"),
        text.to_lowercase(),
    ] {
        let found = read(&text).unwrap();
        let directions: Vec<_> = found
            .components
            .iter()
            .map(|c| (c.name.as_str(), c.direction))
            .collect();
        let azimuth = |degrees| Some(Direction::Azimuth(degrees));
        assert_eq!(
            directions,
            [
                ("L", azimuth(355.0)),
                ("V", Some(Direction::Up)),
                ("T", azimuth(85.0))
            ]
        );
        for one in &found.components {
            assert_eq!((one.unit, one.motion.dt_s()), ("g/10", 0.005));
            for (found, value) in one.motion.accel_m_s2().iter().zip(values()) {
                // The last bit depends on the order of the factors.
                assert!((found - value * 0.980665).abs() < 1e-15, "{found} {value}");
            }
        }
        assert!(found.notes[0].to_string().contains("duration"));
    }
    let found = read(&text).unwrap();
    assert_eq!(
        (found.format, found.components[0].line_of_first_value),
        ("BHRC volume 1", 28)
    );
    assert_eq!(found.components[0].station.as_deref(), Some("A Town"));
    assert_eq!(
        read(&part("V", points, &values()))
            .unwrap()
            .components
            .len(),
        1
    );
}

/// 200 samples a second: the duration counts the last interval in, or leaves it out, or fits
/// neither.
#[test]
fn the_step_is_the_duration_over_the_values() {
    for (text, expected) in [
        ("30.065", 0.005),
        ("30.06", 0.005),
        ("30.060", 0.005),
        ("60.13", 0.01),
    ] {
        let duration = scan(text.as_bytes()).unwrap();
        assert_eq!(step(6013.0, duration), expected, "{text}");
    }
    assert_eq!(step(6013.0, scan(b"31.234").unwrap()), 31.234 / 6013.0);
}

#[test]
fn what_is_refused() {
    let points = "NO OF POINTS = 24  DURATION = 0.120 SEC";
    let text = part("L", points, &values());
    for (from, to, message) in [
        ("VOL1DS", "VOL2DS", "x.v1:1: is a VOL2DS file"),
        ("POINTS = 24", "POINTS = 44", "\"-END\" is not a number"),
        (
            "POINTS = 24",
            "POINTS = 10",
            "x.v1:29: there are more values",
        ),
        (
            "POINTS = 24",
            "POINTS =   ",
            "x.v1:11: the header does not state the number of values and the duration",
        ),
        (
            "-1.00000E0",
            "  -999.000",
            "x.v1:28: \"-999\" marks a missing value",
        ),
    ] {
        let problem = read(&text.replacen(from, to, 1)).expect_err(message);
        assert!(problem.contains(message), "{problem}");
    }
}

#[test]
fn components_that_are_not_there_are_said() {
    let points = "NO OF POINTS = 24  DURATION = 0.120 SEC";
    let three: String = ["L", "V", "T"]
        .iter()
        .map(|name| part(name, points, &values()))
        .collect();
    assert_eq!(read(&three).unwrap().notes.len(), 3, "one of each step");
    let cut = read(three.trim_end().strip_suffix("-END OF RECORD-").unwrap()).unwrap();
    assert_eq!(
        cut.notes[3..],
        ["the last channel does not end with a line \"end of record\": the file may be cut off"]
    );
    let one = read(&part("L", points, &values())).unwrap();
    assert_eq!(
        one.notes[1..],
        ["the file has only 1 of three components: it may be cut off"]
    );
}
