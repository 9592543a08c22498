//! When a count of worlds answers a question: intervals, looks, sides, clusters, shares and yearly
//! rates.
//!
//! A *world* is one complete draw of everything that is uncertain, so a question has one yes or no
//! in it. Independent worlds make a count binomial, and its [`clopper_pearson`] interval exact.
//! Worlds are added from one look to the next until the interval is on one [`Side`] of the accepted
//! probability, or the cap is reached. Nothing here decides what to do with an object.
//!
//! # Reference
//! Clopper and Pearson (1934) for the interval; Jansen (1999) for the shares; McGuire (2004),
//! section 10, for the sum over levels of intensity.
//!
//! # Accuracy
//! Calculated exactly, by recursion over the looks, for one question whose probability P is
//! log-uniform from 0.002 to 1 (10,000 values), with 98 % at each look and looks from 20 worlds to
//! the cap. *Coverage* is the chance that the interval at the last look holds P: the least over all
//! P, and the mean. *Settled* is the chance that a question whose P is the accepted probability is
//! called below it, above it, or either, which is wrong in any case; *flips* the share of questions for which 24 seeds show both sides (close
//! calls do not count).
//!
//! | accepted | cap | least coverage | mean | settled | flips | mean worlds at 0.1, 0.5, 1, 4 times the accepted |
//! |---|---|---|---|---|---|---|
//! | 10 % | 320 | 96.0 % | 99.1 % | 1.4, 2.3, 3.7 % | 0.70 % | 95, 240, 314, 26 |
//! | 5 % | 640 | 95.4 % | 99.0 % | 1.6, 2.6, 4.2 % | 1.00 % | 191, 479, 627, 46 |
//! | 2 % | 1280 | 94.8 % | 98.8 % | 1.3, 3.2, 4.5 % | 1.81 % | 478, 1110, 1247, 100 |
//!
//! Objects with two questions that go together, both read at the object's last look, show *below* in
//! all and *above* in one among 24 seeds less often: 0.2, 0.6 and 0.7 % of 4000 simulated objects.
//!
//! The least is at a P just above the accepted one. Of the P, 1 % have less than 95.6 % where 2 % is
//! accepted, and 0.1 % where 5 % is.

mod annual;
mod clusters;
mod shares;

pub use annual::{AnnualRate, Level, annual_rate, hazard_per_year, level_below, strip_rates};
pub use clusters::{Clusters, LEAST_CORRELATION_RATIO};
pub use shares::{Share, jansen_share};

pub use crate::fragility::clopper_pearson;
use crate::fragility::{lower_end, upper_end};

use thiserror::Error;

/// Least number of expected events at the accepted probability when the cap is reached: the cap is
/// the first look with 25/a worlds or more.
const EVENTS_AT_CAP: f64 = 25.0;

/// Why worlds cannot be counted or judged.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DecisionError {
    /// A number is out of its range.
    #[error("{name} must be {requirement}, not {value}")]
    Range {
        /// What the number is.
        name: &'static str,
        /// The requirement that it does not meet.
        requirement: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// More worlds at the first look than in all.
    #[error("the first look takes {first} worlds, more than the {most} worlds in all")]
    FirstAboveMost {
        /// Worlds at the first look.
        first: u32,
        /// Worlds in all.
        most: u32,
    },
    /// Records that were not all used equally often.
    #[error(
        "each of {records} records must be used {worlds_per_record} times, but its worlds hold {hits} events"
    )]
    Clusters {
        /// Number of records.
        records: usize,
        /// Worlds of each.
        worlds_per_record: u32,
        /// The count that does not fit.
        hits: u32,
    },
}

fn within(
    fine: bool,
    name: &'static str,
    requirement: &'static str,
    value: f64,
) -> Result<(), DecisionError> {
    fine.then_some(()).ok_or(DecisionError::Range {
        name,
        requirement,
        value,
    })
}

fn check_accepted(accepted: f64) -> Result<(), DecisionError> {
    within(
        accepted > 0.0 && accepted < 1.0,
        "the accepted probability",
        "above 0 and below 1",
        accepted,
    )
}

/// The ends of a confidence interval of a probability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

impl Interval {
    /// The side of the accepted probability on which the whole interval lies.
    pub fn side(self, accepted: f64) -> Side {
        if self.low > accepted {
            Side::Above
        } else if self.high < accepted {
            Side::Below
        } else {
            Side::Open
        }
    }
}

