//! Eqs. (5)–(8) with the numbers of an object, so that a reader can check them with a calculator.

use freestand::G0_M_S2;

use freestand_assess::result::Chain;
use freestand_input::words::number;
use freestand_inventory::Item;
use maud::{Markup, html};

use super::words;

/// The landing at the world that decides, step by step.
pub(super) fn equations(item: &Item, chain: &Chain) -> Markup {
    let said = format!(
        "The world that decides, the hardest once the accepted share of the worlds is left out, is {}. In \
         the plane of the {}, the centre of gravity rises by Δh = {} mm, and the uplift is {} mm.",
        chain.motion,
        chain.axis.name(),
        millimetres(chain.cg_rise_m),
        millimetres(chain.uplift_m)
    );
    let mut lines = geometry(item, chain);
    match chain.stiffness_n_m {
        Some(stiffness_n_m) => lines.extend(spring(chain, stiffness_n_m)),
        None => lines.push(format!(
            "The cushion is not a linear spring, so the landing is solved numerically: m_eff at v gives a_edge = {} g, \
             Δv = {} m/s, T = {} ms.",
            number(chain.edge_acceleration_g, 4),
            number(chain.velocity_change_m_s, 4),
            number(1e3 * chain.pulse_duration_s, 4)
        )),
    }
    lines.push(format!(
        "The velocity before the impact gives a_edge = {} g. The verdict uses the larger of the two values.",
        number(chain.edge_acceleration_impact_velocity_g, 4)
    ));
    if let Some(ratio) = chain.demand_capacity_ratio {
        lines.push(format!(
            "Demand/capacity in this world: {}.",
            number(ratio, 4)
        ));
    }
    html! {
        p { (said) }
        div.eqs { @for line in lines { p.eq { (words(&line)) } } }
    }
}

/// A length in mm, as the rest of the page has them.
fn millimetres(length_m: f64) -> String {
    number(1e3 * length_m, 4)
}

/// R, R_D and m_eff.
fn geometry(item: &Item, chain: &Chain) -> Vec<String> {
    let [h, t, b, r] = [
        chain.height_m,
        chain.thickness_m,
        chain.base_m,
        chain.half_diagonal_m,
    ]
    .map(millimetres);
    let m = number(chain.mass_kg, 4);
    let (r_d, m_eff) = (
        number(chain.landing_ratio, 4),
        number(chain.effective_mass_kg, 4),
    );
    let halted = "The landing is halted (no rocking after it): Eq. (8), with R_D = 0 in the shock."
        .to_owned();
    if chain.is_uniform {
        let x = number((chain.base_m / chain.half_diagonal_m).powi(2), 4);
        let mass = if chain.is_halted {
            format!("m_eff = m/(0.75 (d/R)²) = {m_eff} kg")
        } else {
            format!("m_eff = m (1 − 0.1875 (d/R)²) = {m} × (1 − 0.1875 × {x}) = {m_eff} kg")
        };
        let mut lines = vec![
            format!("R = ½ √(h² + t²) = ½ √({h}² + {t}²) = {r} mm, (d/R)² = ({t}/{r})² = {x}"),
            format!("(6)  R_D = 1 − ⅜ (d/R)² = {r_d}"),
            mass,
        ];
        lines.extend(chain.is_halted.then_some(halted));
        return lines;
    }
    let cg_m = item.cg_height_m.unwrap_or(0.5 * chain.height_m);
    let inertia = (chain.height_m.powi(2) + chain.thickness_m.powi(2)) / 12.0
        + cg_m * cg_m
        + 0.25 * chain.base_m * chain.base_m;
    let (z, i0) = (millimetres(cg_m), number(1e6 * inertia, 4));
    let mass = if chain.is_halted {
        "m I₀′/B²"
    } else {
        "m I₀′ (1 − R_D²)/B²"
    };
    let mut lines = vec![
        format!("R = √((B/2)² + z²) = √(({b}/2)² + {z}²) = {r} mm"),
        format!("I₀′ = I₀/m = (h² + t²)/12 + R² = {i0} mm²"),
        format!(
            "R_D = 1 − B²/(2 I₀′) = {r_d} (Eq. (6) for a block that is not uniform or has inset feet)"
        ),
        format!("m_eff = {mass} = {m_eff} kg"),
    ];
    lines.extend(chain.is_halted.then_some(halted));
    lines
}

/// a, a_edge, Δv and T on a spring.
fn spring(chain: &Chain, stiffness_n_m: f64) -> Vec<String> {
    let k = format!("{} N/mm", number(1e-3 * stiffness_n_m, 4));
    let (a, edge) = (
        number(chain.drop_acceleration_g, 4),
        number(chain.edge_acceleration_g, 4),
    );
    let drop = format!(
        "(7)  a = √(2 k g Δh/m) = √(2 × {k} × {} m/s² × {} mm/{} kg) = {a} g",
        number(G0_M_S2, 6),
        number(1e3 * chain.cg_rise_m, 4),
        number(chain.mass_kg, 4)
    );
    let shock = match (chain.is_uniform, chain.is_halted) {
        (true, false) => format!("(5)  a_edge = ¾ (1 − R_D²)^(−½) (d/R)² a = {edge} g"),
        (true, true) => format!("(8)  a_edge = ¾ (d/R)² a = {edge} g"),
        (false, _) => format!("a_edge = v √(k/m_eff), v = B √(2 g Δh/I₀′): {edge} g"),
    };
    vec![
        drop,
        shock,
        format!("Δv = 2 v = {} m/s", number(chain.velocity_change_m_s, 4)),
        format!(
            "T = π √(m_eff/k) = {} ms",
            number(1e3 * chain.pulse_duration_s, 4)
        ),
    ]
}
