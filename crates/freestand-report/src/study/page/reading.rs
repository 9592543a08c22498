//! Explanations: comparison with the paper, assumptions, definitions, corrections.

use freestand::building::Model;
use freestand::code_spectrum::{CodeSpectrum, SiteClass};

use freestand_input::words::{number, percent};
use freestand_study::result::{LevelResult, StudyResult};
use freestand_study::study::{Ground, Study};
use freestand_study::summary::level_summary;

use freestand_output::html::{BREAK, list, table, words};
use maud::{Markup, html};

/// The paper's numbers next to those of this study.
pub(super) fn beside_the_paper(study: &Study, result: &StudyResult) -> Markup {
    let at = |wanted: f64| {
        result.levels.iter().find(|level| {
            level
                .level
                .level_ratio
                .is_some_and(|ratio| (ratio - wanted).abs() < 0.02)
        })
    };
    let rows = [
        ["Shock at mid-height", "about 3.5 g", &shock_words(at(0.5))],
        ["Shock at the roof", "up to 5 g", &shock_words(at(1.0))],
        [
            "Objects 200 mm thick and higher than 1.5 m at the roof",
            "overturn",
            &overturned_words(at(1.0)),
        ],
    ]
    .map(|row| row.map(words));
    html! {
        p {
            "The paper: H. Al Abadi, J. Petrolito, N. Lam and E. Gad, “Shock Induced Damage onto Free-Standing Objects \
             in an Earthquake”, Section V and Fig. 7: objects of 150 kg on 4380 N/mm in a generic 30-storey building, in \
             a synthetic 500-year Melbourne earthquake on site class D."
        }
        (table("", &["", "Paper", "This study"].map(words), rows))
        @if !is_the_papers_case(study) {
            p {
                "The ground, objects or cushion of this study differ from the paper’s: compare the two columns only by \
                 their order of magnitude."
            }
        }
        p {
            "The paper shows the result of one motion, but states neither the motion nor the period, damping and modes \
             of the building, so that its curves cannot be reproduced exactly. The shock of one object differs between \
             motions by a factor of two and more: compare bands, not lines."
        }
    }
}

fn is_the_papers_case(study: &Study) -> bool {
    let ground = match &study.ground {
        Ground::Synthetic(synthetic) => match &synthetic.target.spectrum {
            CodeSpectrum::As1170_4(code) => {
                code.site() == SiteClass::De
                    && code.return_period_years() == 500
                    && (code.kpz_g() - 0.08).abs() < 1e-9
            }
            _ => false,
        },
        Ground::Simulated(_) | Ground::Recorded(_) | Ground::OnFloors => false,
    };
    ground
        && study
            .building
            .as_ref()
            .is_some_and(|building| building.storeys == 30)
        && (study.objects.mass_kg - 150.0).abs() < 1e-6
        && study
            .objects
            .cushion
            .cushion
            .linear_stiffness_n_m()
            .is_some_and(|k| (k - 4.38e6).abs() < 1.0)
}

fn shock_words(level: Option<&LevelResult>) -> String {
    let Some(level) = level else {
        return "not a level of this study".to_owned();
    };
    let s = level_summary(level, None);
    match (s.edge_acceleration_g_median, s.edge_acceleration_g_max) {
        (Some(median), Some(most)) => {
            format!(
                "medians up to {} g; single motions up to {} g",
                number(median, 3),
                number(most, 3)
            )
        }
        (None, Some(most)) => format!("single motions up to {} g", number(most, 3)),
        _ => "every motion overturns them".to_owned(),
    }
}

fn overturned_words(level: Option<&LevelResult>) -> String {
    let Some(level) = level else {
        return "not a level of this study".to_owned();
    };
    let shares: Vec<f64> = level
        .statistics
        .iter()
        .flatten()
        .filter(|s| (s.thickness_m - 0.2).abs() < 1e-9 && s.height_m > 1.5 + 1e-9)
        .map(|s| s.overturned_share)
        .collect();
    match (
        shares.iter().copied().reduce(f64::min),
        shares.iter().copied().reduce(f64::max),
    ) {
        (Some(least), Some(most)) if least == most => {
            format!("{} of the motions overturn them", percent(most, 0))
        }
        (Some(least), Some(most)) => {
            format!(
                "{} to {} of the motions overturn them",
                percent(least, 0),
                percent(most, 0)
            )
        }
        _ => "not in this study’s grid".to_owned(),
    }
}

