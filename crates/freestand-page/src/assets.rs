//! The page, embedded. It holds no secret, so it needs no token.

use std::io::Read;

use bytes::Bytes;
use flate2::read::GzDecoder;
use hyper::header::{
    ACCEPT_ENCODING, CACHE_CONTROL, CONTENT_ENCODING, ETAG, HeaderValue, IF_NONE_MATCH, VARY,
};
use hyper::{HeaderMap, StatusCode};
use sha2::{Digest, Sha256};

use crate::reply::{Answered, Content, response};

/// An embedded file. It is packed, as every browser takes it: the program is smaller by a quarter of a megabyte.
struct Asset {
    path: &'static str,
    content_type: &'static str,
    packed: &'static [u8],
}

impl Asset {
    /// The file as it is.
    fn plain(&self) -> Option<Vec<u8>> {
        let mut plain = Vec::new();
        GzDecoder::new(self.packed).read_to_end(&mut plain).ok()?;
        Some(plain)
    }
}

/// The film in three dimensions, which is loaded only where a body is shown.
const FILM: &str = "/assets/film.js";

/// One file of `ui/dist`, which `cargo xtask ui` makes.
macro_rules! asset {
    ($path:expr, $file:literal, $content_type:literal) => {
        Asset {
            path: $path,
            content_type: $content_type,
            packed: include_bytes!(concat!("../ui/dist/", $file, ".gz")),
        }
    };
}

static ASSETS: [Asset; 5] = [
    asset!("/", "index.html", "text/html; charset=utf-8"),
    asset!(
        "/assets/app.js",
        "assets/app.js",
        "text/javascript; charset=utf-8"
    ),
    asset!(FILM, "assets/film.js", "text/javascript; charset=utf-8"),
    asset!(
        "/assets/app.css",
        "assets/app.css",
        "text/css; charset=utf-8"
    ),
    asset!("/assets/icon.svg", "assets/icon.svg", "image/svg+xml"),
];

/// The file at a path of the table; `None` where there is none.
pub(crate) fn asset(path: &str, headers: &HeaderMap) -> Option<Answered> {
    let asset = ASSETS.iter().find(|asset| asset.path == path)?;
    let accepts = |header: &HeaderValue| {
        header
            .to_str()
            .is_ok_and(|text| text.split(',').any(is_gzip))
    };
    let is_packed = headers.get_all(ACCEPT_ENCODING).iter().any(accepts);
    let bytes = match is_packed {
        true => Bytes::from_static(asset.packed),
        false => asset.plain()?.into(),
    };
    let tag = format!("\"{}\"", hex(&Sha256::digest(&bytes)));
    let tag = HeaderValue::from_str(&tag).ok()?;
    let is_known = headers
        .get_all(IF_NONE_MATCH)
        .iter()
        .any(|known| known == tag);
    let (status, content) = match is_known {
        true => (StatusCode::NOT_MODIFIED, None),
        false => (StatusCode::OK, Some(bytes)),
    };
    let mut answer = response(status, asset.content_type, Content::Whole(content));
    let own = answer.headers_mut();
    // The next version of freestand may be at the same address.
    own.insert(CACHE_CONTROL, HeaderValue::from_static("no-cache"));
    own.insert(VARY, HeaderValue::from_static("accept-encoding"));
    own.insert(ETAG, tag);
    if is_packed {
        own.insert(CONTENT_ENCODING, HeaderValue::from_static("gzip"));
    }
    Some(answer)
}

/// `gzip`, unless its weight is 0.
fn is_gzip(offer: &str) -> bool {
    let mut parts = offer.split(';').map(str::trim);
    let is_named = parts
        .next()
        .is_some_and(|name| name.eq_ignore_ascii_case("gzip"));
    let is_refused = parts.any(|part| {
        let weight = part
            .strip_prefix("q=")
            .and_then(|weight| weight.parse::<f64>().ok());
        weight.is_some_and(|weight| weight <= 0.0)
    });
    is_named && !is_refused
}

/// Bytes as hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A page that was changed without its packed form would be two pages.
    #[test]
    fn packed_files_are_the_plain_ones() {
        for asset in &ASSETS {
            let file = if asset.path == "/" {
                "/index.html"
            } else {
                asset.path
            };
            let made = concat!(env!("CARGO_MANIFEST_DIR"), "/ui/dist").to_owned() + file;
            let plain = asset.plain().unwrap();
            assert!(
                plain == std::fs::read(made).unwrap(),
                "{file}: run cargo xtask ui"
            );
        }
    }

    /// First load: 150 kB and 6 requests at most.
    #[test]
    fn the_page_is_small() {
        let first: Vec<&Asset> = ASSETS.iter().filter(|asset| asset.path != FILM).collect();
        assert!(first.len() <= 6);
        assert!(first.iter().map(|asset| asset.packed.len()).sum::<usize>() <= 150_000);
        // Nothing of the film is in it.
        let is_three = |bytes: &[u8]| bytes.windows(13).any(|word| word == b"WebGLRenderer");
        assert!(first.iter().all(|asset| !is_three(&asset.plain().unwrap())));
    }

    #[test]
    fn gzip_is_offered_or_not() {
        assert!(is_gzip("gzip") && is_gzip(" GZIP;q=0.5"));
        assert!(!is_gzip("br") && !is_gzip("gzip;q=0") && !is_gzip("gzip; q=0.0"));
    }
}
