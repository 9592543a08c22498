//! The table of outcomes: runs or counts of objects, at intensities.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use freestand::fragility::{OutcomeClass, Outcomes, Run, ShockRun};
use freestand::rocking::Outcome;
use freestand_input::file::{InputFile, load};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::nearest;
use freestand_study::run::Progress;

use super::LEAST_ROTATION_RATIO;
use super::curves::caution_of;
use super::measure::{MEASURES, Measure};
use super::table::{Row, RowProblems, Table};
use freestand_inventory::too_mild::TooMild;

const HINT: &str = "write one row per run under \"object,motion,pfv [m/s],outcome\", or counts under \
                    \"object,pfv [m/s],no_uplift,rocked,exceeded,overturned\"";
/// The column with the intensity at which the motion of a run just lifts its object.
pub(super) const UPLIFT: &str = "uplift_intensity";

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
    /// Its shock \[g\]; `None` if it is not known, or if the rotation is below
    /// [`LEAST_ROTATION_RATIO`].
    pub(crate) shock_g: Option<f64>,
    /// The intensity at which its motion just lifts the object; `None` if it is not known.
    pub(crate) uplift: Option<f64>,
}

/// A run as a row of a table of outcomes states it.
#[derive(Debug, Clone, Copy)]
pub(super) struct RunRow<'a> {
    pub(super) object: &'a str,
    pub(super) motion: &'a str,
    pub(super) intensity: f64,
    /// `None`: it could not be followed.
    pub(super) class: Option<OutcomeClass>,
    pub(super) shock_g: Option<f64>,
    pub(super) weight: f64,
    pub(super) rotation_ratio: Option<f64>,
    pub(super) uplift: Option<f64>,
    /// Why it could not be followed; empty: that is not said.
    pub(super) reason: &'a str,
    pub(super) caution: Option<TooMild>,
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
    /// Why, in words: each reason once, for each object.
    pub(super) reasons: Vec<Vec<String>>,
    /// Why each object may fail more often than its runs say; `None`: that is not said.
    pub(super) cautions: Vec<Option<TooMild>>,
    /// The line of the first row of each object, from 1.
    first_lines: Vec<usize>,
}

impl OutcomeTable {
    /// Reads a file.
    ///
    /// # Errors
    /// A missing column; every row with a class that does not exist, an intensity that is not above
    /// 0 or an empty cell, each with its line and column; a second row for the same object, motion
    /// and intensity; the table that `assess` writes; and if the caller stopped it.
    pub(super) fn load(path: &Path, progress: Progress) -> Result<Self, Problems> {
        let read = Self::read(&load(path)?, path, progress)?;
        read.check_twice(progress)?;
        Ok(read)
    }

    /// Reads the bytes of a file.
    ///
    /// # Errors
    /// As for [`OutcomeTable::load`].
    pub(super) fn read(bytes: &[u8], path: &Path, progress: Progress) -> Result<Self, Problems> {
        let mut problems = RowProblems::watched(progress);
        let table = Table::read(bytes, path, HINT, &mut problems)?;
        if table.column("world").is_some() && table.column("fell").is_some() {
            let problem =
                table.header_problem("this is the table of worlds that assess writes".to_owned());
            let hint = "its worlds have no intensity measure and cannot be fitted: give a table with the measure of every run";
            return Err(problem.hint(hint).into());
        }
        let (column, measure, factor) = measure_of(&table)?;
        let mut reading = Reading::of(problems);
        let mut read = Self::empty(InputFile::new(path, bytes), measure);
        let intensity = |row: &Row| Ok::<f64, Problem>(factor * table.positive(row, column)?);
        if table.column("outcome").is_some() || table.column("motion").is_some() {
            read.add_runs(&table, intensity, &mut reading)?;
        } else {
            read.add_counts(&table, intensity, &mut reading)?;
        }
        reading.problems.finish(path)?;
        (read.objects, read.motions) = (reading.objects.names, reading.motions.names);
        Ok(read)
    }

