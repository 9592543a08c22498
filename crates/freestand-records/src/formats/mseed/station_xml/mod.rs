//! FDSN StationXML: the sensitivity and the direction of a channel. The response is not removed:
//! one number scales all frequencies, which is right where the response is flat.

use super::Source;
use crate::formats::instant::Instant;
use crate::motion_file::{Direction, ReadOptions};
use crate::notes::{Note, NoteKind};
use crate::text::units::record_unit;
use freestand_input::file::InputFile;
use freestand_input::file::load;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, shorten};
use roxmltree::{Document, Node, ParsingOptions};
use std::path::{Path, PathBuf};

/// Longest StationXML \[bytes\]. The inventory of a whole network has some hundred megabytes.
const MAX_BYTES: usize = 512 << 20;
/// Most XML nodes in such an inventory; each takes some tens of bytes while the file is read.
const MAX_NODES: u32 = 20_000_000;

/// The station descriptions for a record file: the one that the user names, or those next to the
/// file.
pub(super) struct Stations<'a> {
    record: &'a Path,
    named: Option<&'a Path>,
    read: Vec<Inventory>,
}

/// One StationXML.
pub(super) struct Inventory {
    file: InputFile,
    /// Where each line but the first begins.
    line_starts: Vec<usize>,
    epochs: Vec<Epoch>,
}

/// A channel during a time in which nothing about it changed.
struct Epoch {
    source: Source,
    /// Where its element begins.
    at: usize,
    start: Option<Instant>,
    end: Option<Instant>,
    /// A start or an end that cannot be read.
    bad_date: Option<String>,
    azimuth_deg: Option<f64>,
    dip_deg: Option<f64>,
    sensitivity: Option<Sensitivity>,
    is_polynomial: bool,
}

/// `InstrumentSensitivity`: counts for one unit of ground motion.
#[derive(Debug, Clone, PartialEq)]
struct Sensitivity {
    value: Option<f64>,
    frequency_hz: Option<f64>,
    input: String,
    output: String,
}

/// How to convert counts to m/s².
#[derive(Debug)]
pub(super) struct Scaling {
    pub(super) counts_per_m_s2: f64,
    pub(super) direction: Option<Direction>,
    pub(super) notes: Vec<Note>,
}

/// What an instrument measures.
#[derive(Debug)]
pub(super) enum Sensed {
    Acceleration(Scaling),
    /// Something else. The file is correct, but the channel cannot be used.
    Other(Problem),
}

/// Attributes of one element; those of a StationXML have some ten. The parser compares each with all before it.
const MAX_ATTRIBUTES: usize = 100;

fn has_too_many_attributes(bytes: &[u8]) -> bool {
    bytes
        .split(|b| *b == b'<')
        .any(|element| element.len() > 4 * MAX_ATTRIBUTES && attributes(element) > MAX_ATTRIBUTES)
}

/// The attributes behind a `<`. A value in quotes may contain `>` and `=`.
fn attributes(element: &[u8]) -> usize {
    let mut quote = None;
    let mut count = 0;
    for byte in element {
        match (byte, quote) {
            (b'"' | b'\'', None) => quote = Some(byte),
            (_, Some(open)) if byte == open => quote = None,
            (b'=', None) => count += 1,
            (b'>', None) => break,
            _ => {}
        }
    }
    count
}

impl<'a> Stations<'a> {
    pub(super) fn new(record: &'a Path, options: &'a ReadOptions) -> Self {
        Self {
            record,
            named: options.station_xml.as_deref(),
            read: Vec::new(),
        }
    }

    /// The description of a channel's station, where there is one.
    ///
    /// # Errors
    /// A file that cannot be read or is not StationXML.
    pub(super) fn of(&mut self, source: &Source) -> Result<Option<&Inventory>, Problem> {
        let named = self.named.map(Path::to_path_buf);
        let Some(path) = named.or_else(|| next_to(self.record, source)) else {
            return Ok(None);
        };
        if !self.read.iter().any(|one| one.file.path == path) {
            self.read.push(Inventory::parse(&load(&path)?, &path)?);
        }
        Ok(self.read.iter().find(|one| one.file.path == path))
    }
}

