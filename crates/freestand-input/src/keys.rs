//! The keys under which a person writes values, and how messages name them.
//!
//! A key has one spelling in files, in Python and in this program: `pad_stiffness`. A message puts
//! a key in backticks, alone or with a value as in TOML: `` `pad_stiffness` ``,
//! `` `beyond = "hold"` ``. The shell that shows the message writes the keys as its user does, with
//! [`KeyStyle::shown`]. Backticks in messages are for keys only.

use crate::written::Written;

/// How a person writes a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum KeyStyle {
    /// `pad_stiffness`, `beyond = "hold"`.
    #[default]
    File,
    /// `--pad-stiffness`, `--beyond hold`.
    Flag,
    /// `pad_stiffness_n_m`, `beyond="hold"`: an argument of Python, which is in SI and states its
    /// unit.
    Argument,
}

/// Arguments of Python whose names are not those of their keys, with the unit that a bare number
/// has; the first argument of a key is the one that messages name.
const ARGUMENTS: &[(&str, &str, &str)] = &[
    ("stiffness_n_m", "stiffness", " N/m"),
    ("pad_stiffness_n_m", "pad_stiffness", " N/m"),
    ("series_stiffness_n_m", "series_stiffness", " N/m"),
    ("contact_stiffness_n_m", "contact_stiffness", " N/m"),
    ("wall_stiffness_n_m", "wall_stiffness", " N/m"),
    ("tangential_stiffness_n_m", "tangential_stiffness", " N/m"),
    ("pad_thickness_m", "pad_thickness", " m"),
    ("damping_ratio", "damping", ""),
    ("damping_n_s_m", "damping", " N s/m"),
    ("dissipation_s_m", "dissipation", " s/m"),
    ("bottoming_m", "bottoming", " m"),
    ("dt_s", "dt", " s"),
    ("azimuth_deg", "azimuth", " deg"),
    ("taper_ratio", "taper", ""),
    ("low_cut_hz", "low_cut", " Hz"),
    ("high_cut_hz", "high_cut", " Hz"),
    ("resample_s", "resample", " s"),
    ("scale_to_g", "scale_to", " g"),
    ("height_m", "height", " m"),
    ("thickness_m", "thickness", " m"),
    ("heights_m", "heights", " m"),
    ("thicknesses_m", "thicknesses", " m"),
    ("width_m", "width", " m"),
    ("diameter_m", "diameter", " m"),
    ("scan_error_m", "scan_error", " m"),
    ("contact_sinking_m", "contact_sinking", " m"),
    ("base_width_m", "base_width", " m"),
    ("cg_height_m", "cg_height", " m"),
    ("cg_offset_m", "cg_offset", " m"),
    ("inertia_kg_m2", "inertia", " kg m2"),
    ("clearance_left_m", "clearance_left", " m"),
    ("clearance_right_m", "clearance_right", " m"),
    ("stop_stiffness_n_m", "stop_stiffness", " N/m"),
    ("wall_height_m", "wall_height", " m"),
    ("wall_gap_m", "wall_gap", " m"),
    ("neighbour_gap_m", "neighbour_gap", " m"),
    ("clearance_m", "clearance", " m"),
    ("upper_height_m", "upper_height", " m"),
    ("upper_thickness_m", "upper_thickness", " m"),
    ("upper_mass_kg", "upper_mass", " kg"),
    ("cushion", "on", ""),
    ("importance_ratio", "importance", ""),
    ("amplification_ratio", "amplification", ""),
    ("response_ratio", "response", ""),
    ("resonance_ratio", "resonance", ""),
    ("strength_ratio", "strength", ""),
    ("building_ductility_ratio", "building_ductility", ""),
    ("anchor_inset_m", "anchor_inset", " m"),
    ("anchor_capacity_n", "anchor_capacity", " N"),
    ("anchor_shear_capacity_n", "anchor_shear_capacity", " N"),
    ("inventory", "list", ""),
    ("edits", "edit", ""),
    ("cg_rise_m", "cg_rise", " m"),
    ("uplift_m", "uplift", " m"),
    ("rotation_rad", "rotation", " rad"),
    ("angular_velocity_rad_s", "angular_velocity", " rad/s"),
    ("initial_rotation_rad", "initial_rotation", " rad"),
    ("initial_velocity_rad_s", "initial_velocity", " rad/s"),
    ("impact_velocity_m_s", "impact_velocity", " m/s"),
    ("duration_s", "duration", " s"),
    ("mass_kg", "mass", " kg"),
    ("gravity_m_s2", "gravity", " m/s2"),
    ("gap_m", "gap", " m"),
    ("obstacle_height_m", "obstacle_height", " m"),
    ("at_m", "at_point", " m"),
    ("drop_acceleration_g", "drop_acceleration", " g"),
    ("tolerance_g", "tolerance", " g"),
    ("tolerance_duration_s", "tolerance_duration", " s"),
    (
        "tolerance_velocity_change_m_s",
        "tolerance_velocity_change",
        " m/s",
    ),
    ("tolerance_edge_lift_m", "tolerance_edge_lift", " m"),
    ("component_frequency_hz", "component_frequency", " Hz"),
    ("component_capacity_g", "component_capacity", " g"),
    ("sphere_radius_m", "sphere_radius", " m"),
    ("velocity_error_ratio", "velocity_error", ""),
    ("corner_hz", "corner", " Hz"),
    ("load_n", "load", " N"),
    ("machine_stiffness_n_m", "machine_compliance", " N/m"),
    ("dynamic_stiffness_n_m", "dynamic", " N/m"),
    ("cut_toe", "toe", ""),
    ("inverted", "invert", ""),
    ("left_m", "wall_gap_left", " m"),
    ("right_m", "wall_gap_right", " m"),
    ("fault_distance_m", "fault_distance", " m"),
    ("ground_acceleration_g", "ground_acceleration", " g"),
    ("floor_acceleration_g", "floor_acceleration", " g"),
    ("corner_periods_s", "corner_periods", " s"),
    ("sds_g", "sds", " g"),
    ("sd1_g", "sd1", " g"),
    ("ss_g", "ss", " g"),
    ("s1_g", "s1", " g"),
    ("long_period_s", "long_period", " s"),
    ("storey_height_m", "storey_height", " m"),
    ("building_height_m", "height", " m"),
    ("building_height_m", "building_height", " m"),
    ("building_period_s", "building_period", " s"),
    ("period_s", "period", " s"),
    ("across_period_s", "across_period", " s"),
    ("periods_s", "periods", " s"),
    ("frequencies_hz", "frequencies", " Hz"),
    ("tail_s", "tail", " s"),
    ("time_step_s", "time_step", " s"),
    ("shaking_s", "shaking", " s"),
    ("envelope_s", "envelope", " s"),
    ("pga_g", "pga", " g"),
    ("ceiling_g", "ceiling", " g"),
    ("discount_ratio", "discount", ""),
    ("accepted_rate", "accepted", " /yr"),
    ("site_deg", "site_coordinates", ""),
];

