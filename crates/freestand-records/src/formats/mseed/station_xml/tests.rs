use super::*;
use crate::formats::mseed::fixture::mseed_record;
use crate::formats::{MotionFile, parse_motions};

/// A description with one channel an entry: code, location, epoch, azimuth and dip, what stands in
/// `Response`.
fn xml(channels: &[(&str, &str, &str, &str, &str)]) -> String {
    let mut out = String::from(
        "<?xml version='1.0' encoding='UTF-8'?>\n<FDSNStationXML xmlns=\"http://www.fdsn.org/xml/station/1\" \
         schemaVersion=\"1.2\">\n<Source>me</Source>\n<Network code=\"XX\">\n<Station code=\"ABC\" \
         startDate=\"1990-01-01\">\n",
    );
    for (code, location, epoch, direction, response) in channels {
        let (azimuth, dip) = direction.split_once(' ').unwrap();
        out.push_str(&format!(
            "<Channel code=\"{code}\" locationCode=\"{location}\" {epoch}>\n<Azimuth \
             unit=\"DEGREES\">{azimuth}</Azimuth><Dip>{dip}</Dip>\n<Response>{response}</Response>\n</Channel>\n"
        ));
    }
    out + "</Station>\n</Network>\n</FDSNStationXML>\n"
}

fn sensitivity(value: &str, frequency: &str, input: &str, output: &str) -> String {
    let unit = |name: &str| format!("<Name>{name}</Name><Description>units</Description>");
    let (input, output) = (unit(input), unit(output));
    // The gain of a stage must not be taken for that of the whole.
    format!(
        "<InstrumentSensitivity><Value>{value}</Value><Frequency>{frequency}</Frequency>\
        <InputUnits>{input}</InputUnits><OutputUnits>{output}</OutputUnits></InstrumentSensitivity>\
        <Stage number=\"1\"><StageGain><Value>3.5</Value><Frequency>1</Frequency></StageGain></Stage>\
        <Stage number=\"2\"><StageGain><Value>7</Value><Frequency>1</Frequency></StageGain></Stage>"
    )
}

fn source(channel: &str, location: &str) -> Source {
    let [network, station, location, channel] = ["XX", "ABC", location, channel].map(str::to_owned);
    Source {
        network,
        station,
        location,
        channel,
    }
}

fn at(text: &str) -> Instant {
    Instant::parse(text).unwrap()
}

fn scaling(text: &str, channel: &str, location: &str, start: &str) -> Result<Scaling, Problem> {
    let inventory = Inventory::parse(text.as_bytes(), "XX.ABC.xml".as_ref())?;
    match inventory.scaling(
        &source(channel, location),
        at(start),
        at(start).later_by_s(60.0),
    )? {
        Sensed::Acceleration(scaling) => Ok(scaling),
        Sensed::Other(problem) => Err(problem),
    }
}

#[test]
fn every_spelling_of_an_acceleration_is_taken() {
    for (unit, counts_per_m_s2) in [
        ("M/S**2", 2000.0),
        ("m/s**2", 2000.0),
        ("m/s^2", 2000.0),
        ("M/S2", 2000.0),
        ("m/s/s", 2000.0),
        ("CM/S**2", 2e5),
    ] {
        let text = xml(&[(
            "HNE",
            "",
            "",
            "90.0 0.0",
            &sensitivity("2000", "1.0", unit, "COUNTS"),
        )]);
        let found = scaling(&text, "HNE", "", "2020-01-01").unwrap();
        assert_eq!(
            (found.counts_per_m_s2, found.direction),
            (counts_per_m_s2, Some(Direction::Azimuth(90.0))),
            "{unit}"
        );
        assert!(
            found.notes[0].to_string().contains("XX.ABC.xml")
                && found.notes[0].to_string().contains("is not removed"),
            "{:?}",
            found.notes
        );
    }
}

/// At 2 Hz a displacement of 1 m is an acceleration of (4 pi)^2 m/s2: 157.91 counts/m are 1
/// count/(m/s2).
#[test]
fn an_accelerometer_may_be_described_by_displacement() {
    let value = (4.0 * std::f64::consts::PI).powi(2) * 2000.0;
    let text = xml(&[(
        "HNE",
        "",
        "",
        "90 0",
        &sensitivity(&value.to_string(), "2.0", "M", "counts"),
    )]);
    let found = scaling(&text, "HNE", "", "2020-01-01").unwrap();
    // Three roundings.
    assert!((found.counts_per_m_s2 - 2000.0).abs() < 4.0 * f64::EPSILON * 2000.0);
    assert!(
        found.notes[0].to_string().contains("(2 pi f)^2"),
        "{:?}",
        found.notes
    );
    for (channel, frequency, message) in [
        ("HNE", "0", "frequency is missing"),
        ("BHZ", "2", "an accelerometer is expected"),
    ] {
        let text = xml(&[(
            channel,
            "",
            "",
            "90 0",
            &sensitivity("1e9", frequency, "M", "counts"),
        )]);
        let problem = scaling(&text, channel, "", "2020-01-01").unwrap_err();
        assert!(problem.message.contains(message), "{problem}");
    }
}

