//! The study as written: a TOML text, read key by key with the line of each value.
//!
//! Nothing stops at the first problem: every reader takes what it can, notes what is wrong and goes on, so that a file
//! is put right in one round. Unknown keys are found because each reader says which keys it knows.

mod cushion;
mod processing;

use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{Problem, ProblemKind};
use crate::quantity::{self, Dimension, Unit};

pub(crate) use cushion::CushionOptions;
pub(crate) use processing::ProcessingOptions;

/// A value and the line on which it stands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Written<T> {
    pub(crate) value: T,
    pub(crate) line: usize,
}

impl<T> Written<T> {
    pub(crate) fn map<U>(self, change: impl FnOnce(T) -> U) -> Written<U> {
        Written { value: change(self.value), line: self.line }
    }
}

/// `[ground]`, as written. A `None` is a key that is missing or that was refused.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct GroundOptions {
    pub(crate) line: Option<usize>,
    pub(crate) code: Option<Written<String>>,
    pub(crate) edition: Option<Written<u64>>,
    pub(crate) city: Option<Written<String>>,
    pub(crate) hazard_factor: Option<Written<f64>>,
    pub(crate) site: Option<Written<String>>,
    pub(crate) return_period_years: Option<Written<u64>>,
    pub(crate) count: Option<Written<u64>>,
    pub(crate) seed: Option<Written<u64>>,
    pub(crate) motions: Option<Written<Vec<Written<String>>>>,
    pub(crate) unit: Option<Written<String>>,
    pub(crate) dt_s: Option<Written<f64>>,
    pub(crate) component: Option<Written<String>>,
    pub(crate) station_xml: Option<Written<String>>,
    pub(crate) scale: Option<Written<f64>>,
    pub(crate) processing: Option<ProcessingOptions>,
    /// Some key was refused: files cannot be read as they were meant to be.
    pub(crate) is_incomplete: bool,
}

/// `[building]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BuildingOptions {
    pub(crate) storeys: Option<Written<u64>>,
    pub(crate) storey_height_m: Option<Written<f64>>,
    pub(crate) frame: Option<Written<String>>,
    pub(crate) period_s: Option<Written<f64>>,
    pub(crate) damping: Option<Written<f64>>,
    pub(crate) shear_flexure: Option<Written<f64>>,
    pub(crate) modes: Option<Written<u64>>,
    pub(crate) levels: Option<Written<Vec<LevelOptions>>>,
}

/// One entry of `levels`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LevelOptions {
    pub(crate) line: usize,
    pub(crate) name: Option<Written<String>>,
    pub(crate) level_ratio: Option<Written<f64>>,
}

/// `[objects]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ObjectsOptions {
    pub(crate) heights_m: Option<Written<Vec<f64>>>,
    pub(crate) thicknesses_m: Option<Written<Vec<f64>>>,
    pub(crate) mass_kg: Option<Written<f64>>,
    pub(crate) cushion: CushionOptions,
    pub(crate) restitution: Option<Written<RestitutionOption>>,
    pub(crate) restitution_factor: Option<Written<f64>>,
    pub(crate) accuracy: Option<Written<String>>,
    pub(crate) tolerance_m_s2: Option<Written<f64>>,
    pub(crate) friction: Option<Written<f64>>,
}

/// `restitution`: a word or a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum RestitutionOption {
    Housner,
    Value(f64),
}

/// `[outputs]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct OutputsOptions {
    pub(crate) figures: Option<Written<bool>>,
    pub(crate) report: Option<Written<bool>>,
    pub(crate) history: Option<HistoryOptions>,
}

/// `history` of `[outputs]`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HistoryOptions {
    pub(crate) line: usize,
    pub(crate) level: Option<Written<String>>,
    pub(crate) motion: Option<Written<String>>,
    pub(crate) height_m: Option<Written<f64>>,
    pub(crate) thickness_m: Option<Written<f64>>,
}

/// A study as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Options {
    pub(crate) ground: GroundOptions,
    pub(crate) building: BuildingOptions,
    pub(crate) objects: ObjectsOptions,
    pub(crate) outputs: OutputsOptions,
}

