//! Quantities and grids as flags, studies and tables write them.
#![no_main]
use freestand_input::quantity::{
    Dimension, find_unit, format_si, parse, parse_grid, parse_in_unit,
};

libfuzzer_sys::fuzz_target!(|text: &str| {
    for dimension in [
        Dimension::Length,
        Dimension::Mass,
        Dimension::Time,
        Dimension::Acceleration,
        Dimension::Stiffness,
        Dimension::Frequency,
        Dimension::Angle,
        Dimension::AngularVelocity,
        Dimension::Velocity,
        Dimension::Inertia,
        Dimension::Ratio,
    ] {
        if let Ok(value) = parse(text, dimension) {
            assert!(value.is_finite());
            // What is printed for people is a quantity again.
            assert!(parse(&format_si(value, dimension), dimension).is_ok());
        }
        if let Ok(values) = parse_grid(text, dimension) {
            assert!(values.iter().all(|value| value.is_finite()));
        }
        if let Ok(unit) = find_unit(text, dimension) {
            assert!(parse_in_unit("1", unit).is_ok_and(f64::is_finite));
        }
    }
});
