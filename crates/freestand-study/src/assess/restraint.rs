//! Forces to fix an object with.

/// TEMPORARY
pub fn clearance_m(height_m: f64, thickness_m: f64, rotation_rad: f64) -> f64 {
    height_m * rotation_rad.sin() + thickness_m * (1.0 - rotation_rad.cos())
}
