use crate::formats::{Component, ReadOptions, parse_motions};
use crate::notes::Note;
use freestand::G0_M_S2;
use freestand_input::problem::{Problem, ProblemKind};

const TITLE: &str = "PEER NGA STRONG MOTION DATABASE RECORD\n\
    Imperial Valley-06, 10/15/1979, El Centro Array #12, 140\n\
    ACCELERATION TIME SERIES IN UNITS OF G\n";

fn read_with(text: &[u8], options: &ReadOptions) -> Result<Component, Problem> {
    let file = parse_motions(text.to_vec(), "folder/name.AT2".as_ref(), options)
        .map_err(|error| error.problems[0].clone())?;
    assert_eq!(file.format, "PEER AT2");
    Ok(file.components[0].clone())
}

fn read(text: &str) -> Result<Component, Problem> {
    read_with(text.as_bytes(), &ReadOptions::default())
}

#[test]
fn every_header_of_the_family() {
    for counts in [
        "NPTS=  4, DT= .01000 SEC",
        "NPTS=   4, DT=   .0100 SEC,            ",
        "   4   .0100    NPTS, DT",
        "4   0.0100  NPTS, DT",
        "    4    0.0100   NPTS,  DT (SEC)",
        "npts= 4, dt= 0.01",
        "NPTS=4 DT=0.010",
        "NPTS= 4., DT= 1.0E-02 SEC",
        "NPTS= 4, DT= 1.0D-02 SEC",
        "NPTS:    4   DT:   0.01 s",
        "NPTS 4 DT 0.01",
        "NPTS, DT = 4, 0.01",
        "DT=0.01, NPTS=4",
        "NPTS= 4, DT= 10 MSEC",
    ] {
        let text = format!("{TITLE}{counts}\n .1 -.2\n .3 -.4\n");
        let found = read(&text).unwrap_or_else(|problem| panic!("{counts}: {problem}"));
        assert_eq!(found.motion.dt_s(), 0.01, "{counts}");
        assert_eq!(
            found.motion.accel_m_s2(),
            [0.1, -0.2, 0.3, -0.4].map(|a| a * G0_M_S2)
        );
        assert_eq!(
            (found.name.as_str(), found.station.as_deref()),
            ("140", Some("El Centro Array #12"))
        );
        assert_eq!((found.unit, found.line_of_first_value), ("g", 5));
    }
}

#[test]
fn every_way_to_write_the_values() {
    let header = format!("{TITLE}NPTS= 6, DT= .02 SEC\n");
    let expected = [0.1234e-2, -0.5678e-3, 0.5, 1.0, -1.2345e-101, 0.0].map(|a| a * G0_M_S2);
    for values in [
        ".1234E-02 -.5678E-03 .5 1 -1.2345E-101 0\n",
        ".1234E-02-.5678E-03 .5000E+00\n .1000E+01-1.2345-101 .0000E+00",
        ".1234D-02\n-.5678d-03\n.5\n1.\n-1.2345-101\n-.0\n\n\n   \n",
        "  .1234E-02  -.5678E-03  +.5 1.0 -1.2345D-101 0.\x1A",
        "\n\n.1234E-02 -.5678E-03 .5 1 -1.2345E-101 0",
    ] {
        let text = header.clone() + values;
        for ending in ["\n", "\r\n", "\r", "\r\r\n"] {
            let found = read(&text.replace('\n', ending))
                .unwrap_or_else(|problem| panic!("{values}: {problem}"));
            assert_eq!(found.motion.accel_m_s2(), expected, "{values} {ending:?}");
        }
    }
    // A byte-order mark, and Latin-1 letters in the title.
    let mut bytes = b"\xEF\xBB\xBF".to_vec();
    bytes.extend(
        header
            .replace("El Centro", "M?xico")
            .bytes()
            .map(|b| if b == b'?' { 0xE9 } else { b }),
    );
    bytes.extend(b"1 2 3 4 5 6");
    assert_eq!(
        read_with(&bytes, &ReadOptions::default())
            .unwrap()
            .station
            .as_deref(),
        Some("M\u{e9}xico Array #12")
    );
}

