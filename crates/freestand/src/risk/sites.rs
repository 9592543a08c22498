//! What earthquakes cost at several sites together, in simulated years.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1, StandardNormal};

use crate::fragility::{draw_stream, normal_ratio, uniform_draw};

/// What is simulated \[years\]: a loss that is reached once in 1000 years then has 1000 events, and a standard error of
/// 3 % of its rate.
pub const SIMULATED_YEARS: u32 = 1_000_000;

/// What an insurance pays of a loss.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Terms {
    /// What is not paid of each loss.
    pub deductible: f64,
    /// The most that is paid of each loss; infinite: everything.
    pub limit: f64,
}

impl Terms {
    /// Everything is paid.
    pub const ALL: Self = Self {
        deductible: 0.0,
        limit: f64::INFINITY,
    };

    /// min(max(L − deductible, 0), limit).
    pub fn paid(self, loss: f64) -> f64 {
        (loss - self.deductible).clamp(0.0, self.limit)
    }
}

/// Earthquakes of one strength at a site.
#[derive(Debug, Clone, PartialEq)]
pub struct LossLevel {
    /// How often they happen \[1/year\].
    pub annual_rate: f64,
    /// What each of its worlds costs; all are equally likely.
    pub losses: Vec<f64>,
}

/// What earthquakes cost at a site.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteLosses {
    /// From the weakest to the strongest.
    pub levels: Vec<LossLevel>,
    /// What is paid of the loss of the site in each earthquake.
    pub terms: Terms,
}

impl SiteLosses {
    fn annual_rate(&self) -> f64 {
        self.levels.iter().map(|level| level.annual_rate).sum()
    }

    /// Σ ν f(L) of a function of the loss \[currency/year\].
    fn a_year(&self, of: impl Fn(f64) -> f64) -> f64 {
        let level = |level: &LossLevel| {
            let sum: f64 = level.losses.iter().map(|loss| of(*loss)).sum();
            level.annual_rate * sum / level.losses.len().max(1) as f64
        };
        self.levels.iter().map(level).sum()
    }

    /// What it costs a year on average.
    pub fn expected_loss_per_year(&self) -> f64 {
        self.a_year(|loss| loss)
    }

    /// What its own terms pay a year on average.
    pub fn expected_payment_per_year(&self) -> f64 {
        self.a_year(|loss| self.terms.paid(loss))
    }

    /// The loss in one of the earthquakes whose strength is reached at this rate; 0 below the weakest.
    fn at_strength(&self, rate_per_year: f64, random: &mut ChaCha8Rng) -> f64 {
        let mut below = 0.0;
        for level in self.levels.iter().rev() {
            below += level.annual_rate;
            if rate_per_year < below && !level.losses.is_empty() {
                let place = uniform_draw(random, 0.0, level.losses.len() as f64) as usize;
                return level.losses[place.min(level.losses.len() - 1)];
            }
        }
        0.0
    }

    /// Its losses from the largest on, each with the rate at which it is reached.
    fn by_loss(&self) -> Vec<(f64, f64)> {
        let each = |level: &LossLevel| {
            let rate = level.annual_rate / level.losses.len().max(1) as f64;
            let losses = level.losses.clone();
            losses.into_iter().map(move |loss| (loss, rate))
        };
        let mut all: Vec<(f64, f64)> = self.levels.iter().flat_map(each).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut sum = 0.0;
        for (_, rate) in &mut all {
            sum += *rate;
            *rate = sum;
        }
        all
    }
}

/// How the losses of several sites belong together. Every site has the same losses at the same rates in all three.
#[derive(Debug, Clone, PartialEq)]
pub enum Dependence {
    /// Every earthquake happens at one site alone.
    Independent,
    /// Every earthquake happens at all sites, each as strong as its site makes it: a Gaussian copula with these
    /// correlations between the ranks of the strengths.
    Correlated(Vec<Vec<f64>>),
    /// Every earthquake costs each site what is reached there at the same rate: the sites are as one.
    Common,
}

/// exp(−3h/r) for each pair of sites, from their distances h.
///
/// # Reference
/// Jayaram and Baker (2009), eq. 17: the range r is 8.5 km + 17.2 km/s T below T = 1 s where the ground of
/// neighbours differs, 40.7 km − 15 km/s T where it is alike, and 22 km + 3.7 km/s T above.
pub fn correlations(distances_km: &[Vec<f64>], range_km: f64) -> Vec<Vec<f64>> {
    let row = |row: &Vec<f64>| row.iter().map(|h| (-3.0 * h / range_km).exp()).collect();
    distances_km.iter().map(row).collect()
}

