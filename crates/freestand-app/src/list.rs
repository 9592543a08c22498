//! The list of an assessment: its study, and how it is read.

use std::path::PathBuf;

use freestand_assess::list::{ListRequest, inventory_of};
use freestand_input::problem::Problems;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_inventory::Inventory;
use freestand_study::building::MAX_STOREYS;
use freestand_study::resolve::{Overrides, StudySource, builtin};
use freestand_study::study::Study;

use crate::cells::{CellKeys, Libraries};
use crate::files::Files;
use crate::place::{self, FaultKeys, PlaceKeys};
use crate::request::{path, request};
use crate::study;

request! {
    /// The study of an assessment, its inventory, and how that is read.
    #[command(mut_args(|arg| place::under(arg, place::OF_STUDY)))]
    pub struct ListKeys {
        /// Study file (TOML) with hazard, building and settings [default: the built-in study]
        #[arg(value_name = "STUDY.toml")]
        pub study: Option<Written>,
        /// A place.
        #[command(flatten)]
        pub hazard: PlaceKeys,
        /// Its fault.
        #[command(flatten)]
        pub fault: FaultKeys,
        /// Inventory (CSV or XLSX); replaces the inventory of the study
        pub inventory = "FILE",
        /// How its cells are read.
        #[command(flatten)]
        pub cells: CellKeys,
        /// Number of storeys: of the building where the study states none, else only to place floors by their
        /// numbers [default: the study's]
        pub storeys = "N",
        /// Count every doubt about the list as an error
        pub strict = switch,
        /// Also assess objects that are reported as anchored, as if they were free
        pub assess_anchored = switch,
        /// The user's own libraries.
        #[command(flatten)]
        pub libraries: Libraries,
    }
}

/// The study of an assessment and its list, which have not been read.
#[derive(Debug, Clone)]
pub struct ListMeant {
    source: Option<StudySource>,
    overrides: Overrides,
    libraries: [Option<PathBuf>; 2],
    inventory: Option<PathBuf>,
    /// How the list is read.
    pub request: ListRequest,
}

impl ListMeant {
    /// The study, with what was given in place of its keys; `pages` are those of the report.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn study(&self, pages: Option<usize>) -> Result<Study, Problems> {
        let mut study = match &self.source {
            Some(source) => source.load(&self.overrides)?,
            None => builtin(&self.overrides)?,
        };
        let settings = &mut study.assessment;
        settings.seed = self.overrides.seed.unwrap_or(settings.seed);
        let [tolerances, cushions] = &self.libraries;
        settings.library = tolerances.clone().or(settings.library.take());
        settings.cushion_library = cushions.clone().or(settings.cushion_library.take());
        settings.pages = pages.unwrap_or(settings.pages);
        Ok(study)
    }

    /// The list, which the study may name.
    ///
    /// # Errors
    /// No list; a library, a mapping or a list that cannot be used.
    pub fn inventory(&self, study: &Study) -> Result<Inventory, Problems> {
        inventory_of(study, self.inventory.as_deref(), &self.request)
    }
}

impl ListKeys {
    /// The mapping file and the libraries.
    pub(crate) fn inputs(&self, files: &Files) -> Vec<PathBuf> {
        let libraries = [&self.libraries.library, &self.libraries.cushion_library];
        let libraries = libraries.map(|name| files.path_of(name.as_ref()));
        let mut inputs = self.cells.inputs(files);
        inputs.extend(libraries.into_iter().flatten());
        inputs.extend(self.hazard.input(files));
        inputs
    }

    /// What is asked of a study and its list.
    pub fn judged(&self, read: &mut WordReader<'_>, files: &Files, seed: Option<u64>) -> ListMeant {
        let hazard = self.hazard.words_with(&self.fault, read, files);
        read.pass(&place::FAULT_KEYS);
        let storeys = read.whole_within("storeys", 1..=MAX_STOREYS);
        ListMeant {
            source: study::source_without_flag(read, files),
            overrides: Overrides {
                seed,
                hazard,
                storeys,
                ..Overrides::default()
            },
            libraries: self.libraries.paths(read, files),
            inventory: path(read, "inventory", files),
            request: ListRequest {
                cells: self.cells.cells(read, files),
                storeys: storeys.map(usize::from),
                is_strict: read.flag("strict"),
                assess_anchored: read.flag("assess_anchored"),
            },
        }
    }
}
