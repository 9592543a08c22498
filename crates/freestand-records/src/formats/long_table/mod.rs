//! Tables of ETABS and SAP2000: one row for each joint, output case and step, with the components
//! side by side.
//!
//! A title (`TABLE: Joint Accelerations - Absolute`), a row of headings (Story, Label, Output Case,
//! Step Number or Time, UX, UY, UZ; or Joint, OutputCase, StepNum, U1, U2, U3), a row of units, then
//! the rows.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::motion_file::{Found, ReadOptions, Reading};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::Block;
use crate::text::fortran::number;
use crate::text::lines::{Line, lines};
use crate::text::sampling::time_step;
use crate::text::table::quoted_cells;
use crate::text::units::{Stated, decide, record_unit};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, Unit, shorten};

/// Headings are among the first lines.
const HEADER_LINES: usize = 12;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    Story,
    /// The name of the joint.
    Label,
    /// Another name of the same joint.
    UniqueName,
    Case,
    StepType,
    Step,
    Time,
    /// A component, by its heading as it is printed.
    Component(&'static str),
}

/// The meaning of a heading; rotations and everything else are ignored.
fn column(heading: &str) -> Option<Column> {
    let plain: String = heading
        .chars()
        .filter(char::is_ascii_alphanumeric)
        .collect::<String>()
        .to_ascii_lowercase();
    Some(match plain.as_str() {
        "story" | "storey" | "level" => Column::Story,
        "label" | "joint" | "point" | "jointlabel" => Column::Label,
        "uniquename" => Column::UniqueName,
        "outputcase" | "loadcase" | "loadcasecombo" | "case" | "combo" => Column::Case,
        "steptype" => Column::StepType,
        "stepnumber" | "stepnum" | "step" => Column::Step,
        "time" => Column::Time,
        other => {
            let mut components = ["UX", "UY", "UZ", "U1", "U2", "U3"].into_iter();
            Column::Component(components.find(|name| name.eq_ignore_ascii_case(other))?)
        }
    })
}

/// The cells of a line, by the separator that gives the most of them.
fn cells(line: &Line<'_>) -> (u8, Vec<String>) {
    let text = line.text();
    let of = |separator: u8| (separator, quoted_cells(&text, separator));
    let all = [b',', b';', b'\t'].map(of);
    all.into_iter()
        .max_by_key(|(_, cells)| cells.len())
        .unwrap_or_default()
}

/// The headings, if a line is a row of them.
fn headings(line: &Line<'_>) -> Option<(u8, Vec<Option<Column>>)> {
    let (separator, cells) = cells(line);
    let columns: Vec<Option<Column>> = cells.iter().map(|cell| column(cell)).collect();
    let has = |is_it: fn(Column) -> bool| columns.iter().flatten().any(|column| is_it(*column));
    let is_header = has(|c| matches!(c, Column::Component(_)))
        && has(|c| matches!(c, Column::Story | Column::Label | Column::UniqueName))
        && has(|c| c == Column::Case);
    is_header.then_some((separator, columns))
}

/// Whether the text is such a table.
pub(super) fn is_long_table(bytes: &[u8]) -> bool {
    lines(bytes)
        .take(HEADER_LINES)
        .any(|line| headings(&line).is_some())
}

/// The histories of one joint in one output case.
struct Joint {
    story: String,
    label: String,
    case: String,
    /// The line of each row.
    lines: Vec<usize>,
    steps: Vec<f64>,
    /// The finest printed digit of the steps counts 10^this.
    last_digit_exponent: i32,
    values: Vec<Vec<f64>>,
}

impl Joint {
    fn first_line(&self) -> usize {
        self.lines.first().copied().unwrap_or(1)
    }
}

/// Where each joint is, by storey, label and output case.
type Places = BTreeMap<(String, String, String), usize>;

/// What is above the rows.
struct Head {
    separator: u8,
    columns: Vec<Option<Column>>,
    line: usize,
    title: Option<String>,
    units: Vec<Option<&'static Unit>>,
}

impl Head {
    fn at(&self, wanted: Column) -> Option<usize> {
        self.columns
            .iter()
            .position(|column| *column == Some(wanted))
    }

    fn components(&self) -> impl Iterator<Item = (usize, &'static str)> {
        self.columns
            .iter()
            .enumerate()
            .filter_map(|(at, column)| match column {
                Some(Column::Component(name)) => Some((at, *name)),
                _ => None,
            })
    }
}

