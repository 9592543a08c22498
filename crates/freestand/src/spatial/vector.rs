//! Vectors, and rotations by unit quaternions (w, x, y, z).

pub(super) type Vector = [f64; 3];

/// (w, x, y, z), from body axes to those of the floor.
pub(super) type Turn = [f64; 4];

/// No rotation.
pub(super) const UPRIGHT: Turn = [1.0, 0.0, 0.0, 0.0];

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn sum(a: &Vector, b: &Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn difference(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// How far a rotation moves the end of a vector: (Q − I) p, without cancellation where the rotation
/// is small.
pub(super) fn moved(turn: &Turn, p: &Vector) -> Vector {
    let [w, axis @ ..] = turn;
    let twice = cross(axis, p).map(|part| 2.0 * part);
    let second = cross(axis, &twice);
    [w * twice[0] + second[0], w * twice[1] + second[1], w * twice[2] + second[2]]
}

/// Q p.
pub(super) fn turned(turn: &Turn, p: &Vector) -> Vector {
    sum(p, &moved(turn, p))
}

/// Qᵀ.
pub(super) fn back(turn: &Turn) -> Turn {
    [turn[0], -turn[1], -turn[2], -turn[3]]
}

/// q̇ = ½ q ⊗ (0, Ω), with Ω in body axes.
pub(super) fn turning(turn: &Turn, omega: &Vector) -> Turn {
    let [w, axis @ ..] = turn;
    let across = cross(axis, omega);
    [
        -0.5 * dot(axis, omega),
        0.5 * (w * omega[0] + across[0]),
        0.5 * (w * omega[1] + across[1]),
        0.5 * (w * omega[2] + across[2]),
    ]
}

/// The rotation by `angle_rad` about a horizontal axis that tilts a body towards the direction
/// `toward_rad` (0: +x, π/2: +y).
pub(super) fn tilted(angle_rad: f64, toward_rad: f64) -> Turn {
    let (sin, cos) = (0.5 * angle_rad).sin_cos();
    [cos, -sin * toward_rad.sin(), sin * toward_rad.cos(), 0.0]
}

/// The axis of a body that is vertical at rest, in floor axes.
pub(super) fn upward([w, x, y, z]: &Turn) -> Vector {
    [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)]
}
