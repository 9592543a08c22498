//! `worlds.csv`: the motions and the building of every world, on every floor with objects.

use freestand::G0_M_S2;
use freestand::motion::Motion;
use freestand::oscillator::response_spectrum;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_output::folder::OutputFolder;
use freestand_output::rows::{broken, csv_writer};
use freestand_records::horizontal::HorizontalMotion;
use freestand_study::study::{Ground, Study};
use rayon::prelude::*;

use super::csv::push_field;
use super::table::Cell;
use freestand_assess::portfolio::Lived;
use freestand_assess::worlds::{HorizontalPeaks, Worlds};

/// The file's name.
pub const WORLDS_NAME: &str = "worlds.csv";

/// Periods of the ground spectra \[s\].
const PERIODS_S: [f64; 4] = [0.2, 0.5, 1.0, 2.0];

/// Damping of the ground spectra, which is that of the spectra of codes.
const DAMPING_RATIO: f64 = 0.05;

/// Worlds between two writes, each of which may be a stop: a second or two of work.
const BLOCK: u32 = 64;

const HEADER: [&str; 19] = [
    "world",
    "level_ratio",
    "period_s",
    "damping_ratio",
    "record",
    "pga_x_g",
    "pga_y_g",
    "pfa_x_g",
    "pfa_y_g",
    "sa_0.2_x_g",
    "sa_0.5_x_g",
    "sa_1_x_g",
    "sa_2_x_g",
    "sa_0.2_y_g",
    "sa_0.5_y_g",
    "sa_1_y_g",
    "sa_2_y_g",
    "pulse_period_s",
    "pulse_velocity_m_s",
];

/// Writes the file: a row for each world and floor, worlds first. Motions are made on the current
/// thread pool and dropped again; only the rows of some worlds are in memory.
///
/// The columns of y are empty where there is one component, those of the ground and of the building
/// where the study gives the motions of floors.
///
/// # Errors
/// A motion that cannot be generated, a run that is stopped by `go_on`, or a full disk.
pub fn write_worlds(
    folder: &OutputFolder,
    study: &Study,
    worlds: &Worlds,
    lived: &Lived,
    mut go_on: impl FnMut(u32) -> Result<(), Problems>,
) -> Result<(), Problems> {
    // The names in turn: only a ground motion knows its own.
    let names = match &study.ground {
        Ground::OnFloors => study.ground.names(&study.levels),
        _ => Vec::new(),
    };
    let mut file = folder.begin(WORLDS_NAME)?;
    file.write(&csv_of([HEADER.map(Cell::text).to_vec()])?)?;
    for first in (0..lived.worlds).step_by(BLOCK as usize) {
        go_on(first)?;
        let block = first..lived.worlds.min(first + BLOCK);
        let made: Vec<Result<Vec<Vec<Cell>>, Problems>> = block
            .into_par_iter()
            .map(|world| rows(worlds, world, &lived.levels, &names))
            .collect();
        for rows in made {
            file.write(&csv_of(rows?)?)?;
        }
    }
    Ok(file.finish()?)
}

/// The rows of a world, one for each level.
fn rows<'a>(
    worlds: &Worlds,
    world: u32,
    levels: &[f64],
    names: &'a [String],
) -> Result<Vec<Vec<Cell<'a>>>, Problems> {
    let ground = worlds.ground(world, 0)?;
    let building = worlds.building(world)?;
    let named = names
        .get(world as usize % names.len().max(1))
        .map(|name| Cell::text(name));
    let record = named
        .unwrap_or_else(|| Cell::owned(ground.as_ref().and_then(|ground| ground.record.clone())));
    let motions = ground
        .as_ref()
        .map(|ground| components(&ground.motion))
        .unwrap_or_default();
    let [along, across] = motions.map(spectrum_g);
    let spectra = [along?, across?].concat();
    let pulse = worlds.pulse(world)?;
    let pulse = [
        pulse.map(|(pulse, _)| pulse.shape.period_s),
        pulse.map(|(_, amplitude_m_s)| amplitude_m_s),
    ];
    let floors = worlds.floor_peaks(world, levels)?;
    let peaks = motions.map(|motion| motion.map(Motion::peak_m_s2));
    let row = |(level_ratio, floor): (&f64, &HorizontalPeaks)| {
        let building = [
            building.map(|one| one.period_s),
            building.and_then(|one| one.damping_ratio),
        ];
        let peaks = [peaks, [Some(floor.along_m_s2), floor.across_m_s2]]
            .concat()
            .into_iter()
            .map(|peak| peak.map(|peak_m_s2| peak_m_s2 / G0_M_S2));
        let mut cells = vec![
            Cell::Count(u64::from(world)),
            Cell::number(Some(*level_ratio)),
        ];
        cells.extend(building.map(Cell::number));
        cells.push(record.clone());
        let shaking = peaks.chain(spectra.iter().copied()).chain(pulse);
        cells.extend(shaking.map(Cell::number));
        cells
    };
    Ok(levels.iter().zip(&floors).map(row).collect())
}

fn components(motion: &HorizontalMotion) -> [Option<&Motion>; 2] {
    [Some(&motion.along), motion.across.as_ref()]
}

/// Pseudo-accelerations at [`PERIODS_S`] \[g\].
fn spectrum_g(motion: Option<&Motion>) -> Result<[Option<f64>; 4], Problem> {
    let Some(motion) = motion else {
        return Ok([None; 4]);
    };
    let failed = |error: freestand::oscillator::OscillatorError| {
        Problem::new(
            ProblemKind::Computation,
            format!("a ground spectrum cannot be computed: {error}"),
        )
    };
    let found = response_spectrum(motion, DAMPING_RATIO, &PERIODS_S).map_err(failed)?;
    let mut values = found.psa_m_s2.into_iter().map(|psa| psa / G0_M_S2);
    Ok([(); 4].map(|()| values.next()))
}

/// Rows as CSV, written as `objects.csv` is.
pub(super) fn csv_of<'a>(
    rows: impl IntoIterator<Item = Vec<Cell<'a>>>,
) -> Result<Vec<u8>, Problem> {
    let mut writer = csv_writer();
    let mut text = String::new();
    for row in rows {
        for cell in &row {
            text.clear();
            push_field(&mut text, cell);
            writer.write_field(&text).map_err(broken)?;
        }
        writer.write_record(None::<&[u8]>).map_err(broken)?;
    }
    writer
        .into_inner()
        .map_err(|error| broken(csv::Error::from(error.into_error())))
}