/// Whether a text is TOML and has a table of a study.
pub(crate) fn has_table_of_ours(text: &str) -> bool {
    let names = ["ground", "building", "objects", "outputs"];
    DeTable::parse(text.trim_start_matches('\u{feff}'))
        .is_ok_and(|table| table.get_ref().keys().any(|key| names.contains(&key.get_ref().as_ref())))
}

/// Reads a study; what is wrong goes into the problems, what could be read into the options.
pub(crate) fn parse(text: &str, source: Option<&Path>) -> (Options, Vec<Problem>) {
    let mut reader = Reader::new(text, source);
    let mut options = Options::default();
    let Some(document) = reader.document(text) else { return (options, reader.problems) };
    let mut top = Section::new("", document.get_ref(), 1);
    if let Some(mut table) = top.table(&mut reader, "ground") {
        options.ground = ground(&mut reader, &mut table);
        table.finish(&mut reader);
        options.ground.is_incomplete = !reader.problems.is_empty();
    }
    if let Some(mut table) = top.table(&mut reader, "building") {
        options.building = building(&mut reader, &mut table);
        table.finish(&mut reader);
    }
    if let Some(mut table) = top.table(&mut reader, "objects") {
        options.objects = objects(&mut reader, &mut table);
        table.finish(&mut reader);
    }
    if let Some(mut table) = top.table(&mut reader, "outputs") {
        options.outputs = outputs(&mut reader, &mut table);
        table.finish(&mut reader);
    }
    top.finish(&mut reader);
    (options, reader.problems)
}

/// Reads a cushion file, in which the keys stand at the top.
pub(crate) fn parse_cushion(text: &str, source: &Path) -> (CushionOptions, Vec<Problem>) {
    let mut reader = Reader::new(text, Some(source));
    let Some(document) = reader.document(text) else { return (CushionOptions::new(), reader.problems) };
    let mut top = Section::new("", document.get_ref(), 1);
    let options = cushion::cushion(&mut reader, &mut top);
    top.finish(&mut reader);
    (options, reader.problems)
}

fn ground(reader: &mut Reader, table: &mut Section) -> GroundOptions {
    GroundOptions {
        line: Some(table.line),
        code: table.string(reader, "code"),
        edition: table.count(reader, "edition"),
        city: table.string(reader, "city"),
        hazard_factor: table.ratio(reader, "hazard_factor"),
        site: table.string(reader, "site"),
        return_period_years: table.count(reader, "return_period_years"),
        count: table.count(reader, "count"),
        seed: table.count(reader, "seed"),
        motions: table.strings(reader, "motions"),
        unit: table.string(reader, "unit"),
        dt_s: table.quantity(reader, "dt", Dimension::Time),
        component: table.name_or_number(reader, "component"),
        station_xml: table.string(reader, "station_xml"),
        scale: table.ratio(reader, "scale"),
        processing: processing::processing(reader, table),
        is_incomplete: false,
    }
}

fn building(reader: &mut Reader, table: &mut Section) -> BuildingOptions {
    BuildingOptions {
        storeys: table.count(reader, "storeys"),
        storey_height_m: table.quantity(reader, "storey_height", Dimension::Length),
        frame: table.string(reader, "frame"),
        period_s: table.quantity(reader, "period", Dimension::Time),
        damping: table.ratio(reader, "damping"),
        shear_flexure: table.ratio(reader, "shear_flexure"),
        modes: table.count(reader, "modes"),
        levels: levels(reader, table),
    }
}

