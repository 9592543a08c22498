//! How well an intensity measure tells what an object does.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// A straight line through points, by least squares, and what it leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Value at 0.
    pub intercept: f64,
    /// Slope.
    pub slope: f64,
    /// Standard deviation of the residuals, with two degrees of freedom taken off.
    pub residual_sd: f64,
    /// Residuals, in the order of the points.
    pub residuals: Vec<f64>,
}

impl Line {
    /// Two-sided p-value of a slope of 0 by Student's t with n − 2 degrees of freedom; `None` where
    /// the points lie on the line.
    fn p_value(&self, spread: f64) -> Option<f64> {
        let degrees = self.residuals.len() as f64 - 2.0;
        let t = self.slope * spread / self.residual_sd;
        let law = StudentsT::new(0.0, 1.0, degrees).ok()?;
        t.is_finite().then(|| 2.0 * law.cdf(-t.abs()))
    }
}

/// The line through points (x, y) with the smallest sum of squares; `None` for fewer than three
/// points, or where all x are equal.
///
/// With x = ln of an intensity measure and y = ln of a demand, the slope b is the *practicality* of
/// the measure and the residual standard deviation its *efficiency*.
///
/// # Reference
/// Padgett, J. E., Nielson, B. G. and DesRoches, R. (2008). Selection of optimal intensity measures
/// in probabilistic seismic demand models of highway bridge portfolios. Earthquake Engineering and
/// Structural Dynamics 37, 711–725.
///
/// # Example
/// ```
/// let line = freestand::fragility::line_through(&[(0.0, 1.0), (1.0, 3.5), (2.0, 5.0)]).unwrap();
/// assert!((line.slope - 2.0).abs() < 1e-12 && (line.intercept - 7.0 / 6.0).abs() < 1e-12);
/// ```
pub fn line_through(points: &[(f64, f64)]) -> Option<Line> {
    weighted_line(
        &points
            .iter()
            .map(|(x, y)| (*x, *y, 1.0))
            .collect::<Vec<_>>(),
    )
}

/// As [`line_through`], of points (x, y, weight), each of which counts as often as its weight says;
/// the weights together count as many as there are points. `None` for fewer than three points with a
/// weight, too.
///
/// # Example
/// Twice the weight is the point twice:
/// ```
/// use freestand::fragility::{line_through, weighted_line};
/// let twice = line_through(&[(0.0, 1.0), (1.0, 3.5), (2.0, 5.0), (2.0, 5.0)]).unwrap();
/// let weighted = weighted_line(&[(0.0, 1.0, 0.5), (1.0, 3.5, 0.5), (2.0, 5.0, 1.0)]).unwrap();
/// assert!((weighted.slope - twice.slope).abs() < 1e-12);
/// assert!((weighted.intercept - twice.intercept).abs() < 1e-12);
/// ```
pub fn weighted_line(points: &[(f64, f64, f64)]) -> Option<Line> {
    let count = points.iter().filter(|point| point.2 > 0.0).count();
    if count < 3 {
        return None;
    }
    let all = points.iter().map(|point| point.2).sum::<f64>();
    let mean = |of: &dyn Fn(f64, f64) -> f64| {
        points
            .iter()
            .map(|(x, y, weight)| weight * of(*x, *y))
            .sum::<f64>()
            / all
    };
    let (middle, level) = (mean(&|x, _| x), mean(&|_, y| y));
    let square = mean(&|x, _| (x - middle).powi(2));
    if square.partial_cmp(&(1e-24 * (1.0 + middle * middle))) != Some(std::cmp::Ordering::Greater) {
        return None;
    }
    let slope = mean(&|x, y| (x - middle) * (y - level)) / square;
    let residual = |x: f64, y: f64| y - level - slope * (x - middle);
    let residuals: Vec<f64> = points.iter().map(|(x, y, _)| residual(*x, *y)).collect();
    let count = count as f64;
    let residual_sd = (mean(&|x, y| residual(x, y).powi(2)) * count / (count - 2.0)).sqrt();
    Some(Line {
        intercept: level - slope * middle,
        slope,
        residual_sd,
        residuals,
    })
}

/// Σ (x − x̄)².
fn squares(points: &[(f64, f64)]) -> f64 {
    let middle = points.iter().map(|point| point.0).sum::<f64>() / points.len() as f64;
    points.iter().map(|(x, _)| (x - middle).powi(2)).sum()
}

/// How probable a slope as steep as that of these points would be if y did not depend on x: the
/// *sufficiency* of a measure, where y is what the measure left and x is another property of the
/// motions. A small p (below 0.05) means that the outcome depends on the property, too. `None` for
/// fewer than three points, or where all x are equal.
///
/// # Reference
/// Luco, N. and Cornell, C. A. (2007). Structure-specific scalar intensity measures for near-source
/// and ordinary earthquake ground motions. Earthquake Spectra 23, 357–392.
///
/// # Example
/// Points without a trend, and with one: t = 4√3 with one degree of freedom, p = 1 − 2 atan(t)/π.
/// ```
/// use freestand::fragility::trend_p_value;
/// assert!((trend_p_value(&[(0.0, 1.0), (1.0, -1.0), (2.0, 1.0)]).unwrap() - 1.0).abs() < 1e-12);
/// let p = trend_p_value(&[(0.0, 1.0), (1.0, 3.5), (2.0, 5.0)]).unwrap();
/// let exact = 1.0 - 2.0 * (4.0 * 3.0_f64.sqrt()).atan() / std::f64::consts::PI;
/// assert!((p - exact).abs() < 1e-12, "{p} {exact}");
/// ```
pub fn trend_p_value(points: &[(f64, f64)]) -> Option<f64> {
    line_through(points)?.p_value(squares(points).sqrt())
}
