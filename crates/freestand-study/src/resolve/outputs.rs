//! Resolves `[outputs]`.

use super::{Resolver, or, stated};
use crate::options::{HistoryOptions, OutputsOptions};
use crate::study::{HistoryChoice, Level, Objects, Outputs, TitleBlock};
use freestand_input::quantity::{Dimension, format_si, shorten};

impl Resolver<'_> {
    pub(super) fn outputs(
        &mut self,
        written: &OutputsOptions,
        levels: &[Level],
        objects: Option<&Objects>,
        motions: Option<&[String]>,
    ) -> Outputs {
        let history = written
            .history
            .as_ref()
            .and_then(|history| self.history(history, levels, objects, motions));
        let parquet = or(&written.parquet, false);

        let title = TitleBlock {
            date: stated(&written.date),
            preparer: stated(&written.preparer),
            revision: stated(&written.revision),
        };
        Outputs {
            figures: or(&written.figures, true),
            report: or(&written.report, true),
            parquet,
            cards: or(&written.cards, false),
            title,
            history,
        }
    }

    fn history(
        &mut self,
        written: &HistoryOptions,
        levels: &[Level],
        objects: Option<&Objects>,
        motions: Option<&[String]>,
    ) -> Option<HistoryChoice> {
        // It may name a level or an object that was refused.
        if !self.is_complete {
            return None;
        }
        let (Some(level), Some(height), Some(thickness)) =
            (&written.level, &written.height_m, &written.thickness_m)
        else {
            let hint =
                "write history = { level = \"roof\", height = \"1.5 m\", thickness = \"300 mm\" }";
            self.note(
                Some(written.line),
                "history needs level, height and thickness",
                hint,
            );
            return None;
        };
        let named = levels
            .iter()
            .find(|one| one.name.eq_ignore_ascii_case(&level.value));
        if named.is_none() {
            let names: Vec<&str> = levels.iter().map(|level| level.name.as_str()).collect();
            self.note(
                Some(level.line),
                format!(
                    "history: no level has the name \"{}\"",
                    shorten(&level.value)
                ),
                format!("levels: {}", names.join(", ")),
            );
        }
        self.positive(&written.height_m, "history.height", Dimension::Length);
        self.positive(&written.thickness_m, "history.thickness", Dimension::Length);
        if let Some(objects) = objects {
            for (key, value, grid) in [
                ("height", height, &objects.heights_m),
                ("thickness", thickness, &objects.thicknesses_m),
            ] {
                // Grid points are interpolated, so that 1.5 m in the grid may differ from "1.5 m"
                // by rounding.
                if !grid
                    .iter()
                    .any(|point| (point - value.value).abs() <= 1e-9 * value.value.abs())
                {
                    let message = format!(
                        "history: the grid has no {key} of {}",
                        format_si(value.value, Dimension::Length)
                    );
                    self.note(
                        Some(value.line),
                        message,
                        format!(
                            "add it to {key}{}",
                            if key == "height" { "s" } else { "es" }
                        ),
                    );
                }
            }
        }
        if let (Some(motion), Some(names)) = (&written.motion, motions)
            && !names.contains(&motion.value)
        {
            let names = &names[..names.len().min(10)];
            self.note(
                Some(motion.line),
                format!(
                    "history: no motion has the name \"{}\"",
                    shorten(&motion.value)
                ),
                format!("motions: {}", names.join(", ")),
            );
        }
        Some(HistoryChoice {
            level: named?.name.clone(),
            motion: stated(&written.motion),
            height_m: height.value,
            thickness_m: thickness.value,
        })
    }
}
