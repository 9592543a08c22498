//! Maps as GeoTIFF: doubles on a grid of longitude and latitude, as GEM publishes its global map.

use std::io::Cursor;
use std::path::Path;

use freestand_input::problem::Problem;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

use super::numbers::{Value, spectrum};
use super::sites::Wanted;
use super::{Coordinates, HazardFormat, SiteHazard};

const DOWNLOAD: &str = "download the map again; only GeoTIFF without compression is read";

/// The value of the cell that holds the point. The file does not say what it is: its name does, as
/// `v2023_1_pga_475_rock_3min.tif`.
pub(super) fn read(bytes: &[u8], path: &Path, wanted: &Wanted) -> Result<SiteHazard, Problem> {
    let Some(at) = wanted.at else {
        let message = "the file is a map, and no point on it is named";
        let hint = "name one, such as `place = \"41.01, 28.97\"`";
        return Err(Problem::value(message, hint).of(&["place"]));
    };
    let years = named_years(path)?;
    let damaged =
        |error: tiff::TiffError| Problem::format(format!("the TIFF is damaged: {error}"), DOWNLOAD);
    let mut limits = Limits::default();
    // One strip or tile is decoded, never the map.
    limits.decoding_buffer_size = 64 << 20;
    let mut decoder = Decoder::new(Cursor::new(bytes))
        .map_err(damaged)?
        .with_limits(limits);
    let (width, height) = decoder.dimensions().map_err(damaged)?;
    let missing = |what: &str| {
        let message =
            format!("the TIFF does not have {what}, so nothing says where its values are");
        Problem::format(
            message,
            "give a GeoTIFF in degrees of longitude and latitude",
        )
    };
    let scale = decoder
        .get_tag_f64_vec(Tag::ModelPixelScaleTag)
        .map_err(|_| missing("the size of its cells"))?;
    let tie = decoder
        .get_tag_f64_vec(Tag::ModelTiepointTag)
        .map_err(|_| missing("the place of its corner"))?;
    let (&[dx, dy, ..], &[0.0, 0.0, _, west, north, ..]) = (&scale[..], &tie[..]) else {
        return Err(missing("the place of its north-western corner"));
    };
    let is_fine = dx > 0.0 && dy > 0.0 && west.abs() <= 360.0 && north.abs() <= 90.5;
    if !is_fine {
        return Err(missing("degrees of longitude and latitude"));
    }
    let column = (at.longitude_deg - west).rem_euclid(360.0) / dx;
    let row = (north - at.latitude_deg) / dy;
    if !(0.0..f64::from(width)).contains(&column) || !(0.0..f64::from(height)).contains(&row) {
        let message = format!("{} lies outside the map", at.words());
        return Err(Problem::value(message, "give a map that has the place").of(&["place"]));
    }
    let (column, row) = (column as u32, row as u32);
    let (chunk_width, chunk_height) = decoder.chunk_dimensions();
    if chunk_width == 0 || chunk_height == 0 {
        return Err(Problem::format(
            "the TIFF is damaged: its strips are empty",
            DOWNLOAD,
        ));
    }
    let across = width.div_ceil(chunk_width);
    let chunk = row / chunk_height * across + column / chunk_width;
    let (data_width, _) = decoder.chunk_data_dimensions(chunk);
    let index =
        (row % chunk_height) as usize * data_width as usize + (column % chunk_width) as usize;
    let number = match decoder.read_chunk(chunk).map_err(damaged)? {
        DecodingResult::F64(values) => values.get(index).copied(),
        DecodingResult::F32(values) => values.get(index).copied().map(f64::from),
        _ => {
            let message = "the cells of the TIFF are not floating-point numbers";
            return Err(Problem::format(
                message,
                "give the map of accelerations in g, not a picture of it",
            ));
        }
    };
    let number = number
        .ok_or_else(|| Problem::format("the TIFF is damaged: a strip is too short", DOWNLOAD))?;
    // Where nothing was calculated, as on the sea, maps have NaN or a large negative number.
    if number.is_nan() || number <= 0.0 {
        let message = format!("the map has no value at {}", at.words());
        return Err(Problem::value(message, "name a point on land").of(&["place"]));
    }
    let centre = Coordinates {
        latitude_deg: north - (f64::from(row) + 0.5) * dy,
        longitude_deg: (west + (f64::from(column) + 0.5) * dx + 180.0).rem_euclid(360.0) - 180.0,
    };
    let place = format!("the cell at {}", centre.words());
    let value = Value {
        number,
        place,
        line: None,
    };
    Ok(SiteHazard {
        sites: width as usize * height as usize,
        at: Some(centre),
        distance_km: Some(centre.distance_km(at)),
        spectra: vec![spectrum(Some(years), [(0.0, value)])?],
        ..SiteHazard::of(HazardFormat::Geotiff)
    })
}

/// The return period of a map of PGA, by its name.
fn named_years(path: &Path) -> Result<f64, Problem> {
    let name = path
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    let words: Vec<&str> = name.split(|c: char| !c.is_ascii_alphanumeric()).collect();
    let after = words.iter().position(|word| *word == "pga");
    // Below 30 years it is a number of the version, above 100 000 a date.
    let years = after.and_then(|at| {
        let mut rest = words[at + 1..].iter();
        rest.find_map(|word| {
            word.parse::<f64>()
                .ok()
                .filter(|years| (30.0..1e5).contains(years))
        })
    });
    years.ok_or_else(|| {
        let message = "the name of the map does not say that it is PGA, and at which return period";
        let hint = "keep the name that GEM gave it, such as v2023_1_pga_475_rock_3min.tif";
        Problem::format(message, hint)
    })
}
