//! Files of SAC, the Seismic Analysis Code: a header of 632 bytes and single-precision samples
//! without a unit.

use super::binary::{Order, as_written, field};
use super::instant::Instant;
use crate::motion_file::{
    Component, Direction, Found, ReadOptions, Reading, Start, file_stem, length_note, peak_note,
    refuse_not_finite, without_line,
};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::Block;
use crate::text::lines::{joined, lines};
use freestand_input::problem::{Problem, ProblemKind};
use std::path::Path;

/// Bytes before the samples.
const HEADER: usize = 632;
/// Double-precision values after the samples in version 7.
const FOOTER: usize = 22 * 8;
/// The value of a header number that is not set.
const UNSET: f32 = -12345.0;

/// Places of the header words that are used.
mod word {
    pub(super) const DELTA: usize = 0;
    pub(super) const DEPMIN: usize = 1;
    pub(super) const DEPMAX: usize = 2;
    pub(super) const SCALE: usize = 3;
    pub(super) const B: usize = 5;
    pub(super) const E: usize = 6;
    pub(super) const CMPAZ: usize = 57;
    pub(super) const CMPINC: usize = 58;
    /// Year, day of the year, hour, minute, second and millisecond of the reference time.
    pub(super) const NZYEAR: usize = 70;
    pub(super) const NVHDR: usize = 76;
    pub(super) const NPTS: usize = 79;
    pub(super) const IFTYPE: usize = 85;
    pub(super) const IDEP: usize = 86;
    pub(super) const LEVEN: usize = 105;
}

/// The byte order in which the header version is 6 or 7 and the other fields are possible.
fn order(bytes: &[u8]) -> Option<Order> {
    let fits = |order: &Order| {
        let at = |word: usize| order.i32(bytes, 4 * word);
        matches!(at(word::NVHDR), Some(6 | 7))
            && matches!(at(word::LEVEN), Some(0 | 1 | -12345))
            && at(word::IFTYPE).is_some_and(|kind| (1..=100).contains(&kind) || kind == -12345)
    };
    (bytes.len() >= HEADER)
        .then(|| [Order::Little, Order::Big].into_iter().find(fits))
        .flatten()
}

/// Whether this is a SAC file.
pub(super) fn is_sac(bytes: &[u8]) -> bool {
    order(bytes).is_some()
}

/// Whether this is a SAC file in text: five numbers per line, fourteen lines of reals, then whole
/// numbers, of which the seventh is the version; numbers that are not set are -12345.
pub(super) fn is_text_sac(bytes: &[u8]) -> bool {
    let head: Vec<String> = lines(bytes).take(16).map(|line| line.text()).collect();
    let words: Vec<Vec<&str>> = head
        .iter()
        .map(|text| text.split_whitespace().collect())
        .collect();
    let has_five = |fields: &Vec<&str>| {
        fields.len() == 5 && fields.iter().all(|field| field.parse::<f64>().is_ok())
    };
    words.len() == 16
        && words.iter().all(has_five)
        && matches!(words[15][1], "6" | "7")
        && words
            .iter()
            .flatten()
            .filter(|field| field.starts_with("-12345"))
            .count()
            > 5
}

/// Refuses SAC in text.
pub(super) fn read_text(_: &[u8], _: &Path, _: &ReadOptions) -> Result<Reading, Problem> {
    Err(Problem::format(
        "is an alphanumeric SAC file, which cannot be read",
        "convert it to binary SAC (in SAC: read alpha FILE, then write)",
    ))
}

/// Reads a SAC file.
pub(super) fn read(bytes: &[u8], path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let not_sac = || Problem::new(ProblemKind::Format, "is not a SAC file");
    let order = order(bytes).ok_or_else(not_sac)?;
    let header = Header { bytes, order };
    header.refuse_other_kinds()?;
    let version = header.integer(word::NVHDR);
    let stated = header.integer(word::NPTS);
    let npts = usize::try_from(stated).map_err(|_| {
        Problem::format(
            format!("the number of samples (NPTS) is {stated}"),
            "the file is damaged, or NPTS was never set: fetch it again",
        )
    })?;
    let footer = if version == 7 { FOOTER } else { 0 };
    if npts
        .checked_mul(4)
        .and_then(|size| size.checked_add(HEADER + footer))
        != Some(bytes.len())
    {
        let found = bytes.len().saturating_sub(HEADER + footer) as f64 / 4.0;
        return Err(Problem::format(
            format!("the header declares {npts} samples (NPTS), but the file has room for {found}"),
            "the file is damaged or cut off: fetch it again",
        ));
    }
    let Some(unit) = options.unit()? else {
        return Err(Problem::value(
            "a SAC file does not state its unit",
            "state it with `unit`: nm/s2 for files from data centres, g for records of the Community Seismic Network, \
             cm/s2 or m/s2 elsewhere",
        ));
    };
    let values: Vec<f64> = (0..npts)
        .filter_map(|i| order.f32(bytes, HEADER + 4 * i))
        .map(f64::from)
        .collect();
    refuse_not_finite(&values, "")?;
    let words = format!(
        "the samples are assumed to be in {}; a SAC file does not state its unit",
        unit.symbol
    );
    let mut notes = vec![Note::new(NoteKind::UnitAssumed, words)];
    notes.extend(header.notes());
    let text = |at: usize| header.text(at);
    let channel = text(600);
    let name = channel.clone().unwrap_or_else(|| file_stem(path));
    let dt_s = header.step(version, HEADER + 4 * npts)?;
    let block = Block {
        values,
        first_line: 1,
    };
    let component = Found {
        station: joined(
            &[
                &text(608).unwrap_or_default(),
                &text(440).unwrap_or_default(),
            ],
            ".",
        ),
        direction: header
            .direction()
            .or_else(|| channel.as_deref().and_then(Direction::parse)),
        is_raw: true,
        ..Found::new(name, *unit, (dt_s, 1), block)
    }
    .component(options)
    .map_err(without_line)?;
    let component = Component {
        start: header.start_s().map(Start::Date),
        ..component
    };
    if let (Some(begin_s), Some(end_s)) = (header.real(word::B), header.real(word::E)) {
        notes.extend(length_note(
            &component,
            f64::from(end_s) - f64::from(begin_s),
        ));
    }
    let stated = [word::DEPMIN, word::DEPMAX]
        .iter()
        .filter_map(|&at| header.real(at));
    notes.extend(peak_note(
        &component,
        unit.to_si(stated.fold(0.0, |a: f64, b| a.max(f64::from(b).abs()))),
    ));
    Ok(Reading {
        format: "SAC",
        components: vec![component],
        notes,
    })
}

