//! `point_source` of `[ground]` as meant.

use freestand::code_spectrum::SiteClass;
use freestand::synthesis::PAIR_MAGNITUDES;

use super::{MAX_MOTIONS, Overrides, Resolver, or};
use crate::options::{GroundOptions, PointSourceOptions};
use crate::simulated::{Earthquakes, SimulatedRequest, SourceInput, SourceProblem, SourceWords, find_earthquakes};
use crate::study::SimulatedGround;
use crate::target::Target;

/// Where nothing is said: the rock that the source's motions are for, as in `motion simulate`.
const SITE: SiteClass = SiteClass::Be;

impl Resolver<'_> {
    pub(super) fn simulated(
        &mut self,
        written: &GroundOptions,
        source: &PointSourceOptions,
        overrides: &Overrides,
    ) -> Option<SimulatedGround> {
        let before = self.problems.len();
        let pairs = or(&source.pairs, false);
        let mut words = SourceWords::default();
        for (key, text) in &source.words {
            words.set(key, text.value.clone());
        }
        let input =
            words.resolve().map_err(|all| all.into_iter().for_each(|one| self.source_problem(source, one))).ok();
        let hazard = if pairs { self.hazard(written) } else { None };
        let site = if pairs { None } else { self.site_of_one(written) };
        let each = input.map_or(1, |input| if pairs && input.magnitude.is_none() { PAIR_MAGNITUDES.len() } else { 1 });
        let count = self.count_of_each(written, each as u64);
        let earthquakes = input.and_then(|input| self.earthquakes((written, source), &input, hazard.as_ref(), pairs));
        // Distances that are looked for without what was refused would be those of another study.
        if written.is_incomplete || self.problems.len() > before {
            return None;
        }
        let SourceInput { preset, changes, options, .. } = input?;
        let site = hazard.as_ref().map_or(site, |target| SiteClass::parse(target.spectrum.site_name()?).ok());
        let seed = overrides.seed.unwrap_or(or(&written.seed, 1));
        let request = SimulatedRequest {
            preset,
            changes,
            earthquakes: earthquakes?,
            site: site.unwrap_or(SITE),
            count,
            seed,
            options,
        };
        let earthquakes = find_earthquakes(&request).map_err(|problem| self.source_problem(source, problem)).ok()?;
        self.warnings.extend(hazard.iter().flat_map(|target| target.warnings.iter().cloned()));
        self.warnings.extend(request.limits(&earthquakes));
        self.warnings.extend(request.assumptions());
        Some(SimulatedGround { request, earthquakes, hazard })
    }

    fn source_problem(&mut self, source: &PointSourceOptions, SourceProblem { key, problem }: SourceProblem) {
        let line = source.words.iter().find(|(name, _)| Some(*name) == key).map_or(source.line, |(_, text)| text.line);
        self.note(Some(line), problem.message, problem.hint.unwrap_or_default());
    }

    fn earthquakes(
        &mut self,
        (written, source): (&GroundOptions, &PointSourceOptions),
        input: &SourceInput,
        hazard: Option<&Target>,
        pairs: bool,
    ) -> Option<Earthquakes> {
        if pairs {
            if let Some((_, distance)) = source.words.iter().find(|(key, _)| *key == "distance") {
                let hint = "leave it out: it is looked for; or leave pairs out";
                self.note(Some(distance.line), "distance and pairs exclude each other", hint);
            }
            let kpz_g = hazard?.kpz_g()?;
            return Some(Earthquakes::Pairs { kpz_g, magnitudes: input.magnitude.into_iter().collect() });
        }
        for (key, missing) in [("magnitude", input.magnitude.is_none()), ("distance", input.distance_m.is_none())] {
            if missing && !written.is_incomplete {
                let hint = "write point_source = { magnitude = 6.0, distance = \"30 km\" }, or { pairs = true }";
                self.note(Some(source.line), format!("point_source needs {key}"), hint);
            }
        }
        Some(Earthquakes::One { magnitude: input.magnitude?, distance_m: input.distance_m? })
    }

    /// The code's spectrum whose rock spectrum the earthquakes are to meet.
    fn hazard(&mut self, written: &GroundOptions) -> Option<Target> {
        let mut at_site = written.clone();
        if !at_site.target.iter().any(|(key, _)| *key == "site") {
            let site = freestand_input::toml_reader::Written { value: SITE.name().to_owned(), line: 0 };
            at_site.target.push(("site", site));
        }
        let other = |key: &str, value: &str| key == "spectrum" || (key == "code" && !is_as1170_4(value));
        if let Some((key, text)) = written.target.iter().find(|(key, text)| other(key, &text.value)) {
            let hint = "take another code for synthetic or matched motions, or a magnitude and a distance";
            self.note(Some(text.line), format!("{key}: pairs are looked for by AS 1170.4 only"), hint);
            return None;
        }
        self.target(&at_site)
    }

    /// Of what describes a spectrum, one earthquake takes the ground at the site alone.
    fn site_of_one(&mut self, written: &GroundOptions) -> Option<SiteClass> {
        let mut site = Some(SITE);
        for (key, text) in &written.target {
            if *key == "site" {
                site = SiteClass::parse(&text.value).ok();
                if site.is_none() {
                    let message = format!(
                        "site \"{}\" is not a class of AS 1170.4",
                        freestand_input::quantity::shorten(&text.value)
                    );
                    self.note(Some(text.line), message, "Ae, Be, Ce, De or Ee; left out, Be: rock");
                }
            } else {
                let hint = format!("leave {key} out, or look for earthquakes with pairs = true in place of a distance");
                let message = format!("{key} goes with pairs = true: one magnitude and distance need no code");
                self.note(Some(text.line), message, hint);
            }
        }
        site
    }

    /// Motions of each earthquake.
    fn count_of_each(&mut self, written: &GroundOptions, earthquakes: u64) -> u64 {
        let count = or(&written.count, 10);
        let most = MAX_MOTIONS / earthquakes;
        if !(1..=most).contains(&count) {
            let line = written.count.as_ref().map(|count| count.line);
            let what = if earthquakes == 1 { "" } else { ", the motions of each of four earthquakes," };
            let message = format!("count{what} must be a whole number from 1 to {most}, not {count}");
            self.note(line, message, format!("give count as a whole number from 1 to {most}"));
        }
        count.clamp(1, most)
    }
}

fn is_as1170_4(code: &str) -> bool {
    code.to_lowercase().replace([' ', '-', '_'], "").starts_with("as1170")
}