/// Ends of keys that a flag does not have.
const UNSTATED: [&str; 2] = ["_years", "_point"];

/// Keys whose arguments have the same name, and bare values.
const SAME: &[&str] = &[
    "across_mode_table",
    "across_shear_flexure",
    "across_storey_table",
    "baseline",
    "beyond",
    "city",
    "code",
    "component",
    "fault_magnitude",
    "cushion",
    "edition",
    "exponent",
    "fa",
    "filter_order",
    "frame",
    "fv",
    "hazard_factor",
    "importance_factor",
    "interpolation",
    "keep_mean",
    "law",
    "mode_table",
    "modes",
    "pads_per_edge",
    "period_code",
    "place",
    "rayleigh_modes",
    "return_period_years",
    "scale",
    "scale_to_sa",
    "scale_to_spectrum",
    "shear_flexure",
    "site",
    "soil_factor",
    "spectrum",
    "spectrum_type",
    "station_xml",
    "storey_table",
    "storeys",
    "unit",
];

/// The key of an argument of Python, and the unit of a bare number, to be written after it.
///
/// # Example
/// ```
/// use freestand_input::keys::argument_key;
/// assert_eq!(argument_key("pad_stiffness_n_m"), Some(("pad_stiffness", " N/m")));
/// assert_eq!(argument_key("law"), Some(("law", "")));
/// assert_eq!(argument_key("stiffnes"), None);
/// ```
pub fn argument_key(argument: &str) -> Option<(&'static str, &'static str)> {
    let same = SAME.iter().find(|name| **name == argument);
    same.map(|&key| (key, "")).or_else(|| {
        let mut renamed = ARGUMENTS.iter();
        renamed
            .find(|(name, ..)| *name == argument)
            .map(|&(_, key, unit)| (key, unit))
    })
}

