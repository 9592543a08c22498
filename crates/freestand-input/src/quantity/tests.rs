use super::*;
use proptest::prelude::*;

/// Exact comparisons throughout: the power of ten goes into the decimal digits, so each result is
/// the nearest f64 to the decimal value; g and degrees are one product, written here as the same
/// product.
#[test]
fn every_spelling_of_every_unit() {
    use Dimension::*;
    for (text, dimension, expected) in [
        ("2.3 m", Length, 2.3),
        ("2.3m", Length, 2.3),
        ("2300 mm", Length, 2.3),
        ("2300mm", Length, 2.3),
        ("230cm", Length, 2.3),
        ("230 CM", Length, 2.3),
        ("1e3mm", Length, 1.0),
        ("1.5e-3 m", Length, 0.0015),
        (".5m", Length, 0.5),
        ("5.m", Length, 5.0),
        ("+2 m", Length, 2.0),
        ("-2 m", Length, -2.0),
        ("\u{2212}2 m", Length, -2.0),
        ("  25\tmm ", Length, 0.025),
        ("1.001 km", Length, 1001.0),
        ("140 kg", Mass, 140.0),
        ("140 KG", Mass, 140.0),
        ("1.2 t", Mass, 1200.0),
        ("0.35g", Acceleration, 0.35 * G0_M_S2),
        ("0.35 G", Acceleration, 0.35 * G0_M_S2),
        ("350 mg", Acceleration, 0.35 * G0_M_S2),
        ("9.8 m/s2", Acceleration, 9.8),
        ("9.8 m/s^2", Acceleration, 9.8),
        ("9.8 m/s²", Acceleration, 9.8),
        ("9.8 m / s²", Acceleration, 9.8),
        ("9.8 m/s/s", Acceleration, 9.8),
        ("980 cm/s2", Acceleration, 9.8),
        ("980 cm/s²", Acceleration, 9.8),
        ("9800 mm/s2", Acceleration, 9.8),
        ("9800mm/s^2", Acceleration, 9.8),
        ("980 gal", Acceleration, 9.8),
        ("9.8 m s^-2", Acceleration, 9.8),
        ("9.8 m·s⁻²", Acceleration, 9.8),
        ("9.8 m.s-2", Acceleration, 9.8),
        ("980 cm s^-2", Acceleration, 9.8),
        ("980 cm·s⁻²", Acceleration, 9.8),
        ("9.8e6 um/s2", Acceleration, 9.8),
        ("9.8e6 µm/s²", Acceleration, 9.8),
        ("35 %g", Acceleration, 0.35 * G0_M_S2),
        ("35 % g", Acceleration, 0.35 * G0_M_S2),
        ("3.5 g/10", Acceleration, 0.35 * G0_M_S2),
        ("350 milli-g", Acceleration, 0.35 * G0_M_S2),
        ("350e3 ug", Acceleration, 0.35 * G0_M_S2),
        ("350e3 µg", Acceleration, 0.35 * G0_M_S2),
        ("350e3 micro-g", Acceleration, 0.35 * G0_M_S2),
        ("100 in/s2", Acceleration, 100.0 * 0.0254),
        ("100 ft/s^2", Acceleration, 100.0 * 0.3048),
        ("980 Gal", Acceleration, 9.8),
        ("4380 N/mm", Stiffness, 4.38e6),
        ("4.38e6 N/m", Stiffness, 4.38e6),
        ("4380 kN/m", Stiffness, 4.38e6),
        ("4.38 kN/mm", Stiffness, 4.38e6),
        ("4.38 MN/m", Stiffness, 4.38e6),
        ("11 ms", Time, 0.011),
        ("0.011 s", Time, 0.011),
        ("10 kHz", Frequency, 1e4),
        ("10 khz", Frequency, 1e4),
        ("10 Hz", Frequency, 10.0),
        ("1 rad", Angle, 1.0),
        ("5 mrad", Angle, 0.005),
        ("90 deg", Angle, 90.0 * DEGREE),
        ("90°", Angle, 90.0 * DEGREE),
        ("1.2 rad/s", AngularVelocity, 1.2),
        ("-1rad/s", AngularVelocity, -1.0),
        ("30 deg/s", AngularVelocity, 30.0 * DEGREE),
        ("30 °/s", AngularVelocity, 30.0 * DEGREE),
        ("1.2 m/s", Velocity, 1.2),
        ("120 cm/s", Velocity, 1.2),
        ("1200 mm/s", Velocity, 1.2),
        ("12 kg m2", Inertia, 12.0),
        ("12 kg·m²", Inertia, 12.0),
        ("12 kg m^2", Inertia, 12.0),
        ("12 kg*m^2", Inertia, 12.0),
        ("12 kg.m2", Inertia, 12.0),
        ("12kgm2", Inertia, 12.0),
        ("0.05", Ratio, 0.05),
        ("5 %", Ratio, 0.05),
        ("5%", Ratio, 0.05),
        ("7 %", Ratio, 0.07),
        ("-1", Ratio, -1.0),
        ("1e-400", Ratio, 0.0),
        ("0e999999999999", Ratio, 0.0),
    ] {
        assert_eq!(parse(text, dimension), Ok(expected), "{text}");
    }
}

