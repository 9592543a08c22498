//! The kernel for objects on pads beside the scalar solver, under recorded motions. The records belong to others and are not
//! shipped: the test reads them where they are at hand (`FREESTAND_SHARED`, else `../shared` beside the workspace) and says
//! so if not.

#![allow(
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::{
    CompliantAccuracy, CompliantBase, CompliantOptions, CompliantWorld, PadOutcome,
    pad_uplift_threshold_m_s2, rock_compliant, rock_compliant_many,
};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::motion::Motion;
use freestand::rocking::{Base, Outcome};
use freestand_records::formats::{ReadOptions, read_motions};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

fn shared() -> PathBuf {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::env::var_os("FREESTAND_SHARED").map_or_else(|| workspace.join("../shared"), PathBuf::from)
}

/// 30 s or less about the peak of a record.
fn record(path: &Path) -> Option<Motion> {
    let options = ReadOptions {
        unit: Some("g".to_owned()),
        ..ReadOptions::default()
    };
    let file = read_motions(path, &ReadOptions::default())
        .or_else(|_| read_motions(path, &options))
        .ok()?;
    let motion = &file.components.first()?.motion;
    let accel = motion.accel_m_s2();
    let peak = (0..accel.len()).max_by(|&a, &b| accel[a].abs().total_cmp(&accel[b].abs()))?;
    let half = (15.0 / motion.dt_s()) as usize;
    let part = accel[peak.saturating_sub(half)..(peak + half).min(accel.len())].to_vec();
    Motion::new(motion.dt_s(), part).ok()
}

/// Every record scaled to 1.3 times the threshold of a rack and of a narrow cabinet. The tolerances are those of the
/// campaign over synthetic motions; 40 of the records are those of one suite.
#[test]
#[ignore = "seconds of the scalar solver"]
fn under_recorded_motions_both_solvers_agree() {
    let folder = shared().join("records");
    let names = [
        "elCentro.AT2",
        "RSN175_IMPVALL.H_H-E12140.AT2",
        "Northridge.dat",
        "0111a.smc",
    ];
    let mut paths: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
    if let Ok(suite) = std::fs::read_dir(folder.join("p695")) {
        let texts = suite.filter_map(|entry| Some(entry.ok()?.path()));
        paths.extend(
            texts.filter(|path| path.extension().is_some_and(|extension| extension == "txt")),
        );
    }
    paths.sort();
    let records: Vec<Motion> = paths.iter().filter_map(|path| record(path)).collect();
    if records.is_empty() {
        println!("skipped: recorded motions are not in $FREESTAND_SHARED/records (../shared)");
        return;
    }
    for (height_m, width_m, mass_kg, stiffness_n_m) in
        [(2.0, 0.9, 400.0_f64, 1.5e6), (2.3, 0.6, 140.0, 4.38e6)]
    {
        let block = Block::uniform(height_m, width_m).unwrap();
        let damping_n_s_m = 2.0 * 0.1 * (stiffness_n_m * mass_kg).sqrt();
        let peak = 1.3 * pad_uplift_threshold_m_s2(&block, mass_kg, stiffness_n_m, G0_M_S2);
        let motions: Vec<Motion> = records
            .iter()
            .map(|record| record.scaled(peak / record.peak_m_s2()).unwrap())
            .collect();
        let worlds: Vec<CompliantWorld> = motions
            .iter()
            .map(|motion| CompliantWorld {
                block,
                mass_kg,
                stiffness_n_m,
                damping_n_s_m,
                motion: Base {
                    horizontal: Some(motion),
                    vertical: None,
                },
            })
            .collect();
        let cushion = Cushion::new(ContactLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        })
        .unwrap();
        let base = CompliantBase::new(mass_kg, cushion);
        let options = CompliantOptions {
            accuracy: CompliantAccuracy::Fast,
            ..CompliantOptions::default()
        };
        let expected: Vec<_> = worlds
            .par_iter()
            .map(|world| rock_compliant(&world.block, &base, world.motion, &options).unwrap())
            .collect();
        let mut differences = Vec::new();
        let mut falls = 0i32;
        for (found, expected) in rock_compliant_many(&worlds, G0_M_S2)
            .into_iter()
            .zip(&expected)
        {
            let found = found.unwrap();
            falls += i32::from(found.outcome == PadOutcome::Overturned);
            falls -= i32::from(expected.outcome == Outcome::Overturned);
            if found.lift_m > 0.0 && expected.uplift_m > 0.0 {
                differences.push((found.lift_m / expected.uplift_m).ln().abs());
            }
        }
        differences.sort_by(f64::total_cmp);
        let at = |share: f64| differences[(share * (differences.len() - 1) as f64) as usize];
        println!(
            "{} records, {} lifted: {:.4} {:.4}",
            records.len(),
            differences.len(),
            at(0.5),
            at(0.9)
        );
        assert!(
            differences.len() * 4 >= records.len(),
            "{} of {} lifted",
            differences.len(),
            records.len()
        );
        assert!(
            at(0.5) <= 0.01 && at(0.9) <= 0.05,
            "{} {}",
            at(0.5),
            at(0.9)
        );
        // One of fifty is 0.02.
        assert!(falls.abs() <= 1, "{falls}");
    }
}