/// The first of these files next to `CI.CLC..HNE.D.mseed`: the name of the channel or the station
/// with `.xml`, or the file's own name, shortened dot by dot.
fn next_to(record: &Path, source: &Source) -> Option<PathBuf> {
    let mut names = Vec::new();
    // A name from a record must not lead out of its folder.
    let is_plain = |text: &str| text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-');
    if let Some(station) = source.full_station()
        && [
            &source.network,
            &source.station,
            &source.location,
            &source.channel,
        ]
        .iter()
        .all(|part| is_plain(part))
    {
        names.extend([source.full_name(), station]);
    }
    let mut stem = crate::motion_file::file_stem(record);
    loop {
        names.push(stem.clone());
        let Some(dot) = stem.rfind('.').filter(|&dot| dot > 0) else {
            break;
        };
        stem.truncate(dot);
    }
    names
        .iter()
        .map(|name| record.with_file_name(format!("{name}.xml")))
        .find(|path| path != record && path.is_file())
}

impl Inventory {
    fn parse(bytes: &[u8], path: &Path) -> Result<Self, Problem> {
        let refused = |message: String| {
            Problem::format(
                message,
                "fetch the station's description as StationXML, level response or channel",
            )
            .in_file(path)
        };
        if bytes.len() > MAX_BYTES {
            return Err(refused("is longer than 512 MiB".to_owned()));
        }
        let text =
            std::str::from_utf8(bytes).map_err(|_| refused("is not UTF-8 text".to_owned()))?;
        if has_too_many_attributes(bytes) {
            return Err(refused(format!(
                "has an element with more than {MAX_ATTRIBUTES} attributes"
            )));
        }
        // A document type, with which entities could grow without bound, is refused by default.
        let options = ParsingOptions {
            nodes_limit: MAX_NODES,
            ..ParsingOptions::default()
        };
        let document = Document::parse_with_options(text, options).map_err(|error| {
            let line = error.pos().row as usize;
            refused(format!("is not XML: {}", shorten(&error.to_string()))).at_line(line)
        })?;
        let root = document.root_element();
        if root.tag_name().name() != "FDSNStationXML" {
            return Err(refused(format!(
                "is not StationXML, but <{}>",
                shorten(root.tag_name().name())
            )));
        }
        let mut epochs = Vec::new();
        for network in children(root, "Network") {
            for station in children(network, "Station") {
                epochs.extend(
                    children(station, "Channel").map(|channel| epoch(network, station, channel)),
                );
            }
        }
        let line_starts = text.match_indices('\n').map(|(at, _)| at + 1).collect();
        Ok(Self {
            file: InputFile::new(path, bytes),
            line_starts,
            epochs,
        })
    }

    /// The file.
    pub(super) fn file(&self) -> &InputFile {
        &self.file
    }

    /// The file's name, for notes.
    pub(super) fn name(&self) -> String {
        self.file
            .path
            .file_name()
            .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    }

