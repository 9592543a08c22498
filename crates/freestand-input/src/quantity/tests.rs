use super::units::{DEGREE, G0_M_S2};
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
        ("100 in/s2", Acceleration, 2.54),
        ("100 ft/s^2", Acceleration, 30.48),
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

/// The values are the f64 nearest to the exact fractions: `float(Fraction(...))` of Python, with
/// 0.0254 m, 0.45359237 kg and 4.4482216152605 N. A unit with a divisor (slug, lbf/in, psi) and a
/// fraction in thirds have two roundings: 1 ulp, 2.3e-16 of the value at most; all others none.
#[test]
fn inches_feet_and_pounds() {
    use Dimension::*;
    for (text, dimension, expected) in [
        ("74 in", Length, 1.8796),
        ("74in", Length, 1.8796),
        ("74 inches", Length, 1.8796),
        ("74 inch", Length, 1.8796),
        ("74\"", Length, 1.8796),
        ("74 \"", Length, 1.8796),
        ("74″", Length, 1.8796),
        ("74''", Length, 1.8796),
        ("74”", Length, 1.8796),
        ("74 IN", Length, 1.8796),
        ("74 in.", Length, 1.8796),
        ("6'2\"", Length, 1.8796),
        ("6′2″", Length, 1.8796),
        ("6’2”", Length, 1.8796),
        ("6' 2\"", Length, 1.8796),
        ("6'-2\"", Length, 1.8796),
        ("6' - 2\"", Length, 1.8796),
        ("6 ft 2 in", Length, 1.8796),
        ("6ft2in", Length, 1.8796),
        ("6 ft. 2 in.", Length, 1.8796),
        ("6 feet 2 inches", Length, 1.8796),
        ("6 FT 2 IN", Length, 1.8796),
        ("6 ft 2\"", Length, 1.8796),
        ("6′-2″", Length, 1.8796),
        ("6`2''", Length, 1.8796),
        ("6'-6\"", Length, 1.9812),
        ("5' 2 1/2\"", Length, 1.5875),
        ("5'-2-1/2\"", Length, 1.5875),
        ("5'2½\"", Length, 1.5875),
        ("5' 2.5\"", Length, 1.5875),
        ("6'0\"", Length, 1.8288),
        ("0'11\"", Length, 0.2794),
        ("5' ½\"", Length, 1.5367),
        ("6'11.75\"", Length, 2.12725),
        ("11 1/2 in", Length, 0.2921),
        ("11½ in", Length, 0.2921),
        ("11 ½\"", Length, 0.2921),
        ("11-1/2 in", Length, 0.2921),
        ("11.5 in", Length, 0.2921),
        ("23/2 in", Length, 0.2921),
        ("11 1⁄2 in", Length, 0.2921),
        ("1/2 in", Length, 0.0127),
        ("½\"", Length, 0.0127),
        ("-1 1/2 in", Length, -0.0381),
        ("1/3 in", Length, 0.008466666666666667),
        ("5 12/16 in", Length, 0.14605),
        ("6 ft", Length, 1.8288),
        ("6'", Length, 1.8288),
        ("6.5'", Length, 1.9812),
        ("6½'", Length, 1.9812),
        ("-6 ft", Length, -1.8288),
        ("6 feet", Length, 1.8288),
        ("1 foot", Length, 0.3048),
        ("2 yd", Length, 1.8288),
        ("2 yards", Length, 1.8288),
        ("２３００ｍｍ", Length, 2.3),
        ("2300㎜", Length, 2.3),
        ("2 metres", Length, 2.0),
        ("150 lb", Mass, 68.0388555),
        ("150 lbs", Mass, 68.0388555),
        ("150lbm", Mass, 68.0388555),
        ("150 pounds", Mass, 68.0388555),
        ("150 LBS", Mass, 68.0388555),
        ("150 lbs.", Mass, 68.0388555),
        ("1 oz", Mass, 0.028349523125),
        ("8 ounces", Mass, 0.226796185),
        ("1 short ton", Mass, 907.18474),
        ("2.5 short tons", Mass, 2267.96185),
        ("1 slug", Mass, 14.593902937206364),
        ("12 slugs", Mass, 175.1268352464764),
        ("80 kgs", Mass, 80.0),
        ("2 tonnes", Mass, 2000.0),
        ("1 pound", Mass, 0.45359237),
        ("1 lbf", Force, 4.4482216152605),
        ("2.5 kip", Force, 11120.55403815125),
        ("3 kips", Force, 13344.6648457815),
        ("4 kN", Force, 4000.0),
        ("7 N", Force, 7.0),
        ("100 kgf", Force, 980.665),
        ("100 lbf/in", Stiffness, 17512.683524647637),
        ("100 lb/in", Stiffness, 17512.683524647637),
        ("100 lbs/in", Stiffness, 17512.683524647637),
        ("100 LBF/IN", Stiffness, 17512.683524647637),
        ("100 lb / in.", Stiffness, 17512.683524647637),
        ("100 lbf/ft", Stiffness, 1459.3902937206365),
        ("3 kip/in", Stiffness, 525380.5057394292),
        ("3 kips/in", Stiffness, 525380.5057394292),
        ("3 kip/ft", Stiffness, 43781.70881161909),
        ("50 psi", Pressure, 344737.86465841805),
        ("36 ksi", Pressure, 248211262.554061),
        ("30 kPa", Pressure, 30000.0),
        ("12 in/s", Velocity, 0.3048),
        ("12 ft/s", Velocity, 3.6576),
        ("12 in/s2", Acceleration, 0.3048),
        ("32.2 ft/s²", Acceleration, 9.81456),
        ("386.4 in/s^2", Acceleration, 9.81456),
    ] {
        let value = parse(text, dimension).unwrap_or_else(|problem| panic!("{text}: {problem:?}"));
        let is_rounded_twice = ["slug", "lb", "kip", "psi", "ksi", "1/3"]
            .iter()
            .any(|unit| text.contains(unit))
            && !matches!(dimension, Mass | Force)
            || text.contains("slug");
        let most = if is_rounded_twice || text.contains("LBF/IN") {
            2.3e-16 * expected
        } else {
            0.0
        };
        assert!(
            (value - expected).abs() <= most,
            "{text}: {value:?}, not {expected:?}"
        );
        // The readers of tables go another way to the same value.
        assert_eq!(Quantity::read(text).unwrap().si(None), Ok(value), "{text}");
    }
}

