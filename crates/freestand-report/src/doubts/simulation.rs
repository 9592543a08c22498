//! What a simulation of motions assumes, as sentences.

use freestand::synthesis::{
    HighCut, PAIR_MOTIONS, Preset, SOUTH_EAST_AUSTRALIA_FARTHEST_M, SOUTH_EAST_AUSTRALIA_MAGNITUDES,
};
use freestand_input::words::number;
use freestand_study::simulated::{OutsideLimits, PresetAssumption, SimulationAssumption};

/// Something that a simulation assumes.
pub fn simulation_assumption(assumption: &SimulationAssumption) -> String {
    match assumption {
        SimulationAssumption::OfPreset(preset, one) => of_preset(*preset, one),
        SimulationAssumption::PathOfBoore => {
            "the source spectrum of Atkinson and Boore (1995) is combined with 0.05 s/km along the path, not with their \
             own duration"
                .to_owned()
        }
        SimulationAssumption::DurationOfOneCorner => {
            "the source has two corners, but its duration is 1/f0 with the single corner f0 of the same stress drop"
                .to_owned()
        }
        SimulationAssumption::QualityFitted {
            lowest_hz,
            highest_hz,
        } => format!(
            "Q was fitted from {lowest_hz} to {highest_hz} Hz; outside, the values at the ends are used"
        ),
        SimulationAssumption::SiteRatio(site) => format!(
            "site {}: Fourier amplitudes of rock times the ratio of the code's spectra {}/Be at T = 1/f; no soil column \
             was computed",
            site.name(),
            site.name()
        ),
        SimulationAssumption::DistancesFound => format!(
            "distances are those at which the geometric mean of {PAIR_MOTIONS} motions on rock, with the same time step \
             and low cut as the written ones, fits the code's rock spectrum from T = 0.5 to 1 s; the hazard was not \
             deaggregated"
        ),
    }
}

fn of_preset(preset: Preset, assumption: &PresetAssumption) -> String {
    let words = match assumption {
        PresetAssumption::OtherRegions {
            stress_drop_pa,
            high_cut,
        } => {
            let stress = stress_drop_pa.map_or_else(
                || "trilinear spreading is that".to_owned(),
                |stress_pa| format!("{} and trilinear spreading are those", mpa(stress_pa)),
            );
            let last = high_cut.map_or_else(String::new, |high_cut| {
                format!(", {} is a common value for rock", cut(high_cut))
            });
            format!(
                "{stress} of eastern North America, Q is that of Wilkie and Gibson{last}; none is fitted to the site"
            )
        }
        PresetAssumption::CutRecalled { high_cut, after } => {
            format!("{} is quoted from memory, after {after}", cut(*high_cut))
        }
        PresetAssumption::ForeignProfile => {
            "the Melbourne profile is not part of that model".to_owned()
        }
        PresetAssumption::DeepSources(stress_pa) => {
            format!("{} is for sources above 10 km depth", mpa(*stress_pa))
        }
        PresetAssumption::OtherStress(stress_pa) => {
            format!("the stress drop is {}, not the preset's", mpa(*stress_pa))
        }
        PresetAssumption::OtherCut(high_cut) => format!(
            "the loss near the surface is {}, not the preset's",
            cut(*high_cut)
        ),
        PresetAssumption::HardRock => "hard rock: no amplification by the crust".to_owned(),
    };
    format!("{}: {words}", preset.name())
}

fn mpa(stress_pa: f64) -> String {
    format!("{} MPa", number(stress_pa / 1e6, 3))
}

fn cut(high_cut: HighCut) -> String {
    match high_cut {
        HighCut::Kappa { kappa_s } => format!("κ0 = {} s", number(kappa_s, 3)),
        HighCut::MaximumFrequency { frequency_hz } => {
            format!("f_max = {} Hz", number(frequency_hz, 3))
        }
    }
}

/// That a preset was not made for an earthquake: the limits are those of the only one that has some.
pub fn outside_limits(earthquake: &OutsideLimits) -> String {
    format!(
        "se-australia was made for magnitudes from {} to {} and distances below {} km, not for magnitude {} at {} km",
        number(*SOUTH_EAST_AUSTRALIA_MAGNITUDES.start(), 3),
        number(*SOUTH_EAST_AUSTRALIA_MAGNITUDES.end(), 3),
        number(SOUTH_EAST_AUSTRALIA_FARTHEST_M / 1e3, 3),
        number(earthquake.magnitude, 3),
        number(earthquake.distance_m / 1e3, 4)
    )
}