fn levels(reader: &mut Reader, table: &mut Section) -> Option<Written<Vec<LevelOptions>>> {
    let (value, line) = table.take(reader, "levels")?;
    let DeValue::Array(items) = value else {
        reader.wrong_type(line, "levels", "a list", value, "write levels = [{ name = \"roof\", level_ratio = 1.0 }]");
        return None;
    };
    let mut levels = Vec::new();
    for item in items {
        let line = reader.line_of(item.span().start);
        match item.get_ref() {
            DeValue::Table(entries) => {
                let mut entry = Section::new("levels", entries, line);
                let level = LevelOptions {
                    line,
                    name: entry.string(reader, "name"),
                    level_ratio: entry.ratio(reader, "level_ratio"),
                };
                entry.finish(reader);
                levels.push(level);
            }
            value => {
                let level_ratio = reader.ratio_value("levels", value, line);
                levels.push(LevelOptions { line, name: None, level_ratio });
            }
        }
    }
    Some(Written { value: levels, line })
}

fn objects(reader: &mut Reader, table: &mut Section) -> ObjectsOptions {
    ObjectsOptions {
        heights_m: table.grid(reader, "heights", Dimension::Length),
        thicknesses_m: table.grid(reader, "thicknesses", Dimension::Length),
        mass_kg: table.quantity(reader, "mass", Dimension::Mass),
        cushion: cushion::cushion(reader, table),
        restitution: restitution(reader, table),
        restitution_factor: table.ratio(reader, "restitution_factor"),
        accuracy: table.string(reader, "accuracy"),
        tolerance_m_s2: table.quantity(reader, "tolerance", Dimension::Acceleration),
        friction: table.ratio(reader, "friction"),
    }
}

fn restitution(reader: &mut Reader, table: &mut Section) -> Option<Written<RestitutionOption>> {
    let (value, line) = table.take(reader, "restitution")?;
    if value.as_str().is_some_and(|word| word.eq_ignore_ascii_case("housner")) {
        return Some(Written { value: RestitutionOption::Housner, line });
    }
    if value.as_str().is_some_and(|word| !word.contains(|c: char| c.is_ascii_digit())) {
        let problem = value_problem(format!("restitution = {} is not known", describe(value)));
        reader.note(Some(line), problem.hint("write \"housner\" or a number in (0, 1]"));
        return None;
    }
    reader.ratio_value("restitution", value, line).map(|ratio| ratio.map(RestitutionOption::Value))
}

fn outputs(reader: &mut Reader, table: &mut Section) -> OutputsOptions {
    OutputsOptions {
        figures: table.boolean(reader, "figures"),
        report: table.boolean(reader, "report"),
        history: table.table(reader, "history").map(|mut entry| {
            let history = HistoryOptions {
                line: entry.line,
                level: entry.string(reader, "level"),
                motion: entry.string(reader, "motion"),
                height_m: entry.quantity(reader, "height", Dimension::Length),
                thickness_m: entry.quantity(reader, "thickness", Dimension::Length),
            };
            entry.finish(reader);
            history
        }),
    }
}

