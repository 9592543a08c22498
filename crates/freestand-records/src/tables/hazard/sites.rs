//! Where the sites of a file are, and which of them is meant.

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{canonical, counted, number, shortest};

use super::GroundMeasure;

/// A point on WGS 84.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coordinates {
    /// Latitude, north positive \[degrees\].
    pub latitude_deg: f64,
    /// Longitude, east positive \[degrees\].
    pub longitude_deg: f64,
}

/// The mean radius of the Earth \[km\].
const EARTH_KM: f64 = 6371.0;

impl Coordinates {
    /// The distance on a sphere \[km\].
    ///
    /// # Example
    /// ```
    /// use freestand_records::tables::hazard::Coordinates;
    /// let at = |latitude_deg, longitude_deg| Coordinates { latitude_deg, longitude_deg };
    /// assert!((at(41.0, 29.0).distance_km(at(42.0, 29.0)) - 111.19).abs() < 0.01);
    /// ```
    pub fn distance_km(self, other: Self) -> f64 {
        let [phi, other_phi] = [self, other].map(|one| one.latitude_deg.to_radians());
        let half = |from: f64, to: f64| (0.5 * (to - from)).sin().powi(2);
        let longitude = half(
            self.longitude_deg.to_radians(),
            other.longitude_deg.to_radians(),
        );
        let h = half(phi, other_phi) + phi.cos() * other_phi.cos() * longitude;
        2.0 * EARTH_KM * h.sqrt().min(1.0).asin()
    }

    /// As a person writes them: `41.01, 28.97`.
    pub fn words(self) -> String {
        format!(
            "{}, {}",
            shortest(self.latitude_deg),
            shortest(self.longitude_deg)
        )
    }
}

/// The values of a site of a file hold so far away \[km\]: half the diagonal of a cell of 0.2°, the coarsest
/// grid that is published, at the equator (15.7 km), and a town.
pub const FARTHEST_KM: f64 = 20.0;

/// Sites that are nearer to each other are one \[km\]: files have five decimals of a degree.
const SAME_KM: f64 = 0.01;

/// Which site is meant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Wanted {
    /// Where it is.
    pub at: Option<Coordinates>,
    /// Its name, for files that have names.
    pub name: Option<String>,
    /// The measure of curves that do not state theirs.
    pub measure: Option<GroundMeasure>,
}

/// A site of a file.
pub(super) struct Site {
    /// Its line, from 1.
    pub(super) line: Option<usize>,
    pub(super) name: Option<String>,
    pub(super) at: Option<Coordinates>,
}

/// The site that is meant.
pub(super) struct Chosen {
    /// Its place among the sites.
    pub(super) index: usize,
    /// How far away it is \[km\].
    pub(super) distance_km: Option<f64>,
}

impl Chosen {
    /// Not by its distance.
    fn named(index: usize) -> Self {
        Self {
            index,
            distance_km: None,
        }
    }
}

/// The site that is meant.
pub(super) fn chosen(sites: &[Site], wanted: &Wanted) -> Result<Chosen, Problem> {
    let example = sites.iter().find_map(|site| match (&site.name, site.at) {
        (_, Some(at)) => Some(at.words()),
        (Some(name), None) => Some(name.clone()),
        (None, None) => None,
    });
    let hint = format!(
        "name one, such as `place = \"{}\"`",
        example.unwrap_or_default()
    );
    let named = wanted.name.as_deref().map(canonical);
    let by_name: Vec<usize> = sites
        .iter()
        .enumerate()
        .filter(|(_, site)| {
            named.is_some() && site.name.as_deref().map(canonical).as_ref() == named.as_ref()
        })
        .map(|(k, _)| k)
        .collect();
    if let [only] = by_name[..] {
        return Ok(Chosen::named(only));
    }
    let Some(at) = wanted.at else {
        return match (sites.len(), &wanted.name) {
            (0, _) => Err(Problem::format("the file has no site", "download it again")),
            (1, None) => Ok(Chosen::named(0)),
            (_, Some(name)) if by_name.is_empty() => {
                let message = format!("the file has no site \"{}\"", shorten(name));
                Err(Problem::value(message, hint).of(&["place"]))
            }
            (many, _) => {
                let message = format!("the file has {}", counted(many, "site"));
                Err(Problem::value(message, hint).of(&["place"]))
            }
        };
    };
    let mut found: Vec<(usize, f64)> = sites
        .iter()
        .enumerate()
        .filter_map(|(k, site)| Some((k, site.at?.distance_km(at))))
        .collect();
    found.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    let Some(&(nearest, km)) = found.first() else {
        // The one site of a file that does not say where it is.
        return match sites.len() {
            1 => Ok(Chosen::named(0)),
            _ => Err(
                Problem::value("the sites of the file have names, not coordinates", hint)
                    .of(&["place"]),
            ),
        };
    };
    if km.is_nan() || km > FARTHEST_KM {
        let there = sites[nearest]
            .at
            .map_or_else(String::new, Coordinates::words);
        let message = format!(
            "the file has no site at {}: the nearest, {there}, is {} km away",
            at.words(),
            number(km, 3)
        );
        let hint = format!(
            "its values hold for {} km; give a file with the place, or its site: `place = \"{there}\"`",
            number(FARTHEST_KM, 3)
        );
        return Err(Problem::value(message, hint).of(&["place"]));
    }
    let twin = found.get(1).and_then(|&(other, other_km)| {
        let apart = sites[other].at?.distance_km(sites[nearest].at?);
        (apart < SAME_KM && other_km - km < SAME_KM).then_some(other)
    });
    if let Some(twin) = twin {
        let there = sites[nearest]
            .at
            .map_or_else(String::new, Coordinates::words);
        let problem = Problem::format(
            format!("two sites of the file are at {there}"),
            "leave one of them in the file",
        );
        return Err(match sites[twin].line {
            Some(line) => problem.at_line(line),
            None => problem,
        });
    }
    Ok(Chosen {
        index: nearest,
        distance_km: Some(km),
    })
}
