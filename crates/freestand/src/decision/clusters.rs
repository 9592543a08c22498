//! Worlds that share records: their effective number.

use super::{DecisionError, Interval};
use crate::fragility::clopper_pearson;

/// The smallest correlation between the answers under one record: that of objects under recorded
/// motions is 0.3 to 0.55, and a sample of few records may show none by chance.
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
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clusters {
    share: f64,
    unknown: f64,
    effective: f64,
    correlation: f64,
}

impl Clusters {
    /// From the number of events under each record, out of `worlds_per_record` worlds each.
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
        Self::with_unknown(hits, 0, worlds_per_record)
    }

    /// The same, where `unknown` of all worlds have no answer: they count as no at the lower end of
    /// the interval and as yes at the upper.
    ///
    /// # Errors
    /// Those of [`Clusters::new`].
    pub fn with_unknown(hits: &[u32], unknown: u32, worlds_per_record: u32) -> Result<Self, DecisionError> {
        let most = hits.iter().copied().max().unwrap_or(1);
        if hits.is_empty() || worlds_per_record == 0 || most > worlds_per_record {
            return Err(DecisionError::Clusters { records: hits.len(), worlds_per_record, hits: most });
        }
        let (records, per_record) = (hits.len() as f64, f64::from(worlds_per_record));
        let shares = hits.iter().map(|&hits| f64::from(hits) / per_record);
        let share = hits.iter().map(|&hits| f64::from(hits)).sum::<f64>() / (records * per_record);
        let scatter: f64 = shares.map(|own| (own - share).powi(2)).sum();
        let worlds = records * per_record;
        let is_mixed = share > 0.0 && share < 1.0;
        let correlation = if is_mixed && worlds_per_record > 1 {
            // s²(n−1) is the scatter.
            let estimate = (scatter * per_record / (records * share * (1.0 - share)) - 1.0) / (per_record - 1.0);
            estimate.clamp(LEAST_CORRELATION_RATIO, 1.0)
        } else {
            LEAST_CORRELATION_RATIO
        };
        let effective = (worlds / (1.0 + (per_record - 1.0) * correlation)).max(records);
        let unknown = (f64::from(unknown) / worlds).min(1.0 - share);
        Ok(Self { share, unknown, effective, correlation })
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
        let end = |share: f64| clopper_pearson(share * self.effective, self.effective, confidence);
        Interval { low: end(self.share).0, high: end(self.share + self.unknown).1 }
    }
}
