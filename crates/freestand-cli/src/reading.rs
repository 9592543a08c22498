//! Flags for record files, and how a command reads its motions from them.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_input::file::as_named;
use freestand_input::keys::KeyStyle;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_records::processing::parse_target_source;
use freestand_study::recorded::{MotionFiles, ReadMotion, Upward, read_all};

use crate::failure::Failure;
use crate::keys::Keys;
use crate::processing::ReadKeys;
use crate::values::{Given, Reads, Values};

/// Flags for how records are read and processed.
#[derive(Debug, Clone, Args)]
pub(crate) struct ReadArgs {
    #[command(flatten)]
    keys: Keys<ReadKeys>,
}

/// Flags for reading the vertical record of a motion. `--vertical`, which names it, is a flag of
/// the command itself.
#[derive(Debug, Clone, Args)]
pub(crate) struct VerticalArgs {
    /// Factor that multiplies the vertical samples [default: 1]
    #[arg(long, any = Dimension::Ratio, requires = "vertical")]
    vertical_scale: Option<Given>,
    /// Component to read from the vertical record, if it has several
    #[arg(long, value_name = "NAME|NUMBER", requires = "vertical")]
    vertical_component: Option<String>,
}

impl VerticalArgs {
    /// The motions of vertical records: unit, step, baseline and filters are those of the
    /// horizontal record; scale and component are their own, and they are not rotated.
    pub(crate) fn read_all(
        &self,
        horizontal: &ReadArgs,
        paths: &[PathBuf],
    ) -> Result<Vec<ReadMotion>, Failure> {
        let mut values = Values::default();
        let scale = values.read(&self.vertical_scale);
        let mut read = horizontal.clone();
        let words = &mut read.keys.words;
        for key in [
            "component",
            "scale",
            "azimuth",
            "scale_to",
            "scale_to_sa",
            "scale_to_spectrum",
        ] {
            words.remove(key);
        }
        self.vertical_component
            .iter()
            .for_each(|name| words.set("component", name));
        scale
            .iter()
            .for_each(|ratio| words.set("scale", ratio.to_string()));
        let files = read.files(paths, &mut values);
        values.finish()?;
        Ok(read_all(&MotionFiles {
            vertical: Upward::Itself("vertical_component"),
            ..files
        })?)
    }
}

/// Keys that are next to `motions` in a study; the others are in `processing`.
const FILE_KEYS: [&str; 5] = ["unit", "dt", "component", "station_xml", "scale"];

impl ReadArgs {
    /// Refuses these flags if no record is read; the hint is made from their keys in a study.
    pub(crate) fn refuse_without_record(
        &self,
        hint: impl FnOnce(&str) -> String,
    ) -> Result<(), Failure> {
        let given = || self.keys.words.entries().map(|(key, _)| key);
        if self.keys.words.is_empty() {
            return Ok(());
        }
        let flags: Vec<String> = given().map(|key| KeyStyle::Flag.name(key)).collect();
        let table = |key| {
            if FILE_KEYS.contains(&key) {
                ""
            } else {
                "processing."
            }
        };
        let keys: Vec<String> = given().map(|key| format!("{}{key}", table(key))).collect();
        Err(Failure::usage(
            format!("{} without a record", flags.join(", ")),
            hint(&keys.join(", ")),
        ))
    }

    /// The files and how to read them; problems are added to `values`.
    pub(crate) fn files(&self, paths: &[PathBuf], values: &mut Values) -> MotionFiles {
        let mut reader = WordReader::new(&self.keys.words);
        let files = MotionFiles::read(&mut reader, as_named);
        reader
            .problems
            .into_iter()
            .for_each(|problem| values.push(problem));
        MotionFiles {
            paths: paths.to_vec(),
            ..files
        }
    }

    /// The files that are read: records, the StationXML that is named, and the target that they are
    /// scaled to.
    pub(crate) fn inputs<'a>(
        &self,
        records: impl IntoIterator<Item = &'a PathBuf>,
    ) -> Vec<PathBuf> {
        let target = self
            .keys
            .words
            .get("scale_to_spectrum")
            .and_then(|text| parse_target_source(text).ok());
        let station_xml = self.keys.words.get("station_xml").map(PathBuf::from);
        records
            .into_iter()
            .cloned()
            .chain(station_xml)
            .chain(target.map(|target| target.path))
            .collect()
    }

    /// One motion from each file.
    pub(crate) fn read_all(&self, paths: &[PathBuf]) -> Result<Vec<ReadMotion>, Failure> {
        let mut values = Values::default();
        let files = self.files(paths, &mut values);
        values.finish()?;
        Ok(read_all(&files)?)
    }
}

/// A path as text for outputs.
pub(crate) fn path_text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
