//! How often objects fail, what that costs, and which options are worth their money: fragilities, their
//! hazards, losses, and the folders of other programs.

pub mod budget;
pub mod costs;
pub mod doubts;
pub mod export;
pub mod fragility;
pub mod objects;
pub mod plan;
pub mod portfolio;
mod rates;
pub mod report;
mod request;
mod risk;
#[cfg(test)]
mod tests;

pub use costs::load_changed;
pub use report::RiskReport;
pub use request::{
    DEFAULT_YEARS, RISK_SCHEMA, RiskCurves, RiskRequest, amount, coordinates, yearly_rate, years,
};
pub use risk::{LEFT_OUT, risk};
