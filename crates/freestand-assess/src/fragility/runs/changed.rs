//! Objects that are run as an option changes them.

use std::path::PathBuf;

/// What an option changes of an object; `None`: that stays.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Change {
    /// Stiffness under one edge \[N/m\].
    pub stiffness_n_m: Option<f64>,
    /// Distance between the edges in the direction of the thickness \[m\].
    pub base_thickness_m: Option<f64>,
    /// Mass \[kg\].
    pub mass_kg: Option<f64>,
}

/// An object as an option changes it.
#[derive(Debug, Clone, PartialEq)]
pub struct ChangedObject {
    /// Of the object.
    pub id: String,
    /// Of its curves, `ID/option`.
    pub curve_id: String,
    /// What changes.
    pub change: Change,
    /// The file of the options.
    pub file: PathBuf,
    /// Its line in that file, from 1.
    pub line: usize,
}
