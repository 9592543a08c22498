use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};

/// A file as the network wrote it, with Latin-5 letters: Ö and İ.
fn file() -> Vec<u8> {
    let text = "STRONG GROUND MOTION RECORDS OF TURKIYE\n\
        PLACE                   : BING#L MERKEZ@\n\
        EARTHQUAKE DATE         : 2018/03/07 05:08:23 (GMT)\n\
        EPICENTER COORDINATES   : 39.06850N-40.29510E\n\
        STATION ID              : 1210\n\
        RECORD TIME             : 07/03/2018 05:08:19.00 (GMT)\n\
        NUMBER OF DATA          : 4\n\
        SAMPLING INTERVAL (sec) : 0.01\n\
        RAW PGA VALUES (gal)    : (N-S) 3.5 (E-W) 0.5 (U-D) 120.25\n\
        Copyright EARTHQUAKE DEPARTMENT\n\
        DISASTER AND EMERGENCY MANAGEMENT PRESIDENCY\n\
        \u{20}      N-S          E-W          U-D\n\
        \u{20}  -0.000093     -0.000002     0.000071\n\
        \u{20}   3.500000      0.500000  -120.250000\n\
        \u{20}   0.000000      0.000000     0.000000\n\
        \u{20}   1.000000     -0.250000     2.000000\n";
    text.bytes()
        .map(|byte| if byte == b'#' { 0xD6 } else { byte })
        .map(|b| if b == b'@' { 0xDD } else { b })
        .collect()
}

pub(crate) fn sample() -> Vec<u8> {
    file()
}

fn replace(from: &str, to: &str) -> Vec<u8> {
    let bytes = file();
    let at = bytes
        .windows(from.len())
        .position(|part| part == from.as_bytes())
        .unwrap();
    [&bytes[..at], to.as_bytes(), &bytes[at + from.len()..]].concat()
}

fn read(bytes: Vec<u8>) -> Result<MotionFile, String> {
    parse_motions(bytes, "x.txt".as_ref(), &ReadOptions::default())
        .map_err(|error| error.problems[0].to_string())
}

#[test]
fn three_columns_in_gal() {
    for ending in ["\n", "\r\n", "\r", "\r\r\n"] {
        let bytes = file()
            .split(|&b| b == b'\n')
            .collect::<Vec<_>>()
            .join(ending.as_bytes());
        let found = read(bytes).unwrap();
        let facts: Vec<_> = found
            .components
            .iter()
            .map(|c| (c.name.as_str(), c.direction, c.unit))
            .collect();
        let expected = [
            ("N-S", Some(Direction::Azimuth(0.0)), "gal"),
            ("E-W", Some(Direction::Azimuth(90.0)), "gal"),
            ("U-D", Some(Direction::Up), "gal"),
        ];
        assert_eq!(facts, expected);
        // Exact: the printed decimals are the values.
        assert_eq!(
            found.components[2].motion.accel_m_s2(),
            [0.000071, -120.25, 0.0, 2.0].map(|v| v / 100.0)
        );
        assert_eq!(
            (
                found.components[0].motion.dt_s(),
                found.components[0].line_of_first_value
            ),
            (0.01, 13)
        );
        assert_eq!(
            found.components[0].station.as_deref(),
            Some("1210 BINGÖL MERKEZÝ")
        );
        assert_eq!(found.notes, [""; 0]);
    }
}

#[test]
fn other_spellings_and_missing_lines() {
    assert_eq!(
        read(replace("OF TURKIYE", "OF TURKEY"))
            .unwrap()
            .components
            .len(),
        3
    );
    assert_eq!(
        read(replace(
            "STRONG GROUND MOTION RECORDS OF",
            "\n Strong Ground Motion Record of"
        ))
        .unwrap()
        .components
        .len(),
        3
    );
    // Without the line of directions the order is the one that all files have.
    let found = read(replace("       N-S          E-W          U-D\n", "")).unwrap();
    assert_eq!(
        found
            .components
            .iter()
            .map(|c| c.name.as_str())
            .collect::<Vec<_>>(),
        ["N-S", "E-W", "U-D"]
    );
    let found = read(replace(
        "RAW PGA VALUES (gal)    : (N-S) 3.5 (E-W) 0.5 (U-D) 120.25\n",
        "",
    ))
    .unwrap();
    assert_eq!((found.components[0].unit, found.notes.len()), ("gal", 1));
    assert!(
        found.notes[0]
            .to_string()
            .contains("no line states the unit")
    );
    assert_eq!(
        read(replace("(N-S) 3.5", "(N-S) 9.5")).unwrap().notes.len(),
        1
    );
    let mut bytes = file();
    bytes.extend(b"\n\nend of file\n");
    assert!(
        read(bytes).unwrap().notes[0]
            .to_string()
            .contains("follows the last value")
    );
    // One component alone.
    let mut bytes: Vec<u8> = file()
        .split_inclusive(|&b| b == b'\n')
        .take(11)
        .flatten()
        .copied()
        .collect();
    bytes.extend(b"   U-D\n 1.0\n-2.0\n 3.0\n-120.25\n");
    let found = read(bytes).unwrap();
    assert_eq!(
        (found.components.len(), found.components[0].direction),
        (1, Some(Direction::Up))
    );
}

#[test]
fn what_is_refused() {
    for (from, to, message) in [
        (
            "DATA          : 4",
            "DATA          : 5",
            "x.txt:7: the header declares 5 values, but the file has 4",
        ),
        ("(sec) : 0.01", "(sec) : ", "the header has no time step"),
        (
            "(sec) : 0.01",
            "(sec) : 0",
            "x.txt:8: the time step must be positive",
        ),
        (
            "-120.250000",
            " -32768",
            "x.txt:14: \"-32768\" marks a missing value",
        ),
        (
            "-120.250000",
            "",
            "x.txt:14: a row must have 3 values, but this one has 2",
        ),
    ] {
        let problem = read(replace(from, to)).expect_err(message);
        assert!(problem.contains(message), "{problem}");
    }
}
