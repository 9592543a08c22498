//! What is told of a run and of a plan, beside their files.

use freestand_assess::result::Decision;
use freestand_output::answer;
use freestand_output::answer::ByName;
use freestand_study::study::Study;
use freestand_study::target::Target;

use freestand_risk::budget::{BudgetPlan, PlanRow};

use super::plan::{assumptions, sentences};
use super::{First, Head, Since};

answer! {
    /// The summary of a job; its fields are the keys of the JSON document.
    #[derive(Default)]
    pub struct JobReport {
        /// Rows of the inventory.
        objects: usize,
        /// Objects that an earlier run finished.
        resumed: usize,
        /// Objects that this run assessed.
        computed: usize,
        /// Objects whose worlds did not suffice before this run was stopped: they have no verdict yet.
        unsettled: usize,
        /// Worlds of the object with the most.
        worlds: usize,
        /// Whether this run was stopped before its end; a run with `resume` continues it.
        interrupted: bool,
        /// Objects by decision.
        decisions: ByName<usize>,
        /// Objects by the tier that decided.
        tiers: [usize; 4],
        /// Objects with a history that failed.
        failed: usize,
        /// Rocking histories that this run computed.
        histories: u64,
        /// The folder.
        out: String,
        /// The files in it.
        files: Vec<String>,
        /// The files of an earlier run that were removed from it.
        removed: Vec<String>,
        /// The sentence that says whose building this is, where no study was given.
        no_study: Option<String>,
        /// Whether nobody stated the place, or the hazard in another way.
        place_is_assumed: bool,
        /// Whether nobody stated the building.
        building_is_assumed: bool,
        /// What was assumed, one sentence each.
        assumptions: Vec<String>,
        /// For how many objects the list leaves a column empty, so that something is assumed.
        assumed_columns: ByName<usize>,
        /// What the study calls the building.
        building_name: Option<String>,
        /// The place whose hazard was used.
        place_name: Option<String>,
        /// Place and building in words.
        place: String = skip,
        /// Objects that are left as they are, assessed for falling alone.
        only_falling: usize,
        /// What the plan within a budget was asked, and what it leaves; `null`: no budget was given.
        budget: Option<BudgetPlan>,
        /// The options of the plan.
        plan: Option<Vec<PlanRow>>,
        /// Every option for every object, those of the plan first.
        plan_alternatives: Option<Vec<PlanRow>>,
        /// What the plan does, one sentence each; empty: no budget was given.
        plan_sentences: Vec<String>,
        /// What it assumes, one sentence each.
        plan_assumptions: Vec<String>,
        /// What has changed since an earlier assessment; `null`: none was named.
        since: Option<Since>,
        /// The most urgent objects.
        first: Vec<First> = skip,
        /// What is wrong or doubtful in the list, a line for each kind and column.
        problems: Vec<String> = skip,
        /// Other warnings.
        warnings: Vec<String> = skip,
    }
}

impl JobReport {
    /// With the plan within a budget, if one was asked for.
    #[must_use]
    pub fn planned(mut self, plan: Option<BudgetPlan>) -> Self {
        let Some(plan) = plan else { return self };
        self.plan_sentences = sentences(&plan);
        self.plan_assumptions = assumptions(&plan);
        self.plan = Some(plan.planned().cloned().collect());
        self.plan_alternatives = Some(plan.rows.clone());
        self.budget = Some(plan);
        self
    }

    /// Objects with this decision.
    pub fn count(&self, decision: Decision) -> u64 {
        let mut all = self.decisions.0.iter();
        all.find(|(name, _)| *name == decision.name())
            .map_or(0, |(_, objects)| *objects as u64)
    }

    /// What a JSON document says beside the result: whose building it is, the problems of the list,
    /// and the other warnings.
    pub fn all_warnings(&self) -> Vec<String> {
        let problems = self
            .problems
            .iter()
            .map(|line| format!("in the list: {line}"));
        self.no_study
            .iter()
            .cloned()
            .chain(problems)
            .chain(self.warnings.iter().cloned())
            .collect()
    }
}

/// What a report says about the study and the list, whatever became of the objects.
pub fn said(study: &Study, head: &Head) -> JobReport {
    JobReport {
        assumptions: head.assumptions.clone(),
        assumed_columns: ByName(head.assumed_columns.clone()),
        no_study: head.no_study.clone(),
        place_is_assumed: study.place_is_assumed,
        building_is_assumed: study.building_is_assumed,
        building_name: study.building_name.clone(),
        place_name: study.ground.code_spectrum().and_then(Target::place_name),
        place: head.one_line.clone(),
        problems: head.problems.clone(),
        warnings: head.warnings.clone(),
        ..JobReport::default()
    }
}

answer! {
    /// The summary of a plan; its fields are the keys of the JSON document.
    pub struct PlanReport {
        /// The folder.
        out: String,
        /// Number of shards, counted from 0.
        shards: usize,
        /// Rows of the inventory.
        rows: usize,
        /// Rows of the largest shard.
        rows_most: usize,
        /// Whether the folder had this plan already: nothing was written.
        was_planned: bool,
        /// The sentence that says whose building this is, where no study was given.
        no_study: Option<String>,
        /// Place and building in words.
        place: String = skip,
        /// What is wrong or doubtful in the list, a line for each kind and column.
        problems: Vec<String> = skip,
        /// Other warnings.
        warnings: Vec<String> = skip,
    }
}