#[test]
fn lengths_that_a_person_would_query() {
    for (text, message, hint) in [
        (
            "6'2",
            "\"6'2\" has a number after the feet without a mark of inches",
            "6'2\"",
        ),
        (
            "6 ft 2",
            "\"6 ft 2\" has a number after the feet without a mark of inches",
            "6 ft 2 in",
        ),
        (
            "1'200",
            "\"1'200\" has a number after the feet without a mark of inches",
            "thousands",
        ),
        (
            "6'12\"",
            "\"6'12\"\" has 12 inches or more after the feet",
            "7'2\"",
        ),
        (
            "5' 30 in",
            "\"5' 30 in\" has 12 inches or more after the feet",
            "",
        ),
        (
            "5' 11 16/16\"",
            "\"5' 11 16/16\"\" is not a mixed number",
            "",
        ),
        (
            "-6'2\"",
            "\"-6'2\"\" has a sign, a fraction or an exponent before the feet",
            "-74 in",
        ),
        (
            "+6 ft 2 in",
            "\"+6 ft 2 in\" has a sign, a fraction or an exponent before the feet",
            "",
        ),
        (
            "5.5' 2\"",
            "\"5.5' 2\"\" has a sign, a fraction or an exponent before the feet",
            "",
        ),
        (
            "5½' 2\"",
            "\"5½' 2\"\" has a sign, a fraction or an exponent before the feet",
            "",
        ),
        (
            "6' 2 cm",
            "\"6' 2 cm\" has something other than inches after the feet",
            "6'2\"",
        ),
        (
            "6' 2'",
            "\"6' 2'\" has something other than inches after the feet",
            "",
        ),
        (
            "6'2\"3",
            "\"6'2\"3\" has something other than inches after the feet",
            "",
        ),
        (
            "6' 1e0 in",
            "\"6' 1e0 in\" has an exponent in the inches",
            "",
        ),
        ("1/0 in", "\"1/0 in\" is a division by 0", "1/2 in"),
        ("6' 1/0\"", "\"6' 1/0\"\" is a division by 0", ""),
        ("5 3/2 in", "\"5 3/2 in\" is not a mixed number", ""),
        ("10 000/3 in", "\"10 000/3 in\" is not a mixed number", ""),
        (
            "1/99999 in",
            "\"1/99999 in\" is not a fraction that can be read",
            "",
        ),
        ("6 2\"", "\"6 2\"\" is more than one number", ""),
        ("1.5/2 in", "\"/2 in\" is not a unit of a length", ""),
        (
            "6'2\" kg",
            "\"6'2\" kg\" has something other than inches",
            "",
        ),
    ] {
        let problem = parse(text, Dimension::Length).expect_err(text);
        assert!(problem.message.starts_with(message), "{text}: {problem:?}");
        assert!(
            problem.hint.as_deref().unwrap_or("").contains(hint),
            "{text}: {problem:?}"
        );
    }
    for (text, dimension, hint) in [
        ("6'2\"", Dimension::Mass, "kg"),
        (
            "5 ton",
            Dimension::Mass,
            "t (1000 kg) or short ton (2000 lb)",
        ),
        ("5 lb", Dimension::Force, "lbf"),
        ("5 kip", Dimension::Mass, "kg"),
    ] {
        assert!(
            parse(text, dimension)
                .expect_err(text)
                .hint
                .unwrap()
                .contains(hint),
            "{text}"
        );
    }
}

