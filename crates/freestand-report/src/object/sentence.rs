//! The answer about one object: one sentence, and its kind.

use freestand_input::quantity::UnitSystem;
use freestand_input::words::{number, percent_significant};

use crate::assessment::compared::reach;
use crate::assessment::words::too_mild;
use freestand_assess::one_object::NamedEarthquake;
use freestand_assess::result::{Probability, Rolled, TooMild};

/// What the answer says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr, strum::VariantArray)]
#[strum(serialize_all = "kebab-case")]
pub enum AnswerKind {
    /// Nothing that was tried lifts an edge.
    DoesNotRock,
    /// It is on free casters: it rolls, and no stop overturns it.
    Rolls,
    /// It has little friction: it slides, and no stop overturns it.
    Slides,
    /// Something lifts an edge, nothing overturns it.
    Rocks,
    /// It is overturned, at most as often as is accepted.
    ProbablyStands,
    /// It is overturned more often than is accepted, and perhaps less often than not.
    MayFall,
    /// It is certain to be overturned more often than not: the interval lies above one half, or all given
    /// motions overturn it.
    Falls,
}

impl AnswerKind {
    /// The kind that belongs to these counts; `probability`: that it is overturned, `None` where the motions
    /// are given and are all there is.
    pub(super) fn of(
        counts: &Counts,
        accepted_ratio: f64,
        probability: Option<Probability>,
    ) -> Self {
        let share = f64::from(counts.overturned) / f64::from(counts.asked.max(1));
        let falls = probability.map_or(counts.overturned == counts.asked, |p| p.low > 0.5);
        match (counts.overturned, counts.lifted) {
            // It may fall where its calculation lets it stand.
            (0, _) if counts.too_mild.is_some() => Self::MayFall,
            (0, _) if counts.rolled.is_some() && counts.slides => Self::Slides,
            (0, _) if counts.rolled.is_some() => Self::Rolls,
            (0, 0) => Self::DoesNotRock,
            (0, _) => Self::Rocks,
            _ if counts.too_mild.is_some() && share < 0.5 => Self::MayFall,
            _ if share <= accepted_ratio => Self::ProbablyStands,
            _ if falls => Self::Falls,
            _ => Self::MayFall,
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::DoesNotRock => "does not rock",
            Self::Rolls => "rolls and stays standing",
            Self::Slides => "slides and stays standing",
            Self::Rocks => "stays standing",
            Self::ProbablyStands => "will probably stay standing",
            Self::MayFall => "may fall over",
            Self::Falls => "falls over",
        }
    }
}

/// The floor that a sentence names.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ToldFloor {
    /// The ground.
    Ground,
    /// The roof.
    Roof,
    /// A floor above the ground by its number.
    Number {
        /// Its number; 1 is the first above the ground.
        floor: u32,
        /// The storeys of the building.
        storeys: usize,
    },
    /// A floor by its name.
    Name(String),
    /// A height over that of the building.
    Share(f64),
}

/// How often, and how much.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Counts {
    /// Simulated earthquakes, or motions.
    pub(super) motions: u32,
    /// Those that lift an edge.
    pub(super) lifted: u32,
    /// Those by the model that decides whether it falls.
    pub(super) asked: u32,
    /// Those of them that overturn it.
    pub(super) overturned: u32,
    /// Those that exceed what it withstands without overturning it; `None`: it has no tolerance.
    pub(super) exceeded: Option<u32>,
    /// Largest uplift without overturning \[m\].
    pub(super) uplift_m_max: Option<f64>,
    /// Largest shock without overturning \[g\].
    pub(super) shock_g_max: Option<f64>,
    /// Largest acceleration of the floor \[g\].
    pub(super) floor_g_max: f64,
    /// Acceleration that lifts an edge \[g\].
    pub(super) lift_g: f64,
    /// Those that leave it leaning on a wall, past its balance point: they count as overturning it.
    pub(super) leaning: u32,
    /// Those in which what stands on it falls first; `None`: nothing stands on it.
    pub(super) upper_falls: Option<u32>,
    /// How it rolls or slides; `None`: it does neither.
    pub(super) rolled: Option<Rolled>,
    /// Whether it slides on its base.
    pub(super) slides: bool,
    /// Whether a wall or a neighbour was named.
    pub(super) has_wall: bool,
    /// Why it may fall where the counts let it stand.
    pub(super) too_mild: Option<TooMild>,
}

