//! Buildings as tables: storeys with mass and stiffness, or modes with their shapes at the floors.

use std::path::Path;

use freestand::building::{Storey, TableMode};

use crate::text::cells::{Cells, wrong};
use crate::text::headings::Heading;
use crate::text::lines::check_text;
use freestand_input::file::load;
use freestand_input::problem::Problem;
use freestand_input::quantity::{self, Dimension, shorten};

const STOREYS: &str =
    "one row per storey from the ground up, under \"storey,height [m],mass [t],stiffness [kN/mm]\"";
const MODES: &str = "one row per mode, under \"mode,period [s],participation,damping [%],effective mass [%],3.2 m,6.4 \
                     m\" and so on: the shape at each floor under its height";

/// The rows of a table of storeys, and their lines.
#[derive(Debug, Clone, PartialEq)]
pub struct StoreyTable {
    pub storeys: Vec<Storey>,
    pub lines: Vec<usize>,
}

/// The rows of a table of modes, and their lines.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeTable {
    /// Heights of the floors above the ground, rising \[m\].
    pub heights_m: Vec<f64>,
    pub modes: Vec<TableMode>,
    pub lines: Vec<usize>,
}

/// Reads the bytes of a table, which must be text.
pub fn load_table(path: &Path) -> Result<Vec<u8>, Problem> {
    let mut bytes = load(path)?;
    check_text(&mut bytes).map_err(|problem| problem.in_file(path))?;
    Ok(bytes)
}

/// Reads a table of storeys from the ground up.
///
/// # Errors
/// A missing column, a cell that is not a number, storeys that are numbered downwards.
pub fn read_storeys(bytes: &[u8]) -> Result<StoreyTable, Problem> {
    let cells = Cells::read(bytes, STOREYS)?;
    let height = cells.needed(Dimension::Length, "the height of a storey")?;
    let name = cells
        .headings
        .get(height)
        .map_or("", |heading| heading.name.as_str());
    if name.to_lowercase().contains("elev") {
        let message = format!(
            "the column \"{}\" is not the height of a storey",
            shorten(name)
        );
        let hint = "write the height of each storey: its elevation minus that of the storey below";
        return Err(wrong(cells.line, message).hint(hint));
    }
    let mass = cells.needed(Dimension::Mass, "the mass of a floor")?;
    let stiffness = cells.needed(Dimension::Stiffness, "the stiffness of a storey")?;
    let named = |heading: &Heading| {
        let name = heading.name.to_lowercase();
        heading.unit.is_none() && (name.starts_with("storey") || name.starts_with("story"))
    };
    if let Some(column) = cells.only(named, "the storey")? {
        check_upwards(cells.rows.iter().map(|row| (row.line, row.text(column))))?;
    }
    let storeys = cells.rows.iter().map(|row| {
        Ok(Storey {
            mass_kg: cells.number(row, mass, "mass")?,
            stiffness_n_m: cells.number(row, stiffness, "stiffness")?,
            height_m: cells.number(row, height, "height")?,
        })
    });
    Ok(StoreyTable {
        storeys: storeys.collect::<Result<_, Problem>>()?,
        lines: cells.rows.iter().map(|row| row.line).collect(),
    })
}

/// Some programs list storeys from the roof down; the storey numbers reveal it.
fn check_upwards<'a>(rows: impl Iterator<Item = (usize, &'a str)>) -> Result<(), Problem> {
    let number = |text: &str| {
        text.trim_start_matches(|c: char| !c.is_ascii_digit())
            .parse::<u32>()
            .ok()
    };
    let mut below: Option<u32> = None;
    for (line, text) in rows {
        let here = number(text);
        if let (Some(below), Some(here)) = (below, here)
            && here <= below
        {
            let message = format!("storey {here} follows storey {below}");
            return Err(
                wrong(line, message).hint("sort the rows from the ground up, each storey once")
            );
        }
        below = here.or(below);
    }
    Ok(())
}

/// What a column in a table of modes holds.
#[derive(Debug, Clone, Copy, PartialEq)]
enum ModeColumn {
    Name,
    Period,
    Frequency,
    Participation,
    Damping,
    EffectiveMass,
    /// The shape at this height \[m\].
    Floor(f64),
}