fn value_problem(message: String) -> Problem {
    Problem::new(ProblemKind::Value, message)
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What stands in the file, for a message.
fn describe(value: &DeValue) -> String {
    match value {
        DeValue::String(text) => format!("\"{}\"", quantity::shorten(text)),
        DeValue::Integer(number) => quantity::shorten(number.as_str()),
        DeValue::Float(number) => quantity::shorten(number.as_str()),
        DeValue::Boolean(flag) => flag.to_string(),
        DeValue::Datetime(_) => "a date".to_owned(),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// The digits of a bare number.
fn bare_number(value: &DeValue) -> Option<String> {
    match value {
        DeValue::Integer(number) if number.radix() == 10 => Some(number.as_str().to_owned()),
        DeValue::Float(number) => Some(number.as_str().to_owned()),
        _ => None,
    }
}

/// The text, its lines, and what is wrong with it.
struct Reader<'s> {
    source: Option<&'s Path>,
    line_starts: Vec<usize>,
    problems: Vec<Problem>,
}

impl<'s> Reader<'s> {
    fn new(text: &str, source: Option<&'s Path>) -> Self {
        let mut reader = Self { source, line_starts: Vec::new(), problems: Vec::new() };
        reader.set_text(text);
        reader
    }

    fn set_text(&mut self, text: &str) {
        self.line_starts = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
    }

    /// The keys and values of the text, unless it is not TOML.
    fn document<'t>(&mut self, text: &'t str) -> Option<Spanned<DeTable<'t>>> {
        // An editor's byte order mark is no part of the first key.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        self.set_text(text);
        let (document, errors) = DeTable::parse_recoverable(text);
        for error in errors {
            let line = error.span().map(|span| self.line_of(span.start));
            // What else is wrong with the same line follows from the first.
            if self.problems.last().is_some_and(|last| last.line == line) {
                continue;
            }
            let problem = Problem::new(ProblemKind::Format, format!("not TOML: {}", one_line(error.message())));
            let hint = if text.replace("\r\n", "").contains('\r') {
                "save it with lines that end in LF or CR LF"
            } else {
                "a table is written [ground], a key as name = value, and text in \"quotes\""
            };
            self.note(line, problem.hint(hint));
        }
        // In a text that is not TOML the rest may be rubbish: do not bury the cause under its consequences.
        self.problems.is_empty().then_some(document)
    }

    /// The line of a byte, from 1.
    fn line_of(&self, byte: usize) -> usize {
        self.line_starts.partition_point(|&start| start <= byte)
    }

    fn note(&mut self, line: Option<usize>, problem: Problem) {
        let problem = line.map_or(problem.clone(), |line| problem.at_line(line));
        self.problems.push(self.source.map_or(problem.clone(), |path| problem.in_file(path)));
    }

    fn wrong_type(&mut self, line: usize, key: &str, expected: &str, value: &DeValue, hint: &str) {
        let problem = value_problem(format!("{key} must be {expected}, not {}", describe(value)));
        self.note(Some(line), problem.hint(hint));
    }

    fn keep<T>(&mut self, key: &str, line: usize, result: Result<T, Problem>) -> Option<Written<T>> {
        match result {
            Ok(value) => Some(Written { value, line }),
            Err(mut problem) => {
                problem.message = format!("{key}: {}", problem.message);
                self.note(Some(line), problem);
                None
            }
        }
    }

    /// A ratio: bare, or a string such as "5 %".
    fn ratio_value(&mut self, key: &str, value: &DeValue, line: usize) -> Option<Written<f64>> {
        let text = value.as_str().map(str::to_owned).or_else(|| bare_number(value));
        let Some(text) = text else {
            self.wrong_type(line, key, "a number", value, "write a bare number or a percentage such as \"5 %\"");
            return None;
        };
        let result = quantity::parse(&text, Dimension::Ratio);
        self.keep(key, line, result)
    }

    /// A quantity: a string with its unit, or a bare number where the key states the unit.
    fn quantity_value(
        &mut self,
        key: &str,
        value: &DeValue,
        line: usize,
        dimension: Dimension,
        stated: Option<&Unit>,
    ) -> Option<Written<f64>> {
        let result = match (stated, bare_number(value), value.as_str()) {
            (Some(unit), Some(number), _) => quantity::parse_in_unit(&number, unit),
            (Some(unit), None, Some(text)) => quantity::parse_in_unit(text, unit),
            (None, Some(number), _) => quantity::parse(&number, dimension),
            (None, None, Some(text)) => quantity::parse(text, dimension),
            _ => {
                let hint = format!("write a number and its unit, such as {}", example(dimension));
                self.wrong_type(line, key, dimension.with_article(), value, &hint);
                return None;
            }
        };
        self.keep(key, line, result)
    }
}

fn example(dimension: Dimension) -> String {
    dimension.units().next().map_or_else(|| "0.5".to_owned(), |unit| format!("\"2.3 {}\"", unit.symbol))
}

/// How a unit is written at the end of a key: `N/mm` → `n_mm`, `m/s2` → `m_s2`.
fn key_suffix(unit: &Unit) -> String {
    unit.symbol.to_lowercase().replace(['/', '·'], "_")
}

/// A table being read, and the keys that were asked for.
struct Section<'t, 'i> {
    name: &'static str,
    entries: &'t DeTable<'i>,
    line: usize,
    known: Vec<&'static str>,
    taken: Vec<String>,
}

