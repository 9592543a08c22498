use super::*;
use crate::formats::{MotionFile, parse_motions, write_at2, write_csv};
use crate::text::headings::heading;
use freestand::G0_M_S2;
use freestand::motion::Motion;

fn options(unit: &str, dt_s: f64) -> ReadOptions {
    ReadOptions {
        unit: (!unit.is_empty()).then(|| unit.to_owned()),
        dt_s: (dt_s > 0.0).then_some(dt_s),
        ..ReadOptions::default()
    }
}

fn parse(text: &str, options: &ReadOptions) -> Result<MotionFile, Problem> {
    parse_motions(text.as_bytes().to_vec(), "in/rec.txt".as_ref(), options)
        .map_err(|error| error.problems[0].clone())
}

/// Name, unit, dt and samples of each component, in m/s².
fn facts(file: &MotionFile) -> Vec<(&str, &str, f64, &[f64])> {
    file.components
        .iter()
        .map(|c| {
            (
                c.name.as_str(),
                c.unit,
                c.motion.dt_s(),
                c.motion.accel_m_s2(),
            )
        })
        .collect()
}

/// Exact: times are decimals and samples in m/s² pass unchanged.
#[test]
fn one_motion_in_many_hands() {
    let expected = [("a", "m/s2", 0.01, &[0.5, -0.25, 1e-3][..])];
    for text in [
        "t [s],a [m/s2]\n0,0.5\n0.01,-0.25\n0.02,1e-3\n",
        "time(s);a(m/s^2)\r\n0,00;0,5\r\n0,01;-0,25\r\n0,02;0,001\r\n",
        "time [s];a [m/s2]\n0.00;0.5\n0.01;-0.25\n0.02;0.001",
        "Time [ms]\ta [m/s²]\n0\t.5\n10\t-.25\n20\t1D-3\n",
        "Time [ms]\ta [m/s²]\n0\t,5\n10\t-,25\n20\t0,001\n",
        "Time (s)  a (m/s2)\n 0.00  0.5\n 0.01 -0.25\n 0.02 .001\n",
        "time,a\ns,m/s2\n0.01,0.5\n0.02,-0.25\n0.03,0.001\n",
        "\"time [s]\",\"a [m/s2]\"\n\"0.00\",\"0.5\"\n\"0.01\",\"-0.25\"\n\"0.02\",\"0.001\"\n",
        "A record of 3 samples\n\nStation 24278\nt[s] a[m/s2]\n0.00\t0.5\n0.01\t-0.25\n0.02\t1e-3",
        "# a comment\nt[s],a[m/s2]\n# more\n100.00, 0.5\n\n# between\n100.01, -0.25\n100.02, 1e-3\n",
        "# t [s], a [m/s2]\n0,0.5\n0.01,-0.25\n0.02,0.001\n",
        "t [s],a [m/s2],\n0,0.5,\n0.01,-0.25,\n0.02,0.001,\n",
        "time [s] a [M/SEC/SEC]\n0.00 0.5\n0.01-0.25\n0.02 1.0-003\n",
    ] {
        for ending in ["\n", "\r\n", "\r", "\r\r\n"] {
            let text = text.replace("\r\n", "\n").replace('\n', ending);
            let file = parse(&text, &ReadOptions::default())
                .unwrap_or_else(|problem| panic!("{text}: {problem}"));
            assert_eq!(facts(&file), expected, "{text}");
        }
    }
}

