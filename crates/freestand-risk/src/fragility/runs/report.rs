//! What runs tell.

use freestand::fragility::resurrections;
use freestand_assess::verdict::{NoShockLimits, NotFollowed};
use freestand_input::file::InputFile;
use freestand_output::table::Table;
use strum::EnumCount;

use super::super::doubt::HazardDoubt;
use super::super::measure::{At, Measure};
use super::super::{FitMethod, FragilityReport};
use super::follow::Followed;
use super::levels::{Added, MOST_ADDED};
use super::request::DOUBTFUL_SCALE;
use super::shaking::{Asked, FloorShaking};
use super::{ObjectRuns, RunsRequest, follow};

/// Fragilities from runs.
#[derive(Debug)]
pub struct RunsReport {
    /// What was asked, with the scales that were chosen or added.
    pub request: RunsRequest,
    /// One for each measure, with the outcomes of its table.
    pub reports: Vec<FragilityReport>,
    /// The tables of outcomes, for each measure.
    pub outcomes: Vec<Table>,
    /// What was added to the intensities of stripes for a hazard.
    pub added: Option<Added>,
    /// The objects with their runs.
    pub objects: Vec<ObjectRuns>,
    /// For each floor its motions.
    pub floors: Vec<Vec<FloorShaking>>,
    /// The objects that were not run.
    pub left_out: Vec<LeftOut>,
}

/// An object that was not run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Its id.
    pub id: String,
    /// The reason.
    pub why: NotFollowed,
}

/// What to know of runs, besides their fits and their hazard.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum RunsDoubt {
    /// Objects that were not run.
    LeftOut(Vec<LeftOut>),
    /// Objects that are fitted to their outcomes, although a fit of shocks was asked for.
    NotByShock {
        /// The id of the first.
        id: String,
        /// Why.
        why: NoShockLimits,
        /// How many they are.
        objects: usize,
    },
    /// So many objects have a tolerance that cannot be compared: mass or cushion are missing.
    LacksShock(usize),
    /// Runs use motions that are scaled far.
    ScaledFar {
        /// By more than this.
        scale_ratio: f64,
        /// How many.
        scaled: usize,
        /// Of how many.
        runs: usize,
    },
    /// Objects of whose rates much is still open.
    StillOpen {
        /// Their ids.
        ids: Vec<String>,
        /// The most intensities that are added.
        most_added: usize,
    },
}

impl RunsReport {
    /// What to know of the runs.
    pub fn doubts(&self) -> Vec<RunsDoubt> {
        let mut doubts = Vec::new();
        if !self.left_out.is_empty() {
            doubts.push(RunsDoubt::LeftOut(self.left_out.clone()));
        }
        if self.request.fit == FitMethod::TwoStage {
            let mut not = self
                .objects
                .iter()
                .filter_map(|one| Some((&one.id, one.shock_limits().err()?)));
            let objects = not.clone().count();
            doubts.extend(not.next().map(|(id, why)| RunsDoubt::NotByShock {
                id: id.clone(),
                why,
                objects,
            }));
        }
        let lacking = self.objects.iter().filter(|one| one.nominal.lacks_shock());
        let lacking = lacking.count();
        doubts.extend((lacking > 0).then_some(RunsDoubt::LacksShock(lacking)));
        let scaled = self.objects.iter().map(ObjectRuns::marked).sum();
        doubts.extend((scaled > 0).then_some(RunsDoubt::ScaledFar {
            scale_ratio: DOUBTFUL_SCALE,
            scaled,
            runs: self.runs(),
        }));
        let open = self.added.iter().map(|added| &added.open_ids);
        let open = open.filter(|ids| !ids.is_empty());
        doubts.extend(open.map(|ids| RunsDoubt::StillOpen {
            ids: ids.clone(),
            most_added: MOST_ADDED,
        }));
        doubts
    }

    /// What to know of the hazard for which intensities were added.
    pub fn hazard_doubts(&self) -> impl Iterator<Item = HazardDoubt> {
        let site_deg = self.request.site_deg;
        let site_deg = site_deg.filter(|_| !self.request.site_is_exported);
        let added = self.added.iter();
        added.flat_map(move |added| added.hazard.doubts_at(site_deg))
    }

    /// How many runs there are.
    pub fn runs(&self) -> usize {
        let motions = self.objects.iter().flat_map(|one| &one.motions);
        motions.map(Vec::len).sum()
    }

    /// Runs that stay upright above a scale that overturns the object.
    pub fn survived(&self) -> usize {
        let motions = self.objects.iter().flat_map(|one| &one.motions);
        motions
            .map(|runs| resurrections(&follow::classes(runs)))
            .sum()
    }

    /// The files that were read.
    pub fn inputs(&self) -> impl Iterator<Item = &InputFile> {
        let added = self.added.iter();
        let of_hazard = added.filter_map(|added| added.hazard.file.as_ref());
        self.request.inputs.iter().chain(of_hazard)
    }

    /// The scales or intensities that were asked for, or chosen before a hazard asked for more.
    pub fn scales_given(&self) -> Option<usize> {
        let added = self.added.as_ref().map_or(0, |added| added.count);
        let scales = self.request.scales.as_ref();
        scales.map(|all| all.len() - added)
    }

    /// The runs of each motion of an object, with their intensities by the first measure.
    pub fn intensities<'r>(
        &'r self,
        one: &'r ObjectRuns,
        measure: Measure,
        at: At,
    ) -> impl Iterator<Item = Vec<(f64, &'r Followed)>> {
        let shakings = self.floors.get(one.floor).map_or(&[][..], Vec::as_slice);
        let first = Asked {
            measure,
            place: 0,
            at,
        };
        shakings
            .iter()
            .zip(&one.motions)
            .filter_map(move |(shaking, runs)| {
                let unit = shaking.intensity(first, one.factors)?;
                let each = runs.iter().map(|run| (unit * run.scale_ratio, run));
                Some(each.collect())
            })
    }

    /// The report by the first measure, for other programs.
    pub fn first(&self) -> Option<&FragilityReport> {
        self.reports.first()
    }
}