/// Reads such a table: components `Story12 UX`, with the joint and the output case in the name where
/// there are several.
pub(super) fn read(bytes: &[u8], _path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let (head, joints) = table(bytes)?;
    let mut notes = Vec::new();
    if head
        .title
        .as_ref()
        .is_some_and(|title| title.to_ascii_lowercase().contains("relative"))
    {
        let words = "the title says that the accelerations are relative to the ground: rocking needs absolute ones; \
                     export \"Joint Accelerations - Absolute\"";
        notes.push(Note::new(NoteKind::Relative, words));
    }
    let requested = options.unit()?;
    let mut labels: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for joint in &joints {
        labels.entry(&joint.story).or_default().insert(&joint.label);
    }
    let has_cases = joints
        .windows(2)
        .any(|pair| pair.first().map(|one| &one.case) != pair.last().map(|one| &one.case));
    let mut components = Vec::new();
    for joint in &joints {
        let step = step(&head, joint, options)?;
        for (index, (at, name)) in head.components().enumerate() {
            let stated = head.units.get(at).copied().flatten().map(|unit| Stated {
                unit,
                line: head.line + 1,
            });
            let unit = decide(stated, requested, "the table")?;
            let name = format!("{} {name}", joint_name(joint, &labels, has_cases));
            let block = Block {
                values: joint.values.get(index).cloned().unwrap_or_default(),
                first_line: joint.first_line(),
            };
            let found = Found {
                direction: None,
                ..Found::new(name, *unit, step, block)
            };
            components.push(found.component(options)?);
        }
    }
    Ok(Reading {
        format: "ETABS/SAP2000 table",
        components,
        notes,
    })
}

/// The head of the table, and its rows by joint.
fn table(bytes: &[u8]) -> Result<(Head, Vec<Joint>), Problem> {
    let mut rest = lines(bytes);
    let mut title = None;
    let (separator, columns, line) = loop {
        let Some(line) = rest.next() else {
            let hint = "export the table of joint accelerations with its headings";
            return Err(Problem::format("no row of headings was found", hint).at_line(1));
        };
        if let Some((separator, columns)) = headings(&line) {
            break (separator, columns, line.number);
        }
        title =
            title.or_else(|| Some(line.text().trim().to_owned()).filter(|text| !text.is_empty()));
    };
    let mut head = Head {
        separator,
        columns,
        line,
        title,
        units: Vec::new(),
    };
    let mut joints: Vec<Joint> = Vec::new();
    let mut found = Places::new();
    for line in rest.filter(|line| !line.is_blank()) {
        let cells = quoted_cells(&line.text(), head.separator);
        let is_units = joints.is_empty()
            && head
                .components()
                .all(|(at, _)| value(cells.get(at), head.separator).is_none());
        if is_units {
            head.units = cells.iter().map(|cell| unit(cell)).collect();
            head.line = line.number - 1;
            continue;
        }
        add_row(&head, &mut joints, &mut found, &cells, line.number)?;
    }
    // The joints of an output case have the same steps: a shorter one is what a cut left.
    let mut longest: BTreeMap<&str, usize> = BTreeMap::new();
    for joint in &joints {
        let most = longest.entry(&joint.case).or_default();
        *most = joint.lines.len().max(*most);
    }
    let is_short = |joint: &&Joint| {
        longest
            .get(joint.case.as_str())
            .is_some_and(|most| joint.lines.len() < *most)
    };
    if let Some(joint) = joints.iter().find(is_short) {
        let message = format!(
            "joint {} {} has fewer steps than others of its output case",
            joint.story, joint.label
        );
        let line = joint.lines.last().copied().unwrap_or(head.line);
        return Err(
            Problem::format(message, "the table is incomplete: export it again").at_line(line),
        );
    }
    if joints.is_empty() {
        return Err(Problem::format(
            "the table has no rows",
            "export the results of a time history",
        )
        .at_line(head.line));
    }
    Ok((head, joints))
}

/// A unit as these programs print it: `m/sec²`, `in/sec2`, `Sec`.
fn unit(cell: &str) -> Option<&'static Unit> {
    record_unit(&cell.trim().to_ascii_lowercase().replace("sec", "s"))
}

/// The number in a cell; a decimal comma where another character separates the columns.
fn value(cell: Option<&String>, separator: u8) -> Option<(f64, i32)> {
    let text = cell?.trim();
    let pointed = if separator == b',' {
        text.to_owned()
    } else {
        text.replace(',', ".")
    };
    let found = number(pointed.as_bytes())?;
    found
        .value
        .is_finite()
        .then_some((found.value, found.last_digit_exponent))
}