    /// How to convert the counts of a channel between two times to m/s².
    ///
    /// # Errors
    /// No epoch with the start of the record, epochs that contradict each other, or no sensitivity.
    pub(super) fn scaling(
        &self,
        source: &Source,
        start: Instant,
        end: Instant,
    ) -> Result<Sensed, Problem> {
        let name = source.full_name();
        let of_channel = || self.epochs.iter().filter(|epoch| epoch.source == *source);
        let begun = |epoch: &Epoch| {
            epoch.start.is_none_or(|from| from <= start)
                && epoch.end.is_none_or(|until| start < until)
        };
        let mut matching = of_channel().filter(|epoch| begun(epoch));
        let Some(epoch) = matching.next() else {
            let (what, hint) = if of_channel().next().is_some() {
                (
                    format!("has no epoch of {name} at {start}"),
                    "fetch the description for the time of the record".to_owned(),
                )
            } else {
                (
                    format!("does not describe {name}"),
                    format!(
                        "it describes {}; name another file with `station_xml`",
                        self.listing()
                    ),
                )
            };
            return Err(Problem::value(what, hint).in_file(&self.file.path));
        };
        let refused = |message: String| {
            Problem::new(ProblemKind::Value, format!("{name}: {message}"))
                .in_file(&self.file.path)
                .at_line(self.line_of(epoch.at))
        };
        if let Some(date) = of_channel().find_map(|epoch| epoch.bad_date.as_deref()) {
            return Err(refused(format!("\"{}\" is not a date", shorten(date)))
                .hint("write the dates of its epochs as 2012-04-13T17:28:00"));
        }
        if let Some(other) = matching.find(|other| other.sensitivity != epoch.sensitivity) {
            let line = self.line_of(other.at);
            return Err(refused(format!(
                "two epochs with different sensitivities cover {start}; the other is on line {line}"
            ))
            .hint("keep the right one in the file"));
        }
        let (counts_per_m_s2, words) = match epoch.scaling() {
            Ok(scaling) => scaling,
            Err(Refusal::Wrong(message, hint)) => return Err(refused(message).hint(hint)),
            Err(Refusal::Other(message)) => {
                let hint = "use the record of the accelerometer (channels HN?, BN?)";
                return Ok(Sensed::Other(refused(message).hint(hint)));
            }
        };
        let file = self.name();
        let words = format!(
            "counts are divided by the sensitivity in {file}, {words}; the response of the instrument is not removed"
        );
        let mut notes = vec![Note::of(&name, NoteKind::Sensitivity, words)];
        if epoch.end.is_some_and(|until| until < end) {
            let words = format!("the record continues past the end of its epoch in {file}");
            notes.push(Note::of(&name, NoteKind::EpochEnds, words));
        }
        Ok(Sensed::Acceleration(Scaling {
            counts_per_m_s2,
            direction: epoch.direction(),
            notes,
        }))
    }

    fn line_of(&self, at: usize) -> usize {
        self.line_starts.partition_point(|&start| start <= at) + 1
    }

    fn listing(&self) -> String {
        const MAX: usize = 8;
        let mut names: Vec<String> = Vec::new();
        for epoch in &self.epochs {
            let name = epoch.source.full_name();
            if !names.contains(&name) {
                names.push(name);
            }
            if names.len() > MAX {
                names[MAX] = "and more".to_owned();
                break;
            }
        }
        if names.is_empty() {
            "no channels".to_owned()
        } else {
            let names: Vec<String> = names.iter().map(|name| shorten(name)).collect();
            names.join(", ")
        }
    }
}

/// Why counts cannot be converted to m/s².
enum Refusal {
    /// The instrument measures something else; the text says what.
    Other(String),
    /// The description is incomplete: why, and what to do.
    Wrong(String, &'static str),
}

const CORRECT_IT: &str = "correct it, or state the unit with `unit`";

impl Epoch {
    /// Counts per m/s², and the same in words.
    fn scaling(&self) -> Result<(f64, String), Refusal> {
        let Some(sensitivity) = &self.sensitivity else {
            let what = if self.is_polynomial {
                "a polynomial response, and no InstrumentSensitivity"
            } else {
                "no InstrumentSensitivity"
            };
            return Err(Refusal::Wrong(
                format!("the channel has {what}"),
                "fetch the description with level=response, or state the unit with `unit`",
            ));
        };
        sensitivity.counts_per_m_s2(&self.source)
    }

