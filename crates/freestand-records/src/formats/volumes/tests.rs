use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};
use freestand::G0_M_S2;

/// 16I5 and 8F10.3 blocks of `integers` and `reals` numbers; integers 28 and 53 are the number of
/// points.
fn blocks(npts: usize, integers: (usize, usize), reals: usize) -> String {
    let (count, width) = integers;
    let ints: Vec<String> = (1..=count)
        .map(|i| {
            if matches!(i, 28 | 53) {
                format!("{npts:>width$}")
            } else {
                format!("{i:>width$}")
            }
        })
        .collect();
    let reals: Vec<String> = (1..=reals)
        .map(|i| format!("{:>10.3}", -0.5 * i as f64))
        .collect();
    let rows = |fields: &[String], n: usize| {
        fields
            .chunks(n)
            .map(|row| row.concat() + "\n")
            .collect::<String>()
    };
    rows(&ints, 80 / width) + &rows(&reals, 8)
}

fn padded(text: &[&str], lines: usize) -> String {
    text.iter()
        .copied()
        .chain(std::iter::repeat(""))
        .take(lines)
        .map(|line| line.to_owned() + "\n")
        .collect()
}

/// Pairs in 10F7.3.
fn pairs(points: &[(f64, f64)]) -> String {
    let fields = |(t, a): &(f64, f64)| format!("{t:>7.3}{a:>7.3}");
    points
        .chunks(5)
        .map(|row| row.iter().map(fields).collect::<String>() + "\n")
        .collect()
}

const V1_TEXT: [&str; 12] = [
    "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 02/28/94",
    "SOME EARTHQUAKE",
    "(ORIGIN: ?)",
    "99999-S1-1.01   TRIGGER TIME: 01/17/94",
    "STATION NO. 99999   34.000N, 118.000W     SMA-1  S/N 0001",
    "A TOWN - MAIN ST                 CSMIP",
    "CHAN  1:  90 DEG",
    "SOME EARTHQUAKE",
    "HYPOCENTER: ?",
    "INSTR PERIOD =  .0407 SEC",
    "NO. OF POINTS =  6  RECORD LENGTH =  .110 SEC",
    "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =  1.250 G, AT  .020 SEC.",
];

const UNEVEN: [(f64, f64); 6] = [
    (0.0, 1.0),
    (0.02, -12.5),
    (0.035, 0.25),
    (0.05, 0.0),
    (0.09, -2.0),
    (0.11, 2.0),
];

fn v1(points: &[(f64, f64)]) -> String {
    padded(&V1_TEXT, 13)
        + &blocks(points.len(), (100, 5), 50)
        + &pairs(points)
        + "/&  ----------  END OF DATA FOR CHANNEL  1\n"
}

const SERIES: [f64; 11] = [
    1.0, -2.5, 3.25, 0.0, 0.5, -120.25, 0.125, 4.0, 2.0, -1.0, 0.75,
];

fn series(values: &[f64], (width, decimals): (usize, usize)) -> String {
    values
        .chunks(8)
        .map(|row| {
            row.iter()
                .map(|v| format!("{v:>width$.decimals$}"))
                .collect::<String>()
                + "\n"
        })
        .collect()
}

/// A channel of volume II with its three series.
fn v2(name: &str, format: (usize, usize), stated: &str) -> String {
    let text = [
        &format!("CORRECTED ACCELEROGRAM   99999       CHAN  1:  {name}     FROM"),
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED:  6/06/83",
        "SOME EARTHQUAKE",
        "",
        "",
        "STATION NO. 99999   35.908N, 120.458W     SMA-1",
        "A TOWN",
        &format!("CHAN  1:  {name}"),
        "RMS ACCEL OF (UNCOR) RECORD  =  .030 G.",
        "  11 POINTS OF INSTRUMENT- AND BASELINE-CORRECTED ACCEL, VELOC AND DISPL DATA",
        "AT EQUALLY-SPACED INTERVALS OF    .020  SEC.",
        "PEAK ACCELERATION =   120.250    CM/SEC/SEC  AT     .100   SEC.",
    ];
    let mut out = padded(&text, 25) + &blocks(SERIES.len(), (100, 5), 100);
    for (what, unit) in [
        ("ACCEL", "CM/SEC/SEC"),
        ("VELOC", "CM/SEC"),
        ("DISPL", "CM"),
    ] {
        out += &format!(
            " 11 POINTS OF {what} DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: {unit}){stated}\n"
        );
        out += &series(&SERIES, format);
    }
    out + "/&  ----------  END OF DATA FOR CHANNEL  1  ----------\n"
}