/// The unit of a bare number that Python takes for a key; none where its value has no unit.
///
/// # Example
/// ```
/// use freestand_input::keys::unit_of_argument;
/// assert_eq!((unit_of_argument("pad_stiffness"), unit_of_argument("law")), ("N/m", ""));
/// ```
pub fn unit_of_argument(key: &str) -> &'static str {
    let mut renamed = ARGUMENTS.iter();
    let found = renamed.find(|(_, known, _)| *known == key);
    found.map_or("", |(.., unit)| unit.trim_start())
}

impl KeyStyle {
    /// A key in this style. A flag does not state what its value is: `return_period_years` is
    /// `--return-period`, `at_point` is `--at`.
    pub fn name(self, key: &str) -> String {
        match self {
            Self::File => key.to_owned(),
            Self::Flag => {
                let stated = UNSTATED
                    .iter()
                    .fold(key, |key, end| key.trim_end_matches(end));
                format!("--{}", stated.replace('_', "-"))
            }
            Self::Argument => ARGUMENTS
                .iter()
                .find(|(_, known, _)| *known == key)
                .map_or(key, |(name, ..)| name)
                .to_owned(),
        }
    }

    /// A message with its keys in this style.
    ///
    /// # Example
    /// ```
    /// use freestand_input::keys::KeyStyle;
    /// let message = "`pad_stiffness` needs `pads_per_edge = 2`";
    /// assert_eq!(KeyStyle::Flag.shown(message), "--pad-stiffness needs --pads-per-edge 2");
    /// assert_eq!(KeyStyle::File.shown(message), "pad_stiffness needs pads_per_edge = 2");
    /// ```
    pub fn shown(self, message: &str) -> String {
        let (mut shown, mut rest) = (String::with_capacity(message.len()), message);
        while let Some((before, tail)) = rest.split_once('`') {
            shown.push_str(before);
            // A backtick that does not mark a key stays unchanged.
            match tail
                .split_once('`')
                .and_then(|(marked, after)| Some((self.entry(marked)?, after)))
            {
                Some((entry, after)) => {
                    shown.push_str(&entry);
                    rest = after;
                }
                None => {
                    shown.push('`');
                    rest = tail;
                }
            }
        }
        shown.push_str(rest);
        shown
    }

    /// `key` or `key = value` in this style; `None` for anything else.
    fn entry(self, marked: &str) -> Option<String> {
        let (key, value) = marked
            .split_once(" = ")
            .map_or((marked, None), |(key, value)| (key, Some(value)));
        let is_key = key.starts_with(|c: char| c.is_ascii_lowercase())
            && key
                .chars()
                .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
        if !is_key {
            return None;
        }
        let name = self.name(key);
        Some(match (self, value) {
            (Self::File, _) => marked.to_owned(),
            (Self::Flag, None | Some("true")) | (Self::Argument, None) => name,
            (Self::Argument, Some("true")) => format!("{name}=True"),
            // Without its unit the value would say something else.
            (Self::Argument, Some(_)) if name != key => name,
            (Self::Argument, Some(value)) => format!("{name}={value}"),
            (Self::Flag, Some(value)) => {
                let bare = value.trim_matches('"');
                let is_word = bare
                    .chars()
                    .all(|c| c.is_ascii_alphanumeric() || "._-".contains(c));
                format!("{name} {}", if is_word { bare } else { value })
            }
        })
    }
}

/// Values as a person wrote them, with their units, in the order of writing. Values from a file
/// have their line numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Words {
    entries: Vec<Word>,
}

#[derive(Debug, Clone, PartialEq)]
struct Word {
    key: &'static str,
    text: String,
    /// The numbers of a program, which are in SI; of a person they are a text with a unit.
    numbers: Vec<f64>,
    /// What a program gave in place of one value.
    many: Option<&'static str>,
    line: Option<usize>,
}

impl Words {
    /// Sets the value of a key and removes its earlier values.
    pub fn set(&mut self, key: &'static str, text: impl Into<String>) {
        self.remove(key);
        self.add(key, text, None);
    }

    /// Adds a value to those of a key, with its line if it is from a file.
    pub fn add(&mut self, key: &'static str, text: impl Into<String>, line: Option<usize>) {
        self.entries.push(Word {
            key,
            text: text.into(),
            numbers: Vec::new(),
            many: None,
            line,
        });
    }

