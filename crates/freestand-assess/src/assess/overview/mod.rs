//! What the summary of an assessment counts, row by row, in bounded memory; shared by every output that has one.

use std::collections::BTreeMap;

use crate::inventory::{Item, Rating};
use freestand_study::result::Ranked;

use super::result::{Decision, Probability};
use super::table::Line;

/// Floors that are told apart; objects on further ones are counted together.
pub const MOST_FLOORS: usize = 100;

/// Counts by [`Decision::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Rows of the inventory.
    pub objects: [usize; 4],
    /// Pieces: rows times their quantity.
    pub pieces: [u64; 4],
}

impl Counts {
    /// Of one decision.
    pub fn of(&self, decision: Decision) -> usize {
        self.objects[decision as usize]
    }

    /// Of all decisions.
    pub fn total(&self) -> usize {
        self.objects.iter().sum()
    }

    fn add(&mut self, decision: Decision, quantity: u32) {
        self.objects[decision as usize] += 1;
        // An inventory of 1e6 rows of 4e9 pieces still fits.
        let pieces = &mut self.pieces[decision as usize];
        *pieces = pieces.saturating_add(quantity.into());
    }
}

/// One floor of a building.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorCounts {
    /// Its name, or its level where it has none.
    pub name: String,
    /// 0 ground, 1 roof; of the first object that was met there.
    pub level_ratio: Option<f64>,
    /// Median peak acceleration of the floor \[g\]; of the first object that was met there.
    pub pfa_g_median: Option<f64>,
    /// Its objects.
    pub counts: Counts,
}

/// One of the three consequences of FEMA E-74.
#[derive(Debug, Clone, PartialEq)]
pub struct ConsequenceCounts {
    /// `life safety (LS)`.
    pub name: &'static str,
    /// Objects rated high, medium, low, and not rated.
    pub ratings: [Counts; 4],
}

/// The names of [`ConsequenceCounts::ratings`].
pub const RATINGS: [&str; 4] = ["high", "medium", "low", "not rated"];

/// One line of the list of what to do first.
#[derive(Debug, Clone, PartialEq)]
pub struct Urgent {
    /// 1 is the most urgent.
    pub rank: usize,
    /// The object's name.
    pub id: String,
    /// What it is.
    pub item: String,
    /// How many of them stand there.
    pub quantity: u32,
    /// Where it stands.
    pub place: String,
    /// What to do.
    pub decision: Decision,
    /// What governs.
    pub governing: Option<String>,
    /// Demand over capacity of the median motion.
    pub demand_capacity: Option<Ranked>,
    /// P(exceed), or P(overturn) without a tolerance.
    pub probability: Option<Probability>,
    /// Whether that is of overturning alone.
    pub is_overturn_only: bool,
    /// The larger shock of the median motion \[g\].
    pub shock_g: Option<Ranked>,
    /// Why, in one or two sentences.
    pub why: String,
}

/// Everything that the summary counts.
#[derive(Debug, Clone, PartialEq)]
pub struct Overview {
    /// Rows of the inventory.
    pub total: usize,
    /// Rows that were assessed.
    pub assessed: usize,
    /// By decision.
    pub counts: Counts,
    /// By tier that decided, 0 to 3.
    pub tiers: [usize; 4],
    /// Objects without a tolerance, without geometry or level, and those that a source decides that may not.
    pub without_tolerance: usize,
    /// Objects whose motion could not be followed: geometry or level is missing, or no motion could be.
    pub without_response: usize,
    /// Objects under which some motion could not be followed to its end.
    pub with_failed_motions: usize,
    /// Life safety, property loss, functional loss.
    pub consequences: [ConsequenceCounts; 3],
    /// The most urgent, by rank; as many as were asked for.
    pub urgent: BTreeMap<usize, Urgent>,
    floors: BTreeMap<FloorKey, FloorCounts>,
    others: Option<FloorCounts>,
    most_urgent: usize,
}

/// Building, name of the floor, level in a form that sorts.
type FloorKey = (String, String, Option<u64>);

impl Overview {
    /// Nothing counted yet, of an inventory of `total` rows; the list will hold the `most_urgent`.
    pub fn new(total: usize, most_urgent: usize) -> Self {
        let consequence = |name| ConsequenceCounts { name, ratings: [Counts::default(); 4] };
        Self {
            total,
            assessed: 0,
            counts: Counts::default(),
            tiers: [0; 4],
            without_tolerance: 0,
            without_response: 0,
            with_failed_motions: 0,
            consequences: ["life safety (LS)", "property loss (PL)", "functional loss (FL)"].map(consequence),
            urgent: BTreeMap::new(),
            floors: BTreeMap::new(),
            others: None,
            most_urgent,
        }
    }