/// The assumptions.
pub(super) fn assumptions(study: &Study) -> Markup {
    let mut items = vec![
        if study.directions_deg.len() > 1 {
            "Each object is a rigid, uniform rectangular block on two edges that rocks about one horizontal axis. \
             The motion is turned through half a circle, and the direction that is worst for the object counts. \
             Check an item about both of its axes."
        } else {
            "Each object is a rigid, uniform rectangular block on two edges that rocks about one horizontal axis, \
             in the plane of the motion. Check an item about both of its axes."
        },
        "It does not slide, bounce or twist, and it hits no wall or neighbour. Warnings state where friction is not \
         sufficient for this.",
        "The rocking is computed on a rigid floor; the cushion only determines the shock, as a linear spring \
         without damping.",
        if study.ground.has_vertical() {
            "The vertical motion of the floor changes the weight of the object, by (1 + vertical acceleration/g), at \
             uplift and while it rocks; the floors above the ground have that of the ground, times one factor."
        } else {
            "Horizontal only: the vertical motion of the floor is not considered."
        },
        match study
            .building
            .as_ref()
            .map(|building| building.along.model())
        {
            Some(Model::Beam { .. }) => {
                "The building is linear and elastic and uniform over its height; the objects do not affect it."
            }
            Some(Model::Shear { .. }) => {
                "The building is linear and elastic; its floors are rigid and it deforms only in shear. The objects \
                 do not affect it."
            }
            Some(Model::Table { .. }) => {
                "The building is linear and elastic, with only the modes of its table; the rest of its mass follows \
                 the ground. The objects do not affect it."
            }
            None => "The motions of the floors are used as given.",
        },
        "An impact takes no time. The restitution r of the inputs is the angular velocity after it divided by that \
         before; the landing ratio of the impact model is always that of Eq. (6).",
        "After the motion, zeros are appended until every object has come to rest or overturned.",
    ];
    match &study.ground {
        Ground::Synthetic(_) => items.push(
            "The ground motions are synthetic: noise under a smooth window, matched to the target spectrum. They \
             differ only in their phases, so their scatter is smaller than that of real earthquakes.",
        ),
        Ground::Simulated(_) => items.push(
            "The ground motions are simulated: noise under a smooth window with the mean Fourier amplitudes of a \
             point source, without the extent of a fault, pulses or surface waves. They differ only in their phases, \
             so their scatter is smaller than that of real earthquakes.",
        ),
        Ground::Recorded(records) if records.iter().any(|record| record.matched.is_some()) => items.push(
            "The records were matched to the target spectrum: their phases are kept, their amplitudes are not. \
             Their scatter is smaller than that of real earthquakes.",
        ),
        Ground::Recorded(_) if study.ground.suite().is_some() => items.push(
            "The records were selected and scaled so that their spectra together have the mean of the target and a \
             stated dispersion; the shape of each is its own. A factor changes the amplitudes of a record, not its \
             duration or its frequencies.",
        ),
        Ground::Recorded(_) | Ground::OnFloors => {}
    }
    let assumed = if let Ground::Simulated(simulated) = &study.ground {
        crate::ground::assumptions(&simulated.request)
    } else {
        vec![]
    };
    items.extend(assumed.iter().map(String::as_str));
    list(&items)
}