    /// The table of these runs, which `file` states from its second line on.
    ///
    /// # Errors
    /// Every intensity that is not above 0, with its line.
    pub(super) fn of_runs<'a>(
        file: InputFile,
        measure: Measure,
        rows: impl Iterator<Item = RunRow<'a>>,
        progress: Progress,
    ) -> Result<Self, Problems> {
        let mut reading = Reading::of(RowProblems::watched(progress));
        let mut table = Self::empty(file, measure);
        for (line, row) in (2..).zip(rows) {
            reading.problems.row()?;
            if row.intensity > 0.0 && row.intensity.is_finite() {
                table.add_run(&mut reading, line, &row);
            } else {
                let name = measure.name();
                let message = format!("{name}: {} is not a number above 0", row.intensity);
                let problem = Problem::value(message, "leave out this motion");
                let of_row = problem.in_file(&table.file.path).at_line(line);
                reading.problems.push(of_row);
            }
        }
        reading.problems.finish(&table.file.path)?;
        (table.objects, table.motions) = (reading.objects.names, reading.motions.names);
        Ok(table)
    }

    fn empty(file: InputFile, measure: Measure) -> Self {
        Self {
            file,
            measure,
            objects: Vec::new(),
            motions: Vec::new(),
            runs: Vec::new(),
            unresolved: Vec::new(),
            reasons: Vec::new(),
            cautions: Vec::new(),
            first_lines: Vec::new(),
        }
    }

    fn add_run(&mut self, reading: &mut Reading<'_>, line: usize, row: &RunRow<'_>) {
        let object = self.object(reading, row.object, line, row.caution);
        let motion = reading.motions.place(row.motion);
        let Some(class) = row.class else {
            self.unresolved[object] += 1;
            let known = &mut self.reasons[object];
            if !row.reason.is_empty() && known.iter().all(|one| one != row.reason) {
                known.push(row.reason.to_owned());
            }
            return;
        };
        let is_known = |ratio: f64| ratio >= LEAST_ROTATION_RATIO;
        self.runs.push(OutcomeRun {
            object,
            line,
            run: Run {
                motion: Some(motion),
                intensity: row.intensity,
                class,
                weight: row.weight,
            },
            shock_g: row
                .shock_g
                .filter(|_| row.rotation_ratio.is_none_or(is_known)),
            uplift: row.uplift.filter(|uplift| *uplift > 0.0),
        });
    }

    fn add_runs(
        &mut self,
        table: &Table,
        intensity: impl Fn(&Row) -> Result<f64, Problem>,
        reading: &mut Reading<'_>,
    ) -> Result<(), Problem> {
        let (object, motion, outcome) = (
            table.needed("object")?,
            table.needed("motion")?,
            table.needed("outcome")?,
        );
        let (weight, reason) = (table.column("weight"), table.column("reason"));
        let (shock, rotation) = (
            table.column("edge_acceleration"),
            table.column("rotation_ratio"),
        );
        let unit = shock
            .and_then(|shock| table.headings.get(shock))
            .map(|heading| heading.unit.as_deref());
        // A shock is in g or m/s², as a peak acceleration is.
        let to_g = unit
            .map_or(Ok(1.0), |unit| Measure::Pga.factor_from(unit))
            .map_err(|_| {
                let message = "the column \"edge_acceleration\" is not in g".to_owned();
                table
                    .header_problem(message)
                    .hint("write edge_acceleration [g]")
            })?;
        let uplift = table.column(UPLIFT);
        let unit = uplift
            .and_then(|uplift| table.headings.get(uplift))
            .map(|heading| heading.unit.as_deref());
        let uplift_factor = unit
            .map_or(Ok(1.0), |unit| self.measure.factor_from(unit))
            .map_err(|problem| {
                table
                    .header_problem(format!("the column \"{UPLIFT}\": {}", problem.message))
                    .hint(HINT)
            })?;
        for row in &table.rows {
            reading.problems.row()?;
            // Every cell is read before the row is dropped, so that all its problems are reported.
            let problems = &mut reading.problems;
            let object = problems.keep(table.filled(row, object));
            let motion = problems.keep(table.filled(row, motion));
            let intensity = problems.keep(intensity(row));
            let class = problems.keep(class_of(table, row, outcome));
            let weight = problems.keep(table.optional(row, weight));
            let shock = problems.keep(table.optional(row, shock));
            let rotation = problems.keep(table.optional(row, rotation));
            let uplift = problems.keep(table.optional(row, uplift));
            let caution = problems.keep(caution_of(table, row));
            let (Some(object), Some(motion), Some(intensity)) = (object, motion, intensity) else {
                continue;
            };
            let (Some(class), Some(weight)) = (class, weight) else {
                continue;
            };
            let (Some(shock), Some(rotation), Some(uplift)) = (shock, rotation, uplift) else {
                continue;
            };
            let Some(caution) = caution else { continue };
            let run = RunRow {
                object,
                motion,
                intensity,
                class,
                shock_g: shock.map(|shock| to_g * shock),
                weight: weight.unwrap_or(1.0),
                rotation_ratio: rotation,
                uplift: uplift.map(|uplift| uplift_factor * uplift),
                reason: reason.map_or("", |reason| table.text(row, reason)),
                caution,
            };
            self.add_run(reading, row.line, &run);
        }
        Ok(())
    }

    fn add_counts(
        &mut self,
        table: &Table,
        intensity: impl Fn(&Row) -> Result<f64, Problem>,
        reading: &mut Reading<'_>,
    ) -> Result<(), Problem> {
        let object = table.needed("object")?;
        let columns = COUNTS.map(|name| table.column(name));
        table.needed("overturned")?;
        if columns.iter().flatten().count() < 2 {
            let message = "beside \"overturned\" there is no column of counts".to_owned();
            return Err(table.header_problem(message));
        }
        for row in &table.rows {
            reading.problems.row()?;
            let problems = &mut reading.problems;
            let object = problems.keep(table.filled(row, object));
            let intensity = problems.keep(intensity(row));
            let counts = columns
                .map(|column| column.map(|column| problems.keep(table.non_negative(row, column))));
            let caution = problems.keep(caution_of(table, row));
            let Some(((object, intensity), caution)) = object.zip(intensity).zip(caution) else {
                continue;
            };
            let object = self.object(reading, object, row.line, caution);
            for (class, count) in OutcomeClass::ALL.into_iter().zip(counts) {
                let Some(Some(weight)) = count else { continue };
                let run = Run {
                    motion: None,
                    intensity,
                    class,
                    weight,
                };
                self.runs.push(OutcomeRun {
                    object,
                    line: row.line,
                    run,
                    shock_g: None,
                    uplift: None,
                });
            }
        }
        Ok(())
    }

    /// Refuses runs that appear twice: an object under a motion at one intensity has one outcome.
    fn check_twice(&self, progress: Progress) -> Result<(), Problems> {
        let mut problems = RowProblems::watched(progress);
        let mut known: HashMap<(usize, usize, u64), &OutcomeRun> = HashMap::new();
        for one in &self.runs {
            problems.row()?;
            let Some(motion) = one.run.motion else {
                continue;
            };
            let before = *known
                .entry((one.object, motion, one.run.intensity.to_bits()))
                .or_insert(one);
            if before.line == one.line {
                continue;
            }
            let name = |names: &[String], place: usize| {
                shorten(names.get(place).map_or("", String::as_str))
            };
            let outcomes = if before.run.class == one.run.class {
                format!("appears twice, with the outcome {}", one.run.class.name())
            } else {
                format!(
                    "has two outcomes, {} and {}",
                    before.run.class.name(),
                    one.run.class.name()
                )
            };
            let message = format!(
                "lines {} and {}: the object {} under the motion {} at one intensity {outcomes}",
                before.line,
                one.line,
                name(&self.objects, one.object),
                name(&self.motions, motion),
            );
            let hint = "keep one of the two rows, or give different motions different names";
            problems.push(
                Problem::value(message, hint)
                    .in_file(&self.file.path)
                    .at_line(one.line),
            );
        }
        problems.finish(&self.file.path)
    }

    /// The place of an object; a new one is added.
    fn object(
        &mut self,
        reading: &mut Reading<'_>,
        id: &str,
        line: usize,
        caution: Option<TooMild>,
    ) -> usize {
        let object = reading.objects.place(id);
        if object == self.unresolved.len() {
            self.unresolved.push(0);
            self.reasons.push(Vec::new());
            self.cautions.push(None);
            self.first_lines.push(line);
        }
        if let Some(known) = self.cautions.get_mut(object) {
            *known = known.or(caution);
        }
        object
    }

    /// A problem with an object, reported at its first row.
    pub(super) fn object_problem(&self, object: usize, message: &str, hint: &str) -> Problem {
        let id = self.objects.get(object).map_or("", String::as_str);
        let problem = Problem::value(format!("object {}: {message}", shorten(id)), hint)
            .in_file(&self.file.path);
        self.first_lines
            .get(object)
            .map_or(problem.clone(), |line| problem.at_line(*line))
    }

    /// The runs of every object, in the order of the objects.
    ///
    /// # Errors
    /// Every object without a run that could be followed.
    pub(crate) fn by_object(&self) -> Result<Vec<Outcomes>, Problems> {
        let mut runs: Vec<Vec<Run>> = vec![Vec::new(); self.objects.len()];
        for one in &self.runs {
            if let Some(runs) = runs.get_mut(one.object) {
                runs.push(one.run);
            }
        }
        let mut problems = RowProblems::default();
        let outcomes = runs.iter().enumerate().map(|(object, runs)| {
            let found = Outcomes::new(runs).map_err(|error| {
                self.object_problem(
                    object,
                    &error.to_string(),
                    "leave out the object, or add its runs",
                )
            });
            problems.keep(found)
        });
        let outcomes: Vec<Outcomes> = outcomes.collect::<Vec<_>>().into_iter().flatten().collect();
        problems.finish(&self.file.path)?;
        Ok(outcomes)
    }

    /// For each object the intensities at which its motions just lift it, in the order of its motions;
    /// `None` where that is not known.
    pub(super) fn uplifts(&self) -> Vec<Vec<Option<f64>>> {
        let mut found: Vec<BTreeMap<usize, Option<f64>>> =
            vec![BTreeMap::new(); self.objects.len()];
        for one in self.runs.iter().filter(|one| one.run.weight > 0.0) {
            let (Some(known), Some(motion)) = (found.get_mut(one.object), one.run.motion) else {
                continue;
            };
            let least = known.entry(motion).or_insert(one.uplift);
            *least = least.zip(one.uplift).map(|(a, b)| a.min(b));
        }
        found
            .into_iter()
            .map(|known| known.into_values().collect())
            .collect()
    }

    /// Refuses shocks that are not above 0 or are above the ceiling.
    pub(super) fn check_shocks(&self, ceiling_g: f64) -> Result<(), Problems> {
        let mut problems = RowProblems::default();
        for (object, shocks) in self.shocks().iter().enumerate() {
            for (line, ShockRun { shock_g, .. }) in
                shocks.iter().filter(|(_, run)| !run.is_below(ceiling_g))
            {
                let hint = "correct it, or give the `ceiling` of this object, the ceiling_g that freestand shock states";
                let message = format!(
                    "the shock is {shock_g} g, but must be above 0 and at most the ceiling, {ceiling_g} g"
                );
                problems.push(Problem {
                    line: Some(*line),
                    ..self.object_problem(object, &message, hint)
                });
            }
        }
        problems.finish(&self.file.path)
    }

    /// For each object the shocks of its runs that rocked and did not overturn, with their lines.
    pub(super) fn shocks(&self) -> Vec<Vec<(usize, ShockRun)>> {
        let mut shocks = vec![Vec::new(); self.objects.len()];
        for OutcomeRun {
            object,
            line,
            run,
            shock_g,
            ..
        } in &self.runs
        {
            let rocked = matches!(run.class, OutcomeClass::Rocked | OutcomeClass::Exceeded)
                && run.weight > 0.0;
            if let (true, Some(shock_g), Some(of_object)) =
                (rocked, *shock_g, shocks.get_mut(*object))
            {
                of_object.push((
                    *line,
                    ShockRun {
                        intensity: run.intensity,
                        shock_g,
                        weight: run.weight,
                    },
                ));
            }
        }
        shocks
    }
}

