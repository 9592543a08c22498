//! A place by its name or its coordinates, and what comes near to what was written.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::LazyLock;

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{canonical, number};

use super::cities::{City, cities};
use super::rows::by_hand;
use super::{Confidence, Coordinates, Place, PlaceHazard, Size, grid, places};
use freestand_records::tables::hazard::Wanted;

/// Up to here the values of a place hold for coordinates \[km\]: about the width of a town, and half the step of the grids
/// from which the values of most places are.
const SAME_PLACE_KM: f64 = 5.0;
/// The places that are told of coordinates without values are at most so far away \[km\].
const NEAR_KM: f64 = 300.0;
/// If none is so near, the nearest is told of a city up to here \[km\].
const FAR_AWAY_KM: f64 = 1000.0;

/// Why a place has no hazard.
#[derive(Debug, Clone, PartialEq)]
pub enum NotFound {
    /// Its name is not in the tables; names that a slip of the pen makes of it, and what is known of the places of its
    /// country that are not in the tables.
    Unknown(Vec<String>, Option<Unlisted>),
    /// A city without values: its name, the nearest places with values, each with its distance \[km\], and what is known
    /// of the places of its country that are not in the tables.
    NoValues(String, Vec<(String, f64)>, Option<Unlisted>),
    /// Several places have this name: their names in full.
    Several(Vec<String>),
    /// Coordinates in a country without a grid; the nearest places, each with its distance \[km\], and the coordinates in
    /// the other order, where places are near those alone. Which municipality they are in is not known, nor whether the
    /// tables list it.
    Far(Vec<(String, f64)>, Option<Coordinates>),
    /// Coordinates that do not exist.
    NoCoordinates,
    /// Coordinates that exist in the other order alone.
    Swapped(Coordinates),
    /// One value for the place would be wrong: why.
    Refused(&'static str),
}

/// What is known of the places of a country that are not in the tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unlisted {
    /// Those of Spain have an acceleration below the least that the annex of NCSE-02 lists.
    Spain,
}

impl Unlisted {
    fn of(country: &str) -> Option<Self> {
        (country == "Spain").then_some(Self::Spain)
    }

    /// Of a city that is known to be none of its municipalities.
    ///
    /// # Reference
    /// NCSE-02 (Real Decreto 997/2002, BOE 244), annex 1: the municipalities whose a_b is 0.04 g or more.
    fn words(self) -> &'static str {
        match self {
            Self::Spain => {
                "NCSE-02 lists only the municipalities of Spain with a_b of 0.04 g or more: one that it does not list has less"
            }
        }
    }

    /// Of a name that was not found: it may be misspelt, or that of a part of a municipality.
    fn words_of_unknown(self) -> &'static str {
        match self {
            Self::Spain => {
                "check the spelling and the province; only if annex 1 of NCSE-02 really does not list the municipality is its \
                 a_b below 0.04 g"
            }
        }
    }
}

/// Places for which one value would be wrong, and why.
const REFUSED: [(&str, &str); 7] = [
    (
        "Mexico City,Ciudad de Mexico,CDMX",
        "no value on rock is right for the lake zone of Mexico City, where the ground itself makes the spectrum, with periods up \
         to 2.5 s: take the spectrum of your site from SASID and give it as a table (`spectrum`)",
    ),
    (
        "Reykjavik",
        "the boundary of a zone runs near Reykjavik: 0.10 to 0.40 g (recalled)",
    ),
    (
        "Algiers,Alger",
        "the zone of Algiers has 0.25 to 0.40 g by the use of the building (recalled)",
    ),
    (
        "Kaohsiung",
        "the districts of Kaohsiung differ too much: S_DS 0.5 to 0.7 g (recalled)",
    ),
    (
        "Tainan",
        "the districts of Tainan differ too much: S_D1 0.35 to 0.45 g (recalled)",
    ),
    (
        "Vancouver",
        "no value for Vancouver is in the program: the tool of Natural Resources Canada gives it",
    ),
    (
        "Jakarta",
        "no value for Jakarta is in the program: the map of SNI 1726 gives it",
    ),
];

