//! Which files of a folder are the two horizontal components of one record.
//!
//! Names of components differ in one place. From the surest to the least sure: what their headers
//! say of station and direction; two letters for two directions; two azimuths at right angles; 1 and
//! 2 at the end.

use std::collections::BTreeMap;

use freestand_records::formats::{Component, Direction, Start};

/// Letters for two horizontal directions.
const DIRECTIONS: [(&str, &str); 8] = [
    ("N", "E"),
    ("NS", "EW"),
    ("X", "Y"),
    ("L", "T"),
    ("LN", "TR"),
    ("LONG", "TRAN"),
    ("FN", "FP"),
    ("NORTH", "EAST"),
];
/// Letters for the vertical.
const VERTICAL: [&str; 9] = ["UP", "UD", "DN", "DWN", "DOWN", "VER", "VERT", "V", "Z"];
/// How far two directions may be from a right angle \[degrees\]: the Lucerne record of 1992 has
/// components at 260 and 345 degrees.
const SKEW_DEG: f64 = 5.0 + 1e-9;

/// A file with one component.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Single {
    tokens: Vec<Token>,
    station: Option<String>,
    azimuth_deg: Option<f64>,
    /// First and last time, counted from 1970 \[s\].
    times_s: Option<(f64, f64)>,
}

/// Letters, digits or one other character of a name, in capitals.
#[derive(Debug, Clone, PartialEq)]
struct Token {
    text: String,
    kind: Kind,
    is_extension: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Letters,
    Digits,
    Other,
}

fn kind(c: char) -> Kind {
    match c {
        _ if c.is_alphabetic() => Kind::Letters,
        _ if c.is_ascii_digit() => Kind::Digits,
        _ => Kind::Other,
    }
}

impl Single {
    /// From the name of the file and its only component.
    pub(super) fn new(file_name: &str, component: &Component) -> Self {
        let azimuth_deg = match component.direction {
            Some(Direction::Azimuth(azimuth_deg)) => Some(azimuth_deg),
            Some(Direction::Up) | None => None,
        };
        let times_s = match component.start {
            Some(Start::Date(from_s)) => Some((from_s, from_s + component.motion.duration_s())),
            Some(Start::Column(_)) | None => None,
        };
        Self {
            tokens: tokens(file_name),
            station: component.station.clone(),
            azimuth_deg,
            times_s,
        }
    }

    /// Whether the name says that the component is vertical.
    pub(super) fn is_vertical(&self) -> bool {
        let is_up = |token: &Token| VERTICAL.contains(&token.text.as_str());
        let stem: Vec<&Token> = self
            .tokens
            .iter()
            .filter(|token| !token.is_extension)
            .collect();
        let seed =
            |token: &Token| token.kind == Kind::Letters && seed_axis(&token.text) == Some('Z');
        // V2 is a format, not a direction.
        let extension: Vec<&Token> = self
            .tokens
            .iter()
            .filter(|token| token.is_extension)
            .collect();
        let by_extension = match extension.as_slice() {
            [_dot, only] => is_up(only),
            [_dot, first, _sensor] => first.text == "UD",
            _ => false,
        };
        // A name of one word is that of an earthquake or of a place.
        let by_stem = matches!(stem.as_slice(), [_, .., last] if is_up(last) || seed(last));
        by_extension || by_stem
    }

    /// Nothing that the headers say speaks against a pair.
    fn may_go_with(&self, other: &Self) -> bool {
        let agree = |a: &Option<String>, b: &Option<String>| a.is_none() || b.is_none() || a == b;
        let turned = self
            .azimuth_deg
            .zip(other.azimuth_deg)
            .is_none_or(|(a, b)| is_right_angle(a, b));
        let at_one_time = self
            .times_s
            .zip(other.times_s)
            .is_none_or(|(a, b)| a.0 < b.1 && b.0 < a.1);
        turned && at_one_time && agree(&self.station, &other.station)
    }