fn mode_column(heading: &Heading) -> Option<ModeColumn> {
    let name = heading.name.to_lowercase();
    match heading.unit.map(|unit| unit.dimension) {
        Some(Dimension::Time) => return Some(ModeColumn::Period),
        Some(Dimension::Frequency) => return Some(ModeColumn::Frequency),
        None | Some(Dimension::Ratio) => {}
        Some(_) => return None,
    }
    if name.contains("mass") {
        Some(ModeColumn::EffectiveMass)
    } else if name.starts_with("damping") || name == "ζ" {
        Some(ModeColumn::Damping)
    } else if heading.unit.is_some() {
        None
    } else if name.contains("participation") || ["γ", "gamma"].contains(&name.as_str()) {
        Some(ModeColumn::Participation)
    } else if name.starts_with("mode") {
        Some(ModeColumn::Name)
    } else {
        quantity::parse(&heading.name, Dimension::Length)
            .ok()
            .map(ModeColumn::Floor)
    }
}

/// Reads a table of modes.
///
/// # Errors
/// A missing or unknown column, floors that do not rise, a cell that is not a number.
pub fn read_modes(bytes: &[u8]) -> Result<ModeTable, Problem> {
    let cells = Cells::read(bytes, MODES)?;
    let (mut kinds, mut floors) = (Vec::new(), Vec::new());
    for (index, heading) in cells.headings.iter().enumerate() {
        let Some(kind) = mode_column(heading) else {
            let message = format!("the column \"{}\" is not known", shorten(&heading.name));
            return Err(
                wrong(cells.line, message).hint(format!("remove it, or name it as here: {MODES}"))
            );
        };
        if let ModeColumn::Floor(height_m) = kind {
            floors.push((index, height_m));
        } else if kinds.iter().any(|&(_, other)| other == kind) {
            let message = format!("the column \"{}\" repeats another", shorten(&heading.name));
            return Err(wrong(cells.line, message).hint("keep only one of them in the file"));
        }
        kinds.push((index, kind));
    }
    let of = |kind: ModeColumn| {
        kinds
            .iter()
            .find(|&&(_, other)| other == kind)
            .map(|&(index, _)| index)
    };
    let needed = |kind: ModeColumn, what: &str| of(kind).ok_or_else(|| cells.missing(what));
    check_heights(&floors, cells.line)?;
    let (period, is_frequency) = match (of(ModeColumn::Period), of(ModeColumn::Frequency)) {
        (Some(period), _) => (period, false),
        (None, Some(frequency)) => (frequency, true),
        (None, None) => (needed(ModeColumn::Period, "a period with its unit")?, false),
    };
    let participation = needed(ModeColumn::Participation, "a participation factor")?;
    let modes = cells.rows.iter().map(|row| {
        let period = cells.number(row, period, "period")?;
        let shape = floors
            .iter()
            .map(|&(index, _)| cells.number(row, index, "shape"));
        Ok(TableMode {
            period_s: if is_frequency { 1.0 / period } else { period },
            damping_ratio: cells.optional(row, of(ModeColumn::Damping), "damping")?,
            participation_ratio: cells.number(row, participation, "participation factor")?,
            effective_mass_ratio: cells.optional(
                row,
                of(ModeColumn::EffectiveMass),
                "effective mass",
            )?,
            shape_ratio: shape.collect::<Result<_, Problem>>()?,
        })
    });
    Ok(ModeTable {
        modes: modes.collect::<Result<_, Problem>>()?,
        heights_m: floors.iter().map(|&(_, height_m)| height_m).collect(),
        lines: cells.rows.iter().map(|row| row.line).collect(),
    })
}