/// What is collected while a table is read.
struct Reading<'p> {
    objects: Names,
    motions: Names,
    problems: RowProblems<'p>,
}

impl<'p> Reading<'p> {
    fn of(problems: RowProblems<'p>) -> Self {
        Self {
            objects: Names::default(),
            motions: Names::default(),
            problems,
        }
    }
}

/// Names in the order in which they first appear, with their places.
#[derive(Default)]
struct Names {
    names: Vec<String>,
    places: HashMap<String, usize>,
}

impl Names {
    fn place(&mut self, name: &str) -> usize {
        if let Some(place) = self.places.get(name) {
            return *place;
        }
        let place = self.names.len();
        self.names.push(name.to_owned());
        self.places.insert(name.to_owned(), place);
        place
    }
}

/// The class of a row; `None`: it could not be followed.
fn class_of(table: &Table, row: &Row, outcome: usize) -> Result<Option<OutcomeClass>, Problem> {
    let text = table.filled(row, outcome)?;
    if text == UNRESOLVED {
        return Ok(None);
    }
    // An object that leans on a wall counts as overturned.
    let text = if text == Outcome::Leaned.name() {
        OutcomeClass::Overturned.name()
    } else {
        text
    };
    text.parse().map(Some).map_err(|_| {
        let names = OutcomeClass::ALL.map(OutcomeClass::name);
        let near = nearest(text, &names)
            .map(|near| format!("; is it {near}?"))
            .unwrap_or_default();
        let message = format!("\"{}\" is not an outcome{near}", shorten(text));
        let hint = format!(
            "write {}, or unresolved for a run that could not be calculated",
            names.join(", ")
        );
        table.cell_problem(row, outcome, &message).hint(hint)
    })
}

