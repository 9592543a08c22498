//! The answer about one object: one sentence, and its kind.

use freestand_input::quantity::UnitSystem;
use freestand_input::words::{number, percent_significant};

use crate::result::{Probability, Rolled, TooMild};

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

/// The earthquake that a sentence names.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Told {
    /// The hazard of a place.
    Place {
        /// Its name.
        name: String,
        /// Its code in print.
        code: String,
        /// The return period, if the code has one \[years\].
        years: Option<u32>,
        /// The site, such as `site De`.
        site: Option<String>,
        /// Whether the hazard was recalled and not read.
        is_approximate: bool,
    },
    /// A peak acceleration of the ground.
    GroundAcceleration {
        /// The peak \[g\].
        peak_g: f64,
    },
    /// The earthquake of a study that names no place, such as `the earthquake of hospital.toml (…)`.
    Study {
        /// The earthquake in words.
        words: String,
    },
    /// The records or simulated motions of a study, which its worlds use in turn.
    MotionsOfStudy {
        /// How many.
        motions: usize,
        /// The study.
        study: String,
    },
    /// Motions of the floor itself.
    Motions,
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
    pub(super) earthquake: Told,
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
            (AnswerKind::DoesNotRock, Told::Motions) if motions > 1 => {
                "rocks in none of them".to_owned()
            }
            (AnswerKind::DoesNotRock, earthquake) if motions > 1 => {
                format!("rocks in none of {motions} {}", earthquake.noun())
            }
            (kind, _) => kind.words().to_owned(),
        }
    }

    /// `In Melbourne (AS 1170.4, 500 years, site De) on the ground`.
    fn under(&self) -> String {
        let floor = self.floor.words();
        match &self.earthquake {
            Told::Place {
                name,
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
                format!("In {name} ({}) {floor}", details.join(", "))
            }
            Told::GroundAcceleration { peak_g } => {
                let peak = format!("At a ground acceleration of {} g", number(*peak_g, 4));
                // The ground that accelerates is the floor.
                if self.floor == ToldFloor::Ground {
                    peak
                } else {
                    format!("{peak} {floor}")
                }
            }
            Told::Study { words } => format!("Under {words} {floor}"),
            Told::MotionsOfStudy { motions: 1, study } => {
                format!("Under the motion of {study} {floor}")
            }
            Told::MotionsOfStudy { motions, study } => {
                format!("Under the {motions} motions of {study} {floor}")
            }
            Told::Motions if self.counts.motions == 1 => "Under this motion".to_owned(),
            Told::Motions => format!("Under these {} motions", self.counts.motions),
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
                0 if self.earthquake == Told::Motions => "none overturns".to_owned(),
                0 => format!("none of {asked} {} overturns", self.earthquake.noun()),
                _ => self.count(overturned, asked, verb),
            };
            return format!(
                "it is {}; in that calculation {counted} it, but the real object may fall",
                why.words()
            );
        }
        match self.kind {
            // A peak may pass the threshold on its way to no uplift: across an edge, or on pads.
            AnswerKind::DoesNotRock if floor_g_max >= lift_g => match self.earthquake {
                Told::Motions if motions == 1 => "it lifts no edge".to_owned(),
                _ if motions == 1 => format!(
                    "the one {} lifts no edge",
                    self.earthquake.noun().trim_end_matches('s')
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
                    Told::Motions if motions == 1 => format!("it lifts an edge{by}"),
                    _ => format!(
                        "{} an edge{by}{none}",
                        self.count(lifted, motions, ("lifts", "lift"))
                    ),
                }
            }
            AnswerKind::Rolls | AnswerKind::Slides => String::new(),
            AnswerKind::Falls if motions == 1 && self.earthquake == Told::Motions => String::new(),
            AnswerKind::ProbablyStands | AnswerKind::MayFall | AnswerKind::Falls => {
                let counted = self.count(overturned, asked, ("overturns", "overturn"));
                // Few motions are all there is to say; all is all.
                let interval = self
                    .probability
                    .filter(|_| self.earthquake != Told::Motions && overturned < asked);
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
        let noun = self.earthquake.noun();
        let verb = if hits == 1 { one } else { many };
        match &self.earthquake {
            Told::Motions if hits == of => format!("all {of} {verb}"),
            Told::Motions => format!("{hits} {verb}"),
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
            (Told::Motions, 1) if motions == 1 => String::new(),
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
            Told::Motions => share.to_owned(),
            earthquake if is_kind && motions > 1 => {
                format!(" in 84 % of {motions} {}", earthquake.noun())
            }
            _ => share.to_owned(),
        };
        let mut told = format!("{begin}by up to {}{first}", rolled.reach_words(self.units));
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
                    "; the shock of the stop exceeds the {limit} that it withstands{}",
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
            format!(" in {of}")
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
            Some(shock_g) if exceeded == 0 => {
                format!(
                    "; its landings reach {} g and stay below the {limit} that it withstands",
                    number(shock_g, 2)
                )
            }
            Some(shock_g) => {
                format!(
                    "; its landings reach {} g and exceed the {limit} that it withstands{times}",
                    number(shock_g, 2)
                )
            }
            None if self.kind == AnswerKind::DoesNotRock => format!("; it withstands {limit}"),
            None => String::new(),
        }
    }
}

