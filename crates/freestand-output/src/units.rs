//! The units that names of values end in.

/// Endings of names, longest first, each with its unit and the number of digits that people are
/// shown.
const UNITS: [(&str, &str, usize); 21] = [
    ("_m_s2", "m/s2", 4),
    ("_rad_s", "rad/s", 6),
    ("_m2_s", "m²/s", 4),
    ("_j_m3", "J/m³", 4),
    ("_m3_j", "m³/J", 5),
    ("_n_s_m", "N·s/m", 6),
    ("_n_m", "N/m", 6),
    ("_n_s", "N·s", 4),
    ("_m_s", "m/s", 4),
    ("_s_m", "s/m", 6),
    ("_ratio", "", 4),
    ("_rad", "rad", 6),
    ("_deg", "deg", 4),
    ("_kg", "kg", 4),
    ("_pa", "Pa", 6),
    ("_hz", "Hz", 6),
    ("_g", "g", 4),
    ("_j", "J", 4),
    ("_n", "N", 6),
    ("_m", "m", 6),
    ("_s", "s", 6),
];

/// The unit of the value called `name`, and the number of digits that people are shown.
pub(crate) fn unit_of(name: &str) -> Option<(&'static str, usize)> {
    UNITS
        .iter()
        .find(|(ending, ..)| name.ends_with(ending))
        .map(|&(_, unit, digits)| (unit, digits))
}

/// The unit of the values called `name`, which may have words after the unit (`uplift_m_median`) or
/// the unit in brackets (`pfv [m/s]`).
pub(crate) fn unit_within(name: &str) -> Option<&str> {
    if let Some((_, unit)) = name
        .strip_suffix(']')
        .and_then(|name| name.rsplit_once('['))
    {
        return Some(unit);
    }
    let mut heads = std::iter::successors(Some(name), |name| {
        name.rsplit_once('_').map(|(head, _)| head)
    });
    heads.find_map(unit_of).map(|(unit, _)| unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ending_comes_before_the_shorter_one_that_ends_it() {
        for (i, (ending, ..)) in UNITS.iter().enumerate() {
            let earlier = UNITS[..i]
                .iter()
                .find(|(shorter, ..)| ending.ends_with(shorter));
            assert!(earlier.is_none(), "{ending} is never reached: {earlier:?}");
        }
    }

    #[test]
    fn words_may_follow_the_unit() {
        let names = [
            "uplift_m_median",
            "edge_acceleration_g_max_of_survivors",
            "pfv_m_s_p16",
            "beta",
            "motions",
        ];
        assert_eq!(
            names.map(unit_within),
            [Some("m"), Some("g"), Some("m/s"), None, None]
        );
        assert_eq!(unit_within("pfv [m/s]"), Some("m/s"));
    }
}
