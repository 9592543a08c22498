//! `shock-spectrum`: what a component feels, of records and of classical pulses.

use std::path::PathBuf;

use freestand::shock_response::{Pulse, ShockSpectrumOptions};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, parse_grid};
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::recorded::ReadMotion;
use freestand_study::shock_spectrum::{
    DEFAULT_FREQUENCIES, KINDS, PEAKS, SHAPES, ShockSpectrumReport, ShockSpectrumRequest,
    acceleration_unit, pulse_shock_spectrum, recorded_shock_spectra,
};

use crate::files::Files;
use crate::records::{NamedRecords, Records};
use crate::request::{Question, Request, one_of, reader, request};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.shock-spectrum/1";

request! { question
    /// The shock response spectrum of records or of a pulse.
    // A laboratory file has columns, not components.
    #[command(mut_arg("component", |arg| arg.visible_alias("column")))]
    pub struct ShockSpectrum {
        /// Record files
        #[arg(value_name = "FILE")]
        pub motion: Vec<Written>,
        /// A classical pulse instead of files
        pub pulse = "PULSE" with (value_parser = one_of(SHAPES)) under "A pulse",
        /// Peak of the pulse; the spectrum has the same unit
        pub peak_acceleration = "ACCELERATION" under "A pulse",
        /// Duration of the pulse
        pub duration = "TIME" under "A pulse",
        /// Damping ratio of the oscillators [default: 5 %]
        pub damping = "RATIO",
        /// Quality factor Q = 1/(2 damping), instead of the damping ratio [default: 10]
        pub q = "RATIO",
        /// Frequencies of the oscillators: from:to:N/oct, from:to:count or a list [default: 1 Hz:10 kHz:12/oct]
        pub frequencies = "GRID",
        /// Response of the oscillators [default: absolute-acceleration]
        pub kind = "KIND" with (value_parser = one_of(KINDS)),
        /// Peak of that response [default: maximax]
        pub peak = "PEAK" with (value_parser = one_of(PEAKS)),
        /// Find peaks at the samples only, not on the band-limited curve through them
        pub no_upsample = switch,
        /// How the records are read.
        #[command(flatten)]
        pub records: Records,
    }
}

/// What is asked, in SI.
#[derive(Debug)]
pub struct Meant {
    /// The spectrum.
    pub spectrum: ShockSpectrumRequest,
    /// What shakes the oscillators.
    pub shock: Shock,
}

/// What shakes the oscillators.
#[derive(Debug)]
pub enum Shock {
    /// A pulse, and the unit that its peak was given in.
    Pulse(Pulse, &'static str),
    /// Records, and the files that were read.
    Recorded(Vec<ReadMotion>, Vec<PathBuf>),
}

impl Meant {
    /// The spectra. `go_on` is asked now and then.
    ///
    /// # Errors
    /// A record or a pulse that the method cannot answer, and what `go_on` returns.
    pub fn spectra(
        &self,
        go_on: impl Fn() -> Result<(), Problem>,
    ) -> Result<ShockSpectrumReport, Problem> {
        match &self.shock {
            Shock::Pulse(pulse, unit) => pulse_shock_spectrum(pulse, unit, &self.spectrum, go_on),
            Shock::Recorded(motions, _) => recorded_shock_spectra(motions, &self.spectrum, go_on),
        }
    }

    /// The files that were read.
    pub fn inputs(&self) -> &[PathBuf] {
        match &self.shock {
            Shock::Pulse(..) => &[],
            Shock::Recorded(_, inputs) => inputs,
        }
    }
}

impl Question for ShockSpectrum {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let (spectrum, pulse, named) = self.judged(files)?;
        let shock = match pulse {
            Some((pulse, unit)) => Shock::Pulse(pulse, unit),
            None => {
                let mut inputs = named.paths();
                inputs.extend(self.records.inputs(files));
                Shock::Recorded(named.shocks()?, inputs)
            }
        };
        Ok(Meant { spectrum, shock })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.judged(files).map(drop)
    }
}

