//! Flags that state a hazard curve.

use std::path::PathBuf;

use clap::Args;
use freestand_assess::fragility::{HazardGiven, Measure};
use freestand_assess::risk::coordinates;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

use crate::values::{Given, Reads, Values};

/// Flags that state a hazard curve.
#[derive(Debug, Args)]
pub(crate) struct CurveArgs {
    /// Hazard curve: "pgv [m/s],annual_rate", or a hazard_curve-*.csv of OpenQuake
    #[arg(long, value_name = "FILE")]
    pub(crate) hazard: Option<PathBuf>,
    /// Power law, such as "k0=1e-4 /yr, k=2.5, reference=1 m/s"
    #[arg(long, value_name = "LAW")]
    hazard_power: Option<String>,
    /// Intensity measure of a hazard that is not from a file: pga, pgv, pfv, sa(0.5) and so on [default:
    /// that of the fragilities]
    #[arg(long, value_name = "IM", read = measure)]
    hazard_im: Option<Given<Measure>>,
    /// Longitude and latitude in degrees: the site to use of a hazard file with several, or the place
    /// of exported objects
    #[arg(long, value_name = "LON,LAT", read = coordinates)]
    pub(crate) site_coordinates: Option<Given<(f64, f64)>>,
}

impl CurveArgs {
    /// What was given of the hazard.
    pub(crate) fn given(&self, values: &mut Values) -> HazardGiven {
        HazardGiven {
            file: self.hazard.clone(),
            power_law: self.hazard_power.clone(),
            measure: values.read(&self.hazard_im),
            ..HazardGiven::default()
        }
    }
}

fn measure(text: &str) -> Result<Measure, Problem> {
    Measure::parse(text).ok_or_else(|| {
        let message = format!("\"{}\" is not an intensity measure", shorten(text));
        Problem::value(
            message,
            "write pga, pgv, pfa, pfv, sa(0.5), sa_avg(0.2:2), velocity_ratio or acceleration_ratio",
        )
    })
}