    /// The file's possible places among pairs.
    fn places(&self) -> Vec<(Place, Mark)> {
        let mut places = Vec::new();
        let last = self.tokens.iter().rposition(|token| !token.is_extension);
        for (at, token) in self.tokens.iter().enumerate() {
            let mut add = |rule, kept: &str, mark| {
                let name = self
                    .tokens
                    .iter()
                    .enumerate()
                    .map(|(i, one)| if i == at { kept } else { &one.text });
                places.push((
                    Place {
                        rule,
                        at,
                        name: name.map(str::to_owned).collect(),
                    },
                    mark,
                ));
            };
            if let (Some(_), Some(azimuth_deg)) = (&self.station, self.azimuth_deg) {
                add(Rule::Header, "", Mark::Azimuth(azimuth_deg));
            }
            if token.kind == Kind::Letters {
                for (first, second) in DIRECTIONS {
                    if token.text == first || token.text == second {
                        add(
                            Rule::Letters,
                            first,
                            if token.text == first {
                                Mark::First
                            } else {
                                Mark::Second
                            },
                        );
                    }
                }
                let code: String = token.text.chars().take(2).collect();
                match seed_axis(&token.text) {
                    Some('N') => add(Rule::Letters, &code, Mark::First),
                    Some('E') => add(Rule::Letters, &code, Mark::Second),
                    _ => {}
                }
            }
            // Nor are dates and years numbers of components.
            let digits = token.text.as_str();
            let is_year =
                digits.len() == 4 && (digits.starts_with("19") || digits.starts_with("20"));
            if token.kind == Kind::Digits && !token.is_extension && !is_year && digits.len() < 8 {
                if let Some((start, azimuth)) = digits
                    .len()
                    .checked_sub(3)
                    .map(|start| digits.split_at(start))
                    && let Some(azimuth_deg) = azimuth
                        .parse()
                        .ok()
                        .filter(|deg| (0.0..=360.0).contains(deg))
                {
                    add(Rule::Azimuth, start, Mark::Azimuth(azimuth_deg));
                }
                let (start, end) = digits.split_at(digits.len() - 1);
                if Some(at) == last {
                    add(
                        Rule::Number,
                        start,
                        if end == "1" {
                            Mark::First
                        } else if end == "2" {
                            Mark::Second
                        } else {
                            Mark::Other
                        },
                    );
                }
            }
        }
        places
    }
}

/// What files of one pair have in common: all of the name but one part of one token.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    rule: Rule,
    at: usize,
    name: Vec<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Rule {
    Header,
    Letters,
    Azimuth,
    Number,
}

/// Where a file differs from its partner.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mark {
    First,
    Second,
    Azimuth(f64),
    Other,
}

impl Mark {
    fn goes_with(self, other: Self) -> bool {
        match (self, other) {
            (Self::First, Self::Second) | (Self::Second, Self::First) => true,
            (Self::Azimuth(a), Self::Azimuth(b)) => is_right_angle(a, b),
            _ => false,
        }
    }
}

fn is_right_angle(one_deg: f64, other_deg: f64) -> bool {
    ((one_deg - other_deg).rem_euclid(180.0) - 90.0).abs() <= SKEW_DEG
}

/// The last letter of a SEED channel of a seismometer or an accelerometer.
fn seed_axis(text: &str) -> Option<char> {
    match *text.as_bytes() {
        [_, b'L' | b'N' | b'G' | b'H', axis @ (b'E' | b'N' | b'Z')] => Some(char::from(axis)),
        _ => None,
    }
}

fn tokens(file_name: &str) -> Vec<Token> {
    let dot = file_name.rfind('.').unwrap_or(file_name.len());
    let mut tokens: Vec<Token> = Vec::new();
    for (at, c) in file_name.char_indices() {
        let (kind, is_extension) = (kind(c), at >= dot);
        let capitals = c.to_uppercase();
        match tokens.last_mut() {
            Some(last)
                if last.kind == kind
                    && kind != Kind::Other
                    && last.is_extension == is_extension =>
            {
                last.text.extend(capitals);
            }
            _ => tokens.push(Token {
                text: capitals.collect(),
                kind,
                is_extension,
            }),
        }
    }
    tokens
}