#[test]
fn a_cell_and_its_heading() {
    let inch = find_unit("″", Dimension::Length).unwrap();
    let mm = find_unit("mm", Dimension::Length).unwrap();
    for (text, unit, si_m, bare) in [
        ("52½", None, 1.3335, 52.5),
        ("52 1/2", None, 1.3335, 52.5),
        ("72", None, 1.8288, 72.0),
        ("6'2\"", Some(inch), 1.8796, 74.0),
        ("1829 mm", Some(mm), 1.829, 1829.0),
    ] {
        let cell = Quantity::read(text).unwrap();
        assert_eq!(
            (cell.unit, cell.si(Some(inch)), cell.bare()),
            (unit, Ok(si_m), Ok(bare)),
            "{text}"
        );
    }
    assert_eq!(parse_in_unit("52½", inch), Ok(1.3335));
    assert!(
        parse_in_unit("6'2\"", mm)
            .unwrap_err()
            .hint
            .unwrap()
            .contains("already stated")
    );
    // A workbook has a number where a text file has digits: the same value from both.
    assert_eq!((inch.to_si(74.0), inch.from_si(1.8796)), (1.8796, 74.0));
    for (text, dimension, symbol) in [
        ("MM", Dimension::Length, "mm"),
        ("M", Dimension::Length, "m"),
        ("T", Dimension::Mass, "t"),
        ("LBS", Dimension::Mass, "lb"),
        ("KG", Dimension::Mass, "kg"),
        ("MS", Dimension::Time, "ms"),
        ("MN/M", Dimension::Stiffness, "MN/m"),
    ] {
        assert_eq!(find_unit_any_case(text, dimension).unwrap().symbol, symbol);
    }
    assert!(find_unit_any_case("KG", Dimension::Length).is_err());
}

/// Every unit is found by each of its names, and by no other unit's.
#[test]
fn names_of_units_are_unique() {
    for dimension in Dimension::ALL {
        for unit in dimension.units() {
            let found = lookup(unit.symbol).unwrap();
            assert_eq!((found.symbol, found.dimension), (unit.symbol, dimension));
            assert_eq!(find_unit_any_case(unit.symbol, dimension).unwrap(), unit);
        }
    }
}