impl Told {
    /// What is counted.
    pub(super) fn noun(&self) -> &'static str {
        match self {
            Self::MotionsOfStudy { .. } => "simulations",
            Self::Motions => "motions",
            Self::Place { .. } | Self::GroundAcceleration { .. } | Self::Study { .. } => {
                "simulated earthquakes"
            }
        }
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
mod tests {
    use super::*;

    fn place(name: &str, code: &str, years: Option<u32>, site: Option<&str>) -> Told {
        let (name, code, site) = (name.to_owned(), code.to_owned(), site.map(str::to_owned));
        Told::Place {
            name,
            code,
            years,
            site,
            is_approximate: false,
        }
    }

    fn counts(motions: u32, lifted: u32, overturned: u32) -> Counts {
        Counts {
            motions,
            lifted,
            asked: motions,
            overturned,
            lift_g: 0.21,
            floor_g_max: 0.3,
            ..Counts::default()
        }
    }

    fn answer(earthquake: Told, counts: Counts) -> Answer {
        let kind = AnswerKind::of(&counts, 0.1, None);
        Answer {
            kind,
            earthquake,
            floor: ToldFloor::Ground,
            counts,
            probability: None,
            withstands: None,
            units: UnitSystem::Si,
        }
    }

    fn p(value: f64, low: f64, high: f64) -> Option<Probability> {
        Some(Probability { value, low, high })
    }

    const ROLLED: Rolled = Rolled {
        travel_m_median: 0.2,
        travel_m_p84: 0.31,
        is_at_least: false,
        clearance_m: None,
        stop_share: 0.0,
        stop_speed_m_s_p84: None,
        clearance_needed_m: 0.45,
        trip_speed_m_s: 1.92,
    };

    /// What rolls is told by its travel, against its clearance and the speed that trips it.
    #[test]
    fn travel_against_clearance() {
        let tell = |rolled: Rolled, counts: Counts| {
            let counts = Counts {
                rolled: Some(rolled),
                exceeded: Some(2),
                ..counts
            };
            Answer {
                withstands: TEN_G,
                ..answer(Told::GroundAcceleration { peak_g: 0.5 }, counts)
            }
            .sentence()
        };
        // By hand: 310 mm is 12.2 in, 1.92 m/s 6.3 ft/s; distances are rounded up.
        let in_us = Answer {
            units: UnitSystem::Us,
            ..answer(
                Told::Motions,
                Counts {
                    rolled: Some(Rolled {
                        clearance_m: Some(0.2),
                        stop_share: 0.45,
                        stop_speed_m_s_p84: Some(1.1),
                        ..ROLLED
                    }),
                    ..counts(20, 0, 0)
                },
            )
        };
        let said = in_us.sentence();
        assert!(
            said.contains("the stop at 7.9 in")
                && said.contains("3.6 ft/s")
                && said.ends_with("from 6.3 ft/s."),
            "{said}"
        );
        assert!(!said.contains(" mm") && !said.contains(" m/s"), "{said}");
        let still = Counts {
            exceeded: Some(0),
            ..counts(20, 0, 0)
        };
        let room = Rolled {
            clearance_m: Some(0.4),
            ..ROLLED
        };
        let said = tell(room, still);
        assert!(said.contains(
            "stays standing: by up to 310 mm in 84 % of 20 simulated earthquakes, less than its clearance of 400 mm"
        ));
        let stops = Rolled {
            clearance_m: Some(0.2),
            stop_share: 0.45,
            stop_speed_m_s_p84: Some(1.1),
            ..ROLLED
        };
        assert_eq!(
            tell(stops, counts(20, 0, 0)),
            "At a ground acceleration of 0.5 g this object rolls and stays standing: by up to 200 mm in 84 % of 20 \
             simulated earthquakes; it meets the stop at 200 mm in 9 of 20 at up to 1.1 m/s in 84 % of them, and a stop \
             overturns it from 1.9 m/s; the shock of the stop exceeds the 10 g that it withstands in 2 of 20."
        );
        let trips = tell(stops, counts(20, 3, 3));
        assert!(
            trips.contains(
                "may fall over: 3 of 20 simulated earthquakes overturn it; it rolls by up to 200 mm"
            ),
            "{trips}"
        );
        let one = Counts {
            rolled: Some(Rolled {
                stop_share: 1.0,
                ..stops
            }),
            ..counts(1, 0, 0)
        };
        assert_eq!(
            answer(Told::Motions, one).sentence(),
            "Under this motion this object rolls and stays standing: by up to 200 mm; it meets the stop at 200 mm at up to \
             1.1 m/s, and a stop overturns it from 1.9 m/s."
        );
    }

