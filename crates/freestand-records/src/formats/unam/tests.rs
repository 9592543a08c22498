use super::direction;
use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};
use std::fmt::Write;

/// A file of the standard's version 2: the parts and names that its readers look for, on as many
/// lines as they expect.
fn file() -> String {
    let mut text = String::from("\n\nRED DE PRUEBA\n\n\n\n");
    text.push_str("       ARCHIVO ESTANDAR DE ACELERACION\n");
    let mut put = |name: &str, value: &str| {
        let _ = writeln!(text, "{name:<40}: {value}");
    };
    put("VERSION DEL FORMATO", "2.0");
    put("NOMBRE DE LA ESTACION", "UNA ESTACI\u{d3}N");
    put("CLAVE DE LA ESTACION", "UNES");
    put("COORDENADAS DE LA ESTACION", "16.5000 LAT. N");
    put("", "99.5000 LONG. W");
    put("NUMERO DE CANALES", "3");
    put(
        "ORIENTACION C1-C6 (rumbo;orientacion)",
        "/N00E;+/V;+/N90W;-/",
    );
    put("VEL. DE MUESTREO, C1-C6 (muestras/s)", "/100/100/100/");
    put("INTERVALO DE MUESTREO, C1-C6 (s)", "/0.010/0.010/0.010/");
    put("HORA DE LA PRIMERA MUESTRA (GMT)", "13:17:50.00");
    put("DURACION DEL REGISTRO (s), C1-C6", "/1.20/1.20/1.20/");
    put("NUM. TOTAL DE MUESTRAS, C1-C6", "/120/120/120/");
    put("ACEL. MAX.(Gal), C1-C6", "/-3.50/2.25/1234.50/");
    put("ACEL. MAX. C1-C6, EN LA MUESTRA", "/8/8/8/");
    put("UNIDADES DE LOS DATOS", "Gal (cm/s/s)");
    put("FACTOR DE DECIMACION", "1");
    put("FORMATO DATOS", "3F10.3");
    while text.lines().count() < 104 {
        text.push_str("comentario\n");
    }
    text.push_str("DATOS DE ACELERACION:\n------------------------------\n");
    text.push_str("   CANAL-1   CANAL-2   CANAL-3\n      N00E         V      E--W\n------------------------------\n");
    for i in 0..120 {
        let row = if i == 7 {
            [-3.5, 2.25, 1234.5]
        } else {
            [1.0, -1.0, -0.5]
        };
        let _ = writeln!(text, "{:>10.3}{:>10.3}{:>10.3}", row[0], row[1], row[2]);
    }
    text
}

/// As the agency's programs write it: in Latin-1.
fn read(text: &str) -> Result<MotionFile, String> {
    let bytes = text
        .chars()
        .map(|c| u8::try_from(u32::from(c)).unwrap())
        .collect();
    parse_motions(bytes, "x.ASA".as_ref(), &ReadOptions::default())
        .map_err(|error| error.problems[0].to_string())
}

#[test]
fn three_channels_in_the_order_of_the_header() {
    let found = read(&file()).unwrap();
    assert_eq!((found.format, &found.notes), ("ASA", &Vec::new()));
    // N90W;- points against west: to the east.
    let about: Vec<_> = found
        .components
        .iter()
        .map(|one| (one.name.as_str(), one.direction))
        .collect();
    let (north, east) = (Direction::Azimuth(0.0), Direction::Azimuth(90.0));
    assert_eq!(
        about,
        [
            ("N00E", Some(north)),
            ("V", Some(Direction::Up)),
            ("N90W", Some(east))
        ]
    );
    for (one, at_7) in found.components.iter().zip([-3.5, 2.25, 1234.5]) {
        assert_eq!(
            (one.unit, one.is_raw, one.motion.dt_s()),
            ("gal", false, 0.01)
        );
        assert_eq!(
            (one.station.as_deref(), one.line_of_first_value),
            (Some("UNA ESTACI\u{d3}N"), 110)
        );
        // Exact: both are the product of the same two f64.
        assert_eq!(
            (one.motion.accel_m_s2()[7], one.motion.accel_m_s2().len()),
            (at_7 / 100.0, 120)
        );
    }
}

#[test]
fn bearings_and_signs() {
    for (text, expected) in [
        ("N00E", Some(Direction::Azimuth(0.0))),
        ("N--S", Some(Direction::Azimuth(0.0))),
        ("N90W", Some(Direction::Azimuth(270.0))),
        ("N90W;-", Some(Direction::Azimuth(90.0))),
        ("S45E;+", Some(Direction::Azimuth(135.0))),
        ("+V", Some(Direction::Up)),
        ("V;+", Some(Direction::Up)),
        ("V;-", None),
        ("-V", None),
        ("S9OE", None),
        ("", None),
    ] {
        assert_eq!(direction(text), expected, "{text}");
    }
}

