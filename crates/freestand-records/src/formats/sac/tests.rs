use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};
use proptest::prelude::*;

const VALUES: [f32; 4] = [0.5, -0.25, 12.0, -12345.0];

/// A file as the SAC manual has it: 70 reals, 40 whole numbers, 192 characters, samples; in version
/// 7 a footer.
fn file(big: bool, version: i32, words: &[(usize, f32)], integers: &[(usize, i32)]) -> Vec<u8> {
    let put = |bits: u32| {
        if big {
            bits.to_be_bytes()
        } else {
            bits.to_le_bytes()
        }
    };
    let mut header = [(-12345.0f32).to_bits(); 110];
    header[70..].fill((-12345i32).cast_unsigned());
    header[0] = 0.02f32.to_bits();
    for (at, value) in [
        (76, version),
        (79, VALUES.len() as i32),
        (85, 1),
        (86, 8),
        (105, 1),
    ]
    .iter()
    .chain(integers)
    {
        header[*at] = value.cast_unsigned();
    }
    for (at, value) in words {
        header[*at] = value.to_bits();
    }
    let mut out: Vec<u8> = header.iter().flat_map(|&word| put(word)).collect();
    out.extend(b"T001230 -12345          ");
    out.extend(b"-12345  ".repeat(17));
    out.extend(b"HNE     CJ      -12345  -12345  ");
    out.extend(VALUES.iter().flat_map(|value| put(value.to_bits())));
    if version == 7 {
        let step = 0.004f64.to_bits();
        let step = if big {
            step.to_be_bytes()
        } else {
            step.to_le_bytes()
        };
        out.extend(step.repeat(22));
    }
    out
}

fn read_in(bytes: &[u8], unit: Option<&str>) -> Result<MotionFile, String> {
    let options = ReadOptions {
        unit: unit.map(str::to_owned),
        ..ReadOptions::default()
    };
    parse_motions(bytes.to_vec(), "x.sac".as_ref(), &options).map_err(|error| error.to_string())
}

fn read(bytes: &[u8]) -> Result<MotionFile, String> {
    read_in(bytes, Some("m/s2"))
}

#[test]
fn either_order_and_version_is_read() {
    for (big, version, dt_s) in [
        (true, 6, 0.02),
        (false, 6, 0.02),
        (true, 7, 0.004),
        (false, 7, 0.004),
    ] {
        let found = read(&file(big, version, &[], &[])).unwrap();
        let one = &found.components[0];
        assert_eq!(
            (found.format, one.name.as_str(), one.unit, one.is_raw),
            ("SAC", "HNE", "m/s2", true)
        );
        assert_eq!(
            (one.station.as_deref(), one.direction),
            (Some("CJ.T001230"), Some(Direction::Azimuth(90.0)))
        );
        // Exact: 0.02 is the decimal that the single-precision value stands for.
        assert_eq!(one.motion.dt_s(), dt_s);
        assert_eq!(one.motion.accel_m_s2(), VALUES.map(f64::from));
    }
}

#[test]
fn the_unit_is_asked_for() {
    let message = read_in(&file(false, 6, &[], &[]), None).unwrap_err();
    assert!(
        message.contains("does not state its unit")
            && message.contains("`unit`")
            && message.contains("nm/s2"),
        "{message}"
    );
    let found = read_in(&file(false, 6, &[], &[]), Some("nm/s2")).unwrap();
    let third = found.components[0].motion.accel_m_s2()[2];
    // The unit and the product are rounded, each to half an epsilon.
    assert!((third - 12e-9).abs() <= f64::EPSILON * 12e-9, "{third}");
    assert!(
        found.notes[0]
            .to_string()
            .contains("assumed to be in nm/s2")
    );
}

#[test]
fn directions_scale_and_peak_are_told() {
    for (azimuth, incidence, direction) in [
        (350.0, 90.0, Some(Direction::Azimuth(350.0))),
        (-10.0, 90.0, Some(Direction::Azimuth(350.0))),
        (0.0, 0.0, Some(Direction::Up)),
        // Down, and a slope: no name, but that of the channel.
        (0.0, 180.0, Some(Direction::Azimuth(90.0))),
    ] {
        let found = read(&file(false, 6, &[(57, azimuth), (58, incidence)], &[])).unwrap();
        assert_eq!(
            found.components[0].direction, direction,
            "{azimuth} {incidence}"
        );
    }
    let found = read(&file(false, 6, &[(3, 2.0), (1, -12344.0), (2, 12.0)], &[])).unwrap();
    assert_eq!(found.notes.len(), 3, "{:?}", found.notes);
    assert!(
        found.notes[2]
            .to_string()
            .contains("more than any ground or floor motion"),
        "{:?}",
        found.notes
    );
    assert!(
        found.notes[1].to_string().contains("SCALE is 2")
            && found.notes[1].to_string().contains("not multiplied")
    );
    let found = read(&file(false, 6, &[(1, -1.0), (2, 12.0)], &[])).unwrap();
    assert!(
        found.notes[1].to_string().contains("states a peak of 12"),
        "{:?}",
        found.notes
    );
}

