//! The assumptions of a simulation, after all changes of parameters.

use freestand::code_spectrum::SiteClass;
use freestand::synthesis::{
    HighCut, PAIR_MOTIONS, PathDuration, PointSource, Preset, Quality,
    SOUTH_EAST_AUSTRALIA_FARTHEST_M, SOUTH_EAST_AUSTRALIA_MAGNITUDES, SourceSpectrum,
};

use super::{Earthquakes, SimulatedRequest};
use freestand_input::words::number;

/// One sentence each; `source` is any source of the request, with its changes.
pub(super) fn assumptions(request: &SimulatedRequest, source: &PointSource) -> Vec<String> {
    let mut said = of_the_preset(request, source);
    if source.spectrum == SourceSpectrum::TwoCorner {
        if source.path_duration == PathDuration::Boore {
            said.push(
                "the source spectrum of Atkinson and Boore (1995) is combined with 0.05 s/km along the path, \
                 not with their own duration"
                    .to_owned(),
            );
        }
        said.push(
            "the source has two corners, but its duration is 1/f0 with the single corner f0 of the same stress drop"
                .to_owned(),
        );
    }
    if let Quality::LogCubic {
        lowest_hz,
        highest_hz,
        ..
    } = source.quality
    {
        said.push(format!(
            "Q was fitted from {lowest_hz} to {highest_hz} Hz; outside, the values at the ends are used"
        ));
    }
    if request.site != SiteClass::Be {
        said.push(format!(
            "site {}: Fourier amplitudes of rock times the ratio of the code's spectra {}/Be at T = 1/f; no soil \
             column was computed",
            request.site.name(),
            request.site.name()
        ));
    }
    if matches!(request.earthquakes, Earthquakes::Pairs { .. }) {
        said.push(format!(
            "distances are those at which the geometric mean of {PAIR_MOTIONS} motions on rock, with the same time \
             step and low cut as the written ones, fits the code's rock spectrum from T = 0.5 to 1 s; the hazard was \
             not deaggregated"
        ));
    }
    said
}

fn of_the_preset(request: &SimulatedRequest, source: &PointSource) -> Vec<String> {
    let (preset, changes) = (request.preset, &request.changes);
    let own_stress = changes.stress_drop_pa.is_none();
    let cut = match source.high_cut {
        HighCut::Kappa { kappa_s } => format!("κ0 = {} s", number(kappa_s, 3)),
        HighCut::MaximumFrequency { frequency_hz } => {
            format!("f_max = {} Hz", number(frequency_hz, 3))
        }
    };
    let own_cut = changes.kappa_s.is_none();
    let mpa = format!("{} MPa", number(source.stress_drop_pa / 1e6, 3));
    let mut said = Vec::new();
    let mut say = |is_so: bool, words: String| {
        if is_so {
            said.push(format!("{}: {words}", preset.name()));
        }
    };
    match preset {
        Preset::Victoria => {
            let stress = if own_stress {
                format!("{mpa} and trilinear spreading are those")
            } else {
                "trilinear spreading is that".to_owned()
            };
            let last = if own_cut {
                format!(", {cut} is a common value for rock")
            } else {
                String::new()
            };
            say(
                true,
                format!(
                    "{stress} of eastern North America, Q is that of Wilkie and Gibson{last}; none is fitted to the \
                     site"
                ),
            );
        }
        Preset::IntraplateHardRock => {
            say(
                own_cut,
                format!("{cut} is quoted from memory, after Atkinson and Boore (1995)"),
            );
        }
        Preset::SouthEastAustralia => {
            say(
                own_cut,
                format!("{cut} is quoted from memory, after Allen (2012)"),
            );
            say(
                source.profile.is_some(),
                "the Melbourne profile is not part of that model".to_owned(),
            );
            say(
                own_stress,
                format!("{mpa} is for sources above 10 km depth"),
            );
        }
    }
    say(
        !own_stress,
        format!("the stress drop is {mpa}, not the preset's"),
    );
    say(
        !own_cut,
        format!("the loss near the surface is {cut}, not the preset's"),
    );
    say(
        changes.hard_rock,
        "hard rock: no amplification by the crust".to_owned(),
    );
    said
}

/// A warning if an earthquake lies outside the range of its model.
pub(super) fn outside_limits(preset: Preset, source: &PointSource) -> Option<String> {
    let inside = SOUTH_EAST_AUSTRALIA_MAGNITUDES.contains(&source.magnitude)
        && source.distance_m < SOUTH_EAST_AUSTRALIA_FARTHEST_M;
    (preset == Preset::SouthEastAustralia && !inside).then(|| {
        format!(
            "se-australia was made for magnitudes from {} to {} and distances below {} km, not for magnitude {} at \
             {} km",
            number(*SOUTH_EAST_AUSTRALIA_MAGNITUDES.start(), 3),
            number(*SOUTH_EAST_AUSTRALIA_MAGNITUDES.end(), 3),
            number(SOUTH_EAST_AUSTRALIA_FARTHEST_M / 1e3, 3),
            number(source.magnitude, 3),
            number(source.distance_m / 1e3, 4)
        )
    })
}