fn not_acceleration(what: &str) -> (String, &'static str) {
    (
        format!("is {what}; an acceleration is expected"),
        "use the record of the accelerometer",
    )
}

/// The first 632 bytes.
struct Header<'a> {
    bytes: &'a [u8],
    order: Order,
}

impl Header<'_> {
    fn integer(&self, word: usize) -> i32 {
        self.order.i32(self.bytes, 4 * word).unwrap_or(-12345)
    }

    /// Time of the first sample: B seconds after the reference time, if the header has both.
    fn start_s(&self) -> Option<f64> {
        let field = |i: usize| u32::try_from(self.integer(word::NZYEAR + i)).ok();
        let (year, day) = (
            u16::try_from(field(0)?).ok()?,
            u16::try_from(field(1)?).ok()?,
        );
        let (hour, minute, second, millisecond) = (field(2)?, field(3)?, field(4)?, field(5)?);
        if hour > 24 || minute > 60 || second > 60 || millisecond > 1000 {
            return None;
        }
        let reference =
            Instant::from_day(year, day, [hour, minute, second], 1_000_000 * millisecond);
        Some(
            reference
                .later_by_s(f64::from(self.real(word::B)?))
                .seconds(),
        )
    }

    fn real(&self, word: usize) -> Option<f32> {
        self.order
            .f32(self.bytes, 4 * word)
            .filter(|value| *value != UNSET && value.is_finite())
    }

    /// A field of eight letters.
    fn text(&self, at: usize) -> Option<String> {
        Some(field(self.bytes, at, at + 8))
            .filter(|text| !text.is_empty() && !text.starts_with("-12345"))
    }

    fn refuse_other_kinds(&self) -> Result<(), Problem> {
        let (message, hint) = match (
            self.integer(word::IFTYPE),
            self.integer(word::LEVEN),
            self.integer(word::IDEP),
        ) {
            (2 | 3, ..) => (
                "is a spectrum; a time series (IFTYPE = ITIME) is expected".to_owned(),
                "transform it back to a time series",
            ),
            (1, 0, _) => (
                "has unevenly spaced samples (LEVEN is false)".to_owned(),
                "interpolate it to equal steps first",
            ),
            (1, 1, 5 | 8 | -12345) => return Ok(()),
            (1, 1, 6) => not_acceleration("a displacement (IDEP = IDISP)"),
            (1, 1, 7) => not_acceleration("a velocity (IDEP = IVEL)"),
            (1, 1, 50) => not_acceleration("a voltage (IDEP = IVOLTS)"),
            (1, 1, other) => (
                format!("holds an unknown quantity (IDEP = {other})"),
                "set IDEP = IACC if it is an acceleration",
            ),
            (1, other, _) => (
                format!("does not say whether its samples are evenly spaced (LEVEN = {other})"),
                "set LEVEN to true in the header if they are",
            ),
            (other, ..) => (
                format!("holds no time series (IFTYPE = {other})"),
                "use the time series of the same record (IFTYPE = ITIME)",
            ),
        };
        Err(Problem::format(message, hint))
    }

    /// The time step \[s\]: version 7 repeats it in double precision after the samples.
    fn step(&self, version: i32, footer_at: usize) -> Result<f64, Problem> {
        let double = (version == 7)
            .then(|| self.order.f64(self.bytes, footer_at))
            .flatten();
        let double = double.filter(|step| *step > 0.0 && step.is_finite());
        double
            .or_else(|| self.real(word::DELTA).map(as_written))
            .filter(|step| *step > 0.0)
            .ok_or_else(|| {
                Problem::format(
                    "the time step (DELTA) is missing",
                    "set DELTA in the header",
                )
            })
    }

    fn notes(&self) -> Option<Note> {
        let scale = self.real(word::SCALE).filter(|scale| *scale != 1.0)?;
        let words =
            format!("SCALE is {scale} in the header; the samples were not multiplied by it");
        Some(Note::new(NoteKind::FactorIgnored, words))
    }

    /// CMPINC is in degrees from the upward vertical, CMPAZ in degrees from north; within five
    /// degrees of an axis.
    fn direction(&self) -> Option<Direction> {
        let incidence = f64::from(self.real(word::CMPINC)?);
        if incidence.abs() <= 5.0 {
            return Some(Direction::Up);
        }
        let azimuth = as_written(self.real(word::CMPAZ)?);
        ((incidence - 90.0).abs() <= 5.0).then(|| Direction::Azimuth(azimuth.rem_euclid(360.0)))
    }
}

#[cfg(test)]
mod tests;
