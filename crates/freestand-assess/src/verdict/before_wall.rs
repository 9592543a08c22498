//! What a wall would change: objects that fall, and for which the list gives no wall, live through the
//! same worlds before one.

use crate::result::{Assessment, BeforeWall, Decision, FallsAnswer};
use freestand_input::problem::Problems;
use freestand_inventory::ItemShape;
use freestand_study::study::assessment::WallUse;

use super::Context;
use super::draw::Change;
use super::object::{Model, Way};
use super::response::Lived;
use super::trial::{Life, Question, Trial, live_again};

/// Touching, and about the depth of a skirting board with what hangs down behind an object \[m\].
const GAPS_M: [f64; 2] = [0.0, 0.05];

/// Of each trial; `None`: it does not fall too often, its wall is known, or walls do not count.
pub(super) fn before_walls(
    context: &Context,
    trials: &[Trial],
    assessed: &[Assessment],
) -> Result<Vec<Option<BeforeWall>>, Problems> {
    let mut found: Vec<Option<BeforeWall>> = trials.iter().map(|_| None).collect();
    let wanting = trials
        .iter()
        .zip(assessed)
        .enumerate()
        .filter(|(_, (trial, found))| is_wanted(context, trial, found));
    let places: Vec<usize> = wanting.map(|(place, _)| place).collect();
    let mut tried: Vec<Trial> = places
        .iter()
        .flat_map(|&place| before(context, &trials[place]))
        .collect();
    let worlds = places
        .iter()
        .flat_map(|&place| [trials[place].worlds(); GAPS_M.len()]);
    let lives = tried.iter().zip(worlds).map(|(trial, worlds)| Life {
        trial,
        worlds,
        change: Change::None,
    });
    let lives: Vec<Life> = lives.collect();
    let mut lived: Vec<Vec<Lived>> = lives.iter().map(|_| Vec::new()).collect();
    live_again(context, &lives, |place, more| lived[place].extend(more))?;
    drop(lives);
    let mut falls = tried.iter_mut().zip(lived).map(|(tried, lived)| {
        tried.lived = lived;
        tried.probability(context, Question::Falls, Model::Rigid)
    });
    for place in places {
        found[place] = falls
            .next()
            .zip(falls.next())
            .map(|(touching, at_50_mm)| BeforeWall { touching, at_50_mm });
    }
    Ok(found)
}

fn is_wanted(context: &Context, trial: &Trial, found: &Assessment) -> bool {
    let falls = found
        .answers
        .as_ref()
        .is_some_and(|answers| answers.falls != FallsAnswer::Stays);
    let has_wall = trial.member.item.surroundings.wall_gap_m.is_some();
    found.decision == Decision::Restrain
        && falls
        && !has_wall
        // A wall does not make a round object a square one.
        && trial.member.item.shape == ItemShape::Block
        // Beside a wall it is followed on a rigid base.
        && !matches!(trial.subject.way, Way::Hull(..))
        && trial.subject.way.rocks()
        && trial.subject.way.asks(Model::Rigid)
        && context.study.assessment.walls == WallUse::AsListed
}

fn before<'a>(context: &'a Context, trial: &Trial<'a>) -> [Trial<'a>; 2] {
    let around = &trial.member.item.surroundings;
    GAPS_M.map(|gap_m| {
        Trial::new(
            context,
            trial.member,
            trial.subject.before_wall(around, gap_m),
        )
    })
}