impl NotFound {
    /// The problem with what was written under a key, if it has one; `bring` says what serves in place of a place.
    pub fn problem(&self, key: Option<&str>, text: &str, bring: &str) -> Problem {
        let text = shorten(text);
        let text = match self {
            Self::Far(..) | Self::NoCoordinates | Self::Swapped(_) => text.to_string(),
            _ => format!("\"{text}\""),
        };
        let shown = key.map_or_else(|| text.clone(), |key| format!("`{key}` {text}"));
        const LIST: &str = "freestand place list shows all places";
        let quoted = |names: &[String]| {
            let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
            names.join(" or ")
        };
        match self {
            Self::Unknown(near, unlisted) => {
                let message = format!("{shown} is not in the table of places");
                let others =
                    format!("give its coordinates, such as \"41.01, 28.97\"; {bring}; {LIST}");
                let hint = match (near.is_empty(), unlisted) {
                    (true, None) => others,
                    (true, Some(unlisted)) => {
                        format!("{}; {others}", unlisted.words_of_unknown())
                    }
                    (false, None) => format!("did you mean {}?", quoted(near)),
                    // That a name is near does not say that it is meant.
                    (false, Some(unlisted)) => format!(
                        "did you mean {}? If not, {}; {others}",
                        quoted(near),
                        unlisted.words_of_unknown()
                    ),
                };
                Problem::value(message, hint)
            }
            Self::Several(names) => {
                let message = format!("{shown} is the name of {} places", names.len());
                Problem::value(message, format!("say which: {}", quoted(names)))
            }
            Self::NoValues(city, near, unlisted) => {
                let message = format!("no hazard is known for {city}");
                Problem::value(message, without_values(near, *unlisted, bring))
            }
            Self::Far(_, Some(swapped)) => Problem::value(
                format!("no hazard is known at {shown}"),
                format!(
                    "the latitude comes first: did you mean \"{}\"?",
                    swapped.words()
                ),
            ),
            Self::Far(near, None) => {
                let message = format!("no hazard is known at {shown}");
                Problem::value(message, without_values(near, None, bring))
            }
            Self::Swapped(at) => Problem::value(
                format!("{shown} are no coordinates"),
                format!("the latitude comes first: did you mean \"{}\"?", at.words()),
            ),
            Self::NoCoordinates => Problem::value(
                format!("{shown} are no coordinates"),
                "give the latitude (-90 to 90), then the longitude (-180 to 180), such as \"41.01, 28.97\"",
            ),
            Self::Refused(why) => Problem::value(*why, bring),
        }
    }
}

/// What serves in place of a place without values, near which these have some.
fn without_values(near: &[(String, f64)], unlisted: Option<Unlisted>, bring: &str) -> String {
    let unlisted = unlisted.map(|unlisted| unlisted.words().to_owned());
    let near =
        (!near.is_empty()).then(|| format!("the nearest places with values are {}", away(near)));
    let all: Vec<String> = unlisted
        .into_iter()
        .chain(near)
        .chain([bring.to_owned()])
        .collect();
    all.join("; ")
}

/// Places with their distances.
fn away(near: &[(String, f64)]) -> String {
    let near: Vec<String> = near
        .iter()
        .map(|(name, km)| format!("{name} ({} km away)", number(*km, 2)))
        .collect();
    near.join(", ")
}

impl City {
    /// Whether one of these names of it, with or without its country behind it, was written.
    fn has<'a>(&self, names: impl IntoIterator<Item = &'a String>, wanted: &str) -> bool {
        names.into_iter().any(|name| {
            let rest = wanted.strip_prefix(name.as_str()).map(str::trim_start);
            rest.is_some_and(|rest| rest.is_empty() || is_country(rest, &self.country))
        })
    }
}

