use std::f64::consts::{FRAC_PI_2, PI};

use super::*;
use crate::G0_M_S2;
use crate::block::Block;
use crate::compliant::{CompliantBase, CompliantOptions, Start, rock_compliant};
use crate::cushion::ContactLaw;
use crate::rocking::{Base, Outcome};

/// One sine of this amplitude \[g\] and duration, from `from_s` on, sampled every 5 ms.
fn pulse(amplitude_g: f64, period_s: f64, from_s: f64, duration_s: f64) -> Motion {
    let samples = (duration_s / 0.005).round() as usize;
    let at = |index: usize| {
        let time_s = index as f64 * 0.005 - from_s;
        let inside = (0.0..=period_s).contains(&time_s);
        if inside { amplitude_g * G0_M_S2 * (2.0 * PI * time_s / period_s).sin() } else { 0.0 }
    };
    Motion::new(0.005, (0..=samples).map(at).collect()).unwrap()
}

fn prism(thickness_m: f64, width_m: f64, height_m: f64, mass_kg: f64, stiffness_n_m: f64) -> SpatialObject {
    let support = Support::new(Cushion::linear(stiffness_n_m).unwrap());
    SpatialObject { shape: Shape::Prism { thickness_m, width_m, height_m }, mass_kg, support, walls: Vec::new() }
}

fn cylinder(radius_m: f64, height_m: f64, mass_kg: f64, stiffness_n_m: f64) -> SpatialObject {
    let shape = Shape::Cylinder { diameter_m: 2.0 * radius_m, height_m };
    SpatialObject { shape, ..prism(1.0, 1.0, 1.0, mass_kg, stiffness_n_m) }
}

fn until(duration_s: f64) -> SpatialOptions {
    SpatialOptions { duration_s: Some(duration_s), ..SpatialOptions::default() }
}

fn released(tilt_rad: f64, toward_rad: f64, omega_rad_s: [f64; 3], duration_s: f64) -> SpatialOptions {
    let start = SpatialStart::Released { tilt_rad, toward_rad, omega_rad_s };
    SpatialOptions { start, ..until(duration_s) }
}

fn both<'a>(x: &'a Motion, y: &'a Motion) -> SpatialMotion<'a> {
    SpatialMotion { x: Some(x), y: Some(y), vertical: None }
}

fn along_x(x: &Motion) -> SpatialMotion<'_> {
    SpatialMotion { x: Some(x), ..SpatialMotion::default() }
}

fn rock(object: &SpatialObject, motion: SpatialMotion<'_>) -> SpatialRocking {
    rock_spatial(object, motion, &SpatialOptions::default()).unwrap()
}

#[test]
fn zz_probe() {
    let x = pulse(0.353, 0.4, 0.0, 0.645);
    let y = pulse(0.2491, 0.4, 0.0, 0.645);
    let r = rock(&prism(0.476, 0.476, 2.23, 174.7, 4.219e6), both(&x, &y));
    println!("{r:#?}\nexpect 0.06345786253973495 at 0.6274333 final .056458295096553944 .02853003699882657");
    let x = pulse(0.434, 0.49, 0.0, 0.825);
    let y = pulse(0.6296, 0.49, 0.0, 0.825);
    let r = rock(&prism(0.687, 0.796, 2.23, 585.1, 11208000.0), both(&x, &y));
    println!("{r:#?}\nexpect 0.1552669621419387");
    let stack = Stack {
        lower: StackBody { height_m: 1.148, thickness_m: 0.379, mass_kg: 382.9 },
        upper: StackBody { height_m: 0.825, thickness_m: 0.242, mass_kg: 95.8 },
        support: Support::new(Cushion::linear(7721000.0).unwrap()),
        interface: Support::new(Cushion::linear(1146000.0).unwrap()),
    };
    let x = pulse(0.377, 0.69, 0.0, 0.17);
    let r = rock_stack(&stack, Base { horizontal: Some(&x), vertical: None }, &SpatialOptions::default()).unwrap();
    println!("{r:#?} expect .007230606328223352 0.010617553098715118 0.005565945150447223");
}
