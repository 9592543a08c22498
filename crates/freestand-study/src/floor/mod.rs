//! Floors of a building under ground motions: request → report.

use freestand::G0_M_S2;
use freestand::building::{Building, FloorPeaks, Mode, floor_motions, floor_peaks};
use freestand::code_spectrum::CodeSpectrum;
use freestand::measures::cumulative_trapezoid;
use freestand::motion::Motion;

use crate::building::{BuildingInput, ModeReport, damping_words, model_words};
use crate::inspect::check_upsampling;
use crate::recorded::ReadMotion;
use crate::statistics::{QUANTILES, ranked_quantile};
use crate::study::{DEFAULT_VERTICAL_AMPLIFICATION, RecordedMotion};
use crate::target::code_parts;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::significant;
use freestand_output::answer;
use freestand_output::answer::Answer;
use freestand_output::facts::table;
use freestand_output::table::Table;
use freestand_records::horizontal::HorizontalMotion;
use freestand_records::notes::{Note, NoteKind};

mod spectra;

pub use spectra::{LevelSpectra, SpectraReport, SpectraRequest, largest_psa_m_s2, spectra_table};

/// The levels where none are given: half of the height, and the roof.
pub const DEFAULT_LEVELS: &str = "0.5, 1.0";

/// A request for floor motions: a building and the levels.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorRequest {
    /// The building.
    pub building: BuildingInput,
    /// Shares of the height.
    pub levels_ratio: Vec<f64>,
    /// Whether each level is the floor above the one before it, so that their drifts are those of
    /// storeys.
    pub is_storeys: bool,
    /// Zeros appended to the record \[s\].
    pub tail_s: f64,
    /// Points in each sample interval at which peaks are taken; the ground is linear between
    /// samples.
    pub upsample: usize,
    /// Response spectra of the floors, where requested.
    pub spectra: Option<SpectraRequest>,
    /// Vertical acceleration of the levels above the ground over that of the ground; `None`: 1.
    pub vertical_amplification_ratio: Option<f64>,
    /// A code, whose accelerations of rigid parts are compared with those of the floors.
    pub code: Option<CodeSpectrum>,
}

/// The ground and every floor of a building as shares of its height: those of its table, or of
/// equal storeys.
pub fn every_floor(building: &Building, storeys: usize) -> Vec<f64> {
    match building.floors_ratio() {
        [] => (0..=storeys)
            .map(|floor| floor as f64 / storeys as f64)
            .collect(),
        floors => std::iter::once(0.0).chain(floors.iter().copied()).collect(),
    }
}

/// The floors under one motion: report, motions, spectra, notes.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionFloors {
    /// Their report.
    pub report: MotionReport,
    /// The motions of the levels, as long as the record and its tail.
    pub floors: Vec<HorizontalMotion>,
    /// The vertical motions of the levels, of the same length; none if the record has none.
    pub verticals: Vec<Motion>,
    /// Pseudo-accelerations, `[level][damping][period]` \[g\]; empty where not requested.
    pub spectra_g: Vec<Vec<Vec<f64>>>,
    /// Warnings for the user.
    pub notes: Vec<Note>,
}

answer! {
    /// The report on the floors under all motions; of several, the median of each number.
    pub struct FloorReport named {
        motion: String,
        processing: Vec<String>,
        building_height_m: f64,
        model: String,
        damping: String,
        damping_ratio: Option<f64>,
        shear_flexure_ratio: Option<f64>,
        pga_g: f64,
        modes: Vec<FloorMode>,
        across: Option<AxisReport>,
        levels: Vec<LevelReport>,
        motions: Vec<MotionReport>,
        spectra: Option<SpectraReport>,
        /// The clause of the code that `code_part_g` of the levels is from.
        code_clause: Option<&'static str>,
    }

    /// The second axis, where it differs from the first.
    #[expect(
        missing_docs,
        reason = "the names are those of the JSON document and state the units"
    )]
    pub struct AxisReport of (axis: &Building) {
        model: String = model_words(axis);
        damping: String = damping_words(axis);
        modes: Vec<FloorMode> = mode_reports(axis);
    }

    /// A mode of the building.
    pub struct FloorMode of (mode: &Mode) {
        mode: ModeReport = ModeReport(mode.clone()) => flat;
        /// Γφ at the roof.
        roof_share_ratio: f64 = mode.share_ratio(1.0);
    }

    /// One level over all motions.
    pub struct LevelReport {
        profile: LevelProfile = flat,
        /// The file of the floor motion, where there is one motion and it was written.
        path: Option<String>,
    }

    /// A row of the profile.
    pub struct LevelProfile named {
        level_ratio: f64,
        height_m: f64,
        pfa_g: f64,
        /// 16 and 84 % over several motions.
        pfa_g_p16: Option<f64>,
        pfa_g_p84: Option<f64>,
        pfv_m_s: f64,
        pfd_m: f64,
        drift_ratio: Option<f64>,
        /// The acceleration of a rigid part by the code.
        code_part_g: Option<f64>,
        vertical: Option<VerticalPeak> = flat,
    }

    /// Of motions with a vertical component.
    pub struct VerticalPeak {
        /// Peak vertical acceleration.
        pfa_vertical_g: f64,
    }

    /// The part of the report on one motion.
    pub struct MotionReport named {
        motion: String,
        processing: Vec<String>,
        components: usize,
        pga_g: f64,
        levels: Vec<MotionLevel>,
    }

    /// One level under one motion. Of two components `pfa_g` and `pfv_m_s` are the largest over all
    /// directions; displacement (relative to the ground) and drift are the larger of the two axes.
    pub struct MotionLevel named {
        level_ratio: f64,
        pfa_g: f64,
        pfa_along_g: f64,
        pfa_across_g: Option<f64>,
        /// Direction of the largest, from the first axis towards the second, 0 to 180; null for one
        /// component.
        pfa_direction_deg: Option<f64>,
        pfv_m_s: f64,
        pfd_m: f64,
        drift_ratio: Option<f64>,
        path: Option<String>,
        /// Peak vertical acceleration, if the record has a vertical component.
        pfa_vertical_g: Option<f64>,
        vertical_path: Option<String>,
    }
}

