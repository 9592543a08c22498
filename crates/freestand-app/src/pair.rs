//! `motion rotate` and `motion rotd`: two horizontal components.

use freestand::synthesis::DAMPING_RATIO;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, parse_grid};
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_records::processing::azimuth_deg;
use freestand_study::inspect::{RotdRequest, check_percentiles};
use freestand_study::pair::{PairFiles, ReadPair, RotateRequest, read_pair};
use freestand_study::recorded::{MotionFiles, Second};
use schemars::JsonSchema;
use serde::Serialize;

use crate::files::Files;
use crate::motion::{Converted, FORMATS, Format, Meant, inputs, periods, recorded};
use crate::records::{Records, components};
use crate::request::{Question, Request, one_of, reader, request};

/// The schema of the response of `motion rotate`.
pub const ROTATE: &str = "freestand.motion-rotate/1";
/// The schema of the response of `motion rotd`.
pub const ROTD: &str = "freestand.motion-rotd/1";

request! {
    /// Two horizontal components, from one file or from two.
    // A pair is never rotated while it is read: the flag is known only to be refused with a hint.
    #[command(
        mut_arg("azimuth", |arg| arg.hide(true)),
        mut_arg("component", |arg| arg.help("Component to read from each of two files, by name or by number (from 1)"))
    )]
    pub struct PairKeys under "Reading records" {
        /// A record with two horizontal components, or two records with one each
        #[arg(value_name = "FILE")]
        pub motion: Vec<Written>,
        /// The two components to read from one file with several: names or numbers, such as "1, 2"
        pub components = "NAME, NAME",
        /// How the records are read.
        #[command(flatten)]
        pub records: Records,
    }
}

request! { question
    /// The component of a pair in another direction.
    pub struct Rotate {
        /// The pair.
        #[command(flatten)]
        pub pair: PairKeys,
        /// Azimuth of the new component, clockwise from north
        pub to = "ANGLE",
        /// Azimuths of the two components [default: those stated in the files]
        pub azimuths = "ANGLE, ANGLE",
        /// Format to write [default: csv]
        pub format = "FORMAT" with (value_parser = one_of(FORMATS)),
    }
}

request! { question
    /// The response spectra of a pair over all directions.
    // Two components have no common factor to a target: these flags are known only to be refused with
    // a hint.
    #[command(
        mut_arg("scale_to", |arg| arg.hide(true)),
        mut_arg("scale_to_sa", |arg| arg.hide(true)),
        mut_arg("scale_to_spectrum", |arg| arg.hide(true))
    )]
    pub struct Rotd {
        /// The pair.
        #[command(flatten)]
        pub pair: PairKeys,
        /// Percentiles over the directions: 50 is the median, 100 the largest [default: 50, 100]
        pub percentiles = "LIST",
        /// Damping ratio [default: 5 %]
        pub damping = "RATIO",
        /// Periods: from:to:count or a list [default: 0 s and 121 from 0.05 s to 5 s]
        pub periods = "GRID",
    }
}

impl PairKeys {
    /// The files of the pair, which have not been read, and all files that are read.
    fn files(&self, read: &mut WordReader<'_>, files: &Files) -> Meant<PairFiles> {
        let named = recorded(read, &self.motion, &self.records, files);
        read.exclusive("component", "components");
        let both = read.text("components").map(components);
        let both = both.and_then(|both| read.keep("components", both));
        let asked = PairFiles {
            files: MotionFiles {
                paths: named.paths(),
                ..named.how().clone()
            },
            components: match both.clone() {
                Some(Second::SameFile(called)) => called,
                _ => None,
            },
        };
        read.problems.keep_comparisons(asked.check());
        if named.count() == 2 && both == Some(Second::SameFile(None)) {
            let message =
                "`components` chooses two components of one file, but two files are given";
            let hint = "choose one of each file with `component`";
            read.note(&["components"], message, hint);
        }
        let inputs = inputs(&named, &self.records, files);
        Meant { asked, inputs }
    }
}

