//! Made-up objects of each decision, to see what the pages do with them.

use freestand::rocking::Restitution;
use freestand_study::assess::overview::Overview;
use freestand_study::assess::result::{
    AxisResponse, CapacityCheck, Chain, CompliantCheck, FloorFacts, Probability, Response, RestraintForce, Shock,
    Sliding, Softening, Swing,
};
use freestand_study::assess::table::Line;
use freestand_study::assess::{Assessment, Decision, Head, Row};
use freestand_study::inventory::{Consequences, Item, Rating};
use freestand_study::library::{Confidence, Tolerance};
use freestand_study::result::Ranked;

pub(crate) fn head() -> Head {
    let pair = |name: &str, value: &str| (name.to_owned(), value.to_owned());
    Head {
        facts: vec![
            pair(
                "Inventory",
                "inventory.csv, 4 rows, SHA-256 0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef",
            ),
            pair("Hazard", "AS 1170.4-2007, Melbourne, site De, 500 years"),
            pair("Building", "8 storeys of 3.6 m, period 0.91 s, damping 5 %"),
        ],
        assumptions: vec!["A probability of 10 % is accepted where the owner states none.".to_owned()],
        warnings: vec!["Three rows have no tolerance.".to_owned()],
        total: 4,
    }
}

pub(crate) fn item(number: u32) -> Item {
    Item {
        row: number + 1,
        id: format!("H-{number:03}"),
        item: "Drug cabinet, tall".to_owned(),
        quantity: 2,
        priority: "1".to_owned(),
        location: String::new(),
        building: "Main".to_owned(),
        floor: format!("Level {}", number % 3),
        room: "Ward pharmacy".to_owned(),
        consequences: Consequences {
            life_safety: Some(Rating::High),
            property: Some(Rating::Low),
            function: Some(Rating::Medium),
        },
        level_ratio: Some(f64::from(number % 3) / 2.0),
        height_m: Some(1.95),
        thickness_m: Some(0.45),
        width_m: Some(0.9),
        base_thickness_m: None,
        base_width_m: None,
        cg_height_m: Some(0.9),
        mass_kg: Some(140.0),
        cushion: None,
        cushion_log_sd: None,
        cushion_source: Some("rubber-pad-40-shore: handbook (range)".to_owned()),
        tolerance: Some(Tolerance {
            peak_m_s2: Some(49.0),
            duration_s: Some(0.011),
            velocity_change_m_s: None,
            edge_lift_m: None,
            source: "the inventory".to_owned(),
            confidence: Confidence::Stated,
        }),
        restitution: Restitution::Factor(0.95),
        friction_ratio: Some((0.3, 0.5)),
        accepted_ratio: None,
        notes: "Photo 12; doors are locked".to_owned(),
        carried: Vec::new(),
    }
}

fn bare(decision: Decision, why: &str) -> Assessment {
    Assessment {
        id: String::new(),
        decision,
        why: why.to_owned(),
        tier: 0,
        accepted_ratio: 0.1,
        accepted_for: "default".to_owned(),
        floor: None,
        response: None,
        shock: None,
        capacity: None,
        p_overturn: None,
        p_exceed: None,
        draws: 0,
        sliding: None,
        softening: None,
        compliant: None,
        tornado: Vec::new(),
        restraint: Vec::new(),
        clearance_m: None,
        context: Vec::new(),
        chain: None,
        notes: Vec::new(),
    }
}

fn values(low: f64, median: f64, high: f64) -> [Ranked; 3] {
    [low, median, high].map(Ranked::Value)
}

fn response() -> Response {
    let axis = |axis: &str, alpha: f64| AxisResponse {
        axis: axis.to_owned(),
        slenderness_angle_rad: alpha,
        half_diagonal_m: 1.0006,
        uplift_threshold_g: alpha.tan(),
        uplift_share: 0.8,
        overturn_share: 0.3,
        edge_acceleration_g: Some([Ranked::Value(1.2), Ranked::Value(4.1), Ranked::Overturned]),
        ceiling_g: Some(6.2),
    };
    Response {
        motions: 10,
        failed: 1,
        failure: Some("the record ends while the object still rocks".to_owned()),
        uplift_share: 0.8,
        overturn_share: 0.3,
        uplift_m: [Ranked::Value(0.004), Ranked::Value(0.031), Ranked::Overturned],
        rotation_ratio: [Ranked::Value(0.04), Ranked::Value(0.31), Ranked::Overturned],
        impacts_max: 87,
        axes: vec![axis("thickness", 0.2267), axis("width", 0.4324)],
    }
}

fn swing(parameter: &str, at: (Ranked, Ranked), flips: bool) -> Swing {
    Swing {
        parameter: parameter.to_owned(),
        low: "0.8 ×".to_owned(),
        high: "1.25 ×".to_owned(),
        at_low: at.0,
        at_high: at.1,
        as_is: Ranked::Value(1.31),
        flips,
    }
}