/// What an object withstands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Withstands {
    /// Peak acceleration \[g\].
    pub(super) peak_g: f64,
    /// Duration of its half-sine \[s\].
    pub(super) duration_s: Option<f64>,
}

/// Uplifts below 1 mm are not told in digits, as on the page.
const LEAST_UPLIFT_M: f64 = 1e-3;

/// Everything that a sentence says.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Answer {
    pub(super) kind: AnswerKind,
    pub(super) earthquake: NamedEarthquake,
    pub(super) floor: ToldFloor,
    pub(super) counts: Counts,
    /// That it is overturned.
    pub(super) probability: Option<Probability>,
    pub(super) withstands: Option<Withstands>,
    pub(super) units: UnitSystem,
}

impl Answer {
    /// The sentence, on one line.
    pub(super) fn sentence(&self) -> String {
        // Before "does not rock" the floor is set off, because numbers of the floor follow.
        let comma = if self.kind == AnswerKind::DoesNotRock {
            ","
        } else {
            ""
        };
        let evidence = match self.evidence() {
            text if text.is_empty() => text,
            text => format!(": {text}"),
        };
        let (under, kind, leaning, first) = (
            self.under(),
            self.kind_words(),
            self.leaning(),
            self.falls_first(),
        );
        let rest = if self.counts.rolled.is_some() {
            self.rolling()
        } else {
            self.landings()
        };
        format!("{under}{comma} this object {kind}{evidence}{leaning}{first}{rest}.")
    }

    /// What the object does. That nothing lifted an edge is a count, not a promise.
    fn kind_words(&self) -> String {
        let motions = self.counts.motions;
        match (self.kind, &self.earthquake) {
            (AnswerKind::DoesNotRock, NamedEarthquake::Motions) if motions > 1 => {
                "rocks in none of them".to_owned()
            }
            (AnswerKind::DoesNotRock, earthquake) if motions > 1 => {
                format!("rocks in none of {motions} {}", noun(earthquake))
            }
            (kind, _) => kind.words().to_owned(),
        }
    }

    /// `In Melbourne (AS 1170.4, 500 years, site De) on the ground`.
    fn under(&self) -> String {
        let floor = self.floor.words();
        match &self.earthquake {
            NamedEarthquake::Place {
                name,
                is_point,
                code,
                years,
                site,
                is_approximate,
            } => {
                let mut details = vec![code.clone()];
                details.extend(years.map(|years| format!("{years} years")));
                details.extend(site.clone());
                if *is_approximate {
                    details.push("approximate hazard, confirm".to_owned());
                }
                let at = if *is_point { "At" } else { "In" };
                format!("{at} {name} ({}) {floor}", details.join(", "))
            }
            NamedEarthquake::GroundAcceleration { peak_g } => {
                let peak = format!("At a ground acceleration of {} g", number(*peak_g, 4));
                // The ground that accelerates is the floor.
                if self.floor == ToldFloor::Ground {
                    peak
                } else {
                    format!("{peak} {floor}")
                }
            }
            NamedEarthquake::Study {
                study,
                code,
                years,
                site,
            } => {
                let mut details = vec![code.clone()];
                details.extend(years.map(|years| format!("{years} years")));
                details.extend(site.clone());
                let details = details.join(", ");
                format!("Under the earthquake of {study} ({details}) {floor}")
            }
            NamedEarthquake::MotionsOfStudy { motions: 1, study } => {
                format!("Under the motion of {study} {floor}")
            }
            NamedEarthquake::MotionsOfStudy { motions, study } => {
                format!("Under the {motions} motions of {study} {floor}")
            }
            NamedEarthquake::Motions if self.counts.motions == 1 => "Under this motion".to_owned(),
            NamedEarthquake::Motions => format!("Under these {} motions", self.counts.motions),
        }
    }

