//! How well the default synthesis fits: the table of `docs/motions.md`.
//!
//! `cargo run --release -p freestand-study --example matched_motions [SEED]`

#![expect(clippy::print_stdout, reason = "an example says what it computed")]

use freestand::code_spectrum::{As1170_4, Edition, Eurocode8, GroundType, SiteClass, SpectrumType};
use freestand::measures::{Integrals, integrals};
use freestand::motion::Motion;
use freestand::synthesis::{MatchedMotion, SynthesisError, SynthesisOptions, synthesize};
use rayon::prelude::*;

const MOTIONS: u64 = 10;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let seed = std::env::args().nth(1).map_or(Ok(1), |text| text.parse())?;
    println!(
        "| spectrum | rms, mean (largest) | worst period | target ZPA | PGA | PGV | D5–95 | v(end)/PGV | d(end)/PGD |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for site in SiteClass::ALL {
        let code = As1170_4::new(Edition::default(), site, 0.08, 500)?;
        row(&format!("AS 1170.4 {}", site.name()), seed, |t| {
            code.sa_g(t)
        })?;
    }
    let grounds = [
        GroundType::A,
        GroundType::B,
        GroundType::C,
        GroundType::D,
        GroundType::E,
    ];
    for (number, spectrum_type) in [(1, SpectrumType::Type1), (2, SpectrumType::Type2)] {
        for ground in grounds {
            let code = Eurocode8::new(spectrum_type, ground, 0.1, 1.0)?;
            row(
                &format!("Eurocode 8 type {number}, {ground:?}"),
                seed,
                |t| code.sa_g(t),
            )?;
        }
    }
    Ok(())
}

fn row(name: &str, seed: u64, target: impl Fn(f64) -> f64 + Sync) -> Result<(), SynthesisError> {
    let all: Vec<MatchedMotion> = (0..MOTIONS)
        .into_par_iter()
        .map(|index| synthesize(&target, seed, index, &SynthesisOptions::default()))
        .collect::<Result<_, _>>()?;
    let mean =
        |value: fn(&MatchedMotion) -> f64| all.iter().map(value).sum::<f64>() / MOTIONS as f64;
    let largest = |value: fn(&MatchedMotion) -> f64| all.iter().map(value).fold(0.0, f64::max);
    println!(
        "| {name} | {:.1} % ({:.1} %) | {:.0} % | {:.3} g | {:.3} g | {:.3} m/s | {:.1} s | {:.0e} | {:.0e} |",
        100.0 * mean(|one| one.misfit.rms_ratio),
        100.0 * largest(|one| one.misfit.rms_ratio),
        100.0 * largest(|one| one.misfit.worst_ratio.abs()),
        all[0].misfit.target_zpa_g,
        mean(|one| one.misfit.pga_g),
        mean(|one| one.misfit.pgv_m_s),
        mean(|one| one.misfit.d5_95_s),
        largest(|one| end_ratios(&one.motion).0),
        largest(|one| end_ratios(&one.motion).1),
    );
    Ok(())
}

/// Final velocity and displacement over their peaks.
fn end_ratios(motion: &Motion) -> (f64, f64) {
    let Integrals {
        velocity_m_s: velocity,
        displacement_m: displacement,
    } = integrals(motion);
    let ratio = |values: &[f64]| {
        let peak = values.iter().fold(0.0_f64, |peak, v| peak.max(v.abs()));
        values.last().map_or(0.0, |last| last.abs() / peak)
    };
    (ratio(&velocity), ratio(&displacement))
}
