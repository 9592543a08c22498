//! Buildings: their modes from periods or from tables in files, and their description in words.

mod doubt;
mod words;

use std::path::{Path, PathBuf};

use freestand::building::{Building, BuildingError, Damping, Mode, ModeQuantity, Model};
use freestand::code_spectrum::PeriodCode;

use freestand_input::file::{InputFile, file_name};
use freestand_input::problem::Problem;
use freestand_input::words::{counted, number, percent};
use freestand_output::answer_of;
use freestand_records::tables::{load_table, read_modes, read_storeys};

pub use doubt::{BuildingDoubt, PeriodFrom};
pub(crate) use words::axis_key;
pub(crate) use words::{GivenStoreys, resolve_with};
pub use words::{MAX_STOREYS, resolve};

/// Default number of storeys.
pub const DEFAULT_STOREYS: u32 = 30;
/// Default storey height; also the one with which a height alone becomes storeys \[m\].
pub const DEFAULT_STOREY_HEIGHT_M: f64 = 3.2;
/// Default α₀ of the shear-flexure beam: a frame combined with walls.
pub const DEFAULT_SHEAR_FLEXURE_RATIO: f64 = 5.0;
/// Default damping of each mode.
pub const DEFAULT_DAMPING_RATIO: f64 = freestand::oscillator::DAMPING_RATIO;
/// Default number of modes.
pub const DEFAULT_MODES: usize = 10;

/// An effective mass ratio above 1, up to this value, is 1 with a rounding error.
const LARGEST_ROUNDED_RATIO: f64 = 1.01;

/// The source of the modes of one axis.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisModel {
    /// A uniform shear-flexure beam.
    Beam {
        /// Fundamental period \[s\].
        period_s: f64,
        /// `α₀ = H √(GA/EI)`.
        shear_flexure_ratio: f64,
    },
    /// A file with one row for each storey: height, mass, stiffness.
    StoreyTable(PathBuf),
    /// A file with one row for each mode: period, participation, shape at the floors.
    ModeTable(PathBuf),
}

/// A request for one horizontal axis of a building.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisRequest {
    /// The source of its modes.
    pub model: AxisModel,
    /// Damping of modes for which a table does not state it.
    pub damping: Damping,
    /// Number of modes; `None`: [`DEFAULT_MODES`], or fewer if the building has fewer.
    pub modes: Option<usize>,
}

/// One horizontal axis of a building.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its modes.
    pub building: Building,
    /// Height of the roof \[m\], if a table states it.
    pub height_m: Option<f64>,
    /// The table that it was read from, if any.
    pub table: Option<BuildingTable>,
    /// What may be wrong with it.
    pub doubts: Vec<BuildingDoubt>,
}

/// A table that a building was read from.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildingTable {
    /// The key of a study that names it: `storey_table` or `mode_table`.
    pub key: &'static str,
    /// The file.
    pub file: InputFile,
    /// Its content.
    pub text: Vec<u8>,
    /// Whether it states the damping of every mode, so that no other is used.
    pub states_damping: bool,
    /// Whether it is of the second axis.
    pub is_across: bool,
}

/// The building and its modes.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildingInput {
    /// Number of storeys.
    pub storeys: usize,
    /// Height of the roof \[m\].
    pub height_m: f64,
    /// Height of one storey \[m\]; `None` if a table states each.
    pub storey_height_m: Option<f64>,
    /// Its modes along the first horizontal axis.
    pub along: Building,
    /// Its modes along the second; `None`: as along the first.
    pub across: Option<Building>,
    /// What the period is from.
    pub period_from: PeriodFrom,
    /// The code whose formula gave a period, if one did.
    pub period_code: Option<PeriodCode>,
    /// The same for the second axis, if it has its own.
    pub across_from: Option<PeriodFrom>,
    /// The tables that it was read from.
    pub tables: Vec<BuildingTable>,
    /// What may be wrong with it.
    pub doubts: Vec<BuildingDoubt>,
}

