//! What gives a spectrum of Eurocode 8 its shape: its type, the ground, the corner periods.

use super::{CodeSpectrumError, class_named};

/// Type of spectrum, EN 1998-1, 3.2.2.2(2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SpectrumType {
    /// Type 1: earthquakes with surface-wave magnitudes above 5.5 contribute most to the hazard.
    Type1,
    /// Type 2: magnitudes of 5.5 or less, usual where seismicity is low.
    Type2,
}

impl SpectrumType {
    /// The number of the type.
    pub fn number(self) -> u8 {
        match self {
            Self::Type1 => 1,
            Self::Type2 => 2,
        }
    }
}

/// Ground type, EN 1998-1, Table 3.1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
pub enum GroundType {
    /// Rock.
    A,
    /// Very dense sand, gravel or very stiff clay.
    B,
    /// Dense or medium-dense sand, gravel or stiff clay.
    C,
    /// Loose-to-medium soil or soft-to-firm clay.
    D,
    /// A surface layer of 5 to 20 m of C or D over stiff material.
    E,
}

impl GroundType {
    /// All types, in the order of the code.
    pub const ALL: [Self; 5] = [Self::A, Self::B, Self::C, Self::D, Self::E];

    /// The type as the code writes it.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The type in words.
    pub fn description(self) -> &'static str {
        match self {
            Self::A => "rock",
            Self::B => "very dense sand or gravel, very stiff clay",
            Self::C => "dense or medium-dense sand or gravel, stiff clay",
            Self::D => "loose-to-medium soil, soft-to-firm clay",
            Self::E => "a shallow layer of C or D over stiff material",
        }
    }

    /// The type with a given name, in upper or lower case.
    ///
    /// # Errors
    /// A name that is not one of the five; the code requires special studies for S1 and S2.
    pub fn parse(name: &str) -> Result<Self, CodeSpectrumError> {
        class_named(&Self::ALL, name, "A, B, C, D, E")
    }
}

/// The shape of a horizontal spectrum: soil factor and corner periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumShape {
    /// Soil factor S.
    pub soil_factor_ratio: f64,
    /// Period at which the plateau begins, TB \[s\].
    pub tb_s: f64,
    /// Period at which it ends, TC \[s\].
    pub tc_s: f64,
    /// Period at which constant displacement begins, TD \[s\].
    pub td_s: f64,
}

impl SpectrumShape {
    /// The recommended values; national annexes may differ.
    ///
    /// # Reference
    /// EN 1998-1:2004, Tables 3.2 and 3.3.
    pub fn recommended(spectrum_type: SpectrumType, ground: GroundType) -> Self {
        let (soil_factor_ratio, tb_s, tc_s) = match (spectrum_type, ground) {
            (SpectrumType::Type1, GroundType::A) => (1.0, 0.15, 0.4),
            (SpectrumType::Type1, GroundType::B) => (1.2, 0.15, 0.5),
            (SpectrumType::Type1, GroundType::C) => (1.15, 0.20, 0.6),
            (SpectrumType::Type1, GroundType::D) => (1.35, 0.20, 0.8),
            (SpectrumType::Type1, GroundType::E) => (1.4, 0.15, 0.5),
            (SpectrumType::Type2, GroundType::A) => (1.0, 0.05, 0.25),
            (SpectrumType::Type2, GroundType::B) => (1.35, 0.05, 0.25),
            (SpectrumType::Type2, GroundType::C) => (1.5, 0.10, 0.25),
            (SpectrumType::Type2, GroundType::D) => (1.8, 0.10, 0.30),
            (SpectrumType::Type2, GroundType::E) => (1.6, 0.05, 0.25),
        };
        let td_s = match spectrum_type {
            SpectrumType::Type1 => 2.0,
            SpectrumType::Type2 => 1.2,
        };
        Self {
            soil_factor_ratio,
            tb_s,
            tc_s,
            td_s,
        }
    }
}