    /// Leaning counts as a fall, and is told apart.
    #[test]
    fn leaning_is_told() {
        let tell = |leaning, counts: Counts| {
            answer(
                Told::GroundAcceleration { peak_g: 0.5 },
                Counts { leaning, ..counts },
            )
            .sentence()
        };
        assert!(
            tell(3, counts(20, 18, 9))
                .ends_with("overturn it; in 3 of these it ends leaning on its wall.")
        );
        assert!(
            tell(9, counts(20, 18, 9))
                .ends_with("overturn it; in all of these it ends leaning on its wall.")
        );
        assert!(tell(1, counts(20, 18, 1)).ends_with("overturns it; it then leans on its wall."));
        let one = answer(
            Told::Motions,
            Counts {
                leaning: 1,
                ..counts(1, 1, 1)
            },
        )
        .sentence();
        assert_eq!(
            one,
            "Under this motion this object falls over; it ends leaning on its wall."
        );
    }

    #[test]
    fn the_body_of_a_stack_that_falls_first_is_told() {
        let tell = |upper: u32, counts: Counts| {
            answer(
                Told::GroundAcceleration { peak_g: 0.5 },
                Counts {
                    upper_falls: Some(upper),
                    ..counts
                },
            )
            .sentence()
        };
        let mixed =
            "; in 3 of these what stands on it falls first, in the others the object itself.";
        assert!(tell(3, counts(20, 18, 9)).ends_with(mixed));
        assert!(
            tell(9, counts(20, 18, 9))
                .ends_with("; in all of these what stands on it falls first.")
        );
        assert!(
            tell(0, counts(20, 18, 9))
                .ends_with("; in all of these the object itself falls first.")
        );
        assert!(!tell(0, counts(20, 18, 0)).contains("first"));
        let one = answer(
            Told::Motions,
            Counts {
                upper_falls: Some(1),
                ..counts(1, 1, 1)
            },
        )
        .sentence();
        assert_eq!(
            one,
            "Under this motion this object falls over; what stands on it falls first."
        );
    }

    const TEN_G: Option<Withstands> = Some(Withstands {
        peak_g: 10.0,
        duration_s: None,
    });

