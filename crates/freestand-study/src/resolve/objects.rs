//! Resolves `[objects]`.

use freestand::block::Block;

use freestand::rocking::{Accuracy, Restitution};

use super::{MAX_OBJECTS, Resolver, or, stated};
use crate::options::{ObjectsOptions, RestitutionOption};
use crate::restitution::checked;
use crate::shape::squat;
use crate::study::{Objects, StudyDoubt};
use freestand_input::quantity::{Dimension, parse_grid, shorten};
use freestand_input::toml_reader::Written;

const DEFAULT_MASS_KG: f64 = 150.0;
const DEFAULT_HEIGHTS: &str = "0.5 m:3 m:26";
const DEFAULT_THICKNESSES_M: [f64; 5] = [0.2, 0.3, 0.4, 0.5, 0.6];

impl Resolver<'_> {
    pub(super) fn objects(&mut self, written: &ObjectsOptions) -> Option<Objects> {
        for (key, grid) in [
            ("heights", &written.heights_m),
            ("thicknesses", &written.thicknesses_m),
        ] {
            if let Some(Written { value, line }) = grid {
                if value.is_empty() {
                    self.note(
                        Some(*line),
                        format!("{key} is empty"),
                        "give at least one length",
                    );
                } else if let Some(wrong) = value
                    .iter()
                    .find(|&&length| !(length > 0.0 && length.is_finite()))
                {
                    self.note(
                        Some(*line),
                        format!("{key} must be positive, not {wrong} m"),
                        "give lengths above 0",
                    );
                }
            }
        }
        self.positive(&written.mass_kg, "mass", Dimension::Mass);
        let mass_kg = or(&written.mass_kg, DEFAULT_MASS_KG);
        let cushion = self.cushion(&written.cushion, mass_kg);
        self.positive(
            &written.tolerance_m_s2,
            "tolerance",
            Dimension::Acceleration,
        );
        self.positive(&written.friction, "friction", Dimension::Ratio);
        self.exclusive(
            ("restitution", &written.restitution),
            ("restitution_factor", &written.restitution_factor),
        );
        let heights_m = or(
            &written.heights_m,
            parse_grid(DEFAULT_HEIGHTS, Dimension::Length).unwrap_or_default(),
        );
        let thicknesses_m = or(&written.thicknesses_m, DEFAULT_THICKNESSES_M.to_vec());
        if heights_m.len().saturating_mul(thicknesses_m.len()) > MAX_OBJECTS {
            let line = written
                .heights_m
                .as_ref()
                .or(written.thicknesses_m.as_ref())
                .map(|w| w.line);
            self.note(
                line,
                format!(
                    "the grid of {} heights × {} thicknesses has more than {MAX_OBJECTS} objects",
                    heights_m.len(),
                    thicknesses_m.len()
                ),
                "give fewer heights or thicknesses",
            );
            return None;
        }
        let accuracy = self.accuracy(written);
        let blocks: Vec<Block> = heights_m
            .iter()
            .flat_map(|&height_m| {
                thicknesses_m
                    .iter()
                    .filter_map(move |&t| Block::uniform(height_m, t).ok())
            })
            .collect();
        let restitution = self.restitution(written, &blocks);
        if blocks.len() != heights_m.len() * thicknesses_m.len() {
            return None;
        }
        let (cushion, cushion_file) = cushion?;
        let of_cushion = cushion.stiffness_doubts(mass_kg).into_iter();
        let squat = squat(blocks.len(), blocks.iter().copied()).into_iter();
        self.doubts.extend(of_cushion.map(StudyDoubt::Cushion));
        self.doubts.extend(squat.map(StudyDoubt::Squat));
        Some(Objects {
            heights_m,
            thicknesses_m,
            blocks,
            mass_kg,
            cushion,
            cushion_file,
            restitution: restitution?,
            accuracy: accuracy?,
            tolerance_m_s2: stated(&written.tolerance_m_s2),
            friction: stated(&written.friction),
        })
    }

    fn accuracy(&mut self, written: &ObjectsOptions) -> Option<Accuracy> {
        let Some(Written { value, line }) = &written.accuracy else {
            return Some(Accuracy::Standard);
        };
        match value.to_lowercase().as_str() {
            "fast" => Some(Accuracy::Fast),
            "standard" => Some(Accuracy::Standard),
            "tight" => Some(Accuracy::Tight),
            _ => {
                self.note(
                    Some(*line),
                    format!("accuracy \"{}\" is not known", shorten(value)),
                    "use fast, standard or tight",
                );
                None
            }
        }
    }

    fn restitution(&mut self, written: &ObjectsOptions, blocks: &[Block]) -> Option<Restitution> {
        let (restitution, line) = match (&written.restitution_factor, &written.restitution) {
            (Some(factor), _) => (Restitution::Factor(factor.value), Some(factor.line)),
            (
                None,
                Some(Written {
                    value: RestitutionOption::Value(value),
                    line,
                }),
            ) => (Restitution::Value(*value), Some(*line)),
            (None, _) => (Restitution::Housner, None),
        };
        checked(restitution, blocks)
            .map_err(|problem| self.fault(line, "restitution", problem))
            .ok()
    }
}