impl<'t, 'i> Section<'t, 'i> {
    fn new(name: &'static str, entries: &'t DeTable<'i>, line: usize) -> Self {
        Self { name, entries, line, known: Vec::new(), taken: Vec::new() }
    }

    fn entry(&self, key: &str) -> Option<(&'t Spanned<std::borrow::Cow<'i, str>>, &'t DeValue<'i>)> {
        self.entries.iter().find(|(name, _)| name.get_ref() == key).map(|(name, value)| (name, value.get_ref()))
    }

    fn take(&mut self, reader: &Reader, key: &'static str) -> Option<(&'t DeValue<'i>, usize)> {
        self.known.push(key);
        let (name, value) = self.entry(key)?;
        self.taken.push(key.to_owned());
        Some((value, reader.line_of(name.span().start)))
    }

    fn table(&mut self, reader: &mut Reader, key: &'static str) -> Option<Section<'t, 'i>> {
        let (value, line) = self.take(reader, key)?;
        if let DeValue::Table(entries) = value {
            return Some(Section::new(key, entries, line));
        }
        let hint = if self.name.is_empty() {
            format!("write [{key}] on a line of its own")
        } else {
            format!("write {key} = {{ … }}")
        };
        reader.wrong_type(line, key, "a table", value, &hint);
        None
    }

