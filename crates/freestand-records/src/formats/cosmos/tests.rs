use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};
use freestand::G0_M_S2;
use std::fmt::Write;

/// A channel as the format's description has it, with the declared sizes and formats of `sizes`:
/// values a line, width.
struct Channel<'a> {
    title: &'a str,
    name: &'a str,
    sizes: [(usize, usize); 2],
    integers: &'a [(usize, i64)],
    reals: &'a [(usize, f64)],
    data: &'a str,
    rows: &'a [&'a str],
    end: &'a str,
}

const UNCORRECTED: Channel<'_> = Channel {
    title: "Uncorrected acceleration  (Format v01.20 with 13 text lines) Src: x",
    name: "Sta Chan  1: 360 deg (Rcrdr Chan  1)",
    sizes: [(10, 8), (6, 13)],
    integers: &[(1, 2), (2, 1), (3, 4)],
    reals: &[(34, 0.02), (62, 5.0), (64, -10.123)],
    data: "      10 acceleration pts, approx  1 secs, units=cm/sec2(04), Format=(8F10.3)",
    rows: &[
        "     1.000   -10.123-99999.999     0.000     0.500     0.250     0.125     0.000",
        "     2.000    -2.000",
    ],
    end: "End-of-data for Chan  1 acceleration",
};

fn text(channel: &Channel<'_>) -> String {
    let mut text = format!(
        "{}\nRcrd of an earthquake\nHypocenter: ?\nOrigin: ?\n{:<40}{}\nCoords: 0 0\nRecorder: x\nRcrd start time: \
         x\n{}\nRaw record\nProcessed\nRecord not filtered.\nValues used when parameter or data value is \
         unknown/unspecified:   -999, -999.0\n",
        channel.title, "Statn No: 05- 1 Code:CE-1  CGS", "A Town - Main St", channel.name
    );
    for (what, (per_line, width), decimals) in [
        ("Integer", channel.sizes[0], 0),
        ("Real", channel.sizes[1], 6),
    ] {
        let kind = if decimals == 0 {
            format!("I{width}")
        } else {
            format!("F{width}.6")
        };
        let rows = 100usize.div_ceil(per_line);
        let _ = writeln!(
            text,
            " 100 {what}-header values follow on {rows:>3} lines, Format= ({per_line}{kind})"
        );
        for i in 1..=100 {
            let value = if decimals == 0 {
                channel
                    .integers
                    .iter()
                    .find(|(at, _)| *at == i)
                    .map_or(-999.0, |(_, value)| *value as f64)
            } else {
                channel
                    .reals
                    .iter()
                    .find(|(at, _)| *at == i)
                    .map_or(-999.0, |(_, value)| *value)
            };
            let _ = write!(
                text,
                "{value:>width$.decimals$}{}",
                if i % per_line == 0 || i == 100 {
                    "\n"
                } else {
                    ""
                }
            );
        }
    }
    let _ = writeln!(
        text,
        "   2 Comment line(s) follow, each starting with a \"|\":\n| 12 pts units=g Format=(1F5.1)\n|"
    );
    let _ = writeln!(
        text,
        "{}\n{}\n{}",
        channel.data,
        channel.rows.join("\n"),
        channel.end
    );
    text
}

fn read(text: &str) -> Result<MotionFile, String> {
    read_with(text, &ReadOptions::default())
}

fn read_with(text: &str, options: &ReadOptions) -> Result<MotionFile, String> {
    parse_motions(text.as_bytes().to_vec(), "x.v1c".as_ref(), options)
        .map_err(|error| error.problems[0].to_string())
}

const VALUES: [f64; 10] = [
    1.0, -10.123, -99999.999, 0.0, 0.5, 0.25, 0.125, 0.0, 2.0, -2.0,
];

