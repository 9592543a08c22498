//! `inventory check`: how a list of objects is understood.

use std::path::PathBuf;

use freestand_assess::list::floors_of;
use freestand_input::problem::Problems;
use freestand_input::quantity::UnitSystem;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_inventory::library::Libraries;
use freestand_inventory::{
    CellsRequest, Floors, HeadingReport, Mapping, ReadOptions, Reading, SenseReport,
    inspect_headings, inspect_inventory, marked_copy,
};
use freestand_study::building::MAX_STOREYS;
use freestand_study::resolve::{Overrides, StudySource};
use schemars::JsonSchema;
use serde::Serialize;

use crate::cells::{CellKeys, Libraries as LibraryKeys};
use crate::files::Files;
use crate::request::{Question, Request as _, one_of, path_without_flag, reader, request};
use crate::study;

/// The schema of the response.
pub const SCHEMA: &str = "freestand.inventory/1";

request! { question
    /// A list, and how it is read.
    pub struct CheckList {
        /// List of objects (CSV, TSV or XLSX)
        #[arg(value_name = "FILE")]
        pub file: Option<Written>,
        /// How its cells are read.
        #[command(flatten)]
        pub how: CellKeys,
        /// Study file (TOML) whose building has the floors
        pub study = "FILE.toml",
        /// Number of storeys of the building, to place floors by their numbers
        pub storeys = "N",
        /// Units of the text; the JSON document is in SI [default: those of most columns]
        pub units = "UNITS" with (value_parser = one_of(&UnitSystem::ALL)),
        /// Count every doubt as an error
        pub strict = switch,
        /// Show only the headings, with examples of their cells and what each was taken for; also for a list of
        /// which too few headings are known
        pub headings = switch,
        /// Also list the text of every cell (with --json)
        pub cells = switch,
        /// The user's own libraries.
        #[command(flatten)]
        pub libraries: LibraryKeys,
    }
}

/// What is asked.
#[derive(Debug, Clone)]
pub struct Meant {
    /// The list.
    pub file: PathBuf,
    /// How its cells are read.
    pub cells: CellsRequest,
    /// Units of the text; `None`: those of most columns.
    pub units: Option<UnitSystem>,
    /// Whether only its headings are wanted.
    pub is_headings: bool,
    /// The files that are read.
    pub inputs: Vec<PathBuf>,
    study: Option<StudySource>,
    storeys: Option<usize>,
    is_strict: bool,
    wants_cells: bool,
    libraries: [Option<PathBuf>; 2],
}

impl Meant {
    /// The floors of the building.
    ///
    /// # Errors
    /// Everything that is wrong with the study.
    pub fn floors(&self) -> Result<Floors, Problems> {
        Ok(match &self.study {
            Some(source) => floors_of(&source.load(&Overrides::default())?, self.storeys),
            None => Floors {
                storeys: self.storeys,
                ..Floors::default()
            },
        })
    }

    /// The list as it is understood, and if it is wanted the workbook with a note at each cell that has a problem.
    /// `unread` is asked about the problems of a list that cannot be read.
    ///
    /// # Errors
    /// A file that is no list, a library or a mapping that cannot be used.
    pub fn reading(
        &self,
        floors: Floors,
        wants_copy: bool,
        unread: impl FnOnce(Problems) -> Problems,
    ) -> Result<(Reading, Option<Vec<u8>>), Problems> {
        let [tolerances, cushions] = &self.libraries;
        let libraries = Libraries::with_files(tolerances.as_deref(), cushions.as_deref())?;
        let mapping = self
            .cells
            .columns
            .as_deref()
            .map(Mapping::load)
            .transpose()?;
        libraries.looked_up(|lookup| {
            let options = ReadOptions {
                sheet: self.cells.sheet.as_deref(),
                mapping: mapping.as_ref(),
                floors,
                is_strict: self.is_strict,
                edits: &self.cells.edits,
                wants_cells: self.wants_cells,
                lookup,
            };
            let reading = inspect_inventory(&self.file, &options).map_err(unread)?;
            let copy = wants_copy
                .then(|| marked_copy(&self.file, &options, &reading.inventory.findings))
                .transpose()?;
            Ok((reading, copy))
        })
    }

    /// The headings alone.
    ///
    /// # Errors
    /// A file that is no table.
    pub fn headings(&self) -> Result<Vec<HeadingReport>, Problems> {
        inspect_headings(&self.file, self.cells.sheet.as_deref())
    }
}

/// Keys that say nothing about the headings alone.
const OF_CELLS: [&str; 9] = [
    "study",
    "storeys",
    "units",
    "strict",
    "cells",
    "columns",
    "edit",
    "library",
    "cushion_library",
];

impl Question for CheckList {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let is_headings = read.flag("headings");
        if is_headings {
            for key in OF_CELLS {
                if read.has(key) {
                    let message = format!("`{key}` says nothing about the headings alone");
                    read.note(&[key], message, "leave it out, or leave `headings` out");
                }
            }
        }
        let cells = self.how.cells(&mut read, files);
        let units = read.choice("units", &UnitSystem::ALL);
        let study = study::source(&mut read, files);
        let storeys = read.whole_within("storeys", 1..=MAX_STOREYS);
        let (is_strict, wants_cells) = (read.flag("strict"), read.flag("cells"));
        let libraries = self.libraries.paths(&mut read, files);
        let file = file(&mut read, files);
        let file = read.problems.finish(file)?;
        let mut inputs = vec![file.clone()];
        inputs.extend(self.how.inputs(files));
        inputs.extend(files.path_of(self.study.as_ref()));
        Ok(Meant {
            file,
            cells,
            units,
            is_headings,
            inputs,
            study,
            storeys: storeys.map(usize::from),
            is_strict,
            wants_cells,
            libraries,
        })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.resolve(files)?.floors().map(drop)
    }
}

fn file(read: &mut WordReader<'_>, files: &Files) -> Option<PathBuf> {
    let hint = "name a file, such as objects.csv";
    read.require("file", "no list is named", hint);
    path_without_flag(read, "file", files)
}

/// The headings of a list alone.
#[derive(Debug, Serialize, JsonSchema)]
pub struct HeadingsReport {
    /// The file.
    pub path: String,
    /// Its columns.
    pub headings: Vec<HeadingReport>,
    /// What a column can be taken for.
    pub senses: Vec<SenseReport>,
}
