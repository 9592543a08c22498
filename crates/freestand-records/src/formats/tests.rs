use std::sync::LazyLock;

use super::*;
use freestand::motion::Motion;
use proptest::prelude::*;

fn three() -> MotionFile {
    let text = b"t[s],NS[g],EW[g],360[g]\n0,1,2,3\n1,4,5,6\n".to_vec();
    parse_motions(text, "x.csv".as_ref(), &ReadOptions::default()).unwrap()
}

#[test]
fn a_file_without_components_is_refused() {
    let reading = Reading {
        format: "columns",
        components: Vec::new(),
        notes: Vec::new(),
    };
    let problem = reading.with_components().err().unwrap();
    assert!(
        problem.message == "holds no acceleration record" && problem.hint.is_some(),
        "{problem}"
    );
    let reading = Reading {
        format: "columns",
        components: three().components,
        notes: Vec::new(),
    };
    assert_eq!(reading.with_components().unwrap().components.len(), 3);
}

#[test]
fn components_are_chosen_by_name_or_number() {
    let file = three();
    for (wanted, name) in [
        ("NS", "NS"),
        ("ew", "EW"),
        ("2", "EW"),
        ("360", "360"),
        ("3", "360"),
        (" EW [g] ", "EW"),
    ] {
        assert_eq!(file.select(Some(wanted)).unwrap().name, name, "{wanted}");
    }
    for wanted in ["UP", "0", "4", "", "-1", "["] {
        let problem = file.select(Some(wanted)).unwrap_err();
        assert!(problem.message.contains("1 NS, 2 EW, 3 360"), "{problem}");
    }
    let problem = file.select(None).unwrap_err();
    assert_eq!(problem.message, "has 3 components: 1 NS, 2 EW, 3 360");
    assert!(problem.hint.unwrap().contains("`component`"));
    let mut one = file;
    one.components.truncate(1);
    assert_eq!(one.select(None).unwrap().name, "NS");
}

#[test]
fn two_of_one_name_are_told_apart_by_number() {
    let mut file = three();
    file.components[1].name = "NS".to_owned();
    assert!(
        file.select(Some("ns"))
            .unwrap_err()
            .message
            .contains("several")
    );
    assert_eq!(
        file.select(Some("2")).unwrap().motion.accel_m_s2()[0],
        file.components[1].motion.accel_m_s2()[0]
    );
}

#[test]
fn what_is_no_file_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let problem = |name: &str| {
        read_motions(&folder.path().join(name), &ReadOptions::default())
            .unwrap_err()
            .problems
            .remove(0)
    };
    assert!(problem("absent.at2").message.contains("cannot open"));
    assert!(problem("").message.contains("is a folder"));
    std::fs::write(folder.path().join("empty"), "").unwrap();
    assert!(problem("empty").message.contains("empty"));
    std::fs::write(folder.path().join("binary"), [0u8; 700]).unwrap();
    let found = problem("binary");
    assert!(found.message.contains("binary") && found.path.is_some() && found.hint.is_some());
}

#[test]
fn a_sensitivity_without_effect_is_refused_by_every_format() {
    let sensitivity = Some(parse_sensitivity("10 mV/g").unwrap());
    let options = ReadOptions {
        sensitivity,
        is_shock: true,
        ..ReadOptions::default()
    };
    let accel_m_s2 = (0..40).map(|i| (f64::from(i) * 0.3).sin()).collect();
    let at2 = write_at2(&Motion::new(0.01, accel_m_s2).unwrap(), "x");
    for text in [at2.as_str(), "t [s],a [g]\n0,1\n1,4\n"] {
        let problem = parse_motions(text.into(), "x".as_ref(), &options)
            .unwrap_err()
            .problems
            .remove(0);
        assert!(
            problem.message.contains("is not in volts") && problem.hint.is_some(),
            "{problem}"
        );
    }
}

static SAMPLES: LazyLock<[Vec<u8>; 10]> = LazyLock::new(|| {
    let accel = (0..40).map(|i| (f64::from(i) * 0.3).sin()).collect();
    let motion = Motion::new(0.02, accel).unwrap();
    [
        write_at2(&motion, "Somewhere, 1/1/2000, Station, 090").into_bytes(),
        write_csv(&motion).into_bytes(),
        write_csv(&motion)
            .replace(',', ";")
            .replace('.', ",")
            .into_bytes(),
        b"# units=g dt=0.01\n 1.0E-01-2.0D-01 3.0-003\n-.1 -.2 -.3\n".to_vec(),
        b"3 0.02\n1\n2\n3\n".to_vec(),
        geonet::tests::sample(),
        bhrc::tests::sample(),
        dyna::tests::sample(),
        nsmn::tests::sample(),
        sigma::tests::sample(),
    ]
});