fn read(text: &str) -> Result<MotionFile, String> {
    read_with(text, &ReadOptions::default())
}

fn read_with(text: &str, options: &ReadOptions) -> Result<MotionFile, String> {
    parse_motions(text.as_bytes().to_vec(), "x".as_ref(), options)
        .map_err(|error| error.problems[0].to_string())
}

/// Values times their unit, as the reader multiplies: exact.
/// How many of a unit make one of another, and that in m/s²: exact numbers both, or nearest.
type Unit = (f64, f64);
const CM_S2: Unit = (100.0, 1.0);
const G: Unit = (1.0, G0_M_S2);
const TENTHS_OF_G: Unit = (10.0, G0_M_S2);

#[track_caller]
fn assert_values(file: &MotionFile, component: usize, values: &[f64], (parts, whole_m_s2): Unit) {
    let expected: Vec<f64> = values
        .iter()
        .map(|value| value / parts * whole_m_s2)
        .collect();
    assert_eq!(file.components[component].motion.accel_m_s2(), expected);
}

#[test]
fn pairs_at_uneven_times_are_straight_lines_on_their_common_step() {
    let file = read(&v1(&UNEVEN)).unwrap();
    let one = &file.components[0];
    assert_eq!(
        (file.format, one.name.as_str(), one.unit),
        ("CSMIP V1", "90 DEG", "g/10")
    );
    assert_eq!(
        (one.direction, one.station.as_deref()),
        (Some(Direction::Azimuth(90.0)), Some("A TOWN - MAIN ST"))
    );
    // 20, 35, 50, 90 and 110 ms are multiples of 5 ms.
    assert_eq!(
        (one.motion.dt_s(), one.motion.accel_m_s2().len()),
        (0.005, 23)
    );
    for (t, a) in UNEVEN {
        assert_eq!(
            one.motion.accel_m_s2()[(t / 0.005_f64).round() as usize],
            a / 10.0 * G0_M_S2,
            "a point is kept"
        );
    }
    // Halfway from 1 to -12.5; rounding of one product and one sum.
    assert!((one.motion.accel_m_s2()[2] + 5.75 * 0.1 * G0_M_S2).abs() < 1e-14);
    assert!(
        file.notes.len() == 1
            && file.notes[0]
                .to_string()
                .contains("6 points at uneven times"),
        "{:?}",
        file.notes
    );
    let asked = ReadOptions {
        uneven_dt_s: Some(0.01),
        ..ReadOptions::default()
    };
    let file = read_with(&v1(&UNEVEN), &asked).unwrap();
    assert_eq!(
        (
            file.components[0].motion.dt_s(),
            file.components[0].motion.accel_m_s2().len()
        ),
        (0.01, 12)
    );
}

#[test]
fn pairs_at_equal_times_keep_their_step() {
    let points: Vec<(f64, f64)> = (0..13)
        .map(|i| (99.95 + 0.01 * f64::from(i), f64::from(i) - 12.5))
        .collect();
    let text = v1(&points).replace("POINTS =  6", "POINTS =  13");
    assert!(text.contains("100.000 -7.500100.010"), "fields touch");
    let file = read(&text).unwrap();
    assert_eq!(
        (file.components[0].motion.dt_s(), file.notes.len()),
        (0.01, 0)
    );
    assert_values(
        &file,
        0,
        &points.iter().map(|point| point.1).collect::<Vec<_>>(),
        TENTHS_OF_G,
    );
    // Of two counts, one is right; the last value is lost with its time.
    assert!(read(&text.replace("POINTS =  13", "POINTS =  99")).is_ok());
    let cut = text
        .replace("100.070  -.500", "")
        .replace("100.070 -0.500", "");
    assert!(
        cut != text
            && read(&cut)
                .unwrap_err()
                .contains("declares 13 points, but the channel has 12")
    );
    assert!(
        read(&text.replace("-12.500", "-999.00"))
            .unwrap_err()
            .starts_with("x:28: \"-999\" marks a missing")
    );
    assert!(
        read(&text.replace(" 99.960", " 99.940"))
            .unwrap_err()
            .contains("does not increase")
    );
}

