//! Resolves the building of `[building]` along each horizontal axis.

use freestand::building::{Damping, MAX_MODES};
use freestand::code_spectrum::{FrameKind, fundamental_period_s};

use super::{MAX_STOREYS, Resolver, or};
use crate::building::{
    Axis, AxisModel, AxisRequest, DEFAULT_DAMPING_RATIO, DEFAULT_SHEAR_FLEXURE_RATIO, DEFAULT_STOREY_HEIGHT_M,
    DEFAULT_STOREYS, axis,
};
use crate::options::{AxisOptions, BuildingOptions};
use crate::study::BuildingInput;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, format_si, shorten};
use freestand_input::toml_reader::Written;

/// The height that both axes share.
#[derive(Debug, Clone, Copy)]
struct Stated {
    storeys: usize,
    storey_height_m: f64,
}

impl Resolver<'_> {
    pub(super) fn building(&mut self, written: &BuildingOptions) -> Option<BuildingInput> {
        self.require(&written.storeys, |n| (1..=MAX_STOREYS).contains(&n), "storeys", "a whole number from 1 to 500");
        self.positive(&written.storey_height_m, "storey_height", Dimension::Length);
        let before = self.problems.len();
        let along = &written.along;
        self.check_axis(along);
        if let Some(across) = &written.across {
            self.check_axis(&across.value);
        }
        for (key, table) in [("storey_table", &along.storey_table), ("mode_table", &along.mode_table)] {
            self.exclusive((key, table), ("storeys", &written.storeys));
            self.exclusive((key, table), ("storey_height", &written.storey_height_m));
        }
        let mut stated = Stated {
            storeys: usize::try_from(or(&written.storeys, DEFAULT_STOREYS.into())).unwrap_or(usize::MAX),
            storey_height_m: or(&written.storey_height_m, DEFAULT_STOREY_HEIGHT_M),
        };
        let first = self.axis(along, stated, before);
        if let Some((Axis { height_m: Some(height_m), building, .. }, _)) = &first {
            let floors = building.floors_ratio().len();
            stated = Stated { storeys: floors, storey_height_m: height_m / floors as f64 };
        }
        let height_m = stated.storeys as f64 * stated.storey_height_m;
        // Resolved even if the first is wrong, so that the problems of both are reported at once.
        let across = written.across.as_ref();
        let second = across.map(|across| self.axis(&inherited(&across.value, along), stated, before));
        self.check_damping_counts(along, first.as_ref());
        if let (Some(across), Some(second)) = (across, &second) {
            self.check_damping_counts(&across.value, second.as_ref());
        }
        let (first, period_note) = first?;
        let uniform = first.height_m.is_none();
        let second = match second {
            None => None,
            Some(second) => Some(second?),
        };
        if let (Some((Axis { height_m: Some(other_m), .. }, _)), Some(across)) = (&second, &written.across)
            && (other_m - height_m).abs() > 1e-3 * height_m
        {
            let (here, there) = (format_si(height_m, Dimension::Length), format_si(*other_m, Dimension::Length));
            let message = format!("the building is {there} high across, but {here} along");
            self.note(
                Some(across.line),
                message,
                "both tables must have the same height, because levels are shares of it",
            );
            return None;
        }
        let (second, across_note) = second.unzip();
        let mut tables = Vec::from_iter(first.table.clone().map(|table| (false, table)));
        // A table that the second axis inherits is listed once, with the first.
        let names_its_own =
            across.is_some_and(|axis| axis.value.storey_table.is_some() || axis.value.mode_table.is_some());
        let own = second.as_ref().and_then(|axis| axis.table.clone()).filter(|_| names_its_own);
        tables.extend(own.map(|table| (true, table)));
        self.warnings.extend(first.warnings);
        self.warnings.extend(second.iter().flat_map(|axis| axis.warnings.clone()));
        Some(BuildingInput {
            storeys: stated.storeys,
            height_m,
            storey_height_m: uniform.then_some(stated.storey_height_m),
            along: first.building,
            across: second.map(|axis| axis.building),
            period_note,
            across_note,
            tables,
        })
    }

    /// Notes what is wrong with the keys of one axis.
    fn check_axis(&mut self, written: &AxisOptions) {
        self.positive(&written.period_s, "period", Dimension::Time);
        self.require(&written.damping, |zeta| (0.0..1.0).contains(&zeta), "damping", "a ratio from 0 to below 1");
        self.require(&written.shear_flexure, |a| a >= 0.0 && a.is_finite(), "shear_flexure", "0 or more");
        self.require(&written.modes, |n| (1..=MAX_MODES as u64).contains(&n), "modes", "a whole number from 1 to 50");
        self.exclusive(("period", &written.period_s), ("frame", &written.frame));
        self.exclusive(("storey_table", &written.storey_table), ("mode_table", &written.mode_table));
        self.exclusive(("modes", &written.modes), ("mode_table", &written.mode_table));
        for (key, table) in [("storey_table", &written.storey_table), ("mode_table", &written.mode_table)] {
            self.exclusive((key, table), ("period", &written.period_s));
            self.exclusive((key, table), ("frame", &written.frame));
            self.exclusive((key, table), ("shear_flexure", &written.shear_flexure));
        }
        if let Some(Written { value, line }) = &written.frame
            && FrameKind::parse(value).is_none()
        {
            let hint = "steel-moment, concrete-moment, steel-braced or other; or give period = \"1.92 s\"";
            self.note(Some(*line), format!("frame \"{}\" is not known", shorten(value)), hint);
        }
    }

    /// Notes damping keys that have no effect because the table states the damping of every mode.
    fn check_damping_counts(&mut self, written: &AxisOptions, axis: Option<&(Axis, String)>) {
        if !axis.is_some_and(|(axis, _)| axis.table.as_ref().is_some_and(|table| table.states_damping)) {
            return;
        }
        let keys = [
            ("damping", written.damping.as_ref().map(|w| w.line)),
            ("rayleigh_modes", written.rayleigh_modes.as_ref().map(|w| w.line)),
        ];
        for (key, line) in keys {
            if line.is_some() {
                let message = format!("{key} is not used: the table states the damping of every mode");
                self.note(line, message, format!("leave {key} out, or clear the cells of the modes that it is for"));
            }
        }
    }

    /// One axis, and the source of its period. `before`: the number of problems before the building
    /// was read.
    fn axis(&mut self, written: &AxisOptions, stated: Stated, before: usize) -> Option<(Axis, String)> {
        let (model, note) = match (&written.storey_table, &written.mode_table) {
            (Some(name), _) => {
                (AxisModel::StoreyTable(self.base_dir.join(&name.value)), "from the storeys of the table".to_owned())
            }
            (None, Some(name)) => (AxisModel::ModeTable(self.base_dir.join(&name.value)), "from the table".to_owned()),
            (None, None) => {
                let (period_s, note) = self.period(written, stated.storeys as f64 * stated.storey_height_m)?;
                (
                    AxisModel::Beam {
                        period_s,
                        shear_flexure_ratio: or(&written.shear_flexure, DEFAULT_SHEAR_FLEXURE_RATIO),
                    },
                    note,
                )
            }
        };
        let damping_ratio = or(&written.damping, DEFAULT_DAMPING_RATIO);
        let damping = match &written.rayleigh_modes {
            None => Damping::Uniform(damping_ratio),
            Some(modes) => {
                let modes = modes.value.map(|mode| usize::try_from(mode).unwrap_or(usize::MAX));
                Damping::Rayleigh { damping_ratio, modes }
            }
        };
        let modes = written.modes.as_ref().map(|modes| usize::try_from(modes.value).unwrap_or(usize::MAX));
        if self.problems.len() > before {
            // Values that were refused above would be refused again.
            return None;
        }
        match axis(&AxisRequest { model, damping, modes }) {
            Ok(axis) => Some((axis, note)),
            Err(problem) => {
                self.axis_fault(written, problem);
                None
            }
        }
    }

    fn axis_fault(&mut self, written: &AxisOptions, problem: Problem) {
        let line_of = |name: &Option<Written<String>>| name.as_ref().map(|name| name.line);
        let (key, line) = match (line_of(&written.storey_table), line_of(&written.mode_table)) {
            (None, None) => {
                let line = written.rayleigh_modes.as_ref().map(|modes| modes.line);
                ("building", line.or(written.period_s.as_ref().map(|period| period.line)))
            }
            (Some(line), _) => ("storey_table", Some(line)),
            (None, line) => ("mode_table", line),
        };
        self.fault(line, key, problem);
    }

    /// The fundamental period and its source.
    fn period(&self, written: &AxisOptions, height_m: f64) -> Option<(f64, String)> {
        if let Some(period) = &written.period_s {
            return Some((period.value, "as given".to_owned()));
        }
        // A frame that does not exist was noted above.
        let kind = written.frame.as_ref().map_or(Some(FrameKind::Other), |frame| FrameKind::parse(&frame.value))?;
        let period_s = fundamental_period_s(kind, height_m).ok()?;
        let (kt, name, height) = (kind.period_factor(), kind.name(), format_si(height_m, Dimension::Length));
        Some((period_s, format!("AS 1170.4, 1.25 kt h^0.75 with kt = {kt} (frame \"{name}\") and h = {height}")))
    }
}

/// Values that `across` does not state are those along the first axis; but where it describes
/// another kind of model, it takes only the damping from there.
fn inherited(across: &AxisOptions, along: &AxisOptions) -> AxisOptions {
    let has_table = across.storey_table.is_some() || across.mode_table.is_some();
    let has_period = across.period_s.is_some() || across.frame.is_some();
    let is_beam = !has_table && (has_period || across.shear_flexure.is_some());
    let along_has_table = along.storey_table.is_some() || along.mode_table.is_some();
    let mut axis = across.clone();
    axis.damping = axis.damping.or_else(|| along.damping.clone());
    axis.rayleigh_modes = axis.rayleigh_modes.or_else(|| along.rayleigh_modes.clone());
    if !(has_table || along_has_table && is_beam) {
        axis.storey_table = along.storey_table.clone();
        axis.mode_table = along.mode_table.clone();
        axis.shear_flexure = axis.shear_flexure.or_else(|| along.shear_flexure.clone());
        axis.modes = axis.modes.or_else(|| along.modes.clone());
        if !has_period {
            axis.period_s = along.period_s.clone();
            axis.frame = along.frame.clone();
        }
    }
    axis
}
