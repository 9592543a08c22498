//! How often objects fail, what that costs, and which options are worth their money: fragilities, their
//! hazards, losses, and the folders of other programs.

mod costs;
mod doubts;
pub mod export;
mod figure;
pub mod fragility;
mod objects;
mod page;
mod plan;
mod portfolio;
mod rates;
mod report;
mod request;
mod risk;
#[cfg(test)]
mod tests;
mod text;
mod words;

pub use costs::load_changed;
pub use figure::risk_figure;
pub use page::owners_page;
pub use report::RiskReport;
pub use request::{
    DEFAULT_YEARS, RISK_SCHEMA, RiskCurves, RiskRequest, amount, coordinates, yearly_rate, years,
};
pub use risk::{LEFT_OUT, risk};
pub use text::text;
