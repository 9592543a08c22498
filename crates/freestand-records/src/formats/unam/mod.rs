//! ASA, the standard acceleration file of Mexico's networks (UNAM, CICESE): a long Spanish header,
//! then a column for each channel, in gal.

use crate::motion_file::{Direction, Found, ReadOptions, Reading, peak_note};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::{Block, Format};
use crate::text::fortran::{fields, leading_value, scan};
use crate::text::head::Head;
use crate::text::lines::{Line, Lines, joined, lines};
use crate::text::rows;
use crate::text::units::{Stated, decide, record_unit};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use std::path::Path;

/// The last line that may be the title; in every known file it is line 7.
const TITLE_LINES: usize = 20;
/// The last line that may be the first row; in every known file it is line 110.
const HEADER_LINES: usize = 300;

/// Whether the text is such a file: `ARCHIVO ESTANDAR DE ACELERACION` among the first lines, and a
/// list for the channels.
pub(super) fn is_unam(bytes: &[u8]) -> bool {
    let has_list = |line: &Line<'_>| {
        let text = plain(&line.text());
        [
            "NUM. TOTAL DE MUESTRAS",
            "INTERVALO DE MUESTREO",
            "ORIENTACION",
            "FORMATO DATOS",
        ]
        .iter()
        .any(|key| text.trim_start().starts_with(key))
    };
    lines(bytes)
        .take(TITLE_LINES)
        .any(|line| plain(&line.text()).contains("ARCHIVO ESTANDAR DE ACELERACION"))
        && lines(bytes).take(HEADER_LINES).any(|line| has_list(&line))
}

/// Capitals without accents, which only some files have.
fn plain(text: &str) -> String {
    let letter = |c: char| match c {
        'Á' => 'A',
        'É' => 'E',
        'Í' => 'I',
        'Ó' => 'O',
        'Ú' => 'U',
        'Ñ' => 'N',
        other => other,
    };
    text.to_uppercase().chars().map(letter).collect()
}

/// Reads such a file: `NAME : value` lines, the names of the channels above their columns, the
/// rows.
pub(super) fn read(bytes: &[u8], _path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let header = Header::read(&mut rest);
    let format = header.format(&rest)?;
    let columns = format.per_line;
    let (dt_line, dt_s) = header.step(columns)?;
    let (unit_line, unit_text) = header
        .value("UNIDADES DE LOS DATOS")
        .unwrap_or((dt_line, ""));
    let stated = unit_text
        .split(|c: char| c.is_whitespace() || "(),;".contains(c))
        .find_map(record_unit)
        .map(|unit| Stated {
            unit,
            line: unit_line,
        });
    let unit = decide(stated, options.unit()?, "the record")?;
    let names = header.names(columns)?;

    let mut notes = Vec::new();
    let mut rows = rows::read(&mut rest, format, &mut notes)?;
    header.check_counts(&mut rows.columns, &names, &mut notes)?;
    header.check_durations(dt_s, &rows.columns, &mut notes)?;
    let peaks = header
        .list("ACEL. MAX.(GAL)")
        .map(|(_, peaks)| peaks)
        .unwrap_or_default();
    let station = [
        header.value("NOMBRE DE LA ESTACION"),
        header.value("CLAVE DE LA ESTACION"),
    ];
    let station = station
        .into_iter()
        .flatten()
        .find_map(|(_, name)| joined(&[name], ""));
    let mut components = Vec::new();
    for (i, (name, values)) in names.into_iter().zip(rows.columns).enumerate() {
        let block = Block {
            values,
            first_line: rows.first_line,
        };
        let bearing = name.split(';').next().unwrap_or(&name).trim().to_owned();
        let component = Found {
            direction: direction(&name),
            station: station.clone(),
            ..Found::new(bearing, *unit, (dt_s, dt_line), block)
        }
        .component(options)?;
        if let Some(peak) = peaks.get(i).and_then(|peak| scan(peak.as_bytes())) {
            // The name of the line says gal, whatever the unit of the data.
            notes.extend(peak_note(&component, 0.01 * peak.value));
        }
        components.push(component);
    }
    Ok(Reading {
        format: "ASA",
        components,
        notes,
    })
}