#[test]
fn sizes_and_formats_are_those_that_the_file_declares() {
    let wide = Channel {
        sizes: [(12, 6), (5, 15)],
        ..UNCORRECTED
    };
    for text in [
        text(&UNCORRECTED),
        text(&wide),
        text(&UNCORRECTED).replace('\n', "\r\n"),
    ] {
        // The large value touches its neighbour; the header's peak is another,
        // and no ground has it.
        let file = read(&text).unwrap();
        assert_eq!(
            (file.format, file.components.len(), file.notes.len()),
            ("COSMOS V1", 1, 2)
        );
        let one = &file.components[0];
        // Exact: one division by an exact number, and 5 ms over 1000 is the nearest number to
        // 0.005.
        assert_eq!(one.motion.accel_m_s2(), VALUES.map(|value| value / 100.0));
        assert_eq!(
            (one.name.as_str(), one.unit, one.is_raw),
            ("360 deg", "cm/s2", false)
        );
        assert_eq!(
            (one.direction, one.motion.dt_s()),
            (Some(Direction::Azimuth(0.0)), 0.005)
        );
        assert_eq!(one.station.as_deref(), Some("A Town - Main St"));
    }
}

#[test]
fn units_are_told_by_code_and_name() {
    for (stated, unit, worth) in [
        ("units=g.     (02)", "g", G0_M_S2),
        ("units=in/sec2(07)", "in/s2", 0.0254),
        ("units=gal (10)", "gal", 0.01),
        ("units=mg (11)", "mg", 0.001 * G0_M_S2),
        ("units=cm/sec/sec", "cm/s2", 0.01),
        ("Units= cm/s^2 (04)", "cm/s2", 0.01),
    ] {
        let file = read(&text(&UNCORRECTED).replace("units=cm/sec2(04)", stated)).expect(stated);
        assert_eq!(file.components[0].unit, unit);
        // One factor in two ways: a unit in the last place.
        assert!(
            (file.components[0].motion.accel_m_s2()[0] - worth).abs() < 1e-15 * worth.max(1.0),
            "{stated}"
        );
    }
    for (stated, message) in [
        ("units=g (04)", "g by its name, but cm/s2 by its code"),
        ("units=volts (51)", "not a known unit of acceleration"),
        ("units=sec & g (03)", "not a known unit of acceleration"),
        ("units=", "not a known unit of acceleration"),
    ] {
        let problem =
            read(&text(&UNCORRECTED).replace("units=cm/sec2(04)", stated)).expect_err(stated);
        assert!(
            problem.starts_with("x.v1c:46:") && problem.contains(message),
            "{stated}: {problem}"
        );
    }
}

#[test]
fn counts_need_the_sensitivity() {
    let raw = Channel {
        title: "Raw acceleration counts   (Format v01.10 with 13 text lines)",
        integers: &[(1, 0), (2, 1), (3, 50)],
        reals: &[(22, 2.0), (34, 0.01), (42, 0.5), (62, -999.0)],
        data: "       4 raw accel.    pts, approx  1 secs, units=counts (50),Format=(10I8)",
        rows: &["     100    -999     -50 1000000"],
        ..UNCORRECTED
    };
    let file = read(&text(&raw)).unwrap();
    let one = &file.components[0];
    assert_eq!(
        (file.format, one.unit, one.is_raw, one.motion.dt_s()),
        ("COSMOS V0", "counts", true, 0.01)
    );
    assert!(file.notes[0].to_string().contains("1 value of -999"));
    // 2 microvolts a count over 0.5 V/g are 4e-6 g a count; three factors, so some units in the
    // last place.
    for (found, count) in one
        .motion
        .accel_m_s2()
        .iter()
        .zip([100.0, -999.0, -50.0, 1e6])
    {
        assert!((found - count * 4e-6 * G0_M_S2).abs() <= 1e-14 * found.abs());
    }
    for reals in [
        &[(22, 2.0), (62, 5.0)][..],
        &[(42, 2.0), (62, 5.0)],
        &[(22, 0.0), (42, 0.5), (62, 5.0)],
    ] {
        assert!(
            read(&text(&Channel { reals, ..raw }))
                .unwrap_err()
                .contains("real header")
        );
    }
}