/// Each file once, in order, with its partner where it has one: always the later of the two. A file
/// has a partner if exactly two files share a place.
pub(super) fn pairs(singles: &[Single]) -> Vec<(usize, Option<usize>)> {
    let mut groups: BTreeMap<Place, Vec<(usize, Mark)>> = BTreeMap::new();
    for (index, single) in singles.iter().enumerate() {
        for (place, mark) in single.places() {
            groups.entry(place).or_default().push((index, mark));
        }
    }
    let mut partners: Vec<Option<usize>> = vec![None; singles.len()];
    // By rule, because the places are in that order.
    for group in groups.values() {
        if let &[(first, one), (second, other)] = group.as_slice()
            && one.goes_with(other)
            && partners[first].is_none()
            && partners[second].is_none()
            && singles[first].may_go_with(&singles[second])
        {
            partners[first] = Some(second);
            partners[second] = Some(first);
        }
    }
    let is_first =
        |(index, partner): &(usize, Option<usize>)| partner.is_none_or(|partner| partner > *index);
    partners.into_iter().enumerate().filter(is_first).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(name: &str) -> Single {
        Single {
            tokens: tokens(name),
            station: None,
            azimuth_deg: None,
            times_s: None,
        }
    }

    /// The pairs of files with these names, in order.
    fn paired(names: &[&str]) -> Vec<String> {
        let singles: Vec<Single> = names.iter().map(|name| named(name)).collect();
        let both = |(first, second): (usize, Option<usize>)| {
            Some(format!("{} {}", names[first], names[second?]))
        };
        pairs(&singles).into_iter().filter_map(both).collect()
    }

    #[test]
    fn names_of_the_usual_sources_are_paired() {
        for (first, second) in [
            ("120111.txt", "120112.txt"),
            ("kobe_1.csv", "kobe_2.csv"),
            ("kobe-H1.csv", "kobe-H2.csv"),
            (
                "RSN175_IMPVALL.H_H-E12140.AT2",
                "RSN175_IMPVALL.H_H-E12230.AT2",
            ),
            ("RSN953_NORTHR_MUL009.AT2", "RSN953_NORTHR_MUL279.AT2"),
            ("RSN879_LANDERS_LCN260.AT2", "RSN879_LANDERS_LCN345.AT2"),
            ("RSN1485_CHICHI_TCU045-E.AT2", "RSN1485_CHICHI_TCU045-N.AT2"),
            ("RSN1633_MANJIL_ABBAR--L.AT2", "RSN1633_MANJIL_ABBAR--T.AT2"),
            ("AOM0011801241951.EW", "AOM0011801241951.NS"),
            ("AICH040010061330.EW2", "AICH040010061330.NS2"),
            ("CI.CLC..HNE.mseed", "CI.CLC..HNN.mseed"),
            ("CI.CLC..HN1.mseed", "CI.CLC..HN2.mseed"),
            ("a.x", "a.y"),
        ] {
            assert_eq!(paired(&[first, second]), [format!("{first} {second}")]);
        }
        // Among others of the same station, in any number.
        let names = [
            "120111.txt",
            "120112.txt",
            "120121.txt",
            "120122.txt",
            "121211.txt",
            "121212.txt",
            "121221.txt",
        ];
        assert_eq!(
            paired(&names),
            [
                "120111.txt 120112.txt",
                "120121.txt 120122.txt",
                "121211.txt 121212.txt"
            ]
        );
        let sensors = ["A.EW1", "A.EW2", "A.NS1", "A.NS2"];
        assert_eq!(paired(&sensors), ["A.EW1 A.NS1", "A.EW2 A.NS2"]);
    }

    #[test]
    fn numbered_records_are_not_pairs() {
        for names in [
            &["quake1.csv", "quake2.csv", "quake3.csv"][..],
            &[
                "quake01.csv",
                "quake02.csv",
                "quake03.csv",
                "quake10.csv",
                "quake11.csv",
                "quake12.csv",
            ],
            &["kobe.csv", "northridge.csv"],
            &["station_2011.csv", "station_2012.csv"],
            &["20180212.csv", "20180302.csv"],
            &["a000.csv", "a090.csv", "a180.csv"],
            &["a.AT1", "a.AT2"],
            &["a_10.csv", "a_11.csv"],
        ] {
            assert_eq!(paired(names), [] as [String; 0], "{names:?}");
        }
    }

    #[test]
    fn headers_decide_where_they_speak() {
        let of = |name: &str, station: &str, azimuth_deg, from_s: f64| Single {
            station: Some(station.to_owned()),
            azimuth_deg: Some(azimuth_deg),
            times_s: Some((from_s, from_s + 60.0)),
            ..named(name)
        };
        let (a, c) = (
            of("0111a.smc", "S", 360.0, 0.0),
            of("0111c.smc", "S", 90.0, 0.0),
        );
        assert_eq!(pairs(&[a.clone(), c.clone()]), [(0, Some(1))]);
        for other in [
            of("0111c.smc", "S", 180.0, 0.0),
            of("0111c.smc", "T", 90.0, 0.0),
            of("0111c.smc", "S", 90.0, 61.0),
        ] {
            assert_eq!(pairs(&[a.clone(), other]), [(0, None), (1, None)]);
        }
        // The names fit, the directions do not.
        let (one, two) = (of("q_1.smc", "S", 0.0, 0.0), of("q_2.smc", "S", 0.0, 0.0));
        assert_eq!(pairs(&[one, two]), [(0, None), (1, None)]);
    }

    #[test]
    fn a_vertical_component_is_known_by_its_name() {
        for name in [
            "RSN175_IMPVALL.H_H-E12-UP.AT2",
            "A.UD",
            "A.UD1",
            "CLC.HNZ.csv",
            "quake_v.csv",
            "q-DWN.AT2",
        ] {
            assert!(named(name).is_vertical(), "{name}");
        }
        for name in [
            "quake.V2",
            "CE1.V2A",
            "up.d.csv",
            "v.csv",
            "nevada.csv",
            "kobe_1.csv",
        ] {
            assert!(!named(name).is_vertical(), "{name}");
        }
    }
}
