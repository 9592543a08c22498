//! What an answer depends on: the total index of Jansen.

/// Fewest worlds with the event, and without it, from which a share is reported.
const FEWEST: usize = 10;

/// How much of an answer depends on one group of unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// Jansen's total index: the mean of (Y − Y′)² over 2p(1 − p).
    pub total_ratio: f64,
    /// Share of the worlds in which the answer changes when this group alone is drawn again.
    pub changed_ratio: f64,
}

/// Jansen's total index of a group of unknowns, from pairs of answers: Y in a world, and Y′ in the
/// same world with that group drawn again and all else unchanged,
///
/// share = mean\[(Y − Y′)²\]/(2p(1 − p)),
///
/// where p is the share of yes among all answers of the pairs, both Y and Y′: they have one
/// distribution. It is 1 on average where everything depends on the group, and 0 where nothing
/// does; the shares of all groups add up to more than 1 where groups interact. `None` where fewer
/// than 10 of the worlds have the event (or are without it), for then it is mostly chance.
///
/// # Reference
/// Jansen (1999), "Analysis of variance designs for model output", Computer Physics Communications
/// 117; Saltelli et al. (2010), table 2, (f).
///
/// # Example
/// In 40 worlds, of which 20 have the event, drawing the group again changes eight answers, half of
/// them each way: 8/40/(2·¼).
/// ```
/// let answers: Vec<(bool, bool)> = (0..40).map(|i| (i < 20, (i < 20) != (16..24).contains(&i))).collect();
/// let share = freestand::decision::jansen_share(&answers).unwrap();
/// assert!((share.total_ratio - 0.4).abs() < 1e-12 && share.changed_ratio == 0.2);
/// ```
pub fn jansen_share(answers: &[(bool, bool)]) -> Option<Share> {
    let count = |is: &dyn Fn(&(bool, bool)) -> bool| answers.iter().filter(|pair| is(pair)).count();
    let hits = count(&|pair| pair.0);
    if hits < FEWEST || answers.len() - hits < FEWEST {
        return None;
    }
    let worlds = answers.len() as f64;
    let p = (hits + count(&|pair| pair.1)) as f64 / (2.0 * worlds);
    let changed_ratio = count(&|pair| pair.0 != pair.1) as f64 / worlds;
    Some(Share {
        total_ratio: changed_ratio / (2.0 * p * (1.0 - p)),
        changed_ratio,
    })
}