#[test]
fn channels_follow_one_another_and_other_quantities_are_left_out() {
    let up = Channel {
        name: "Sta Cha: 2   UP      (Rcrdr Chan  2) Location:Free-field",
        ..UNCORRECTED
    };
    let velocity = Channel {
        title: "Corrected velocity        (Format v01.20 with 13 text lines)",
        integers: &[(1, 2), (2, 2), (3, 5)],
        data: "      10 velocity     pts, approx  1 secs, units=cm/sec (05), Format=(8F10.3)",
        end: "End-of-data for Chan  1 velocity",
        ..UNCORRECTED
    };
    let file = read(
        &[
            text(&UNCORRECTED),
            text(&velocity),
            text(&up),
            text(&UNCORRECTED),
        ]
        .concat(),
    )
    .unwrap();
    let names: Vec<&str> = file
        .components
        .iter()
        .map(|one| one.name.as_str())
        .collect();
    assert_eq!(names, ["360 deg, channel 1", "UP", "360 deg, channel 3"]);
    assert!(
        file.notes
            .iter()
            .any(|note| note.to_string().contains("1 series of quantities other"))
    );
    let problem = read(&text(&velocity)).unwrap_err();
    assert!(
        problem.starts_with("x.v1c:46: holds a velocity"),
        "{problem}"
    );
    // All three series of a channel below one header.
    let both = text(&UNCORRECTED)
        + velocity.data
        + "\n"
        + &velocity.rows.join("\n")
        + "\n"
        + velocity.end
        + "\n";
    assert_eq!(read(&both).unwrap().components.len(), 1);
}

#[test]
fn the_first_version_states_the_rate_above_the_values() {
    let old = Channel {
        title: "Uncorrected Acceleration  (Format v01.00 with 13 text lines) Orig: A.ASC",
        name: "Sta Cha: 1     0 deg (Rcrdr Chan  1) Location:Free-field",
        reals: &[(30, 0.005)],
        data: "3  acceleration pts a  200 pts/sec, Units=cm/s/s     , Format=(1F14.9  )",
        rows: &["   0.001000000", "  -0.500000000", "   0.250000000"],
        ..UNCORRECTED
    };
    let text = text(&old).replace("lines, Format= (", "lines, Format  (");
    let file = read(&text).unwrap();
    let one = &file.components[0];
    assert_eq!((one.name.as_str(), one.motion.dt_s()), ("0 deg", 0.005));
    assert_eq!(
        one.motion.accel_m_s2(),
        [0.001 / 100.0, -0.5 / 100.0, 0.25 / 100.0]
    );
    let named = text.replace(old.name, "Sta Chan   3  90    HNE           Location:   --");
    assert_eq!(read(&named).unwrap().components[0].name, "90");
    let unnamed = text.replace(old.name, "Sta Chan  1:");
    assert_eq!(read(&unnamed).unwrap().components[0].name, "channel 1");
    let both = self::text(&UNCORRECTED).replace("approx  1 secs", "at 100 pts/sec");
    assert!(
        read(&both)
            .unwrap_err()
            .contains("0.005 s in the header, but 0.01 s above the values")
    );
}

#[test]
fn one_value_more_or_less_is_taken_where_the_end_line_proves_it() {
    for (declared, ok) in [
        ("      11", true),
        ("       9", true),
        ("      12", false),
        ("       8", false),
    ] {
        let found = read(&text(&UNCORRECTED).replace("      10 acc", &format!("{declared} acc")));
        match found {
            Ok(file) => assert!(
                ok && file.components[0].motion.accel_m_s2().len() == 10 && file.notes.len() == 3
            ),
            Err(problem) => assert!(!ok && problem.starts_with("x.v1c:"), "{problem}"),
        }
    }
    let cut = text(&UNCORRECTED)
        .replace("      10 acc", "      11 acc")
        .replace(UNCORRECTED.end, "");
    assert!(
        read(&cut).unwrap_err().contains("ends after 10 of 11"),
        "cut off, not miscounted"
    );
}