    /// The six sentences of the specification, word for word.
    #[test]
    fn the_sentences_that_were_asked_for() {
        let melbourne = place("Melbourne", "AS 1170.4", Some(500), Some("site De"));
        let one = answer(
            melbourne,
            Counts {
                floor_g_max: 0.13,
                ..counts(20, 0, 0)
            },
        );
        let two = answer(
            Told::Motions,
            Counts {
                uplift_m_max: Some(0.0312),
                ..counts(6, 4, 0)
            },
        );
        let wellington = place("Wellington", "NZS 1170.5", Some(500), Some("site C"));
        let three = Answer {
            floor: ToldFloor::Number {
                floor: 1,
                storeys: 7,
            },
            probability: p(9.0 / 320.0, 0.0109, 0.0577),
            ..answer(wellington, counts(320, 200, 9))
        };
        let los_angeles = place("Los Angeles", "ASCE 7-16", None, Some("site D"));
        let four = Answer {
            floor: ToldFloor::Number {
                floor: 3,
                storeys: 6,
            },
            probability: p(0.45, 0.2, 0.72),
            ..answer(los_angeles, counts(20, 20, 9))
        };
        let five = Answer {
            probability: p(1.0, 0.79, 1.0),
            ..answer(Told::GroundAcceleration { peak_g: 0.8 }, counts(20, 20, 20))
        };
        let athens = Told::Place {
            name: "Athens".to_owned(),
            code: "Eurocode 8".to_owned(),
            years: None,
            site: None,
            is_approximate: true,
        };
        let lands = Counts {
            uplift_m_max: Some(0.009),
            shock_g_max: Some(6.41),
            exceeded: Some(0),
            ..counts(160, 31, 0)
        };
        let six = Answer {
            withstands: TEN_G,
            ..answer(athens, lands)
        };
        let expected = [
            (
                one,
                "does-not-rock",
                "In Melbourne (AS 1170.4, 500 years, site De) on the ground, this object rocks in none of 20 simulated \
                 earthquakes: the floor reaches 0.13 g at most and it takes 0.21 g to lift an edge.",
            ),
            (
                two,
                "rocks",
                "Under these 6 motions this object stays standing: 4 lift an edge, by 31 mm at most, and none \
                 overturns it.",
            ),
            (
                three,
                "probably-stands",
                "In Wellington (NZS 1170.5, 500 years, site C) on floor 1 of 7 this object will probably stay \
                 standing: 9 of 320 simulated earthquakes overturn it (2.8 %, between 1.1 and 5.8 %).",
            ),
            (
                four,
                "may-fall",
                "In Los Angeles (ASCE 7-16, site D) on floor 3 of 6 this object may fall over: 9 of 20 simulated \
                 earthquakes overturn it (45 %, between 20 and 72 %).",
            ),
            (
                five,
                "falls",
                "At a ground acceleration of 0.8 g this object falls over: all 20 simulated earthquakes overturn it.",
            ),
            (
                six,
                "rocks",
                "In Athens (Eurocode 8, approximate hazard, confirm) on the ground this object stays standing: 31 of \
                 160 simulated earthquakes lift an edge, by 9 mm at most; its landings reach 6.4 g, under the 10 g \
                 that it withstands.",
            ),
        ];
        for (answer, kind, sentence) in expected {
            assert_eq!(
                (answer.kind.into(), answer.sentence().as_str()),
                (kind, sentence)
            );
        }
    }

    /// Every kind under every earthquake: one line, one full stop, and what is named.
    #[test]
    fn every_kind_under_every_earthquake() {
        let earthquakes = [
            (
                place("Oslo", "a code", None, None),
                "In Oslo (a code) on the ground",
                "simulated earthquakes",
            ),
            (
                Told::GroundAcceleration { peak_g: 0.3 },
                "At a ground acceleration of 0.3 g",
                "simulated earthquakes",
            ),
            (
                Told::Study {
                    words: "the earthquake of s.toml (EC8)".to_owned(),
                },
                "Under the earthquake of s.toml (EC8) on the ground",
                "simulated earthquakes",
            ),
            (
                Told::MotionsOfStudy {
                    motions: 7,
                    study: "s.toml".to_owned(),
                },
                "Under the 7 motions of s.toml on the ground",
                "simulations",
            ),
            (Told::Motions, "Under these 40 motions", ""),
        ];
        let of_kind = [
            (counts(40, 0, 0), "rocks in none of "),
            (
                Counts {
                    rolled: Some(ROLLED),
                    ..counts(40, 0, 0)
                },
                "rolls and stays standing: by up to 310 mm",
            ),
            (
                Counts {
                    rolled: Some(ROLLED),
                    slides: true,
                    ..counts(40, 0, 0)
                },
                "slides and stays standing: by up to 310 mm",
            ),
            (counts(40, 1, 0), "stays standing: 1"),
            (counts(40, 9, 2), "will probably stay standing: 2"),
            (counts(40, 30, 12), "may fall over: 12"),
            (counts(40, 40, 40), "falls over: all 40"),
        ];
        for (earthquake, under, noun) in earthquakes {
            for ((counts, words), kind) in of_kind
                .into_iter()
                .zip(<AnswerKind as strum::VariantArray>::VARIANTS)
            {
                let told = answer(earthquake.clone(), counts);
                let sentence = told.sentence();
                assert_eq!(told.kind, *kind);
                let comma = if *kind == AnswerKind::DoesNotRock {
                    ","
                } else {
                    ""
                };
                assert!(
                    sentence.starts_with(&format!("{under}{comma} this object {words}")),
                    "{sentence}"
                );
                assert!(
                    sentence.contains(noun) && sentence.ends_with('.') && !sentence.contains('\n'),
                    "{sentence}"
                );
            }
        }
    }