#[test]
fn a_title_line_gives_count_step_unit_and_format() {
    let values = [
        0.000011, -0.34425, 0.5, -0.25, 0.125, 0.0, 0.75, -1.0, 0.0625, 1.25,
    ];
    let head = padded(&V1_TEXT[..11], 13) + &blocks(10, (100, 5), 50);
    let title = " 10 Accelerogram points at 100 pts/sec in units of g.       Format: (8f9.6)  \n";
    let head = head.replace("POINTS =  6", "POINTS =  10");
    let text = head + title + &series(&values, (9, 6)) + "/& End of Data\n";
    let both = text.clone() + &text.replace("CHAN  1:  90 DEG", "CHAN  2: H1 (Rcrdr 2)");
    let file = read(&both).unwrap();
    assert_eq!((file.format, file.components.len()), ("CSMIP V1", 2));
    assert_eq!(
        (
            file.components[1].name.as_str(),
            file.components[1].direction
        ),
        ("H1", None)
    );
    assert_eq!(
        (file.components[1].unit, file.components[1].motion.dt_s()),
        ("g", 0.01)
    );
    assert_values(&file, 1, &values, G);
    for text in [
        text.replace("Format: (8f9.6)", ""),
        text.replace('\n', "\r\n"),
        format!("\x0C\n{text}\n\n"),
    ] {
        assert_values(&read(&text).unwrap(), 0, &values, G);
    }
    for (from, to, start, message) in [
        (" 10 Acc", " 11 Acc", "x:", "not a number"),
        (
            " 10 Acc",
            "  9 Acc",
            "x:30:",
            "has 2 values of acceleration, but should have 1",
        ),
        (
            " 10 Acc",
            "  8 Acc",
            "x:30:",
            "more values follow than the 8",
        ),
        ("units of g.", "units of cm/sec.", "x:28:", "values in cm/s"),
        ("at 100 pts/sec", "", "x:28:", "time step"),
        (" 0.500000", "-999.    ", "x:29:", "missing"),
    ] {
        let problem = read(&text.replace(from, to)).expect_err(message);
        assert!(
            problem.starts_with(start) && problem.contains(message),
            "{problem}"
        );
    }
    assert!(read(&text[..text.len() - 40]).unwrap_err().contains("x:"));
    let velocity = text.replace("HYPOCENTER: ?", "SCSN   Data: Velocity");
    assert!(read(&velocity).unwrap_err().contains("holds a velocity"));
    // Each channel left out is named by the line on which it begins; a channel has 31 lines.
    let displacement = text.replace("HYPOCENTER: ?", "SCSN   Data: Displacement");
    let found = read(&(text.clone() + &velocity + &displacement)).unwrap();
    let notes = [
        "line 32: a channel that holds a velocity was left out",
        "line 63: a channel that holds a displacement was left out",
    ];
    assert_eq!(found.components.len(), 1);
    assert_eq!(found.notes, notes);
    let cut = text.clone() + &velocity.lines().take(29).collect::<Vec<_>>().join("\n");
    assert!(
        read(&cut)
            .unwrap_err()
            .contains("the file ends after 1 of 2 lines of \"10 Accelerogram points")
    );
}

