//! Costs per year and over a horizon.

use thiserror::Error;

/// Why a discount rate or a horizon cannot be used.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{name} must be {requirement}, not {value}")]
pub struct MoneyError {
    /// What the number is.
    pub name: &'static str,
    /// The requirement that it does not meet.
    pub requirement: &'static str,
    /// The value that was given.
    pub value: f64,
}

/// Expected loss per year, q \[(λ_e − λ_o) C_e + λ_o C_o\]: `cost_exceeds` each time the tolerance is
/// exceeded without overturning, `cost_overturns` each time the object overturns. Both costs are of
/// one object, in one currency; the rates are per year.
///
/// # Example
/// Three objects; exceeded every 100 years for 1000, overturned every 1000 years for 5000:
/// ```
/// let loss = freestand::risk::expected_annual_loss(3.0, 0.01, 0.001, 1000.0, 5000.0);
/// assert!((loss - 3.0 * (0.009 * 1000.0 + 0.001 * 5000.0)).abs() < 1e-12);
/// ```
pub fn expected_annual_loss(
    quantity: f64,
    rate_exceeds: f64,
    rate_overturns: f64,
    cost_exceeds: f64,
    cost_overturns: f64,
) -> f64 {
    // Separately fitted curves may cross, and less than nothing cannot happen.
    quantity
        * ((rate_exceeds - rate_overturns).max(0.0) * cost_exceeds
            + rate_overturns * cost_overturns)
}

/// Present value of 1 per year, paid continuously over a horizon: (1 − e^{−rH})/r, H where r is 0
/// \[years\].
///
/// # Errors
/// A horizon that is not positive, or a rate that is negative, or 1 or more.
///
/// # Example
/// 3 % over 40 years:
/// ```
/// let years = freestand::risk::present_value_factor_years(0.03, 40.0)?;
/// assert!((years - (1.0 - (-1.2_f64).exp()) / 0.03).abs() < 1e-12);
/// # Ok::<(), freestand::risk::MoneyError>(())
/// ```
pub fn present_value_factor_years(
    discount_rate: f64,
    horizon_years: f64,
) -> Result<f64, MoneyError> {
    check(discount_rate, horizon_years)?;
    Ok(if discount_rate == 0.0 {
        horizon_years
    } else {
        -(-discount_rate * horizon_years).exp_m1() / discount_rate
    })
}

fn within(
    fine: bool,
    name: &'static str,
    requirement: &'static str,
    value: f64,
) -> Result<(), MoneyError> {
    let error = MoneyError {
        name,
        requirement,
        value,
    };
    (fine && value.is_finite()).then_some(()).ok_or(error)
}

fn check(discount_rate: f64, horizon_years: f64) -> Result<(), MoneyError> {
    let (name, requirement) = ("the horizon in years", "positive and finite");
    within(horizon_years > 0.0, name, requirement, horizon_years)?;
    let (name, requirement) = ("the discount rate", "from 0 to below 1");
    within(
        (0.0..1.0).contains(&discount_rate),
        name,
        requirement,
        discount_rate,
    )
}

/// Present value of a measure that is paid now and again whenever its life ends within the horizon,
/// C Σ e^{−r n L} over n L < H; C without a life.
///
/// # Errors
/// A horizon or a life that is not positive, or a rate that is negative, or 1 or more.
///
/// # Example
/// A life of 15 years in 40: paid now, after 15 and after 30 years.
/// ```
/// assert_eq!(freestand::risk::renewed_cost(100.0, Some(15.0), 0.0, 40.0), Ok(300.0));
/// ```
pub fn renewed_cost(
    cost: f64,
    life_years: Option<f64>,
    discount_rate: f64,
    horizon_years: f64,
) -> Result<f64, MoneyError> {
    check(discount_rate, horizon_years)?;
    let Some(life_years) = life_years else {
        return Ok(cost);
    };
    // A life of seconds would be paid a billion times.
    let requirement = "positive and at least a thousandth of the horizon";
    let fine = life_years >= 1e-3 * horizon_years;
    within(fine, "the life in years", requirement, life_years)?;
    let times = (0..)
        .map(|n| f64::from(n) * life_years)
        .take_while(|time| *time < horizon_years);
    Ok(times.map(|time| cost * (-discount_rate * time).exp()).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn years_without_interest_are_years() {
        assert_eq!(present_value_factor_years(0.0, 40.0), Ok(40.0));
        // The series of (1 − e^{−rH})/r begins with H − rH²/2.
        let small = present_value_factor_years(1e-9, 40.0).unwrap();
        assert!((small - (40.0 - 1e-9 * 800.0)).abs() < 1e-12, "{small}");
        assert_eq!(
            present_value_factor_years(0.03, -1.0).unwrap_err().name,
            "the horizon in years"
        );
        for wrong in [-0.03, 1.0, 3.0, f64::NAN] {
            let error = present_value_factor_years(wrong, 1.0).unwrap_err();
            assert_eq!(error.name, "the discount rate");
        }
    }

    #[test]
    fn a_measure_is_renewed_within_the_horizon_only() {
        assert_eq!(renewed_cost(100.0, None, 0.03, 40.0), Ok(100.0));
        assert_eq!(renewed_cost(100.0, Some(20.0), 0.0, 40.0), Ok(200.0));
        let discounted = renewed_cost(100.0, Some(20.0), 0.03, 40.0).unwrap();
        assert!((discounted - 100.0 * (1.0 + (-0.6_f64).exp())).abs() < 1e-12);
        assert!(renewed_cost(100.0, Some(0.0), 0.03, 40.0).is_err());
    }
}
