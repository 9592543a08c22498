//! The counts in the summary of an assessment, made row by row in bounded memory; shared by all
//! outputs with a summary.

use std::collections::{BTreeMap, BTreeSet};

use freestand_assess::result::{Assessment, Criterion, Decision};
use freestand_inventory::library::Confidence;
use freestand_inventory::{Item, Rating};
use freestand_study::result::Ranked;

use super::floors::{FloorKey, floor_key, floor_words};
use super::reasons::why;
use super::table::Line;
use super::words::{chance, exceeded, falls};
use super::worklist::{Task, sort_floors};
use crate::restraint::force::{source_name, to_confirm};

/// Floors that are counted separately; objects on further floors are counted together.
pub(super) const MAX_FLOORS: usize = 100;

/// Counts by [`Decision::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Counts {
    /// Rows of the inventory.
    pub objects: [usize; Decision::COUNT],
    /// Pieces: rows times their quantity.
    pub pieces: [u64; Decision::COUNT],
}

impl Counts {
    /// Objects with this decision.
    pub(super) fn of(&self, decision: Decision) -> usize {
        self.objects[decision as usize]
    }

    /// Objects with any decision.
    pub(super) fn total(&self) -> usize {
        self.objects.iter().sum()
    }

    fn add(&mut self, decision: Decision, quantity: u32) {
        self.objects[decision as usize] += 1;
        // 1e6 rows of 4e9 pieces still fit.
        let pieces = &mut self.pieces[decision as usize];
        *pieces = pieces.saturating_add(quantity.into());
    }
}

/// One floor of a building.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FloorCounts {
    /// Its name, or its level where it has none.
    pub name: String,
    /// 0 ground, 1 roof; of the first object on the floor.
    pub level_ratio: Option<f64>,
    /// Median PFA \[g\]; of the first object on the floor.
    pub pfa_g_median: Option<f64>,
    /// Its objects.
    pub counts: Counts,
}

/// One of the three consequences of FEMA E-74.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ConsequenceCounts {
    /// `life safety`.
    pub name: &'static str,
    /// Objects rated high, medium, low, and not rated.
    pub ratings: [Counts; 4],
}

/// The names of [`ConsequenceCounts::ratings`].
pub(super) const RATINGS: [&str; 4] = ["high", "medium", "low", "not rated"];

/// One row of the list of the most urgent objects.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Urgent {
    /// 1 is the most urgent.
    pub rank: usize,
    /// Identifier of the object.
    pub id: String,
    /// What it is.
    pub item: String,
    /// How many such objects there are.
    pub quantity: u32,
    /// Its floor.
    pub floor: String,
    /// Where it is.
    pub place: String,
    /// What to do.
    pub decision: Decision,
    /// The governing criterion.
    pub governing: Option<Criterion>,
    /// Demand/capacity of the median world, by the model that decides.
    pub demand_capacity: Option<Ranked>,
    /// P(it falls), in words.
    pub falls: String,
    /// P(its tolerance is exceeded), in words.
    pub exceeded: String,
    /// The probability that decides, in words.
    pub chance: String,
    /// Shock of the median world, by the model that decides \[g\].
    pub shock_g: Option<Ranked>,
    /// Force of a restraint \[N\].
    pub force_n: Option<f64>,
    /// Why, in one or two sentences.
    pub why: String,
}

