//! `place list` and `place show`: the places whose hazard is known.

use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::written::Written;
use freestand_output::answer_of;
use freestand_study::places::{Place, near, places};

use crate::files::Files;
use crate::request::{Question, Request as _, reader, request};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.place/1";

/// Places with their hazard.
#[derive(Debug)]
pub struct Found(pub Vec<&'static Place>);

answer_of!(Found as found {
    places: Vec<&'static Place> = found.0.clone();
});

request! { question
    /// All places, or those of a country or a code.
    pub struct PlaceList {
        /// Country or code, such as greece or asce7
        #[arg(value_name = "WORD")]
        pub word: Option<Written>,
    }
}

request! { question
    /// One place.
    pub struct PlaceShow {
        /// Name of the place
        #[arg(value_name = "NAME")]
        pub name: Option<Written>,
    }
}

impl Question for PlaceList {
    type Meant = Vec<&'static Place>;

    fn resolve(&self, _: &Files) -> Result<Self::Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let found = match read.one("word").map(listed) {
            None => Some(places().iter().collect()),
            Some(found) => {
                let found = found.map_err(|problem| problem.of(&["word"]));
                read.problems.keep(found)
            }
        };
        read.problems.finish(found)
    }
}

impl Question for PlaceShow {
    type Meant = &'static Place;

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

/// The places of a country or a code.
fn listed(word: &str) -> Result<Vec<&'static Place>, Problem> {
    let plain = |text: &str| {
        text.to_lowercase()
            .chars()
            .filter(|c| c.is_alphanumeric())
            .collect::<String>()
    };
    let wanted = plain(word);
    let is_of = |place: &&Place| {
        [
            place.country,
            place.region,
            place.hazard.code(),
            place.hazard.code_title(),
        ]
        .iter()
        .any(|one| !one.is_empty() && plain(one) == wanted)
    };
    let found: Vec<&Place> = places().iter().filter(is_of).collect();
    if found.is_empty() {
        let mut countries: Vec<&str> = places().iter().map(|place| place.country).collect();
        countries.dedup();
        let message = format!("no place is in \"{}\"", shorten(word));
        let hint = format!("countries: {}", countries.join(", "));
        return Err(Problem::value(message, hint));
    }
    Ok(found)
}

fn shown(name: &str) -> Result<&'static Place, Problem> {
    Place::find(name).ok_or_else(|| {
        let hint = match near(name).as_slice() {
            [] => "freestand place list shows all of them".to_owned(),
            names => format!("did you mean {}?", names.join(" or ")),
        };
        let message = format!("\"{}\" is not in the table of places", shorten(name));
        Problem::value(message, hint)
    })
}