/// Calculates the floors under one motion.
///
/// # Errors
/// A tail or a number of samples that does not fit in memory; floor motions that overflow.
pub fn floors(read: &ReadMotion, request: &FloorRequest) -> Result<MotionFloors, Problem> {
    let recorded = &read.motion;
    let along = AxisFloors::new(&recorded.motion, &request.building.along, request)?;
    let across_building = request
        .building
        .across
        .as_ref()
        .unwrap_or(&request.building.along);
    let across = recorded.across.as_ref();
    let across = across
        .map(|second| AxisFloors::new(&second.motion, across_building, request))
        .transpose()?;
    let mut notes = read.notes.clone();
    let mut levels = Vec::with_capacity(request.levels_ratio.len());
    for (i, &level_ratio) in request.levels_ratio.iter().enumerate() {
        let axes: Vec<&AxisFloors> = std::iter::once(&along).chain(&across).collect();
        notes.extend(late_peak(level_ratio, &axes, i));
        levels.push(motion_level(level_ratio, &axes, i, request)?);
    }
    let verticals = verticals(recorded, request)?;
    for (level, vertical) in levels.iter_mut().zip(&verticals) {
        level.pfa_vertical_g = Some(vertical.peak_m_s2() / G0_M_S2);
    }
    let fine: Vec<HorizontalMotion> =
        pairs(along.fine, across.as_ref().map(|axis| axis.fine.clone()));
    let spectra_g = match &request.spectra {
        Some(spectra) => fine
            .iter()
            .map(|floor| spectra::of_floor(floor, spectra))
            .collect::<Result<_, _>>()?,
        None => Vec::new(),
    };
    Ok(MotionFloors {
        report: MotionReport {
            motion: recorded.name.clone(),
            processing: recorded.processing.clone(),
            components: if across.is_some() { 2 } else { 1 },
            pga_g: recorded.as_used().peak_m_s2() / G0_M_S2,
            levels,
        },
        floors: pairs(along.floors, across.map(|axis| axis.floors)),
        verticals,
        spectra_g,
        notes,
    })
}

/// The vertical motion of the ground at every level, amplified above the ground.
fn verticals(recorded: &RecordedMotion, request: &FloorRequest) -> Result<Vec<Motion>, Problem> {
    let Some(vertical) = &recorded.vertical else {
        return Ok(Vec::new());
    };
    let padded = with_tail(&vertical.motion, request.tail_s)?;
    let amplification = request
        .vertical_amplification_ratio
        .unwrap_or(DEFAULT_VERTICAL_AMPLIFICATION);
    let at = |&level_ratio: &f64| {
        let factor = if level_ratio == 0.0 {
            1.0
        } else {
            amplification
        };
        padded
            .scaled(factor)
            .map_err(|error| failed(error.to_string()))
    };
    request.levels_ratio.iter().map(at).collect()
}

fn failed(message: String) -> Problem {
    Problem::new(ProblemKind::Computation, message).hint("check the record and its scale")
}

fn pairs(along: Vec<Motion>, across: Option<Vec<Motion>>) -> Vec<HorizontalMotion> {
    let across = across.map_or_else(
        || vec![None; along.len()],
        |across| across.into_iter().map(Some).collect(),
    );
    let both = along.into_iter().zip(across);
    both.map(|(along, across)| HorizontalMotion { along, across })
        .collect()
}