/// `N00E`, `V`, `N90W;-`: the bearing and, after the semicolon, the sign.
fn direction(name: &str) -> Option<Direction> {
    let (bearing, sign) = name.split_once(';').unwrap_or((name, "+"));
    let (bearing, sign) = match bearing.trim().strip_prefix(['+', '-']) {
        Some(rest) => (rest, bearing.trim()),
        None => (bearing, sign.trim()),
    };
    match (Direction::parse(bearing)?, sign.starts_with('-')) {
        (direction, false) => Some(direction),
        (Direction::Azimuth(degrees), true) => Some(Direction::Azimuth((degrees + 180.0) % 360.0)),
        (Direction::Up, true) => None,
    }
}

/// The lines above the numbers.
struct Header(Head);

impl Header {
    /// Takes the lines down to the first row: the first line of numbers below the heading of the
    /// data or, without a heading, below the line that states their format.
    fn read(rest: &mut Lines<'_>) -> Self {
        let begins =
            |line: &Line<'_>, name: &str| plain(line.text().trim_start()).starts_with(name);
        let last_before = |name: &str| {
            rest.clone()
                .take(HEADER_LINES)
                .find(|line| begins(line, name))
        };
        let above = last_before("DATOS DE ACELERACION").or_else(|| last_before("FORMATO DATOS"));
        let above = above.map_or(usize::MAX, |line| line.number);
        let is_row = |line: &Line<'_>| !line.is_blank() && fields(line.bytes, |_| ()).is_ok();
        Self(Head::take(rest, HEADER_LINES, |line| {
            line.number > above && is_row(line)
        }))
    }

    /// The text after the first colon of the line whose name begins with `name`.
    fn value(&self, name: &str) -> Result<(usize, &str), Problem> {
        self.0.find(
            name,
            "the header is incomplete: fetch the file again",
            |text| {
                let (own, value) = text.split_once(':')?;
                plain(own.trim_start())
                    .starts_with(name)
                    .then_some(value.trim())
            },
        )
    }

    /// `/N00E/V/N90W/`: one entry for each channel; a second list continues from the seventh
    /// channel.
    fn list(&self, name: &str) -> Result<(usize, Vec<&str>), Problem> {
        let (first, _) = self.value(name)?;
        let mut entries = Vec::new();
        for (_, text) in self.0.lines.iter().filter(|(line, _)| *line >= first) {
            if let Some((own, value)) = text.split_once(':')
                // "ACEL. MAX. C1-C6, EN LA MUESTRA" is another list.
                && plain(own.trim_start()).starts_with(name)
            {
                let value = value.trim();
                let value = value.strip_prefix('/').unwrap_or(value);
                // An empty entry keeps its place: the next belongs to the next column.
                entries.extend(
                    value
                        .strip_suffix('/')
                        .unwrap_or(value)
                        .split('/')
                        .map(str::trim),
                );
            }
        }
        while entries.last().is_some_and(|entry| entry.is_empty()) {
            entries.pop();
        }
        Ok((first, entries))
    }

    /// The numbers of a list, for the channels that have a column.
    fn numbers(&self, name: &str, columns: usize) -> Result<(usize, Vec<f64>), Problem> {
        let (line, entries) = self.list(name)?;
        let numbers: Option<Vec<f64>> = entries
            .iter()
            .take(columns)
            .map(|entry| leading_value(entry))
            .collect();
        match numbers {
            Some(numbers) if numbers.len() == columns => Ok((line, numbers)),
            _ => Err(Problem::format(
                format!("\"{name}\" does not have a number for each of {columns} channels"),
                "the header is damaged: fetch the file again",
            )
            .at_line(line)),
        }
    }

    /// `3F10.3` as the header states; else as many columns as the first row has.
    fn format(&self, rest: &Lines<'_>) -> Result<Format, Problem> {
        if let Ok((line, text)) = self.value("FORMATO DATOS")
            && !text.is_empty()
        {
            let format = Format::parse(text).filter(|format| format.per_line <= 24);
            return format.ok_or_else(|| {
                Problem::format(
                    format!("the format of the data is \"{}\"", shorten(text)),
                    "it should read like 3F10.3: one number for each channel",
                )
                .at_line(line)
            });
        }
        let mut columns = 0;
        if let Some(row) = rest.clone().next() {
            let _ = fields(row.bytes, |_| columns += 1);
        }
        if (1..=24).contains(&columns) {
            return Ok(Format::new(columns, 10));
        }
        Err(rows::no_row(rest))
    }

