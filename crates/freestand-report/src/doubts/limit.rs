//! Where a result is outside the range of its model.

use freestand::impact::ValidityWarning;

/// Where a result is outside the range of its model.
pub fn model_limit(limit: &ValidityWarning) -> String {
    match *limit {
        ValidityWarning::StaticCompression {
            compression_mm,
            limit_mm,
        } => format!(
            "the weight alone would compress the cushion by {compression_mm:.4} mm, more than its {limit_mm} mm: was the \
             stiffness given in N/m instead of N/mm?"
        ),
        ValidityWarning::LowStiffness { stiffness_n_mm } => format!(
            "the stiffness of {stiffness_n_mm:.4} N/mm under one edge is very low: was it given in N/m instead of N/mm?"
        ),
        ValidityWarning::Bottoming {
            compression_mm,
            limit_mm,
        } => format!(
            "the impact compresses the cushion by {compression_mm:.2} mm of its {limit_mm} mm: a pad stiffens as it \
             bottoms, so the shock is higher than the linear law gives"
        ),
        ValidityWarning::HalfSpace {
            compression_mm,
            limit_mm,
        } => format!(
            "the impact compresses the cushion by {compression_mm:.2} mm of its {limit_mm} mm: beyond a quarter of the \
             thickness a Hertz law no longer holds, the pad stiffens and the shock is higher"
        ),
        ValidityWarning::Bottomed {
            compression_mm,
            bottoming_mm,
        } => format!(
            "the impact compresses the cushion by {compression_mm:.2} mm of the {bottoming_mm} mm at which it bottoms: \
             the shock is that of a bottomed pad and depends mainly on where it bottoms"
        ),
        ValidityWarning::BeyondTable { compression_mm } => format!(
            "the impact compresses the cushion by {compression_mm:.2} mm, beyond the last point of its force table: the \
             last line of the table was extended"
        ),
        ValidityWarning::Squat { landing_ratio } => format!(
            "a squat object (Housner's ratio {landing_ratio:.3} is negative, h/t < 0.707 for a uniform block) cannot \
             rock through an impact: landings are halted (r = 0 in the motion, shock by Eq. (8))"
        ),
        ValidityWarning::Sliding {
            needed_ratio,
            friction_ratio,
            in_impact,
        } => {
            let when = if in_impact {
                "in an impact"
            } else {
                "while rocking"
            };
            format!(
                "the object needs a coefficient of friction of {needed_ratio:.3} {when}, more than the available \
                 {friction_ratio}: it may slide, which the model does not cover"
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::doubts::tests::all;

    #[test]
    fn every_limit_in_words() {
        let (compression_mm, limit_mm) = (12.3456, 20.0);
        let limits = [
            ValidityWarning::StaticCompression {
                compression_mm,
                limit_mm,
            },
            ValidityWarning::LowStiffness {
                stiffness_n_mm: 4.38,
            },
            ValidityWarning::Bottoming {
                compression_mm,
                limit_mm,
            },
            ValidityWarning::HalfSpace {
                compression_mm,
                limit_mm,
            },
            ValidityWarning::Bottomed {
                compression_mm,
                bottoming_mm: 12.5,
            },
            ValidityWarning::BeyondTable { compression_mm },
            ValidityWarning::Squat {
                landing_ratio: -0.1,
            },
            ValidityWarning::Sliding {
                needed_ratio: 0.61,
                friction_ratio: 0.5,
                in_impact: true,
            },
        ];
        all(&limits);
        let told: Vec<String> = limits.iter().map(model_limit).collect();
        insta::assert_snapshot!(told.join("\n"));
    }
}