    /// As often as is accepted is accepted; an object falls where the interval lies above one half.
    #[test]
    fn kinds_at_their_limits() {
        let kind = |asked, overturned, accepted_ratio| {
            let share = f64::from(overturned) / f64::from(asked);
            // Of 20 worlds, a tenth to a quarter on each side.
            let probability = (asked > 1).then_some(Probability {
                value: share,
                low: share - 0.2,
                high: share + 0.2,
            });
            let counts = Counts {
                asked,
                lifted: asked,
                overturned,
                ..Counts::default()
            };
            <&str>::from(AnswerKind::of(&counts, accepted_ratio, probability))
        };
        assert_eq!(
            [2, 3].map(|overturned| kind(20, overturned, 0.1)),
            ["probably-stands", "may-fall"]
        );
        assert_eq!(
            [4, 5].map(|overturned| kind(20, overturned, 0.2)),
            ["probably-stands", "may-fall"]
        );
        assert_eq!(
            [9, 10, 14].map(|overturned| kind(20, overturned, 0.1)),
            ["may-fall"; 3]
        );
        assert_eq!(
            [15, 20].map(|overturned| kind(20, overturned, 0.1)),
            ["falls"; 2]
        );
        // Given motions are all there is.
        let given = |overturned| Counts {
            asked: 3,
            lifted: 3,
            overturned,
            ..Counts::default()
        };
        assert_eq!(
            [2, 3].map(|n| <&str>::from(AnswerKind::of(&given(n), 0.1, None))),
            ["may-fall", "falls"]
        );
        assert_eq!(kind(1, 1, 0.1), "falls");
        // On pads it can fall where an edge of a rigid floor lifts in no world.
        let fallen = Counts {
            asked: 20,
            lifted: 0,
            overturned: 1,
            ..Counts::default()
        };
        assert_eq!(
            AnswerKind::of(&fallen, 0.1, None),
            AnswerKind::ProbablyStands
        );
    }

    #[test]
    fn one_and_all_are_told_as_people_do() {
        let tell = |earthquake: &Told, counts| answer(earthquake.clone(), counts).sentence();
        let one = Counts {
            uplift_m_max: Some(0.1234),
            ..counts(1, 1, 0)
        };
        assert_eq!(
            tell(&Told::Motions, one),
            "Under this motion this object stays standing: it lifts an edge, by 123 mm."
        );
        for (uplift_m, said) in [
            (0.0, "less than 1 mm"),
            (9.99e-4, "less than 1 mm"),
            (1e-3, "1 mm at most"),
        ] {
            let barely = Counts {
                uplift_m_max: Some(uplift_m),
                ..counts(6, 4, 0)
            };
            let whole = format!(": 4 lift an edge, by {said}, and none overturns it.");
            assert!(
                tell(&Told::Motions, barely).ends_with(&whole),
                "{}",
                tell(&Told::Motions, barely)
            );
        }
        assert_eq!(
            tell(&Told::Motions, counts(1, 1, 1)),
            "Under this motion this object falls over."
        );
        let still = Counts {
            floor_g_max: 0.1,
            ..counts(1, 0, 0)
        };
        let said = "Under this motion, this object does not rock: the floor reaches 0.1 g and it takes 0.21 g to lift an \
                    edge.";
        assert_eq!(tell(&Told::Motions, still), said);
        assert!(
            tell(&Told::Motions, counts(6, 6, 0))
                .ends_with(": all 6 lift an edge, and none overturns it.")
        );
        assert!(tell(&Told::Motions, counts(6, 6, 1)).ends_with(": 1 overturns it."));
        assert!(tell(&Told::Motions, counts(6, 6, 6)).ends_with(": all 6 overturn it."));
        let peak = Told::GroundAcceleration { peak_g: 0.5 };
        assert!(
            tell(&peak, counts(1, 1, 1))
                .ends_with("falls over: the one simulated earthquake overturns it.")
        );
        let two = tell(&peak, counts(20, 1, 0));
        assert!(
            two.ends_with(": 1 of 20 simulated earthquakes lifts an edge, and none overturns it."),
            "{two}"
        );
    }