    /// The step, which all channels must share: a row is one moment.
    fn step(&self, columns: usize) -> Result<(usize, f64), Problem> {
        let (line, steps) = self.numbers("INTERVALO DE MUESTREO", columns)?;
        match steps.first() {
            // One part in a million is a difference in printing.
            Some(&dt_s)
                if dt_s > 0.0
                    && steps
                        .iter()
                        .all(|other| (other - dt_s).abs() <= 1e-6 * dt_s) =>
            {
                Ok((line, dt_s))
            }
            _ => Err(Problem::format(
                "the channels have different time steps, or none",
                "put each channel into a file of its own",
            )
            .at_line(line)),
        }
    }

    /// The orientations, in the order of the columns. The text above the columns must not
    /// contradict them.
    fn names(&self, columns: usize) -> Result<Vec<String>, Problem> {
        let listed = self
            .list("ORIENTACION")
            .map(|(_, names)| names)
            .unwrap_or_default();
        let mut names: Vec<String> = listed
            .into_iter()
            .take(columns)
            .map(str::to_owned)
            .collect();
        for (i, name) in names
            .iter_mut()
            .enumerate()
            .filter(|(_, name)| name.is_empty())
        {
            *name = format!("component {}", i + 1);
        }
        names.extend((names.len()..columns).map(|i| format!("component {}", i + 1)));
        for (line, text) in self.0.lines.iter().rev().take(5) {
            let above: Vec<&str> = text.split_whitespace().collect();
            let contradicts =
                |(own, name): (&&str, &String)| match (direction(own), direction(name)) {
                    (Some(above), Some(listed)) => above != listed && !text.contains(':'),
                    _ => false,
                };
            if above.len() == columns && above.iter().zip(&names).any(contradicts) {
                let message = format!(
                    "the columns are \"{}\", but the header lists {}",
                    shorten(text.trim()),
                    names.join(", ")
                );
                return Err(Problem::format(
                    message,
                    "find out which is right, and correct the other",
                )
                .at_line(*line));
            }
        }
        Ok(names)
    }

    /// The number of rows is the largest of the channels' numbers. Rows after the end of a shorter
    /// channel are ignored for it.
    fn check_counts(
        &self,
        columns: &mut [Vec<f64>],
        names: &[String],
        notes: &mut Vec<Note>,
    ) -> Result<(), Problem> {
        let (line, counts) = self.numbers("NUM. TOTAL DE MUESTRAS", columns.len())?;
        let found = columns.first().map_or(0, Vec::len);
        let most = counts.iter().fold(0.0f64, |a, b| a.max(*b));
        if found as f64 != most {
            return Err(Problem::format(
                format!("the header declares {most} rows, but the file has {found}"),
                "the file may be cut off: fetch it again, or correct the number if no row is \
                 missing",
            )
            .at_line(line));
        }
        for ((column, name), &count) in columns.iter_mut().zip(names).zip(&counts) {
            if count < most {
                column.truncate(count.max(0.0) as usize);
                let words = format!("the rows after its {count} values were ignored");
                notes.push(Note::of(name, NoteKind::RowsIgnored, words));
            }
        }
        Ok(())
    }

    /// Checks the durations: they reveal a file that was decimated without correcting its step.
    fn check_durations(
        &self,
        dt_s: f64,
        columns: &[Vec<f64>],
        notes: &mut Vec<Note>,
    ) -> Result<(), Problem> {
        let Ok((line, durations)) = self.numbers("DURACION DEL REGISTRO", columns.len()) else {
            return Ok(());
        };
        let Some((column, &stated_s)) =
            columns.iter().zip(&durations).find(|(column, stated_s)| {
                // Durations are printed with one or two digits, or rounded to the second.
                let found_s = column.len() as f64 * dt_s;
                (found_s - **stated_s).abs() > 1.0 + 0.01 * found_s
            })
        else {
            return Ok(());
        };
        let message = format!(
            "{} values at {dt_s} s last {:.2} s, but the header states {stated_s} s",
            column.len(),
            column.len() as f64 * dt_s
        );
        let thinned = self
            .value("FACTOR DE DECIMACION")
            .ok()
            .and_then(|(_, text)| scan(text.as_bytes()));
        if thinned.is_some_and(|factor| factor.value > 1.0) {
            return Err(Problem::format(
                message,
                "the record was decimated (FACTOR DE DECIMACION): correct the time step",
            )
            .at_line(line));
        }
        notes.push(Note::new(NoteKind::DurationDiffers, message));
        Ok(())
    }
}

#[cfg(test)]
mod tests;