#[test]
fn what_is_no_acceleration_is_refused_with_its_line() {
    for (response, message) in [
        (
            sensitivity("1e9", "1", "M/S", "COUNTS"),
            "measures a velocity (M/S)",
        ),
        (
            sensitivity("1e9", "1", "nm/s", "COUNTS"),
            "measures \"nm/s\"",
        ),
        (sensitivity("1e9", "1", "PA", "COUNTS"), "measures \"PA\""),
        (
            sensitivity("1e9", "1", "M/S**2", "V"),
            "is of \"V\", not of counts",
        ),
        (sensitivity("0", "1", "M/S**2", "COUNTS"), "has no value"),
        (sensitivity("much", "1", "M/S**2", "COUNTS"), "has no value"),
        (String::new(), "no InstrumentSensitivity"),
        (
            "<InstrumentPolynomial/>".to_owned(),
            "a polynomial response",
        ),
    ] {
        let text = xml(&[
            ("HNN", "", "", "0 0", ""),
            ("HNE", "", "", "90 0", &response),
        ]);
        let problem = scaling(&text, "HNE", "", "2020-01-01").unwrap_err();
        assert!(
            problem
                .to_string()
                .starts_with("XX.ABC.xml:10: XX.ABC..HNE: "),
            "{problem}"
        );
        assert!(
            problem.message.contains(message) && problem.hint.is_some(),
            "{problem}"
        );
    }
}

#[test]
fn epochs_and_locations_choose_the_channel() {
    let (old, new) = (
        sensitivity("1000", "1", "M/S**2", "COUNTS"),
        sensitivity("3000", "1", "M/S**2", "COUNTS"),
    );
    let (early, late) = (
        "startDate=\"2010-01-01T00:00:00Z\" endDate=\"2015-06-01T12:00:00.5Z\"",
        "startDate=\"2015-06-01T12:00:00.5Z\" endDate=\"3000-01-01T00:00:00\"",
    );
    let text = xml(&[
        (
            "HNE",
            "10",
            "",
            "0 0",
            &sensitivity("5", "1", "M/S**2", "COUNTS"),
        ),
        ("HNE", "--", early, "92.5 0.0", &old),
        ("HNE", "", late, "0.0 -90.0", &new),
    ]);
    for (start, value, direction) in [
        ("2010-01-01", 1000.0, Direction::Azimuth(92.5)),
        ("2015-06-01T12:00:00.4999", 1000.0, Direction::Azimuth(92.5)),
        ("2015-06-01T12:00:00.5", 3000.0, Direction::Up),
    ] {
        let found = scaling(&text, "HNE", "", start).unwrap();
        assert_eq!(
            (found.counts_per_m_s2, found.direction),
            (value, Some(direction)),
            "{start}"
        );
        assert_eq!(
            found.notes.len(),
            if start.ends_with(".4999") { 2 } else { 1 },
            "{:?}",
            found.notes
        );
    }
    assert_eq!(
        scaling(&text, "HNE", "10", "1999-01-01")
            .unwrap()
            .counts_per_m_s2,
        5.0
    );
    assert!(
        scaling(&text, "HNE", "", "2009-12-31T23:59:59")
            .unwrap_err()
            .message
            .contains("no epoch of XX.ABC..HNE")
    );
    let problem = scaling(&text, "HNZ", "", "2020-01-01").unwrap_err();
    assert!(
        problem
            .hint
            .unwrap()
            .contains("describes XX.ABC.10.HNE, XX.ABC..HNE;")
    );
    let bad = xml(&[("HNE", "", "startDate=\"yesterday\"", "0 0", &new)]);
    assert!(
        scaling(&bad, "HNE", "", "2020-01-01")
            .unwrap_err()
            .message
            .contains("\"yesterday\" is not a date")
    );
    let twice = xml(&[
        ("HNE", "", late, "0 0", &new),
        ("HNE", "", late, "0 0", &old),
    ]);
    let problem = scaling(&twice, "HNE", "", "2020-01-01").unwrap_err();
    assert!(
        problem.message.contains("two epochs with different")
            && problem.message.ends_with("line 10"),
        "{problem}"
    );
}

#[test]
fn what_is_no_station_xml_is_refused() {
    let bomb = "<?xml version=\"1.0\"?><!DOCTYPE a [<!ENTITY b \"bbbbbbbb\"><!ENTITY c \
                \"&b;&b;&b;\">]><FDSNStationXML>&c;</FDSNStationXML>";
    // Deep enough for the stack of a thread if elements were read one inside the other.
    let deep = "<a>".repeat(200_000);
    for (text, message) in [
        ("", "is not XML"),
        ("<a/>", "is not StationXML, but <a>"),
        ("<FDSNStationXML>", "is not XML"),
        (bomb, "is not XML"),
        (&deep, "is not XML"),
    ] {
        let problem = scaling(text, "HNE", "", "2020-01-01").unwrap_err();
        assert!(
            problem.message.contains(message) && problem.path.is_some(),
            "{problem}"
        );
    }
    let problem = Inventory::parse(b"\xFF\xFE<", "x".as_ref()).err().unwrap();
    assert!(problem.message.contains("not UTF-8"));
}

