//! The text of `freestand spectrum`: all rows of a small grid; for a large one, the first few rows,
//! where to find the others, and a summary of each motion.

use freestand_input::words::{counted, significant};
use freestand_study::spectrum::{
    SpectrumChunk, SpectrumMotion, SpectrumRequest, SpectrumTally, SpectrumTiming,
};

use crate::table::{Column, cells, headings, optional, table};

/// The largest number of rows that are all shown; if there are more, only the first few are.
const MAX_SHOWN_ROWS: usize = 200;
const FIRST_ROWS: usize = 10;

/// The largest number of motions that are summarised.
const MAX_SHOWN_MOTIONS: usize = 50;

/// Shown for every spectrum.
const COLUMNS: [Column; 8] = [
    ("motion", "motion", 0),
    ("height_m", "height [m]", 4),
    ("thickness_m", "thickness [m]", 4),
    ("outcome", "outcome", 0),
    ("uplift_m", "uplift [mm]", 4),
    ("edge_acceleration_g", "shock, uplift [g]", 4),
    (
        "edge_acceleration_impact_velocity_g",
        "shock, impact velocity [g]",
        4,
    ),
    ("ceiling_g", "ceiling [g]", 4),
];

/// Of objects that slide or roll; where casters are braked, some of them rock.
const SLIDING_COLUMNS: [Column; 7] = [
    ("motion", "motion", 0),
    ("height_m", "height [m]", 4),
    ("thickness_m", "thickness [m]", 4),
    ("outcome", "outcome", 0),
    ("slide_peak_m", "slide [mm]", 4),
    ("slide_speed_max_m_s", "speed [m/s]", 4),
    ("uplift_m", "uplift [mm]", 4),
];
/// Shown for objects beside walls.
const OF_WALLS: [Column; 1] = [("wall_speed_max_m_s", "speed at a wall [m/s]", 4)];

/// Shown with `--sensitivity`.
const OF_SENSITIVITY: [Column; 2] = [
    ("sensitivity_ratio", "sensitivity", 3),
    ("sensitive", "sensitive", 0),
];

/// The rows that the text shows, and the sums over all rows.
#[derive(Debug)]
pub struct Seen {
    /// One for each motion.
    pub tallies: Vec<SpectrumTally>,
    rows: Vec<Vec<String>>,
    total: usize,
    walls: bool,
    sensitivity: bool,
    slides: bool,
    has_pads: bool,
}

impl Seen {
    /// For `total` rows of this number of motions.
    pub fn new(motions: usize, total: usize, request: &SpectrumRequest) -> Self {
        let tallies = vec![SpectrumTally::default(); motions];
        let (walls, slides) = (!request.walls.is_none(), request.surface.is_some());
        let has_pads = request.cushion.is_some();
        Self {
            tallies,
            rows: Vec::new(),
            total,
            walls,
            sensitivity: request.sensitivity,
            slides,
            has_pads,
        }
    }

    fn columns(&self) -> Vec<Column> {
        if self.slides {
            return SLIDING_COLUMNS.to_vec();
        }
        let walls = OF_WALLS.iter().filter(|_| self.walls);
        let sensitivity = OF_SENSITIVITY.iter().filter(|_| self.sensitivity);
        COLUMNS
            .iter()
            .chain(walls)
            .chain(sensitivity)
            .copied()
            .collect()
    }

    /// Adds the rows of a chunk.
    pub fn add(&mut self, chunk: &SpectrumChunk) {
        let keep = if self.total > MAX_SHOWN_ROWS {
            FIRST_ROWS
        } else {
            self.total
        };
        chunk.add_to(&mut self.tallies[chunk.motion]);
        let (columns, missing) = (self.columns(), keep - self.rows.len().min(keep));
        self.rows
            .extend(chunk.rows().take(missing).map(|row| cells(&row, &columns)));
    }

    /// The text; `place` is the file with all rows.
    pub fn text(
        &self,
        motions: &[SpectrumMotion],
        place: Option<&str>,
        timing: &SpectrumTiming,
    ) -> String {
        let mut text = table(&headings(&self.columns()), &self.rows);
        let more = self.total - self.rows.len();
        if more > 0 {
            let place = place.map_or_else(
                || "--csv FILE or --json writes all rows".to_owned(),
                |path| format!("all rows are in {path}"),
            );
            text += &format!("… and {more} more rows: {place}\n\n");
            text += &self.motions(motions);
        }
        if self.has_pads {
            text +=
                "\nbase: rigid; on its pads, which give the shock alone, an object may lift more\n";
        }
        let steps = timing.block_steps;
        text += &format!(
            "\n{steps} block-steps in {} s",
            significant(timing.solve_s, 3)
        );
        if let Some(seconds) = timing.sensitivity.map(|timing| timing.sensitivity_s) {
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
            "largest uplift [mm]",
            "largest shock, uplift [g]",
        ];
        headings.extend(self.walls.then_some("leaned"));
        headings.extend(self.sensitivity.then_some("sensitive"));
        headings.extend(
            self.slides
                .then_some(["slid", "largest slide [mm]"])
                .iter()
                .flatten(),
        );
        let rows = motions
            .iter()
            .zip(&self.tallies)
            .take(MAX_SHOWN_MOTIONS)
            .map(|(motion, tally)| {
                let mut row = vec![motion.name.clone()];
                row.extend(
                    [tally.objects, tally.rocked, tally.overturned, tally.failed]
                        .map(|count| count.to_string()),
                );
                row.push(millimetres(tally.largest_uplift_m));
                row.push(optional(tally.largest_edge_acceleration_g, 4, ""));
                row.extend(self.walls.then(|| tally.leaned.to_string()));
                row.extend(self.sensitivity.then(|| tally.sensitive.to_string()));
                if self.slides {
                    row.extend([tally.slid.to_string(), millimetres(tally.largest_slide_m)]);
                }
                row
            });
        let mut text = table(&headings, &rows.collect::<Vec<_>>());
        if motions.len() > MAX_SHOWN_MOTIONS {
            text += &format!(
                "… and {}\n",
                counted(motions.len() - MAX_SHOWN_MOTIONS, "more motion")
            );
        }
        text
    }
}

fn millimetres(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| significant(1e3 * value, 4))
}