#[test]
fn what_the_file_leaves_open_the_flags_say() {
    // One column and a step.
    let file = parse("0.1\n-0.2\n", &options("m/s2", 0.02)).unwrap();
    assert_eq!(
        (facts(&file), file.format),
        (vec![("rec", "m/s2", 0.02, &[0.1, -0.2][..])], "columns")
    );
    // With a step every column is a component, without it the first is the time.
    let file = parse("0.00,1,2\n0.02,3,4\n", &options("m/s2", 0.5)).unwrap();
    let names = ["component 1", "component 2", "component 3"];
    assert_eq!(
        file.components
            .iter()
            .map(|c| c.name.as_str())
            .collect::<Vec<_>>(),
        names
    );
    let file = parse("0.00,1,2\n0.02,3,4\n", &options("m/s2", 0.0)).unwrap();
    let expected = vec![
        ("component 1", "m/s2", 0.02, &[1.0, 3.0][..]),
        ("component 2", "m/s2", 0.02, &[2.0, 4.0][..]),
    ];
    assert_eq!((facts(&file), file.format), (expected, "CSV"));
    assert!(file.notes[0].to_string().contains("seconds"));
    // A header that names the time keeps it the time.
    let file = parse("time_s,accel_m_s2\n0,1\n0.02,3\n", &options("", 0.02)).unwrap();
    assert_eq!(
        facts(&file),
        [("accel_m_s2", "m/s2", 0.02, &[1.0, 3.0][..])]
    );
    // Comments state unit and step.
    let text = "# synthetic\n# units=m/s^2 dt=0.005 columns=2\n0,1\n2,3\n";
    let file = parse(text, &ReadOptions::default()).unwrap();
    assert_eq!(
        (
            file.components.len(),
            file.components[1].motion.accel_m_s2()
        ),
        (2, &[1.0, 3.0][..])
    );
    assert_eq!(
        (file.components[0].motion.dt_s(), file.notes.len()),
        (0.005, 2)
    );
    let file = parse("# units=g, dt = 5ms\n0\n1\n", &ReadOptions::default()).unwrap();
    assert_eq!(
        (
            file.components[0].motion.dt_s(),
            file.components[0].motion.accel_m_s2()[1]
        ),
        (0.005, G0_M_S2)
    );
    // Prose states the unit.
    let file = parse("Units: cm/s2\n0 1\n0.1 2\n", &ReadOptions::default()).unwrap();
    assert_eq!((file.components[0].unit, file.notes.len()), ("cm/s2", 2));
    // The first row is npts and dt.
    let file = parse("5 0.02\n1 2 3\n4 5\n", &options("m/s2", 0.0)).unwrap();
    assert_eq!(
        facts(&file),
        [("rec", "m/s2", 0.02, &[1.0, 2.0, 3.0, 4.0, 5.0][..])]
    );
    assert!(file.notes[0].to_string().contains("number of values"));
    // A velocity next to the acceleration is left out, with a note.
    let file = parse(
        "t[s],a[g],v[cm/s],disp,force [kN]\n0,1,1,1,1\n0.1,2,2,2,2\n",
        &ReadOptions::default(),
    )
    .unwrap();
    assert_eq!((file.components.len(), file.notes.len()), (1, 3));
}

