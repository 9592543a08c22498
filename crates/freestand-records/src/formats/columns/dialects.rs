//! Columns as many hands write them: every text holds one record, and must read as it.

use super::*;
use crate::formats::{MotionFile, parse_motions};

const ACCEL: [f64; 4] = [0.5, -0.25, 0.001, -0.0];

fn options(unit: &str, dt_s: f64) -> ReadOptions {
    ReadOptions {
        unit: (!unit.is_empty()).then(|| unit.to_owned()),
        dt_s: (dt_s > 0.0).then_some(dt_s),
        ..ReadOptions::default()
    }
}

fn read(bytes: &[u8], options: &ReadOptions) -> Result<MotionFile, Problem> {
    parse_motions(bytes.to_vec(), "rec.txt".as_ref(), options)
        .map_err(|error| error.problems[0].clone())
}

#[track_caller]
fn assert_one(bytes: &[u8], options: &ReadOptions) {
    let text = String::from_utf8_lossy(bytes);
    let file = read(bytes, options)
        .unwrap_or_else(|problem| panic!("{text}\n{problem} {:?}", problem.hint));
    assert_eq!(file.components.len(), 1, "{text}");
    // Exact: decimals, read in m/s².
    assert_eq!(file.components[0].motion.accel_m_s2(), ACCEL, "{text}");
    assert_eq!(file.components[0].motion.dt_s(), 0.01, "{text}");
}

/// With the number of each row before it.
fn numbered(csv: &str) -> String {
    csv.lines()
        .zip(1..)
        .map(|(row, number)| format!("{number},{row}\n"))
        .collect()
}

#[test]
fn time_and_acceleration() {
    let rows = "0.00 0.5\n0.01 -0.25\n0.02 0.001\n0.03 -0.0\n";
    let csv = rows.replace(' ', ",");
    let european = rows.replace(' ', ";").replace('.', ",");
    let quoted = "\"0,00\",\"0,5\"\n\"0,01\",\"-0,25\"\n\"0,02\",\"0,001\"\n\"0,03\",\"-0,0\"\n";
    for text in [
        format!("Time, s;a, m/s2\n{european}"),
        format!("sep=;\nTime [s];a [m/s2]\n{european}"),
        format!(
            "t / s\ta / (m/s^2)\n{}",
            rows.replace(' ', "\t").replace('.', ",")
        ),
        format!("t (s)  a (m/s2)\n{}", rows.replace('.', ",")),
        format!("\"Time (s)\",\"Acc., NS (m/s2)\"\n{csv}"),
        format!("\"Time (s)\",\"Acc., NS (m/s2)\"\n{quoted}"),
        format!("Time,Acceleration\n(s),(m/s/s)\n{csv}"),
        format!("Time,Acceleration\nsec,M/S**2\nmeasured,computed\n{csv}"),
        format!("Time Acceleration\ns m/s2\n---- ----\n{rows}"),
        format!("% time (s) acc (m/s2)\n{rows}"),
        format!("# time (s), acc (m/s2)\n{csv}"),
        format!("Time (s)   Acc. NS (m/s2)\n{rows}"),
        format!(
            "\t{}",
            format!("time [s]\ta [m/s2]\n{rows}")
                .replace(' ', "\t")
                .replace('\n', "\n\t")
        ),
        format!(
            "time [s]\ta [m/s2]\n{}",
            rows.replace(' ', "\t").replace('\n', "\t\n")
        ),
        format!("time [s],a [m/s2],,\n{csv}").replace(",,", ","),
        format!(
            "time [s] a [m/s2]\n{}",
            rows.replace("0.", ".").replace(" .", " +.")
        ),
        format!(
            "time [s] a [m/s2]\n\n\n{}\n\n  \n",
            rows.replace('\n', "\n\n")
        ),
        format!("Units: m/s2\nStation 24278, 12.3 km\n{rows}"),
        format!(
            "{}time [s] a [m/s2]\n{rows}",
            "A line of prose with 3 numbers, 1.5 and 7\n".repeat(5000)
        ),
        format!("No,t [s],a [m/s2]\n{}", numbered(&csv)),
        format!("Original sampling rate: 200 Hz\ntime [s] a [m/s2]\n{rows}"),
    ] {
        for ending in ["\n", "\r\n", "\r", "\r\r\n"] {
            let bytes = text.replace('\n', ending).into_bytes();
            assert_one(&bytes, &ReadOptions::default());
            assert_one(
                &[&b"\xEF\xBB\xBF"[..], &bytes].concat(),
                &ReadOptions::default(),
            );
        }
    }
    // Latin-1: a superscript two, and an umlaut above.
    assert_one(
        format!("B\u{fc}ro\nt [s] a [m/s#]\n{rows}")
            .replace('#', "\u{b2}")
            .chars()
            .map(|c| c as u8)
            .collect::<Vec<_>>()
            .as_slice(),
        &ReadOptions::default(),
    );
    // What the file leaves open.
    for text in [
        rows.to_owned(),
        csv.clone(),
        european,
        format!("time,a\n{csv}"),
        format!("4 0.01\n{rows}"),
        format!("0.01, 4\n{rows}"),
        numbered(&csv),
        // Time begins at the step.
        rows.replace("0.03", "0.04")
            .replace("0.02", "0.03")
            .replace("0.01", "0.02")
            .replace("0.00 ", "0.01 "),
        // Four decimals, and a clock that jitters by less than 1 % of the step.
        rows.replace("0.01", "0.0100").replace("0.02", "0.0200"),
    ] {
        assert_one(text.as_bytes(), &options("m/s2", 0.0));
    }
    let jittered = "0.00000 0.5\n0.01004 -0.25\n0.01997 0.001\n0.03000 -0.0\n";
    assert_one(jittered.as_bytes(), &options("m/s2", 0.0));
}