#[test]
fn of_volume_two_the_acceleration_is_read() {
    for (format, stated) in [
        ((10, 3), ""),
        ((10, 6), "  (8F10.6)"),
        ((10, 5), "  Format=(8F10.5)"),
    ] {
        let text = v2("UP", format, stated) + &v2("UP", format, stated).replace("  UP", "  H2");
        let file = read(&text).unwrap();
        assert_eq!((file.format, file.notes.len()), ("CSMIP V2", 0));
        let names: Vec<&str> = file
            .components
            .iter()
            .map(|one| one.name.as_str())
            .collect();
        assert_eq!(
            (names, file.components[0].motion.dt_s()),
            (vec!["UP", "H2"], 0.02)
        );
        assert_values(&file, 1, &SERIES, CM_S2);
    }
    // As it is printed today.
    let today = v2("UP", (10, 6), "")
        .to_lowercase()
        .replace(" sec.  (units: cm/sec/sec)", " sec, in cm/sec2. (8f10.6)");
    assert!(today.contains("in cm/sec2. (8f10.6)"));
    assert_values(&read(&today).unwrap(), 0, &SERIES, CM_S2);
    let text = v2("UP", (10, 3), "");
    let (start, tail) = text.split_once(" 11 POINTS OF ACCEL").unwrap();
    let (_, tail) = tail.split_once(" 11 POINTS OF VELOC").unwrap();
    let velocity_first = format!("{start} 11 POINTS OF VELOC{tail}");
    assert!(
        read(&velocity_first)
            .unwrap_err()
            .contains("an acceleration record is expected")
    );
    let other_peak = read(&text.replace("=   120.250", "=  -130.000")).unwrap();
    assert!(
        other_peak.notes[0]
            .to_string()
            .contains("header states a peak")
    );
    // A second channel that is damaged or cut off is not lost in silence.
    let damaged = text.clone() + &text.replace(" 11 POINTS OF ACCEL", " xx POINTS OF ACCEL");
    assert!(read(&damaged).unwrap_err().contains("the channel has 0"));
    let lines_of_header = text
        .lines()
        .take_while(|line| !line.contains("POINTS OF ACCEL DATA"))
        .count();
    // Three lines a series, its title among them: after the accelerations, and within velocities
    // and displacements.
    for (lines, message) in [
        (4, "lines of \"11 POINTS OF VELOC"),
        (7, "lines of \"11 POINTS OF DISPL"),
    ] {
        let head: Vec<&str> = text.lines().take(lines_of_header + lines).collect();
        assert!(
            read(&head.join("\n")).unwrap_err().contains(message),
            "cut {lines} lines after the header"
        );
    }
    for lines in [10, 30, 40, 46, 47] {
        let head: String = text
            .lines()
            .take(lines)
            .map(|line| format!("{line}\n"))
            .collect();
        assert!(
            read(&(text.clone() + &head)).unwrap_err().starts_with("x:"),
            "cut after {lines} lines"
        );
    }
    assert!(
        read(&format!("RESPONSE AND FOURIER AMPLITUDE SPECTRA\n{text}"))
            .unwrap_err()
            .contains("spectra")
    );
}

/// Without an end mark, and under a title that does not say accelerogram, a channel is a channel
/// still.
#[test]
fn no_channel_is_lost_in_silence() {
    let whole = v2("UP", (10, 3), "");
    let (text, _) = whole.split_once("/&").unwrap();
    let lines = text.lines().count();
    let alien = text
        .replace("CORRECTED ACCELEROGRAM  ", "CORRECTED RECORD")
        .replace("UNCORRECTED ACCELEROGRAM", "RAW");
    assert!(!alien.contains("ACCELEROGRAM"));
    for between in ["", "/&\n", "\n\n"] {
        let found = read(&format!("{text}{between}{alien}")).unwrap();
        assert_eq!(
            (found.components.len(), found.notes.len()),
            (2, 1),
            "{between:?}"
        );
        assert!(
            found.notes[0]
                .to_string()
                .contains("does not end with a line \"/&\""),
            "{:?}",
            found.notes
        );
        assert_values(&found, 1, &SERIES, CM_S2);
    }
    for end in ["", "/&\n"] {
        // Text alone holds no channel, however long it is.
        let first = lines + 1 + end.lines().count();
        for count in [1, 100] {
            let found = read(&format!("{text}{end}{}", "A REMARK\n".repeat(count))).unwrap();
            let note = format!("line {first}: the text after the last channel was ignored");
            assert!(
                found.components.len() == 1 && found.notes[0] == note.as_str(),
                "{end:?}"
            );
            // The mark is not looked for after a hundred lines.
            assert_eq!(
                found.notes.len(),
                if end.is_empty() || count == 100 { 2 } else { 1 },
                "{:?}",
                found.notes
            );
        }
        // More text than any header has, and a channel after it; numbers after no title line.
        let integers = alien
            .lines()
            .position(|line| line.starts_with("    1    2"))
            .unwrap();
        for (tail, at) in [
            ("A REMARK\n".repeat(100) + &alien, first + 100 + integers),
            ("   1.000   2.000\n".to_owned(), first),
            ("A REMARK\n 1.000-2.000\n".to_owned(), first + 1),
            (blocks(11, (100, 5), 100), first),
        ] {
            let problem = read(&format!("{text}{end}{tail}")).unwrap_err();
            assert_eq!(
                problem,
                format!("x:{at}: no line states what these numbers are"),
                "{end:?}"
            );
        }
    }
}