#[test]
fn what_is_refused_and_what_is_said() {
    use Dimension::*;
    for (text, dimension, message, hint) in [
        (
            "2.3",
            Length,
            "\"2.3\" needs a unit",
            "write \"2.3 m\" or \"2.3 mm\"",
        ),
        (
            "0",
            Length,
            "\"0\" needs a unit",
            "write \"0 m\" or \"0 mm\"",
        ),
        ("7", Inertia, "\"7\" needs a unit", "write \"7 kg·m2\""),
        ("5 kg", Length, "\"5 kg\" is a mass, not a length", "m, mm"),
        ("5 %", Length, "\"5 %\" is a ratio, not a length", "m, mm"),
        (
            "5 m",
            Ratio,
            "\"5 m\" is a length, not a ratio",
            "bare number",
        ),
        (
            "150 g",
            Mass,
            "\"150 g\" is an acceleration, not a mass",
            "acceleration of gravity",
        ),
        (
            "2 rad",
            AngularVelocity,
            "\"2 rad\" is an angle, not an angular velocity",
            "rad/s",
        ),
        (
            "5 furlong",
            Length,
            "\"furlong\" is not a unit of a length",
            "m, mm",
        ),
        (
            "5 MM",
            Length,
            "\"MM\" is not a unit of a length",
            "capital letters matter",
        ),
        (
            "5 M",
            Length,
            "\"M\" is not a unit of a length",
            "write \"m\"",
        ),
        (
            "5 Mg",
            Acceleration,
            "\"Mg\" is not a unit of an acceleration",
            "write \"mg\"",
        ),
        (
            "5 mN/m",
            Stiffness,
            "\"mN/m\" is not a unit of a stiffness",
            "write \"MN/m\"",
        ),
        (
            "5 m m",
            Length,
            "\"m m\" is not a unit of a length",
            "known",
        ),
        ("", Length, "a quantity is missing", "number and its unit"),
        (
            "m",
            Length,
            "\"m\" is not a quantity",
            "number and its unit",
        ),
        ("nan m", Length, "\"nan m\" is not a quantity", ""),
        ("inf m", Length, "\"inf m\" is not a quantity", ""),
        ("-inf", Ratio, "\"-inf\" is not a quantity", ""),
        ("--2 m", Length, "\"--2 m\" is not a quantity", ""),
        (". m", Length, "\". m\" is not a quantity", ""),
        ("1e999 m", Length, "\"1e999 m\" is too large", ""),
        ("1e307 kN/m", Stiffness, "\"1e307 kN/m\" is too large", ""),
        (
            "2,3 m",
            Length,
            "\"2,3 m\" has a comma in the number",
            "point",
        ),
        (
            "1 000 mm",
            Length,
            "\"1 000 mm\" is more than one number",
            "",
        ),
        ("1.2.3 m", Length, "\"1.2.3 m\" is more than one number", ""),
        (
            "1_000 mm",
            Length,
            "\"1_000 mm\" is more than one number",
            "",
        ),
        ("1e m", Length, "\"e m\" is not a unit of a length", ""),
    ] {
        let problem = parse(text, dimension).expect_err(text);
        assert_eq!(problem.message, message);
        assert!(
            problem.hint.as_deref().unwrap_or("").contains(hint),
            "{text}: {problem:?}"
        );
    }
}

#[test]
fn signs_are_checked_where_asked() {
    assert_eq!(
        parse_positive("2 m", Dimension::Length, "the height"),
        Ok(2.0)
    );
    let problem = parse_positive("-1 m", Dimension::Length, "the height").unwrap_err();
    assert_eq!(problem.message, "the height must be positive, not \"-1 m\"");
    assert!(parse_positive("0 m", Dimension::Length, "the height").is_err());
    assert_eq!(
        parse_non_negative("0 mm", Dimension::Length, "the rise"),
        Ok(0.0)
    );
    assert!(parse_non_negative("-1 mm", Dimension::Length, "the rise").is_err());
}

#[test]
fn a_header_states_the_unit() {
    let mm = find_unit("mm", Dimension::Length).unwrap();
    assert_eq!(parse_in_unit(" 200 ", mm), Ok(0.2));
    assert!(
        parse_in_unit("200 mm", mm)
            .unwrap_err()
            .hint
            .unwrap()
            .contains("already stated")
    );
    assert!(parse_in_unit("", mm).is_err());
    assert!(
        find_unit("kg", Dimension::Length)
            .unwrap_err()
            .message
            .contains("is a mass")
    );
}

