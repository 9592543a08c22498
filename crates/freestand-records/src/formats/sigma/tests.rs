use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};

fn file(values: &[f64]) -> String {
    let peak = values
        .iter()
        .fold(0.0f64, |peak, value| peak.max(value.abs()));
    let mut text = format!(
        "Event Date & Time             : 2009-04-06 01:32:39\n\
         Station Code / Name           : 2987 / A Town - V. River, Italy\n\
         Network                       : DPC (A network)\n\
         Orientation                   : NS\n\
         Processing Info               : Butterworth: acausal.\n\
         Filter Cut-off Frequency (Hz) : 0.100 - 50.000\n\
         Time Increment (s)            : 0.005\n\
         Number of Data                : {}\n\
         PGA (m/s/s)                   : {peak:.7E}\n\
         Accelaration time series in m/s/s\n",
        values.len()
    );
    for row in values.chunks(5) {
        for value in row {
            let printed = format!("{value:.7E}");
            let (mantissa, exponent) = printed.split_once('E').unwrap();
            let exponent: i32 = exponent.parse().unwrap();
            text.push_str(&format!("{mantissa:>10}E{exponent:+03}"));
        }
        text.push('\n');
    }
    text
}

pub(crate) fn sample() -> Vec<u8> {
    file(&values()).into_bytes()
}

fn read(text: &str) -> Result<MotionFile, String> {
    parse_motions(
        text.as_bytes().to_vec(),
        "x.cor.acc".as_ref(),
        &ReadOptions::default(),
    )
    .map_err(|error| error.problems[0].to_string())
}

fn values() -> Vec<f64> {
    (0..12)
        .map(|i| f64::from((i * 7919) % 20_001 - 15_000) / 1e7)
        .collect()
}

#[test]
fn values_that_touch() {
    let text = file(&values());
    assert!(text.contains("E-03-"), "negative values touch");
    for text in [
        text.clone(),
        text.replace('\n', "\r\n"),
        format!("\n\n{text}\n"),
        text.replacen("Event Date & Time", "EVENT DATE & TIME", 1),
    ] {
        let found = read(&text).unwrap();
        let one = &found.components[0];
        assert_eq!(
            (found.format, one.name.as_str(), one.unit),
            ("SIGMA/RESORCE", "NS", "m/s2")
        );
        assert_eq!(
            (one.direction, one.motion.dt_s()),
            (Some(Direction::Azimuth(0.0)), 0.005)
        );
        assert_eq!(
            one.station.as_deref(),
            Some("2987 / A Town - V. River, Italy")
        );
        // Exact: the values have fewer digits than are printed.
        assert_eq!(one.motion.accel_m_s2(), values());
        assert_eq!(found.notes, [""; 0]);
    }
}

#[test]
fn what_is_refused_and_what_is_noted() {
    let text = file(&values());
    for (from, to, message) in [
        (
            "Accelaration time series in m/s/s",
            "Velocity time series in m/s",
            "x.cor.acc:10: holds \"Velocity",
        ),
        (
            "Data                : 12",
            "Data                : 16",
            "ends after 12 of 16",
        ),
        (
            "Data                : 12",
            "Data                : 10",
            "x.cor.acc:13: there are more values",
        ),
        (
            "Data                : 12",
            "Data                : ",
            "no number of values",
        ),
        (
            "(s)            : 0.005",
            "(s)            : ",
            "no time step",
        ),
        (
            "-1.5000000E-03",
            "    -999.     ",
            "x.cor.acc:11: \"-999\" marks a missing value",
        ),
    ] {
        let problem = read(&text.replacen(from, to, 1)).expect_err(message);
        assert!(problem.contains(message), "{problem}");
    }
    // The unit is stated in two places; one is enough. Without both, the user must state it.
    let one = text.replace("Accelaration time series in m/s/s\n", "");
    assert_eq!(read(&one).unwrap().components[0].unit, "m/s2");
    assert!(
        read(&one.replace("PGA (m/s/s)", "PGA        "))
            .unwrap_err()
            .contains("unit of the record is not stated")
    );
    let found = read(&text.replacen("    : 1.5", "    : 2.5", 1)).unwrap();
    assert!(found.notes[0].to_string().contains("header states a peak"));
}