/// What there is at a large city that has no row of its own: a point of a grid, a place that is this city by another name, or the
/// places that are near. `None`: no such city is known.
fn of_city(wanted: &str, code: Option<&str>) -> Option<Result<Place, NotFound>> {
    // The name of a city comes before another city's old or foreign one.
    let mut called: Vec<&City> = cities()
        .iter()
        .filter(|city| city.has(city.names.first(), wanted))
        .collect();
    if called.is_empty() {
        let other = |city: &&City| city.has(&city.names, wanted);
        called.extend(cities().iter().find(other));
    }
    let city = *called.first()?;
    if called.iter().any(|other| other.country != city.country) {
        let mut names: Vec<String> = called
            .iter()
            .map(|city| format!("{}, {}", city.name, city.country))
            .collect();
        // Two cities of a country may have one name, and the larger one is meant.
        let mut told = HashSet::new();
        names.retain(|name| told.insert(name.clone()));
        return Some(Err(NotFound::Several(names)));
    }
    let name = format!("{}, {}", city.name, city.country);
    let unlisted = Unlisted::of(&city.country);
    Some(at(city.at, code).map_err(|why| match why {
        // A place is there, but has no values of this code.
        NotFound::Far(near, _) if near.first().is_some_and(|(_, km)| *km <= SAME_PLACE_KM) => {
            NotFound::NoValues(name, near, None)
        }
        NotFound::Far(near, _) if near.is_empty() => {
            let first = nearest(city.at).into_iter().next();
            let first = first.and_then(|place| Some((place.full_name(), place.distance_km?)));
            let first = first.filter(|(_, km)| *km <= FAR_AWAY_KM);
            NotFound::NoValues(name, first.into_iter().collect(), unlisted)
        }
        NotFound::Far(near, _) => NotFound::NoValues(name, near, unlisted),
        other => other,
    }))
}

impl Place {
    /// The place with this name or at these coordinates, by the first of its codes.
    ///
    /// # Example
    /// ```
    /// use freestand_study::places::{Place, PlaceHazard};
    /// let place = Place::find("zürich").unwrap();
    /// assert_eq!((place.name.as_ref(), place.country), ("Zurich", "Switzerland"));
    /// assert!(matches!(place.hazard, PlaceHazard::Eurocode8 { ground_acceleration_g: 0.06, .. }));
    /// assert_eq!(Place::find("Atlantis"), None);
    /// assert_eq!(Place::find("41.01, 28.97").unwrap().name, "Istanbul");
    /// ```
    pub fn find(text: &str) -> Option<Self> {
        Self::look_up(text, None).ok()
    }

    /// The place with this name or at these coordinates. Capitals, accents and punctuation do not matter; the state or the
    /// country may follow: `Charleston, SC`, `Wellington New Zealand`. Of the places with this name, one with values for
    /// `code` comes first.
    ///
    /// # Errors
    /// Why there is none.
    pub fn look_up(text: &str, code: Option<&str>) -> Result<Self, NotFound> {
        if let Some(point) = coordinates(text) {
            return at(point?, code);
        }
        let wanted = canonical(text);
        if let Some((_, why)) = REFUSED
            .iter()
            .find(|(names, _)| names.split(',').any(|name| canonical(name) == wanted))
        {
            return Err(NotFound::Refused(why));
        }
        let mut found: Vec<(usize, &Self)> = Called::by_letter()
            .get(&wanted.chars().next())
            .into_iter()
            .flatten()
            .filter(|called| called.is(&wanted))
            .map(|called| (called.place.rank(called.row), called.place))
            .collect();
        if let Some(code) = code
            && found.iter().any(|(_, place)| place.hazard.code() == code)
        {
            found.retain(|(_, place)| place.hazard.code() == code);
        }
        let Some(&(rank, first)) = found.iter().min_by_key(|(rank, _)| rank) else {
            return of_city(&wanted, code).unwrap_or_else(|| Err(unknown(text)));
        };
        // A city of another country may be meant as well, a parish hardly.
        found.retain(|(other, place)| {
            *other == rank || *other == 1 && place.country != first.country
        });
        // Some parishes stand twice in the table, with the same values.
        found.dedup_by(|(_, one), (_, other)| {
            one.full_name() == other.full_name() && one.hazard == other.hazard
        });
        // A parish may have the name of a city that is not in the table, such as La Paz.
        let is_parish = found.iter().all(|(_, place)| place.size == Size::Parish);
        if is_parish
            && first.names().any(|name| canonical(name) == wanted)
            && let Some(city) = of_city(&wanted, code)
        {
            return city;
        }
        let is_one_of_the_table =
            |(other, place): &(usize, &Self)| *other == 0 && place.country == first.country;
        let is_by_hand = found.iter().all(is_one_of_the_table);
        // The places of the table by hand keep their names, and answers tell the country of one that a city abroad has as well.
        let abroad = match rank > 0 && code.is_none() {
            true => larger_abroad(&wanted, &found),
            false => Vec::new(),
        };
        if found.len() + abroad.len() > 1 && !is_by_hand {
            let names = found.iter().map(|(_, place)| place.full_name());
            return Err(NotFound::Several(names.chain(abroad).collect()));
        }
        if is_parish && first.names().any(|name| canonical(name) == wanted) {
            return Err(NotFound::Unknown(vec![first.full_name()], None));
        }
        let mut meant = first.clone();
        if let PlaceHazard::Ntc2018 { at } = meant.hazard {
            meant.distance_km = grid::node_distance_km(at);
        }
        Ok(meant)
    }