/// The only column whose name is a measure, and the factor from its unit to the unit of the measure.
pub(crate) fn measure_of(table: &Table) -> Result<(usize, Measure, f64), Problem> {
    let headings = table.headings.iter().enumerate();
    let mut found =
        headings.filter_map(|(i, heading)| Some((i, heading, Measure::parse(&heading.name)?)));
    match (found.next(), found.next()) {
        (Some((column, heading, measure)), None) => {
            let factor = measure
                .factor_from(heading.unit.as_deref())
                .map_err(|problem| {
                    table
                        .header_problem(problem.message)
                        .hint(problem.hint.unwrap_or_default())
                })?;
            Ok((column, measure, factor))
        }
        (None, _) => {
            let message = "there is no column with an intensity measure".to_owned();
            Err(table
                .header_problem(message)
                .hint(format!("name one column as {MEASURES}")))
        }
        (Some((_, _, one)), Some((_, _, other))) => {
            let message = format!(
                "there are two intensity measures, {} and {}",
                one.name(),
                other.name()
            );
            Err(table
                .header_problem(message)
                .hint("keep one of them in the file"))
        }
    }
}

#[cfg(test)]
mod tests {
    use freestand_study::run::no_progress;

    use super::*;

    fn read(text: &str) -> Result<OutcomeTable, Problems> {
        OutcomeTable::read(text.as_bytes(), Path::new("o.csv"), &no_progress)
    }