    /// What shows it.
    fn evidence(&self) -> String {
        let Counts {
            motions,
            lifted,
            asked,
            overturned,
            uplift_m_max,
            floor_g_max,
            lift_g,
            ..
        } = self.counts;
        if let Some(why) = self
            .counts
            .too_mild
            .filter(|_| self.kind == AnswerKind::MayFall)
        {
            let verb = ("overturns", "overturn");
            let counted = match overturned {
                0 if self.earthquake == NamedEarthquake::Motions => "none overturns".to_owned(),
                0 => format!("none of {asked} {} overturns", noun(&self.earthquake)),
                _ => self.count(overturned, asked, verb),
            };
            return format!(
                "it is {}; in that calculation {counted} it, but the real object may fall",
                too_mild(why)
            );
        }
        match self.kind {
            // A peak may pass the threshold on its way to no uplift: across an edge, or on pads.
            AnswerKind::DoesNotRock if floor_g_max >= lift_g => match self.earthquake {
                NamedEarthquake::Motions if motions == 1 => "it lifts no edge".to_owned(),
                _ if motions == 1 => format!(
                    "the one {} lifts no edge",
                    noun(&self.earthquake).trim_end_matches('s')
                ),
                _ => "none lifts an edge".to_owned(),
            },
            AnswerKind::DoesNotRock => {
                let (floor, lift) = apart(floor_g_max, lift_g);
                let at_most = if motions == 1 { "" } else { " at most" };
                format!(
                    "the floor reaches {floor} g{at_most} and it takes {lift} g to lift an edge"
                )
            }
            AnswerKind::Rocks => {
                let at_most = if lifted == 1 { "" } else { " at most" };
                let by = match uplift_m_max {
                    None => String::new(),
                    // An edge that barely lets go of its pad: digits would only pretend to know how much.
                    Some(uplift_m) if uplift_m < LEAST_UPLIFT_M => {
                        format!(", by less than {}", self.units.distance(LEAST_UPLIFT_M, 1))
                    }
                    Some(uplift_m) => {
                        format!(
                            ", by {}{at_most}",
                            self.units
                                .distance(uplift_m, if uplift_m < 0.1 { 2 } else { 3 })
                        )
                    }
                };
                // With what it withstands, the landings follow.
                let none = if self.withstands.is_some() {
                    ""
                } else {
                    ", and none overturns it"
                };
                match self.earthquake {
                    NamedEarthquake::Motions if motions == 1 => format!("it lifts an edge{by}"),
                    _ => format!(
                        "{} an edge{by}{none}",
                        self.count(lifted, motions, ("lifts", "lift"))
                    ),
                }
            }
            AnswerKind::Rolls | AnswerKind::Slides => String::new(),
            AnswerKind::Falls if motions == 1 && self.earthquake == NamedEarthquake::Motions => {
                String::new()
            }
            AnswerKind::ProbablyStands | AnswerKind::MayFall | AnswerKind::Falls => {
                let counted = self.count(overturned, asked, ("overturns", "overturn"));
                // Few motions are all there is to say; all is all.
                let interval = self
                    .probability
                    .filter(|_| self.earthquake != NamedEarthquake::Motions && overturned < asked);
                let interval = interval.map_or_else(String::new, |p| {
                    let [low, high] = [p.low, p.high].map(|end| percent_significant(end, 2));
                    let low = low.trim_end_matches(" %");
                    format!(
                        " ({}, between {low} and {high})",
                        percent_significant(p.value, 2)
                    )
                });
                format!("{counted} it{interval}")
            }
        }
    }

