//! Fragility curves as a table.

use std::collections::HashMap;
use std::path::Path;

use freestand::fragility::{Curve, CurveKind, Fit, FitKind, LimitState};
use freestand::risk::Capacity;
use freestand_input::file::{InputFile, load};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::shortest;

use super::doubt::{Contradiction, CurveDoubt};
use super::measure::{At, MEASURES, Measure};
use super::table::{Row, RowProblems, Table};
use freestand_inventory::too_mild::TooMild;
use strum::VariantArray;

/// The column of `fragility.csv` with [`capacities_text`].
pub(crate) const CAPACITY: &str = "capacity";

/// The column of outcomes and curves with the name of a [`TooMild`].
pub(crate) const CAUTION: &str = "caution";

const HINT: &str = "the columns are id,im,im_unit,at,limit_state,kind,median,beta, and lower,upper for a step or bounds";

/// The curves of one object.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectCurves {
    /// Its id.
    pub id: String,
    /// Measure of the intensity.
    pub measure: Measure,
    /// Where it is taken.
    pub at: At,
    /// From harmless to severe.
    pub curves: Vec<Curve>,
    /// Between which intensities of the runs the capacities are, for each limit state; empty where only
    /// the curves are known.
    pub(crate) capacities: Vec<(LimitState, Vec<Capacity>)>,
    /// Why the object may fail more often than its curves say; `None`: that is not said.
    pub caution: Option<TooMild>,
    /// The line of its first curve in the file, from 1.
    pub line: usize,
}

impl ObjectCurves {
    /// The curve of a limit state.
    pub(crate) fn curve(&self, state: LimitState) -> Option<CurveKind> {
        self.curves
            .iter()
            .find(|curve| curve.limit_state == state)
            .map(|curve| curve.kind)
    }

    /// Between which intensities of the runs the capacities of a limit state are; empty where that is not
    /// known.
    pub(crate) fn capacities(&self, state: LimitState) -> &[Capacity] {
        self.capacities
            .iter()
            .find(|one| one.0 == state)
            .map_or(&[], |one| &one.1)
    }
}

