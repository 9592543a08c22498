//! `motion info`, `motion spectrum` and `motion convert`: what is in records.

use std::path::PathBuf;

use freestand::block::Block;
use freestand::synthesis::DAMPING_RATIO;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::words::Choices;
use freestand_input::written::Written;
use freestand_study::inspect::{InfoRequest, SpectrumReport, SpectrumRequest};
use freestand_study::recorded::{MotionFiles, ReadMotion};
use freestand_study::target::usual_periods_s;
use schemars::JsonSchema;
use serde::Serialize;

use crate::files::Files;
use crate::records::{NamedRecords, Records};
use crate::request::{Question, Request, one_of, reader, request};

/// The schema of the response of `motion info`.
pub const INFO: &str = "freestand.motion-info/1";
/// The schema of the response of `motion spectrum`.
pub const SPECTRUM: &str = "freestand.motion-spectrum/1";
/// The schema of the response of `motion convert`.
pub const CONVERT: &str = "freestand.motion-convert/1";

request! { question
    /// The contents and the measures of records.
    // Components are measured without rotation: the flag is known only to be refused with a hint.
    #[command(mut_arg("azimuth", |arg| arg.hide(true)))]
    pub struct MotionInfo {
        /// Records
        #[arg(value_name = "FILE")]
        pub motion: Vec<Written>,
        /// Height of a block, to see what the motions mean to it; needs --thickness
        pub height = "LENGTH",
        /// Thickness of the block, its horizontal size in the plane of rocking; needs --height
        pub thickness = "LENGTH",
        /// How the records are read.
        #[command(flatten)]
        pub records: Records,
    }
}

request! { question
    /// The response spectrum of a record.
    pub struct MotionSpectrum {
        /// Record
        #[arg(value_name = "FILE")]
        pub motion: Option<Written>,
        /// Damping ratio, or a list of ratios [default: 5 %]
        pub damping = "LIST",
        /// Periods: from:to:count or a list [default: 0 s and 121 from 0.05 s to 5 s]
        pub periods = "GRID",
        /// Replace each sample by N on the band-limited curve through the samples, for periods shorter
        /// than ten time steps [default: 1]
        pub upsample = "N",
        /// How the record is read.
        #[command(flatten)]
        pub records: Records,
    }
}

request! { question
    /// Records in another format.
    pub struct MotionConvert {
        /// Records
        #[arg(value_name = "FILE")]
        pub motion: Vec<Written>,
        /// Format to write
        pub to = "FORMAT" with (value_parser = one_of(FORMATS)),
        /// How the records are read.
        #[command(flatten)]
        pub records: Records,
    }
}

/// A format that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// time_s,accel_m_s2
    Csv,
    /// PEER AT2
    At2,
}

/// The formats by name.
pub const FORMATS: Choices<Format> = &[
    (Format::Csv, "csv", "time_s,accel_m_s2"),
    (Format::At2, "at2", "PEER AT2"),
];

/// What is asked of records, and the files that are read.
#[derive(Debug)]
pub struct Meant<T> {
    /// What is asked.
    pub asked: T,
    /// The files.
    pub inputs: Vec<PathBuf>,
}

impl Question for MotionInfo {
    type Meant = Meant<InfoRequest>;

    fn resolve(&self, files: &Files) -> Result<Self::Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let named = recorded(&mut read, &self.motion, &self.records, files);
        let asked = InfoRequest {
            files: MotionFiles {
                paths: named.paths(),
                ..named.how().clone()
            },
            block: block(&mut read),
            keep_motions: false,
        };
        let inputs = inputs(&named, &self.records, files);
        read.problems.finish(Some(Meant { asked, inputs }))
    }
}

impl Question for MotionSpectrum {
    type Meant = Meant<(ReadMotion, SpectrumRequest)>;

    fn resolve(&self, files: &Files) -> Result<Self::Meant, Problems> {
        let (named, request) = self.judged(files)?;
        Ok(Meant {
            asked: (named.one()?, request),
            inputs: inputs(&named, &self.records, files),
        })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.judged(files).map(drop)
    }
}

impl MotionSpectrum {
    fn judged<'f>(
        &self,
        files: &'f Files,
    ) -> Result<(NamedRecords<'f>, SpectrumRequest), Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let named = one_record(&mut read, self.motion.as_ref(), &self.records, files);
        let damping_ratios = read.grid("damping", Dimension::Ratio);
        let outside = |ratio: &&f64| !(0.0..1.0).contains(*ratio);
        if let Some(wrong) = damping_ratios.iter().flatten().find(outside) {
            read.note(
                &["damping"],
                format!("`damping`: {wrong} is not from 0 to below 1"),
                "give the share of critical damping, such as \"5 %\"",
            );
        }
        let request = SpectrumRequest {
            damping_ratios: damping_ratios.unwrap_or_else(|| vec![DAMPING_RATIO]),
            periods_s: periods(&mut read),
            upsample: read.whole_within("upsample", 1..).unwrap_or(1),
        };
        read.problems.finish(Some((named, request)))
    }
}