    /// `9 of 320 simulated earthquakes overturn`, `all 20 simulated earthquakes overturn`, `4 lift`.
    fn count(&self, hits: u32, of: u32, (one, many): (&str, &str)) -> String {
        let noun = noun(&self.earthquake);
        let verb = if hits == 1 { one } else { many };
        match &self.earthquake {
            NamedEarthquake::Motions if hits == of => format!("all {of} {verb}"),
            NamedEarthquake::Motions => format!("{hits} {verb}"),
            _ if of == 1 => format!("the one {} {verb}", noun.trim_end_matches('s')),
            _ if hits == of => format!("all {of} {noun} {verb}"),
            _ => format!("{hits} of {of} {noun} {verb}"),
        }
    }

    /// `; in 3 of them it ends leaning on its wall`.
    fn leaning(&self) -> String {
        let Counts {
            leaning,
            overturned,
            asked,
            ..
        } = self.counts;
        match leaning {
            0 => String::new(),
            _ if overturned == 1 && asked == 1 => "; it ends leaning on its wall".to_owned(),
            _ if leaning == overturned && overturned == 1 => {
                "; it then leans on its wall".to_owned()
            }
            _ if leaning == overturned => {
                "; in all of these it ends leaning on its wall".to_owned()
            }
            _ => format!("; in {leaning} of these it ends leaning on its wall"),
        }
    }

    /// Which of two bodies on top of each other falls first.
    fn falls_first(&self) -> String {
        let Counts {
            upper_falls,
            overturned,
            ..
        } = self.counts;
        let Some(upper) = upper_falls.filter(|_| overturned > 0) else {
            return String::new();
        };
        let which = match upper {
            0 => "the object itself",
            _ => "what stands on it",
        };
        match upper {
            _ if overturned == 1 => format!("; {which} falls first"),
            _ if upper == 0 || upper == overturned => {
                format!("; in all of these {which} falls first")
            }
            _ => format!(
                "; in {upper} of these {which} falls first, in the others the object itself"
            ),
        }
    }

    /// Its travel against its clearance, and the speed at the stop against the trip speed.
    fn rolling(&self) -> String {
        let Some(rolled) = &self.counts.rolled else {
            return String::new();
        };
        let Counts {
            motions, exceeded, ..
        } = self.counts;
        let times = |count: u32| match (&self.earthquake, count) {
            (NamedEarthquake::Motions, 1) if motions == 1 => String::new(),
            (_, count) => format!(" in {count} of {motions}"),
        };
        // After what overturns it, or after its kind.
        let is_kind = matches!(self.kind, AnswerKind::Rolls | AnswerKind::Slides);
        let begin = match (is_kind, self.counts.slides) {
            (true, _) => ": ",
            (false, true) => "; it slides ",
            (false, false) => "; it rolls ",
        };
        let share = if motions == 1 { "" } else { " in 84 % of them" };
        let first = match &self.earthquake {
            NamedEarthquake::Motions => share.to_owned(),
            earthquake if is_kind && motions > 1 => {
                format!(" in 84 % of {motions} {}", noun(earthquake))
            }
            _ => share.to_owned(),
        };
        let mut told = format!("{begin}by up to {}{first}", reach(rolled, self.units));
        match (
            rolled.clearance_m,
            (rolled.stop_share * f64::from(motions)).round() as u32,
        ) {
            (None, _) if self.counts.has_wall => {
                told.push_str("; it may run into what stands beside it, which is not calculated");
            }
            (None, _) => told.push_str(", and nothing that was named stops it"),
            (Some(clearance_m), 0) => {
                told.push_str(&format!(
                    ", less than its clearance of {}",
                    self.units.reach(clearance_m)
                ));
            }
            (Some(clearance_m), stops) => {
                let clearance = self.units.reach(clearance_m);
                let speed = rolled
                    .stop_speed_m_s_p84
                    .map_or_else(String::new, |speed_m_s| {
                        format!(" at up to {}{share}", self.units.speed(speed_m_s, 2))
                    });
                let trip = self.units.speed(rolled.trip_speed_m_s, 2);
                told.push_str(&format!(
                    "; it meets the stop at {clearance}{}{speed}, and a stop overturns it from {trip}",
                    times(stops)
                ));
            }
        }
        match (&self.withstands, exceeded) {
            (Some(withstands), Some(exceeded)) if exceeded > 0 => {
                let limit = withstands.words();
                told.push_str(&format!(
                    "; the shock of the stop exceeds the {limit} that it withstands,{}",
                    times(exceeded)
                ));
            }
            _ => {}
        }
        told
    }