#[test]
fn prose_full_of_numbers_is_prose() {
    let found = read(
        "Data for El Centro 1940 North South Component (Peknold Version)\n\
        3 points at equal spacing of 0.02 sec Points are listed in the format of 8F10.5, i.e., 8 points across in a row\n\
        The units are (g)\nNPTS=  3, DT= .02000 SEC\n0.1 0.2 0.3\n",
    )
    .unwrap();
    assert_eq!(
        (found.name.as_str(), found.station, found.unit),
        ("name", None, "g")
    );
    // A title that mentions NPTS and DT itself.
    let found =
        read("1\nresampled from NPTS=9, DT=.005\nunits of cm/s2\nNPTS= 2, DT= .02\n1 2").unwrap();
    assert_eq!(
        (found.motion.dt_s(), found.motion.accel_m_s2()),
        (0.02, &[0.01, 0.02][..])
    );
    let old = "A\nIMPERIAL VALLEY 10/15/79 2316, EL CENTRO ARRAY #12, 140 (USGS STATION 931)\n\
        ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=40.0 Hz\n 2 .005 NPTS, DT\n.1 .2";
    let found = read(old).unwrap();
    assert_eq!(
        (found.name.as_str(), found.station.as_deref()),
        ("140", Some("EL CENTRO ARRAY #12"))
    );
}

#[test]
fn the_unit_is_never_guessed() {
    let text = "a\nb\nc\nNPTS= 2, DT= .02\n1 2";
    let problem = read(text).unwrap_err();
    assert!(problem.message.contains("not stated") && problem.hint.unwrap().contains("`unit`"));
    let options = ReadOptions {
        unit: Some("cm/s2".to_owned()),
        ..ReadOptions::default()
    };
    assert_eq!(
        read_with(text.as_bytes(), &options)
            .unwrap()
            .motion
            .accel_m_s2(),
        [0.01, 0.02]
    );
    let problem =
        read_with(format!("{TITLE}NPTS= 2, DT= .02\n1 2").as_bytes(), &options).unwrap_err();
    assert_eq!(
        (problem.line, problem.message.as_str()),
        (
            Some(3),
            "the record is in g according to the file, not in cm/s2"
        )
    );
    let options = ReadOptions {
        unit: Some("furlong".to_owned()),
        ..ReadOptions::default()
    };
    assert_eq!(
        read_with(text.as_bytes(), &options).unwrap_err().path,
        None,
        "a wrong option is not a fault of the \
                                                                              file"
    );
}

#[test]
fn what_is_refused() {
    let g = |rest: &str| format!("{TITLE}{rest}");
    let sister = |quantity: &str, unit: &str| {
        format!("PEER\nx\n{quantity} TIME SERIES IN UNITS OF {unit}\nNPTS= 2, DT= .02\n1 2")
    };
    for (text, line, message) in [
        (
            g("NPTS= 4, DT= .02\n1 2 3"),
            4,
            "declares 4 values, but the file has 3",
        ),
        (
            g("NPTS= 2, DT= .02\n1 2 3"),
            4,
            "declares 2 values, but the file has 3",
        ),
        (
            g("NPTS= 999999999999, DT= .02\n1 2 3"),
            4,
            "declares 999999999999 values",
        ),
        (g("NPTS= 1, DT= .02\n1"), 5, "at least 2 samples"),
        (g("NPTS= 0, DT= .02\n"), 4, "at least 2 samples"),
        (g("NPTS= 2, DT= 0\n1 2"), 4, "not positive"),
        (g("NPTS= 2, DT= -.1\n1 2"), 4, "not positive"),
        (
            g("NPTS= 2, DT= 1e-12\n1 2"),
            4,
            "the time step must be from 1e-6 s to 100 s, not 1e-12 s",
        ),
        (g("NPTS= 2, DT= 2000\n1 2"), 4, "not 2000.0 s"),
        (g("NPTS= 2.5, DT= .1\n1 2"), 4, "not a whole number"),
        (g("NPTS= -2, DT= .1\n1 2"), 4, "not a whole number"),
        (g("NPTS= 2, DT= ?\n1 2"), 4, "is missing"),
        (g("NPTS= 3, DT= .02\n1 2\nx"), 6, "\"x\" is not a number"),
        (
            g("NPTS= 3, DT= .02\n1 2\n1.2.3"),
            6,
            "\"1.2.3\" is not a number",
        ),
        (
            g("NPTS= 3, DT= .02\n1 2\nNaN"),
            6,
            "\"NaN\" marks a missing value",
        ),
        (g("NPTS= 3, DT= .02\n1 2\n****"), 6, "missing value"),
        (
            g("NPTS= 3, DT= .02\n1\n-999. 2"),
            6,
            "\"-999\" marks a missing value",
        ),
        (g("NPTS= 3, DT= .02\n1 1.7E+38\n2"), 5, "missing value"),
        (g("NPTS= 3, DT= .02\n1 2\n-32768"), 6, "missing value"),
        (g("NPTS= 3, DT= .02\n1 2\n1e999"), 6, "missing value"),
        (sister("VELOCITY", "CM/S"), 3, "is a velocity record (VT2)"),
        (
            sister("DISPLACEMENT", "CM"),
            3,
            "is a displacement record (DT2)",
        ),
        (
            "a\nb\nunits of cm/s\nNPTS= 2, DT= .02\n1 2".to_owned(),
            3,
            "the record is a velocity (cm/s)",
        ),
    ] {
        let problem = read(&text).expect_err(&text);
        assert!(problem.message.contains(message), "{message}: {problem}");
        assert_eq!(problem.line, Some(line), "{problem}");
        assert!(problem.path.is_some());
        assert_eq!(problem.kind, ProblemKind::Format);
    }
    let options = ReadOptions {
        dt_s: Some(0.005),
        ..ReadOptions::default()
    };
    let problem = read_with(g("NPTS= 2, DT= .02\n1 2").as_bytes(), &options).unwrap_err();
    assert!(
        problem
            .message
            .contains("0.02 s according to the header, not 0.005 s")
    );
    assert_eq!(problem.line, Some(4));
}