impl Question for MotionConvert {
    type Meant = Meant<(Vec<ReadMotion>, Format)>;

    fn resolve(&self, files: &Files) -> Result<Self::Meant, Problems> {
        let (named, format) = self.judged(files)?;
        Ok(Meant {
            asked: (named.in_any_direction()?, format),
            inputs: inputs(&named, &self.records, files),
        })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.judged(files).map(drop)
    }
}

impl MotionConvert {
    fn judged<'f>(&self, files: &'f Files) -> Result<(NamedRecords<'f>, Format), Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let named = recorded(&mut read, &self.motion, &self.records, files);
        read.require("to", "`to` is missing", "give a format: csv or at2");
        let format = read.choice("to", FORMATS);
        read.problems.finish(format.map(|format| (named, format)))
    }
}

/// The records of a request, which have not been read; it must name one.
pub(crate) fn recorded<'f>(
    read: &mut WordReader<'_>,
    motion: &[Written],
    records: &Records,
    files: &'f Files,
) -> NamedRecords<'f> {
    let named = records.named_alone(read, motion, files);
    if motion.is_empty() {
        read.missing(&["motion"], "no record is named", "name a record");
    }
    named
}

/// The only record of a request, which has not been read.
pub(crate) fn one_record<'f>(
    read: &mut WordReader<'_>,
    motion: Option<&Written>,
    records: &Records,
    files: &'f Files,
) -> NamedRecords<'f> {
    let names = match motion {
        Some(Written::List(all)) => all.as_slice(),
        Some(one) => std::slice::from_ref(one),
        None => &[],
    };
    if names.len() > 1 {
        let message = format!("one record is expected, not {}", names.len());
        read.note(&["motion"], message, "name one record");
    }
    recorded(read, names, records, files)
}

/// The periods of a spectrum.
pub(crate) fn periods(read: &mut WordReader<'_>) -> Vec<f64> {
    let periods_s = read.grid("periods", Dimension::Time);
    if let Some(wrong) = periods_s.iter().flatten().find(|period| **period < 0.0) {
        read.note(
            &["periods"],
            format!("`periods`: {wrong} s is below zero"),
            "give periods of 0 or more, such as \"0.05 s:5 s:100\"",
        );
    }
    periods_s.unwrap_or_else(usual_periods_s)
}

/// The files that are read.
pub(crate) fn inputs(named: &NamedRecords<'_>, records: &Records, files: &Files) -> Vec<PathBuf> {
    [named.paths(), records.inputs(files)].concat()
}

/// The block of the rocking measures; it needs both sizes.
fn block(read: &mut WordReader<'_>) -> Option<Block> {
    for (key, other) in [("height", "thickness"), ("thickness", "height")] {
        if read.has(key) && !read.has(other) {
            read.missing(
                &[other],
                format!("`{key}` needs `{other}`"),
                "give both sizes of the block, or none",
            );
        }
    }
    let height_m = read.positive("height", Dimension::Length);
    let thickness_m = read.positive("thickness", Dimension::Length);
    let block = Block::uniform(height_m?, thickness_m?)
        .map_err(|error| Problem::value(error.to_string(), "check the dimensions of the object"));
    read.keep("height", block)
}

/// The response spectra of a motion.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SpectrumAnswer<'a> {
    /// The spectra.
    #[serde(flatten)]
    pub report: &'a SpectrumReport,
    /// The figures that were written.
    pub plots: Vec<String>,
}

/// Motions in another format.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ConvertReport {
    /// One for each motion.
    pub motions: Vec<Converted>,
}

/// A motion as a file.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Converted {
    /// The file that was read.
    pub source: String,
    /// The file that was written.
    pub path: Option<String>,
    /// Its format.
    pub format: &'static str,
    /// Time step \[s\].
    pub dt_s: f64,
    /// Number of samples.
    pub npts: usize,
    /// The processing, one entry for each step.
    pub processing: Vec<String>,
    /// The factor applied to the samples, with all digits.
    pub scale_ratio: f64,
    /// The text of the file, if it was not written to a folder.
    pub text: Option<String>,
}