    /// Dip is in degrees below the horizon, azimuth in degrees from north. A sensor within five
    /// degrees of an axis has the name of that axis, as SEED names channels.
    fn direction(&self) -> Option<Direction> {
        let (Some(azimuth), Some(dip)) = (self.azimuth_deg, self.dip_deg) else {
            return Direction::parse(&self.source.channel);
        };
        if (dip + 90.0).abs() <= 5.0 {
            Some(Direction::Up)
        } else {
            (dip.abs() <= 5.0 && azimuth.is_finite())
                .then(|| Direction::Azimuth(azimuth.rem_euclid(360.0)))
        }
    }
}

impl Sensitivity {
    fn counts_per_m_s2(&self, source: &Source) -> Result<(f64, String), Refusal> {
        let (input, output) = (shorten(&self.input), shorten(&self.output));
        let Some(value) = self
            .value
            .filter(|value| *value != 0.0 && value.is_finite())
        else {
            let message = "the InstrumentSensitivity has no value".to_owned();
            return Err(Refusal::Wrong(message, CORRECT_IT));
        };
        if !self.output.to_lowercase().contains("count") {
            let message = format!("the sensitivity is of \"{output}\", not of counts");
            return Err(Refusal::Wrong(
                message,
                "fetch a description whose sensitivity is in counts, the output of the digitizer",
            ));
        }
        match record_unit(&self.input) {
            Some(unit) if unit.dimension == Dimension::Acceleration => {
                Ok((value / unit.to_si(1.0), format!("{value} counts/({input})")))
            }
            Some(unit) if unit.dimension == Dimension::Length => {
                let Some(frequency_hz) = self.frequency_hz.filter(|f| *f > 0.0 && f.is_finite())
                else {
                    let message = format!(
                        "the sensitivity is to displacement ({input}), but its frequency is missing"
                    );
                    return Err(Refusal::Wrong(message, CORRECT_IT));
                };
                // Instrument code N means an accelerometer, whatever the unit of its sensitivity.
                if source.channel.chars().nth(1) != Some('N') {
                    let message = format!(
                        "the sensitivity is to displacement ({input}); an accelerometer is expected"
                    );
                    return Err(Refusal::Other(message));
                }
                let omega_rad_s = std::f64::consts::TAU * frequency_hz;
                let words = format!(
                    "{value} counts/({input}) at {frequency_hz} Hz: at that frequency, a displacement of 1 means an \
                     acceleration of (2 pi f)^2"
                );
                Ok((value / unit.to_si(1.0) / (omega_rad_s * omega_rad_s), words))
            }
            Some(unit) => {
                let what = unit.dimension.with_article();
                Err(Refusal::Other(format!(
                    "the instrument measures {what} ({input}); an acceleration is expected"
                )))
            }
            None => Err(Refusal::Other(format!(
                "the instrument measures \"{input}\"; an acceleration such as M/S**2 is expected"
            ))),
        }
    }
}

fn epoch(network: Node<'_, '_>, station: Node<'_, '_>, channel: Node<'_, '_>) -> Epoch {
    let code =
        |node: Node<'_, '_>, name| node.attribute(name).unwrap_or_default().trim().to_owned();
    let written = |name| channel.attribute(name);
    let time = |name| written(name).and_then(Instant::parse);
    let bad_date = ["startDate", "endDate"]
        .into_iter()
        .filter_map(written)
        .find(|text| Instant::parse(text).is_none());
    // "--" means the empty location in requests and in some descriptions.
    let location = code(channel, "locationCode").replace("--", "");
    let response = children(channel, "Response").next();
    let in_response = |name| response.and_then(|response| children(response, name).next());
    let sensitivity = in_response("InstrumentSensitivity").map(|node| Sensitivity {
        value: number(node, "Value"),
        frequency_hz: number(node, "Frequency"),
        input: unit_name(node, "InputUnits"),
        output: unit_name(node, "OutputUnits"),
    });
    Epoch {
        source: Source {
            network: code(network, "code"),
            station: code(station, "code"),
            location,
            channel: code(channel, "code"),
        },
        at: channel.range().start,
        start: time("startDate"),
        end: time("endDate"),
        bad_date: bad_date.map(str::to_owned),
        azimuth_deg: number(channel, "Azimuth"),
        dip_deg: number(channel, "Dip"),
        sensitivity,
        is_polynomial: in_response("InstrumentPolynomial").is_some(),
    }
}

/// Children of one name, in any namespace: some writers omit it.
fn children<'a, 'input>(
    node: Node<'a, 'input>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'input>> {
    node.children()
        .filter(move |child| child.is_element() && child.tag_name().name() == name)
}

fn number(node: Node<'_, '_>, name: &'static str) -> Option<f64> {
    children(node, name).next()?.text()?.trim().parse().ok()
}

fn unit_name(node: Node<'_, '_>, name: &'static str) -> String {
    let unit = children(node, name)
        .next()
        .and_then(|unit| children(unit, "Name").next());
    unit.and_then(|name| name.text())
        .unwrap_or_default()
        .trim()
        .to_owned()
}

#[cfg(test)]
mod tests;