#[test]
fn one_column_or_a_series() {
    let unit = options("m/s2", 0.0);
    let both = options("m/s2", 0.01);
    for text in [
        "0.5\n-0.25\n0.001\n-0.0\n",
        "+0.5\n-0.25\n+1.0E-03\n-0.0\n\n",
        " 5D-1\n-.25\n.1e-2\n-0.\n",
    ] {
        assert_one(text.as_bytes(), &both);
        assert_one(format!("4 0.01\n{text}").as_bytes(), &unit);
        assert_one(format!("0.01 4\n{text}").as_bytes(), &unit);
        assert_one(format!("4\n{text}").as_bytes(), &both);
        assert_one(format!("a [m/s2]\n{text}").as_bytes(), &options("", 0.01));
        assert_one(
            format!("Acceleration, NS (m/s2)\n{text}").as_bytes(),
            &options("", 0.01),
        );
        assert_one(
            format!("Sampling rate: 100 Hz\nUnits: m/s2\n{text}").as_bytes(),
            &options("", 0.0),
        );
        assert_one(
            format!("# dt = 10 ms, units m/s2\n{text}").as_bytes(),
            &options("", 0.0),
        );
    }
    assert_one(b"4 0.01\n0.5 -0.25 0.001\n-0.0\n", &unit);
    // Several values a line are columns, whether or not one series was meant; a short last line
    // tells that it was.
    assert_eq!(
        read(b"0.5 -0.25\n0.001 -0.0\n", &both)
            .unwrap()
            .components
            .len(),
        2
    );
    let ragged = read(b"0.5 -0.25 1\n0.001 -0.0\n", &both).unwrap_err();
    assert!(ragged.hint.unwrap().contains("NPTS, DT"));
    // Decimal commas in one column look like two columns of whole numbers, but for -0.
    let comma = read(b"1,5\n-0,25\n2,1\n", &both).unwrap_err();
    assert!(comma.message.contains("decimal sign"), "{comma}");
    // A whole number above whole numbers may be a value.
    assert_eq!(
        read(b"2\n1\n3\n", &both).unwrap().components[0]
            .motion
            .accel_m_s2()
            .len(),
        3
    );
    let file = read(b"4\n0.5\n-0.25\n0.001\n-0.0\n", &both).unwrap();
    assert!(
        file.notes[0].to_string().contains("number of values"),
        "{:?}",
        file.notes
    );
}