/// Whatever a file is, it is read or refused with a message of one line, and what is read is
/// finite.
fn survives(bytes: Vec<u8>) -> Result<(), TestCaseError> {
    let given = ReadOptions {
        unit: Some("g".to_owned()),
        dt_s: Some(0.01),
        ..ReadOptions::default()
    };
    let resampled = ReadOptions {
        unit: Some("g".to_owned()),
        uneven_dt_s: Some(0.01),
        ..ReadOptions::default()
    };
    for options in [ReadOptions::default(), given, resampled] {
        match parse_motions(bytes.clone(), "x".as_ref(), &options) {
            Ok(file) => {
                prop_assert!(!file.components.is_empty());
                for component in &file.components {
                    prop_assert!(component.motion.accel_m_s2().iter().all(|a| a.is_finite()));
                    prop_assert!(component.line_of_first_value > 0);
                }
            }
            Err(error) => {
                prop_assert!(!error.problems[0].message.contains(['\n', '\r']), "{error}")
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    #[ignore = "seconds: hundreds of damaged files"]
    fn damaged_files_are_read_or_refused(
        which in 0..10usize,
        cut in 0.0..1.0f64,
        damage in prop::collection::vec((0.0..1.0f64, any::<u8>()), 0..6),
        characters in prop::collection::vec((0.0..1.0f64, prop::sample::select(b"+-.eEdD0 9,;\t\n\r#\"[(NPTS=\xff\xc3".to_vec())), 0..6),
    ) {
        let mut bytes = SAMPLES[which].clone();
        if cut > 0.3 {
            bytes.truncate((cut * bytes.len() as f64) as usize);
        }
        for (at, byte) in damage.into_iter().chain(characters) {
            let at = (at * bytes.len() as f64) as usize;
            if let Some(target) = bytes.get_mut(at) {
                *target = byte;
            }
        }
        survives(bytes)?;
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        survives(bytes)?;
    }

    #[test]
    #[ignore = "seconds: files at random"]
    fn any_numbers_and_separators_are_read_or_refused(text in "([-+]?[0-9]{0,3}\\.?[0-9]{0,3}([eEdD]?[-+][0-9]{1,3})?[ ,;\t\n]){0,30}") {
        survives(text.into_bytes())?;
    }
}

/// Every agency's title may be above a table from another source.
#[test]
fn a_title_alone_makes_no_agency_s_file() {
    let titles = [
        "UNCORRECTED ACCELEROGRAM DATA",
        "CORRECTED ACCELEROGRAM",
        "STRONG GROUND MOTION RECORDS OF TURKIYE",
        "ARCHIVO ESTANDAR DE ACELERACION",
        "UNIVERSIDAD DE CHILE - RENADIC",
        "Earthquake Information",
        "VOL1DS FILE",
        "EVENT_NAME: somewhere",
        "Event Date & Time (UTC): yesterday",
        "Origin Time 2018/01/24 19:51:00",
        "1 UNCORRECTED ACCELEROGRAM",
        "Uncorrected accelerogram of GNS Science",
        "FILE 0 OF UNCORRECTED ACCELEROGRAM DATA OF IIA001",
    ];
    for title in titles {
        for mark in ["# ", ""] {
            let table = format!("{mark}{title}\ntime [s],a [g]\n0,1\n0.01,2\n0.02,3\n");
            let file = parse_motions(table.into_bytes(), "x".as_ref(), &ReadOptions::default());
            let file = file.unwrap_or_else(|error| panic!("{mark}{title}: {error}"));
            assert_eq!(
                (file.format, file.components[0].motion.accel_m_s2().len()),
                ("CSV", 3),
                "{mark}{title}"
            );
            let at2 = format!(
                "{mark}PEER STRONG MOTION DATABASE, {title}\nA, 1/1/2000, B, 090\nUNITS OF G\nNPTS= 2, DT= .02\n1 2\n"
            );
            let file = parse_motions(at2.into_bytes(), "x".as_ref(), &ReadOptions::default());
            assert_eq!(
                file.unwrap_or_else(|error| panic!("{mark}{title}: {error}"))
                    .format,
                "PEER AT2",
                "{title}"
            );
        }
    }
}

/// Hundreds of g are noted of a floor and not of a shock; the other notes stay.
#[test]
fn a_shock_may_be_beyond_a_floor() {
    let notes = |is_shock: bool| {
        let options = ReadOptions {
            is_shock,
            station_xml: Some("x.xml".into()),
            ..ReadOptions::default()
        };
        let text = "time [s],a [g]\n0,0\n0.01,300\n0.02,0\n".to_owned();
        parse_motions(text.into_bytes(), "x.csv".as_ref(), &options)
            .unwrap()
            .notes
    };
    let (floor, shock) = (notes(false), notes(true));
    assert!(
        floor[0].to_string().contains("value 2 is 300.0 g")
            && floor[1..] == shock[..]
            && shock.len() == 1,
        "{floor:?} {shock:?}"
    );
}
