//! Formats of record files. A format is recognised by the content of a file, never by its name.
//!
//! A family of formats is one module with a function that recognises its files and a function that
//! reads them. To add one, write the module and add a line to `FAMILIES` below. Several families
//! share a module: `volumes` is the layout of `csmip` and `usc`; `binary` and `instant` are the
//! numbers and times that `mseed` and `sac` read.

mod at2;
mod bhrc;
mod binary;
mod columns;
mod cosmos;
mod csmip;
mod cwa;
mod dyna;
mod geonet;
mod instant;
mod knet;
mod long_table;
mod mseed;
mod nsmn;
mod sac;
mod sigma;
mod smc;
mod unam;
mod usc;
mod volumes;

pub(crate) use crate::motion_file::check_step;
pub use crate::motion_file::{Component, Direction, MotionFile, ReadOptions, Start, parse_unit};
pub use crate::text::sensitivity::{Sensitivity, parse_sensitivity};
pub use crate::write::{write_at2, write_csv, write_pair_csv};

use std::path::Path;

use crate::motion_file::{Reading, doubts};
use crate::notes::printable;
use crate::tables::hazard;
use crate::text::lines::check_text;
use crate::text::sensitivity::not_in_volts;
use freestand_input::file::load;
use freestand_input::problem::{Problem, Problems};

/// Reads a record file.
///
/// # Errors
/// A file that cannot be read, is of an unknown format, is broken or has gaps. A unit or time step
/// that neither the file nor the options state: nothing is guessed from the size of values.
pub fn read_motions(path: &Path, options: &ReadOptions) -> Result<MotionFile, Problems> {
    parse_motions(load(path)?, path, options)
}

/// As [`read_motions`], from bytes in memory; `path` names them in messages. The StationXML of a
/// miniSEED file is looked for next to it.
///
/// # Errors
/// As [`read_motions`].
///
/// # Example
/// ```
/// use freestand_records::formats::{ReadOptions, parse_motions};
/// let file = parse_motions(b"time [s],a [g]\n0,0\n0.01,0.5\n".to_vec(), "x.csv".as_ref(), &ReadOptions::default())?;
/// assert_eq!(file.components[0].motion.peak_m_s2(), 0.5 * freestand::G0_M_S2);
/// # Ok::<(), freestand_input::problem::Problems>(())
/// ```
pub fn parse_motions(
    mut bytes: Vec<u8>,
    path: &Path,
    options: &ReadOptions,
) -> Result<MotionFile, Problems> {
    // Checked first, because a wrong option is not a fault of the file.
    options.check()?;
    let read = reader(&mut bytes, options).map_err(|problem| problem.in_file(path))?;
    let reading = read(&bytes, path, options).and_then(Reading::with_components);
    let Reading {
        format,
        mut components,
        mut notes,
    } = reading.map_err(|problem| problem.in_file(path))?;
    if !options.is_shock {
        notes.extend(components.iter().flat_map(doubts));
    }
    // What a header holds goes to terminals and into tables.
    for component in &mut components {
        component.name = printable(&component.name);
        component.station = component.station.as_deref().map(printable);
    }
    let file = MotionFile {
        path: path.to_path_buf(),
        format,
        components,
        notes,
    };
    Ok(file.with_unused(options))
}

/// A family of formats that share a layout: whether a file is one of them, by its first lines, and what reads it. The
/// first family that recognises a file reads it.
type Family = (fn(&[u8]) -> bool, Reader);

type Reader = fn(&[u8], &Path, &ReadOptions) -> Result<Reading, Problem>;

/// Binary formats. They come first: what they do not recognise must be text.
const BINARY: &[Family] = &[(mseed::is_mseed, mseed::read), (sac::is_sac, sac::read)];

/// From the most specific signature to the least. What no family recognises is read as columns.
const FAMILIES: &[Family] = &[
    (smc::is_smc, smc::read),
    (cosmos::is_cosmos, cosmos::read),
    (geonet::is_geonet, geonet::read),
    (usc::is_usc, usc::read),
    (csmip::is_csmip, csmip::read),
    (knet::is_knet, knet::read),
    (cwa::is_cwa, cwa::read),
    (unam::is_unam, unam::read),
    (bhrc::is_bhrc, bhrc::read),
    (dyna::is_dyna, dyna::read),
    (nsmn::is_nsmn, nsmn::read),
    (sigma::is_sigma, sigma::read),
    (sac::is_text_sac, sac::read_text),
    (at2::is_at2, at2::read),
    (long_table::is_long_table, long_table::read),
];

/// How much of a text is searched for signatures: more than the longest header, which has 300 lines
/// of 80 characters. Without this limit, a file of one endless line would take long to search.
const SNIFFED_BYTES: usize = 64 << 10;

/// The reader for the content. What is not binary must be text.
///
/// # Errors
/// Something else. A sensitivity for a format that has no columns in volts.
fn reader(bytes: &mut Vec<u8>, options: &ReadOptions) -> Result<Reader, Problem> {
    let mut family = BINARY.iter().find(|(recognises, _)| recognises(bytes));
    if family.is_none() {
        if let Some(format) = hazard::recognised(bytes) {
            let message = format!("is a hazard file ({}), not a record", format.name());
            let hint = "name it as `spectrum` beside a place, or as `hazard` of freestand risk";
            return Err(Problem::format(message, hint));
        }
        check_text(bytes)?;
        let head = &bytes[..bytes.len().min(SNIFFED_BYTES)];
        family = FAMILIES.iter().find(|(recognises, _)| recognises(head));
    }
    match (family, options.sensitivity) {
        (None, _) => Ok(columns::read),
        (Some((_, read)), None) => Ok(*read),
        (Some(_), Some(_)) => Err(not_in_volts("the record")),
    }
}

#[cfg(test)]
mod tests;
