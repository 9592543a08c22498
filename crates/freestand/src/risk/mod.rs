//! How often a limit state is reached, what that costs, and what to restrain first.
//!
//! A [`Hazard`] says how often a ground or floor motion is as strong as x, a
//! [`CurveKind`](crate::fragility::CurveKind) how likely the object reaches a limit state then;
//! [`annual_rate`] is the integral of both. With the user's costs it is an expected annual loss,
//! and [`best_plan`] chooses the measures that are worth most within a budget.

mod capacity;
mod deaggregation;
mod hazard;
mod loss;
mod money;
mod open;
mod plan;
mod rate;
mod sites;

pub use capacity::{AboveLast, Capacity, capacities, least_avoided, rate_bounds};
pub use deaggregation::{Bin, annual_rate_below, deaggregation};
pub use hazard::{Hazard, HazardError, HazardPoint, Tail};
pub use loss::{
    LossPoint, LossShares, World, expected_loss_per_year, independent_loss_exceedance,
    loss_at_return_period, loss_exceedance,
};
pub use money::{MoneyError, expected_annual_loss, present_value_factor_years, renewed_cost};
pub use open::{Gap, OpenPart, RESOLVED, bounds_by_runs, open_parts, open_rate};
pub use plan::{Choice, Plan, best_plan};
pub use rate::{AnnualRates, annual_rate, probability_in_years};
pub use sites::{
    Amounts, Dependence, LossLevel, SIMULATED_YEARS, SimulatedLosses, SiteLosses, Terms,
    correlations, reached_once_in, simulate,
};