fn check_heights(floors: &[(usize, f64)], line: usize) -> Result<(), Problem> {
    if floors.is_empty() {
        return Err(wrong(line, "no column holds the shape at a floor").hint(MODES));
    }
    let mut below_m = 0.0;
    for &(_, height_m) in floors {
        // This also refuses NaN.
        if height_m.partial_cmp(&below_m) != Some(std::cmp::Ordering::Greater) {
            let message =
                format!("the floor at {height_m} m is not above the one before it, at {below_m} m");
            let hint =
                "write the floors from the lowest above the ground to the roof, without the ground";
            return Err(Problem::format(message, hint).at_line(line));
        }
        below_m = height_m;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn storeys_are_read_with_their_units() {
        let text = "# a tower\nstorey,height [m],mass [t],stiffness [kN/mm],note\n\nG,4,450,1200,entrance\n\
                    1,3.2,400,900.5,\n# roof\n2,3.2,200,900.5,\"roof, light\"\n";
        let table = read_storeys(text.as_bytes()).unwrap();
        assert_eq!(table.lines, [4, 5, 7]);
        assert_eq!(
            table.storeys[0],
            Storey {
                mass_kg: 450e3,
                stiffness_n_m: 1.2e9,
                height_m: 4.0
            }
        );
        assert_eq!(
            table.storeys[2],
            Storey {
                mass_kg: 200e3,
                stiffness_n_m: 900.5e6,
                height_m: 3.2
            }
        );
        let german =
            read_storeys("height [mm];mass [kg];stiffness [MN/m]\n3200,5;4e5;1,5\n".as_bytes())
                .unwrap();
        assert_eq!(
            german.storeys[0],
            Storey {
                mass_kg: 4e5,
                stiffness_n_m: 1.5e6,
                height_m: 3.2005
            }
        );
    }

    #[test]
    fn modes_are_read_with_their_units() {
        let text = "mode,period [s],participation factor,damping [%],effective mass [%],3.2 m,6400 mm\n\
                    1,1.25,1.3,2,78,0.6,1\n2,0.4,-0.4,,,-0.9,1\n";
        let table = read_modes(text.as_bytes()).unwrap();
        assert_eq!((table.heights_m, table.lines), (vec![3.2, 6.4], vec![2, 3]));
        let [first, second] = table.modes.as_slice() else {
            panic!()
        };
        assert_eq!((first.period_s, first.participation_ratio), (1.25, 1.3));
        assert_eq!(
            (first.damping_ratio, first.effective_mass_ratio),
            (Some(0.02), Some(0.78))
        );
        assert_eq!(
            (second.damping_ratio, second.effective_mass_ratio),
            (None, None)
        );
        assert_eq!(second.shape_ratio, [-0.9, 1.0]);
        let frequencies = read_modes(b"frequency [Hz],gamma,3 m\n2.5,1,1\n").unwrap();
        assert_eq!(frequencies.modes[0].period_s, 0.4);
    }

    /// A file of millions of rows is refused at the first row too many, without reading the rest: its last row, which is
    /// none, is not mentioned.
    #[test]
    #[ignore = "seconds: a table of many megabytes"]
    fn a_table_without_end_is_left_early() {
        let storeys = format!(
            "height [m],mass [t],stiffness [kN/mm]\n{}x\n",
            "3,1,1\n".repeat(25_000)
        );
        let modes = format!(
            "period [s],participation,3 m\n{}x\n",
            "1,1,1\n".repeat(25_000)
        );
        for problem in [
            read_storeys(storeys.as_bytes()).unwrap_err(),
            read_modes(modes.as_bytes()).unwrap_err(),
        ] {
            assert_eq!(problem.line, Some(20_002), "{problem}");
        }
    }

    #[test]
    fn what_is_no_table_is_refused_with_its_line() {
        let storeys = "storey,height [m],mass [t],stiffness [kN/mm]\n";
        let modes = "mode,period [s],participation,3 m,6 m\n";
        let cases: [(Result<(), Problem>, &str); 14] = [
            (read_storeys(b"").map(drop), "empty"),
            (
                read_storeys(storeys.as_bytes()).map(drop),
                "line 1: no rows",
            ),
            (
                read_storeys(b"height [m],mass,stiffness [kN/mm]\n3,4,5\n").map(drop),
                "line 1: no column holds the mass",
            ),
            (
                read_storeys(b"h [m],z [m],mass [t],k [N/m]\n3,4,5,6\n").map(drop),
                "both the height",
            ),
            (
                read_storeys(format!("{storeys}1,3,4\n").as_bytes()).map(drop),
                "line 2: this row has 3 cells, but the header has 4",
            ),
            (
                read_storeys(format!("{storeys}1,3,4,x\n").as_bytes()).map(drop),
                "the stiffness is \"x\"",
            ),
            (
                read_storeys(format!("{storeys}1,3,4,\n").as_bytes()).map(drop),
                "the stiffness is \"\"",
            ),
            (
                read_storeys(format!("{storeys}L2,3,4,5\nL1,3,4,5\n").as_bytes()).map(drop),
                "line 3: storey 1 follows",
            ),
            (
                read_modes(b"period [s],participation\n1,2\n").map(drop),
                "no column holds the shape",
            ),
            (
                read_modes(b"period [s],3 m\n1,2\n").map(drop),
                "no column holds a participation",
            ),
            (
                read_modes(b"period,participation,3 m\n1,2,1\n").map(drop),
                "the column \"period\" is not known",
            ),
            (
                read_modes(b"period [s],participation,UX,3 m\n1,2,1,1\n").map(drop),
                "\"UX\" is not known",
            ),
            (
                read_modes(b"period [s],participation,6 m,3 m\n1,2,1,1\n").map(drop),
                "the floor at 3 m is not",
            ),
            (
                read_modes(format!("{modes}1,1,1,0.5,inf\n").as_bytes()).map(drop),
                "line 2: the shape is \"inf\"",
            ),
        ];
        for (result, said) in cases {
            let problem = result.unwrap_err();
            assert!(
                problem.to_string().contains(said) && problem.hint.is_some(),
                "{problem}"
            );
        }
    }
}