/// A pair that is turned: its files, or what they have.
#[derive(Debug)]
pub struct Turning<P> {
    /// The pair.
    pub pair: P,
    /// The direction.
    pub request: RotateRequest,
    /// The format of the file that is written.
    pub format: Format,
}

impl Question for Rotate {
    type Meant = Meant<Turning<ReadPair>>;

    fn resolve(&self, files: &Files) -> Result<Self::Meant, Problems> {
        let Meant { asked, inputs } = self.judged(files)?;
        Ok(Meant {
            asked: Turning {
                pair: read_pair(&asked.pair)?,
                request: asked.request,
                format: asked.format,
            },
            inputs,
        })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.judged(files).map(drop)
    }
}

impl Rotate {
    fn judged(&self, files: &Files) -> Result<Meant<Turning<PairFiles>>, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let pair = self.pair.files(&mut read, files);
        let of_azimuth = |problem: &&mut Problem| problem.is_about("azimuth");
        for problem in read.problems.problems.iter_mut().filter(of_azimuth) {
            problem.hint =
                Some("leave it out: the azimuth of the new component is `to`".to_owned());
        }
        let hint = "give the azimuth of the new component, such as `to = \"30 deg\"`";
        read.require("to", "`to` is missing", hint);
        let to = read.quantity("to", Dimension::Angle);
        let hint = "write \"0 deg, 90 deg\", clockwise from north";
        let azimuths = read.two("azimuths", Dimension::Angle, hint);
        let format = read.choice("format", FORMATS).unwrap_or(Format::Csv);
        let request = to.map(|to| RotateRequest {
            azimuth_deg: azimuth_deg(to),
            azimuths_deg: azimuths.map(|(one, two)| (azimuth_deg(one), azimuth_deg(two))),
        });
        let request = read.problems.finish(request)?;
        let Meant { asked, inputs } = pair;
        Ok(Meant {
            asked: Turning {
                pair: asked,
                request,
                format,
            },
            inputs,
        })
    }
}

impl Question for Rotd {
    type Meant = Meant<(ReadPair, RotdRequest)>;

    fn resolve(&self, files: &Files) -> Result<Self::Meant, Problems> {
        let (pair, request) = self.judged(files)?;
        Ok(Meant {
            asked: (read_pair(&pair.asked)?, request),
            inputs: pair.inputs,
        })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.judged(files).map(drop)
    }
}

impl Rotd {
    fn judged(&self, files: &Files) -> Result<(Meant<PairFiles>, RotdRequest), Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let pair = self.pair.files(&mut read, files);
        for key in ["scale_to", "scale_to_sa", "scale_to_spectrum"] {
            if read.has(key) {
                let message = format!("`{key}` would give each of two components its own factor");
                read.note(&[key], message, "give the factor itself with `scale`");
            }
        }
        let damping_ratio = read.accepted(
            "damping",
            Dimension::Ratio,
            |ratio| (0.0..1.0).contains(&ratio),
            ["from 0 to below 1", "from 0 to below 1"],
        );
        let request = RotdRequest {
            damping_ratio: damping_ratio.unwrap_or(DAMPING_RATIO),
            periods_s: periods(&mut read),
            percentiles: percentiles(&mut read),
        };
        read.problems.finish(Some((pair, request)))
    }
}

/// Percentiles over the directions: 50 and 50 % are the same.
fn percentiles(read: &mut WordReader<'_>) -> Vec<f64> {
    let found = match read.text("percentiles") {
        Some(text) if text.contains('%') => {
            let plain = parse_grid(&text.replace('%', ""), Dimension::Ratio);
            read.keep("percentiles", plain)
        }
        _ => read.grid("percentiles", Dimension::Ratio),
    };
    let found = found.unwrap_or_else(|| vec![50.0, 100.0]);
    read.keep("percentiles", check_percentiles(&found));
    found
}

/// Two components turned into one direction.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RotateReport {
    /// The direction, clockwise from north \[°\].
    pub azimuth_deg: f64,
    /// The motion in it.
    #[serde(flatten)]
    pub motion: Converted,
}