    /// 0 for the table by hand, 1 for cities, 2 for smaller municipalities and parishes: a name means one of the lowest rank.
    fn rank(&self, row: usize) -> usize {
        match self.size {
            _ if row < by_hand() => 0,
            Size::City => 1,
            Size::Municipality if self.largest_rank().is_some() => 1,
            Size::Municipality | Size::Parish => 2,
        }
    }

    /// Its rank among the large cities, the largest being 0; `None`: it is none of them.
    pub(super) fn largest_rank(&self) -> Option<usize> {
        let here = self.coordinates?;
        cities().iter().position(|city| {
            city.country == self.country && city.at.distance_km(here) <= SAME_CITY_KM
        })
    }

    /// Whether a large city of another country has its name.
    pub(super) fn shares_its_name(&self) -> bool {
        let name = canonical(&self.name);
        cities()
            .iter()
            .any(|city| city.names.first() == Some(&name) && self.is_abroad(city))
    }

    /// Whether a city is in another country. A territory has a name of its own among the cities: Bayamon is in Puerto Rico there,
    /// some kilometres from its row.
    fn is_abroad(&self, city: &City) -> bool {
        let is_here = |at: Coordinates| city.at.distance_km(at) <= 4.0 * SAME_PLACE_KM;
        city.country != self.country && !self.coordinates.is_some_and(is_here)
    }
}

/// The coordinates of a city and of its row in the tables are those of one source: rounded there to 0.01°, here to 0.0001°.
const SAME_CITY_KM: f64 = 2.0;

/// The cities of this name in other countries than those of the places that were found, as long as they are larger than each of
/// these: `Valencia` is a city of Venezuela that is larger than the one of Spain.
fn larger_abroad(wanted: &str, found: &[(usize, &Place)]) -> Vec<String> {
    let largest = found
        .iter()
        .filter_map(|(_, place)| place.largest_rank())
        .min();
    let mut names: Vec<String> = Vec::new();
    for city in cities().iter().take(largest.unwrap_or(usize::MAX)) {
        let name = format!("{}, {}", city.name, city.country);
        if city.has(city.names.first(), wanted)
            && found.iter().all(|(_, place)| place.is_abroad(city))
            && !names.contains(&name)
        {
            names.push(name);
        }
    }
    names
}

/// What a place is called, in canonical words.
struct Called {
    row: usize,
    place: &'static Place,
    names: Vec<String>,
    region: String,
    country: &'static str,
}

impl Called {
    /// The places by the first letter of a name; one whose names begin with several letters is at each.
    fn by_letter() -> &'static HashMap<Option<char>, Vec<Self>> {
        static CALLED: LazyLock<HashMap<Option<char>, Vec<Called>>> = LazyLock::new(|| {
            let mut all: HashMap<Option<char>, Vec<Called>> = HashMap::new();
            for (row, place) in places().iter().enumerate() {
                let names = place.names().map(canonical);
                let letters: BTreeSet<Option<char>> =
                    names.map(|name| name.chars().next()).collect();
                for letter in letters {
                    all.entry(letter).or_default().push(Called::new(row, place));
                }
            }
            all
        });
        &CALLED
    }

    fn new(row: usize, place: &'static Place) -> Self {
        Self {
            row,
            place,
            names: place.names().map(canonical).collect(),
            region: canonical(place.region),
            country: place.country,
        }
    }

    /// Whether these are its name, with or without its state or country behind it.
    fn is(&self, wanted: &str) -> bool {
        self.names.iter().any(|name| {
            let rest = wanted.strip_prefix(name.as_str());
            rest.is_some_and(|rest| {
                let rest = rest.trim_start();
                let follows = rest.strip_prefix(self.region.as_str()).map(str::trim_start);
                rest.is_empty()
                    || is_country(rest, self.country)
                    || follows.is_some_and(|rest| rest.is_empty() || is_country(rest, self.country))
            })
        })
    }
}

