//! The assumptions of a simulation, after all changes of parameters, as data: `freestand-report` has the words.

use freestand::code_spectrum::SiteClass;
use freestand::synthesis::{
    HighCut, PathDuration, PointSource, Preset, Quality, SOUTH_EAST_AUSTRALIA_FARTHEST_M,
    SOUTH_EAST_AUSTRALIA_MAGNITUDES, SourceSpectrum,
};
use strum::EnumCount;

use super::{Earthquakes, SimulatedRequest};

/// Something that a simulation assumes.
#[derive(Debug, Clone, Copy, PartialEq, EnumCount)]
pub enum SimulationAssumption {
    /// Of the parameters of the preset.
    OfPreset(Preset, PresetAssumption),
    /// The source of Atkinson and Boore is combined with a duration along the path that is not theirs.
    PathOfBoore,
    /// The duration of a source with two corners is that of one corner.
    DurationOfOneCorner,
    /// Q was fitted in this range.
    QualityFitted {
        /// From \[Hz\].
        lowest_hz: f64,
        /// To \[Hz\].
        highest_hz: f64,
    },
    /// The site changes the amplitudes of rock.
    SiteRatio(SiteClass),
    /// The distances are those at which the motions fit a spectrum.
    DistancesFound,
}

/// Something that the parameters of a preset assume, or that was changed in them.
#[derive(Debug, Clone, Copy, PartialEq, EnumCount)]
pub enum PresetAssumption {
    /// Values of other regions, in Victoria.
    OtherRegions {
        /// The stress drop, where it is the preset's \[Pa\].
        stress_drop_pa: Option<f64>,
        /// The loss near the surface, where it is the preset's.
        high_cut: Option<HighCut>,
    },
    /// The loss near the surface is quoted from memory.
    CutRecalled {
        /// The loss.
        high_cut: HighCut,
        /// Whose it is.
        after: &'static str,
    },
    /// The crust is that of Melbourne, which is not part of the model.
    ForeignProfile,
    /// The stress drop is that of deep sources \[Pa\].
    DeepSources(f64),
    /// The stress drop is another \[Pa\].
    OtherStress(f64),
    /// The loss near the surface is another.
    OtherCut(HighCut),
    /// There is no amplification by the crust.
    HardRock,
}

/// An earthquake that the preset was not made for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutsideLimits {
    /// Its magnitude.
    pub magnitude: f64,
    /// Its distance \[m\].
    pub distance_m: f64,
}

/// `source` is any source of the request, with its changes.
pub(super) fn assumptions(
    request: &SimulatedRequest,
    source: &PointSource,
) -> Vec<SimulationAssumption> {
    let of_preset = |one| SimulationAssumption::OfPreset(request.preset, one);
    let mut all: Vec<_> = of_the_preset(request, source).map(of_preset).collect();
    if source.spectrum == SourceSpectrum::TwoCorner {
        if source.path_duration == PathDuration::Boore {
            all.push(SimulationAssumption::PathOfBoore);
        }
        all.push(SimulationAssumption::DurationOfOneCorner);
    }
    if let Quality::LogCubic {
        lowest_hz,
        highest_hz,
        ..
    } = source.quality
    {
        all.push(SimulationAssumption::QualityFitted {
            lowest_hz,
            highest_hz,
        });
    }
    if request.site != SiteClass::Be {
        all.push(SimulationAssumption::SiteRatio(request.site));
    }
    if matches!(request.earthquakes, Earthquakes::Pairs { .. }) {
        all.push(SimulationAssumption::DistancesFound);
    }
    all
}

fn of_the_preset(
    request: &SimulatedRequest,
    source: &PointSource,
) -> impl Iterator<Item = PresetAssumption> {
    let (changes, high_cut) = (&request.changes, source.high_cut);
    let own_stress = changes.stress_drop_pa.is_none();
    let own_cut = changes.kappa_s.is_none();
    let recalled = |after| own_cut.then_some(PresetAssumption::CutRecalled { high_cut, after });
    let of_preset = match request.preset {
        Preset::Victoria => [
            Some(PresetAssumption::OtherRegions {
                stress_drop_pa: own_stress.then_some(source.stress_drop_pa),
                high_cut: own_cut.then_some(high_cut),
            }),
            None,
            None,
        ],
        Preset::IntraplateHardRock => [recalled("Atkinson and Boore (1995)"), None, None],
        Preset::SouthEastAustralia => [
            recalled("Allen (2012)"),
            source
                .profile
                .is_some()
                .then_some(PresetAssumption::ForeignProfile),
            own_stress.then_some(PresetAssumption::DeepSources(source.stress_drop_pa)),
        ],
    };
    let changed = [
        (!own_stress).then_some(PresetAssumption::OtherStress(source.stress_drop_pa)),
        (!own_cut).then_some(PresetAssumption::OtherCut(high_cut)),
        changes.hard_rock.then_some(PresetAssumption::HardRock),
    ];
    of_preset.into_iter().chain(changed).flatten()
}

/// Whether an earthquake lies outside the range of its model.
pub(super) fn outside_limits(preset: Preset, source: &PointSource) -> Option<OutsideLimits> {
    let inside = SOUTH_EAST_AUSTRALIA_MAGNITUDES.contains(&source.magnitude)
        && source.distance_m < SOUTH_EAST_AUSTRALIA_FARTHEST_M;
    (preset == Preset::SouthEastAustralia && !inside).then_some(OutsideLimits {
        magnitude: source.magnitude,
        distance_m: source.distance_m,
    })
}
