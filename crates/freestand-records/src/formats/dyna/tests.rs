use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};

const VALUES: [f64; 5] = [0.0, -0.000123, 1.5, -2.25, 0.000001];

/// A file as ESM writes it, with the keys that matter and some that only get in the way.
fn file() -> String {
    let mut text = String::from(
        "EVENT_NAME: A TOWN\nEVENT_ID: EMSC-1\nEVENT_DATE_YYYYMMDD: 20190728\nEVENT_TIME_HHMMSS: 160908\nMAGNITUDE_W: \
         \nNETWORK: HI\nSTATION_CODE: ABC1\nSTATION_NAME: Town Hall,A: Town\nLOCATION: \nVS30_M/S: \n\
         DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20190728_160919.870\nSAMPLING_INTERVAL_S: 0.005000\nNDATA: 5\n\
         DURATION_S: 0.025\nSTREAM: HNE\nUNITS: cm/s^2\nINSTRUMENT: sensor = X | digitizer = Y\nPGA_CM/S^2: 2.250000\n\
         BASELINE_CORRECTION: BASELINE REMOVED\nHEADER_FORMAT: DYNA 1.2\nDATA_TYPE: ACCELERATION\n\
         ORIGINAL_DATA_MEDIATOR: http://example.org/\nUSER1: filter --le 0.1\nUSER5: \n",
    );
    for value in VALUES {
        text.push_str(&format!("{value:.6}\n"));
    }
    text
}

pub(crate) fn sample() -> Vec<u8> {
    file().into_bytes()
}

fn read_with(text: &str, options: &ReadOptions) -> Result<MotionFile, String> {
    parse_motions(text.as_bytes().to_vec(), "x.asc".as_ref(), options)
        .map_err(|error| error.problems[0].to_string())
}

fn read(text: &str) -> Result<MotionFile, String> {
    read_with(text, &ReadOptions::default())
}

fn expected() -> Vec<f64> {
    VALUES.iter().map(|v| v / 100.0).collect()
}

#[test]
fn esm_and_afad() {
    let afad = file()
        .replace(
            "EVENT_DATE_YYYYMMDD: 20190728",
            "EVENT_DATE_YYYYMMDD: 2019/07/28",
        )
        .replace("20190728_160919.870", "28/07/2019 16:09:19.870")
        .replace("DURATION_S: 0.025", "DURATION_S: ")
        .replace("ACCELERATION\n", "Acceleration\n")
        .replace("MEDIATOR: http", "MEDIATOR: : http");
    for text in [
        file(),
        afad,
        file().to_lowercase().replace("hne", "HNE"),
        format!("\n{}\n\n", file()),
    ] {
        for ending in ["\n", "\r\n", "\r", "\r\r\n"] {
            let found = read(&text.replace('\n', ending)).unwrap();
            let one = &found.components[0];
            assert_eq!(
                (found.format, one.name.as_str(), one.unit),
                ("DYNA", "HNE", "cm/s2")
            );
            assert_eq!(
                (one.direction, one.motion.dt_s()),
                (Some(Direction::Azimuth(90.0)), 0.005)
            );
            // Exact: the printed decimals are the values.
            assert_eq!(one.motion.accel_m_s2(), expected());
            assert_eq!(found.notes, [""; 0]);
        }
    }
    let found = read(&file()).unwrap();
    assert_eq!(
        found.components[0].station.as_deref(),
        Some("HI.ABC1 Town Hall,A: Town")
    );
    assert_eq!(found.components[0].line_of_first_value, 25);
}