#[test]
fn what_is_refused() {
    let none = || options("", 0.0);
    for (text, options, line, message) in [
        (
            "0 1\n1 2\n",
            none(),
            None,
            "the unit of the acceleration is not stated",
        ),
        (
            "1\n2\n",
            options("g", 0.0),
            Some(1),
            "one column and no time step",
        ),
        ("1\n", options("g", 0.1), Some(1), "at least 2 samples"),
        ("0 1\n", options("g", 0.0), Some(1), "one sample"),
        (
            "t[s],a[g]\n0,1\n1,2\n",
            options("m/s2", 0.0),
            Some(1),
            "is in g according to the file, not in m/s2",
        ),
        (
            "t[s],a[g]\n0,1\n1,2\n",
            options("", 0.5),
            Some(1),
            "not 0.5 s",
        ),
        (
            "# units=g dt=0.1\n0\n1\n",
            options("", 0.5),
            Some(1),
            "0.1 s according to the file, not 0.5 s",
        ),
        (
            "# units=g dt=-1\n0\n1\n",
            none(),
            Some(1),
            "must be positive",
        ),
        (
            "# units=cm/s dt=1\n0\n1\n",
            options("g", 0.0),
            Some(1),
            "is a velocity (cm/s)",
        ),
        (
            "t[s],v[cm/s]\n0,1\n1,2\n",
            options("g", 0.0),
            Some(2),
            "no column holds an acceleration, only a velocity",
        ),
        (
            "a[g],t[s]\n0,1\n1,2\n",
            none(),
            Some(1),
            "the first column is not the time",
        ),
        (
            "0 1\n1 2\n2 3 4\n",
            options("g", 0.0),
            Some(3),
            "the first row has 2 values, this one has 3",
        ),
        (
            "0,1\n1,2\n2\n",
            options("g", 0.0),
            Some(3),
            "the first row has 2 values, this one has 1",
        ),
        (
            "0,1\n1,\n2,1\n",
            options("g", 0.0),
            Some(2),
            "a value is missing",
        ),
        (
            "0,1,1\n1,,2\n2,1,1\n",
            options("g", 0.0),
            Some(2),
            "a value is missing",
        ),
        (
            "0,1\n1,x\n",
            options("g", 0.0),
            Some(2),
            "\"x\" is not a number",
        ),
        (
            "0,1\n1,NaN\n",
            options("g", 0.0),
            Some(2),
            "\"NaN\" marks a missing value",
        ),
        (
            "0,NaN\n1,1\n",
            options("g", 0.0),
            Some(1),
            "\"NaN\" marks a missing value",
        ),
        (
            "# c\n0,1\n\n1,-999\n",
            options("g", 0.0),
            Some(4),
            "\"-999\" marks a missing value",
        ),
        ("0 1\n1 inf\n", options("g", 0.0), Some(2), "missing value"),
        (
            "0.00,O.1\n0.01,0.2\n0.02,0.3\n",
            options("g", 0.0),
            Some(1),
            "\"O.1\" is not a number",
        ),
        (
            "0.00 1\n0.01 2\n0.03 3\n0.04 4\n0.05 5\n",
            options("g", 0.0),
            Some(3),
            "uneven sampling: 0.03 after 0.01, where the step is 0.01",
        ),
        (
            "0 1\n1 2\n0 3\n",
            options("g", 0.0),
            Some(3),
            "does not increase",
        ),
        (
            "0,0123\n0,0222\n-0,0100\n",
            options("g", 0.01),
            Some(1),
            "comma may be a decimal sign",
        ),
        (
            "5 0.02\n1 2 3\n4\n",
            options("g", 0.0),
            Some(2),
            "the first row has 2 values, this one has 3",
        ),
        (
            "t[s],a[g]\n0,1\n1e-9,2\n",
            none(),
            Some(2),
            "the time step must be from 1e-6 s to 100 s, not 1e-9 s",
        ),
        (
            "0 1\n1000 2\n",
            options("g", 0.0),
            Some(1),
            "from 1e-6 s to 100 s, not 1000.0 s",
        ),
        ("# units=g dt=1e-12\n0\n1\n", none(), Some(2), "not 1e-12 s"),
        (
            "time [min],a [g]\n0,1\n1,2\n",
            none(),
            Some(1),
            "\"time [min]\" does not state a unit of time",
        ),
        ("nothing but words\n", none(), None, "no row of numbers"),
        ("# only comments\n", none(), None, "no row of numbers"),
    ] {
        let problem = parse(text, &options).expect_err(text);
        assert!(
            problem.message.contains(message),
            "{text}{message}: {problem}"
        );
        assert_eq!(problem.line, line, "{text}: {problem}");
        assert!(
            problem.hint.is_some() && problem.path.is_some(),
            "{problem:?}"
        );
    }
    for dt_s in [-1.0, 0.0, f64::NAN, f64::INFINITY, 1e-9, 101.0] {
        let problem = parse(
            "1\n2\n",
            &ReadOptions {
                unit: Some("g".to_owned()),
                dt_s: Some(dt_s),
                ..ReadOptions::default()
            },
        )
        .expect_err("a bad step");
        assert!(
            problem.message.contains("time step") && problem.hint.is_some(),
            "{problem:?}"
        );
    }
}

/// Above one column a damaged number must not pass as a header of one word: the sample would be
/// lost in silence.
#[test]
fn a_header_of_one_word_is_told_from_a_damaged_number() {
    for word in [
        "nan",
        "-inf",
        "*****",
        "0.12O",
        "O.12",
        "-nan(ind)",
        "1.#IND",
        ".",
        "-",
        "1.2.3",
        "+-1",
        "null",
    ] {
        for above in ["", "# comment\n", "accel\n"] {
            let text = format!("{above}{word}\n1\n2\n");
            // Below a heading a dash or a point may underline it.
            if above == "accel\n" && matches!(word, "." | "-") {
                continue;
            }
            let problem = parse(&text, &options("g", 0.01)).expect_err(&text);
            assert_eq!(problem.line, Some(text.lines().count() - 2), "{text}");
            assert!(
                problem.message.contains(word) && problem.hint.unwrap().contains('#'),
                "{text}"
            );
        }
    }
    assert_eq!(
        parse("nan,O.1\n0,1\n1,2\n", &options("g", 0.0))
            .unwrap_err()
            .line,
        Some(1)
    );
    for word in [
        "accel",
        "acceleration_m_s2",
        "a [g]",
        "a[g]",
        "OHC1",
        "El_Centro",
        "infra",
        "accel\n-----",
        "NS-2",
    ] {
        let file = parse(&format!("{word}\n1\n2\n"), &options("", 0.01));
        let file = file.or_else(|_| parse(&format!("{word}\n1\n2\n"), &options("g", 0.01)));
        assert_eq!(
            file.map(|file| file.components[0].motion.accel_m_s2().len()),
            Ok(2),
            "{word}"
        );
    }
    assert_eq!(
        parse("1st 2nd\n1 2\n3 4\n", &options("g", 0.01))
            .unwrap()
            .components[0]
            .name,
        "1st"
    );
}