/// A loss, and what is paid of it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Amounts {
    /// The loss.
    pub loss: f64,
    /// What all terms pay of it.
    pub paid: f64,
}

/// Simulated years.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedLosses {
    /// Each earthquake with a loss.
    pub events: Vec<Amounts>,
    /// Each year with a loss.
    pub totals: Vec<Amounts>,
}

/// What the sites cost in [`SIMULATED_YEARS`]: first each site's terms apply to its loss in an earthquake, then those of
/// the policy to their sum.
///
/// Earthquakes come as a Poisson process: in [`Dependence::Independent`] at each site its own, else one of all sites, with
/// the rate of the site that has most.
///
/// # Accuracy
/// That of counting: a rate of n events has a standard error of its n^−½.
pub fn simulate(
    sites: &[SiteLosses],
    dependence: &Dependence,
    policy: Terms,
    seed: u64,
) -> SimulatedLosses {
    let mut random = draw_stream(seed, 0, 0, 0);
    let mut found = Found {
        events: Vec::new(),
        totals: vec![Amounts::default(); SIMULATED_YEARS as usize],
        policy,
    };
    let most = sites.iter().map(SiteLosses::annual_rate);
    let most = most.fold(0.0, f64::max);
    match dependence {
        Dependence::Independent => {
            for site in sites {
                let rate = site.annual_rate();
                let mut time = 0.0;
                while let Some(year) = next(&mut time, rate, &mut random) {
                    let at = uniform_draw(&mut random, 0.0, rate);
                    let loss = site.at_strength(at, &mut random);
                    found.add(year, [(site, loss)].into_iter());
                }
            }
        }
        Dependence::Correlated(correlations) => {
            let factor = factor(correlations);
            let mut time = 0.0;
            while let Some(year) = next(&mut time, most, &mut random) {
                let normals: Vec<f64> = sites
                    .iter()
                    .map(|_| StandardNormal.sample(&mut random))
                    .collect();
                let losses: Vec<f64> = sites
                    .iter()
                    .zip(&factor)
                    .map(|(site, row)| {
                        let z: f64 = row.iter().zip(&normals).map(|(a, z)| a * z).sum();
                        site.at_strength(most * normal_ratio(-z), &mut random)
                    })
                    .collect();
                found.add(year, sites.iter().zip(losses));
            }
        }
        Dependence::Common => {
            let by_loss: Vec<_> = sites.iter().map(SiteLosses::by_loss).collect();
            let mut time = 0.0;
            while let Some(year) = next(&mut time, most, &mut random) {
                let at = uniform_draw(&mut random, 0.0, most);
                let losses = by_loss.iter().map(|all| {
                    let place = all.partition_point(|(_, rate)| *rate <= at);
                    all.get(place).map_or(0.0, |(loss, _)| *loss)
                });
                found.add(year, sites.iter().zip(losses));
            }
        }
    }
    found.totals.retain(|one| one.loss > 0.0);
    SimulatedLosses {
        events: found.events,
        totals: found.totals,
    }
}

/// The year of the next earthquake of a Poisson process, whose time goes on; `None`: it is after the end.
fn next(time_years: &mut f64, rate_per_year: f64, random: &mut ChaCha8Rng) -> Option<usize> {
    // The rate of a site without losses is the sum of nothing, −0, which would take the time back.
    if rate_per_year <= 0.0 {
        return None;
    }
    let gap: f64 = Exp1.sample(random);
    *time_years += gap / rate_per_year;
    (*time_years < f64::from(SIMULATED_YEARS)).then_some(*time_years as usize)
}

/// What was found so far.
struct Found {
    events: Vec<Amounts>,
    /// Of every year.
    totals: Vec<Amounts>,
    policy: Terms,
}

impl Found {
    fn add<'a>(&mut self, year: usize, losses: impl Iterator<Item = (&'a SiteLosses, f64)>) {
        let mut all = Amounts::default();
        for (site, loss) in losses {
            all.loss += loss;
            all.paid += site.terms.paid(loss);
        }
        all.paid = self.policy.paid(all.paid);
        if all.loss > 0.0 {
            self.events.push(all);
            self.totals[year].loss += all.loss;
            self.totals[year].paid += all.paid;
        }
    }
}

/// The largest amount that is reached at least once in this many years on average, of amounts in
/// [`SIMULATED_YEARS`]; 0 where none is.
pub fn reached_once_in(years: f64, amounts: impl Iterator<Item = f64>) -> f64 {
    let mut amounts: Vec<f64> = amounts.collect();
    amounts.sort_by(|a, b| b.total_cmp(a));
    let count = (f64::from(SIMULATED_YEARS) / years).ceil() as usize;
    let place = count.checked_sub(1);
    place
        .and_then(|place| amounts.get(place))
        .copied()
        .unwrap_or(0.0)
}

