//! Flags for record files, and how a command reads its motions from them.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_input::file::as_named;
use freestand_input::word_reader::WordReader;
use freestand_records::processing::parse_target_source;
use freestand_study::recorded::{MotionFiles, ReadMotion, Upward, read_all};

use crate::failure::Failure;
use crate::keys::Keys;
use crate::processing::ReadKeys;
use crate::values::Values;

/// Flags for how records are read and processed.
#[derive(Debug, Clone, Args)]
pub(crate) struct ReadArgs {
    #[command(flatten)]
    keys: Keys<ReadKeys>,
}

impl ReadArgs {
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

    /// One motion from each file; they need not be horizontal.
    pub(crate) fn read_any(&self, paths: &[PathBuf]) -> Result<Vec<ReadMotion>, Failure> {
        self.read_as(paths, |files| files.vertical = Upward::Itself("component"))
    }

    fn read_as(
        &self,
        paths: &[PathBuf],
        change: impl FnOnce(&mut MotionFiles),
    ) -> Result<Vec<ReadMotion>, Failure> {
        let mut values = Values::default();
        let mut files = self.files(paths, &mut values);
        values.finish()?;
        change(&mut files);
        Ok(read_all(&files)?)
    }

    /// The motion of one file, read by [`ReadArgs::read_all`] or [`ReadArgs::read_any`].
    pub(crate) fn read_one(
        &self,
        path: &Path,
        read: impl FnOnce(&Self, &[PathBuf]) -> Result<Vec<ReadMotion>, Failure>,
    ) -> Result<ReadMotion, Failure> {
        let mut motions = read(self, &[path.to_path_buf()])?;
        motions
            .pop()
            .ok_or_else(|| Failure::computation("the file was read but contains no motion"))
    }
}

/// A path as text for outputs.
pub(crate) fn path_text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
