//! The table of outcomes: runs or counts of objects, at intensities.

use std::collections::HashMap;
use std::path::Path;

use freestand::fragility::{OutcomeClass, Outcomes, Run, ShockRun};
use freestand::rocking::Outcome;
use freestand_input::file::{InputFile, load};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::nearest;

use super::measure::{MEASURES, Measure};
use super::table::{Row, Table};

const HINT: &str = "write one row per run under \"object,motion,pfv [m/s],outcome\", or counts under \
                    \"object,pfv [m/s],no_uplift,rocked,exceeded,overturned\"";
/// The outcome of a run that could not be followed.
pub(super) const UNRESOLVED: &str = "unresolved";
const COUNTS: [&str; 4] = ["no_uplift", "rocked", "exceeded", "overturned"];

/// One run of one object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OutcomeRun {
    /// Place of its object in [`OutcomeTable::objects`].
    pub(crate) object: usize,
    /// Its line in the file, from 1.
    pub(crate) line: usize,
    pub(crate) run: Run,
    /// Its shock, if it is known \[g\].
    pub(crate) shock_g: Option<f64>,
}

/// A table of outcomes.
#[derive(Debug, Clone, PartialEq)]
pub struct OutcomeTable {
    /// The file.
    pub file: InputFile,
    /// Its measure.
    pub measure: Measure,
    /// Ids of the objects, as they first appear.
    pub objects: Vec<String>,
    /// Names of the motions, as they first appear; empty for counts.
    pub motions: Vec<String>,
    pub(crate) runs: Vec<OutcomeRun>,
    /// Runs of each object that could not be followed.
    pub(crate) unresolved: Vec<usize>,
}

impl OutcomeTable {
    /// Reads a file.
    ///
    /// # Errors
    /// A missing column, a class that does not exist, a measure that is not above 0, an empty cell,
    /// each with line and column; two rows of one object, motion and level; the table that `assess`
    /// writes.
    pub fn load(path: &Path) -> Result<Self, Problem> {
        let read = Self::read(&load(path)?, path)?;
        read.check_twice()?;
        Ok(read)
    }

    /// Reads the bytes of a file.
    ///
    /// # Errors
    /// As for [`OutcomeTable::load`].
    pub(super) fn read(bytes: &[u8], path: &Path) -> Result<Self, Problem> {
        let table = Table::read(bytes, path, HINT)?;
        if table.column("world").is_some() && table.column("fell").is_some() {
            let problem = table.header_problem("this is the table of worlds that assess writes".to_owned());
            return Err(problem.hint(
                "its worlds have no intensity measure and cannot be fitted: give a table with the measure of every run",
            ));
        }
        let (column, measure) = measure_of(&table)?;
        let unit = table.headings.get(column).and_then(|heading| heading.unit.as_deref());
        let factor = measure
            .factor_from(unit)
            .map_err(|problem| table.header_problem(problem.message).hint(problem.hint.unwrap_or_default()))?;
        let mut read = Self {
            file: InputFile::new(path, bytes),
            measure,
            objects: Vec::new(),
            motions: Vec::new(),
            runs: Vec::new(),
            unresolved: Vec::new(),
        };
        let intensity = |row: &Row| Ok::<f64, Problem>(factor * table.positive(row, column)?);
        if table.column("outcome").is_some() || table.column("motion").is_some() {
            read.add_runs(&table, intensity)?;
        } else {
            read.add_counts(&table, intensity)?;
        }
        Ok(read)
    }

    fn add_runs(&mut self, table: &Table, intensity: impl Fn(&Row) -> Result<f64, Problem>) -> Result<(), Problem> {
        let (object, motion, outcome) = (table.needed("object")?, table.needed("motion")?, table.needed("outcome")?);
        let weight = table.column("weight");
        let shock = table.column("edge_acceleration");
        let unit = shock.and_then(|shock| table.headings.get(shock)).map(|heading| heading.unit.as_deref());
        // A shock is in g or m/s², as a peak acceleration is.
        let to_g = unit.map_or(Ok(1.0), |unit| Measure::Pga.factor_from(unit)).map_err(|_| {
            let message = "the column \"edge_acceleration\" is not in g".to_owned();
            table.header_problem(message).hint("write edge_acceleration [g]")
        })?;
        for row in &table.rows {
            let object = self.object(table.filled(row, object)?);
            let motion = place(&mut self.motions, table.filled(row, motion)?);
            let (intensity, text) = (intensity(row)?, table.filled(row, outcome)?);
            let weight = table.optional(row, weight)?.unwrap_or(1.0);
            let shock_g = table.optional(row, shock)?.map(|shock| to_g * shock);
            if text == UNRESOLVED {
                self.unresolved[object] += 1;
                continue;
            }
            // What leans on a wall has fallen.
            let text = if text == Outcome::Leaned.name() { OutcomeClass::Overturned.name() } else { text };
            let Some(class) = OutcomeClass::ALL.into_iter().find(|class| class.name() == text) else {
                let names = OutcomeClass::ALL.map(OutcomeClass::name);
                let near = nearest(text, &names).map(|near| format!("; is it {near}?")).unwrap_or_default();
                let message = format!("\"{}\" is not an outcome{near}", shorten(text));
                let hint = format!("write {}, or unresolved for a run that could not be calculated", names.join(", "));
                return Err(table.cell_problem(row, outcome, &message).hint(hint));
            };
            let line = row.line;
            self.runs.push(OutcomeRun {
                object,
                line,
                run: Run { motion: Some(motion), intensity, class, weight },
                shock_g,
            });
        }
        Ok(())
    }