#[test]
fn usc_counts_characters_behind_its_text_and_wraps_it() {
    let first = "CORRECTED ACCELEROGRAM  IIBB127  94.610.0 COMP N08W   FILE   0  CORRESPONDING T";
    let numbered = |text: &str| format!("{text:<72}{}", text.len());
    let mut text = vec![
        first.to_owned(),
        "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:".to_owned(),
    ];
    text.extend(
        [
            "SOME EARTHQUAKE",
            "JAN 17, 1994",
            "IBB127",
            "STATION USC# 0061   34 17 11N, 118 13 31W",
            "A STATION, CA",
        ]
        .map(numbered),
    );
    text.extend(
        [
            "COMP N08W",
            "SOME EARTHQUAKE",
            "EPICENTER",
            "INSTR PERIOD =  .039 SEC",
        ]
        .map(numbered),
    );
    text.extend(
        [
            "NO. OF POINTS =   8820      DURATION =    .210 SEC",
            "UNITS ARE SEC AND G/10",
        ]
        .map(numbered),
    );
    text.push("PEAK ACCELERATION =  -120.25000  CMS/SEC/SEC AT     .100   SEC.".to_owned());
    let head =
        text.join("\n") + "\n" + &"MORE\n".repeat(10) + "IIBB127  A STATION, CA    COMP N08\nW\n";
    let mut file = head.clone() + &blocks(11, (100, 5), 100);
    for (what, unit) in [("ACC", "CM/SEC/SEC"), ("VEL", "CM/SEC"), ("DIS", "CM")] {
        file += &format!(
            "    11 POINTS OF {what} DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS {unit}\n"
        );
        file += &series(&SERIES, (10, 3));
    }
    let found = read(&file).unwrap();
    let one = &found.components[0];
    assert_eq!(
        (found.format, one.name.as_str(), one.unit),
        ("USC V2", "N08W", "cm/s2")
    );
    assert_eq!(one.station.as_deref(), Some("A STATION, CA"));
    // The header's peak has the other sign.
    assert_eq!((one.motion.dt_s(), found.notes.len()), (0.02, 0));
    assert_values(&found, 0, &SERIES, CM_S2);

    let head = text[2..13]
        .iter()
        .map(|line| format!("{line}\n"))
        .collect::<String>()
        .replace("8820", "   6");
    let head = format!("FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\n{head}");
    for integers in [(100, 5), (100, 4)] {
        for lead in ["", " "] {
            let rows = pairs(&UNEVEN)
                .lines()
                .map(|row| format!("{lead}{row}\n"))
                .collect::<String>();
            let found =
                read(&(head.clone() + &blocks(6, integers, 50) + &rows + "/& END\n")).unwrap();
            let one = &found.components[0];
            assert_eq!(
                (found.format, one.name.as_str(), one.unit),
                ("USC V1", "N08W", "g/10")
            );
            assert_eq!(
                (one.motion.dt_s(), one.motion.accel_m_s2().len()),
                (0.005, 23)
            );
            assert_eq!(one.motion.accel_m_s2()[4], -12.5 / 10.0 * G0_M_S2);
        }
    }
}

#[test]
fn renadic_is_volume_one_in_latin_letters() {
    let points: Vec<(f64, f64)> = (0..6)
        .map(|i| (0.01 * f64::from(i), f64::from(i) - 2.5))
        .collect();
    let text = v1(&points)
        .replace(
            "A TOWN - MAIN ST                 CSMIP",
            "VINA DEL MAR CENTRO S/N 675",
        )
        .replace(
            "\nSOME EARTHQUAKE\nHYPO",
            "\nUNIVERSIDAD DE CHILE - RENADIC\nHYPO",
        )
        .replace("CHAN  1:  90 DEG", "CHAN  1: EW")
        .replace("34.000N, 118.000W", "0.000S, 0.000W");
    let mut bytes = text.into_bytes();
    let at = bytes.windows(4).position(|four| four == b"VINA").unwrap();
    bytes[at + 2] = 0xD1;
    let three = [bytes.clone(), bytes.clone(), bytes].concat();
    let file = parse_motions(three, "x".as_ref(), &ReadOptions::default()).unwrap();
    assert_eq!((file.format, file.components.len()), ("RENADIC", 3));
    assert_eq!(
        file.components[2].station.as_deref(),
        Some("VI\u{d1}A DEL MAR CENTRO")
    );
    assert_eq!(
        (
            file.components[1].name.as_str(),
            file.components[1].direction
        ),
        ("EW, channel 2", Some(Direction::Azimuth(90.0)))
    );
    assert_eq!(file.components[1].motion.dt_s(), 0.01);
    assert_values(
        &file,
        1,
        &points.iter().map(|point| point.1).collect::<Vec<_>>(),
        TENTHS_OF_G,
    );
}

