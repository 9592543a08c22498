//! Objects that are run as an option changes them.

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
    /// Its line in the file of the options.
    pub line: usize,
}
