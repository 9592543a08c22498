//! miniSEED 2 (SEED 2.4) and 3 (FDSN): counts of a digitizer in records, several channels per
//! file; no unit.

mod record;
mod series;
mod station_xml;
mod steim;

pub(super) use record::Source;

use crate::motion_file::{
    Component, Direction, Found, ReadOptions, Reading, Start, file_stem, without_line,
};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::Block;
use freestand_input::problem::Problem;
use freestand_input::quantity::Unit;
use freestand_input::words::counted;
use record::{Record, header_order, is_version3, version2, version3};
use series::{Series, join};
use station_xml::{Sensed, Stations};
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Whether the file begins with a record of miniSEED, or with the control headers of a full SEED
/// volume.
pub(super) fn is_mseed(bytes: &[u8]) -> bool {
    let begins = |bytes: &[u8]| is_version3(bytes) || header_order(bytes).is_some();
    let is_volume = is_control_header(bytes) && bytes.get(6) == Some(&b'V');
    // A file may begin with numbered blank records.
    let is_late = || {
        let mut starts = (SKIP..bytes.len().min(1 << 16)).step_by(SKIP);
        is_blank(bytes) && starts.any(|at| begins(&bytes[at..]))
    };
    begins(bytes) || is_volume || is_late()
}

/// Reads every channel of the file that has samples.
pub(super) fn read(bytes: &[u8], path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let scan = scan(bytes)?;
    let mut notes = scan.notes();
    let format = if is_version3(bytes) {
        "miniSEED 3"
    } else {
        "miniSEED 2"
    };
    let mut channels = Vec::new();
    for (source, records) in scan.channels {
        channels.extend(join(source, records)?);
    }
    let names = names(&channels, path);
    let mut stations = Stations::new(path, options);
    let (mut components, mut first_left_out) = (Vec::new(), None);
    for (series, name) in channels.into_iter().zip(names) {
        let (source, start) = (
            series.source.clone(),
            Some(Start::Date(series.start.seconds())),
        );
        match scaled(series, name, &mut stations, options, &mut notes)? {
            Ok(found) => {
                let component = found.component(options).map_err(|mut problem| {
                    problem.message = format!("{}: {}", source.full_name(), problem.message);
                    without_line(problem)
                })?;
                let station_xml = stations
                    .of(&source)?
                    .map(|inventory| inventory.file().clone());
                components.push(Component {
                    start,
                    station_xml,
                    ..component
                });
            }
            Err(problem) => {
                notes.push(Note::new(
                    NoteKind::ChannelLeftOut,
                    format!("{}; it was left out", problem.message),
                ));
                first_left_out.get_or_insert(problem);
            }
        }
    }
    if components.is_empty() {
        if let Some(problem) = first_left_out {
            return Err(problem);
        }
        return Err(Problem::format(
            "holds no records with samples",
            "use a file with data; a dataless SEED volume describes stations only",
        ));
    }
    Ok(Reading {
        format,
        components,
        notes,
    })
}