/// The counts of the summary.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Overview {
    /// Rows of the inventory.
    pub total: usize,
    /// Rows that were assessed.
    pub assessed: usize,
    /// By decision.
    pub counts: Counts,
    /// By tier that decided, 0 to 3.
    pub tiers: [usize; 4],
    /// Objects without a tolerance.
    pub without_tolerance: usize,
    /// Objects that are left as they are, assessed for falling alone.
    pub only_falling: usize,
    /// Free objects without a response: geometry or level is missing, or every history failed.
    pub without_response: usize,
    /// Objects with a history that failed, but not all of them.
    pub with_failed_motions: usize,
    /// Life safety, property loss, functional loss.
    pub consequences: [ConsequenceCounts; 3],
    /// The most urgent, by rank; as many as the list holds.
    pub urgent: BTreeMap<usize, Urgent>,
    /// What has to be done, by rank, for the most urgent objects.
    pub tasks: BTreeMap<usize, Task>,
    /// Objects for which something has to be done.
    pub to_do: usize,
    /// Values quoted from memory on which what has to be done rests, or which are shown; at most [`MAX_RECALLED`].
    pub recalled: BTreeSet<String>,
    /// Whether there are others.
    pub has_more_recalled: bool,
    floors: BTreeMap<FloorKey, FloorCounts>,
    others: Option<FloorCounts>,
    most_urgent: usize,
}

/// Values quoted from memory that are kept by name: a list of a million objects may have as many sources of its own.
const MAX_RECALLED: usize = 200;

/// Tasks in the work list of the report; worklist.csv has all.
const MAX_TASKS: usize = 1_000;

impl Overview {
    /// The counts before the first of `total` rows; the list takes the `most_urgent` objects.
    pub(super) fn new(total: usize, most_urgent: usize) -> Self {
        let consequence = |name| ConsequenceCounts {
            name,
            ratings: [Counts::default(); 4],
        };
        Self {
            total,
            assessed: 0,
            counts: Counts::default(),
            tiers: [0; 4],
            without_tolerance: 0,
            only_falling: 0,
            without_response: 0,
            with_failed_motions: 0,
            consequences: ["life safety", "property", "function"].map(consequence),
            urgent: BTreeMap::new(),
            tasks: BTreeMap::new(),
            to_do: 0,
            recalled: BTreeSet::new(),
            has_more_recalled: false,
            floors: BTreeMap::new(),
            others: None,
            most_urgent,
        }
    }

    /// Counts one row; rows without an assessment do not count.
    pub(super) fn add(&mut self, line: &Line) {
        let Some((rank, found)) = line.found else {
            return;
        };
        let (item, decision) = (line.item, found.decision);
        self.assessed += 1;
        self.counts.add(decision, item.quantity);
        if let Some(tier) = self.tiers.get_mut(usize::from(found.tier)) {
            *tier += 1;
        }
        self.without_tolerance += usize::from(found.capacity.is_none() && item.tolerance.is_none());
        self.only_falling += usize::from(found.is_left_for_falling_alone());
        let is_free = item.anchored != Some(true);
        self.without_response += usize::from(is_free && found.response.is_none());
        self.with_failed_motions +=
            usize::from(found.response.is_some() && found.has_failed_histories());
        let rated = [
            item.consequences.life_safety,
            item.consequences.property,
            item.consequences.function,
        ];
        for (consequence, rating) in self.consequences.iter_mut().zip(rated) {
            consequence.ratings[rating_index(rating)].add(decision, item.quantity);
        }
        self.add_floor(line, decision);
        self.add_recalled(line.item, found);
        if rank <= self.most_urgent {
            self.urgent.insert(rank, urgent(line, rank, found));
        }
    }

    /// The tolerance of an object and the force of its restraint, where they are quoted from memory.
    fn add_recalled(&mut self, item: &Item, found: &Assessment) {
        let tolerance = item.tolerance.as_ref();
        let tolerance = tolerance.filter(|one| one.confidence == Confidence::Recalled);
        let tolerance = tolerance.map(|one| format!("tolerance: {}", one.source));
        let force = found.design_force();
        let of_force = force.into_iter().flat_map(|force| {
            let unread = to_confirm(&force.source).into_iter();
            unread.map(|one| format!("{}: {}", source_name(&force.source), one.what))
        });
        for one in tolerance.into_iter().chain(of_force) {
            if self.recalled.len() < MAX_RECALLED {
                self.recalled.insert(one);
            } else if !self.recalled.contains(&one) {
                self.has_more_recalled = true;
            }
        }
    }

