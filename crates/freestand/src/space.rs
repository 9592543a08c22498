//! Vectors, and rotations by unit quaternions (w, x, y, z).

pub(crate) type Vector = [f64; 3];

/// (w, x, y, z), from body axes to those of the floor.
pub(crate) type Turn = [f64; 4];

/// No rotation.
pub(crate) const UPRIGHT: Turn = [1.0, 0.0, 0.0, 0.0];

#[inline]
pub(crate) fn cross(a: &Vector, b: &Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline]
pub(crate) fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub(crate) fn sum(a: &Vector, b: &Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline]
pub(crate) fn difference(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Q − I of a rotation: what it adds to a vector, without cancellation where it is small.
pub(crate) type Shift = [Vector; 3];

/// Q − I.
#[inline]
pub(crate) fn shift([w, x, y, z]: &Turn) -> Shift {
    [
        [
            -2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            -2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            -2.0 * (x * x + y * y),
        ],
    ]
}

/// (Q − I) p.
#[inline]
pub(crate) fn moved(shift: &Shift, p: &Vector) -> Vector {
    [dot(&shift[0], p), dot(&shift[1], p), dot(&shift[2], p)]
}

/// (Qᵀ − I) p.
#[inline]
pub(crate) fn moved_back(shift: &Shift, p: &Vector) -> Vector {
    let [a, b, c] = shift;
    [
        a[0] * p[0] + b[0] * p[1] + c[0] * p[2],
        a[1] * p[0] + b[1] * p[1] + c[1] * p[2],
        a[2] * p[0] + b[2] * p[1] + c[2] * p[2],
    ]
}

/// Q p: from body axes to those of the floor.
#[inline]
pub(crate) fn turned(shift: &Shift, p: &Vector) -> Vector {
    sum(p, &moved(shift, p))
}

/// Qᵀ p: from the axes of the floor to those of the body.
#[inline]
pub(crate) fn turned_back(shift: &Shift, p: &Vector) -> Vector {
    sum(p, &moved_back(shift, p))
}

/// q̇ = ½ q ⊗ (0, Ω), with Ω in body axes.
#[inline]
pub(crate) fn turning(turn: &Turn, omega: &Vector) -> Turn {
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
pub(crate) fn tilted(angle_rad: f64, toward_rad: f64) -> Turn {
    let (sin, cos) = (0.5 * angle_rad).sin_cos();
    [cos, -sin * toward_rad.sin(), sin * toward_rad.cos(), 0.0]
}
