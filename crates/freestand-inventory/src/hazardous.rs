//! Names of things whose fall hurts people, in some languages.

use freestand_input::words::canonical;

/// Words by which gas cylinders are recognised, in the form of [`canonical`].
const CYLINDERS: [&str; 24] = [
    "cylinder",
    "gas bottle",
    "oxygen bottle",
    "gasflasche",
    "gas flasche",
    "sauerstoffflasche",
    "bouteille de gaz",
    "bouteilles de gaz",
    "bouteille d oxygene",
    "bouteilles d oxygene",
    "bombola",
    "bombole",
    "bombona",
    "cilindro de gas",
    "cilindros de gas",
    "cilindro de oxigeno",
    "cilindros de oxigeno",
    "botella de gas",
    "botellas de gas",
    "botella de oxigeno",
    "botellas de oxigeno",
    "garrafa de oxigenio",
    "oksijen tupu",
    "气瓶",
];

/// Cylinders that hold no gas: glassware, parts of machines and of locks, test pieces. A list that calls a gas
/// cylinder just "cylinder" is common, so these are left out, and no gas is asked for.
const OTHER_CYLINDERS: [&str; 19] = [
    "measuring cylinder",
    "graduated cylinder",
    "mixing cylinder",
    "glass cylinder",
    "hydraulic cylinder",
    "pneumatic cylinder",
    "master cylinder",
    "brake cylinder",
    "engine cylinder",
    "cylinder head",
    "cylinder block",
    "cylinder lock",
    "lock cylinder",
    "concrete cylinder",
    "test cylinder",
    "cylinder graduated",
    "cylinder measuring",
    "cylinder recorder",
    "cylinder seal",
];

/// Words by which incubators of children and beds are recognised, in which somebody lies. An incubator alone may be
/// one of a laboratory.
const LAIN_IN: [&str; 9] = [
    "neonatal incubator",
    "infant incubator",
    "infant warmer",
    "incubadora neonatal",
    "incubatrice neonatale",
    "couveuse",
    "kuvoz",
    "hospital bed",
    "patient bed",
];

fn has_one_of(text: &str, words: &[&str]) -> bool {
    words.iter().any(|word| text.contains(word))
}

/// Whether a name is that of a gas cylinder.
pub fn is_gas_cylinder(name: &str) -> bool {
    let mut text = canonical(name);
    for other in OTHER_CYLINDERS {
        text = text.replace(&format!("{other}s"), "").replace(other, "");
    }
    has_one_of(&text, &CYLINDERS)
}

/// Whether a name is that of something in which somebody lies.
pub fn is_lain_in(name: &str) -> bool {
    has_one_of(&canonical(name), &LAIN_IN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_measuring_cylinder_holds_no_gas() {
        for gas in [
            "Gas cylinders, G size",
            "O2 cylinder",
            "Cylinder",
            "Sauerstoffflasche 50 l",
            "Bombola di ossigeno",
            "Oxygen cylinder and measuring cylinders",
            "Gas-Flasche O2",
            "Bouteilles de gaz",
            "Bouteille d'oxygène",
            "Bombole",
            "Cilindros de gas",
            "Cilindro de oxígeno",
            "Garrafa de oxigénio",
            "Oksijen tüpü",
            "氧气瓶",
            "Oxygen bottle",
        ] {
            assert!(is_gas_cylinder(gas), "{gas}");
        }
        for other in [
            "Measuring cylinder, 2 l",
            "Rack of graduated cylinders",
            "Hydraulic cylinder",
            "Engine, cylinder head",
            "Cylinder seal (Akkadian)",
            "Cylinder recorder",
            "Cylinder (graduated)",
            "Cylinder, measuring, 500 ml",
            "Cabinet",
        ] {
            assert!(!is_gas_cylinder(other), "{other}");
        }
    }

    #[test]
    fn somebody_lies_in_an_incubator_of_infants_and_not_in_one_of_a_laboratory() {
        assert!(is_lain_in("Infant incubators") && is_lain_in("Hospital bed, electric"));
        assert!(!is_lain_in("CO2 incubator") && !is_lain_in("Flower bed"));
    }
}
