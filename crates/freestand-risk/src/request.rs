//! What is asked, and how the numbers in it are read.

use std::path::PathBuf;

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_inventory::{CellsRequest, money};

use crate::fragility::{At, FragilityRequest, HazardSource, number_and_unit};

/// The schema of the document.
pub const RISK_SCHEMA: &str = "freestand.risk/1";

/// Years of the stated probabilities where none are given.
pub const DEFAULT_YEARS: f64 = 50.0;

/// Longitude and latitude, `151.2,-33.9` \[degrees\].
///
/// # Errors
/// Anything but two numbers, or a place that is not on the globe.
pub fn coordinates(text: &str) -> Result<(f64, f64), Problem> {
    let parsed = text.split_once(',').and_then(|(lon, lat)| {
        Some((
            lon.trim().parse::<f64>().ok()?,
            lat.trim().parse::<f64>().ok()?,
        ))
    });
    parsed
        .filter(|(lon, lat)| lon.abs() <= 360.0 && lat.abs() <= 90.0)
        .ok_or_else(|| {
            let message = format!("\"{}\" is not a longitude and a latitude", shorten(text));
            Problem::value(
                message,
                "write degrees, longitude first, such as \"151.2,-33.9\"",
            )
        })
}

/// An amount of money with its currency, `20000 AUD`, `€15 000`.
///
/// # Errors
/// No number of 0 or more, or no currency.
pub fn amount(text: &str) -> Result<(f64, String), Problem> {
    let found = money(text).filter(|(number, _)| *number >= 0.0);
    found.ok_or_else(|| {
        let message = format!("\"{}\" is not an amount of money", shorten(text));
        Problem::value(
            message,
            "write a number and a currency, such as \"20000 AUD\"",
        )
    })
}

/// A number of years, `40 yr` or `40`.
///
/// # Errors
/// No number above 0, or another unit.
pub fn years(text: &str) -> Result<f64, Problem> {
    number_with(
        text,
        &["", "yr", "years", "year"],
        "a number of years",
        "40 yr",
    )
}

/// A rate per year, `1e-4 /yr`.
///
/// # Errors
/// No number above 0, or another unit.
pub fn yearly_rate(text: &str) -> Result<f64, Problem> {
    number_with(
        text,
        &["/yr", "1/yr", "/year", "1/year"],
        "a rate per year",
        "1e-4 /yr",
    )
}

fn number_with(text: &str, units: &[&str], what: &str, example: &str) -> Result<f64, Problem> {
    let found =
        number_and_unit(text).filter(|(number, unit)| *number > 0.0 && units.contains(unit));
    found.map(|(number, _)| number).ok_or_else(|| {
        Problem::value(
            format!("\"{}\" is not {what}", shorten(text)),
            format!("write \"{example}\""),
        )
    })
}

/// Where the fragilities come from.
#[derive(Debug, Clone, PartialEq)]
pub enum RiskCurves {
    /// `fragility.csv`.
    File(PathBuf),
    /// A table of outcomes, which is fitted first.
    Outcomes(FragilityRequest),
}

/// A question about risk.
#[derive(Debug, Clone, PartialEq)]
pub struct RiskRequest {
    /// The fragilities.
    pub curves: RiskCurves,
    /// The hazard.
    pub hazard: HazardSource,
    /// Where a spectral acceleration of the hazard is taken.
    pub hazard_at: Option<At>,
    /// Longitude and latitude of the site, for a hazard file with several \[degrees\].
    pub site_deg: Option<(f64, f64)>,
    /// Costs and accepted rates.
    pub inventory: Option<PathBuf>,
    /// How the cells of that list are read.
    pub list: CellsRequest,
    /// Options.
    pub options: Option<PathBuf>,
    /// The most that options may cost, with its currency.
    pub budget: Option<(f64, String)>,
    /// Over which options pay \[years\].
    pub horizon_years: Option<f64>,
    /// Discount rate per year.
    pub discount_ratio: Option<f64>,
    /// Rate of overturning that is accepted where the inventory has none \[1/year\].
    pub accepted_rate: Option<f64>,
    /// Years of the stated probabilities; `None`: [`DEFAULT_YEARS`].
    pub years: Option<f64>,
}