    /// Counts a task.
    pub(super) fn add_task(&mut self, task: Task) {
        self.to_do += 1;
        self.tasks.insert(task.rank, task);
        if self.tasks.len() > MAX_TASKS {
            self.tasks.pop_last();
        }
    }

    /// Whether objects of more than one building were counted.
    pub(super) fn has_buildings(&self) -> bool {
        let mut names = self.floors.keys().map(|key| &key.building);
        let first = names.next();
        names.any(|name| Some(name) != first)
    }

    /// The floors from the top down; those beyond [`MAX_FLOORS`] together at the end.
    pub(super) fn floors(&self) -> Vec<&FloorCounts> {
        let mut floors: Vec<(&FloorKey, &FloorCounts)> = self.floors.iter().collect();
        sort_floors(&mut floors, |(key, floor)| (floor.level_ratio, *key));
        floors
            .into_iter()
            .map(|(_, floor)| floor)
            .chain(&self.others)
            .collect()
    }

    /// A sentence for the outputs of an interrupted run; `None` for a complete one.
    pub(super) fn partial(&self) -> Option<String> {
        (self.assessed < self.total).then(|| {
            format!(
                "PARTIAL: {} of {} objects were assessed before the run was stopped. The list, the ranks and all \
                 counts below are for these objects only.",
                self.assessed, self.total
            )
        })
    }

    fn add_floor(&mut self, line: &Line, decision: Decision) {
        let item = line.item;
        let level_ratio = item.level_ratio.filter(|level| level.is_finite());
        let key = floor_key(item);
        let facts = line.assessment().and_then(|found| found.floor.as_ref());
        let floor = if self.floors.len() < MAX_FLOORS || self.floors.contains_key(&key) {
            self.floors.entry(key).or_insert_with(|| FloorCounts {
                name: floor_words(&floor_key(item), true),
                level_ratio,
                pfa_g_median: facts.map(|facts| facts.pfa_g_median),
                counts: Counts::default(),
            })
        } else {
            self.others.get_or_insert_with(|| FloorCounts {
                name: "other floors".to_owned(),
                level_ratio: None,
                pfa_g_median: None,
                counts: Counts::default(),
            })
        };
        floor.counts.add(decision, item.quantity);
    }
}

fn rating_index(rating: Option<Rating>) -> usize {
    match rating {
        Some(Rating::High) => 0,
        Some(Rating::Medium) => 1,
        Some(Rating::Low) => 2,
        None => 3,
    }
}

fn urgent(line: &Line, rank: usize, found: &Assessment) -> Urgent {
    let item = line.item;
    Urgent {
        rank,
        id: item.id.clone(),
        item: item.item.clone(),
        quantity: item.quantity,
        floor: floor_words(&floor_key(item), false),
        place: place(item),
        decision: found.decision,
        governing: found.capacity.as_ref().map(|capacity| capacity.governing),
        demand_capacity: found.demand_capacity_median(),
        falls: falls(found),
        exceeded: exceeded(found),
        chance: to_check(chance(found), item),
        shock_g: found.edge_acceleration_g_median(),
        force_n: found.design_force().map(|force| force.force_n),
        why: why(item, found),
    }
}

/// A probability, and whether the row that it rests on is in doubt.
fn to_check(chance: String, item: &Item) -> String {
    match (item.doubts.is_empty(), chance.is_empty()) {
        (true, _) => chance,
        (false, true) => "check the input".to_owned(),
        (false, false) => format!("{chance}; check the input"),
    }
}

/// Where an object is, in words: location, building, floor and room, as far as they are known.
pub(super) fn place(item: &Item) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in [&item.location, &item.building, &item.floor, &item.room] {
        if !part.is_empty() && !parts.contains(&part.as_str()) {
            parts.push(part);
        }
    }
    if parts.is_empty() {
        item.level_ratio
            .map_or_else(String::new, |_| floor_words(&floor_key(item), true))
    } else {
        parts.join(", ")
    }
}

#[cfg(test)]
mod tests;