/// The levels along one axis.
struct AxisFloors {
    floors: Vec<Motion>,
    /// With more samples in each interval, where requested.
    fine: Vec<Motion>,
    peaks: Vec<FloorPeaks>,
    /// Peaks at the samples of the record, and those with the building's ring-down after it.
    within_m_s2: Vec<f64>,
    later_m_s2: Vec<f64>,
}

impl AxisFloors {
    fn new(ground: &Motion, building: &Building, request: &FloorRequest) -> Result<Self, Problem> {
        let ground = &with_tail(ground, request.tail_s)?;
        check_upsampling(request.upsample, ground.accel_m_s2().len())?;
        let failed = |error: freestand::building::BuildingError| failed(error.to_string());
        let levels_ratio = &request.levels_ratio;
        let floors = floor_motions(ground, building, levels_ratio).map_err(failed)?;
        let later = floor_peaks(
            &with_tail(ground, building.tail_s())?,
            building,
            levels_ratio,
        )
        .map_err(failed)?;
        let upsampled = (request.upsample > 1).then(|| ground.upsampled(request.upsample));
        let fine = match &upsampled {
            Some(ground) => floor_motions(ground, building, levels_ratio).map_err(failed)?,
            None => floors.clone(),
        };
        let peaks = floor_peaks(upsampled.as_ref().unwrap_or(ground), building, levels_ratio)
            .map_err(failed)?;
        Ok(Self {
            within_m_s2: floors.iter().map(Motion::peak_m_s2).collect(),
            later_m_s2: later.iter().map(|peak| peak.accel_m_s2).collect(),
            floors,
            fine,
            peaks,
        })
    }
}

/// The motion with its tail of zeros; a tail that does not fit in memory is refused.
fn with_tail(motion: &Motion, tail_s: f64) -> Result<Motion, Problem> {
    motion.with_zero_tail(tail_s).map_err(|error| {
        let message = format!("{tail_s} s of zeros at steps of {} s: {error}", motion.dt_s());
        Problem::value(
            message,
            "check `tail`, `period` and the time step of the record; ten periods of the building are enough",
        )
    })
}

fn motion_level(
    level_ratio: f64,
    axes: &[&AxisFloors],
    index: usize,
    request: &FloorRequest,
) -> Result<MotionLevel, Problem> {
    let gone = || {
        Problem::new(ProblemKind::Computation, "a level has no motion")
            .hint("this is a defect of freestand; please report it")
    };
    let on_level = axes
        .iter()
        .map(|axis| Some((axis.fine.get(index)?, axis.peaks.get(index)?)));
    let (fine, peaks): (Vec<&Motion>, Vec<&FloorPeaks>) = on_level
        .collect::<Option<Vec<_>>>()
        .ok_or_else(gone)?
        .into_iter()
        .unzip();
    let accelerations: Vec<&[f64]> = fine.iter().map(|motion| motion.accel_m_s2()).collect();
    let velocities: Vec<Vec<f64>> = fine
        .iter()
        .map(|motion| cumulative_trapezoid(motion.dt_s(), motion.accel_m_s2()))
        .collect();
    let velocities: Vec<&[f64]> = velocities.iter().map(Vec::as_slice).collect();
    let (pfa_m_s2, direction_deg) = largest(&accelerations);
    let larger = |of: fn(&FloorPeaks) -> f64| peaks.iter().map(|peak| of(peak)).fold(0.0, f64::max);
    let below_ratio = index
        .checked_sub(1)
        .and_then(|below| request.levels_ratio.get(below))
        .copied()
        .unwrap_or(0.0);
    let storey_m = (level_ratio - below_ratio) * request.building.height_m;
    let has_drift = request.is_storeys && storey_m > 0.0;
    Ok(MotionLevel {
        level_ratio,
        pfa_g: pfa_m_s2 / G0_M_S2,
        pfa_along_g: fine.first().map_or(0.0, |motion| motion.peak_m_s2()) / G0_M_S2,
        pfa_across_g: fine.get(1).map(|motion| motion.peak_m_s2() / G0_M_S2),
        pfa_direction_deg: direction_deg,
        pfv_m_s: largest(&velocities).0,
        pfd_m: larger(|peak| peak.displacement_m),
        drift_ratio: has_drift.then(|| larger(|peak| peak.drift_m) / storey_m),
        path: None,
        pfa_vertical_g: None,
        vertical_path: None,
    })
}

