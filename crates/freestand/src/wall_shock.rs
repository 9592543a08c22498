//! The shock where an object strikes a wall.

use crate::block::{Block, Pivot};
use crate::rocking::SideExtremes;
use crate::wall::Contact;

/// What an impact on a wall does to the object. The force is normal to the wall and acts at the
/// point of contact; the foot of the object may lift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallShock {
    contact: Contact,
    /// m_c/m, see [`Contact::effective_mass_ratio`].
    effective_mass_ratio: f64,
    /// I₀/m about the pivot edge \[m²\].
    inertia_per_mass_m2: f64,
}

impl WallShock {
    /// The shock of `block`, which turns about `pivot`, at this contact.
    pub fn new(block: &Block, pivot: Pivot, contact: Contact) -> Self {
        let effective_mass_ratio = contact.effective_mass_ratio(block);
        Self {
            contact,
            effective_mass_ratio,
            inertia_per_mass_m2: pivot.inertia_per_mass_m2,
        }
    }

    /// On the right and on the left side; `None` where there is no contact.
    pub fn of_sides(block: &Block, contacts: [Option<Contact>; 2]) -> [Option<Self>; 2] {
        let [right, left] = contacts;
        let shock = |contact: Option<Contact>, pivot| {
            contact.map(|contact| Self::new(block, pivot, contact))
        };
        [
            shock(right, block.right_pivot()),
            shock(left, block.pivot()),
        ]
    }

    /// v_w = |ω⁻|ℓ: speed of the point of contact towards the wall \[m/s\].
    pub fn speed_m_s(&self, omega_rad_s: f64) -> f64 {
        omega_rad_s.abs() * self.contact.lever_m
    }

    /// a_w = v_w √(k_w/m_c): peak acceleration of the object at the point of contact, normal to its
    /// face \[m/s²\], for a wall of stiffness k_w \[N/m\].
    pub fn acceleration_m_s2(&self, omega_rad_s: f64, mass_kg: f64, stiffness_n_m: f64) -> f64 {
        self.speed_m_s(omega_rad_s) * (stiffness_n_m / (mass_kg * self.effective_mass_ratio)).sqrt()
    }

    /// I₀(1+e_w)|ω⁻|/ℓ: impulse of the wall \[N·s\].
    pub fn impulse_n_s(&self, omega_rad_s: f64, mass_kg: f64) -> f64 {
        let Contact {
            lever_m,
            restitution_ratio,
            ..
        } = self.contact;
        mass_kg * self.inertia_per_mass_m2 * (1.0 + restitution_ratio) * omega_rad_s.abs() / lever_m
    }
}

/// The largest of a quantity over the impacts on both walls, from the largest speeds of each side;
/// `None` without an impact.
pub fn largest(
    shocks: [Option<WallShock>; 2],
    sides: [SideExtremes; 2],
    quantity: impl Fn(&WallShock, f64) -> f64,
) -> Option<f64> {
    let struck = shocks
        .iter()
        .zip(sides)
        .filter(|(_, side)| side.wall_omega_rad_s > 0.0);
    struck
        .filter_map(|(shock, side)| Some(quantity(shock.as_ref()?, side.wall_omega_rad_s)))
        .reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::Wall;

    /// A slender rod that touches the wall: ℓ = h, m_c = m/4, I₀ = mh²/3. With t = h/1000 the terms
    /// in t/h are at most 1e-6.
    #[test]
    fn a_rod_has_the_closed_forms() {
        let rod = Block::uniform(2.0, 0.002).unwrap();
        let contact = Wall::at(0.0).contact(&rod, rod.pivot()).unwrap().unwrap();
        let shock = WallShock::new(&rod, rod.pivot(), contact);
        assert_eq!(shock.speed_m_s(-0.5), 1.0);
        let acceleration = shock.acceleration_m_s2(0.5, 40.0, 1e5);
        assert!(
            (acceleration - (1e5f64 / 10.0).sqrt()).abs() < 1e-4 * acceleration,
            "{acceleration}"
        );
        let impulse = shock.impulse_n_s(0.5, 40.0);
        assert!(
            (impulse - 40.0 * 4.0 / 3.0 * 1.5 * 0.5 / 2.0).abs() < 1e-5 * impulse,
            "{impulse}"
        );
        let sides = [
            SideExtremes::default(),
            SideExtremes {
                wall_omega_rad_s: 0.5,
                ..SideExtremes::default()
            },
        ];
        assert_eq!(
            largest([Some(shock); 2], sides, WallShock::speed_m_s),
            Some(1.0)
        );
        assert_eq!(largest([None; 2], sides, WallShock::speed_m_s), None);
        assert_eq!(
            largest(
                [Some(shock); 2],
                [SideExtremes::default(); 2],
                WallShock::speed_m_s
            ),
            None
        );
    }
}
