//! How often the earthquakes of a place are stronger or weaker than that of the study.

use freestand::code_spectrum::{CodeSpectrum, probability_factors, return_period_factors};
use freestand::risk::{Hazard, HazardPoint};
use freestand_study::places::{NTC_YEARS, PlaceHazard, TBDY_YEARS, TsLevel, ntc_hazard};
use freestand_study::study::Study;

/// The class of TS 1170.5 whose accelerations stand for all, and the values of the plateau: their ratios hardly
/// depend on the class.
const TS_CLASS: usize = 2;

/// Weaker earthquakes than this, over that of the study, are asked of no object.
const LEAST_RATIO: f64 = 0.4;

/// The yearly rate of earthquakes by their intensity over that of the study, between the return periods for
/// which its code or its place has accelerations, and whether it goes on below them: objects that fall in weaker
/// earthquakes fall more often than in those of the shortest return period. `None`: there is one return period alone,
/// or none.
pub(super) fn rates_of(study: &Study) -> Option<(Hazard, bool)> {
    let target = study.ground.code_spectrum()?;
    let own_years = f64::from(target.return_period_years()?);
    let place = target.place.as_ref().map(|place| place.hazard);
    let levels: Vec<(u32, f64)> = match (&target.spectrum, place) {
        (CodeSpectrum::As1170_4(_), _) => probability_factors().to_vec(),
        (CodeSpectrum::Nzs1170_5(_), _) => return_period_factors().to_vec(),
        (CodeSpectrum::Ts1170_5(_), Some(PlaceHazard::Ts1170_5 { levels })) => {
            let plateau = |level: &TsLevel| (level.years, level.values[TS_CLASS].sas_g);
            levels.iter().map(plateau).collect()
        }
        (CodeSpectrum::Tbdy2018(_), Some(PlaceHazard::Tbdy2018 { ss_g, .. })) => {
            TBDY_YEARS.into_iter().zip(ss_g).collect()
        }
        (CodeSpectrum::Ntc2018(_), Some(PlaceHazard::Ntc2018 { at })) => NTC_YEARS
            .into_iter()
            .filter_map(|years| Some((years, ntc_hazard(at, years)?.ag_g)))
            .collect(),
        _ => return None,
    };
    relative(levels, own_years)
}

/// Rates by the intensity over that of `own_years`, which lies between two return periods on a line in logarithms.
fn relative(mut levels: Vec<(u32, f64)>, own_years: f64) -> Option<(Hazard, bool)> {
    levels.sort_by_key(|(years, _)| *years);
    // Codes limit the rarest motions: equal accelerations say nothing of rates.
    levels.dedup_by(|next, before| next.1 <= before.1);
    let points = |scale: f64| {
        let point = |&(years, intensity): &(u32, f64)| HazardPoint {
            intensity: intensity / scale,
            annual_rate: 1.0 / f64::from(years),
        };
        let mut points: Vec<HazardPoint> = levels.iter().map(point).collect();
        // The line through the two shortest return periods goes on.
        let extends = match points[..] {
            [first, second, ..] if first.intensity > LEAST_RATIO => {
                let k = (first.annual_rate / second.annual_rate).ln()
                    / (second.intensity / first.intensity).ln();
                let more = (first.intensity / LEAST_RATIO).powf(k);
                let least = HazardPoint {
                    intensity: LEAST_RATIO,
                    annual_rate: first.annual_rate * more,
                };
                points.insert(0, least);
                true
            }
            _ => false,
        };
        Some((Hazard::points(points).ok()?, extends))
    };
    let after = levels
        .iter()
        .position(|(years, _)| f64::from(*years) >= own_years)
        .unwrap_or(levels.len().checked_sub(1)?)
        .max(1);
    let (&(low_years, low), &(high_years, high)) = (levels.get(after - 1)?, levels.get(after)?);
    let [low_ln, high_ln] = [low_years, high_years].map(|years| f64::from(years).ln());
    let share = (own_years.ln() - low_ln) / (high_ln - low_ln);
    points(low * (high / low).powf(share))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A power law of exponent 2 through two return periods, at one of them and between them: λ(s) = s^−2/R.
    #[test]
    fn rates_are_those_of_the_return_periods() {
        let levels = vec![(2500, 5.0), (100, 1.0)];
        for (own_years, s, expected) in [(100.0, 5.0, 1.0 / 2500.0), (400.0, 2.0, 1.0 / 1600.0)] {
            let (hazard, extends) = relative(levels.clone(), own_years).unwrap();
            assert!(extends);
            let found = hazard.annual_rate(s);
            // Rounding of logarithms.
            assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        }
        assert!(relative(vec![(475, 0.3)], 475.0).is_none());
        // Below the shortest return period the slope goes on: half of its intensity is four times as frequent.
        let (hazard, _) = relative(levels, 100.0).unwrap();
        assert!((hazard.annual_rate(0.5) * 25.0 - 1.0).abs() < 1e-12);
    }
}