/// Other names of countries, in canonical words: what people and post offices write.
const OTHER_COUNTRIES: [(&str, &[&str]); 9] = [
    ("Türkiye", &["turkey", "tr"]),
    ("United States", &["usa", "us", "united states of america"]),
    ("New Zealand", &["nz", "aotearoa"]),
    ("Australia", &["au", "aus"]),
    ("Italy", &["it", "italia"]),
    ("Portugal", &["pt"]),
    ("Spain", &["es", "espana"]),
    ("Ecuador", &["ec"]),
    ("Greece", &["gr"]),
];

/// Whether canonical words name a country: also by its other names.
pub fn is_country(words: &str, country: &str) -> bool {
    let others = OTHER_COUNTRIES.iter().find(|(name, _)| *name == country);
    words == canonical(country) || others.is_some_and(|(_, others)| others.contains(&words))
}

/// An angle as it was written: degrees, minutes and seconds, and the letter of its side.
#[derive(Default)]
struct Angle {
    parts: Vec<f64>,
    is_negative: bool,
    letter: Option<char>,
    /// Whether a sign of degrees or minutes stands behind the last part, so that a smaller part may follow.
    is_open: bool,
}

impl Angle {
    /// Degrees; `None` for minutes or seconds of 60 and more.
    fn degrees(&self) -> Option<f64> {
        let [whole, smaller @ ..] = self.parts.as_slice() else {
            return None;
        };
        if smaller.iter().any(|part| !(0.0..60.0).contains(part)) {
            return None;
        }
        let rest = smaller
            .iter()
            .zip([60.0, 3600.0])
            .map(|(part, by)| part / by);
        let size = whole + rest.sum::<f64>();
        let is_south_or_west = matches!(self.letter, Some('S' | 'W'));
        Some(if self.is_negative != is_south_or_west {
            -size
        } else {
            size
        })
    }

    /// Whether its letter says that it is a longitude.
    fn is_longitude(&self) -> Option<bool> {
        self.letter.map(|letter| matches!(letter, 'E' | 'W'))
    }
}

/// Two angles, each with its side of the equator or of Greenwich before or behind it: `41.01, 28.97`, `N41.01 E28.97`,
/// `41°0'36"N 28°58'12"E`; `None` for a text that has other words.
fn two_angles(text: &str) -> Option<[Angle; 2]> {
    let mut angles: Vec<Angle> = Vec::new();
    let mut open = Angle::default();
    let close = |open: &mut Angle, angles: &mut Vec<Angle>| {
        if !open.parts.is_empty() {
            angles.push(std::mem::take(open));
        }
    };
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let is_number = |c: char| c.is_ascii_digit() || c == '.';
        match c {
            '0'..='9' | '.' | '-' | '+' | '−' => {
                let sign = if is_number(c) { 0 } else { c.len_utf8() };
                let end = rest[sign..]
                    .find(|c| !is_number(c))
                    .map_or(rest.len(), |end| sign + end);
                let number: f64 = rest[sign..end].parse().ok()?;
                if !open.is_open || sign > 0 {
                    close(&mut open, &mut angles);
                }
                if open.parts.is_empty() {
                    open.is_negative = matches!(c, '-' | '−');
                }
                open.parts.push(number);
                open.is_open = false;
                rest = &rest[end..];
                continue;
            }
            '°' | 'º' | '\'' | '′' | '’' | '"' | '″' | '”' if !open.parts.is_empty() => {
                open.is_open = !matches!(c, '"' | '″' | '”') && open.parts.len() < 3;
            }
            'N' | 'S' | 'E' | 'W' | 'n' | 's' | 'e' | 'w' => {
                let letter = Some(c.to_ascii_uppercase());
                match (open.parts.is_empty(), open.letter) {
                    (_, None) => {
                        let is_behind = !open.parts.is_empty();
                        open.letter = letter;
                        if is_behind {
                            close(&mut open, &mut angles);
                        }
                    }
                    (false, Some(_)) => {
                        close(&mut open, &mut angles);
                        open.letter = letter;
                    }
                    (true, Some(_)) => return None,
                }
            }
            ',' | ';' => close(&mut open, &mut angles),
            c if c.is_whitespace() => {}
            _ => return None,
        }
        rest = &rest[c.len_utf8()..];
    }
    if open.parts.is_empty() && open.letter.is_some() {
        return None;
    }
    close(&mut open, &mut angles);
    angles.try_into().ok()
}