/// Where a probability lies relative to the accepted one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// Below it: the upper end is.
    Below,
    /// Above it: the lower end is.
    Above,
    /// The interval holds it: more worlds are needed, or it is a close call.
    Open,
}

impl Side {
    /// The side of a question that several models answer: above where any model is, below where all
    /// are, otherwise open. Without models it is open.
    ///
    /// # Example
    /// ```
    /// use freestand::decision::Side;
    /// assert_eq!(Side::of_models(&[Side::Below, Side::Open]), Side::Open);
    /// assert_eq!(Side::of_models(&[Side::Open, Side::Above]), Side::Above);
    /// ```
    pub fn of_models(models: &[Self]) -> Self {
        if models.contains(&Self::Above) {
            Self::Above
        } else if !models.is_empty() && models.iter().all(|side| *side == Self::Below) {
            Self::Below
        } else {
            Self::Open
        }
    }

    /// Whether no more worlds are needed.
    pub fn is_settled(self) -> bool {
        self != Self::Open
    }
}

/// What the worlds say to one question.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Count {
    /// Number of worlds.
    pub worlds: u32,
    /// Worlds in which the answer is yes.
    pub hits: u32,
    /// Worlds in which it could not be found.
    pub unknown: u32,
}

impl Count {
    /// hits/worlds; 0 without worlds.
    pub fn share_ratio(self) -> f64 {
        if self.worlds == 0 {
            0.0
        } else {
            f64::from(self.hits) / f64::from(self.worlds)
        }
    }

    /// The interval of Clopper and Pearson for independent worlds. A world without an answer counts
    /// as no at the lower end and as yes at the upper.
    ///
    /// # Example
    /// No event in 320 worlds: the upper end is 1 − 0.01^(1/320) = 1.4 %.
    /// ```
    /// use freestand::decision::Count;
    /// let interval = Count { worlds: 320, hits: 0, unknown: 0 }.interval(0.98);
    /// assert!(interval.low == 0.0 && (interval.high - (1.0 - 0.01_f64.powf(1.0 / 320.0))).abs() < 1e-12);
    /// ```
    pub fn interval(self, confidence: f64) -> Interval {
        let (worlds, hits, unknown) = (
            f64::from(self.worlds),
            f64::from(self.hits),
            f64::from(self.unknown),
        );
        Interval {
            low: lower_end(hits, worlds, confidence),
            high: upper_end(hits + unknown, worlds, confidence),
        }
    }
}

/// When worlds are looked at, and how sure an answer must be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Looks {
    first: u32,
    most: u32,
    confidence: f64,
}

impl Default for Looks {
    /// 20 worlds at the first look, 1280 in all, 98 % at every look.
    fn default() -> Self {
        Self {
            first: 20,
            most: 1280,
            confidence: 0.98,
        }
    }
}

impl Looks {
    /// Looks from `first` worlds to `most`, with intervals of this confidence at each.
    ///
    /// # Errors
    /// No worlds at the first look, `first` above `most`, or a confidence that is not above ½ and
    /// below 1.
    pub fn new(first: u32, most: u32, confidence: f64) -> Result<Self, DecisionError> {
        within(
            first >= 1,
            "the number of worlds at the first look",
            "1 or more",
            f64::from(first),
        )?;
        within(
            confidence > 0.5 && confidence < 1.0,
            "the confidence",
            "above 0.5 and below 1",
            confidence,
        )?;
        if first > most {
            return Err(DecisionError::FirstAboveMost { first, most });
        }
        Ok(Self {
            first,
            most,
            confidence,
        })
    }

    /// Worlds at the first look.
    pub fn first(self) -> u32 {
        self.first
    }

    /// Worlds in all.
    pub fn most(self) -> u32 {
        self.most
    }

    /// Confidence of the interval at each look.
    pub fn confidence(self) -> f64 {
        self.confidence
    }

    /// Numbers of independent worlds at which a question with this accepted probability a is looked
    /// at: `first`·2ʲ up to the first that is 25/a or more, the last at most `most`. The last is
    /// the cap.
    ///
    /// # Errors
    /// An accepted probability that is not above 0 and below 1.
    ///
    /// # Example
    /// ```
    /// use freestand::decision::Looks;
    /// assert_eq!(Looks::default().worlds(0.10)?, [20, 40, 80, 160, 320]);
    /// assert_eq!(Looks::default().worlds(0.02)?.last(), Some(&1280));
    /// # Ok::<(), freestand::decision::DecisionError>(())
    /// ```
    pub fn worlds(self, accepted: f64) -> Result<Vec<u32>, DecisionError> {
        check_accepted(accepted)?;
        let enough = EVENTS_AT_CAP / accepted;
        let mut looks = Vec::new();
        let mut worlds = self.first;
        loop {
            looks.push(worlds);
            if f64::from(worlds) >= enough || worlds == self.most {
                return Ok(looks);
            }
            worlds = worlds.saturating_mul(2).min(self.most);
        }
    }