/// Converts counts to m/s² with the sensitivity of a StationXML, or reads them in the user's unit.
/// The inner error is a channel that is not an acceleration: it is left out, and the file is
/// refused only if no channel remains.
fn scaled(
    series: Series,
    name: String,
    stations: &mut Stations<'_>,
    options: &ReadOptions,
    notes: &mut Vec<Note>,
) -> Result<Result<Found, Problem>, Problem> {
    let Series {
        source,
        start,
        end,
        dt_s,
        mut values,
        notes: found,
    } = series;
    notes.extend(found);
    let full_name = source.full_name();
    let (unit, direction) = match (stations.of(&source)?, options.unit()?) {
        (Some(inventory), Some(unit)) => {
            let message = format!(
                "{} gives the sensitivity of its counts, but the unit {} is given too",
                inventory.name(),
                unit.symbol
            );
            return Err(Problem::value(
                message,
                "leave out `unit`; if the values are already in that unit, move the StationXML file away",
            ));
        }
        (Some(inventory), None) => {
            let scaling = match inventory.scaling(&source, start, end)? {
                Sensed::Acceleration(scaling) => scaling,
                Sensed::Other(problem) => return Ok(Err(problem)),
            };
            for value in &mut values {
                *value /= scaling.counts_per_m_s2;
            }
            notes.extend(scaling.notes);
            (Unit::acceleration("m/s2", 0, 1.0), scaling.direction)
        }
        (None, Some(unit)) => {
            let words = format!(
                "the values are assumed to be in {}, without a sensitivity",
                unit.symbol
            );
            notes.push(Note::of(&full_name, NoteKind::UnitAssumed, words));
            (*unit, Direction::parse(&source.channel))
        }
        (None, None) => {
            let message = format!("{full_name}: the sensitivity of the counts is unknown");
            let station = source
                .full_station()
                .unwrap_or_else(|| "STATION".to_owned());
            return Err(Problem::value(
                message,
                format!(
                    "name its StationXML file with `station_xml`, or put it next to the record as {station}.xml; if the \
                 values already have a unit, state it with `unit`"
                ),
            ));
        }
    };
    let block = Block {
        values,
        first_line: 1,
    };
    Ok(Ok(Found {
        station: source.full_station(),
        direction,
        is_raw: true,
        ..Found::new(name, unit, (dt_s, 1), block)
    }))
}

/// The shortest names that tell the channels apart: `HNE`, `10.HNE`, `CI.CLC.10.HNE`.
fn names(channels: &[Series], path: &Path) -> Vec<String> {
    let ways: [fn(&Source) -> String; 3] = [
        |source| source.channel.clone(),
        |source| format!("{}.{}", source.location, source.channel),
        Source::full_name,
    ];
    let named = |way: &fn(&Source) -> String| {
        channels
            .iter()
            .map(|series| way(&series.source))
            .collect::<Vec<_>>()
    };
    let differ = |names: &Vec<String>| names.iter().collect::<HashSet<_>>().len() == names.len();
    let names = ways
        .iter()
        .map(named)
        .find(differ)
        .unwrap_or_else(|| named(&ways[2]));
    let or_file = |name: String| {
        if name.is_empty() {
            file_stem(path)
        } else {
            name
        }
    };
    names.into_iter().map(or_file).collect()
}

/// The records of a file.
#[derive(Default)]
struct Scan<'a> {
    /// In the order of their first records.
    channels: Vec<(Source, Vec<Record<'a>>)>,
    places: HashMap<Source, usize>,
    texts: usize,
    rateless: usize,
    control_headers: usize,
    /// Records that state 0 samples but hold data.
    countless: usize,
}

impl<'a> Scan<'a> {
    fn take(&mut self, source: Source, record: Record<'a>) {
        if record.encoding == Some(0) {
            self.texts += 1;
        } else if record.samples == 0 {
            self.countless += 1;
        } else if record.dt_s.is_none() {
            self.rateless += 1;
        } else if let Some((_, records)) = self
            .places
            .get(&source)
            .and_then(|&place| self.channels.get_mut(place))
        {
            records.push(record);
        } else {
            self.places.insert(source.clone(), self.channels.len());
            self.channels.push((source, vec![record]));
        }
    }

    fn notes(&self) -> Vec<Note> {
        let skipped = [
            (
                self.control_headers,
                "block",
                "of control headers ignored, with any response in them",
            ),
            (self.texts, "record", "of text ignored"),
            (self.rateless, "record", "without a sampling rate ignored"),
            (
                self.countless,
                "record",
                "with data, but 0 samples in the header, ignored: samples may be missing",
            ),
        ];
        skipped
            .iter()
            .filter(|(count, ..)| *count > 0)
            .map(|(count, noun, what)| {
                Note::new(
                    NoteKind::RowsIgnored,
                    format!("{} {what}", counted(*count, noun)),
                )
            })
            .collect()
    }
}