/// Capacities in a cell: `<0.05..0.1=0.25; 0.2..0.4=0.5; 0.4..=0.25`, from..to=share of the motions, with
/// `<` where `to` is the lowest intensity of the runs.
pub(crate) fn capacities_text(found: &[Capacity]) -> String {
    let end = |x: Option<f64>| x.map_or(String::new(), shortest);
    let one = |one: &Capacity| {
        format!(
            "{}{}..{}={}",
            if one.is_lowest { "<" } else { "" },
            end(one.from),
            end(one.to),
            shortest(one.share)
        )
    };
    found.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// The capacities of a cell; `None` if it is not written like that.
fn capacities_of(text: &str, factor: f64) -> Option<Vec<Capacity>> {
    let end = |text: &str| match text {
        "" => Some(None),
        text => text
            .parse::<f64>()
            .ok()
            .filter(|x| *x > 0.0 && x.is_finite())
            .map(|x| Some(factor * x)),
    };
    let one = |text: &str| {
        let text = text.trim();
        let (ends, share) = text.strip_prefix('<').unwrap_or(text).split_once('=')?;
        let (from, to) = ends.split_once("..")?;
        let share = share
            .parse::<f64>()
            .ok()
            .filter(|share| (0.0..=1.0).contains(share))?;
        let (from, to) = (end(from)?, end(to)?);
        let is_rising =
            from.zip(to).is_none_or(|(from, to)| from <= to) && (from.is_some() || to.is_some());
        is_rising.then_some(Capacity {
            from,
            to,
            share,
            is_lowest: text.starts_with('<'),
        })
    };
    text.split(';').map(one).collect()
}

/// Differences of probabilities below this are not reported.
const CONTRADICTION: f64 = 0.005;

impl ObjectCurves {
    /// Where a more severe limit state is more probable than a milder one.
    pub(crate) fn contradiction(&self) -> Option<Contradiction> {
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for curve in &self.curves {
            let (median, beta) = (
                curve.kind.median().unwrap_or(f64::NAN),
                curve.kind.beta().unwrap_or(0.0),
            );
            // Three standard deviations hold all but 0.1 % of either side; of a step a little beyond it.
            let reach = (3.0 * beta).exp().max(1.1);
            (least, most) = (least.min(median / reach), most.max(median * reach));
        }
        let levels: Vec<f64> = (0..=GRID)
            .map(|i| least * (most / least).powf(f64::from(i) / f64::from(GRID)))
            .collect();
        let pairs = self.curves.iter().zip(self.curves.iter().skip(1));
        pairs.into_iter().find_map(|(mild, severe)| {
            let excess = |x: f64| Some(severe.kind.probability(x)? - mild.kind.probability(x)?);
            let is_wrong = |x: &&f64| excess(**x).is_some_and(|excess| excess > CONTRADICTION);
            let (from, to) = (
                levels.iter().find(is_wrong)?,
                levels.iter().rfind(is_wrong)?,
            );
            let fit = Fit {
                kind: FitKind::Separate,
                curves: vec![*mild, *severe],
                log_likelihood: 0.0,
                score_per_run: 0.0,
            };
            Some(Contradiction {
                id: self.id.clone(),
                measure: self.measure,
                from: *from,
                to: *to,
                mild: mild.limit_state,
                severe: severe.limit_state,
                crossing: fit.crossing(least, most).map(|found| found.intensity),
            })
        })
    }
}

/// The contradiction of the first object that has one, and which others have one too.
pub(crate) fn contradictions(curves: &[ObjectCurves]) -> Option<CurveDoubt> {
    let mut found = curves.iter().filter_map(ObjectCurves::contradiction);
    let first = found.next()?;
    let also = found.map(|one| one.id).collect();
    Some(CurveDoubt::Contradiction { first, also })
}

/// Which objects may fail more often than their curves say, by reason.
pub fn cautions<'a>(
    objects: impl Iterator<Item = (&'a str, Option<TooMild>)> + Clone,
) -> impl Iterator<Item = CurveDoubt> {
    TooMild::VARIANTS.iter().filter_map(move |&why| {
        let of_why = objects.clone().filter(|(_, caution)| *caution == Some(why));
        let ids: Vec<String> = of_why.map(|(id, _)| id.to_owned()).collect();
        (!ids.is_empty()).then_some(CurveDoubt::TooMild { why, ids })
    })
}

/// The reason in the column `caution`; `None` without the column or in an empty cell.
pub(super) fn caution_of(table: &Table, row: &Row) -> Result<Option<TooMild>, Problem> {
    let Some(column) = table.given(row, CAUTION) else {
        return Ok(None);
    };
    let text = table.text(row, column);
    text.parse().map(Some).map_err(|_| {
        let names: Vec<&str> = TooMild::VARIANTS.iter().map(|why| why.name()).collect();
        let message = format!("\"{}\" is not a caution", shorten(text));
        table.cell_problem(row, column, &message).hint(format!(
            "write {}, or leave the cell empty",
            names.join(", ")
        ))
    })
}

/// Intensities at which the curves of an object are compared, evenly spaced by their logarithm.
const GRID: u32 = 400;

/// Reads `fragility.csv`, or a table with its first eight columns.
///
/// # Errors
/// A missing column; every row with an unknown word, a median or β that is not above 0, a step or
/// bounds whose lower end is above the upper one, a limit state that appears twice or a second
/// measure for one object, each with its line and column.
pub(crate) fn load_curves(path: &Path) -> Result<(InputFile, Vec<ObjectCurves>), Problems> {
    let bytes = load(path)?;
    Ok((InputFile::new(path, &bytes), read(&bytes, path)?))
}

fn read(bytes: &[u8], path: &Path) -> Result<Vec<ObjectCurves>, Problems> {
    let mut problems = RowProblems::default();
    let table = Table::read(bytes, path, HINT, &mut problems)?;
    let [id, im, unit, at, state] =
        ["id", "im", "im_unit", "at", "limit_state"].map(|name| table.needed(name));
    let (id, im, unit, at, state) = (id?, im?, unit?, at?, state?);
    let (kind, median, beta) = (
        table.needed("kind")?,
        table.needed("median")?,
        table.needed("beta")?,
    );
    let mut objects: Vec<ObjectCurves> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    let mut add = |row: &Row| -> Result<(), Problem> {
        let bad = |column: usize, what: &str, hint: &str| {
            let message = format!("\"{}\" is not {what}", shorten(table.text(row, column)));
            table.cell_problem(row, column, &message).hint(hint)
        };
        let name = table.filled(row, id)?;
        let measure = Measure::parse(table.filled(row, im)?).ok_or_else(|| {
            bad(
                im,
                "an intensity measure",
                &format!("write one of {MEASURES}, without the unit"),
            )
        })?;
        let factor = measure
            .factor_from(Some(table.filled(row, unit)?))
            .map_err(|problem| {
                table
                    .cell_problem(row, unit, &problem.message)
                    .hint(problem.hint.unwrap_or_default())
            })?;
        let place = table
            .filled(row, at)?
            .parse()
            .map_err(|_| bad(at, "a place of a measure", "write ground or floor"))?;
        measure
            .at(Some(place))
            .map_err(|problem| table.cell_problem(row, at, &problem.message))?;
        let limit_state = table
            .filled(row, state)?
            .parse()
            .map_err(|_| bad(state, "a limit state", "write rocks, exceeds or overturns"))?;
        let kind = kind_of(&table, row, Columns { kind, median, beta }, factor)?;
        let curve = Curve { limit_state, kind };
        let found = table.given(row, CAPACITY).map(|column| {
            let hint = "write it as freestand fragility does, or leave the cell empty";
            let wrong = || {
                bad(
                    column,
                    "a list of capacities such as \"0.1..0.2=0.5; 0.2..=0.5\"",
                    hint,
                )
            };
            capacities_of(table.text(row, column), factor).ok_or_else(wrong)
        });
        let found = found.transpose()?.map(|found| (limit_state, found));
        let caution = caution_of(&table, row)?;
        let number = *places.entry(name.to_owned()).or_insert(objects.len());
        match objects.get_mut(number) {
            None => objects.push(ObjectCurves {
                id: name.to_owned(),
                measure,
                at: place,
                curves: vec![curve],
                capacities: found.into_iter().collect(),
                caution,
                line: row.line,
            }),
            Some(object) if object.measure != measure || object.at != place => {
                return Err(table.cell_problem(
                    row,
                    im,
                    "this object has another intensity measure above",
                ));
            }
            Some(object) if object.curve(limit_state).is_some() => {
                return Err(table.cell_problem(
                    row,
                    state,
                    "this limit state of the object appears twice",
                ));
            }
            Some(object) => {
                object.curves.push(curve);
                object.capacities.extend(found);
                object.caution = object.caution.or(caution);
                object.curves.sort_by_key(|curve| curve.limit_state);
            }
        }
        Ok(())
    };
    table.each_row(problems, |row, problems| problems.keep(add(row)))?;
    Ok(objects)
}

/// The places of the columns with the shape of a curve.
struct Columns {
    kind: usize,
    median: usize,
    beta: usize,
}

fn kind_of(
    table: &Table,
    row: &Row,
    Columns { kind, median, beta }: Columns,
    factor: f64,
) -> Result<CurveKind, Problem> {
    let bound = |name: &str| -> Result<f64, Problem> {
        let column = table.needed(name)?;
        Ok(factor * table.positive(row, column)?)
    };
    let in_order = |lower: Option<f64>, upper: Option<f64>| -> Result<(), Problem> {
        if lower.zip(upper).is_none_or(|(lower, upper)| lower <= upper) {
            return Ok(());
        }
        let column = table.needed("upper")?;
        let below = shorten(table.text(row, table.needed("lower")?));
        let message = format!(
            "{} is below the lower intensity {below}",
            shorten(table.text(row, column))
        );
        let hint = "lower is the intensity up to which no run reached the limit state, upper the one from which every \
                    run did: exchange them";
        Err(table.cell_problem(row, column, &message).hint(hint))
    };
    match table.filled(row, kind)? {
        "lognormal" => Ok(CurveKind::Lognormal {
            median: factor * table.positive(row, median)?,
            beta: table.positive(row, beta)?,
        }),
        "step" => match (table.column("lower"), table.column("upper")) {
            (Some(_), Some(_)) => {
                let (lower, upper) = (bound("lower")?, bound("upper")?);
                in_order(Some(lower), Some(upper))?;
                Ok(CurveKind::Step { lower, upper })
            }
            _ => {
                let median = factor * table.positive(row, median)?;
                Ok(CurveKind::Step {
                    lower: median,
                    upper: median,
                })
            }
        },
        "bounds" => {
            let optional = |name: &str| -> Result<Option<f64>, Problem> {
                let is_given = table
                    .column(name)
                    .is_some_and(|column| !table.text(row, column).is_empty());
                is_given.then(|| bound(name)).transpose()
            };
            let (lower, upper) = (optional("lower")?, optional("upper")?);
            // One of them must be there.
            let lower = if upper.is_none() {
                Some(bound("lower")?)
            } else {
                lower
            };
            in_order(lower, upper)?;
            Ok(CurveKind::Bounds { lower, upper })
        }
        "none" => Ok(CurveKind::None {
            lower: bound("lower")?,
        }),
        "all" => Ok(CurveKind::All {
            upper: bound("upper")?,
        }),
        "not-increasing" => Ok(CurveKind::NotIncreasing {
            lower: bound("lower")?,
            upper: bound("upper")?,
        }),
        other => Err(table
            .cell_problem(
                row,
                kind,
                &format!("\"{}\" is not a kind of curve", shorten(other)),
            )
            .hint("write lognormal, step, bounds, none, all or not-increasing")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "id,im,im_unit,at,limit_state,kind,median,beta";

    fn read_text(text: &str) -> Result<Vec<ObjectCurves>, Problem> {
        read_all(text).map_err(|problems| problems.problems[0].clone())
    }

    fn read_all(text: &str) -> Result<Vec<ObjectCurves>, Problems> {
        read(text.as_bytes(), Path::new("f.csv"))
    }

    #[test]
    fn eight_columns_suffice() {
        let curves = read_text(&format!(
            "{HEAD}\na,pgv,cm/s,ground,overturns,lognormal,50,0.25\na,pgv,m/s,ground,exceeds,step,0.3,\n"
        ))
        .unwrap();
        assert_eq!(curves.len(), 1);
        assert_eq!(
            curves[0].curve(LimitState::Overturns),
            Some(CurveKind::Lognormal {
                median: 0.5,
                beta: 0.25
            })
        );
        assert_eq!(
            curves[0].curves[0].kind,
            CurveKind::Step {
                lower: 0.3,
                upper: 0.3
            }
        );
    }

    /// ln x = (1.5 ln 0.5 − 0.1 ln 0.6)/1.4, x = 0.4935; below it P(overturns) is the larger one.
    #[test]
    fn curves_that_contradict_each_other_are_named() {
        let curves = |exceeds: &str, overturns: &str| {
            let row = |id: &str, state: &str, curve: &str| {
                format!("{id},pgv,m/s,ground,{state},lognormal,{curve}\n")
            };
            let rows = ["a", "b", "c"]
                .map(|id| row(id, "exceeds", exceeds) + &row(id, "overturns", overturns));
            read_text(&format!("{HEAD}\n{}", rows.concat())).unwrap()
        };
        let found = curves("0.5,0.1", "0.6,1.5");
        let crossing = found[0].contradiction().unwrap().crossing.unwrap();
        assert!((crossing - 0.4935).abs() < 1e-4, "{crossing}");
        let Some(CurveDoubt::Contradiction { first, also }) = contradictions(&found) else {
            panic!("all three contradict themselves")
        };
        assert_eq!(
            (first.id.as_str(), also),
            ("a", vec!["b".into(), "c".into()])
        );
        assert_eq!(
            (first.mild, first.severe),
            (LimitState::Exceeds, LimitState::Overturns)
        );
        let apart = curves("0.6,0.3", "0.5,0.3")[0].contradiction().unwrap();
        assert_eq!(apart.crossing, None);
        assert_eq!(contradictions(&curves("0.3,0.3", "0.6,0.3")), None);
    }

    /// Capacities of a cell are those that were written, in the unit of the measure.
    #[test]
    fn capacities_are_written_and_read() {
        let text = "<..10=0.125; <5..10=0.125; 20..40=0.5; 40..=0.25";
        let head = format!("{HEAD},capacity");
        let row =
            |cell: &str| format!("{head}\na,pgv,cm/s,ground,overturns,lognormal,30,0.3,{cell}\n");
        let curves = read_text(&row(text)).unwrap();
        let found = curves[0].capacities(LimitState::Overturns);
        assert_eq!(
            capacities_text(found),
            "<..0.1=0.125; <0.05..0.1=0.125; 0.2..0.4=0.5; 0.4..=0.25"
        );
        assert_eq!(
            (found[1].is_lowest, found[2].is_lowest, found[3].to),
            (true, false, None)
        );
        assert!(read_text(&row("")).unwrap()[0].capacities.is_empty());
        for wrong in ["x", "2..1=0.5", "1..2=2", "..=1", "1..2"] {
            let problem = read_text(&row(wrong)).unwrap_err();
            assert!(
                problem.to_string().contains("f.csv:2: column 9") && problem.hint.is_some(),
                "{problem}"
            );
        }
    }

    /// An object has the caution of any of its rows.
    #[test]
    fn a_caution_belongs_to_the_object() {
        let head = format!("{HEAD},caution");
        let row = |id: &str, state: &str, caution: &str| {
            format!("{id},pgv,m/s,ground,{state},lognormal,1,1,{caution}\n")
        };
        let rows = row("a", "rocks", "")
            + &row("a", "overturns", "rolls-or-slides")
            + &row("b", "rocks", "");
        let curves = read_text(&format!("{head}\n{rows}")).unwrap();
        assert_eq!(
            [curves[0].caution, curves[1].caution],
            [Some(TooMild::Glides), None]
        );
        let said = cautions(curves.iter().map(|one| (one.id.as_str(), one.caution)));
        let expected = CurveDoubt::TooMild {
            why: TooMild::Glides,
            ids: vec!["a".to_owned()],
        };
        assert_eq!(said.collect::<Vec<_>>(), [expected]);
        let problem = read_text(&format!("{head}\n{}", row("a", "rocks", "rolls"))).unwrap_err();
        assert!(
            problem
                .to_string()
                .contains("f.csv:2: column 9 (\"caution\"): \"rolls\" is not a caution"),
            "{problem}"
        );
    }

    #[test]
    fn bounds_may_have_one_end() {
        let head = format!("{HEAD},lower,upper");
        let curves = read_text(&format!(
            "{head}\na,pgv,cm/s,ground,overturns,bounds,,,30,\na,pgv,m/s,ground,rocks,bounds,,,,0.2\n"
        ))
        .unwrap();
        let kind = |state| curves[0].curve(state);
        assert_eq!(
            kind(LimitState::Overturns),
            Some(CurveKind::Bounds {
                lower: Some(0.3),
                upper: None
            })
        );
        assert_eq!(
            kind(LimitState::Rocks),
            Some(CurveKind::Bounds {
                lower: None,
                upper: Some(0.2)
            })
        );
        let problem =
            read_text(&format!("{head}\na,pgv,m/s,ground,overturns,bounds,,,,\n")).unwrap_err();
        assert!(
            problem.to_string().contains("f.csv:2: column 9"),
            "{problem}"
        );
    }

    /// At least as often as the upper end and at most as often as the lower one: exchanged, that is
    /// impossible.
    #[test]
    fn ends_that_are_exchanged_are_refused() {
        let head = format!("{HEAD},lower,upper");
        let of = |kind: &str, ends: &str| {
            read_text(&format!(
                "{head}\na,pgv,m/s,ground,overturns,{kind},,,{ends}\n"
            ))
        };
        for kind in ["step", "bounds"] {
            let problem = of(kind, "0.5,0.2").unwrap_err();
            let said = "f.csv:2: column 10 (\"upper\"): 0.2 is below the lower intensity 0.5";
            assert!(
                problem.to_string().contains(said) && problem.hint.is_some(),
                "{kind}: {problem}"
            );
            assert!(
                of(kind, "0.2,0.5").is_ok() && of(kind, "0.2,0.2").is_ok(),
                "{kind}"
            );
        }
    }

    #[test]
    fn what_is_wrong_is_said_with_line_and_column() {
        let cases = [
            (
                "a,pgx,m/s,ground,overturns,lognormal,1,1",
                "f.csv:2: column 2 (\"im\"): \"pgx\" is not",
            ),
            ("a,pgv,g,ground,overturns,lognormal,1,1", "column 3"),
            ("a,pgv,m/s,floor,overturns,lognormal,1,1", "column 4"),
            ("a,pgv,m/s,ground,falls,lognormal,1,1", "column 5"),
            ("a,pgv,m/s,ground,overturns,normal,1,1", "column 6"),
            ("a,pgv,m/s,ground,overturns,lognormal,0,1", "column 7"),
            (
                "a,pgv,m/s,ground,overturns,lognormal,1,",
                "column 8 (\"beta\"): the cell is empty",
            ),
            (
                "a,pgv,m/s,ground,overturns,none,,",
                "there is no column \"lower\"",
            ),
        ];
        for (row, said) in cases {
            let problem = read_text(&format!("{HEAD}\n{row}\n")).unwrap_err();
            assert!(
                problem.to_string().contains(said) && problem.hint.is_some(),
                "{said}: {problem}"
            );
        }
        let rows: String = cases.iter().map(|(row, _)| format!("{row}\n")).collect();
        let all = read_all(&format!("{HEAD}\n{rows}")).unwrap_err();
        let lines: Vec<Option<usize>> = all
            .problems
            .iter()
            .take(7)
            .map(|problem| problem.line)
            .collect();
        assert_eq!(
            (all.len(), lines),
            (cases.len(), (2..9).map(Some).collect()),
            "all rows at once"
        );
        let row = "a,pgv,m/s,ground,overturns,lognormal,1,1";
        assert!(
            read_text(&format!("{HEAD}\n{row}\n{row}\n"))
                .unwrap_err()
                .message
                .contains("twice")
        );
    }
}