#[test]
fn header_cells() {
    for (cell, name, unit) in [
        ("Accel[g]", "Accel", Some("g")),
        ("acceleration (cm/s2)", "acceleration", Some("cm/s2")),
        ("time_s", "time_s", Some("s")),
        ("time_ms", "time_ms", Some("ms")),
        ("t_us", "t_us", Some("us")),
        ("Time [µs]", "Time", Some("us")),
        ("time_of_day", "time_of_day", None),
        // N is north, but of a force.
        ("acceleration (N)", "acceleration (N)", None),
        ("force (N)", "force", Some("N")),
        ("ah_m_s2", "ah_m_s2", Some("m/s2")),
        ("accel_g", "accel_g", Some("g")),
        ("acc_g", "acc_g", Some("g")),
        ("acc_cm_s2", "acc_cm_s2", Some("cm/s2")),
        ("acc in g", "acc", Some("g")),
        ("station in town", "station in town", None),
        ("vel_m_s", "vel_m_s", Some("m/s")),
        ("height_m", "height_m", None),
        ("a_g", "a_g", None),
        ("a (NS)", "a (NS)", None),
        ("a", "a", None),
        ("a ]g[", "a ]g[", None),
    ] {
        let found = heading(cell);
        assert_eq!(
            (found.name.as_str(), found.unit.map(|unit| unit.symbol)),
            (name, unit),
            "{cell}"
        );
    }
}

#[test]
fn our_own_files_read_back() {
    for dt_s in [0.005, 0.01, 1.0 / 3.0, 1.0 / 256.0, 1e-6, 73.0] {
        let samples: Vec<f64> = (0..2000)
            .map(|i| (f64::from(i) * 0.7).sin() * 10f64.powi(i % 40 - 30))
            .collect();
        let motion = Motion::new(dt_s, samples).unwrap();
        let file = parse(&write_csv(&motion), &ReadOptions::default()).unwrap();
        assert_eq!(file.components[0].motion, motion, "to the bit, dt {dt_s}");
        let file = parse(&write_at2(&motion, "title"), &ReadOptions::default()).unwrap();
        assert_eq!(
            (file.format, file.components[0].motion.dt_s()),
            ("PEER AT2", dt_s)
        );
        for (a, b) in file.components[0]
            .motion
            .accel_m_s2()
            .iter()
            .zip(motion.accel_m_s2())
        {
            // 8 significant digits: half of 1e-7 of the leading digit, at worst 5e-8 of the value.
            assert!((a - b).abs() <= 5.01e-8 * b.abs(), "{a} {b}");
        }
    }
    let edges = [f64::MIN_POSITIVE, 5e-324, -0.0, 1e20, -1.5e29, 0.1 + 0.2];
    let motion = Motion::new(0.1 + 0.2, edges.to_vec()).unwrap();
    let back = parse(&write_csv(&motion), &ReadOptions::default()).unwrap();
    let bits = |motion: &Motion| {
        motion
            .accel_m_s2()
            .iter()
            .map(|a| a.to_bits())
            .collect::<Vec<_>>()
    };
    assert_eq!(bits(&back.components[0].motion), bits(&motion));
}

/// One value a line, as OpenSees takes it.
fn series(count: usize, print: impl Fn(f64) -> String) -> String {
    (0..count)
        .map(|i| print((i as f64 * 0.7 + 0.3).sin() * 0.3) + "\n")
        .collect()
}