    fn add_counts(&mut self, table: &Table, intensity: impl Fn(&Row) -> Result<f64, Problem>) -> Result<(), Problem> {
        let object = table.needed("object")?;
        let columns = COUNTS.map(|name| table.column(name));
        table.needed("overturned")?;
        if columns.iter().flatten().count() < 2 {
            let message = "beside \"overturned\" there is no column of counts".to_owned();
            return Err(table.header_problem(message));
        }
        for row in &table.rows {
            let object = self.object(table.filled(row, object)?);
            let intensity = intensity(row)?;
            for (class, column) in OutcomeClass::ALL.into_iter().zip(columns) {
                let Some(column) = column else { continue };
                let weight = table.non_negative(row, column)?;
                self.runs.push(OutcomeRun {
                    object,
                    line: row.line,
                    run: Run { motion: None, intensity, class, weight },
                    shock_g: None,
                });
            }
        }
        Ok(())
    }

    /// Refuses a run that is there twice: a motion at one level has one outcome.
    fn check_twice(&self) -> Result<(), Problem> {
        let mut known: HashMap<(usize, usize, u64), &OutcomeRun> = HashMap::new();
        for one in &self.runs {
            let Some(motion) = one.run.motion else { continue };
            let Some(before) = known.insert((one.object, motion, one.run.intensity.to_bits()), one) else { continue };
            let name = |names: &[String], place: usize| shorten(names.get(place).map_or("", String::as_str));
            let outcomes = if before.run.class == one.run.class {
                format!("is there twice, with the outcome {}", one.run.class.name())
            } else {
                format!("has two outcomes, {} and {}", before.run.class.name(), one.run.class.name())
            };
            let message = format!(
                "lines {} and {}: the object {} under the motion {} at one intensity {outcomes}",
                before.line,
                one.line,
                name(&self.objects, one.object),
                name(&self.motions, motion),
            );
            let hint = "keep one of the two rows; name motions differently if they are different ones";
            return Err(Problem::value(message, hint).in_file(&self.file.path).at_line(one.line));
        }
        Ok(())
    }

    /// The place of an object; a new one is added.
    fn object(&mut self, id: &str) -> usize {
        let object = place(&mut self.objects, id);
        self.unresolved.resize(self.objects.len(), 0);
        object
    }

    /// The runs of every object, in the order of the objects.
    ///
    /// # Errors
    /// An object of which no run could be followed.
    pub(crate) fn by_object(&self) -> Result<Vec<Outcomes>, Problem> {
        let mut runs: Vec<Vec<Run>> = vec![Vec::new(); self.objects.len()];
        for one in &self.runs {
            if let Some(runs) = runs.get_mut(one.object) {
                runs.push(one.run);
            }
        }
        let outcomes = runs.iter().zip(&self.objects).map(|(runs, id)| {
            Outcomes::new(runs).map_err(|error| {
                Problem::value(format!("object {}: {error}", shorten(id)), "leave out the object, or add its runs")
                    .in_file(&self.file.path)
            })
        });
        outcomes.collect()
    }
}

impl OutcomeTable {
    /// The shocks of the runs of an object that rocked and did not overturn.
    pub(crate) fn shocks(&self, object: usize) -> Vec<ShockRun> {
        let rocked = self.runs.iter().filter(|run| {
            run.object == object && matches!(run.run.class, OutcomeClass::Rocked | OutcomeClass::Exceeded)
        });
        let shock = |run: &OutcomeRun| {
            let shock_g = run.shock_g.filter(|_| run.run.weight > 0.0)?;
            Some(ShockRun { intensity: run.run.intensity, shock_g, weight: run.run.weight })
        };
        rocked.filter_map(shock).collect()
    }
}