/// Symbols, equations, percentiles.
pub(super) fn definitions() -> Markup {
    html! {
        h3 { "Motion" }
        p {
            "t, h: thickness (width in the plane of the motion) and height; R = ½√(h² + t²): from a pivot edge to the \
             centre of gravity; α = atan(t/h): the slenderness angle, at which the block balances on its edge; p = \
             √(3g/4R); s = sign of θ; ü: acceleration of the floor."
        }
        p.eq {
            "θ̈ = −p² [ sin(sα − θ) + (ü/g) cos(sα − θ) ], uplift where |ü| > g t/h" (BREAK)
            "ω" sup { "+" } " = r ω" sup { "−" }
            " at θ = 0; Housner: r = 1 − (3/2) sin²α, unless the inputs give another"
        }
        p {
            "Overturned: |θ| reaches π/2. An object that has passed α has not overturned yet: the motion can bring it \
             back."
        }
        p.eq { "uplift δ = t sin|θ|; rise of the centre of gravity Δh = R [cos(α − |θ|) − cos α]" }
        h3 { "Shock" }
        p {
            "m: mass; k: dynamic stiffness of all the cushion under one edge; d: from the pivot edge to the point of \
             impact, t for rocking; a: peak acceleration of the mass m dropped by Δh onto the cushion. The shock is \
             the peak acceleration of the edge that lands."
        }
        p.eq {
            "a = √(2 k g Δh / m) (7)" (BREAK)
            (r_d()) " = 1 − ⅜ (d/R)² (6)" (BREAK)
            (a_edge()) " = ¾ (1 − " (r_d()) "²)" sup { "−½" } " (d/R)² a (5)"
        }
        p { "For (d/R)² > 8/3 (h/t < 0.707) an object cannot rock through an impact; the landing is halted:" }
        p.eq { (a_edge()) " = ¾ (d/R)² a (8)" }
        p {
            "Source “uplift” (the paper’s): Δh is the largest rise over the history. Source “velocity”: Δh = I₀ω²/(2mg) \
             from the largest angular velocity ω just before an impact, I₀ = (4/3) m R². Uplift ceiling: the shock at Δh \
             = R (1 − cos α), the balance point; the uplift source cannot exceed it, the velocity source can, by up to \
             about half."
        }
        h3 { "Statistics" }
        p {
            "For each object all motions are ranked by the quantity: no uplift counts as 0, overturned as larger than \
             any number. The 16th, 50th and 84th percentiles are read from that ranking (linearly between ranks \
             (n − 1)q); one that falls among the overturned is “overturned”. A mean without the overturned histories \
             is not used: it would decrease where objects begin to overturn. PFA: peak floor acceleration; PGA: peak \
             ground acceleration; ZPA: value of the target spectrum at zero period."
        }
    }
}

fn r_d() -> Markup {
    html! { "R" sub { "D" } }
}

fn a_edge() -> Markup {
    html! { "a" sub { "edge" } }
}

/// The misprints that matter here.
pub(super) fn errata() -> Markup {
    let rows = [
        [
            words("Eq. (2)"),
            words("I₀ = ¾ m R²"),
            words("I₀ = (4/3) m R², which Eqs. (5) and (8) already use"),
        ],
        [
            words(r_d()),
            words("before over after the impact"),
            words("after over before: θ̇₂/θ̇₁"),
        ],
        [
            words("below Eq. (4)"),
            words(html! { "1 − " (r_d()) "² is the energy retained" }),
            words("it is the share lost in the impact"),
        ],
        [
            words("Sections IV and V"),
            words("2190 N/m, 4380 N/m"),
            words("N/mm: only then do Table I and Fig. 7 agree"),
        ],
        [
            words("before Eq. (8)"),
            words("cases (a) and (c)"),
            words("(a) and (b), the halted impacts"),
        ],
        [
            words("Eq. (5)"),
            words(html! { "the text leads to √(1 − " (r_d()) "²) in the numerator" }),
            words(
                "used as printed, in the denominator: 4.5 g for the first test of Table I, where 4.0–4.1 g were measured",
            ),
        ],
        [
            words("Fig. 7 (b)"),
            words("SRS at roof level"),
            words("SRS at mid-height"),
        ],
    ];
    table("", &["Where", "Printed", "Used here"].map(words), rows)
}

#[cfg(test)]
mod tests {
    use freestand::building::{Building, Damping, Storey, TableMode};

    use super::*;

    /// Only the beam is uniform over its height.
    #[test]
    fn the_building_is_called_what_it_is() {
        let mut study = crate::study::fixture::study();
        assert!(assumptions(&study).0.contains("uniform over its height"));
        let damping = Damping::Uniform(0.05);
        let storey = Storey {
            mass_kg: 1e5,
            stiffness_n_m: 1e8,
            height_m: 3.0,
        };
        let mode = TableMode {
            period_s: 1.0,
            damping_ratio: None,
            participation_ratio: 1.0,
            effective_mass_ratio: None,
            shape_ratio: vec![1.0],
        };
        for (building, said) in [
            (
                Building::shear(&[storey; 2], &damping, 2).unwrap(),
                "its floors are rigid",
            ),
            (
                Building::from_modes(&[1.0], &[mode], &damping).unwrap(),
                "the modes of its table",
            ),
        ] {
            study.building.as_mut().unwrap().along = building;
            let html = assumptions(&study).0;
            assert!(
                html.contains(said) && !html.contains("uniform over"),
                "{html}"
            );
        }
    }
}