#[test]
fn a_number_of_values_that_does_not_fit_is_no_value() {
    let options = options("g", 0.01);
    let decimals = series(300, |value| format!("{value:.6}"));
    let problem = parse(&format!("400\n{decimals}"), &options).unwrap_err();
    assert_eq!(
        problem.message,
        "the first row, 400, seems to be the number of values, but 300 values follow"
    );
    assert!(problem.line == Some(1) && problem.hint.unwrap().contains("cut off"));
    // The number that fits, a first value with a point, one that others exceed, one of several
    // whole ones.
    assert_eq!(
        parse(&format!("300\n{decimals}"), &options)
            .unwrap()
            .components[0]
            .motion
            .accel_m_s2()
            .len(),
        300
    );
    for text in [
        format!("400.0\n{decimals}"),
        format!("2\n3.5\n{decimals}"),
        format!("2\n1\n{decimals}"),
    ] {
        assert!(parse(&text, &options).is_ok(), "{text}");
    }
    let whole = series(300, |value| format!("{:.0}", value * 1e3));
    let file = parse(
        &format!("300\n{whole}"),
        &ReadOptions {
            unit: Some("mm/s2".into()),
            ..options.clone()
        },
    );
    let file = file.unwrap();
    assert_eq!(file.components[0].motion.accel_m_s2().len(), 301);
    assert!(
        file.notes[0]
            .to_string()
            .contains("the first row, 300, is read as a value"),
        "{:?}",
        file.notes
    );
}

#[test]
fn values_that_no_motion_has_and_numbers_that_lost_characters_are_said() {
    let options = options("g", 0.01);
    let text = series(300, |value| {
        format!("{value:.7E}")
            .replace("E-1", "E-01")
            .replace("E-2", "E-02")
            .replace("E-3", "E-03")
    });
    let notes = |text: &str| parse(text, &options).unwrap().notes;
    assert_eq!(notes(&text), [""; 0]);
    let cut = text.trim_end();
    let cut = notes(&cut[..cut.len() - 5]);
    assert!(
        cut.len() == 1
            && cut[0]
                .to_string()
                .starts_with("line 300: a number has more or fewer"),
        "{cut:?}"
    );
    // A lost point makes 39,000 g of a record.
    let at = text.match_indices('.').nth(99).unwrap().0;
    let lost = notes(&format!("{}{}", &text[..at], &text[at + 1..]));
    assert!(
        lost.len() == 2 && lost[0].to_string().starts_with("line 100: "),
        "{lost:?}"
    );
    assert!(
        lost[1].to_string().contains("value 100 is")
            && lost[1].to_string().contains("check the unit (g)"),
        "{lost:?}"
    );
}

#[test]
fn a_number_of_rows_that_is_stated_is_compared() {
    let rows = "0,1\n0.01,2\n0.02,3\n";
    for (head, told) in [
        ("# npts: 6\nt [s],a [m/s2]\n", true),
        ("NPTS=6\nt [s],a [m/s2]\n", true),
        ("# NPTS = 3\nt [s],a [m/s2]\n", false),
    ] {
        let file = parse(&format!("{head}{rows}"), &ReadOptions::default()).unwrap();
        let note = "line 1 states 6 values, but the table has 3 rows: it may be cut off";
        assert_eq!(
            file.notes.iter().any(|found| *found == note),
            told,
            "{head} {:?}",
            file.notes
        );
    }
}

#[test]
fn units_that_are_stated_but_not_known_are_said_to_be_so() {
    for (head, line) in [
        ("t [s],a [furlong/s2]", 1),
        ("# Units: furlong/s2\nt [s],a", 1),
    ] {
        let problem =
            parse(&format!("{head}\n0,1\n0.01,2\n"), &ReadOptions::default()).unwrap_err();
        assert_eq!(
            (problem.message.as_str(), problem.line),
            ("the unit \"furlong/s2\" is not known", Some(line))
        );
        assert!(parse(&format!("{head}\n0,1\n0.01,2\n"), &options("g", 0.0)).is_ok());
    }
    let file = parse(
        "t [s],a [in/s2],b [%g]\n0,1,1\n0.01,2,2\n",
        &ReadOptions::default(),
    )
    .unwrap();
    // Exact: one product each.
    assert_eq!(
        file.components[0].motion.accel_m_s2(),
        [0.0254, 2.0 * 0.0254]
    );
    assert_eq!(
        file.components[1].motion.accel_m_s2(),
        [0.01 * G0_M_S2, 0.02 * G0_M_S2]
    );
}