    /// Adds a value of a request. An empty list is none.
    pub fn write(&mut self, key: &'static str, written: &Written) {
        let numbers = match written {
            Written::List(all) if all.is_empty() => return,
            Written::Number(number) => vec![*number],
            Written::List(all) => {
                let number = |one: &Written| match one {
                    Written::Number(number) => Some(*number),
                    _ => None,
                };
                all.iter()
                    .map(number)
                    .collect::<Option<_>>()
                    .unwrap_or_default()
            }
            Written::Flag(_) | Written::Text(_) | Written::Table => Vec::new(),
        };
        self.entries.push(Word {
            key,
            // Nobody reads many numbers as a text.
            text: match numbers.len() {
                0..=20 => written.text(),
                many => format!("{many} numbers"),
            },
            numbers,
            many: match written {
                Written::List(_) => Some("a list"),
                Written::Table => Some("a table"),
                _ => None,
            },
            line: None,
        });
    }

    /// Removes the values of a key.
    pub fn remove(&mut self, key: &str) {
        self.entries.retain(|word| word.key != key);
    }

    /// Whether there are no values.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The first value of a key.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.all(key).next()
    }

    /// All values of a key.
    pub fn all(&self, key: &str) -> impl Iterator<Item = &str> {
        self.entries()
            .filter(move |(name, _)| *name == key)
            .map(|(_, text)| text)
    }

    /// What a program gave as the first value of a key in place of one value: a list or a table.
    pub fn many(&self, key: &str) -> Option<&'static str> {
        self.entries.iter().find(|word| word.key == key)?.many
    }

    /// The numbers in SI that a program gave as the first value of a key; none if it is a text.
    pub fn numbers(&self, key: &str) -> &[f64] {
        let first = self.entries.iter().find(|word| word.key == key);
        first.map_or(&[], |word| &word.numbers)
    }

    /// All values of a key, each with the numbers in SI that a program gave in place of its text.
    pub fn all_with_numbers(&self, key: &str) -> impl Iterator<Item = (&str, &[f64])> {
        let of_key = self.entries.iter().filter(move |word| word.key == key);
        of_key.map(|word| (word.text.as_str(), word.numbers.as_slice()))
    }

    /// Keys and values, in the order of writing.
    pub fn entries(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.entries
            .iter()
            .map(|word| (word.key, word.text.as_str()))
    }

    /// Keys and their lines, in the order of writing.
    pub fn lines(&self) -> impl Iterator<Item = (&'static str, Option<usize>)> {
        self.entries.iter().map(|word| (word.key, word.line))
    }

    /// The last line on which one of these keys was written.
    pub fn line_of(&self, keys: &[impl AsRef<str>]) -> Option<usize> {
        self.lines()
            .filter(|(key, _)| keys.iter().any(|one| one.as_ref() == *key))
            .filter_map(|(_, line)| line)
            .max()
    }
}

impl<T: Into<String>> FromIterator<(&'static str, T)> for Words {
    fn from_iter<I: IntoIterator<Item = (&'static str, T)>>(entries: I) -> Self {
        let word = |(key, text): (&'static str, T)| Word {
            key,
            text: text.into(),
            numbers: Vec::new(),
            many: None,
            line: None,
        };
        Self {
            entries: entries.into_iter().map(word).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_shown_as_the_reader_writes_them() {
        assert_eq!(
            KeyStyle::Argument.shown("`pad_stiffness` needs `pads_per_edge = 2`"),
            "pad_stiffness_n_m needs pads_per_edge=2"
        );
        assert_eq!(
            KeyStyle::Argument.shown("`tolerance = \"5 g\"`, `plot = true`"),
            "tolerance_g, plot=True"
        );
        for (message, file, flag) in [
            (
                "`dt`: not a number",
                "dt: not a number",
                "--dt: not a number",
            ),
            (
                "give `tolerance = \"5 g\"`",
                "give tolerance = \"5 g\"",
                "give --tolerance \"5 g\"",
            ),
            (
                "or `beyond = \"hold\"`",
                "or beyond = \"hold\"",
                "or --beyond hold",
            ),
            ("`plot = true`", "plot = true", "--plot"),
            (
                "`return_period_years`",
                "return_period_years",
                "--return-period",
            ),
            (
                "expected `=`, `dt`",
                "expected `=`, dt",
                "expected `=`, --dt",
            ),
            (
                "a lone ` before `dt`",
                "a lone ` before dt",
                "a lone ` before --dt",
            ),
            ("none", "none", "none"),
        ] {
            assert_eq!(
                (KeyStyle::File.shown(message), KeyStyle::Flag.shown(message)),
                (file.to_owned(), flag.to_owned())
            );
        }
    }
}