/// Adds a row to its joint; `found` is where each joint is.
fn add_row(
    head: &Head,
    joints: &mut Vec<Joint>,
    found: &mut Places,
    cells: &[String],
    line: usize,
) -> Result<(), Problem> {
    let text = |wanted: Column| {
        let cell = head.at(wanted).and_then(|at| cells.get(at));
        cell.map_or_else(String::new, |cell| cell.trim().to_owned())
    };
    if ["max", "min"].contains(&text(Column::StepType).to_ascii_lowercase().as_str()) {
        let hint = "export the results step by step, not as envelopes";
        return Err(Problem::format(
            "the table has the largest and smallest values, not histories",
            hint,
        )
        .at_line(line));
    }
    let label = Some(text(Column::Label))
        .filter(|label| !label.is_empty())
        .unwrap_or_else(|| text(Column::UniqueName));
    let (story, case) = (text(Column::Story), text(Column::Case));
    let count = joints.len();
    let index = *found
        .entry((story.clone(), label.clone(), case.clone()))
        .or_insert(count);
    if index == count {
        let values = head.components().map(|_| Vec::new()).collect();
        let (lines, steps) = (Vec::new(), Vec::new());
        joints.push(Joint {
            story,
            label,
            case,
            lines,
            steps,
            last_digit_exponent: i32::MAX,
            values,
        });
    }
    let Some(joint) = joints.get_mut(index) else {
        return Ok(());
    };
    joint.lines.push(line);
    let bad = |at: usize| {
        let shown = cells.get(at).map_or_else(String::new, |cell| shorten(cell));
        Problem::format(
            format!("\"{shown}\" in column {} is not a number", at + 1),
            "repair or export it again",
        )
        .at_line(line)
    };
    if let Some(at) = head.at(Column::Time).or_else(|| head.at(Column::Step)) {
        let (step, last_digit) = value(cells.get(at), head.separator).ok_or_else(|| bad(at))?;
        joint.steps.push(step);
        joint.last_digit_exponent = joint.last_digit_exponent.min(last_digit);
    }
    for ((at, _), values) in head.components().zip(&mut joint.values) {
        values.push(
            value(cells.get(at), head.separator)
                .ok_or_else(|| bad(at))?
                .0,
        );
    }
    Ok(())
}

/// The time step of a joint: of its times, else as given.
fn step(head: &Head, joint: &Joint, options: &ReadOptions) -> Result<(f64, usize), Problem> {
    let line = joint.first_line();
    let is_counted = joint.steps.windows(2).all(|pair| {
        pair.last()
            .zip(pair.first())
            .is_some_and(|(b, a)| b - a == 1.0)
    });
    // SAP2000 writes times into the column of the steps; numbers of steps count by one.
    let has_times = !joint.steps.is_empty() && (head.at(Column::Time).is_some() || !is_counted);
    if !has_times {
        let hint = "give the time step of the analysis with `dt`";
        return match options.dt_s {
            Some(dt_s) => Ok((dt_s, line)),
            None => Err(
                Problem::format("the table numbers the steps and has no times", hint)
                    .at_line(head.line),
            ),
        };
    }
    let at = head.at(Column::Time).or_else(|| head.at(Column::Step));
    let unit = at
        .and_then(|at| head.units.get(at).copied().flatten())
        .filter(|unit| unit.dimension == Dimension::Time);
    let step = time_step(&joint.steps, joint.last_digit_exponent).map_err(|uneven| {
        Problem::format(uneven.message, uneven.hint)
            .at_line(joint.lines.get(uneven.row).copied().unwrap_or(line))
    })?;
    let step_s = unit.map_or(step, |unit| unit.to_si(step));
    match options.dt_s {
        // One part in a thousand: printed times are rounded.
        Some(dt_s) if (dt_s - step_s).abs() > 1e-3 * step_s => {
            let message =
                format!("the time step is {step_s} s according to the table, not {dt_s} s");
            Err(Problem::format(
                message,
                "leave out `dt`, or correct the file if it is wrong",
            )
            .at_line(line))
        }
        _ => Ok((step_s, line)),
    }
}

/// The story, with the joint and the output case where several have the same story; a joint without
/// a story by its label.
fn joint_name(joint: &Joint, labels: &BTreeMap<&str, BTreeSet<&str>>, has_cases: bool) -> String {
    let mut parts = Vec::new();
    match joint.story.as_str() {
        "" => parts.push(format!("Joint {}", joint.label)),
        story => {
            parts.push(story.to_owned());
            parts.extend(
                labels
                    .get(story)
                    .is_some_and(|labels| labels.len() > 1)
                    .then(|| joint.label.clone()),
            );
        }
    }
    parts.extend(has_cases.then(|| joint.case.clone()));
    parts.join(" ")
}

#[cfg(test)]
mod tests;