    #[test]
    fn runs_are_read_with_their_unit() {
        let table = read(
            "object,motion,pfv [cm/s],outcome,weight\nb,m1,50,rocked,\na,m1,50,overturned,2\nb,m2,80,unresolved,\n",
        )
        .unwrap();
        assert_eq!(
            (table.objects, table.motions),
            (
                vec!["b".to_owned(), "a".to_owned()],
                vec!["m1".into(), "m2".into()]
            )
        );
        assert_eq!(
            (
                table.runs[1].run.intensity,
                table.runs[1].run.weight,
                table.unresolved
            ),
            (0.5, 2.0, vec![1, 0])
        );
    }

    #[test]
    fn reasons_are_kept_once() {
        let rows = "a,m,1,unresolved,\"it flies, for long\"\na,n,1,unresolved,\"it flies, for long\"\n\
                    a,o,1,unresolved,\na,p,1,rocked,\nb,m,1,rocked,\n";
        let table = read(&format!("object,motion,pga [g],outcome,reason\n{rows}")).unwrap();
        assert_eq!(
            (table.unresolved, table.reasons),
            (
                vec![3, 0],
                vec![vec!["it flies, for long".to_owned()], vec![]]
            )
        );
    }

    #[test]
    fn a_run_that_is_there_twice_is_refused_with_both_lines() {
        let twice = |outcome: &str| {
            let text = format!(
                "object,motion,pgv [m/s],outcome\na,m,0.2,rocked\na,n,0.2,rocked\na,m,0.2,{outcome}\n"
            );
            read(&text).unwrap().check_twice(&no_progress)
        };
        for (outcome, said) in [
            ("overturned", "two outcomes, rocked and overturned"),
            ("rocked", "appears twice"),
        ] {
            let problem = twice(outcome).unwrap_err();
            let text = problem.to_string();
            assert!(
                problem.len() == 1 && text.contains("lines 2 and 4") && text.contains(said),
                "{problem}"
            );
        }
        let counts = read("object,pgv [m/s],no_uplift,overturned\na,0.2,3,1\na,0.2,2,1\n").unwrap();
        assert_eq!(counts.check_twice(&no_progress), Ok(()));
    }