#[test]
fn what_is_wrong_names_its_line() {
    let text = text(&UNCORRECTED);
    for (from, to, start, message) in [
        (
            "     2.000    -2.000",
            "     2.000 -1.70E+38",
            "x.v1c:48:",
            "missing value",
        ),
        (
            "     2.000    -2.000",
            "     2.000       NaN",
            "x.v1c:48:",
            "missing value",
        ),
        (
            " 100 Real-header",
            " 100 Other-header",
            "x.v1c:",
            "real header",
        ),
        (
            "Format=(8F10.3)",
            "Format=(A80)",
            "x.v1c:46:",
            "format is missing",
        ),
        ("     5.000000", "  -999.000000", "x.v1c:26:", "time step"),
        (
            "13 text lines",
            "99999 text lines",
            "x.v1c:1:",
            "99999 lines of text",
        ),
    ] {
        let problem = read(&text.replacen(from, to, 1)).expect_err(message);
        assert!(
            problem.starts_with(start) && problem.contains(message),
            "{problem}"
        );
    }
    // A second channel that is cut off in its header is not lost in silence.
    let head: String = text
        .lines()
        .take(45)
        .map(|line| format!("{line}\n"))
        .collect();
    assert!(
        read(&(text.clone() + &head))
            .unwrap_err()
            .contains("no values follow")
    );
    let head: String = text
        .lines()
        .take(20)
        .map(|line| format!("{line}\n"))
        .collect();
    assert!(
        read(&(text.clone() + &head))
            .unwrap_err()
            .contains("ends after")
    );
    // The user's word for what the header leaves open, and against what it says.
    let open = text.replacen("     5.000000", "  -999.000000", 1);
    let dt = ReadOptions {
        dt_s: Some(0.01),
        ..ReadOptions::default()
    };
    assert_eq!(
        read_with(&open, &dt).unwrap().components[0].motion.dt_s(),
        0.01
    );
    assert!(
        read_with(&text, &dt)
            .unwrap_err()
            .contains("0.005 s according to the header")
    );
    let unit = ReadOptions {
        unit: Some("g".to_owned()),
        ..ReadOptions::default()
    };
    assert!(
        read_with(&text, &unit)
            .unwrap_err()
            .contains("in cm/s2 according to the file")
    );
}

#[test]
fn damaged_files_are_read_or_refused() {
    let text = text(&UNCORRECTED);
    for at in (0..text.len()).step_by(5) {
        for byte in *b"-9x\n (" {
            let mut bytes = text.clone().into_bytes();
            bytes[at] = byte;
            let read = |bytes: Vec<u8>| parse_motions(bytes, "x".as_ref(), &ReadOptions::default());
            if let Ok(file) = read(bytes.clone()) {
                assert!(
                    file.components.iter().all(|one| one
                        .motion
                        .accel_m_s2()
                        .iter()
                        .all(|a| a.is_finite()))
                );
            }
            // Cut off at the damage, nothing is left of one channel but a refusal or a record that
            // lacks its end line.
            bytes.truncate(at);
            let is_whole = at >= text.find("    -2.000").unwrap();
            assert!(is_whole || read(bytes).is_err(), "cut at {at}");
        }
    }
}

#[test]
fn channels_that_are_not_there_are_said() {
    let one = text(&UNCORRECTED)
        .replace("-99999.999", "     1.000")
        .replace("Recorder: x", "Recorder: x ( 2 Chns of   3 at Sta)");
    let two = one.clone() + &one;
    assert_eq!(read(&two).unwrap().notes, [""; 0]);
    assert_eq!(
        read(&one).unwrap().notes,
        ["the header states 2 channels, but the file has 1: it may be cut off"]
    );
    let cut = two.trim_end().strip_suffix(UNCORRECTED.end).unwrap();
    assert_eq!(
        read(cut).unwrap().notes,
        ["the last channel does not end with a line \"end-of-data\": the file may be cut off"]
    );
}

/// The header's mark of an unknown value is one, unless the others are as large.
#[test]
fn the_value_for_unknown_stands_out() {
    let gap = text(&UNCORRECTED).replace("     2.000    -2.000", "     2.000  -999.000");
    assert!(
        read(&gap).unwrap().notes[0]
            .to_string()
            .contains("line 48: -999 is read as a value")
    );
    let weak = gap.replace("-99999.999", "   499.000");
    assert!(
        read(&weak)
            .unwrap_err()
            .contains("x.v1c:48: \"-999\" marks a missing value")
    );
}
