//! What the ground motions of worlds are, and how long they take: a row for each motion, to compare
//! two versions of the program.
//!
//! `world_motions.rs SITE WORLDS [PASSES] > motions.csv`: SITE is the class of AS 1170.4, `Be` or
//! `De`. For the components x, y and vertical of each world: ln of PGA, PGV, CAV, D5–95 and PGD; the
//! velocity and the displacement that are left at the end; ln Sa/target and the deviation that was
//! drawn, at 40 periods; which of eight blocks the motion overturns. The time of a motion on one core
//! and the share of x that overturns each block go to the standard error output.

#![expect(
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a measurement may stop, and says what it measured"
)]

use std::fmt::Write as _;
use std::time::Instant;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::code_spectrum::{As1170_4, Edition, SiteClass};
use freestand::measures::{integrals, measures};
use freestand::motion::Motion;
use freestand::oscillator::{DAMPING_RATIO, response_spectrum};
use freestand::rocking::{Base, Outcome, RockingOptions, Until, rock};
use freestand::synthesis::SynthesisOptions;
use freestand::worlds::{Component, GroundSpread, SpreadOptions, world_motion};

const PERIODS: i32 = 40;
/// Height \[m\], thickness/height and the factor on the motion.
const BLOCKS: [(f64, f64, f64); 8] = [
    (0.8, 0.12, 1.0),
    (0.8, 0.16, 1.5),
    (1.2, 0.12, 1.2),
    (1.6, 0.12, 1.0),
    (1.6, 0.16, 1.6),
    (2.0, 0.12, 1.5),
    (2.0, 0.2, 2.5),
    (3.0, 0.15, 2.0),
];

fn overturns(motion: &Motion, (height_m, ratio, scale): (f64, f64, f64)) -> bool {
    let block = Block::uniform(height_m, ratio * height_m).unwrap();
    let scaled = motion.scaled(scale).unwrap();
    let base = Base {
        horizontal: Some(&scaled),
        vertical: None,
    };
    let options = RockingOptions {
        until: Until::Settled { at_most_s: 120.0 },
        ..RockingOptions::default()
    };
    rock(&block, base, &options).unwrap().outcome == Outcome::Overturned
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let worlds: u32 = arguments[2].parse().unwrap();
    let site = match arguments[1].as_str() {
        "Be" => SiteClass::Be,
        "De" => SiteClass::De,
        other => panic!("SITE is Be or De, not {other}"),
    };
    let code = As1170_4::new(Edition::default(), site, 0.08, 500).unwrap();
    let target = |period_s: f64| code.sa_g(period_s);
    let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
    let mut options = SynthesisOptions::default();
    if let Some(passes) = arguments.get(3) {
        options.passes = passes.parse().unwrap();
    }
    let periods_s: Vec<f64> = (0..PERIODS)
        .map(|k| 0.05 * 80.0_f64.powf(f64::from(k) / f64::from(PERIODS - 1)))
        .collect();
    print!("world,component,pga,pgv,cav,d5_95,end_v,end_u,pgd");
    periods_s.iter().for_each(|t| print!(",sa_{t:.4}"));
    periods_s.iter().for_each(|t| print!(",drawn_{t:.4}"));
    for (height_m, ratio, scale) in BLOCKS {
        print!(",falls_{height_m}_{ratio}_{scale}");
    }
    println!();
    let mut seconds = 0.0;
    let mut fallen = [0_u32; BLOCKS.len()];
    for world in 0..worlds {
        let spectra = spread.spectra(1, world, 0);
        for (component, name) in [
            (Component::X, "x"),
            (Component::Y, "y"),
            (Component::Vertical, "v"),
        ] {
            let start = Instant::now();
            let motion = world_motion(target, &spectra, component, (1, world, 0), &options)
                .unwrap()
                .motion;
            seconds += start.elapsed().as_secs_f64();
            let all = measures(&motion);
            let spectrum = response_spectrum(&motion, DAMPING_RATIO, &periods_s).unwrap();
            let mut row = format!("{world},{name}");
            for value in [all.pga_m_s2, all.pgv_m_s, all.cav_m_s, all.d5_95_s] {
                write!(row, ",{:.6}", value.ln()).unwrap();
            }
            let left = integrals(&motion);
            for left in [&left.velocity_m_s, &left.displacement_m] {
                write!(row, ",{:e}", left.last().unwrap()).unwrap();
            }
            write!(row, ",{:.6}", all.pgd_m.ln()).unwrap();
            for (sa, &t) in spectrum.psa_m_s2.iter().zip(&periods_s) {
                write!(row, ",{:.6}", (sa / G0_M_S2 / target(t)).ln()).unwrap();
            }
            for &t in &periods_s {
                write!(row, ",{:.6}", spectra.of(component).sa_g(t, 1.0).ln()).unwrap();
            }
            for (count, block) in fallen.iter_mut().zip(BLOCKS) {
                let falls = overturns(&motion, block);
                *count += u32::from(falls && component == Component::X);
                write!(row, ",{}", u8::from(falls)).unwrap();
            }
            println!("{row}");
        }
    }
    for (count, (height_m, ratio, scale)) in fallen.iter().zip(BLOCKS) {
        let share = f64::from(*count) / f64::from(worlds);
        eprintln!("{share:.3} of x overturn {height_m} m x {ratio}, scaled by {scale}");
    }
    eprintln!("{:.3} ms a motion", seconds * 1e3 / f64::from(3 * worlds));
}