impl BuildingInput {
    /// Zeros to append to a ground motion so that the floors ring down along both axes \[s\].
    pub fn tail_s(&self) -> f64 {
        self.across
            .as_ref()
            .map_or(0.0, Building::tail_s)
            .max(self.along.tail_s())
    }
}

/// Makes the modes of an axis; reads its table if it has one.
///
/// # Errors
/// A file that cannot be read or is not such a table (with the line); values that describe no
/// possible building.
pub fn axis(request: &AxisRequest) -> Result<Axis, Problem> {
    match &request.model {
        AxisModel::Beam {
            period_s,
            shear_flexure_ratio,
        } => {
            let modes = request.modes.unwrap_or(DEFAULT_MODES);
            let building = Building::beam(*period_s, 0.0, *shear_flexure_ratio, modes)
                .and_then(|building| building.with_damping(&request.damping))
                .map_err(|error| refused(&error))?;
            Ok(Axis {
                building,
                height_m: None,
                table: None,
                doubts: Vec::new(),
            })
        }
        AxisModel::StoreyTable(path) => {
            storeys(path, request).map_err(|problem| problem.in_file(path))
        }
        AxisModel::ModeTable(path) => modes(path, request).map_err(|problem| problem.in_file(path)),
    }
}

fn storeys(path: &Path, request: &AxisRequest) -> Result<Axis, Problem> {
    let text = load_table(path)?;
    let table = read_storeys(&text)?;
    let modes = request
        .modes
        .unwrap_or_else(|| table.storeys.len().clamp(1, DEFAULT_MODES));
    let building =
        Building::shear(&table.storeys, &request.damping, modes).map_err(|error| match error {
            BuildingError::Storey { storey, .. } => at_row(refused(&error), &table.lines, storey),
            _ => refused(&error),
        })?;
    let heights_m: Vec<f64> = table.storeys.iter().map(|storey| storey.height_m).collect();
    let doubt = look_like_elevations(&heights_m).then(|| BuildingDoubt::LooksLikeElevations {
        file: file_name(path).unwrap_or_default(),
    });
    let file = InputFile::new(path, &text);
    Ok(Axis {
        building,
        height_m: Some(heights_m.iter().sum()),
        table: Some(BuildingTable {
            key: "storey_table",
            file,
            text,
            states_damping: false,
            is_across: false,
        }),
        doubts: doubt.into_iter().collect(),
    })
}

/// Whether heights increase (or decrease, from the roof down) by nearly equal steps that could be
/// storeys. Heights of real storeys differ by a few decimetres at most: less than a third of the
/// lowest.
fn look_like_elevations(heights_m: &[f64]) -> bool {
    let steps_m: Vec<f64> = heights_m.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let (Some(&first), true) = (steps_m.first(), heights_m.len() >= 3) else {
        return false;
    };
    let least_m = heights_m.iter().copied().fold(f64::INFINITY, f64::min);
    let sizes = || steps_m.iter().map(|step| step.abs());
    let (smallest_m, largest_m) = (
        sizes().fold(f64::INFINITY, f64::min),
        sizes().fold(0.0, f64::max),
    );
    steps_m.iter().all(|step| step.signum() == first.signum())
        && largest_m <= 2.0 * smallest_m
        && smallest_m >= least_m / 3.0
}

