//! What each anchor of an object carries, and what it can carry.

use super::force::RestraintForce;

/// What each anchor carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnchorForces {
    /// Tension \[N\].
    pub tension_n: f64,
    /// Tension in concrete \[N\].
    pub tension_concrete_n: f64,
    /// Shear \[N\].
    pub shear_n: f64,
    /// Shear in concrete \[N\].
    pub shear_concrete_n: f64,
}

/// Of each of so many anchors along each of two edges: those of one edge share the tension, all of
/// them the force.
pub fn of_each_anchor(force: &RestraintForce, anchors_per_edge: usize) -> AnchorForces {
    let count = anchors_per_edge as f64;
    let shear_n = force.force_n / (2.0 * count);
    AnchorForces {
        tension_n: force.anchor_tension_n / count,
        tension_concrete_n: force.anchor_tension_concrete_n / count,
        shear_n,
        shear_concrete_n: force.source.overstrength_ratio() * shear_n,
    }
}

/// Force of a bracket at another height than that of `force` \[N\]: the moment about the feet, F c, stays the same.
pub fn bracket_at(force: &RestraintForce, height_m: f64) -> f64 {
    force.bracket_force_n * force.bracket_height_m / height_m
}

/// An anchor that the user has chosen.
#[derive(Debug, Clone, PartialEq)]
pub struct Anchor {
    /// Its name.
    pub name: Option<String>,
    /// Design capacity in tension \[N\].
    pub tension_n: f64,
    /// Design capacity in shear, where it is known \[N\].
    pub shear_n: Option<f64>,
}

impl Anchor {
    /// Demand over capacity: N/N_d, and V/V_d added where V_d is known. The sum is on the safe side of the
    /// curves by which codes combine both. The demand is that in concrete, which is never the smaller one.
    pub fn demand_capacity_ratio(&self, demand: &AnchorForces) -> f64 {
        let shear_ratio = self
            .shear_n
            .map_or(0.0, |shear_n| demand.shear_concrete_n / shear_n);
        demand.tension_concrete_n / self.tension_n + shear_ratio
    }
}