    #[test]
    fn what_is_wrong_is_said_with_line_and_column() {
        let cases = [
            (
                "object,motion,pfv [m/s],outcome\na,m,0.5,fell\n",
                "o.csv:2: column 4 (\"outcome\"): \"fell\" is not",
            ),
            (
                "object,motion,pfv [m/s],outcome\na,m,0.5,roked\n",
                "is it rocked?",
            ),
            (
                "object,motion,pfv [m/s],outcome\na,m,0,rocked\n",
                "o.csv:2: column 3",
            ),
            (
                "object,motion,pfv [m/s],outcome\na,,1,rocked\n",
                "o.csv:2: column 2 (\"motion\"): the cell is empty",
            ),
            (
                "object,motion,pfv,outcome\na,m,1,rocked\n",
                "o.csv:1: pfv has no unit",
            ),
            (
                "object,motion,pfv [g],outcome\na,m,1,rocked\n",
                "o.csv:1: pfv cannot be in \"g\"",
            ),
            (
                "object,motion,outcome\na,m,rocked\n",
                "o.csv:1: there is no column with an intensity measure",
            ),
            (
                "object,motion,pga [g],pfv [m/s],outcome\na,m,1,1,rocked\n",
                "two intensity measures",
            ),
            (
                "object,pga [g],no_uplift,overturned\na,1,2,-1\n",
                "o.csv:2: column 4",
            ),
            (
                "object,pga [g],rocked\na,1,2\n",
                "there is no column \"overturned\"",
            ),
            (
                "id,world,model,fell,exceeded\na,1,rigid,0,0\n",
                "the table of worlds that assess writes",
            ),
            ("object,motion,pga [g],outcome\n", "no rows"),
            (
                "object,motion,pga [g],outcome,edge_acceleration\na,m,1,rocked,2\n",
                "is not in g",
            ),
            (
                "object,motion,pga [g],outcome,edge_acceleration [g]\na,m,1,rocked,-2\n",
                "o.csv:2: column 5",
            ),
        ];
        for (text, said) in cases {
            let problem = read(text).unwrap_err();
            assert!(
                problem.to_string().contains(said) && problem.problems[0].hint.is_some(),
                "{said}: {problem}"
            );
        }
        let only_unresolved =
            read("object,motion,pga [g],outcome\nb,m,1,rocked\na,m,1,unresolved\n").unwrap();
        let problem = only_unresolved.by_object().unwrap_err().to_string();
        assert!(
            problem.starts_with("o.csv:3: object a: there are no runs"),
            "{problem}"
        );
    }

    #[test]
    fn all_bad_rows_are_told_at_once_up_to_a_bound() {
        let rows = "a,m,0,rocked\na,m,1\na,,x,fell\na,m,2,rocked\n";
        let problems = read(&format!("object,motion,pga [g],outcome\n{rows}")).unwrap_err();
        let places: Vec<Option<usize>> = problems
            .problems
            .iter()
            .map(|problem| problem.line)
            .collect();
        assert_eq!(
            places,
            [Some(3), Some(2), Some(4), Some(4), Some(4)],
            "{problems}"
        );
        let rows: String = (0..30).map(|i| format!("a,-{i},1,x{i}\n")).collect();
        let many = read(&format!("object,pga [g],rocked,overturned\n{rows}")).unwrap_err();
        assert_eq!(many.len(), 21);
        assert!(
            many.problems[20]
                .to_string()
                .starts_with("o.csv: and 40 more problems"),
            "{many}"
        );
        let twice = "object,motion,pgv [m/s],outcome\n".to_owned() + &"a,m,0.2,rocked\n".repeat(4);
        assert_eq!(
            read(&twice)
                .unwrap()
                .check_twice(&no_progress)
                .unwrap_err()
                .len(),
            3
        );
    }
}