/// The parser compares each attribute with all before it: what has too many is refused before.
#[test]
fn elements_of_many_attributes_are_refused() {
    for value in ["1", ">", "=' "] {
        let many = |count: usize| {
            let attributes: String = (0..count).map(|n| format!(" a{n}=\"{value}\"")).collect();
            let text = xml(&[(
                "HNZ",
                "00",
                "",
                "0 -90",
                &sensitivity("2000", "1", "M/S**2", "COUNTS"),
            )]);
            text.replace("<Station code", &format!("<Station{attributes} code"))
        };
        assert!(
            scaling(&many(90), "HNZ", "00", "2020-01-01T00:00:00").is_ok(),
            "{value}"
        );
        let refused = scaling(&many(100_000), "HNZ", "00", "2020-01-01T00:00:00").unwrap_err();
        assert_eq!(
            refused.message, "has an element with more than 100 attributes",
            "{value}"
        );
        assert!(refused.hint.is_some());
    }
}

fn read(folder: &Path, named: Option<&str>, unit: Option<&str>) -> Result<MotionFile, String> {
    let options = ReadOptions {
        unit: unit.map(str::to_owned),
        station_xml: named.map(|name| folder.join(name)),
        ..ReadOptions::default()
    };
    parse_motions(
        mseed_record(),
        &folder.join("XX.ABC..HNE.D.mseed"),
        &options,
    )
    .map_err(|error| error.to_string())
}

#[test]
fn the_description_is_named_or_next_to_the_record() {
    let text = |value: &str| {
        xml(&[(
            "HNE",
            "",
            "",
            "90 0",
            &sensitivity(value, "1", "M/S**2", "COUNTS"),
        )])
    };
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let put = |name: &str, value: &str| std::fs::write(folder.join(name), text(value)).unwrap();
    assert!(
        read(folder, None, None)
            .unwrap_err()
            .contains("sensitivity of the counts is unknown")
    );
    assert_eq!(
        read(folder, None, Some("m/s2")).unwrap().components[0]
            .motion
            .peak_m_s2(),
        2000.0
    );
    // From the least wanted to the most: each newcomer is taken before what was there.
    for (name, value, peak_m_s2) in [
        ("XX.xml", "1000", 2.0),
        ("XX.ABC..HNE.D.xml", "2000", 1.0),
        ("XX.ABC.xml", "4000", 0.5),
        ("XX.ABC..HNE.xml", "8000", 0.25),
    ] {
        put(name, value);
        let file = read(folder, None, None).unwrap();
        let one = &file.components[0];
        assert_eq!(
            (one.motion.peak_m_s2(), one.unit, one.is_raw),
            (peak_m_s2, "m/s2", true),
            "{name}"
        );
        assert!(
            file.notes[0]
                .to_string()
                .contains(&format!("in {name}, {value} counts/(M/S**2)")),
            "{:?}",
            file.notes
        );
        assert_eq!(
            file.station_xml(),
            [InputFile::new(&folder.join(name), text(value).as_bytes())]
        );
    }
    // Channels that sense something else are left out, as long as one remains.
    let velocity = sensitivity("1000", "1", "M/S", "COUNTS");
    let both = xml(&[
        ("HNE", "", "", "90 0", &velocity.replace("M/S", "M/S**2")),
        ("HHE", "", "", "90 0", &velocity),
    ]);
    std::fs::write(folder.join("both.xml"), both).unwrap();
    let seismometer: Vec<u8> = mseed_record()
        .iter()
        .enumerate()
        .map(|(i, &b)| if i == 16 { b'H' } else { b })
        .collect();
    let options = ReadOptions {
        station_xml: Some(folder.join("both.xml")),
        ..ReadOptions::default()
    };
    let file = parse_motions(
        [seismometer.clone(), mseed_record()].concat(),
        &folder.join("x"),
        &options,
    )
    .unwrap();
    assert_eq!(
        file.components
            .iter()
            .map(|one| one.name.as_str())
            .collect::<Vec<_>>(),
        ["HNE"]
    );
    assert!(
        file.notes[0]
            .to_string()
            .contains("XX.ABC..HHE: the instrument measures a velocity (M/S)"),
        "{:?}",
        file.notes
    );
    assert!(
        file.notes[0].to_string().ends_with("it was left out"),
        "{:?}",
        file.notes
    );
    let error = parse_motions(seismometer, &folder.join("x"), &options)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("both.xml:") && error.contains("measures a velocity"),
        "{error}"
    );
    put("other.xml", "500");
    assert_eq!(
        read(folder, Some("other.xml"), None).unwrap().components[0]
            .motion
            .peak_m_s2(),
        4.0
    );
    assert!(
        read(folder, Some("absent.xml"), None)
            .unwrap_err()
            .contains("absent.xml: cannot open")
    );
    let both = read(folder, None, Some("g")).unwrap_err();
    assert!(
        both.contains("the unit g is given too") && both.contains("leave out `unit`"),
        "{both}"
    );
}