/// Control headers and records begin at multiples of this many bytes; blank records are skipped in
/// steps of it.
const SKIP: usize = 64;
/// Powers of two of the lengths of control headers: 256 to 65536 bytes.
const CONTROL_LENGTHS: std::ops::RangeInclusive<u32> = 8..=16;

fn scan(bytes: &[u8]) -> Result<Scan<'_>, Problem> {
    let mut scan = Scan::default();
    let (mut at, mut number) = (0, 0);
    let mut control_length = None;
    while at < bytes.len() {
        let rest = &bytes[at..];
        number += 1;
        let (record, length) = if is_version3(rest) {
            version3(bytes, at, number)?
        } else if let Some(order) = header_order(rest) {
            version2(bytes, at, number, order)?
        } else if is_control_header(rest) {
            scan.control_headers += 1;
            number -= 1;
            at += skip_control_header(rest, at, &mut control_length)?;
            continue;
        } else if is_blank(rest) {
            number -= 1;
            at += SKIP;
            continue;
        } else {
            let what = if rest.len() < SKIP {
                "is cut off"
            } else {
                "does not begin like a miniSEED record"
            };
            return Err(record::problem(number, at, what));
        };
        at += length;
        if let Some((source, record)) = record {
            scan.take(source, record);
        }
    }
    Ok(scan)
}

/// A volume, abbreviation, station or time span header of a full SEED volume.
fn is_control_header(bytes: &[u8]) -> bool {
    bytes.get(..8).is_some_and(|head| {
        head[..6].iter().all(u8::is_ascii_digit)
            && matches!(head[6], b'V' | b'A' | b'S' | b'T')
            && matches!(head[7], b' ' | b'*')
    })
}

/// The length of the control header at the start of `bytes`: as the first blockette of the volume
/// states, `010  98 2.412` (blockettes 005, 008, 010), else the distance between the first two
/// control headers; less if a record begins before.
///
/// # Errors
/// Bytes within it that text does not have: it may hide a damaged record of data.
fn skip_control_header(
    bytes: &[u8],
    at: usize,
    length: &mut Option<usize>,
) -> Result<usize, Problem> {
    *length = stated_length(bytes).or(*length);
    let most = length.unwrap_or(bytes.len()).min(bytes.len());
    for from in (SKIP..most).step_by(SKIP) {
        let next = &bytes[from..];
        let is_control = is_control_header(next);
        if is_control || is_version3(next) || header_order(next).is_some() {
            *length = length.or(is_control.then_some(from));
            return Ok(from);
        }
        let is_binary = |b: &u8| b.is_ascii_control() && !b.is_ascii_whitespace() && *b != 0;
        if next.iter().take(SKIP).any(is_binary) {
            return Err(Problem::format(
                format!(
                    "the control header at byte {at} has bytes at {} that are not text",
                    at + from
                ),
                "the file is damaged, and a record of data may be lost in it: fetch it again",
            ));
        }
    }
    Ok(most)
}

/// The power of two follows the blockette's number, length and version.
fn stated_length(bytes: &[u8]) -> Option<usize> {
    let head = bytes
        .get(8..21)
        .filter(|head| matches!(&head[..3], b"005" | b"008" | b"010"))?;
    let power = std::str::from_utf8(&head[11..]).ok()?.trim().parse().ok()?;
    CONTROL_LENGTHS.contains(&power).then_some(1 << power)
}

/// Whether these bytes fill the space between records: a number and blanks, or only blanks or
/// zeros.
fn is_blank(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(SKIP)];
    let (number, rest) = head.split_at(head.len().min(6));
    number
        .iter()
        .all(|b| b.is_ascii_digit() || matches!(b, b' ' | 0))
        && rest.iter().all(|b| matches!(b, b' ' | 0))
}

#[cfg(test)]
pub(super) mod fixture;
#[cfg(test)]
mod tests;