    fn string(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<String>> {
        let (value, line) = self.take(reader, key)?;
        if let Some(text) = value.as_str() {
            return Some(Written { value: text.to_owned(), line });
        }
        reader.wrong_type(line, key, "text", value, "write it in \"quotes\"");
        None
    }

    fn name_or_number(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<String>> {
        let (value, line) = self.take(reader, key)?;
        if let Some(text) = value.as_str().map(str::to_owned).or_else(|| bare_number(value)) {
            return Some(Written { value: text, line });
        }
        reader.wrong_type(line, key, "a name or a number", value, "write it in \"quotes\"");
        None
    }

    fn strings(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<Vec<Written<String>>>> {
        let (value, line) = self.take(reader, key)?;
        let hint = format!("write {key} = [\"a.AT2\", \"b.AT2\"]");
        match value {
            DeValue::String(text) => {
                let only = Written { value: text.clone().into_owned(), line };
                return Some(Written { value: vec![only], line });
            }
            DeValue::Array(items) => {
                let mut strings = Vec::new();
                for item in items {
                    let line = reader.line_of(item.span().start);
                    match item.get_ref().as_str() {
                        Some(text) => strings.push(Written { value: text.to_owned(), line }),
                        None => reader.wrong_type(line, key, "a list of texts", item.get_ref(), &hint),
                    }
                }
                return Some(Written { value: strings, line });
            }
            _ => reader.wrong_type(line, key, "a list of texts", value, &hint),
        }
        None
    }

    fn boolean(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<bool>> {
        let (value, line) = self.take(reader, key)?;
        if let DeValue::Boolean(flag) = value {
            return Some(Written { value: *flag, line });
        }
        reader.wrong_type(line, key, "true or false", value, "write it without quotes");
        None
    }

    fn count(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<u64>> {
        let (value, line) = self.take(reader, key)?;
        let number = match value {
            DeValue::Integer(number) => u64::from_str_radix(number.as_str(), number.radix()).ok(),
            _ => None,
        };
        if let Some(value) = number {
            return Some(Written { value, line });
        }
        reader.wrong_type(line, key, "a whole number", value, "write digits alone, without a sign, a point or quotes");
        None
    }

    fn ratio(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<f64>> {
        let (value, line) = self.take(reader, key)?;
        reader.ratio_value(key, value, line)
    }

    /// The key, or the key with a unit at its end; both at once contradict each other.
    fn take_with_unit(
        &mut self,
        reader: &mut Reader,
        key: &'static str,
        dimension: Dimension,
    ) -> Option<(String, &'t DeValue<'i>, usize, Option<&'static Unit>)> {
        let mut found = self.take(reader, key).map(|(value, line)| (key.to_owned(), value, line, None));
        for unit in dimension.units() {
            let stated = format!("{key}_{}", key_suffix(unit));
            let Some((name, value)) = self.entry(&stated) else { continue };
            // N/mm and kN/m share no suffix, but two spellings of one unit would be seen twice here.
            if self.taken.contains(&stated) {
                continue;
            }
            self.taken.push(stated.clone());
            let line = reader.line_of(name.span().start);
            if let Some((first, ..)) = &found {
                let problem = value_problem(format!("{first} and {stated} both state the same value"));
                reader.note(Some(line), problem.hint("keep one of them"));
            } else {
                found = Some((stated, value, line, Some(unit)));
            }
        }
        found
    }

    fn quantity(&mut self, reader: &mut Reader, key: &'static str, dimension: Dimension) -> Option<Written<f64>> {
        let (name, value, line, unit) = self.take_with_unit(reader, key, dimension)?;
        reader.quantity_value(&name, value, line, dimension, unit)
    }

    /// A grid text, a list of quantities, or one; of bare numbers where the key states the unit.
    fn grid(&mut self, reader: &mut Reader, key: &'static str, dimension: Dimension) -> Option<Written<Vec<f64>>> {
        let (name, value, line, unit) = self.take_with_unit(reader, key, dimension)?;
        match (value, unit) {
            (DeValue::Array(items), _) => {
                let before = reader.problems.len();
                let values: Vec<f64> = items
                    .iter()
                    .filter_map(|item| {
                        let line = reader.line_of(item.span().start);
                        reader.quantity_value(&name, item.get_ref(), line, dimension, unit)
                    })
                    .map(|written| written.value)
                    .collect();
                (reader.problems.len() == before).then_some(Written { value: values, line })
            }
            (DeValue::String(text), unit) => {
                let result = match unit {
                    Some(unit) => quantity::parse_grid_in_unit(text, unit),
                    None => quantity::parse_grid(text, dimension),
                };
                reader.keep(&name, line, result)
            }
            _ => Some(reader.quantity_value(&name, value, line, dimension, unit)?.map(|value| vec![value])),
        }
    }

    /// Refuses the keys that nobody asked for.
    fn finish(self, reader: &mut Reader) {
        for (name, value) in self.entries {
            let key = name.get_ref().as_ref();
            if self.taken.iter().any(|taken| taken == key) {
                continue;
            }
            let what = match (self.name, value.get_ref()) {
                ("", DeValue::Table(_)) => format!("unknown table [{}]", quantity::shorten(key)),
                ("", _) => format!("{} stands outside every table", quantity::shorten(key)),
                (table, _) => format!("unknown key {} in [{table}]", quantity::shorten(key)),
            };
            let hint = match nearest(key, &self.known) {
                Some(near) if self.name.is_empty() => format!("did you mean [{near}]?"),
                Some(near) => format!("did you mean {near}?"),
                None => format!("known: {}", self.known.join(", ")),
            };
            let line = reader.line_of(name.span().start);
            reader.note(Some(line), value_problem(what).hint(hint));
        }
    }
}

/// The candidate that a mistyped word most likely meant: at most a third of its letters differ.
pub(crate) fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let word = word.to_lowercase();
    let (distance, best) = candidates
        .iter()
        .map(|candidate| (edit_distance(&word, &candidate.to_lowercase()), *candidate))
        .min_by_key(|&(distance, _)| distance)?;
    (3 * distance <= word.chars().count().max(best.chars().count())).then_some(best)
}

/// Levenshtein distance with transpositions counted as two; words are short, so the plain table does.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let change = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = change.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problems(text: &str) -> Vec<String> {
        let (_, problems) = parse(text, Some(Path::new("s.toml")));
        problems.iter().map(|p| format!("{p} | {}", p.hint.as_deref().unwrap_or("-"))).collect()
    }

    #[test]
    fn quantities_take_strings_with_units_or_keys_that_state_them() {
        let (options, problems) = parse(
            "[building]\nstorey_height_mm = 3200\nperiod = \"1.92 s\"\ndamping = \"5 %\"\n[objects]\nheights = [\"0.5 m\", \"700 mm\"]\nthicknesses_mm = [200, 300.5]\nstiffness_n_mm = 4380\n",
            None,
        );
        assert_eq!(problems, []);
        assert_eq!(options.building.storey_height_m, Some(Written { value: 3.2, line: 2 }));
        assert_eq!(options.building.period_s, Some(Written { value: 1.92, line: 3 }));
        assert_eq!(options.building.damping, Some(Written { value: 0.05, line: 4 }));
        assert_eq!(options.objects.heights_m.unwrap().value, [0.5, 0.7]);
        assert_eq!(options.objects.thicknesses_m.unwrap().value, [0.2, 0.3005]);
        assert_eq!(
            (options.objects.cushion[0].0, options.objects.cushion[0].1.value.as_str()),
            ("stiffness", "4380 N/mm")
        );
    }

    #[test]
    fn a_key_with_a_unit_takes_a_number_a_list_and_a_grid() {
        for (value, expected) in [
            ("500", &[0.5][..]),
            ("\"500\"", &[0.5]),
            ("[500, 1000]", &[0.5, 1.0]),
            ("[\"500\", 1000.0]", &[0.5, 1.0]),
            ("\"500, 1000\"", &[0.5, 1.0]),
            ("\"500:1000:3\"", &[0.5, 0.75, 1.0]),
        ] {
            let (options, problems) = parse(&format!("[objects]\nheights_mm = {value}\n"), None);
            assert_eq!(problems, []);
            assert_eq!(options.objects.heights_m.unwrap().value, expected, "{value}");
        }
        assert_eq!(
            problems("[objects]\nheights_mm = \"500 mm, 1 m\"\n"),
            [
                "s.toml:2: heights_mm: \"500 mm\" is not a number | the unit is stated already (mm): write the number alone"
            ]
        );
    }

    #[test]
    fn every_problem_is_reported_with_its_line() {
        let got = problems(
            "[ground]\ncout = 3\nsite = 5\n[bulding]\nstoreys = 3\n[building]\nstorey_height = 3.2\nlevels = 4\n[objects]\nmass = \"3 m\"\nmass_kg = 4\n",
        );
        assert_eq!(
            got,
            [
                "s.toml:3: site must be text, not 5 | write it in \"quotes\"",
                "s.toml:2: unknown key cout in [ground] | did you mean count?",
                "s.toml:7: storey_height: \"3.2\" needs a unit | write \"3.2 m\" or \"3.2 mm\"",
                "s.toml:8: levels must be a list, not 4 | write levels = [{ name = \"roof\", level_ratio = 1.0 }]",
                "s.toml:11: mass and mass_kg both state the same value | keep one of them",
                "s.toml:10: mass: \"3 m\" is a length, a mass is expected | known units: kg, t",
                "s.toml:4: unknown table [bulding] | did you mean [building]?",
            ]
        );
    }

    #[test]
    fn text_that_is_not_toml_is_one_message_with_its_line() {
        let got = problems("[ground]\ncount = = 3\n");
        assert!(got[0].starts_with("s.toml:2: not TOML: "), "{got:?}");
        // One fault is one message: no key without a value, no table cut short, is reported beside it.
        for text in [
            "[ground]\nseed=\n",
            "[ground]\nseed = \n[objects]\nmass = 3\n",
            "[ground]\rcount = 3\r[objects]\rmass = \"150 kg\"\r",
            "[ground\ncount = \"x\"\n",
        ] {
            let got = problems(text);
            assert!(got.len() == 1 && got[0].contains("not TOML"), "{text:?}: {got:?}");
        }
        assert!(problems("[ground]\rcount = 3\r")[0].contains("CR LF"));
    }

    #[test]
    fn nearest_words() {
        assert_eq!(nearest("storey_hight", &["storeys", "storey_height"]), Some("storey_height"));
        assert_eq!(nearest("banana", &["storeys", "storey_height"]), None);
        assert_eq!(nearest("x", &[]), None);
    }
}