#[test]
fn several_components() {
    let rows = "0.5 1.5 2.5\n-0.25 1.25 2.25\n0.001 0 0\n-0.0 0 0\n";
    let csv = rows.replace(' ', ",");
    for text in [
        format!(
            "SITE CODE= A,LAT.= 32\nSAMPLING RATE= 100Hz\nUNIT  = gal(cm/s/s)\nNS,EW,UD\n{csv}"
        ),
        format!("Time step: 0.01 s; units cm/s2\nNS EW UD\n{rows}"),
        format!(
            "# dt=0.01 units=cm/s2\nNS;EW;UD\n{}",
            rows.replace(' ', ";").replace('.', ",")
        ),
        format!("# dt=0.01\nNS (gal)   EW (gal)   UD (gal)\n{rows}"),
    ] {
        let file = read(text.as_bytes(), &ReadOptions::default())
            .unwrap_or_else(|problem| panic!("{text}\n{problem}"));
        let names: Vec<_> = file
            .components
            .iter()
            .map(|c| (c.name.as_str(), c.direction.is_some()))
            .collect();
        assert_eq!(names, [("NS", true), ("EW", true), ("UD", true)], "{text}");
        assert_eq!(
            (
                file.components[2].motion.dt_s(),
                file.components[2].motion.accel_m_s2()[1]
            ),
            (0.01, 0.0225)
        );
    }
    // A comment that states the step does not make a component of a column of times.
    let timed = "# dt=0.01 units=g\n0.00,0.5\n0.01,-0.25\n0.02,0.001\n0.03,-0.0\n";
    assert_eq!(
        read(timed.as_bytes(), &ReadOptions::default())
            .unwrap()
            .components
            .len(),
        1
    );
    // The flag does: that is what it is for.
    let file = read(timed.as_bytes(), &options("", 0.01)).unwrap();
    assert!(
        file.components.len() == 2
            && file
                .notes
                .iter()
                .any(|note| note.kind == NoteKind::MayBeTime)
    );
    // Prose that speaks of a step says nothing against a time column.
    let other = "dt = 0.5 s in another file\nunit g\n0.00,0.5\n0.01,-0.25\n0.02,0.001\n";
    assert_eq!(
        read(other.as_bytes(), &ReadOptions::default())
            .unwrap()
            .components[0]
            .motion
            .dt_s(),
        0.01
    );
}

/// The first row is of whole numbers, so that only the second shows the decimal comma.
#[test]
fn a_first_row_of_zeros_does_not_hide_the_decimal_comma() {
    for text in [
        "time [s];a [m/s2]\n0;0\n0,005;0,5\n0,01;-1,5\n",
        "time [s]\ta [m/s2]\n0\t0\n0,005\t0,5\n0,01\t-1,5\n",
    ] {
        let file = read(text.as_bytes(), &ReadOptions::default()).unwrap();
        assert_eq!(
            file.components[0].motion.accel_m_s2(),
            [0.0, 0.5, -1.5],
            "{text}"
        );
    }
}

/// A line over missing samples would be made up, and one over a repeated time cannot be drawn.
#[test]
fn a_gap_and_a_repeated_time_are_not_to_be_interpolated() {
    let told = |skip: usize, by_s: f64| {
        let row = |i: usize| {
            format!(
                "{:.2},{}\n",
                i as f64 * 0.01 + if i < skip { 0.0 } else { by_s },
                i % 7
            )
        };
        let text = format!(
            "time [s],a [m/s2]\n{}",
            (0..200).map(row).collect::<String>()
        );
        read(text.as_bytes(), &ReadOptions::default())
            .unwrap_err()
            .hint
            .unwrap()
    };
    assert!(told(100, 1.0).starts_with("samples are missing"));
    assert!(told(100, -0.01).contains("remove the row"));
}