/// A spectrum, the pulse if there is one, and records that have not been read.
type Judged<'f> = (
    ShockSpectrumRequest,
    Option<(Pulse, &'static str)>,
    NamedRecords<'f>,
);

impl ShockSpectrum {
    fn judged<'f>(&self, files: &'f Files) -> Result<Judged<'f>, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let spectrum = spectrum(&mut read);
        let pulse = pulse(&mut read);
        read.exclusive("pulse", "no_upsample");
        if read.has("pulse") && read.has("motion") {
            read.note(
                &["pulse", "motion"],
                "a pulse and a record exclude each other",
                "keep one of them",
            );
        }
        if !read.has("motion") && !read.has("pulse") {
            read.missing(
                &["motion"],
                "there is neither a record nor a pulse",
                "name a record, or give `pulse`, `peak_acceleration` and `duration`",
            );
        }
        let named = self.records.named_alone(&mut read, &self.motion, files);
        let spectrum = read.problems.finish(spectrum)?;
        Ok((spectrum, pulse, named))
    }
}

fn spectrum(read: &mut WordReader<'_>) -> Option<ShockSpectrumRequest> {
    read.exclusive("damping", "q");
    let damping = read.non_negative("damping", Dimension::Ratio);
    let q = read.positive("q", Dimension::Ratio);
    let damping_ratio = damping
        .or(q.map(|q| 0.5 / q))
        .unwrap_or(ShockSpectrumOptions::default().damping_ratio);
    if damping_ratio >= 1.0 {
        let key = if damping.is_some() { "damping" } else { "q" };
        read.note(
            &[key],
            format!("`{key}`: a damping ratio of {damping_ratio} is not below 1"),
            "give a damping below 100 %, or a Q above 0.5; 5 %, which is Q = 10, is usual",
        );
    }
    let upsample = !read.flag("no_upsample");
    let kind = read.choice("kind", KINDS).unwrap_or_default();
    let peak = read.choice("peak", PEAKS).unwrap_or_default();
    let frequencies_hz = if read.has("frequencies") {
        read.grid("frequencies", Dimension::Frequency)
    } else {
        read.keep(
            "frequencies",
            parse_grid(DEFAULT_FREQUENCIES, Dimension::Frequency),
        )
    };
    let wrong = frequencies_hz.iter().flatten().find(|f| **f <= 0.0);
    if let Some(wrong) = wrong {
        read.note(
            &["frequencies"],
            format!("`frequencies`: {wrong} Hz is not above zero"),
            "give frequencies such as \"1 Hz:10 kHz:12/oct\" or \"20 Hz, 45 Hz\"",
        );
    }
    Some(ShockSpectrumRequest {
        kind,
        peak,
        damping_ratio,
        frequencies_hz: frequencies_hz?,
        upsample,
    })
}

/// The pulse, and the unit that its peak is given in.
fn pulse(read: &mut WordReader<'_>) -> Option<(Pulse, &'static str)> {
    let shape = read.choice("pulse", SHAPES);
    let peak_m_s2 = read.quantity("peak_acceleration", Dimension::Acceleration);
    let unit = acceleration_unit(read.text("peak_acceleration").unwrap_or_default());
    let duration_s = read.positive("duration", Dimension::Time);
    for key in ["peak_acceleration", "duration"] {
        match (read.has("pulse"), read.has(key)) {
            (true, false) => read.missing(
                &[key],
                format!("a pulse needs `{key}`"),
                "give a peak and a duration, such as \"30 g\" and \"11 ms\"",
            ),
            (false, true) => read.note(
                &[key],
                format!("`{key}` applies only to a pulse"),
                "name its shape with `pulse`, or leave it out",
            ),
            _ => {}
        }
    }
    let pulse = Pulse::new(shape?, peak_m_s2?, duration_s?).map_err(|error| {
        let hint = "give a peak and a duration, such as \"30 g\" and \"11 ms\"";
        Problem::value(error.to_string(), hint)
    });
    Some((read.keep("pulse", pulse)?, unit))
}