#[test]
#[ignore = "seconds: hundreds of damaged files"]
fn damaged_files_are_read_or_refused() {
    for text in [v1(&UNEVEN), v2("UP", (10, 3), "")] {
        // Behind the first digits of the last acceleration a record is whole, whatever else is
        // lost.
        let last_value = text
            .find(" 11 POINTS OF VELOC")
            .or_else(|| text.find("/&"))
            .unwrap()
            - 8;
        for at in (0..text.len()).step_by(5) {
            for byte in *b"-9x\n /" {
                let mut bytes = text.clone().into_bytes();
                bytes[at] = byte;
                let read =
                    |bytes: Vec<u8>| parse_motions(bytes, "x".as_ref(), &ReadOptions::default());
                if let Ok(file) = read(bytes.clone()) {
                    assert!(
                        file.components.iter().all(|one| one
                            .motion
                            .accel_m_s2()
                            .iter()
                            .all(|a| a.is_finite()))
                    );
                }
                bytes.truncate(at);
                assert!(at >= last_value || read(bytes).is_err(), "cut at {at}");
            }
        }
    }
}

/// A header that contradicts the values, or a file without its last channels, is said.
#[test]
fn what_the_header_states_is_compared() {
    let values: Vec<f64> = (0..40).map(|i| f64::from(i % 7 - 3) * 0.125).collect();
    let head = padded(&V1_TEXT[..11], 13) + &blocks(40, (100, 5), 50);
    let title = " 40 Accelerogram points at 100 pts/sec in units of g.       Format: (8f9.6)  \n";
    let stated = "POINTS =  40  RECORD LENGTH =  .390 SEC   AT 100 SAMPLES/SEC";
    let head = head
        .replace("POINTS =  6  RECORD LENGTH =  .110 SEC", stated)
        .replace("S/N 0001", "S/N 1 (2 CHNS OF  3 AT STA)");
    let one = head + title + &series(&values, (9, 6)) + "/& End of Data\n";
    let text = one.clone() + &one;
    assert_eq!(read(&text).unwrap().notes, [""; 0]);
    for (from, to, note) in [
        (
            one.as_str(),
            "",
            "the header states 2 channels, but the file has 1: it may be cut off",
        ),
        (
            "POINTS =  40",
            "POINTS =  44",
            "90 DEG: line 28 declares 40 values, but the header declares 44",
        ),
        (
            "AT 100 SAMPLES",
            "AT 200 SAMPLES",
            "90 DEG: the time step is 0.01 s above the values, but 0.005 s in the header",
        ),
        (
            ".390 SEC",
            ".195 SEC",
            "90 DEG: 40 values at 0.01 s last 0.40 s, but the header states 0.20 s: the step may be wrong",
        ),
    ] {
        assert_eq!(read(&text.replacen(from, to, 1)).unwrap().notes, [note]);
    }
    let cut = text.strip_suffix("/& End of Data\n").unwrap();
    assert_eq!(
        read(cut).unwrap().notes,
        ["the last channel does not end with a line \"/&\": the file may be cut off"]
    );
    let two = v2("UP", (10, 3), "").replace("  11 POINTS OF INSTR", "  12 POINTS OF INSTR");
    assert_eq!(
        read(&two).unwrap().notes,
        ["UP: line 46 declares 11 values, but the header declares 12"]
    );
}

/// Found by fuzzing: the problem was on line 0.
#[test]
fn a_channel_without_samples_below_blank_lines_has_a_line() {
    let bytes = b"\n\n\t\r\r99999999999999999999999999999999999999999999999999999999999999\r\r\r\xdc\r\r\r\r\
          \r?R\x0c\x0c\r\x0c\x0c0\x0c\x0c\x0c\n&#i\x1a&\"\x0c\x0c\x0c&\"\x0c\x0c\x0c\x0c\x0ck\xf5\
          \xdb@/\xf7\xf6\xf6\xfa\t\t\t\t\t\xf7\xfd\t\x89RENADIC\t\t\t\t\t\r\r999999999999999999999\
          \x0c\x0c\x0cC\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c\x0c";
    let error = parse_motions(bytes.to_vec(), "x".as_ref(), &ReadOptions::default()).unwrap_err();
    let found: Vec<_> = error
        .problems
        .iter()
        .map(|one| (one.line, one.message.as_str()))
        .collect();
    assert_eq!(
        found,
        [(
            Some(1),
            "the header declares no points, but the channel has 0"
        )]
    );
}