#[test]
fn what_is_no_acceleration_in_equal_steps_is_refused() {
    let good = file(false, 6, &[], &[]);
    let mut nan = good.clone();
    nan[636..640].copy_from_slice(&f32::NAN.to_le_bytes());
    for (bytes, message) in [
        (file(false, 6, &[], &[(86, 7)]), "is a velocity"),
        (file(false, 6, &[], &[(86, 6)]), "is a displacement"),
        (file(false, 6, &[], &[(86, 50)]), "is a voltage"),
        (file(false, 6, &[], &[(85, 2)]), "is a spectrum"),
        (file(false, 6, &[], &[(85, 4)]), "IFTYPE = 4"),
        (file(false, 6, &[], &[(105, 0)]), "unevenly spaced"),
        (
            file(false, 6, &[], &[(79, 5)]),
            "declares 5 samples (NPTS), but the file has room for 4",
        ),
        (file(false, 6, &[], &[(79, -1)]), "(NPTS) is -1"),
        (file(false, 6, &[(0, -12345.0)], &[]), "DELTA) is missing"),
        (nan, "sample 2 is NaN"),
        (good[..640].to_vec(), "room for 2"),
        (file(false, 5, &[], &[]), "binary file of an unknown format"),
    ] {
        let found = read(&bytes).unwrap_err();
        assert!(
            found.contains(message) && !found.contains("x.sac:1"),
            "{found}"
        );
    }
    for depth in [5, -12345] {
        assert!(read(&file(false, 6, &[], &[(86, depth)])).is_ok());
    }
}

#[test]
fn sac_in_text_is_told() {
    let mut text =
        " 0.0200000      -12345.00      -12345.00      -12345.00      -12345.00\n".repeat(14);
    text.push_str("    -12345    -12345    -12345    -12345    -12345\n");
    text.push_str("    -12345         6    -12345    -12345         4\n");
    text.push_str(&"    -12345    -12345    -12345    -12345    -12345\n".repeat(6));
    assert!(
        read(text.as_bytes())
            .unwrap_err()
            .contains("an alphanumeric SAC file")
    );
    assert!(
        !read(text.replace("-12345", "-12346").as_bytes())
            .unwrap_err()
            .contains("SAC")
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn damaged_files_are_read_or_refused(
        cut in 0.0..1.0f64,
        damage in prop::collection::vec((0..648usize, any::<u8>()), 1..8),
    ) {
        let mut bytes = file(false, 6, &[], &[]);
        for (at, byte) in damage {
            bytes[at] = byte;
        }
        if cut > 0.8 {
            bytes.truncate((cut * 648.0) as usize);
        }
        match read(&bytes) {
            Ok(file) => prop_assert!(file.components[0].motion.accel_m_s2().iter().all(|a| a.is_finite())),
            Err(message) => prop_assert!(!message.contains(['\n', '\r']), "{}", message),
        }
    }
}

#[test]
fn a_number_of_samples_below_zero_is_refused() {
    // Found by fuzzing: the problem had no remedy.
    let read = parse_motions(
        file(false, 6, &[], &[(79, -5)]),
        "x.sac".as_ref(),
        &ReadOptions::default(),
    );
    let problem = &read.unwrap_err().problems[0];
    assert_eq!(problem.message, "the number of samples (NPTS) is -5");
    assert!(problem.hint.as_ref().unwrap().contains("fetch it again"));
}

#[test]
fn an_end_that_contradicts_the_step_is_said() {
    for (end, count) in [(5.06, 1), (5.08, 1), (5.16, 2)] {
        let found =
            read(&file(false, 6, &[(5, 5.0), (6, end)], &[(79, 3)]).split_off(0)[..644]).unwrap();
        let found = found
            .notes
            .into_iter()
            .filter(|note| !note.to_string().contains("more than the ground"))
            .collect::<Vec<_>>();
        assert_eq!(found.len(), count, "{end}: {found:?}");
    }
}