/// Latitude and longitude in degrees on WGS 84, the latitude first unless letters say otherwise: `41.01, 28.97`,
/// `41.01° N 28.97° E`, `N41.01 E28.97`, `41°0'36"N 28°58'12"E`, `-41.29 174.78`. `None` for a text that is no two angles.
///
/// # Errors
/// Angles that are on no globe.
pub fn coordinates(text: &str) -> Option<Result<Coordinates, NotFound>> {
    let [first, second] = two_angles(text)?;
    let angles = match (first.is_longitude(), second.is_longitude()) {
        (Some(one), Some(two)) if one == two => return Some(Err(NotFound::NoCoordinates)),
        (Some(true), _) | (_, Some(false)) => [second, first],
        _ => [first, second],
    };
    let [latitude, longitude] = angles.map(|one| one.degrees());
    let of = |latitude_deg, longitude_deg| Coordinates {
        latitude_deg,
        longitude_deg,
    };
    Some(match latitude.zip(longitude) {
        Some((latitude, longitude)) if is_on_globe(of(latitude, longitude)) => {
            Ok(of(latitude, longitude))
        }
        Some((latitude, longitude)) if is_on_globe(of(longitude, latitude)) => {
            Err(NotFound::Swapped(of(longitude, latitude)))
        }
        _ => Err(NotFound::NoCoordinates),
    })
}

fn is_on_globe(at: Coordinates) -> bool {
    (-90.0..=90.0).contains(&at.latitude_deg) && (-180.0..=180.0).contains(&at.longitude_deg)
}

/// Which site of a hazard file a place means: its name, its coordinates, or those of a known place.
///
/// # Errors
/// Coordinates that are on no globe.
pub fn wanted_site(place: Option<&str>) -> Result<Wanted, Problem> {
    let Some(text) = place else {
        return Ok(Wanted::default());
    };
    let (at, name) = match coordinates(text) {
        Some(at) => {
            let at = at.map_err(|why| why.problem(Some("place"), text, "").of(&["place"]))?;
            (Some(at), None)
        }
        None => {
            let known = Place::find(text).and_then(|place| place.coordinates);
            (known, Some(text.to_owned()))
        }
    };
    Ok(Wanted {
        at,
        name,
        measure: None,
    })
}

/// The place at a point: a known place there, else the point of a grid. Italy has a grid, so its towns are points of it.
fn at(point: Coordinates, code: Option<&str>) -> Result<Place, NotFound> {
    let near = nearest(point);
    let is_wanted = |place: &&Place| code.is_none_or(|code| place.hazard.code() == code);
    let here = near
        .iter()
        .filter(|place| place.distance_km.is_some_and(|km| km <= SAME_PLACE_KM))
        .find(is_wanted);
    let is_in_italy = here.is_none_or(|place| matches!(place.hazard, PlaceHazard::Ntc2018 { .. }));
    if is_in_italy
        && code.is_none_or(|code| code == "ntc2018")
        && let Some(km) = grid::node_distance_km(point)
    {
        return Ok(on_grid(point, km));
    }
    here.cloned().ok_or_else(|| {
        let told = told(&near);
        let swapped = Coordinates {
            latitude_deg: point.longitude_deg,
            longitude_deg: point.latitude_deg,
        };
        let is_swapped = || is_on_globe(swapped) && !self::told(&nearest(swapped)).is_empty();
        let swapped = (told.is_empty() && is_swapped()).then_some(swapped);
        NotFound::Far(told, swapped)
    })
}

