//! Resolves `[assessment]`, `[worlds]` and `[restraint]`.

use freestand::code_spectrum::CodeSpectrum;
use freestand::code_spectrum::part_forces::LEAST_BUILDING_DUCTILITY_RATIO;
use freestand::decision::Looks;

use super::{Resolver, line, or, stated};
use crate::options::{ACCEPTED_KEYS, AssessmentOptions, RestraintOptions, WorldOptions};
use crate::study::assessment::{
    Accepted, Bracket, Dimensions, MEASURED_PERIOD_SPREAD, Questions, RestraintSettings, Settings,
    Spread, WallUse, WorldSettings,
};
use crate::study::{Ground, StudyDoubt};
use crate::target::Target;
use freestand_input::file::check_allowed;
use freestand_input::keys::Words;
use freestand_input::quantity::shorten;
use freestand_input::toml_reader::Written;

/// Most worlds of an object: the interval of a probability of 1 in 1000 is then settled.
const MAX_WORLDS: u64 = 100_000;

/// Which values are accepted, and how they are called.
type Limits = (fn(f64) -> bool, &'static str);

const PROBABILITY: Limits = (
    |value| value > 0.0 && value < 1.0,
    "a probability between 0 and 1",
);
/// With a spread above 1 a value is practically unknown, and its draws leave the range of the
/// models.
const SPREAD: Limits = (is_share, "a number from 0 to 1");
const CORRELATION: Limits = (is_share, "a correlation from 0 to 1");
const COMPONENT_RATIO: Limits = (is_positive_share, "above 0, at most 1");
const SHARE: Limits = (is_positive_share, "a share above 0, at most 1");
const DAMPING: Limits = (is_positive_share, "a damping ratio above 0, at most 1");
const CONFIDENCE: Limits = (|value| value > 0.5 && value < 1.0, "above 0.5 and below 1");
const FACTOR: Limits = (
    |value| value > 0.0 && value <= 10.0,
    "a factor above 0, at most 10",
);
const FRICTION: Limits = (
    |value| (0.0..=10.0).contains(&value),
    "a coefficient of friction from 0 to 10",
);
const PAD_STRAIN: Limits = (
    PROBABILITY.0,
    "a share of the pad's thickness, above 0 and below 1",
);

fn is_share(value: f64) -> bool {
    (0.0..=1.0).contains(&value)
}

fn is_positive_share(value: f64) -> bool {
    value > 0.0 && value <= 1.0
}

/// The value of a key within its limits, or its default. The key has the name of its field.
macro_rules! checked {
    ($resolver:ident, $written:ident.$key:ident, $default:expr, $limits:expr) => {
        $resolver.checked(stringify!($key), &$written.$key, $default, $limits)
    };
}

impl Resolver<'_> {
    pub(super) fn assessment(
        &mut self,
        written: &AssessmentOptions,
        worlds: &WorldOptions,
        restraint: &RestraintOptions,
        period_is_measured: bool,
        ground: Option<&Ground>,
    ) -> Settings {
        let defaults = Settings::default();
        for (key, line) in &written.of_worlds {
            let (message, hint) = match *key {
                "draws" | "most_draws" | "screen" | "worlds" => {
                    let hint = "set first and most, the numbers of worlds, in the table [worlds]";
                    (format!("{key} is no key of [assessment]"), hint.to_owned())
                }
                key => {
                    let message =
                        format!("{key} belongs in the table [worlds], not in [assessment]");
                    (message, format!("write {key} in the table [worlds]"))
                }
            };
            self.note(Some(*line), message, hint);
        }

        let files = [
            &written.inventory,
            &written.library,
            &written.cushion_library,
        ];
        let keys = ["inventory", "library", "cushion_library"];
        let mut paths = files.map(|written| {
            written
                .as_ref()
                .map(|written| self.base_dir.join(&written.value))
        });
        for ((path, written), key) in paths.iter().zip(files).zip(keys) {
            // These are read later, or not at all where a flag names another: refused here with their line.
            if let (Some(path), Some(written)) = (path, written)
                && let Err(problem) = check_allowed(path)
            {
                self.fault(Some(written.line), key, problem);
            }
        }
        let [inventory, library, cushion_library] = paths.each_mut().map(Option::take);
        Settings {
            inventory,
            sheet: stated(&written.sheet),
            library,
            cushion_library,
            accepted: self.accepted(written, defaults.accepted),
            questions: self.named("questions", &written.questions, &Questions::ALL),
            is_annual: or(&written.annual, defaults.is_annual),
            seed: or(&written.seed, defaults.seed),
            worlds: self.worlds(worlds, defaults.worlds, period_is_measured),
            spread: Spread {
                restitution: checked!(
                    self,
                    written.restitution_spread,
                    defaults.spread.restitution,
                    SPREAD
                ),
                stiffness: checked!(
                    self,
                    written.stiffness_spread,
                    defaults.spread.stiffness,
                    SPREAD
                ),
                mass: checked!(self, written.mass_spread, defaults.spread.mass, SPREAD),
                geometry: checked!(
                    self,
                    written.geometry_spread,
                    defaults.spread.geometry,
                    SPREAD
                ),
                model: checked!(self, written.model_spread, defaults.spread.model, SPREAD),
                compliant: checked!(
                    self,
                    written.compliant_spread,
                    defaults.spread.compliant,
                    SPREAD
                ),
            },
            pad_damping_ratio: self.pad_damping(written, defaults.pad_damping_ratio),
            compliant_factor: checked!(
                self,
                written.compliant_factor,
                defaults.compliant_factor,
                FACTOR
            ),
            friction_ratio: self.friction(written, defaults.friction_ratio),
            pad_strain_ratio: checked!(
                self,
                written.pad_strain,
                defaults.pad_strain_ratio,
                PAD_STRAIN
            ),
            compliant: or(&written.compliant, defaults.compliant),
            walls: self
                .named("walls", &written.walls, &WallUse::ALL)
                .unwrap_or(defaults.walls),
            dimensions: self
                .named("dimensions", &written.dimensions, &Dimensions::ALL)
                .unwrap_or(defaults.dimensions),
            pages: usize::try_from(or(&written.pages, defaults.pages as u64)).unwrap_or(usize::MAX),
            restraint: self.restraint(restraint, defaults.restraint),
            restraint_code: self.restraint_code(&restraint.code, ground),
        }
    }

    /// `accepted` alone counts for every object; a probability of a rating counts for that rating,
    /// and one of a high rating also for the milder ratings, where it is the larger.
    fn accepted(&mut self, written: &AssessmentOptions, defaults: Accepted) -> Accepted {
        let base = match &written.accepted {
            Some(_) => Accepted::all(checked!(
                self,
                written.accepted,
                defaults.other_ratio,
                PROBABILITY
            )),
            None => defaults,
        };
        let mut ratios = [
            base.life_safety_ratio,
            base.function_ratio,
            base.property_ratio,
        ];
        for ((ratios, keys), written) in ratios
            .iter_mut()
            .zip(ACCEPTED_KEYS)
            .zip(&written.accepted_by_rating)
        {
            let mut stricter: f64 = 0.0;
            for ((ratio, key), written) in ratios.iter_mut().zip(keys).zip(written) {
                *ratio = self.checked(key, written, ratio.max(stricter), PROBABILITY);
                stricter = *ratio;
            }
        }
        let [life_safety_ratio, function_ratio, property_ratio] = ratios;
        Accepted {
            life_safety_ratio,
            function_ratio,
            property_ratio,
            ..base
        }
    }

    fn worlds(
        &mut self,
        written: &WorldOptions,
        defaults: WorldSettings,
        period_is_measured: bool,
    ) -> WorldSettings {
        let period_spread = if period_is_measured {
            MEASURED_PERIOD_SPREAD
        } else {
            defaults.period_spread
        };
        let component_ratio = checked!(
            self,
            written.component_ratio,
            defaults.component_ratio,
            COMPONENT_RATIO
        );
        let component_correlation = checked!(
            self,
            written.component_correlation,
            defaults.component_correlation,
            CORRELATION
        );
        self.require(
            &written.components,
            |count| count == 1 || count == 2,
            "components",
            "1 or 2",
        );
        let confidence = checked!(
            self,
            written.confidence,
            defaults.looks.confidence(),
            CONFIDENCE
        );
        for (key, count) in [("first", &written.first), ("most", &written.most)] {
            let expected = format!("a whole number from 1 to {MAX_WORLDS}");
            self.require(
                count,
                |count| (1..=MAX_WORLDS).contains(&count),
                key,
                &expected,
            );
        }
        let count = |written: &Option<Written<u64>>, default: u32| {
            u32::try_from(or(written, u64::from(default)))
                .unwrap_or(default)
                .clamp(1, MAX_WORLDS as u32)
        };
        let (first, most) = (
            count(&written.first, defaults.looks.first()),
            count(&written.most, defaults.looks.most()),
        );
        if first > most {
            let line = line(&written.first).or(line(&written.most));
            let message = format!("first = {first} is more than most = {most}");
            self.note(
                line,
                message,
                "give both: the number of worlds is doubled from first until it reaches most",
            );
        }
        WorldSettings {
            spectral_spread: checked!(
                self,
                written.spectral_spread,
                defaults.spectral_spread,
                SPREAD
            ),
            intensity_spread: checked!(
                self,
                written.intensity_spread,
                defaults.intensity_spread,
                SPREAD
            ),
            component_correlation,
            component_ratio,
            components: count(&written.components, defaults.components),
            period_spread: checked!(self, written.period_spread, period_spread, SPREAD),
            damping_spread: checked!(
                self,
                written.damping_spread,
                defaults.damping_spread,
                SPREAD
            ),
            // What it refuses was told above.
            looks: Looks::new(first, most, confidence).unwrap_or_default(),
            shares: stated(&written.shares),
        }
    }

    fn restraint(
        &mut self,
        written: &RestraintOptions,
        defaults: RestraintSettings,
    ) -> RestraintSettings {
        let dead_load_ratio = checked!(
            self,
            written.dead_load_ratio,
            defaults.dead_load_ratio,
            SHARE
        );
        let mut factor = |key: &str, written: &Option<Written<f64>>| {
            let accept = |factor| factor > 0.0 && factor <= 20.0;
            self.require(written, accept, key, "a factor above 0, at most 20");
            stated(written)
        };
        let overstrength_ratio = factor("overstrength_ratio", &written.overstrength_ratio);
        let amplification_ratio = factor("amplification_ratio", &written.amplification_ratio);
        let response_ratio = factor("response_ratio", &written.response_ratio);
        let resonance_ratio = factor("resonance_ratio", &written.resonance_ratio);
        let strength_ratio = factor("strength_ratio", &written.strength_ratio);
        let importance_ratio = factor("importance_ratio", &written.importance_ratio);
        self.require(
            &written.building_ductility_ratio,
            |factor| (LEAST_BUILDING_DUCTILITY_RATIO..=20.0).contains(&factor),
            "building_ductility_ratio",
            &format!("a factor from {LEAST_BUILDING_DUCTILITY_RATIO} to 20"),
        );
        self.require(
            &written.bracket_height_m,
            |height| height > 0.0,
            "bracket_height",
            "positive",
        );
        self.require(
            &written.anchor_inset_m,
            |inset| inset >= 0.0,
            "anchor_inset",
            "zero or positive",
        );
        RestraintSettings {
            dead_load_ratio,
            overstrength_ratio,
            amplification_ratio,
            response_ratio,
            resonance_ratio,
            strength_ratio,
            building_ductility_ratio: stated(&written.building_ductility_ratio),
            importance_ratio,
            bracket_height_m: stated(&written.bracket_height_m),
            anchor_inset_m: stated(&written.anchor_inset_m),
            bracket: self
                .named("bracket", &written.bracket, &Bracket::ALL)
                .unwrap_or(defaults.bracket),
        }
    }

    /// The code of the forces, for motions that are by no code.
    fn restraint_code(&mut self, written: &Words, ground: Option<&Ground>) -> Option<Target> {
        let first = written.lines().find_map(|(_, line)| line);
        if written.is_empty() {
            return None;
        }
        let of_motions = ground
            .and_then(Ground::code_spectrum)
            .map(|target| &target.spectrum);
        if let Some(spectrum) =
            of_motions.filter(|spectrum| !matches!(spectrum, CodeSpectrum::Table(_)))
        {
            let message = format!(
                "[restraint] names a code, but the motions are by {} already",
                spectrum.name()
            );
            self.note(
                first,
                message,
                "leave it out: the forces of restraints are by the code of [ground]",
            );
            return None;
        }
        match Target::for_parts(written) {
            Ok(target) => {
                let doubts = target.doubts.iter().cloned();
                self.doubts.extend(doubts.map(StudyDoubt::Restraint));
                Some(target)
            }
            Err(problems) => {
                for problem in problems {
                    let line = written.line_of(&problem.keys).or(first);
                    self.fault(line, "restraint", problem);
                }
                None
            }
        }
    }

    /// A value within its limits, or its default.
    fn checked(
        &mut self,
        key: &str,
        written: &Option<Written<f64>>,
        default: f64,
        (accept, expected): Limits,
    ) -> f64 {
        self.require(written, accept, key, expected);
        or(written, default)
    }

    /// The ends of a range, in their order.
    fn range(
        &mut self,
        [low, high]: [(&str, &Option<Written<f64>>); 2],
        default: (f64, f64),
    ) -> (f64, f64) {
        let range = (or(low.1, default.0), or(high.1, default.1));
        if range.0 > range.1 {
            let message = format!("{} = {} is above {} = {}", low.0, range.0, high.0, range.1);
            self.note(
                line(low.1).or(line(high.1)),
                message,
                "give both: one that is left out has its default value",
            );
        }
        range
    }

    /// `pad_damping` sets both ends of the range.
    fn pad_damping(&mut self, written: &AssessmentOptions, default: (f64, f64)) -> (f64, f64) {
        let both = ("pad_damping", &written.pad_damping);
        let ends = [
            ("pad_damping_low", &written.pad_damping_low),
            ("pad_damping_high", &written.pad_damping_high),
        ];
        for (key, one) in [both, ends[0], ends[1]] {
            self.require(one, DAMPING.0, key, DAMPING.1);
        }
        for end in ends {
            self.exclusive(both, end);
        }
        let default = stated(both.1).map_or(default, |both| (both, both));
        self.range(ends, default)
    }

    fn friction(&mut self, written: &AssessmentOptions, default: (f64, f64)) -> (f64, f64) {
        let ends = [
            ("friction_low", &written.friction_low),
            ("friction_high", &written.friction_high),
        ];
        for (key, one) in ends {
            self.require(one, FRICTION.0, key, FRICTION.1);
        }
        self.range(ends, default)
    }

    /// One of some names.
    fn named<T: Copy>(
        &mut self,
        key: &str,
        written: &Option<Written<String>>,
        all: &[(&str, T)],
    ) -> Option<T> {
        let Written { value, line } = written.as_ref()?;
        let found = all
            .iter()
            .find(|(name, _)| value.trim().eq_ignore_ascii_case(name));
        if found.is_none() {
            let names: Vec<String> = all.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            let message = format!(
                "{key} must be {}, not \"{}\"",
                names.join(" or "),
                shorten(value)
            );
            self.note(
                Some(*line),
                message,
                format!("write {key} = {}", names.first().map_or("", String::as_str)),
            );
        }
        found.map(|(_, value)| *value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resolve::{Overrides, builtin, resolve};

    /// What the built-in study says in words is what a study has that says nothing.
    #[test]
    fn the_built_in_study_states_the_defaults() {
        assert_eq!(
            builtin(&Overrides::default()).unwrap().assessment,
            Settings::default()
        );
        assert_eq!(
            resolve("[assessment]\n", None, "".as_ref())
                .unwrap()
                .assessment,
            Settings::default()
        );
    }

    #[test]
    fn what_is_accepted_counts_for_every_class_that_is_not_named() {
        let text = "[assessment]\naccepted = \"5 %\"\naccepted_life_safety = 0.01\naccepted_function = \"8 %\"\n\
                    inventory = \"a/b.csv\"\n";
        let settings = resolve(text, None, "here".as_ref()).unwrap().assessment;
        let expected = Accepted {
            life_safety_ratio: [0.01, 0.05, 0.05],
            // A milder rating is never stricter.
            function_ratio: [0.08; 3],
            ..Accepted::all(0.05)
        };
        assert_eq!(settings.accepted, expected);
        assert_eq!(settings.inventory, Some("here/a/b.csv".into()));
        let one = resolve(
            "[assessment]\naccepted_life_safety_medium = 0.03\n",
            None,
            "".as_ref(),
        )
        .unwrap()
        .assessment;
        assert_eq!(one.accepted.life_safety_ratio, [0.02, 0.03, 0.20]);
    }

    #[test]
    fn everything_that_is_wrong_is_said_with_its_line() {
        let text = "[assessment]\naccepted = 1.5\ndraws = 8\nscreen = true\nmass_spread = -1\nfriction_low = 0.9\n\
                    pad_strain = 2\nscren = true\npad_damping = 0\nquestions = \"shock\"\n[worlds]\nfirst = 2000\n\
                    spectral_spread = 3\ncomponents = 3\nconfidence = 1\n[restraint]\nbracket = \"soft\"\n\
                    dead_load_ratio = 1.2\n";
        let problems = resolve(text, None, "".as_ref()).unwrap_err().problems;
        let mut lines: Vec<Option<usize>> = problems.iter().map(|problem| problem.line).collect();
        lines.sort_unstable();
        let expected = [2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 13, 14, 15, 17, 18];
        assert_eq!(lines, expected.map(Some), "{problems:?}");
    }

    #[test]
    fn keys_of_worlds_are_pointed_to_their_table() {
        let problems = resolve(
            "[assessment]\nworlds = 30\nconfidence = 0.9\n",
            None,
            "".as_ref(),
        )
        .unwrap_err()
        .problems;
        let said: Vec<&str> = problems
            .iter()
            .filter_map(|problem| problem.hint.as_deref())
            .collect();
        assert!(
            said.iter().any(|hint| hint.contains("set first and most")),
            "{problems:?}"
        );
        assert!(
            said.contains(&"write confidence in the table [worlds]"),
            "{problems:?}"
        );
        // All keys of the table.
        let worlds = resolve("[worlds]\nno_such = 1\n", None, "".as_ref())
            .unwrap_err()
            .problems;
        let known = worlds[0].hint.clone().unwrap_or_default();
        for key in known.trim_start_matches("known: ").split(", ") {
            let problems = resolve(&format!("[assessment]\n{key} = 1\n"), None, "".as_ref())
                .unwrap_err()
                .problems;
            assert!(
                problems[0]
                    .message
                    .contains("belongs in the table [worlds]"),
                "{key}: {problems:?}"
            );
        }
    }

    /// The motions of floors are by no code: [restraint] names the one of the forces.
    #[test]
    fn the_code_of_restraints_stands_where_the_motions_have_none() {
        let study = |ground: &str, restraint: &str| {
            resolve(
                &format!("{ground}[restraint]\n{restraint}"),
                None,
                "".as_ref(),
            )
        };
        let table = "[ground]\ncode = \"table\"\nspectrum = \"gone.csv\"\n";
        let problems = study("", "code = \"asce7\"\nsds = \"1 g\"\n")
            .unwrap_err()
            .problems;
        assert!(
            problems[0].message.contains("the motions are by AS 1170.4"),
            "{problems:?}"
        );
        assert_eq!(problems[0].line, Some(2));
        // The table of the ground is missing too.
        let problems = study(
            table,
            "code = \"asce7\"\nsds = \"-1 g\"\nbuilding_ductility_ratio = 1\n",
        )
        .unwrap_err();
        let lines: Vec<Option<usize>> = problems
            .problems
            .iter()
            .map(|problem| problem.line)
            .collect();
        assert_eq!(lines, [Some(3), Some(6), Some(7)], "{problems:?}");
        let problems = study(table, "sds = \"1 g\"\n").unwrap_err().to_string();
        assert!(
            problems.contains("sds needs a code or a place"),
            "{problems}"
        );
    }

    #[test]
    fn walls_count_as_listed_or_not_at_all() {
        let walls =
            |text: &str| resolve(text, None, "".as_ref()).map(|study| study.assessment.walls);
        assert_eq!(
            walls("[assessment]\nwalls = \"as-listed\"\n").unwrap(),
            WallUse::AsListed
        );
        assert_eq!(
            walls("[assessment]\nwalls = \"ignore\"\n").unwrap(),
            WallUse::Ignore
        );
        let problems = walls("[assessment]\nwalls = \"none\"\n")
            .unwrap_err()
            .problems;
        assert_eq!(problems[0].line, Some(2));
        assert!(problems[0].to_string().contains("ignore"), "{problems:?}");
    }

    #[test]
    fn objects_move_in_a_plane_or_in_three_dimensions() {
        let dimensions =
            |text: &str| resolve(text, None, "".as_ref()).map(|study| study.assessment.dimensions);
        assert_eq!(dimensions("[assessment]\n").unwrap(), Dimensions::Planar);
        assert_eq!(
            dimensions("[assessment]\ndimensions = \"planar\"\n").unwrap(),
            Dimensions::Planar
        );
        assert_eq!(
            dimensions("[assessment]\ndimensions = \"3d\"\n").unwrap(),
            Dimensions::Three
        );
        let problems = dimensions("[assessment]\ndimensions = \"3\"\n")
            .unwrap_err()
            .problems;
        assert_eq!(problems[0].line, Some(2));
        assert!(problems[0].to_string().contains("planar"), "{problems:?}");
    }

    #[test]
    fn one_damping_sets_both_ends_of_its_range() {
        let damping = |text: &str| {
            resolve(text, None, "".as_ref())
                .unwrap()
                .assessment
                .pad_damping_ratio
        };
        assert_eq!(damping("[assessment]\npad_damping = 0.1\n"), (0.1, 0.1));
        assert_eq!(
            damping("[assessment]\npad_damping_high = 0.3\n"),
            (0.05, 0.3)
        );
    }
}
