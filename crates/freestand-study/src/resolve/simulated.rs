//! Resolves `point_source` of `[ground]`.

use freestand::code_spectrum::SiteClass;
use freestand::synthesis::PAIR_MAGNITUDES;

use super::{MAX_MOTIONS, Overrides, Resolver, line, or};
use crate::options::{GroundOptions, PointSourceOptions};
use crate::simulated::{
    DEFAULT_SITE, Earthquakes, SimulatedRequest, SourceInput, find_earthquakes, read_source,
};
use crate::study::{DEFAULT_MOTIONS, DEFAULT_SEED, SimulatedGround, StudyDoubt};
use crate::target::{Target, key_of_other_code};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

impl Resolver<'_> {
    pub(super) fn simulated(
        &mut self,
        written: &GroundOptions,
        source: &PointSourceOptions,
        overrides: &Overrides,
    ) -> Option<SimulatedGround> {
        let before = self.problems.len();
        let pairs = or(&source.pairs, false);
        let input = read_source(&source.words)
            .map_err(|problems| {
                problems
                    .into_iter()
                    .for_each(|problem| self.source_fault(source, problem))
            })
            .ok();
        let (hazard, site) = if pairs {
            (self.hazard(written), None)
        } else {
            (None, self.site_of_one(written))
        };
        let searches_all = input.is_some_and(|input| pairs && input.magnitude.is_none());
        let each = if searches_all {
            PAIR_MAGNITUDES.len()
        } else {
            1
        };
        let count = self.count_of_each(written, each as u64);
        let earthquakes = input
            .and_then(|input| self.earthquakes((written, source), &input, hazard.as_ref(), pairs));
        // Distances found without the keys that were refused would belong to another study.
        if written.is_incomplete || self.problems.len() > before {
            return None;
        }
        let SourceInput {
            preset,
            changes,
            options,
            ..
        } = input?;
        let site = hazard.as_ref().map_or(site, Target::site_class);
        let seed = overrides.seed.unwrap_or(or(&written.seed, DEFAULT_SEED));
        let request = SimulatedRequest {
            preset,
            changes,
            earthquakes: earthquakes?,
            site: site.unwrap_or(DEFAULT_SITE),
            count,
            seed,
            options,
        };
        let earthquakes = find_earthquakes(&request)
            .map_err(|problem| self.source_fault(source, problem))
            .ok()?;
        if let Some(target) = &hazard {
            self.doubt_target(target);
        }
        let limits = request.limits(&earthquakes).into_iter();
        self.doubts.extend(limits.map(StudyDoubt::OutsideLimits));
        let assumptions = request.assumptions().into_iter();
        self.doubts.extend(assumptions.map(StudyDoubt::Simulated));
        Some(SimulatedGround {
            request,
            earthquakes,
            hazard,
        })
    }

    fn source_fault(&mut self, source: &PointSourceOptions, problem: Problem) {
        let line = source.words.line_of(&problem.keys).unwrap_or(source.line);
        self.fault(Some(line), "point_source", problem);
    }

    fn earthquakes(
        &mut self,
        (written, source): (&GroundOptions, &PointSourceOptions),
        input: &SourceInput,
        hazard: Option<&Target>,
        pairs: bool,
    ) -> Option<Earthquakes> {
        if pairs {
            if let Some(line) = source.words.line_of(&["distance"]) {
                let hint = "leave distance out: it is searched for; or leave pairs out";
                self.note(Some(line), "distance and pairs exclude each other", hint);
            }
            let kpz_g = hazard?.kpz_g()?;
            return Some(Earthquakes::Pairs {
                kpz_g,
                magnitudes: input.magnitude.into_iter().collect(),
            });
        }
        for (key, missing) in [
            ("magnitude", input.magnitude.is_none()),
            ("distance", input.distance_m.is_none()),
        ] {
            if missing && !written.is_incomplete {
                let hint = "write point_source = { magnitude = 6.0, distance = \"30 km\" }, or { pairs = true }";
                self.note(Some(source.line), format!("point_source needs {key}"), hint);
            }
        }
        Some(Earthquakes::One {
            magnitude: input.magnitude?,
            distance_m: input.distance_m?,
        })
    }

    /// The code spectrum, whose rock spectrum the earthquakes are to fit.
    fn hazard(&mut self, written: &GroundOptions) -> Option<Target> {
        let mut at_site = written.clone();
        if at_site.target.get("site").is_none() {
            at_site.target.set("site", DEFAULT_SITE.name());
        }
        if let Some(key) = key_of_other_code(&written.target) {
            let hint =
                format!("leave {key} out: other spectra are for synthetic or matched motions");
            let message =
                format!("{key}: pairs = true searches for earthquakes that fit AS 1170.4 only");
            self.note(written.target.line_of(&[key]), message, hint);
            return None;
        }
        self.target(&at_site)
    }

    /// The ground at the site of one earthquake, which needs no spectrum.
    fn site_of_one(&mut self, written: &GroundOptions) -> Option<SiteClass> {
        let mut site = Some(DEFAULT_SITE);
        for (key, text) in written.target.entries() {
            let line = written.target.line_of(&[key]);
            if key == "site" {
                site = SiteClass::parse(text).ok();
                if site.is_none() {
                    let message = format!("site \"{}\" is not a class of AS 1170.4", shorten(text));
                    self.note(
                        line,
                        message,
                        "use Ae, Be, Ce, De or Ee; without site, Be (rock) is used",
                    );
                }
            } else {
                let hint = format!(
                    "leave {key} out, or search for earthquakes with pairs = true instead of a distance"
                );
                let message = format!(
                    "{key} needs pairs = true: a given magnitude and distance need no code"
                );
                self.note(line, message, hint);
            }
        }
        site
    }

    /// The number of motions of each earthquake.
    fn count_of_each(&mut self, written: &GroundOptions, earthquakes: u64) -> u64 {
        let count = or(&written.count, DEFAULT_MOTIONS);
        let most = MAX_MOTIONS / earthquakes;
        if !(1..=most).contains(&count) {
            let line = line(&written.count);
            let what = if earthquakes == 1 {
                ""
            } else {
                ", the motions of each of four earthquakes,"
            };
            let message =
                format!("count{what} must be a whole number from 1 to {most}, not {count}");
            self.note(
                line,
                message,
                format!("give count as a whole number from 1 to {most}"),
            );
        }
        count.clamp(1, most)
    }
}
