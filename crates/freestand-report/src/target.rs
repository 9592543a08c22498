//! Spectra of codes, and motions that fit them, for programs.

use freestand::code_spectrum::As1170_4;
use freestand::synthesis::GENERATOR;
use freestand_output::answer_of;
use freestand_study::matched::{FitReport, FittedMotion};
use freestand_study::places::Place;
use freestand_study::target::{CodeSpectrumReport, PartsReport, Target, TargetDoubt};

use crate::doubts::target_doubt;

/// What a target is and where its numbers are from, each as a name and a value.
pub(crate) fn facts(target: &Target) -> Vec<(&str, String)> {
    let all = target.facts.iter();
    let unread = TargetDoubt::EditionUnread;
    let is_unread = target.doubts.contains(&unread);
    all.map(|(name, value)| (name.as_str(), value.clone()))
        .chain(is_unread.then(|| ("Not confirmed", target_doubt(&unread))))
        .collect()
}

answer_of!(
    /// A target.
    struct OfTarget<'t>(&'t Target) as of {
    code: &'static str = of.0.spectrum.name();
    /// The class of the site.
    site: Option<&'static str> = of.0.spectrum.site_name();
    /// The place whose hazard was used.
    place: Option<&Place> = of.0.place.as_ref();
    hazard: HazardOf<'_> = HazardOf(Some(of.0)) => flat;
    /// Whether the minimum of kpZ governs, by AS 1170.4.
    minimum_kpz_governs: Option<bool> = of.0.as1170_4().map(As1170_4::minimum_governs);
    /// Its description and the sources of its numbers.
    facts: Vec<NamedFact<'_>> = named_facts(of.0);
});

answer_of!(
    /// The hazard of a target; without one, its values are null.
    pub(crate) struct HazardOf<'t>(pub(crate) Option<&'t Target>) as of {
    /// Z.
    hazard_factor: Option<f64> = of.0.and_then(Target::hazard_factor);
    return_period_years: Option<u64> =
        of.0.and_then(Target::return_period_years).map(u64::from);
    kpz_g: Option<f64> = of.0.and_then(Target::kpz_g);
});

/// A name and a value.
#[derive(Clone)]
pub(crate) struct NamedFact<'t>(&'t str, String);

answer_of!(NamedFact<'_> as fact {
    name: String = fact.0.to_owned();
    value: String = fact.1.clone();
});

/// Its facts, as documents have them.
pub(crate) fn named_facts(target: &Target) -> Vec<NamedFact<'_>> {
    let all = facts(target).into_iter();
    all.map(|(name, value)| NamedFact(name, value)).collect()
}

/// Motions that fit a target.
#[derive(Debug, Clone, Copy)]
pub struct FitAnswer<'r>(pub &'r FitReport);

answer_of!(FitAnswer<'_> as report.0 {
    target: OfTarget<'_> = OfTarget(&report.0.target) => flat;
    /// Of synthetic motions.
    seed: Option<u64>;
    /// Of the random numbers.
    generator: Option<&'static str> = report.0.seed.map(|_| GENERATOR);
    method: &'static str = report.0.method.name();
    motions: Vec<&FittedMotion> = report.0.motions.iter().collect();
});

/// A spectrum at its periods.
#[derive(Debug, Clone, Copy)]
pub struct CodeSpectrumAnswer<'r>(pub &'r CodeSpectrumReport);

answer_of!(CodeSpectrumAnswer<'_> as report.0 {
    target: OfTarget<'_> = OfTarget(&report.0.target) => flat;
    corner_periods_s: Vec<f64>;
    periods_s: Vec<f64>;
    sa_g: Vec<f64>;
    /// Given by Eurocode 8 only.
    vertical_sa_g: Option<Vec<f64>>;
    parts: Option<PartsReport>;
});
