use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};
use std::fmt::Write;

const EARTHQUAKE: &str = "#Earthquake Information\n#Origin Time(GMT+08): 2018/02/06-23:50:42\n\
    #EpicenterLongitude(E): 121.69\n#EpicenterLatitude(N): 24.14\n#Depth(km): 10.0\n#Magnitude(Ml): 6.0\n\
    #Station Information\n";

/// A file as the agency's headers describe it: the lines of the header, then 4F10.3.
fn file(earthquake: bool) -> String {
    let mut text = if earthquake {
        EARTHQUAKE.to_owned()
    } else {
        String::new()
    };
    text.push_str(
        "#StationCode: ABC\n#StartTime(GMT+08): 2018/02/06-23:50:29.000\n#RecordLength(sec):    1.000\n\
        #SampleRate(Hz): 200\n#AmplitudeUnit:  gal. DCoffset(corr)\n#AmplitudeMAX. U:    1.000~   -3.000\n\
        #AmplitudeMAX. N:    2.000~   -2.000\n#AmplitudeMAX. E: 1234.500~   -1.500\n\
        #DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n",
    );
    for i in 0..200 {
        let (u, n, e) = match i {
            7 => (-3.0, 2.0, 1234.5),
            _ => (1.0, -1.0, -1.5),
        };
        let _ = writeln!(
            text,
            "{:>10.3}{u:>10.3}{n:>10.3}{e:>10.3}",
            f64::from(i) * 0.005
        );
    }
    text
}

fn read(text: &str) -> Result<MotionFile, String> {
    parse_motions(
        text.as_bytes().to_vec(),
        "x.txt".as_ref(),
        &ReadOptions::default(),
    )
    .map_err(|error| error.problems[0].to_string())
}

#[test]
fn three_components_in_the_order_of_the_header() {
    for (earthquake, line) in [(true, 18), (false, 11)] {
        let found = read(&file(earthquake)).unwrap();
        assert_eq!((found.format, &found.notes), ("CWA", &Vec::new()));
        let about: Vec<_> = found
            .components
            .iter()
            .map(|one| (one.name.as_str(), one.direction))
            .collect();
        let (north, east) = (Direction::Azimuth(0.0), Direction::Azimuth(90.0));
        assert_eq!(
            about,
            [
                ("U", Some(Direction::Up)),
                ("N", Some(north)),
                ("E", Some(east))
            ]
        );
        for (one, at_7) in found.components.iter().zip([-3.0, 2.0, 1234.5]) {
            assert_eq!(
                (one.unit, one.is_raw, one.motion.dt_s()),
                ("gal", false, 0.005)
            );
            assert_eq!(
                (one.station.as_deref(), one.line_of_first_value),
                (Some("ABC"), line)
            );
            // Exact: both are the product of the same two f64.
            assert_eq!(
                (one.motion.accel_m_s2()[7], one.motion.accel_m_s2().len()),
                (at_7 / 100.0, 200)
            );
        }
    }
}

#[test]
fn headers_of_other_hands() {
    let text = file(true);
    for (from, to) in [
        ("\n", "\r\n"),
        ("\n#", "\n\n#"),
        ("#Data: 4F10.3\n", ""),
        ("#RecordLength(sec):    1.000\n", ""),
        ("#RecordLength(sec):    1.000", "#RecordLength(sec): 2"),
        ("#StartTime", "#StartTime(GMT+08): \u{e9}\n#StartTime"),
        ("U(+); N(+); E(+)", "U(+);N(+);E(+)"),
        ("gal. DCoffset(corr)", "cm/s/s DCoffset(corr)"),
    ] {
        assert!(text.contains(from), "{from}");
        let found =
            read(&text.replace(from, to)).unwrap_or_else(|problem| panic!("{to}: {problem}"));
        assert_eq!(
            found.components[2].motion.accel_m_s2()[7],
            1234.5 / 100.0,
            "{to}"
        );
    }
    let raw = read(&text.replace("DCoffset(corr)", "")).unwrap();
    assert!(
        raw.components.iter().all(|one| one.is_raw),
        "nothing says that the offset was removed"
    );
    let turned = read(&text.replace("U(+); N(+)", "N(-); U(-)")).unwrap();
    let directions: Vec<_> = turned.components.iter().map(|one| one.direction).collect();
    assert_eq!(
        directions,
        [
            Some(Direction::Azimuth(180.0)),
            None,
            Some(Direction::Azimuth(90.0))
        ]
    );
    assert!(
        read(&text.replace("-3.000\n", "-6.000\n")).unwrap().notes[0]
            .to_string()
            .contains("header states a peak")
    );
}

#[test]
fn what_is_wrong_names_its_line() {
    let text = file(true);
    for (from, to, line, message) in [
        ("     0.100", "     0.105", "x.txt:38:", "the time is 0.105"),
        (
            "     0.100     1.000    -1.000    -1.500\n",
            "",
            "x.txt:38:",
            "the time is 0.105",
        ),
        (
            "     0.100     1.000    -1.000    -1.500\n",
            "     0.100     1.000    -1.000\n",
            "x.txt:38:",
            "this one has 3",
        ),
        (
            "(sec):    1.000",
            "(sec):    2.000",
            "x.txt:10:",
            "400 rows, but the file has 200",
        ),
        (
            "#SampleRate(Hz): 200",
            "#SampleRate(Hz): 100",
            "x.txt:20:",
            "the time is 0.01",
        ),
        (
            "#SampleRate(Hz): 200",
            "#SampleRate(Hz): 0",
            "x.txt:11:",
            "sampling rate is 0",
        ),
        (
            "#SampleRate(Hz): 200",
            "#SampleRate(Hz): many",
            "x.txt:11:",
            "not a number",
        ),
        (
            "#SampleRate(Hz): 200\n",
            "",
            "x.txt:16:",
            "no line \"#SampleRate\"",
        ),
        (
            "gal. DCoffset",
            "Count. DCoffset",
            "x.txt: ",
            "unit of the record is not stated",
        ),
        (
            "gal. DCoffset",
            "cm. DCoffset",
            "x.txt:12:",
            "an acceleration is expected",
        ),
        (
            "#DataSequence: Time",
            "#DataSequence:",
            "x.txt:16:",
            "columns are given as",
        ),
        ("#Data: 4F10.3", "#Data: 3F10.3", "x.txt:17:", "4 columns"),
        (
            "-3.000     2.000",
            "-999.0     2.000",
            "x.txt:25:",
            "missing value",
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let problem = read(&text.replacen(from, to, 1)).expect_err(message);
        assert!(
            problem.starts_with(line) && problem.contains(message),
            "{problem}"
        );
    }
    let header_only: String = text
        .lines()
        .take(17)
        .map(|line| format!("{line}\n"))
        .collect();
    assert!(
        read(&header_only)
            .unwrap_err()
            .contains("x.txt:17: no row of numbers")
    );
}

#[test]
fn a_row_less_than_the_length_holds_is_said() {
    let found = read(&file(true).replace("(sec):    1.000", "(sec):    1.005")).unwrap();
    assert_eq!(
        found.notes,
        ["200 rows were read, but 1.005 s at 200 Hz would be 201"]
    );
    // A length that leaves out the last step, and one that is rounded.
    for length in ["0.995", "1.0", "1"] {
        assert!(
            read(&file(true).replace("(sec):    1.000", &format!("(sec): {length}")))
                .unwrap()
                .notes
                .is_empty()
        );
    }
}
