use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};
use std::fmt::Write;

/// One component as the format's description has it (GeoNet, Strong motion file formats).
struct Part<'a> {
    title: &'a str,
    name: &'a str,
    /// Integers 31 and 34.
    counts: (usize, usize),
    others: usize,
    factor: f64,
    values: &'a [f64],
}

impl Part<'_> {
    fn text(&self) -> String {
        let mut text = format!("{} accelerogram 20180212_ABCD_20 GNS Science\n", self.title);
        text.push_str(
            "Site ABCD      39 56 38S  176 35 04E\nA Town Hall\nInstrument X\nResolution: 24-bit\n",
        );
        text.push_str("Accelerogram\n6 km south of a place\n2018 February 12         21:15:54 UT\nEpicentre\n");
        let _ = write!(
            text,
            "Number of points {}\nInstrument corrected data\nBand-pass\n",
            self.values.len()
        );
        let _ = write!(
            text,
            "Component {}\nAcceleration:\nVelocity:\nDisplacement:\n",
            self.name
        );
        for i in 0..40 {
            let value = match i {
                30 => self.counts.0,
                33 => self.counts.1,
                34 | 35 => self.others,
                _ => 2018,
            };
            let _ = write!(text, "{value:>8}{}", if i % 10 == 9 { "\n" } else { "" });
        }
        let peak = self
            .values
            .iter()
            .fold(0.0f64, |a, b| if b.abs() > a.abs() { *b } else { a });
        for i in 0..60 {
            let value = match i {
                7 => format!("{:.3}", self.factor),
                24 => "0.0050".to_owned(),
                25 => "0.0200".to_owned(),
                30 | 35 => format!("{:.1}", peak * self.factor),
                _ => "0.".to_owned(),
            };
            let _ = write!(text, "{value:>8}{}", if i % 10 == 9 { "\n" } else { "" });
        }
        for row in self.values.chunks(10) {
            for value in row {
                let _ = write!(text, "{value:>8.1}");
            }
            text.push('\n');
        }
        for at in 0..2 * self.others {
            let _ = write!(
                text,
                " 0.00001{}",
                if at % self.others % 10 == 9 || (at + 1) % self.others == 0 {
                    "\n"
                } else {
                    ""
                }
            );
        }
        text
    }
}

fn values() -> Vec<f64> {
    (0..23)
        .map(|i| f64::from((i * 7919) % 200_001 - 100_000) / 10.0)
        .map(|v| if v == 0.0 { -0.0 } else { v })
        .collect()
}

fn part<'a>(title: &'a str, name: &'a str, values: &'a [f64]) -> Part<'a> {
    let others = if title == "Corrected" {
        values.len()
    } else {
        0
    };
    Part {
        title,
        name,
        counts: (values.len(), values.len()),
        others,
        factor: 1.0,
        values,
    }
}

pub(crate) fn sample() -> Vec<u8> {
    let values = values();
    (part("Corrected", "N", &values).text() + &part("Uncorrected", "Up", &values).text())
        .into_bytes()
}

fn read(text: &str) -> Result<MotionFile, String> {
    parse_motions(
        text.as_bytes().to_vec(),
        "x.V1A".as_ref(),
        &ReadOptions::default(),
    )
    .map_err(|error| error.problems[0].to_string())
}

#[test]
fn three_components_of_two_volumes() {
    let values = values();
    for (title, format) in [("Corrected", "GeoNet V2A"), ("Uncorrected", "GeoNet V1A")] {
        let names = ["S16W  Longitudinal Axis", "S74E", "Up    Vertical Axis"];
        let text: String = names
            .iter()
            .map(|name| part(title, name, &values).text())
            .collect();
        for text in [
            text.clone(),
            text.replace('\n', "\r\n"),
            format!("\n{text}\n\n"),
            text.to_uppercase(),
        ] {
            let found = read(&text).unwrap();
            assert_eq!((found.format, found.components.len()), (format, 3));
            let directions = [
                Direction::Azimuth(196.0),
                Direction::Azimuth(106.0),
                Direction::Up,
            ]
            .map(Some);
            for (one, direction) in found.components.iter().zip(directions) {
                assert_eq!(
                    (one.unit, one.direction, one.motion.dt_s()),
                    ("mm/s2", direction, 0.02)
                );
                // Exact: the printed decimals are the values.
                assert_eq!(
                    one.motion.accel_m_s2(),
                    values.iter().map(|v| v / 1000.0).collect::<Vec<_>>()
                );
            }
            assert_eq!(found.notes, [""; 0]);
        }
        let found = read(&text).unwrap();
        assert_eq!(
            (
                found.components[0].name.as_str(),
                found.components[0].line_of_first_value
            ),
            ("S16W", 27)
        );
        assert_eq!(
            found.components[0].station.as_deref(),
            Some("ABCD A Town Hall")
        );
        // The agency's other spelling of itself, and none.
        assert_eq!(
            read(&text.replace(" GNS Science", ""))
                .unwrap()
                .components
                .len(),
            3
        );
    }
}