#[test]
fn uneven_times_are_interpolated_only_on_request() {
    let text = "time [ms],NS [m/s2],EW [m/s2]\n0,1,0\n10,3,0\n40,0,3\n50,5,1\n";
    let refused = read(text.as_bytes(), &ReadOptions::default()).unwrap_err();
    assert!(
        refused.message.contains("uneven sampling") && refused.line == Some(4),
        "{refused}"
    );
    assert!(
        refused
            .hint
            .as_ref()
            .unwrap()
            .contains("`resample = \"0.01 s\"`"),
        "{refused:?}"
    );
    let asked = |dt_s| ReadOptions {
        uneven_dt_s: Some(dt_s),
        ..ReadOptions::default()
    };
    let file = read(text.as_bytes(), &asked(0.01)).unwrap();
    // Straight between the points: from 3 at 10 ms to 0 at 40 ms in thirds, which are exact here to
    // one rounding.
    for (found, expected) in file.components[0]
        .motion
        .accel_m_s2()
        .iter()
        .zip([1.0, 3.0, 2.0, 1.0, 0.0, 5.0])
    {
        assert!((found - expected).abs() < 1e-15, "{found} {expected}");
    }
    assert_eq!(
        (
            file.components[1].motion.accel_m_s2().len(),
            file.components[1].motion.dt_s()
        ),
        (6, 0.01)
    );
    assert_eq!(file.notes.len(), 1);
    assert!(
        file.notes[0]
            .to_string()
            .contains("4 points became 6 samples; steps were off by up to 0.02 s"),
        "{}",
        file.notes[0]
    );
    // A step that misses the largest value says so.
    let file = read(text.as_bytes(), &asked(0.02)).unwrap();
    assert_eq!(file.components[0].motion.accel_m_s2(), [1.0, 2.0, 0.0]);
    assert!(
        file.notes[1]
            .to_string()
            .contains("reduced a peak from 5.00000 to 2.00000"),
        "{:?}",
        file.notes
    );
    // Even times stay as they are; times that fall are refused all the same.
    let even = read(b"t [s],a [g]\n0,1\n0.05,2\n0.1,3\n", &asked(0.01)).unwrap();
    assert_eq!(
        (even.components[0].motion.dt_s(), even.notes.len()),
        (0.05, 0)
    );
    let falling = read(b"t [s],a [g]\n0,1\n0.5,2\n0.4,3\n0.6,3\n", &asked(0.01)).unwrap_err();
    assert!(
        falling.message.contains("does not increase") && falling.line == Some(4),
        "{falling}"
    );
    let far = read(b"t [s],a [g]\n0,1\n0.5,2\n1e9,3\n", &asked(0.01)).unwrap_err();
    assert!(far.message.contains("too long"), "{far}");
}

#[test]
fn many_columns_share_the_room_for_interpolated_samples() {
    // 50 columns of 100 s at 1e-6 s would be 5e9 samples, 40 GB, from a file of 300 bytes.
    let row = |time: &str| format!("{time}{}\n", ",1".repeat(50));
    let text = format!(
        "time [s]{}\n{}{}{}",
        ",a [g]".repeat(50),
        row("0"),
        row("1"),
        row("99")
    );
    let asked = ReadOptions {
        uneven_dt_s: Some(1e-6),
        ..ReadOptions::default()
    };
    let error = parse_motions(text.clone().into_bytes(), "x.csv".as_ref(), &asked).unwrap_err();
    assert!(error.to_string().contains("too long for steps"), "{error}");
    let asked = ReadOptions {
        uneven_dt_s: Some(0.5),
        ..ReadOptions::default()
    };
    let file = parse_motions(text.into_bytes(), "x.csv".as_ref(), &asked).unwrap();
    assert_eq!(
        (
            file.components.len(),
            file.components[49].motion.accel_m_s2().len()
        ),
        (50, 199)
    );
}