fn modes(path: &Path, request: &AxisRequest) -> Result<Axis, Problem> {
    let text = load_table(path)?;
    let mut table = read_modes(&text)?;
    for ratio in table
        .modes
        .iter_mut()
        .filter_map(|mode| mode.effective_mass_ratio.as_mut())
    {
        // Ratios in tables have few digits: a ratio just above 1 is a rounded 1.
        if *ratio > 1.0 && *ratio <= LARGEST_ROUNDED_RATIO {
            *ratio = 1.0;
        }
    }
    let roof_m = table.heights_m.last().copied().unwrap_or(1.0);
    let levels_ratio: Vec<f64> = table
        .heights_m
        .iter()
        .map(|height_m| height_m / roof_m)
        .collect();
    let building =
        Building::from_modes(&levels_ratio, &table.modes, &request.damping).map_err(|error| {
            match error {
                BuildingError::ModeValue { mode, .. } => {
                    at_row(refused(&error), &table.lines, mode)
                }
                BuildingError::ModeDamping { mode, .. }
                    if table.modes.iter().any(|m| m.damping_ratio.is_some()) =>
                {
                    at_row(refused(&error), &table.lines, mode)
                }
                BuildingError::Modes { at_most, .. } => refused(&error).hint(format!(
                    "delete the modes with the least mass until {at_most} are left"
                )),
                _ => refused(&error),
            }
        })?;
    let name = file_name(path).unwrap_or_default();
    let states_damping = table.modes.iter().all(|mode| mode.damping_ratio.is_some());
    let doubts = building.doubts().into_iter();
    let doubts = doubts.map(|doubt| BuildingDoubt::Modes {
        file: name.clone(),
        doubt,
    });
    let doubts = doubts.collect();
    Ok(Axis {
        building,
        height_m: Some(roof_m),
        table: Some(BuildingTable {
            key: "mode_table",
            file: InputFile::new(path, &text),
            text,
            states_damping,
            is_across: false,
        }),
        doubts,
    })
}

fn at_row(problem: Problem, lines: &[usize], row: usize) -> Problem {
    match row.checked_sub(1).and_then(|index| lines.get(index)) {
        Some(&line) => problem.at_line(line),
        None => problem,
    }
}

fn refused(error: &BuildingError) -> Problem {
    let hint = match error {
        BuildingError::Period { .. } => {
            "check the period, or the units of mass and stiffness in the table"
        }
        BuildingError::RayleighModes { .. } => {
            "give two modes, such as `rayleigh_modes = \"1, 3\"`"
        }
        BuildingError::ModeDamping { .. } => {
            "a ratio in percent needs the heading \"damping [%]\"; Rayleigh damping grows with the frequency: keep \
             fewer modes, or give a higher second mode"
        }
        BuildingError::ModeValue {
            quantity: ModeQuantity::EffectiveMass,
            ..
        } => "shares in percent need the heading \"effective mass [%]\"",
        BuildingError::RoofShare { .. } => {
            "take participation factors and shapes from one export, in the same units, normalisation and direction"
        }
        BuildingError::Storeys { .. } => "combine storeys, or use the modes of your own model",
        BuildingError::Modes { .. } => {
            "a building has no more modes than storeys, and only the first few matter"
        }
        _ => "correct the value",
    };
    Problem::value(error.to_string(), hint)
}

/// The kind of building, in words.
pub fn model_words(building: &Building) -> String {
    match building.model() {
        Model::Beam {
            shear_flexure_ratio,
        } => format!(
            "uniform shear-flexure beam (Miranda and Taghavi 2005), α₀ = H√(GA/EI) = {}",
            number(shear_flexure_ratio, 4)
        ),
        Model::Shear { storeys } => {
            format!(
                "shear building of {} with given masses and stiffnesses",
                counted(storeys, "storey")
            )
        }
        Model::Table { floors } => format!("modes of a table with {}", counted(floors, "floor")),
    }
}

/// A mode of a building.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeReport(pub Mode);

answer_of!(ModeReport as mode {
    /// Of vibration.
    period_s: f64 = mode.0.period_s();
    /// Of critical damping.
    damping_ratio: f64 = mode.0.damping_ratio();
    /// Γ.
    participation_ratio: f64 = mode.0.participation_ratio();
    /// The share of the mass, where masses are known.
    effective_mass_ratio: Option<f64> = mode.0.effective_mass_ratio();
});