#[test]
fn one_component_and_other_counts() {
    let values = values();
    assert_eq!(
        read(&part("Corrected", "N", &values).text())
            .unwrap()
            .components
            .len(),
        1
    );
    // The two counts of an uncorrected record differ: the block has one of them.
    for counts in [(23, 0), (23, 30), (20, 23), (40, 23)] {
        let two = Part {
            counts,
            ..part("Uncorrected", "N", &values)
        }
        .text()
            + &part("Uncorrected", "E", &values).text();
        let found = read(&two).unwrap_or_else(|problem| panic!("{counts:?}: {problem}"));
        assert_eq!(
            found
                .components
                .iter()
                .map(|c| c.motion.accel_m_s2().len())
                .collect::<Vec<_>>(),
            [23, 23],
            "{counts:?}"
        );
    }
    let found = read(
        &Part {
            factor: 0.5,
            ..part("Uncorrected", "N", &values)
        }
        .text(),
    )
    .unwrap();
    assert_eq!(
        found.components[0].motion.accel_m_s2()[0],
        values[0] * 0.5 * 1e-3
    );
    assert!(
        found.notes.len() == 2 && found.notes[0].to_string().contains("0.5 mm/s2"),
        "{:?}",
        found.notes
    );
    assert_eq!(
        found.notes[1],
        "the file has only 1 of three components: it may be cut off"
    );
    // A corrected record whose velocities are cut off is incomplete, though all its
    // accelerations are there.
    let text = part("Corrected", "N", &values).text();
    let cut: Vec<&str> = text.lines().take(31).collect();
    assert!(
        read(&cut.join("\n"))
            .unwrap_err()
            .contains("x.V1A:31: the file ends after 2 of 3 lines of velocity")
    );
    let found = read(&format!("{text}--- end of file ---\n")).unwrap();
    assert!(
        found.notes[0]
            .to_string()
            .contains("of text between or after the components ignored")
    );
}

#[test]
fn what_is_refused() {
    let values = values();
    let text = part("Uncorrected", "N", &values).text();
    for (from, to, message) in [
        ("      23", "      29", "ends after 23 of 29"),
        (
            "      23",
            "      -1",
            "x.V1A:20: the number of accelerations is -1",
        ),
        (
            "  0.0200",
            "  0.0000",
            "x.V1A:23: the time step must be positive",
        ),
        (
            "-10000.0 -9208.1",
            "******** -9208.1",
            "x.V1A:27: \"********\" marks a missing value",
        ),
        (
            "-10000.0 -9208.1",
            "-32768.0 -9208.1",
            "x.V1A:27: \"-32768\" marks a missing value",
        ),
    ] {
        let problem = read(&text.replace(from, to)).expect_err(message);
        assert!(problem.contains(message), "{problem}");
    }
    let few = Part {
        counts: (10, 10),
        ..part("Corrected", "N", &values)
    }
    .text();
    assert!(
        read(&few)
            .unwrap_err()
            .contains("more values than the header declares")
    );
}

#[test]
fn lengths_and_numbers_that_contradict_are_said() {
    let values = values();
    let three: String = ["N", "E", "Up"]
        .map(|name| part("Corrected", name, &values).text())
        .concat();
    assert_eq!(read(&three).unwrap().notes, [""; 0]);
    let long = read(&three.replacen("      0.  0.0050", "    0.88  0.0050", 1)).unwrap();
    assert_eq!(
        long.notes,
        ["N: 23 values at 0.02 s last 0.46 s, but the header states 0.88 s: the step may be wrong"]
    );
    let odd = Part {
        others: 22,
        ..part("Corrected", "N", &values)
    }
    .text();
    let odd =
        odd + &part("Corrected", "E", &values).text() + &part("Corrected", "Up", &values).text();
    let note =
        "N: 23 accelerations were read, but the header declares 22 velocities or displacements";
    assert_eq!(read(&odd).unwrap().notes, [note]);
}

/// Every second strong record exceeds 999 mm/s²; in a weak one, -999 is clearly a gap.
#[test]
fn minus_999_is_missing_where_it_stands_out() {
    let strong: Vec<f64> = (0..23)
        .map(|i| f64::from(i * 163 % 23 - 11) * 111.0)
        .collect();
    assert!(strong.contains(&-999.0));
    let found = read(&part("Corrected", "N", &strong).text()).unwrap();
    assert_eq!(found.components[0].motion.accel_m_s2().len(), 23);
    assert!(
        found.notes[0]
            .to_string()
            .contains("-999 is read as a value"),
        "{:?}",
        found.notes
    );
    let weak: Vec<f64> = strong
        .iter()
        .map(|value| {
            if *value == -999.0 {
                -999.0
            } else {
                value / 10.0
            }
        })
        .collect();
    assert!(
        read(&part("Corrected", "N", &weak).text())
            .unwrap_err()
            .contains("\"-999\" marks a missing value")
    );
}
