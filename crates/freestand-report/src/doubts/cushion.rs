//! How the description of a cushion was read.

use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::number;
use freestand_study::cushion::{CushionNote, HERTZ_EXPONENT, cushion_words};

/// How the description of a cushion was read.
pub fn cushion_note(note: &CushionNote) -> String {
    match note {
        CushionNote::HertzExponent => format!(
            "the exponent of the law was not given: {HERTZ_EXPONENT}, the exponent of a sphere (Hertz)"
        ),
        CushionNote::Secant(secant) => {
            let (written, power) = (&secant.written, number(secant.exponent, 6));
            let per_mm = number(secant.stiffness_n_m / 1e3, 6);
            format!(
                "\"{written}\" is read as the secant stiffness at 1 mm, {per_mm} N/mm^{power}: {:.4e} N/m^{power}",
                secant.coefficient_n_mn
            )
        }
        CushionNote::Pads { count, pad, edge } => {
            let plural = if *count == 1 { "pad" } else { "pads" };
            format!(
                "{count} {plural} of {} → edge {}",
                cushion_words(pad),
                cushion_words(edge)
            )
        }
        CushionNote::DampingRatio {
            ratio,
            mass_kg,
            damping_n_s_m,
        } => format!(
            "damping ratio {} % with {} → {} under the edge",
            number(100.0 * ratio, 4),
            format_si(*mass_kg, Dimension::Mass),
            format_si(*damping_n_s_m, Dimension::Damping)
        ),
        CushionNote::InSeries { layers, whole } => {
            let parts: Vec<String> = layers.iter().map(cushion_words).collect();
            let sum = if whole.linear_stiffness_n_m().is_some() {
                cushion_words(whole)
            } else {
                "one law".to_owned()
            };
            format!("{} in series → {sum}", parts.join(" and "))
        }
    }
}

/// The same of all that is told of a cushion.
pub(crate) fn cushion_notes(notes: &[CushionNote]) -> Vec<String> {
    notes.iter().map(cushion_note).collect()
}

#[cfg(test)]
mod tests {
    use freestand::cushion::{ContactLaw, Cushion};
    use freestand_study::law::Secant;

    use super::*;
    use crate::doubts::tests::all;

    #[test]
    fn every_note_in_words() {
        let linear = |stiffness_n_m| Cushion::linear(stiffness_n_m).unwrap();
        let hertz = Cushion::new(ContactLaw::Power {
            coefficient_n_mn: 2e7,
            exponent: 1.5,
        })
        .unwrap();
        let pads = |count| CushionNote::Pads {
            count,
            pad: linear(2.19e6),
            edge: linear(2.19e6).side_by_side(count),
        };
        let in_series = |layers: Vec<Cushion>| CushionNote::InSeries {
            whole: Cushion::in_series(&layers).unwrap(),
            layers,
        };
        let notes = [
            CushionNote::HertzExponent,
            CushionNote::Secant(Secant {
                written: "40 N/mm".to_owned(),
                stiffness_n_m: 40e3,
                exponent: 2.0,
                coefficient_n_mn: 40e6,
            }),
            pads(1),
            pads(2),
            CushionNote::DampingRatio {
                ratio: 0.05,
                mass_kg: 140.0,
                damping_n_s_m: 2476.4,
            },
            in_series(vec![linear(4.38e6), linear(2.19e6)]),
            in_series(vec![linear(4.38e6), hertz]),
        ];
        all(&notes);
        insta::assert_snapshot!(cushion_notes(&notes).join("\n"));
    }
}