#[test]
fn what_is_refused_and_what_is_said() {
    use Dimension::*;
    for (text, dimension, message, hint) in [
        ("2.3", Length, "\"2.3\" needs a unit", "write \"2.3 m\" or \"2.3 mm\""),
        ("0", Length, "\"0\" needs a unit", "write \"0 m\" or \"0 mm\""),
        ("7", Inertia, "\"7\" needs a unit", "write \"7 kg·m2\""),
        ("5 kg", Length, "\"5 kg\" is a mass, not a length", "m, mm"),
        ("5 %", Length, "\"5 %\" is a ratio, not a length", "m, mm"),
        ("5 m", Ratio, "\"5 m\" is a length, not a ratio", "bare number"),
        ("150 g", Mass, "\"150 g\" is an acceleration, not a mass", "acceleration of gravity"),
        ("2 rad", AngularVelocity, "\"2 rad\" is an angle, not an angular velocity", "rad/s"),
        ("5 furlong", Length, "\"furlong\" is not a unit of a length", "m, mm"),
        ("5 MM", Length, "\"MM\" is not a unit of a length", "capital letters matter"),
        ("5 M", Length, "\"M\" is not a unit of a length", "write \"m\""),
        ("5 Mg", Acceleration, "\"Mg\" is not a unit of an acceleration", "write \"mg\""),
        ("5 mN/m", Stiffness, "\"mN/m\" is not a unit of a stiffness", "write \"MN/m\""),
        ("5 m m", Length, "\"m m\" is not a unit of a length", "known"),
        ("", Length, "a quantity is missing", "number and its unit"),
        ("m", Length, "\"m\" is not a quantity", "number and its unit"),
        ("nan m", Length, "\"nan m\" is not a quantity", ""),
        ("inf m", Length, "\"inf m\" is not a quantity", ""),
        ("-inf", Ratio, "\"-inf\" is not a quantity", ""),
        ("--2 m", Length, "\"--2 m\" is not a quantity", ""),
        (". m", Length, "\". m\" is not a quantity", ""),
        ("1e999 m", Length, "\"1e999 m\" is too large for a number", ""),
        ("1e307 kN/m", Stiffness, "\"1e307 kN/m\" is too large for a number", ""),
        ("2,3 m", Length, "\"2,3 m\" has a comma in the number", "point"),
        ("1 000 mm", Length, "\"1 000 mm\" is more than one number", ""),
        ("1.2.3 m", Length, "\"1.2.3 m\" is more than one number", ""),
        ("1_000 mm", Length, "\"1_000 mm\" is more than one number", ""),
        ("1e m", Length, "\"e m\" is not a unit of a length", ""),
    ] {
        let problem = parse(text, dimension).expect_err(text);
        assert_eq!(problem.message, message);
        assert!(problem.hint.as_deref().unwrap_or("").contains(hint), "{text}: {problem:?}");
    }
}

#[test]
fn signs_are_checked_where_asked() {
    assert_eq!(parse_positive("2 m", Dimension::Length, "the height"), Ok(2.0));
    let problem = parse_positive("-1 m", Dimension::Length, "the height").unwrap_err();
    assert_eq!(problem.message, "the height must be positive, not \"-1 m\"");
    assert!(parse_positive("0 m", Dimension::Length, "the height").is_err());
    assert_eq!(parse_non_negative("0 mm", Dimension::Length, "the rise"), Ok(0.0));
    assert!(parse_non_negative("-1 mm", Dimension::Length, "the rise").is_err());
}

#[test]
fn a_header_states_the_unit() {
    let mm = find_unit("mm", Dimension::Length).unwrap();
    assert_eq!(parse_in_unit(" 200 ", mm), Ok(0.2));
    assert!(parse_in_unit("200 mm", mm).unwrap_err().hint.unwrap().contains("already stated"));
    assert!(parse_in_unit("", mm).is_err());
    assert!(find_unit("kg", Dimension::Length).unwrap_err().message.contains("is a mass"));
}