#[test]
fn a_spectrum_is_no_motion() {
    let problem = parse("period [s],Sa [g]\n0.1,1\n0.2,2\n", &ReadOptions::default()).unwrap_err();
    assert!(
        problem.message.contains("seems to be a spectrum") && problem.line == Some(1),
        "{problem}"
    );
}

#[test]
fn minus_999_is_missing_where_it_stands_out() {
    let rows = "0,-998\n0.01,-999\n0.02,-700.5\n";
    let head = "t [s],a [mm/s2]\n";
    let file = parse(&format!("{head}{rows}"), &ReadOptions::default()).unwrap();
    assert_eq!(
        file.notes,
        [
            "line 3: -999 is read as a value because others are as large; it may mark a missing value"
        ]
    );
    let rows = rows.replace("-998", "9").replace("-700.5", "400");
    let problem = parse(&format!("{head}{rows}"), &ReadOptions::default()).unwrap_err();
    assert_eq!(
        (problem.message.as_str(), problem.line),
        ("\"-999\" marks a missing value", Some(3))
    );
}

/// A pulse of 0.3 g in 200 samples, with what a row makes of its number and its value.
fn rows(heading: &str, row: impl Fn(usize, f64) -> String) -> String {
    let pulse =
        |i: usize| 0.3 * (-((i as f64 - 100.0) / 20.0).powi(2)).exp() * (0.9 * i as f64).sin();
    std::iter::once(format!("{heading}\n"))
        .chain((0..200).map(|i| row(i, pulse(i))))
        .collect()
}

/// The number of a sample is not its time: without a step the file is refused, with one it is read.
#[test]
fn numbers_of_samples_are_no_seconds() {
    for name in ["sample", "Index", "No.", "Nr", "Sample number"] {
        for start in [0, 1] {
            let text = rows(&format!("{name},a [g]"), |i, a| {
                format!("{},{a:.6}\n", i + start)
            });
            let problem = parse(&text, &ReadOptions::default()).unwrap_err();
            assert!(
                problem.hint.is_some_and(|hint| hint.contains("`dt")),
                "{name}"
            );
            let file = parse(&text, &options("", 0.01)).unwrap();
            assert_eq!(
                (file.components.len(), file.components[0].motion.dt_s()),
                (1, 0.01),
                "{name}"
            );
        }
    }
    let timed = rows("t,a [g]", |i, a| format!("{},{a:.6}\n", i));
    assert_eq!(
        parse(&timed, &ReadOptions::default()).unwrap().components[0]
            .motion
            .dt_s(),
        1.0
    );
}

#[test]
fn nines_in_a_gap_are_no_values() {
    let text = rows("t [s],a [gal]", |i, a| {
        let value = if (50..53).contains(&i) {
            9999.99
        } else {
            981.0 * a
        };
        format!("{:.2},{value:.2}\n", 0.01 * i as f64)
    });
    assert_eq!(
        parse(&text, &ReadOptions::default()).unwrap_err().line,
        Some(52)
    );
}

/// An offset of 1 g and one of 0.1 g are said, a record about zero and a pulse to one side are not.
#[test]
fn an_offset_is_said() {
    let of = |offset: f64, share: f64| {
        let text = rows("t [s],a [g]", |i, a| {
            format!("{:.2},{:.6}\n", 0.01 * i as f64, offset + a.max(share * a))
        });
        parse(&text, &ReadOptions::default()).unwrap().notes
    };
    assert_eq!(
        (of(0.0, 1.0).len(), of(0.0, 0.0).len(), of(0.005, 1.0).len()),
        (0, 0, 0)
    );
    for offset in [1.0, -1.0, 0.1] {
        let notes = of(offset, 1.0);
        assert!(
            notes
                .iter()
                .any(|note| note.to_string().contains("baseline")),
            "{offset}: {notes:?}"
        );
    }
}

/// A heading must not tell a terminal what to do.
#[test]
fn control_characters_stay_in_the_file() {
    let file = parse(
        "t [s],a\u{1b}[31m\u{7}b [g]\n0,0\n0.01,1\n",
        &ReadOptions::default(),
    )
    .unwrap();
    let mut said = file
        .components
        .iter()
        .map(|c| c.name.clone())
        .chain(file.notes.iter().map(|note| note.to_string()));
    assert!(said.all(|text| !text.contains(char::is_control)));
}