/// The largest value of one history, or the longest vector of two and its direction, 0 to 180
/// degrees.
fn largest(histories: &[&[f64]]) -> (f64, Option<f64>) {
    match histories {
        [along, across] => {
            let longest = along
                .iter()
                .zip(*across)
                .max_by(|a, b| a.0.hypot(*a.1).total_cmp(&b.0.hypot(*b.1)));
            let (x, y) = longest.map_or((0.0, 0.0), |(x, y)| (*x, *y));
            (x.hypot(y), Some(y.atan2(x).to_degrees().rem_euclid(180.0)))
        }
        _ => (
            histories
                .iter()
                .flat_map(|one| one.iter())
                .fold(0.0, |peak: f64, a| peak.max(a.abs())),
            None,
        ),
    }
}

/// A note where the floor reaches its peak only after the end of the record.
fn late_peak(level_ratio: f64, axes: &[&AxisFloors], index: usize) -> Option<Note> {
    let later = axes
        .iter()
        .filter_map(|axis| Some((axis.within_m_s2.get(index)?, *axis.later_m_s2.get(index)?)));
    let late = later
        .filter(|(within, later)| later > within)
        .map(|(_, later)| later)
        .reduce(f64::max)?;
    let late_g = late / G0_M_S2;
    let words = format!(
        "the floor reaches its peak of {} g only after the end of the record: let it ring down with `tail`",
        significant(late_g, 4)
    );
    Some(Note::of(&format!("level {level_ratio}"), NoteKind::LatePeak, words).amount(late_g, "g"))
}

impl FloorReport {
    /// The report of all motions, in their order; `None` where there are none.
    pub fn new(
        request: &FloorRequest,
        motions: Vec<MotionReport>,
        spectra: Option<SpectraReport>,
    ) -> Option<Self> {
        let first = motions.first()?.clone();
        let building = &request.building.along;
        let several = motions.len() > 1;
        let quantiles = |of: &dyn Fn(&MotionReport) -> Option<f64>| -> [Option<f64>; 3] {
            let mut values: Vec<f64> = motions.iter().filter_map(of).collect();
            QUANTILES.map(|quantile| ranked_quantile(&mut values, quantile).value())
        };
        let code = request.code.as_ref();
        let across_s = request
            .building
            .across
            .as_ref()
            .map_or(f64::INFINITY, Building::period_s);
        let period_s = building.period_s().min(across_s);
        let code = code.and_then(|code| {
            code_parts(
                code,
                Some(request.building.height_m),
                Some(period_s),
                &request.levels_ratio,
            )
        });
        let levels = request
            .levels_ratio
            .iter()
            .enumerate()
            .map(|(i, &level_ratio)| {
                let of = |value: fn(&MotionLevel) -> Option<f64>| {
                    quantiles(&|motion: &MotionReport| motion.levels.get(i).and_then(value))
                };
                let [p16, median, p84] = of(|level| Some(level.pfa_g));
                let median_of = |value| of(value)[1];
                let profile = LevelProfile {
                    level_ratio,
                    height_m: level_ratio * request.building.height_m,
                    pfa_g: median.unwrap_or_default(),
                    pfa_g_p16: p16.filter(|_| several),
                    pfa_g_p84: p84.filter(|_| several),
                    pfv_m_s: median_of(|level| Some(level.pfv_m_s)).unwrap_or_default(),
                    pfd_m: median_of(|level| Some(level.pfd_m)).unwrap_or_default(),
                    drift_ratio: median_of(|level| level.drift_ratio),
                    code_part_g: code.as_ref().and_then(|code| code.accel_g.get(i)).copied(),
                    vertical: median_of(|level| level.pfa_vertical_g)
                        .map(|pfa_vertical_g| VerticalPeak { pfa_vertical_g }),
                };
                let path = first
                    .levels
                    .get(i)
                    .and_then(|level| level.path.clone())
                    .filter(|_| !several);
                LevelReport { profile, path }
            });
        let levels = levels.collect();
        Some(Self {
            motion: first.motion,
            processing: first.processing,
            building_height_m: request.building.height_m,
            model: model_words(building),
            damping: damping_words(building),
            damping_ratio: building.damping_ratio(),
            shear_flexure_ratio: building.shear_flexure_ratio(),
            pga_g: quantiles(&|motion: &MotionReport| Some(motion.pga_g))[1].unwrap_or_default(),
            modes: mode_reports(building),
            across: request.building.across.as_ref().map(AxisReport::of),
            levels,
            motions,
            spectra,
            code_clause: code.map(|code| code.clause),
        })
    }

    /// The profile over the height as CSV.
    ///
    /// # Errors
    /// None in practice: see [`table`].
    pub fn profile_table(&self) -> Result<Table, Problem> {
        table(self.levels.iter().map(|level| level.profile.facts()))
    }
}

fn mode_reports(building: &Building) -> Vec<FloorMode> {
    building.modes().iter().map(FloorMode::of).collect()
}

#[cfg(test)]
mod tests;