fn place(names: &mut Vec<String>, name: &str) -> usize {
    // Rows of an object or of a motion usually follow each other.
    if names.last().is_some_and(|last| last == name) {
        return names.len() - 1;
    }
    names.iter().position(|known| known == name).unwrap_or_else(|| {
        names.push(name.to_owned());
        names.len() - 1
    })
}

/// The only column whose name is a measure.
fn measure_of(table: &Table) -> Result<(usize, Measure), Problem> {
    let measured = |(i, heading): (usize, &super::table::Heading)| Some((i, Measure::parse(&heading.name)?));
    let mut found = table.headings.iter().enumerate().filter_map(measured);
    match (found.next(), found.next()) {
        (Some(only), None) => Ok(only),
        (None, _) => {
            let message = "there is no column with an intensity measure".to_owned();
            Err(table.header_problem(message).hint(format!("name one column as {MEASURES}")))
        }
        (Some((_, one)), Some((_, other))) => {
            let message = format!("there are two intensity measures, {} and {}", one.name(), other.name());
            Err(table.header_problem(message).hint("keep one of them in the file"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<OutcomeTable, Problem> {
        OutcomeTable::read(text.as_bytes(), Path::new("o.csv"))
    }

    #[test]
    fn runs_are_read_with_their_unit() {
        let table = read(
            "object,motion,pfv [cm/s],outcome,weight\nb,m1,50,rocked,\na,m1,50,overturned,2\nb,m2,80,unresolved,\n",
        )
        .unwrap();
        assert_eq!(
            (table.objects, table.motions),
            (vec!["b".to_owned(), "a".to_owned()], vec!["m1".into(), "m2".into()])
        );
        assert_eq!((table.runs[1].run.intensity, table.runs[1].run.weight, table.unresolved), (0.5, 2.0, vec![1, 0]));
    }

    #[test]
    fn a_run_that_is_there_twice_is_refused_with_both_lines() {
        let twice = |outcome: &str| {
            let text = format!("object,motion,pgv [m/s],outcome\na,m,0.2,rocked\na,n,0.2,rocked\na,m,0.2,{outcome}\n");
            read(&text).unwrap().check_twice()
        };
        for (outcome, said) in [("overturned", "two outcomes, rocked and overturned"), ("rocked", "is there twice")] {
            let problem = twice(outcome).unwrap_err();
            assert!(problem.to_string().contains("lines 2 and 4") && problem.message.contains(said), "{problem}");
        }
        let counts = read("object,pgv [m/s],no_uplift,overturned\na,0.2,3,1\na,0.2,2,1\n").unwrap();
        assert_eq!(counts.check_twice(), Ok(()));
    }

    #[test]
    fn what_is_wrong_is_said_with_line_and_column() {
        let cases = [
            ("object,motion,pfv [m/s],outcome\na,m,0.5,fell\n", "o.csv:2: column 4 (\"outcome\"): \"fell\" is not"),
            ("object,motion,pfv [m/s],outcome\na,m,0.5,roked\n", "is it rocked?"),
            ("object,motion,pfv [m/s],outcome\na,m,0,rocked\n", "o.csv:2: column 3"),
            ("object,motion,pfv [m/s],outcome\na,,1,rocked\n", "o.csv:2: column 2 (\"motion\"): the cell is empty"),
            ("object,motion,pfv,outcome\na,m,1,rocked\n", "o.csv:1: pfv has no unit"),
            ("object,motion,pfv [g],outcome\na,m,1,rocked\n", "o.csv:1: pfv cannot be in \"g\""),
            ("object,motion,outcome\na,m,rocked\n", "o.csv:1: there is no column with an intensity measure"),
            ("object,motion,pga [g],pfv [m/s],outcome\na,m,1,1,rocked\n", "two intensity measures"),
            ("object,pga [g],no_uplift,overturned\na,1,2,-1\n", "o.csv:2: column 4"),
            ("object,pga [g],rocked\na,1,2\n", "there is no column \"overturned\""),
            ("id,world,model,fell,exceeded\na,1,rigid,0,0\n", "the table of worlds that assess writes"),
            ("object,motion,pga [g],outcome\n", "no rows"),
            ("object,motion,pga [g],outcome,edge_acceleration\na,m,1,rocked,2\n", "is not in g"),
            ("object,motion,pga [g],outcome,edge_acceleration [g]\na,m,1,rocked,-2\n", "o.csv:2: column 5"),
        ];
        for (text, said) in cases {
            let problem = read(text).unwrap_err();
            assert!(problem.to_string().contains(said) && problem.hint.is_some(), "{said}: {problem}");
        }
        let only_unresolved = read("object,motion,pga [g],outcome\na,m,1,unresolved\n").unwrap();
        assert!(only_unresolved.by_object().unwrap_err().message.contains("no runs"));
    }
}