    /// `; its landings reach 6.4 g, under the 10 g that it withstands`.
    fn landings(&self) -> String {
        let Some(withstands) = self.withstands else {
            return String::new();
        };
        let Counts {
            motions,
            exceeded,
            shock_g_max,
            floor_g_max,
            ..
        } = self.counts;
        let exceeded = exceeded.unwrap_or(0);
        let of = format!("{exceeded} of {motions}");
        let times = if motions == 1 {
            String::new()
        } else {
            format!(", in {of}")
        };
        let limit = withstands.words();
        // Where nothing lands harder, it is the floor itself that is too much.
        let lands_harder = shock_g_max.is_some_and(|shock_g| shock_g > withstands.peak_g);
        if exceeded > 0 && !lands_harder && floor_g_max > withstands.peak_g {
            let floor = number(floor_g_max, 2);
            return format!(
                "; the floor alone, {floor} g, exceeds the {limit} that it withstands{times}"
            );
        }
        match shock_g_max {
            Some(shock_g)
                if exceeded == 0
                    && withstands.duration_s.is_none()
                    && shock_g < withstands.peak_g =>
            {
                let (shock, peak) = apart(shock_g, withstands.peak_g);
                format!("; its landings reach {shock} g, under the {peak} g that it withstands")
            }
            Some(shock_g) => {
                let shock = number(shock_g, 2);
                // A pulse that was survived says more than its peak: the spectra are compared, and the peaks may differ the
                // other way.
                let compared = match (withstands.duration_s, exceeded) {
                    (None, 0) => "and stay below the",
                    (None, _) => "and exceed the",
                    (Some(_), 0) => "with shock response spectra that stay below that of the",
                    (Some(_), _) => "with shock response spectra that exceed that of the",
                };
                let times = if exceeded == 0 { "" } else { &times };
                format!(
                    "; its landings reach {shock} g {compared} {limit} that it withstands{times}"
                )
            }
            None if self.kind == AnswerKind::DoesNotRock => format!("; it withstands {limit}"),
            None => String::new(),
        }
    }
}

/// What is counted.
pub(super) fn noun(earthquake: &NamedEarthquake) -> &'static str {
    match earthquake {
        NamedEarthquake::MotionsOfStudy { .. } => "simulations",
        NamedEarthquake::Motions => "motions",
        NamedEarthquake::Place { .. }
        | NamedEarthquake::GroundAcceleration { .. }
        | NamedEarthquake::Study { .. } => "simulated earthquakes",
    }
}

impl ToldFloor {
    fn words(&self) -> String {
        match self {
            Self::Ground => "on the ground".to_owned(),
            Self::Roof => "on the roof".to_owned(),
            Self::Number { floor, storeys } => format!("on floor {floor} of {storeys}"),
            Self::Name(name) => format!("on \"{name}\""),
            Self::Share(ratio) => format!(
                "at {} of the height of the building",
                percent_significant(*ratio, 3)
            ),
        }
    }
}

impl Withstands {
    /// `10 g`, `15 g of 11 ms`.
    pub(super) fn words(&self) -> String {
        let peak = format!("{} g", number(self.peak_g, 4));
        self.duration_s.map_or(peak.clone(), |seconds| {
            format!("{peak} of {} ms", number(1e3 * seconds, 4))
        })
    }
}

/// Two numbers with the digits that tell them apart, two or more.
fn apart(one: f64, other: f64) -> (String, String) {
    let both = |digits| (number(one, digits), number(other, digits));
    (2..=6)
        .map(both)
        .find(|(one, other)| one != other)
        .unwrap_or_else(|| both(6))
}

#[cfg(test)]
mod tests;