    /// A peak of the floor above the threshold does not contradict the sentence.
    #[test]
    fn no_uplift_above_the_threshold() {
        let told = answer(
            Told::Motions,
            Counts {
                floor_g_max: 0.25,
                ..counts(6, 0, 0)
            },
        );
        assert_eq!(
            told.sentence(),
            "Under these 6 motions, this object rocks in none of them: none lifts an edge."
        );
        let near = answer(
            Told::Motions,
            Counts {
                floor_g_max: 0.2096,
                ..counts(6, 0, 0)
            },
        );
        assert!(
            near.sentence()
                .contains("reaches 0.2096 g at most and it takes 0.21 g"),
            "{}",
            near.sentence()
        );
    }

    #[test]
    fn what_it_withstands() {
        let tell = |counts: Counts, withstands: Option<Withstands>| {
            Answer {
                withstands,
                ..answer(Told::GroundAcceleration { peak_g: 0.3 }, counts)
            }
            .sentence()
        };
        let hard = Counts {
            shock_g_max: Some(14.2),
            exceeded: Some(12),
            ..counts(160, 31, 9)
        };
        assert!(tell(hard, TEN_G).ends_with(
            "; its landings reach 14 g and exceed the 10 g that it withstands in 12 of 160."
        ),);
        let near = Counts {
            shock_g_max: Some(9.97),
            exceeded: Some(0),
            ..counts(160, 31, 0)
        };
        assert!(
            tell(near, TEN_G)
                .ends_with("; its landings reach 9.97 g, under the 10 g that it withstands.")
        );
        let pulse = Some(Withstands {
            peak_g: 15.0,
            duration_s: Some(0.011),
        });
        let harder = Counts {
            shock_g_max: Some(18.0),
            exceeded: Some(0),
            ..counts(160, 31, 0)
        };
        let said = "; its landings reach 18 g and stay below the 15 g of 11 ms that it withstands.";
        assert!(
            tell(harder, pulse).ends_with(said),
            "{}",
            tell(harder, pulse)
        );
        let still = Counts {
            floor_g_max: 0.15,
            exceeded: Some(0),
            ..counts(20, 0, 0)
        };
        assert!(
            tell(still, TEN_G).ends_with("to lift an edge; it withstands 10 g."),
            "{}",
            tell(still, TEN_G)
        );
        let weak = Some(Withstands {
            peak_g: 0.1,
            duration_s: None,
        });
        let shaken = Counts {
            exceeded: Some(20),
            ..still
        };
        assert!(tell(shaken, weak).ends_with(
            "; the floor alone, 0.15 g, exceeds the 0.1 g that it withstands in 20 of 20."
        ));
        let soft = Counts {
            shock_g_max: Some(0.08),
            exceeded: Some(3),
            ..counts(20, 9, 0)
        };
        assert!(tell(soft, weak).ends_with(
            "; the floor alone, 0.3 g, exceeds the 0.1 g that it withstands in 3 of 20."
        ));
        // What falls over does not land on its edges.
        let fallen = Counts {
            exceeded: Some(0),
            ..counts(20, 20, 20)
        };
        assert!(tell(fallen, TEN_G).ends_with("overturn it."));
    }

    #[test]
    fn floors_by_name_and_height() {
        let on = |floor| {
            Answer {
                floor,
                ..answer(place("Oslo", "a code", None, None), counts(20, 20, 20))
            }
            .sentence()
        };
        assert!(on(ToldFloor::Roof).starts_with("In Oslo (a code) on the roof this object"));
        assert!(on(ToldFloor::Name("Lobby".to_owned())).contains(" on \"Lobby\" this object"));
        assert!(
            on(ToldFloor::Share(0.5))
                .contains(" at 50 % of the height of the building this object")
        );
    }
}
