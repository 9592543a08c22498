//! `place list` and `place show`: the places whose hazard is known.

use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::canonical;
use freestand_input::written::Written;
use freestand_output::answer_of;
use freestand_study::places::{NotFound, Place, coordinates, is_country, nearest, places};

use crate::files::Files;
use crate::request::{Question, Request as _, reader, request};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.place/1";

/// Places with their hazard.
#[derive(Debug)]
pub struct Found(pub Vec<Place>);

answer_of!(Found as found {
    places: Vec<&Place> = found.0.iter().collect();
});

request! { question
    /// All places, or those of a country or a code.
    pub struct PlaceList {
        /// Country or code, such as greece or asce7
        #[arg(value_name = "WORD")]
        pub word: Option<Written>,
        /// Only the places of a country, such as Türkiye
        pub country = "NAME",
        /// The 20 places nearest to these coordinates, such as "41.01, 28.97"; places without coordinates are left out
        pub near = "COORDINATES",
    }
}

request! { question
    /// One place.
    pub struct PlaceShow {
        /// Name of the place, or its coordinates
        #[arg(value_name = "NAME", allow_hyphen_values = true)]
        pub name: Option<Written>,
    }
}

/// How many places are told of coordinates.
const NEAREST: usize = 20;

impl Question for PlaceList {
    type Meant = Vec<Place>;

    fn resolve(&self, _: &Files) -> Result<Self::Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let point = read.one("near").map(|text| {
            let found = coordinates(text)
                .unwrap_or(Err(NotFound::NoCoordinates))
                .map_err(|why| told(&why, text).of(&["near"]));
            read.problems.keep(found)
        });
        let mut found = match point {
            None => places().to_vec(),
            Some(point) => point.map(nearest).unwrap_or_default(),
        };
        if let Some(country) = read.one("country") {
            let wanted = canonical(country);
            let chosen = listed(&found, country, |place| is_country(&wanted, place.country));
            found = read
                .problems
                .keep(chosen.map_err(|problem| problem.of(&["country"])))
                .unwrap_or_default();
        }
        if let Some(word) = read.one("word").filter(|_| read.problems.is_empty()) {
            let chosen = listed(&found, word, |place| is_of(place, word));
            found = read
                .problems
                .keep(chosen.map_err(|problem| problem.of(&["word"])))
                .unwrap_or_default();
        }
        if point.is_some() {
            found.truncate(NEAREST);
        }
        read.problems.finish(Some(found))
    }
}

impl Question for PlaceShow {
    type Meant = Place;

    fn resolve(&self, _: &Files) -> Result<Self::Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        if !read.has("name") {
            let hint = "name one, such as Melbourne; freestand place list shows all of them";
            read.missing(&["name"], "no place is named", hint);
        }
        let found = read.one("name").and_then(|name| {
            let found = shown(name).map_err(|problem| problem.of(&["name"]));
            read.problems.keep(found)
        });
        read.problems.finish(found)
    }
}

/// Whether a place is of a country, a state or a code.
fn is_of(place: &Place, word: &str) -> bool {
    let plain = |text: &str| canonical(text).replace(' ', "");
    let wanted = plain(word);
    is_country(&canonical(word), place.country)
        || [
            place.country,
            place.region,
            place.hazard.code(),
            place.hazard.code_title(),
        ]
        .iter()
        .any(|one| !one.is_empty() && plain(one) == wanted)
}

/// Some of the places.
fn listed(
    all: &[Place],
    word: &str,
    is_of: impl Fn(&Place) -> bool,
) -> Result<Vec<Place>, Problem> {
    let found: Vec<Place> = all.iter().filter(|place| is_of(place)).cloned().collect();
    if found.is_empty() {
        let mut countries: Vec<&str> = Vec::new();
        for place in places() {
            if !countries.contains(&place.country) {
                countries.push(place.country);
            }
        }
        let message = format!("no place is in \"{}\"", shorten(word));
        let hint = format!("countries: {}", countries.join(", "));
        return Err(Problem::value(message, hint));
    }
    Ok(found)
}

fn shown(name: &str) -> Result<Place, Problem> {
    Place::look_up(name, None).map_err(|why| told(&why, name))
}

fn told(why: &NotFound, text: &str) -> Problem {
    let bring =
        "a peak ground acceleration, a code with its values or a spectrum can be given instead";
    why.problem(None, text, bring)
}