/// One ratio, or those of the first and the last mode.
pub fn damping_words(building: &Building) -> String {
    match (building.damping_ratio(), building.modes()) {
        (Some(ratio), _) => format!("{} in every mode", percent(ratio, 1)),
        (None, [first, .., last]) => format!(
            "{} in the first mode to {} in the last",
            percent(first.damping_ratio(), 1),
            percent(last.damping_ratio(), 1)
        ),
        (None, _) => "–".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use freestand::building::ModalDoubt;

    use super::*;

    fn request(model: AxisModel) -> AxisRequest {
        AxisRequest {
            model,
            damping: Damping::Uniform(0.05),
            modes: None,
        }
    }

    fn file(text: &str) -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tower.csv");
        std::fs::write(&path, text).unwrap();
        (folder, path)
    }

    /// Two equal storeys: ω₁ = 2√(k/m) sin 18°.
    #[test]
    fn a_table_of_storeys_becomes_a_building() {
        let (_folder, path) = file("height [m],mass [t],stiffness [kN/mm]\n3,100,100\n3,100,100\n");
        let axis = axis(&request(AxisModel::StoreyTable(path))).unwrap();
        let omega = 2.0 * 1000.0f64.sqrt() * 0.1f64.mul_add(std::f64::consts::PI, 0.0).sin();
        assert!((std::f64::consts::TAU / axis.building.period_s() / omega - 1.0).abs() < 1e-14);
        assert_eq!((axis.height_m, axis.building.modes().len()), (Some(6.0), 2));
        assert_eq!(axis.table.map(|table| table.key), Some("storey_table"));
    }

    #[test]
    fn errors_name_the_row() {
        let cases = [
            (
                "height [m],mass [t],stiffness [kN/mm]\n# base\n3,100,100\n3,0,100\n",
                true,
                "tower.csv:4: the mass of storey 2",
            ),
            (
                "period [s],participation,effective mass,3 m\n1,1,78,1\n",
                false,
                "tower.csv:2: the effective mass of mode 1",
            ),
            (
                "period [s],participation,damping,3 m\n1,1,0.05,1\n0.5,1,5,1\n",
                false,
                "tower.csv:3: the damping ratio of mode 2",
            ),
        ];
        for (text, storeys, said) in cases {
            let (_folder, path) = file(text);
            let model = if storeys {
                AxisModel::StoreyTable(path)
            } else {
                AxisModel::ModeTable(path)
            };
            let problem = axis(&request(model)).unwrap_err();
            assert!(
                problem.to_string().contains(said) && problem.hint.is_some(),
                "{problem}"
            );
        }
    }

    #[test]
    fn doubtful_modes_are_said() {
        let (_folder, path) = file("period [s],participation,effective mass [%],3 m\n1,1.9,78,1\n");
        let axis = axis(&request(AxisModel::ModeTable(path))).unwrap();
        let of_table = |doubt| BuildingDoubt::Modes {
            file: "tower.csv".to_owned(),
            doubt,
        };
        assert_eq!(
            axis.doubts,
            [
                of_table(ModalDoubt::EffectiveMass { sum_ratio: 0.78 }),
                of_table(ModalDoubt::RoofShare { sum_ratio: 1.9 })
            ]
        );
    }

    /// Factors of a program that normalises by mass in kg, with shapes of one that does so in t.
    #[test]
    fn modes_of_two_normalisations_are_refused() {
        for factor in [1300.0, 30.6, 3.1, 0.2, -1.3] {
            let (_folder, path) = file(&format!("period [s],participation,3 m\n1,{factor},1\n"));
            let problem = axis(&request(AxisModel::ModeTable(path))).unwrap_err();
            assert!(
                problem.hint.is_some() && problem.to_string().contains("at the roof"),
                "{problem}"
            );
        }
    }

    #[test]
    fn a_mass_above_one_by_rounding_is_one() {
        let of = |mass: &str| {
            let (_folder, path) = file(&format!(
                "period [s],participation,effective mass,3 m\n1,1,{mass},1\n"
            ));
            axis(&request(AxisModel::ModeTable(path)))
                .map(|axis| axis.building.modes()[0].effective_mass_ratio())
        };
        assert_eq!((of("1.0005"), of("1.01")), (Ok(Some(1.0)), Ok(Some(1.0))));
        assert!(of("1.011").is_err());
    }

    #[test]
    fn too_many_modes_are_not_too_few_storeys() {
        let rows: String = (1..=51)
            .map(|i| format!("{},0.02,1\n", 1.0 / f64::from(i)))
            .collect();
        let (_folder, path) = file(&format!("period [s],participation,3 m\n{rows}"));
        let hint = axis(&request(AxisModel::ModeTable(path)))
            .unwrap_err()
            .hint
            .unwrap();
        assert_eq!(
            hint,
            "delete the modes with the least mass until 50 are left"
        );
    }

    #[test]
    fn elevations_in_place_of_heights_are_said() {
        let said = |heights: &[f64]| {
            let rows: String = heights.iter().map(|h| format!("{h},100,100\n")).collect();
            let (_folder, path) = file(&format!("height [m],mass [t],stiffness [kN/mm]\n{rows}"));
            axis(&request(AxisModel::StoreyTable(path)))
                .unwrap()
                .doubts
                .len()
        };
        for elevations in [
            &[4.0, 7.2, 10.4, 13.6][..],
            &[3.0, 6.0, 9.0],
            &[10.4, 7.2, 4.0],
            &[6.0, 8.8, 11.5],
        ] {
            assert_eq!(said(elevations), 1, "{elevations:?}");
        }
        // A tall entrance, storeys that grow or shrink, two rows alone.
        for heights in [
            &[4.0, 3.2, 3.2][..],
            &[6.0, 3.0, 2.8],
            &[3.0, 3.2, 3.4],
            &[2.8, 3.2, 4.0],
            &[3.0, 6.0],
        ] {
            assert_eq!(said(heights), 0, "{heights:?}");
        }
        let (_folder, path) =
            file("elevation [m],mass [t],stiffness [kN/mm]\n4,100,100\n7,100,100\n");
        let problem = axis(&request(AxisModel::StoreyTable(path))).unwrap_err();
        assert!(
            problem
                .to_string()
                .contains("tower.csv:1: the column \"elevation\""),
            "{problem}"
        );
    }

    /// With any byte of a table changed, it is read or refused, without a panic or a number that is
    /// not finite.
    #[test]
    fn no_byte_of_a_table_brings_it_down() {
        let (folder, path) = file("");
        let tables = [
            (
                "storey,height [m],mass [t],stiffness [kN/mm]\n1,3,1e2,9e1\n2,3,80,9e-1\n",
                true,
            ),
            (
                "mode,period [s],participation,damping [%],3 m,6 m\n1,0.8,1.2,5,0.6,1e0\n2,0.3,-0.2,,-1.1,1\n",
                false,
            ),
        ];
        for (text, storeys) in tables {
            for at in 0..text.len() {
                for byte in *b"\0,;\n\"-9e.#\xff" {
                    let mut bytes = text.as_bytes().to_vec();
                    bytes[at] = byte;
                    std::fs::write(&path, bytes).unwrap();
                    let path = path.clone();
                    let model = if storeys {
                        AxisModel::StoreyTable(path)
                    } else {
                        AxisModel::ModeTable(path)
                    };
                    if let Ok(axis) = axis(&request(model)) {
                        let shares = axis
                            .building
                            .modes()
                            .iter()
                            .map(|mode| mode.share_ratio(1.0));
                        assert!(
                            shares.chain(axis.height_m).all(f64::is_finite),
                            "{at} {byte}"
                        );
                    }
                }
            }
        }
        drop(folder);
    }
}