#[test]
fn what_a_header_leaves_open() {
    // The first key may be another; Latin-5 letters are not a reason to refuse.
    let mut bytes = file()
        .replacen("EVENT_NAME: A TOWN\n", "", 1)
        .replace("Town Hall", "K#Y")
        .into_bytes();
    bytes
        .iter_mut()
        .filter(|byte| **byte == b'#')
        .for_each(|byte| *byte = 0xD6);
    let found = parse_motions(bytes, "x.asc".as_ref(), &ReadOptions::default()).unwrap();
    assert_eq!(
        found.components[0].station.as_deref(),
        Some("HI.ABC1 KÖY,A: Town")
    );
    // ITACA's first files name the component, and count west to east.
    let found = read(&file().replace("STREAM: HNE", "COMPONENT: WE")).unwrap();
    assert_eq!(
        (
            found.components[0].name.as_str(),
            found.components[0].direction
        ),
        ("WE", Some(Direction::Azimuth(90.0)))
    );
    let found = read(
        &file()
            .replace("STREAM: HNE\n", "")
            .replace("NDATA: 5", "NDATA: "),
    )
    .unwrap();
    assert_eq!(
        (found.components[0].name.as_str(), found.notes.len()),
        ("x", 1)
    );
    let found = read(&file().replace("BASELINE REMOVED", "BASELINE NOT REMOVED")).unwrap();
    assert!(found.notes[0].to_string().contains("offset"));
    let found = read(&file().replace("S^2: 2.250000", "S^2: 4.000000")).unwrap();
    assert!(found.notes[0].to_string().contains("header states a peak"));
    // Step and unit may come from the user.
    let options = ReadOptions {
        unit: Some("cm/s2".to_owned()),
        dt_s: Some(0.005),
        ..ReadOptions::default()
    };
    let bare = file()
        .replace("SAMPLING_INTERVAL_S: 0.005000", "SAMPLING_INTERVAL_S: ")
        .replace("UNITS: cm/s^2\n", "");
    assert_eq!(
        read_with(&bare, &options).unwrap().components[0]
            .motion
            .accel_m_s2(),
        expected()
    );
    assert_eq!(
        read_with(&file(), &options).unwrap().components[0]
            .motion
            .accel_m_s2(),
        expected()
    );
}

#[test]
fn what_is_refused() {
    for (from, to, message) in [
        (
            "DATA_TYPE: ACCELERATION",
            "DATA_TYPE: VELOCITY",
            "x.asc:21: holds \"VELOCITY\"",
        ),
        (
            "DATA_TYPE: ACCELERATION",
            "DATA_TYPE: DISPLACEMENT",
            "x.asc:21: holds",
        ),
        (
            "DATA_TYPE: ACCELERATION",
            "DATA_TYPE: ACCELERATION RESPONSE SPECTRUM",
            "x.asc:21: holds",
        ),
        (
            "UNITS: cm/s^2",
            "UNITS: cm/s",
            "x.asc:16: the record is a velocity",
        ),
        (
            "UNITS: cm/s^2",
            "UNITS: counts",
            "x.asc:16: the unit \"counts\" is not known",
        ),
        (
            "UNITS: cm/s^2",
            "UNITS: ",
            "the unit of the record is not stated",
        ),
        (
            "NDATA: 5",
            "NDATA: 6",
            "x.asc:13: the header declares 6 values, but the file has 5",
        ),
        ("NDATA: 5", "NDATA: 5.5", "x.asc:13: NDATA is \"5.5\""),
        (
            "SAMPLING_INTERVAL_S: 0.005000",
            "SAMPLING_INTERVAL_S: 0",
            "x.asc:12: the time step must be positive",
        ),
        (
            "SAMPLING_INTERVAL_S: 0.005000",
            "SAMPLING_INTERVAL_S: ",
            "the header has no time step",
        ),
        (
            "1.500000",
            "-999",
            "x.asc:27: \"-999\" marks a missing value",
        ),
        ("1.500000", "1.5OOO", "x.asc:27: "),
        (
            "1.500000",
            "0.01 1.500000",
            "x.asc:27: a row must have 1 value, but this one has 2",
        ),
    ] {
        let problem = read(&file().replacen(from, to, 1)).expect_err(message);
        assert!(problem.contains(message), "{problem}");
    }
    let options = ReadOptions {
        unit: Some("g".to_owned()),
        ..ReadOptions::default()
    };
    assert!(
        read_with(&file(), &options)
            .unwrap_err()
            .contains("is in cm/s2 according to the file, not in g")
    );
}

#[test]
fn a_duration_that_contradicts_the_step_is_said() {
    let notes = read(&file().replace("DURATION_S: 0.025", "DURATION_S: 0.050"))
        .unwrap()
        .notes;
    assert_eq!(
        notes,
        [
            "HNE: 5 values at 0.005 s last 0.03 s, but the header states 0.05 s: the step may be wrong"
        ]
    );
}