/// Cholesky factor of correlations; of two sites at one place the second one adds nothing.
fn factor(correlations: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(correlations.len());
    for (i, correlated) in correlations.iter().enumerate() {
        let mut row: Vec<f64> = Vec::with_capacity(i + 1);
        for (other, correlation) in rows.iter().zip(correlated) {
            let product: f64 = row.iter().zip(other).map(|(a, b)| a * b).sum();
            let diagonal = other.last().copied().unwrap_or(1.0);
            // Rounding leaves about the square root of the precision on the diagonal.
            let is_one_place = diagonal < 1e-7;
            row.push(if is_one_place {
                0.0
            } else {
                (correlation - product) / diagonal
            });
        }
        let used: f64 = row.iter().map(|a| a * a).sum();
        row.push((1.0 - used).max(0.0).sqrt());
        rows.push(row);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::risk::{World, loss_at_return_period, loss_exceedance};

    fn site(rates: &[f64], losses: &[&[f64]], terms: Terms) -> SiteLosses {
        let level = |(rate, losses): (&f64, &&[f64])| LossLevel {
            annual_rate: *rate,
            losses: losses.to_vec(),
        };
        SiteLosses {
            levels: rates.iter().zip(losses).map(level).collect(),
            terms,
        }
    }

    fn two() -> [SiteLosses; 2] {
        [
            site(&[0.02, 0.01], &[&[0.0, 10.0], &[40.0, 80.0]], Terms::ALL),
            site(&[0.03, 0.005], &[&[0.0, 5.0, 7.0], &[100.0]], Terms::ALL),
        ]
    }

    /// The mean and its standard error of amounts a year: for a Poisson process √(Σ a²)/years.
    fn mean(amounts: impl Iterator<Item = f64>) -> (f64, f64) {
        let (sum, squares) = amounts.fold((0.0, 0.0), |(s, q), a| (s + a, q + a * a));
        let years = f64::from(SIMULATED_YEARS);
        (sum / years, f64::sqrt(squares) / years)
    }

    /// Every dependence has the same yearly loss, Σ ν L.
    #[test]
    fn the_yearly_loss_does_not_depend_on_the_dependence() {
        let sites = two();
        let expected: f64 = sites.iter().map(SiteLosses::expected_loss_per_year).sum();
        // 0.02·5 + 0.01·60 + 0.03·4 + 0.005·100.
        assert!((expected - 1.32).abs() < 1e-12);
        let correlated = Dependence::Correlated(vec![vec![1.0, 0.6], vec![0.6, 1.0]]);
        for dependence in [Dependence::Independent, correlated, Dependence::Common] {
            let found = simulate(&sites, &dependence, Terms::ALL, 1);
            let (events, error) = mean(found.events.iter().map(|one| one.loss));
            // Five standard errors: one test in 10⁶ fails by chance, and the seed is fixed.
            assert!(
                (events - expected).abs() < 5.0 * error,
                "{dependence:?} {events}"
            );
            let (totals, _) = mean(found.totals.iter().map(|one| one.loss));
            assert!((totals - events).abs() < 1e-9);
        }
    }

    /// The curves of independent and of common earthquakes are known: rates add, or losses at equal rates.
    #[test]
    fn curves_are_those_of_added_rates_and_of_added_losses() {
        let sites = two();
        let independent: Vec<World> = sites
            .iter()
            .flat_map(|site| &site.levels)
            .flat_map(|level| {
                let annual_rate = level.annual_rate / level.losses.len() as f64;
                let world = move |loss: &f64| World {
                    annual_rate,
                    loss: *loss,
                };
                level.losses.iter().map(world)
            })
            .collect();
        // By rate: [0, .005] 80 + 100, [.005, .01] 40 + 7, [.01, .015] 10 + 7, [.015, .02] 10 + 5, [.02, .025] 0 + 5.
        let common = [
            (0.005, 180.0),
            (0.005, 47.0),
            (0.005, 17.0),
            (0.005, 15.0),
            (0.005, 5.0),
        ];
        let common: Vec<World> = common
            .map(|(annual_rate, loss)| World { annual_rate, loss })
            .to_vec();
        for (dependence, worlds) in [
            (Dependence::Independent, independent),
            (Dependence::Common, common),
        ] {
            let curve = loss_exceedance(&worlds);
            let found = simulate(&sites, &dependence, Terms::ALL, 2);
            for point in &curve {
                let count = found
                    .events
                    .iter()
                    .filter(|one| one.loss >= point.loss)
                    .count() as f64;
                let expected = point.annual_rate * f64::from(SIMULATED_YEARS);
                // Five standard errors of a count.
                assert!(
                    (count - expected).abs() < 5.0 * expected.sqrt(),
                    "{dependence:?} {point:?} {count}"
                );
            }
            // In the middle of a step of the curve, far from where the counting error could reach another one.
            for years in [150.0, 130.0] {
                let at = reached_once_in(years, found.events.iter().map(|one| one.loss));
                assert_eq!(
                    at,
                    loss_at_return_period(&curve, years),
                    "{dependence:?} {years}"
                );
            }
        }
    }

    /// Exponential losses of mean m above a deductible d, at most l: ν m (e^(−d/m) − e^(−(d + l)/m)) a year; and the same
    /// terms as a policy pay the same for one site.
    #[test]
    fn terms_are_those_of_the_closed_form() {
        let (rate, m, terms) = (
            0.05,
            100.0,
            Terms {
                deductible: 50.0,
                limit: 120.0,
            },
        );
        let n = 100_000;
        // Quantiles in the middle of each step: the error of the mean of a monotone function is of the order 1/n.
        let losses: Vec<f64> = (0..n)
            .map(|i| -m * ((f64::from(i) + 0.5) / f64::from(n)).ln())
            .collect();
        let expected = rate * m * ((-50.0 / m).exp() - (-170.0 / m).exp());
        let own = site(&[rate], &[&losses], terms);
        assert!((own.expected_payment_per_year() / expected - 1.0).abs() < 1e-4);
        let (by_site, error) = mean(
            simulate(&[own], &Dependence::Independent, Terms::ALL, 3)
                .events
                .iter()
                .map(|one| one.paid),
        );
        assert!((by_site - expected).abs() < 5.0 * error);
        let without = site(&[rate], &[&losses], Terms::ALL);
        let (by_policy, _) = mean(
            simulate(&[without], &Dependence::Independent, terms, 3)
                .events
                .iter()
                .map(|one| one.paid),
        );
        assert!((by_policy - by_site).abs() < 1e-9);
    }

    /// A site where nothing falls adds nothing.
    #[test]
    fn a_site_without_losses_adds_nothing() {
        let none = site(&[], &[], Terms::ALL);
        let [one, _] = two();
        for dependence in [Dependence::Independent, Dependence::Common] {
            let alone = simulate(std::slice::from_ref(&none), &dependence, Terms::ALL, 6);
            assert_eq!((alone.events.len(), alone.totals.len()), (0, 0));
            let both = simulate(&[one.clone(), none.clone()], &dependence, Terms::ALL, 6);
            assert_eq!(
                both,
                simulate(std::slice::from_ref(&one), &dependence, Terms::ALL, 6)
            );
        }
    }

    /// Annual totals of equal losses are compound Poisson: the share of years with two or more is 1 − e^−ν (1 + ν).
    #[test]
    fn yearly_totals_are_a_compound_poisson_process() {
        let one = site(&[0.1], &[&[1.0]], Terms::ALL);
        let found = simulate(&[one], &Dependence::Independent, Terms::ALL, 4);
        let years = f64::from(SIMULATED_YEARS);
        let expected = (1.0 - (-0.1f64).exp() * 1.1) * years;
        let count = found.totals.iter().filter(|year| year.loss >= 2.0).count() as f64;
        assert!(
            (count - expected).abs() < 5.0 * expected.sqrt(),
            "{count} {expected}"
        );
    }

    /// The correlated strengths of two sites of one level each, half as often as earthquakes come: both are reached
    /// with the orthant probability ¼ + asin(ρ)/2π, and at one place always together.
    #[test]
    fn ranks_are_correlated_as_stated() {
        let pair = [
            site(&[0.05, 0.05], &[&[0.0], &[1.0]], Terms::ALL),
            site(&[0.05, 0.05], &[&[0.0], &[2.0]], Terms::ALL),
        ];
        let h = |km: f64| vec![vec![0.0, km], vec![km, 0.0]];
        for (distance_km, rho) in [(0.0, 1.0), (5.0, (-0.75f64).exp()), (1e6, 0.0)] {
            let dependence = Dependence::Correlated(correlations(&h(distance_km), 20.0));
            let found = simulate(&pair, &dependence, Terms::ALL, 5);
            let both = found.events.iter().filter(|one| one.loss == 3.0).count() as f64;
            let expected =
                0.1 * f64::from(SIMULATED_YEARS) * (0.25 + f64::asin(rho) / std::f64::consts::TAU);
            assert!(
                (both - expected).abs() < 5.0 * expected.sqrt(),
                "{rho} {both} {expected}"
            );
        }
    }
}
