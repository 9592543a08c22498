//! What `freestand spectrum` shows to people: all rows of a small grid; of a large one the first
//! few, where the others are, and each motion summed up.

use freestand_study::spectrum::{SpectrumChunk, SpectrumMotion, SpectrumRow, SpectrumTally, SpectrumTiming};

use crate::printer::{optional, significant, table};

/// Most rows that are shown in full; of more, the first few are.
const SHOWN_ROWS: usize = 200;
const FIRST_ROWS: usize = 10;

/// Most motions that are summed up.
const SHOWN_MOTIONS: usize = 50;

/// What is remembered of the rows that went by.
#[derive(Debug)]
pub(crate) struct Seen {
    /// One for each motion.
    pub(crate) tallies: Vec<SpectrumTally>,
    rows: Vec<Vec<String>>,
    total: usize,
    sensitivity: bool,
}

impl Seen {
    /// For `total` rows of so many motions.
    pub(crate) fn new(motions: usize, total: usize) -> Self {
        Self { tallies: vec![SpectrumTally::default(); motions], rows: Vec::new(), total, sensitivity: false }
    }

    pub(crate) fn add(&mut self, chunk: &SpectrumChunk) {
        let keep = if self.total > SHOWN_ROWS { FIRST_ROWS } else { self.total };
        for row in chunk.rows() {
            self.tallies[chunk.motion].add(&row);
            if self.rows.len() < keep {
                self.sensitivity |= row.sensitivity.is_some();
                self.rows.push(cells(&row));
            }
        }
    }

    /// The text; `place` is the file with all rows.
    pub(crate) fn text(&self, motions: &[SpectrumMotion], place: Option<&str>, timing: &SpectrumTiming) -> String {
        let mut headings = vec![
            "motion",
            "height m",
            "thickness m",
            "outcome",
            "uplift mm",
            "shock g (uplift)",
            "shock g (impact velocity)",
            "ceiling g",
        ];
        headings.extend(self.sensitivity.then_some("sensitivity"));
        let mut text = table(&headings, &self.rows);
        let more = self.total - self.rows.len();
        if more > 0 {
            let place = place.map_or_else(
                || "--csv FILE or --json gives them all".to_owned(),
                |path| format!("all of them are in {path}"),
            );
            text += &format!("… and {more} more rows: {place}\n\n");
            text += &self.motions(motions);
        }
        let steps = timing.block_steps;
        text += &format!("\n{steps} block-steps in {} s", significant(timing.solve_s, 3));
        if let Some(seconds) = timing.sensitivity_s {
            text += &format!(", sensitivity in {} s", significant(seconds, 3));
        }
        text + "\n"
    }

    /// A line for each motion.
    fn motions(&self, motions: &[SpectrumMotion]) -> String {
        let mut headings = vec![
            "motion",
            "objects",
            "rocked",
            "overturned",
            "failed",
            "largest uplift mm",
            "largest shock g (uplift)",
        ];
        headings.extend(self.sensitivity.then_some("sensitive"));
        let rows = motions.iter().zip(&self.tallies).take(SHOWN_MOTIONS).map(|(motion, tally)| {
            let mut row = vec![motion.name.clone()];
            row.extend([tally.objects, tally.rocked, tally.overturned, tally.failed].map(|count| count.to_string()));
            row.push(millimetres(tally.largest_uplift_m));
            row.push(optional(tally.largest_edge_acceleration_g, 4, ""));
            row.extend(self.sensitivity.then(|| tally.sensitive.to_string()));
            row
        });
        let mut text = table(&headings, &rows.collect::<Vec<_>>());
        if motions.len() > SHOWN_MOTIONS {
            text += &format!("… and {} more motions\n", motions.len() - SHOWN_MOTIONS);
        }
        text
    }
}

fn cells(row: &SpectrumRow) -> Vec<String> {
    let mut cells = vec![
        row.motion.to_owned(),
        significant(row.height_m, 4),
        significant(row.thickness_m, 4),
        row.outcome.to_owned(),
        millimetres(row.uplift_m),
        optional(row.edge_acceleration_g, 4, ""),
        optional(row.edge_acceleration_impact_velocity_g, 4, ""),
        optional(row.ceiling_g, 4, ""),
    ];
    cells.extend(row.sensitivity.map(|sensitivity| match sensitivity.ratio {
        None if sensitivity.sensitive => "another outcome".to_owned(),
        ratio => optional(ratio, 3, ""),
    }));
    cells
}

fn millimetres(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| significant(1e3 * value, 4))
}