#[test]
fn grids() {
    let grid = parse_grid("0.3 m:4 m:64", Dimension::Length).unwrap();
    assert_eq!((grid.len(), grid[0], grid[63]), (64, 0.3, 4.0));
    assert!(grid.windows(2).all(|pair| pair[1] > pair[0]));
    assert_eq!(
        parse_grid("300mm : 400 mm : 2", Dimension::Length).unwrap(),
        [0.3, 0.4]
    );
    assert_eq!(
        parse_grid("2 m:1 m:3", Dimension::Length).unwrap(),
        [2.0, 1.5, 1.0]
    );
    assert_eq!(
        parse_grid("1 m:1000 mm:1", Dimension::Length).unwrap(),
        [1.0]
    );
    assert_eq!(
        parse_grid("200 mm, 400 mm,0.5 m", Dimension::Length).unwrap(),
        [0.2, 0.4, 0.5]
    );
    assert_eq!(
        parse_grid("0.5, 1.0", Dimension::Ratio).unwrap(),
        [0.5, 1.0]
    );
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
    assert_eq!(
        parse_grid("5 Hz:5 Hz:12/oct", Dimension::Frequency).unwrap(),
        [5.0]
    );
    for bad in [
        "0 Hz:1 Hz:3/oct",
        "2 Hz:1 Hz:3/oct",
        "-1 Hz:1 Hz:3/oct",
        "1 Hz:2 Hz:0/oct",
        "1 Hz:2 Hz:/oct",
    ] {
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

    /// Feet and inches in sixty-fourths are exact: the value is the nearest f64 to
    /// 254·(64·(12 f + i) + n) / 640000, in every spelling.
    #[test]
    fn feet_and_inches_are_exact(feet in 0u32..2000, inches in 0u32..12, n in 1u32..64) {
        let exact = f64::from(254 * (64 * (12 * feet + inches) + n)) / 640_000.0;
        for text in [
            format!("{feet}' {inches} {n}/64\""),
            format!("{feet}'-{inches}-{n}/64\""),
            format!("{feet} ft {inches} {n}/64 in"),
            format!("{feet}′{inches}{}″", format_args!(" {n}⁄64")),
            format!("{} {n}/64 in", 12 * feet + inches),
            format!("{}/64 in", 64 * inches + n),
        ] {
            let expected = if text.starts_with(&format!("{}/64", 64 * inches + n)) {
                f64::from(254 * (64 * inches + n)) / 640_000.0
            } else {
                exact
            };
            prop_assert_eq!(parse(&text, Dimension::Length), Ok(expected), "{}", text);
        }
    }

    /// A number of a workbook and the same digits of a text are the same value: products of up to
    /// 15 digits with 254 and 3048 are exact, and one division follows.
    #[test]
    fn digits_and_numbers_agree(tenths in 0u32..100_000_000, unit in prop::sample::select(vec!["in", "ft", "yd", "mm", "m"])) {
        let value = f64::from(tenths) / 10.0;
        let unit = find_unit(unit, Dimension::Length).unwrap();
        let (text, number) = (parse_in_unit(&value.to_string(), unit).unwrap(), unit.to_si(value));
        // A tenth is not exact in binary: the product has one rounding, the division another.
        prop_assert!((text - number).abs() <= 3.4e-16 * text);
        if tenths % 10 == 0 {
            prop_assert_eq!(text, number);
        }
    }

    #[test]
    fn marks_and_fractions_are_a_value_or_a_message(text in "[-+]?[0-9]{0,2}( ?[½¼])?( ft|'|′|’)?[ -]?[0-9]{0,3}( |-)?([0-9]{0,2}/[0-9]{0,2})?(\"|″|''| in| inches| mm)?") {
        if let Ok(value) = parse(&text, Dimension::Length) {
            prop_assert!(value.is_finite());
        }
        if let Ok(cell) = Quantity::read(&text) {
            prop_assert!(cell.si(None).is_ok());
        }
    }
}