    /// The smallest number of independent worlds with which a question without a single event is settled
    /// below the accepted probability a: the first n with n ≥ ln((1 − confidence)/2)/ln(1 − a).
    ///
    /// # Errors
    /// An accepted probability that is not above 0 and below 1.
    ///
    /// # Example
    /// ```
    /// use freestand::decision::Looks;
    /// let fewest = |accepted| Looks::default().fewest_worlds(accepted);
    /// assert_eq!([fewest(0.2)?, fewest(0.1)?, fewest(0.05)?, fewest(0.02)?], [21, 44, 90, 228]);
    /// # Ok::<(), freestand::decision::DecisionError>(())
    /// ```
    pub fn fewest_worlds(self, accepted: f64) -> Result<u32, DecisionError> {
        check_accepted(accepted)?;
        let least = ((1.0 - self.confidence) / 2.0).ln() / (1.0 - accepted).ln();
        let worlds = least.ceil().clamp(1.0, f64::from(u32::MAX)) as u32;
        let none = Count {
            worlds,
            hits: 0,
            unknown: 0,
        }
        .interval(self.confidence);
        // The upper end is to be below it, not at it.
        Ok(if none.side(accepted) == Side::Below {
            worlds
        } else {
            worlds.saturating_add(1)
        })
    }

    /// As [`Looks::worlds`] for worlds that use `records` motions in turn: whole passes, 1, 2, 4 … of them and as many
    /// as `most` worlds hold, with `first` worlds or more where one pass has no more than that.
    ///
    /// # Errors
    /// Those of [`Looks::worlds`], or no records.
    ///
    /// # Example
    /// ```
    /// use freestand::decision::Looks;
    /// assert_eq!(Looks::default().worlds_in_passes(0.10, 11)?, [22, 44, 88, 176, 352]);
    /// # Ok::<(), freestand::decision::DecisionError>(())
    /// ```
    pub fn worlds_in_passes(self, accepted: f64, records: u32) -> Result<Vec<u32>, DecisionError> {
        check_accepted(accepted)?;
        within(
            records >= 1,
            "the number of records",
            "1 or more",
            f64::from(records),
        )?;
        let enough = (EVENTS_AT_CAP / accepted).max(f64::from(self.first));
        let mut looks = Vec::new();
        let whole = self.most - self.most % records;
        let mut worlds = records;
        loop {
            let next = Some(worlds.saturating_mul(2).min(whole)).filter(|next| *next > worlds);
            let is_last = f64::from(worlds) >= enough || next.is_none();
            if worlds >= self.first || is_last {
                looks.push(worlds);
            }
            match next {
                Some(next) if !is_last => worlds = next,
                _ => return Ok(looks),
            }
        }
    }

    /// The smallest number of records with which a question without a single event is settled below
    /// the accepted probability at its last look, with this least correlation between worlds of one
    /// record; `None` where even `most` worlds do not settle it.
    ///
    /// # Errors
    /// An accepted probability that is not above 0 and below 1, or a correlation outside 0 to 1.
    ///
    /// # Example
    /// Where only the record differs, 10 % take 44 records: 1 − 0.01^(1/44) = 9.9 %.
    /// ```
    /// use freestand::decision::{LEAST_CORRELATION_RATIO, Looks};
    /// assert_eq!(Looks::default().fewest_records(0.10, 1.0)?, Some(44));
    /// assert_eq!(Looks::default().fewest_records(0.10, LEAST_CORRELATION_RATIO)?, Some(20));
    /// # Ok::<(), freestand::decision::DecisionError>(())
    /// ```
    pub fn fewest_records(
        self,
        accepted: f64,
        least_correlation_ratio: f64,
    ) -> Result<Option<u32>, DecisionError> {
        for records in 1..=self.most {
            let worlds = self
                .worlds_in_passes(accepted, records)?
                .last()
                .copied()
                .unwrap_or(records);
            let none = Clusters::with(
                &vec![0; records as usize],
                0,
                worlds / records,
                least_correlation_ratio,
            )?;
            if none.interval(self.confidence).side(accepted) == Side::Below {
                return Ok(Some(records));
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests;