/// Up to three of the nearest places, unless they are too far away.
fn told(nearest: &[Place]) -> Vec<(String, f64)> {
    let near = nearest
        .iter()
        .filter(|place| place.distance_km.is_some_and(|km| km <= NEAR_KM));
    near.take(3)
        .filter_map(|place| Some((place.full_name(), place.distance_km?)))
        .collect()
}

fn on_grid(point: Coordinates, km: f64) -> Place {
    let (latitude, longitude) = (
        number(point.latitude_deg, 7),
        number(point.longitude_deg, 7),
    );
    Place {
        name: format!("{latitude}, {longitude}").into(),
        other_names: "",
        region: "",
        country: "Italy",
        hazard: PlaceHazard::Ntc2018 { at: point },
        size: Size::City,
        source: "NTC 2018, annex B of NTC 2008 (INGV MPS04): four nodes weighted by 1/d".into(),
        confidence: Confidence::Interpolated,
        coordinates: Some(point),
        distance_km: Some(km),
        fault_distance_km: None,
        derived: None,
    }
}

/// The places whose coordinates are known, the nearest to a point first, each with its distance.
pub fn nearest(point: Coordinates) -> Vec<Place> {
    let mut found: Vec<Place> = places()
        .iter()
        .filter_map(|place| {
            let km = place.coordinates?.distance_km(point);
            Some(Place {
                distance_km: Some(km),
                ..place.clone()
            })
        })
        .collect();
    // The first of two tables comes first.
    found.sort_by(|a, b| {
        a.distance_km
            .unwrap_or(0.0)
            .total_cmp(&b.distance_km.unwrap_or(0.0))
    });
    found
}

/// Why a name is in no table. Of the names of a country alone, those are near that differ little from what stands before the
/// country, or before the first comma: the province may be wrong.
fn unknown(text: &str) -> NotFound {
    let wanted = canonical(text);
    let mut countries: Vec<&'static str> = places().iter().map(|place| place.country).collect();
    countries.dedup();
    let split = wanted.match_indices(' ').find_map(|(at, _)| {
        let mut all = countries.iter();
        let country = all.find(|country| is_country(&wanted[at + 1..], country))?;
        Some((&wanted[..at], *country))
    });
    let Some((name, country)) = split else {
        return NotFound::Unknown(near(text, None), None);
    };
    let mut found = near(name, Some(country));
    if found.is_empty()
        && let Some((first, _)) = text.split_once(',')
    {
        found = near(first, Some(country));
    }
    NotFound::Unknown(found, Unlisted::of(country))
}

/// Up to three places, of all or of one country, that a misspelt name may mean, the nearest first: one letter differs, two of
/// more than eight, or a name of the table by hand begins with what was written.
pub(super) fn near(name: &str, country: Option<&str>) -> Vec<String> {
    let wanted = canonical(name);
    let length = wanted.chars().count();
    let slips = if length > 8 { 2 } else { 1 };
    let mut found: Vec<(usize, &Place, bool)> = Vec::new();
    for (row, place) in places().iter().enumerate() {
        if country.is_some_and(|country| place.country != country) {
            continue;
        }
        let is_by_hand = row < by_hand();
        let distance = place.names().filter_map(|name| {
            let name = canonical(name);
            let distance = strsim::levenshtein(&wanted, &name);
            let is_near = length >= 3 && distance <= slips;
            (is_near || is_by_hand && length >= 3 && name.starts_with(&wanted)).then_some(distance)
        });
        let is_new = || found.iter().all(|(_, other, _)| other.name != place.name);
        if let Some(distance) = distance.min()
            && is_new()
        {
            found.push((distance, place, is_by_hand));
        }
    }
    found.sort_by_key(|(distance, ..)| *distance);
    let name = |place: &Place, is_by_hand: bool| match is_by_hand {
        true => place.name.to_string(),
        false => place.full_name(),
    };
    found
        .into_iter()
        .take(3)
        .map(|(_, place, is_by_hand)| name(place, is_by_hand))
        .collect()
}