#[test]
fn headers_of_other_hands() {
    let text = file();
    for (from, to) in [
        ("\n", "\r\n"),
        (
            "ESTANDAR DE ACELERACION",
            "EST\u{c1}NDAR DE ACELERACI\u{d3}N",
        ),
        ("C1-C6 (s) ", "C1-C6, (s)"),
        ("3F10.3", "(3F10.3)"),
        (
            "FORMATO DATOS                           : 3F10.3",
            "FORMATO DATOS                           :",
        ),
        ("Gal (cm/s/s)", "(Gal)"),
        ("/100/100/100/", "100/100/100"),
        ("DATOS DE ACELERACION:", "datos de aceleraci\u{f3}n:"),
        ("comentario", "1.000 2.000 tres"),
        ("comentario", "1.000 2.000 3.000"),
        ("DATOS DE ACELERACION:", "------------------------------"),
        (
            "NOMBRE DE LA ESTACION                   : UNA ESTACI\u{d3}N\n",
            "NOMBRE DE LA ESTACION                   : UNA ESTACI\u{d3}N\n : \n",
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let found =
            read(&text.replace(from, to)).unwrap_or_else(|problem| panic!("{to}: {problem}"));
        assert_eq!(
            found.components[2].motion.accel_m_s2()[7],
            1234.5 / 100.0,
            "{to}"
        );
        assert_eq!(found.notes, [""; 0], "{to}");
    }
    let peak = read(&text.replace("/2.25/", "/4.50/")).unwrap();
    assert!(
        peak.notes[0]
            .to_string()
            .starts_with("V: the largest value is"),
        "{:?}",
        peak.notes
    );
    let short = read(&text.replace("/120/120/120/", "/120/119/120/")).unwrap();
    assert_eq!(short.components[1].motion.accel_m_s2().len(), 119);
    assert!(
        short.notes[0].to_string().contains("after its 119 values"),
        "{:?}",
        short.notes
    );
    let duration = read(&text.replace("/1.20/1.20/1.20/", "/12.0/12.0/12.0/")).unwrap();
    assert!(
        duration.notes[0]
            .to_string()
            .contains("last 1.20 s, but the header states 12 s"),
        "{:?}",
        duration.notes
    );
}

#[test]
fn what_is_wrong_names_its_line() {
    let text = file();
    for (from, to, line, message) in [
        (
            "/120/120/120/",
            "/130/130/130/",
            "x.ASA:19:",
            "declares 130 rows, but the file has 120",
        ),
        (
            "/120/120/120/",
            "/120/120/",
            "x.ASA:19:",
            "a number for each of 3 channels",
        ),
        (
            "/0.010/0.010/0.010/",
            "/0.010/0.020/0.010/",
            "x.ASA:16:",
            "different time steps",
        ),
        (
            "/0.010/0.010/0.010/",
            "/-/-/-/",
            "x.ASA:16:",
            "a number for each",
        ),
        (
            "Gal (cm/s/s)",
            "cm/s",
            "x.ASA:22:",
            "an acceleration is expected",
        ),
        (
            "Gal (cm/s/s)",
            "cuentas",
            "x.ASA: ",
            "unit of the record is not stated",
        ),
        ("3F10.3", "I10,2F10.3", "x.ASA:24:", "format of the data is"),
        (
            "      N00E         V      E--W",
            "         V      N00E      E--W",
            "x.ASA:108:",
            "the header lists",
        ),
        (
            "     1.000    -1.000    -0.500\n",
            "     1.000    -1.000\n",
            "x.ASA:110:",
            "this one has 2",
        ),
        ("  1234.500", "  -999.000", "x.ASA:117:", "missing value"),
        (
            "INTERVALO",
            "INTERVENO",
            "x.ASA:109:",
            "no line \"INTERVALO DE MUESTREO\"",
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let problem = read(&text.replacen(from, to, 1)).expect_err(message);
        assert!(
            problem.starts_with(line) && problem.contains(message),
            "{problem}"
        );
    }
    let duration = text.replace("/1.20/1.20/1.20/", "/2.20/2.20/2.20/");
    assert_eq!(
        read(&duration).unwrap().notes,
        [""; 0],
        "within the second to which some are rounded"
    );
    let thinned = text
        .replace("/1.20/1.20/1.20/", "/3.60/3.60/3.60/")
        .replace(
            "FACTOR DE DECIMACION                    : 1",
            "FACTOR DE DECIMACION                    : 3",
        );
    let problem = read(&thinned).unwrap_err();
    assert!(
        problem.contains("last 1.20 s, but the header states 3.6 s"),
        "{problem}"
    );
}
