//! Worlds that share records: their effective number.

use super::{DecisionError, Interval, within};
use crate::fragility::{lower_end, upper_end};

/// The smallest correlation between the answers under one record: that of objects under recorded
/// motions is 0.3 to 0.55, and a sample of few records may show none by chance. See the accuracy of
/// [`Clusters`] for what it is worth where the true one is higher.
pub const LEAST_CORRELATION_RATIO: f64 = 0.4;

/// Answers to one question in worlds that use n records, each in the same number M of worlds.
///
/// The effective number of worlds is max(n, N/(1 + (M − 1)ρ)) with N = nM and
///
/// ρ = max(0.4, (s² M(n−1)/(n p(1−p)) − 1)/(M − 1)), at most 1,
///
/// where p is the share of all worlds and s² the sample variance of the shares of the records; ρ =
/// 0.4 where p is 0 or 1, and N counts in full where M = 1.
///
/// # Reference
/// Kish (1965), the design effect 1 + (M − 1)ρ; the estimate of ρ is that of an analysis of
/// variance (Donner and Klar 2000).
///
/// # Accuracy
/// Share of questions that are settled below the accepted probability although theirs is equal to
/// it, in %, after all looks with 98 %: 4000 simulated questions each, the chances under single
/// records beta-distributed with the given true correlation. Above it, it is 1.4 % at most.
///
/// | least ρ | accepted, records | 0.05 | 0.3 | 0.55 | 0.75 | 0.9 | 0.999 |
/// |---|---|---|---|---|---|---|---|
/// | 0.4 | 10 %, 10 | 0.0 | 0.0 | 0.0 | 0.0 | 0.0 | 0.0 |
/// | 0.4 | 10 %, 20 | 0.0 | 0.0 | 0.2 | 1.9 | 5.8 | 12.7 |
/// | 0.4 | 10 %, 44 | 1.2 | 1.4 | 1.4 | 2.3 | 1.4 | 0.6 |
/// | 0.4 | 5 %, 40 | 0.0 | 0.0 | 0.1 | 1.9 | 6.0 | 12.3 |
/// | 0.75 | 10 %, 20 | 0.0 | 0.0 | 0.0 | 0.0 | 0.0 | 0.0 |
/// | 0.75 | 10 %, 44 | 1.1 | 1.0 | 0.7 | 1.3 | 1.0 | 0.6 |
///
/// With 0.4 the interval is too narrow where an answer depends on the record almost alone, and
/// twenty to forty records happen to agree: use 0.75 there, and 1 where worlds of one record do not
/// differ at all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clusters {
    share: f64,
    unknown: f64,
    effective: f64,
    correlation: f64,
}

impl Clusters {
    /// From the number of events under each record, out of `worlds_per_record` worlds each, with ρ
    /// at least [`LEAST_CORRELATION_RATIO`].
    ///
    /// # Errors
    /// No records, no worlds, or more events than worlds.
    ///
    /// # Example
    /// Two of four records whose worlds agree: no more is known than from four worlds.
    /// ```
    /// use freestand::decision::Clusters;
    /// assert_eq!(Clusters::new(&[8, 0, 8, 0], 8)?.effective_worlds(), 4.0);
    /// assert_eq!(Clusters::new(&[1, 0, 1, 0], 1)?.effective_worlds(), 4.0);
    /// # Ok::<(), freestand::decision::DecisionError>(())
    /// ```
    pub fn new(hits: &[u32], worlds_per_record: u32) -> Result<Self, DecisionError> {
        Self::with(hits, 0, worlds_per_record, LEAST_CORRELATION_RATIO)
    }

    /// The same, where `unknown` of all worlds have no answer (they count as no at the lower end of
    /// the interval and as yes at the upper), and with another least ρ: 1 where the worlds of a
    /// record do not differ.
    ///
    /// # Errors
    /// Those of [`Clusters::new`], or a least ρ outside 0 to 1.
    pub fn with(
        hits: &[u32],
        unknown: u32,
        worlds_per_record: u32,
        least_correlation_ratio: f64,
    ) -> Result<Self, DecisionError> {
        let least = least_correlation_ratio;
        within(
            (0.0..=1.0).contains(&least),
            "the least correlation between worlds of a record",
            "0 to 1",
            least,
        )?;
        let most = hits.iter().copied().max().unwrap_or(1);
        if hits.is_empty() || worlds_per_record == 0 || most > worlds_per_record {
            return Err(DecisionError::Clusters {
                records: hits.len(),
                worlds_per_record,
                hits: most,
            });
        }
        let (records, per_record) = (hits.len() as f64, f64::from(worlds_per_record));
        let shares = hits.iter().map(|&hits| f64::from(hits) / per_record);
        let share = hits.iter().map(|&hits| f64::from(hits)).sum::<f64>() / (records * per_record);
        let scatter: f64 = shares.map(|own| (own - share).powi(2)).sum();
        let worlds = records * per_record;
        let is_mixed = share > 0.0 && share < 1.0;
        let correlation = if is_mixed && worlds_per_record > 1 {
            // s²(n−1) is the scatter.
            let estimate = (scatter * per_record / (records * share * (1.0 - share)) - 1.0)
                / (per_record - 1.0);
            estimate.clamp(least, 1.0)
        } else {
            least
        };
        let effective = (worlds / (1.0 + (per_record - 1.0) * correlation)).max(records);
        let unknown = (f64::from(unknown) / worlds).min(1.0 - share);
        Ok(Self {
            share,
            unknown,
            effective,
            correlation,
        })
    }

    /// Share of all worlds with the event.
    pub fn share_ratio(self) -> f64 {
        self.share
    }

    /// Number of independent worlds that say as much.
    pub fn effective_worlds(self) -> f64 {
        self.effective
    }

    /// ρ.
    pub fn correlation_ratio(self) -> f64 {
        self.correlation
    }

    /// The interval of Clopper and Pearson with the effective number of worlds.
    pub fn interval(self, confidence: f64) -> Interval {
        let (share, effective) = (self.share, self.effective);
        Interval {
            low: lower_end(share * effective, effective, confidence),
            high: upper_end((share + self.unknown) * effective, effective, confidence),
        }
    }
}