    /// Counts one row; those that are not assessed yet do not count.
    pub fn add(&mut self, line: &Line) {
        let Some((rank, found)) = line.found else { return };
        let (item, decision) = (line.item, found.decision);
        self.assessed += 1;
        self.counts.add(decision, item.quantity);
        if let Some(tier) = self.tiers.get_mut(usize::from(found.tier)) {
            *tier += 1;
        }
        self.without_tolerance += usize::from(found.capacity.is_none() && item.tolerance.is_none());
        self.without_response += usize::from(found.response.is_none());
        self.with_failed_motions += usize::from(found.response.as_ref().is_some_and(|response| response.failed > 0));
        let rated = [item.consequences.life_safety, item.consequences.property, item.consequences.function];
        for (consequence, rating) in self.consequences.iter_mut().zip(rated) {
            consequence.ratings[rating_index(rating)].add(decision, item.quantity);
        }
        self.add_floor(line, decision);
        if rank <= self.most_urgent {
            self.urgent.insert(rank, urgent(line, rank, found));
        }
    }

    /// The floors, the highest first; those beyond [`MOST_FLOORS`] together at the end.
    pub fn floors(&self) -> Vec<&FloorCounts> {
        let mut floors: Vec<&FloorCounts> = self.floors.values().collect();
        let level = |floor: &FloorCounts| floor.level_ratio.unwrap_or(f64::NEG_INFINITY);
        floors.sort_by(|a, b| level(b).total_cmp(&level(a)));
        floors.extend(&self.others);
        floors
    }

    /// `partial: 40 of 100 objects are assessed`, where the run was interrupted.
    pub fn partial(&self) -> Option<String> {
        (self.assessed < self.total).then(|| {
            format!(
                "PARTIAL: {} of {} objects are assessed; the run was stopped before its end. The list, the ranks and every \
                 count below are of these alone.",
                self.assessed, self.total
            )
        })
    }

    fn add_floor(&mut self, line: &Line, decision: Decision) {
        let item = line.item;
        let level_ratio = item.level_ratio.filter(|level| level.is_finite());
        // A floor that has a name is one floor whatever its rows say of its level.
        let level = if item.floor.is_empty() { level_ratio.map(f64::to_bits) } else { None };
        let key = (item.building.clone(), item.floor.clone(), level);
        let facts = line.assessment().and_then(|found| found.floor.as_ref());
        let floor = if self.floors.len() < MOST_FLOORS || self.floors.contains_key(&key) {
            self.floors.entry(key).or_insert_with(|| FloorCounts {
                name: floor_name(item),
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

fn floor_name(item: &Item) -> String {
    let floor = match (item.floor.as_str(), item.level_ratio) {
        ("", None) => "level not stated".to_owned(),
        ("", Some(level_ratio)) => format!("level {}", freestand_input::words::number(level_ratio, 3)),
        (floor, _) => floor.to_owned(),
    };
    if item.building.is_empty() { floor } else { format!("{}, {floor}", item.building) }
}

fn urgent(line: &Line, rank: usize, found: &super::Assessment) -> Urgent {
    let item = line.item;
    Urgent {
        rank,
        id: item.id.clone(),
        item: item.item.clone(),
        quantity: item.quantity,
        place: place(item),
        decision: found.decision,
        governing: found.capacity.as_ref().map(|capacity| capacity.governing.clone()),
        demand_capacity: found.capacity.as_ref().map(|capacity| capacity.demand_capacity),
        probability: found.p_exceed.or(found.p_overturn),
        is_overturn_only: found.p_exceed.is_none() && found.p_overturn.is_some(),
        shock_g: found.shock.as_ref().map(|shock| shock.edge_acceleration_g[1]),
        why: found.why.clone(),
    }
}

/// Where an object stands, in words: location, building, floor, room, whatever is known of them.
pub fn place(item: &Item) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in [&item.location, &item.building, &item.floor, &item.room] {
        if !part.is_empty() && !parts.contains(&part.as_str()) {
            parts.push(part);
        }
    }
    if parts.is_empty() { item.level_ratio.map_or_else(String::new, |_| floor_name(item)) } else { parts.join(", ") }
}

#[cfg(test)]
mod tests;
