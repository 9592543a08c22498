//! Where large cities are, also those without values: for distances to places that have them, never for a hazard.

use std::sync::LazyLock;

use freestand_input::words::canonical;

use super::Coordinates;
use super::grid::inflated;

/// A city of 100,000 people and more.
pub(super) struct City {
    /// Its names in canonical words.
    pub(super) names: Vec<String>,
    pub(super) name: String,
    pub(super) country: String,
    pub(super) at: Coordinates,
}

/// The cities, the largest first (GeoNames, CC BY 4.0).
pub(super) fn cities() -> &'static [City] {
    static CITIES: LazyLock<Vec<City>> = LazyLock::new(|| {
        let bytes = inflated(include_bytes!("../../places/cities.csv.zlib")).unwrap_or_default();
        let text = String::from_utf8(bytes).unwrap_or_default();
        text.lines().filter_map(read).collect()
    });
    &CITIES
}

/// `name;other names;country;latitude;longitude`
fn read(line: &str) -> Option<City> {
    let fields: Vec<&str> = line.split(';').collect();
    let [name, others, country, latitude, longitude] = fields[..] else {
        return None;
    };
    let others = others.split(',').filter(|name| !name.is_empty());
    Some(City {
        names: std::iter::once(name).chain(others).map(canonical).collect(),
        name: name.to_owned(),
        country: country.to_owned(),
        at: Coordinates {
            latitude_deg: latitude.parse().ok()?,
            longitude_deg: longitude.parse().ok()?,
        },
    })
}
