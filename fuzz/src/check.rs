//! What must hold for all bytes: the check of the fuzz targets and of the mutation test of
//! freestand-records.

use freestand_records::formats::{ReadOptions, parse_motions};
use freestand_records::notes::NoteKind;
use freestand_records::tables::hazard::{Wanted, read_hazard};
use std::path::Path;

/// As freestand::motion has it.
const MAX_SAMPLES: usize = 100_000_000;

/// Reads `bytes` as a hazard file under a name that states the measure of a curve and the return period of a map; whether it is
/// read.
///
/// # Panics
/// A problem without a file or a remedy; a value or a rate that is no number above 0, or a curve that does not fall.
pub fn check_hazard(bytes: &[u8]) -> bool {
    let path = Path::new("/nowhere/PGA/map-475y.csv");
    // The first site of a file with several.
    let wanted = Wanted {
        name: None,
        at: Some(freestand_records::tables::hazard::Coordinates {
            latitude_deg: 45.0,
            longitude_deg: 10.0,
        }),
        measure: None,
    };
    let site = match read_hazard(bytes, path, &wanted) {
        Ok(site) => site,
        Err(problem) => {
            assert!(
                problem.path.is_some() && problem.hint.is_some() && !problem.message.is_empty(),
                "{problem:?}"
            );
            return false;
        }
    };
    let is_fine = |value: f64| value > 0.0 && value.is_finite();
    for spectrum in &site.spectra {
        assert!(spectrum.years.is_none_or(is_fine), "{spectrum:?}");
        assert!(
            spectrum.values.iter().all(|value| is_fine(value.1)),
            "{spectrum:?}"
        );
    }
    for curve in site.hazard_curves().unwrap_or_default() {
        assert!(
            curve
                .points
                .iter()
                .all(|&(x, rate)| is_fine(x) && is_fine(rate)),
            "{curve:?}"
        );
        assert!(
            curve
                .points
                .windows(2)
                .all(|two| two[0].0 < two[1].0 && two[0].1 > two[1].1),
            "{curve:?}"
        );
    }
    true
}

/// Reads `bytes` as a record file, under several options; whether any of them reads it.
///
/// # Panics
/// A problem without a file or a remedy, a component without samples or with one that is not
/// finite, or with more of them than the file can hold.
pub fn check_record(bytes: &[u8]) -> bool {
    let plain = ReadOptions::default();
    let told = ReadOptions {
        unit: Some("g".to_owned()),
        dt_s: Some(0.01),
        ..ReadOptions::default()
    };
    let resampled = ReadOptions {
        unit: Some("cm/s2".to_owned()),
        uneven_dt_s: Some(0.01),
        ..ReadOptions::default()
    };
    // All of them, even after one has read the bytes.
    [plain, told, resampled]
        .map(|options| check_with(bytes, &options))
        .contains(&true)
}

fn check_with(bytes: &[u8], options: &ReadOptions) -> bool {
    // A folder that does not exist: no reader finds a second file in it.
    match parse_motions(bytes.to_vec(), Path::new("/nowhere/record.dat"), options) {
        Err(error) => {
            assert!(!error.problems.is_empty());
            for problem in &error.problems {
                assert!(
                    problem.path.is_some() && !problem.message.is_empty(),
                    "{problem:?}"
                );
                assert!(
                    problem.line.is_some() || problem.hint.is_some(),
                    "{problem:?}"
                );
                // Each line ends with a byte of its own, and an error may be after the last.
                assert!(
                    problem
                        .line
                        .is_none_or(|line| (1..=bytes.len() + 1).contains(&line)),
                    "{problem:?}"
                );
            }
            false
        }
        Ok(file) => {
            assert!(!file.components.is_empty());
            let mut total = 0;
            for one in &file.components {
                let accel_m_s2 = one.motion.accel_m_s2();
                assert!(accel_m_s2.iter().all(|a| a.is_finite()) && one.motion.dt_s() > 0.0);
                total += accel_m_s2.len();
                // Steim-2 packs seven samples into four bytes, text at best one into two.
                // Interpolation may add any number.
                let is_interpolated = file
                    .notes
                    .iter()
                    .any(|note| note.kind == NoteKind::Interpolated);
                assert!(accel_m_s2.len() <= 2 * bytes.len() || is_interpolated);
            }
            // But no more than one motion may have, however many components there are.
            assert!(total <= MAX_SAMPLES.max(2 * bytes.len()));
            true
        }
    }
}