fn notes(text: &str) -> Vec<Note> {
    parse_motions(
        text.as_bytes().to_vec(),
        "x.AT2".as_ref(),
        &ReadOptions::default(),
    )
    .unwrap()
    .notes
}

/// A record as PEER prints it, 201 values.
fn printed() -> String {
    let value = |i: i32| {
        format!(
            "  {:.7}E-02",
            f64::from(i * 7919 % 2003 - 1001) * 1e-3 + 1e-7
        )
        .replace("0.", ".")
    };
    let rows: Vec<String> = (0..41)
        .map(|row| (5 * row..(5 * row + 5).min(201)).map(value).collect())
        .collect();
    format!("{TITLE}NPTS=  201, DT= .01000 SEC\n{}\n", rows.join("\n"))
}

#[test]
fn a_number_that_lost_characters_is_said() {
    let whole = printed();
    assert_eq!(notes(&whole), [""; 0]);
    assert_eq!(
        notes(whole.trim_end()),
        [""; 0],
        "a file need not end with a line end"
    );
    for lost in 1..=4 {
        let cut = &whole[..whole.trim_end().len() - lost];
        match parse_motions(
            cut.as_bytes().to_vec(),
            "x.AT2".as_ref(),
            &ReadOptions::default(),
        ) {
            Ok(file) => {
                assert!(
                    file.notes.len() == 1 && file.notes[0].to_string().starts_with("line 45: "),
                    "{:?}",
                    file.notes
                )
            }
            Err(problem) => assert!(lost == 2 || lost == 3, "{lost}: {problem}"),
        }
    }
    // A point, and with it the size of a value: 1e5 g.
    let at = whole.rfind('.').unwrap();
    let lost = notes(&format!("{}{}", &whole[..at], &whole[at + 1..]));
    assert!(
        lost.len() == 2
            && lost[0].to_string().starts_with("line 45: ")
            && lost[1].to_string().contains("value 201 is"),
        "{lost:?}"
    );
    assert!(
        lost[1].to_string().contains("check the unit (g)"),
        "{lost:?}"
    );
}

#[test]
fn a_decimal_comma_is_named() {
    let problem = read(&format!("{TITLE}NPTS= 2, DT= 0,01\n1 2")).unwrap_err();
    assert!(
        problem
            .message
            .ends_with("has a decimal comma: write a point"),
        "{problem}"
    );
    // The comma after a whole number separates: there is a blank, or no digit.
    assert!(read(&format!("{TITLE}NPTS= 2, DT= 1, SEC\n1 2")).is_ok());
}
