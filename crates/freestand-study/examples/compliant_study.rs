//! The study of `docs/compliant-base.md`: releases over stiffness, tangential stiffness, damping, slenderness and friction against
//! Eqs. (5) and (8), one CSV row for each of 243 runs, and the paper's five tests.
//!
//! `cargo run --release -p freestand-study --example compliant_study > study.csv`

#![expect(clippy::print_stdout, reason = "the result is what it prints")]

use std::error::Error;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::{
    CompliantBase, CompliantOptions, CompliantRocking, Start, rock_compliant,
};
use freestand::cushion::Cushion;
use freestand::impact::{ImpactModel, Landing};
use freestand::rocking::Base;
use freestand_study::compliant::damped;

const MASS_KG: f64 = 140.0;
const HEIGHT_M: f64 = 2.3;
const EDGE_N_M: f64 = 4.38e6;
/// Of the rise at the balance point: 16.2 mm for the cabinet.
const RISE_SHARE: f64 = 0.42;

/// A release, followed until the block has swung to the other side.
fn release(
    block: &Block,
    base: &CompliantBase,
    rise_m: f64,
) -> Result<CompliantRocking, Box<dyn Error>> {
    let pivot = block.right_pivot();
    let rotation_rad = pivot
        .rotation_at_rise_rad(rise_m)
        .ok_or("beyond the balance point")?;
    let quarter_s = (1.0 / (1.0 - rotation_rad / pivot.slenderness_angle_rad)).acosh()
        / pivot.frequency_parameter_rad_s(G0_M_S2);
    let options = CompliantOptions {
        start: Start::Tilted {
            rotation_rad,
            omega_rad_s: 0.0,
        },
        duration_s: Some(2.2 * quarter_s),
        ..CompliantOptions::default()
    };
    Ok(rock_compliant(block, base, Base::default(), &options)?)
}

/// First landing, and the largest until the block has swung to the other side \[g\].
fn shocks(run: &CompliantRocking) -> (f64, f64) {
    let first = run
        .touches
        .first()
        .map_or(0.0, |touch| touch.peak_acceleration_m_s2);
    let largest = run
        .touches
        .iter()
        .map(|touch| touch.peak_acceleration_m_s2)
        .fold(0.0, f64::max);
    (first / G0_M_S2, largest / G0_M_S2)
}

fn study() -> Result<(), Box<dyn Error>> {
    println!(
        "slenderness_ratio,stiffness_n_m,tangential_ratio,damping_ratio,friction,cg_rise_m,first_g,largest_g,equation_5_g,\
         equation_8_g,first_over_5,largest_over_5,first_over_8,touches,swing_restitution_ratio,housner_ratio,energy_residual"
    );
    for slenderness in [2.0, HEIGHT_M / 0.6, 6.0] {
        let block = Block::uniform(HEIGHT_M, HEIGHT_M / slenderness)?;
        let rise_m = RISE_SHARE * block.pivot().balance_rise_m();
        for scale in [0.25, 1.0, 16.0] {
            let stiffness_n_m = scale * EDGE_N_M;
            let spring = Cushion::linear(stiffness_n_m)?;
            let [eq5, eq8] = [ImpactModel::Paper, ImpactModel::Halted].map(|model| {
                let impact =
                    Landing::rocking(&block, model).impact(MASS_KG, &spring, rise_m, G0_M_S2);
                impact.edge_acceleration_m_s2 / G0_M_S2
            });
            for tangential_stiffness_ratio in [0.5, 1.0, 10.0] {
                for damping_ratio in [0.0, 0.05, 0.15] {
                    for friction_ratio in [Some(0.3), Some(0.6), None] {
                        let base = CompliantBase {
                            tangential_stiffness_ratio,
                            friction_ratio,
                            ..CompliantBase::new(
                                MASS_KG,
                                damped(MASS_KG, stiffness_n_m, damping_ratio)?,
                            )
                        };
                        let run = release(&block, &base, rise_m)?;
                        let (first, largest) = shocks(&run);
                        // The tilt is to the right, the swing after the landing to the left.
                        let after = run.swings.iter().find(|swing| swing.rotation_rad < 0.0);
                        let rise_after_m =
                            after.map_or(0.0, |swing| block.pivot().cg_rise_m(swing.rotation_rad));
                        let restitution = (rise_after_m / rise_m).sqrt();
                        println!(
                            "{slenderness:.4},{stiffness_n_m},{tangential_stiffness_ratio},{damping_ratio},{},{rise_m:.6},{first:.4},\
                             {largest:.4},{eq5:.4},{eq8:.4},{:.4},{:.4},{:.4},{},{restitution:.4},{:.4},{:.1e}",
                            friction_ratio.map_or("no slip".to_owned(), |mu| mu.to_string()),
                            first / eq5,
                            largest / eq5,
                            first / eq8,
                            run.touches.len(),
                            block.landing_ratio(),
                            run.energy.residual_ratio
                        );
                    }
                }
            }
        }
    }
    Ok(())
}

/// The paper's releases at three dampings: first landing and largest of the first swing, in units of 9.80665 m/s².
fn table_one() -> Result<(), Box<dyn Error>> {
    println!(
        "\ncg_rise_mm,damping_ratio,tangential_ratio,first_g,largest_g,equation_5_g,contact_ms"
    );
    let block = Block::uniform(HEIGHT_M, 0.6)?;
    for rise_mm in [16.0, 27.0, 32.0] {
        for damping_ratio in [0.0, 0.02, 0.05, 0.1, 0.15] {
            for tangential_stiffness_ratio in [0.5, 1.0, 10.0] {
                let base = CompliantBase {
                    tangential_stiffness_ratio,
                    ..CompliantBase::new(MASS_KG, damped(MASS_KG, EDGE_N_M, damping_ratio)?)
                };
                let run = release(&block, &base, 1e-3 * rise_mm)?;
                let (first, largest) = shocks(&run);
                let eq5 = Landing::rocking(&block, ImpactModel::Paper).impact(
                    MASS_KG,
                    &Cushion::linear(EDGE_N_M)?,
                    1e-3 * rise_mm,
                    G0_M_S2,
                );
                let touch = run.touches.first().ok_or("it never landed")?;
                println!(
                    "{rise_mm},{damping_ratio},{tangential_stiffness_ratio},{first:.3},{largest:.3},{:.3},{:.2}",
                    eq5.edge_acceleration_m_s2 / G0_M_S2,
                    1e3 * (touch.end_time_s.unwrap_or(f64::NAN) - touch.time_s)
                );
            }
        }
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    study()?;
    table_one()
}