#[test]
fn grids() {
    let grid = parse_grid("0.3 m:4 m:64", Dimension::Length).unwrap();
    assert_eq!((grid.len(), grid[0], grid[63]), (64, 0.3, 4.0));
    assert!(grid.windows(2).all(|pair| pair[1] > pair[0]));
    assert_eq!(parse_grid("300mm : 400 mm : 2", Dimension::Length).unwrap(), [0.3, 0.4]);
    assert_eq!(parse_grid("2 m:1 m:3", Dimension::Length).unwrap(), [2.0, 1.5, 1.0]);
    assert_eq!(parse_grid("1 m:1000 mm:1", Dimension::Length).unwrap(), [1.0]);
    assert_eq!(parse_grid("200 mm, 400 mm,0.5 m", Dimension::Length).unwrap(), [0.2, 0.4, 0.5]);
    assert_eq!(parse_grid("0.5, 1.0", Dimension::Ratio).unwrap(), [0.5, 1.0]);
    for bad in [
        "",
        "1 m,",
        "200, 400 mm",
        "1 m:2 m",
        "1 m:2 m:1",
        "1 m:2 m:0",
        "1 m:2 m:2.5",
        "1 m:2 m:-3",
        "1 m:2 m:3:4",
        "1:2 m:3",
        "1 m:2 m:12/oct",
        "1 m:2 m:99999999999999999999999",
        "1 m:2 m:1000001",
    ] {
        assert!(parse_grid(bad, Dimension::Length).is_err(), "{bad}");
    }
}

#[test]
fn grids_in_octaves() {
    // 3 octaves of 3 steps; the ends are exact, the inner points one exp2 and one product from it:
    // a few ulp.
    let grid = parse_grid("1 Hz:8 Hz:3/oct", Dimension::Frequency).unwrap();
    assert_eq!((grid.len(), grid[0], grid[9]), (10, 1.0, 8.0));
    assert!((grid[3] - 2.0).abs() < 1e-14 && (grid[6] - 4.0).abs() < 1e-14);
    // log2(10 000)·12 = 159.45: 160 points on the steps and the end.
    let grid = parse_grid("1 Hz:10 kHz:12/oct", Dimension::Frequency).unwrap();
    assert_eq!((grid.len(), grid[160]), (161, 1e4));
    assert_eq!(parse_grid("5 Hz:5 Hz:12/oct", Dimension::Frequency).unwrap(), [5.0]);
    for bad in ["0 Hz:1 Hz:3/oct", "2 Hz:1 Hz:3/oct", "-1 Hz:1 Hz:3/oct", "1 Hz:2 Hz:0/oct", "1 Hz:2 Hz:/oct"] {
        assert!(parse_grid(bad, Dimension::Frequency).is_err(), "{bad}");
    }
    assert!(parse_grid("1 Hz:2 Hz:1000001/oct", Dimension::Frequency).is_err());
}

#[test]
fn values_are_echoed_as_engineers_read_them() {
    use Dimension::*;
    for (value, dimension, expected) in [
        (2.3, Length, "2.3 m"),
        (0.2, Length, "200 mm"),
        (0.0, Length, "0 m"),
        (-0.0125, Length, "-12.5 mm"),
        (150.0, Mass, "150 kg"),
        (4.38e6, Stiffness, "4380 N/mm"),
        (0.35 * G0_M_S2, Acceleration, "0.35 g"),
        (0.011, Time, "11 ms"),
        (2.5, Time, "2.5 s"),
        (1.0 / 3.0, Ratio, "0.333333"),
        (12.0, Inertia, "12 kg·m²"),
        (1234567.0, Frequency, "1234567 Hz"),
        (1e-7, Ratio, "1e-7"),
        (2.5e12, Frequency, "2.5e12 Hz"),
    ] {
        assert_eq!(format_si(value, dimension), expected);
    }
}

proptest! {
    #[test]
    fn anything_is_a_value_or_a_message(text in "\\PC{0,24}") {
        let _ = parse(&text, Dimension::Length);
        let _ = parse_grid(&text, Dimension::Frequency);
    }

    #[test]
    fn near_misses_are_a_value_or_a_message(text in "[-+]?[0-9]{0,3}[.,]?[0-9]{0,3}(e|E|:|, )?[-+]?[0-9]{0,5} ?(m|mm|g|N/mm|%|°|kg m2|/oct|:3)?") {
        if let Ok(value) = parse(&text, Dimension::Length) {
            prop_assert!(value.is_finite());
        }
        let _ = parse_grid(&text, Dimension::Length);
    }

    /// The echo has 6 significant digits: a relative error of 5e-6 at most.
    #[test]
    fn an_echo_reads_back(value in -1e6..1e6f64, dimension in prop::sample::select(vec![
        Dimension::Length, Dimension::Mass, Dimension::Time, Dimension::Acceleration, Dimension::Stiffness,
        Dimension::Frequency, Dimension::Angle, Dimension::AngularVelocity, Dimension::Velocity, Dimension::Inertia,
        Dimension::Ratio])) {
        let back = parse(&format_si(value, dimension), dimension).unwrap();
        prop_assert!((back - value).abs() <= 5.01e-6 * value.abs(), "{value} {back}");
    }
}