/// With everything that there can be.
pub(crate) fn full(decision: Decision) -> Assessment {
    Assessment {
        tier: 2,
        floor: Some(FloorFacts { level_ratio: 0.5, pfa_g_median: 0.213, pfa_g_max: 0.301, pfv_m_s_median: 0.187 }),
        response: Some(response()),
        shock: Some(Shock {
            edge_acceleration_g: values(1.2, 4.3, 6.1),
            edge_acceleration_uplift_g: values(1.1, 4.1, 5.9),
            edge_acceleration_max_g: Some(6.3),
            pulse_duration_s: 0.0178,
            velocity_change_m_s: Ranked::Value(0.52),
            ceiling_g: 6.2,
            stiffness_n_m: Some(4.38e6),
            impacts_above_tolerance: Some(3),
        }),
        capacity: Some(CapacityCheck {
            demand_capacity: Ranked::Value(1.31),
            demand_capacity_p84: Ranked::Overturned,
            governing: "peak".to_owned(),
            tolerance: "5 g, 11 ms half-sine".to_owned(),
            source: "bench-equipment-operating: placeholder severity".to_owned(),
            decides: true,
            floor_ratio: Some(0.04),
        }),
        p_overturn: Some(Probability { value: 0.29, low: 0.24, high: 0.35 }),
        p_exceed: Some(Probability { value: 0.62, low: 0.56, high: 0.68 }),
        draws: 64,
        sliding: Some(Sliding { verdict: "possible".to_owned(), friction_ratio: (0.3, 0.5), is_stated: true }),
        softening: Some(Softening {
            max_stiffness_n_m: Some(1.9e6),
            stroke_m: Some(0.0031),
            pad_thickness_m: 0.02,
            edge_acceleration_g: Some(3.2),
            admissible: false,
            note: "it still overturns under 3 of 10 motions".to_owned(),
        }),
        compliant: Some(CompliantCheck { motions: 5, overturned: 2, shock_ratio: Some(0.84), agrees: true }),
        tornado: vec![
            swing("motion", (Ranked::Value(0.2), Ranked::Overturned), true),
            swing("stiffness", (Ranked::Value(1.17), Ranked::Value(1.46)), false),
            swing("restitution", (Ranked::Value(0.97), Ranked::Value(1.6)), true),
            swing("geometry", (Ranked::NoData, Ranked::Value(1.4)), false),
        ],
        restraint: vec![RestraintForce {
            source: "AS 1170.4-2007, section 8".to_owned(),
            force_n: 433.0,
            force_ratio: 0.315,
            anchor_tension_n: 178.0,
            note: "kpZ Ch(0) (1 + kc hx) ac Ic / Rc W = 0.315 W; Ic, ac, Rc assumed".to_owned(),
        }],
        clearance_m: Some(0.062),
        context: vec![
            "P-58 bookcase of 5 shelves under this floor's velocity: 38 % (FEMA P-58, E.20.22.105a).".to_owned(),
        ],
        chain: Some(Chain {
            motion: "motion 4".to_owned(),
            axis: "thickness".to_owned(),
            height_m: 2.3,
            thickness_m: 0.6,
            is_uniform: true,
            base_m: 0.6,
            half_diagonal_m: 1.18849,
            mass_kg: 140.0,
            stiffness_n_m: Some(4.38e6),
            cg_rise_m: 0.027,
            landing_ratio: 0.9044,
            is_halted: false,
            drop_acceleration_g: 13.13,
            effective_mass_kg: 133.3,
            edge_acceleration_g: 5.881,
            edge_acceleration_impact_velocity_g: 5.2,
            velocity_change_m_s: 0.6363,
            pulse_duration_s: 0.01733,
            uplift_m: 0.0694676,
            demand_capacity_ratio: Some(1.176),
        }),
        notes: vec!["The restitution is Housner's: a measured one is often lower.".to_owned()],
        ..bare(decision, "It overturns under 3 of 10 motions, and no pad can help against that.")
    }
}

/// One object of each decision; the third has nothing but an id.
pub(crate) fn rows(items: &[Item]) -> Vec<Row<'_>> {
    let found = |index: usize| match Decision::ALL[index % 4] {
        Decision::NoVerdict => bare(Decision::NoVerdict, "The height and the level are missing."),
        decision => full(decision),
    };
    items.iter().enumerate().map(|(index, item)| Row { rank: index + 1, item, found: found(index) }).collect()
}

pub(crate) fn overview(rows: &[Row<'_>], total: usize) -> Overview {
    let mut overview = Overview::new(total, 10);
    for row in rows {
        overview.add(&Line::of(row));
    }
    overview
}
