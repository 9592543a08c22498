//! What a request is about, and which of its values do not apply to that.

use crate::body;

/// What a request is about: its words choose it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Rigid,
    Slides,
    OnPads,
    InSpace,
    AtWallOnPads,
    Stack,
    Shape,
    Scan,
}

impl Kind {
    /// Whether it is a body on the points of its hull.
    pub(super) fn is_body(self) -> bool {
        matches!(self, Self::Shape | Self::Scan)
    }

    /// What it is, for a value that does not apply to it.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Rigid => "an object on a rigid base",
            Self::Slides => "an object that slides or rolls",
            Self::OnPads => "an object on cushions",
            Self::InSpace => "an object in three dimensions",
            Self::AtWallOnPads => "an object on cushions at a wall",
            Self::Stack => "a stack",
            Self::Shape => "a shape in three dimensions",
            Self::Scan => "a scan",
        }
    }

    /// A value that does not apply to it, and what to do about it.
    pub(super) fn refusal(self, key: &str) -> (String, &'static str) {
        let on_cushions = matches!(
            self,
            Self::OnPads | Self::InSpace | Self::AtWallOnPads | Self::Stack
        );
        let only = |home: &str| format!("`{key}` applies only to {home}");
        let not = || format!("`{key}` does not apply to {}", self.words());
        let is_of_cushions =
            OF_CUSHIONS.contains(&key) || OF_SPACE.contains(&key) || OF_STACK.contains(&key);
        match key {
            "height" | "thickness" | "width" | "diameter" if self == Self::Scan => (
                format!("`{key}` does not apply to a scan"),
                "leave it out: the size of a scan follows from its file and `scan_unit`",
            ),
            _ if body::OF_SCAN.contains(&key) && self == Self::Shape => {
                (only("a scan"), "add `scan`, or leave it out")
            }
            "initial_rotation" | "initial_velocity" | "duration" if self.is_body() => (
                not(),
                "leave it out: it starts from rest, and is followed until it rests or lies",
            ),
            _ if body::KEYS.contains(&key) && on_cushions => (
                only("a stiff floor"),
                "leave it out, or leave `base` and the cushion out",
            ),
            _ if body::KEYS.contains(&key) && self == Self::Rigid => (
                only("a shape or a scan in three dimensions"),
                "add `shape` or `scan`, or leave it out",
            ),
            "width" if self == Self::Slides => (
                only("an object that slides under both components"),
                "add `motion_y` or `components`, or leave it out",
            ),
            _ if body::KEYS.contains(&key) && self == Self::Slides => (
                only("an object that rocks"),
                "leave it out, or leave `sliding` or `casters` out",
            ),
            _ if OF_SPACE.contains(&key) && !on_cushions && !self.is_body() => (
                only("an object in three dimensions"),
                "add `shape` for a stiff floor or `base = \"compliant\"` for cushions, or leave it out",
            ),
            _ if is_of_cushions && !on_cushions && !self.is_body() => (
                only("a compliant base"),
                "add `base = \"compliant\"`, or leave it out",
            ),
            "wall_height" if self.is_body() => (
                not(),
                "leave it out: the wall is taller than the object, and where the upper edge of a lower one would meet \
                     its surface is not calculated",
            ),
            "wall_restitution" if self.is_body() => (
                only("a rigid base"),
                "leave it out: on the hull, what an impact at a wall returns follows from `wall_stiffness` and `wall_damping`",
            ),
            "wall_damping" if self == Self::Rigid => (
                only("a compliant base or a shape"),
                "leave it out, or give `wall_restitution`",
            ),
            "wall_restitution" if on_cushions => (
                only("a rigid base"),
                "leave it out: on cushions, what an impact at a wall returns follows from its cushion, which \
                 `wall_stiffness` describes",
            ),
            "restitution" | "restitution_factor" | "model" if on_cushions => (
                only("a rigid base"),
                "leave it out: on cushions, the equations of motion determine the energy lost in a landing",
            ),
            _ if OF_SLIDING.contains(&key) && on_cushions => (
                only("a rigid base"),
                "leave it out: on cushions, `friction` decides whether the object slides",
            ),
            "brakes" | "rolling_resistance" if self == Self::Rigid => (
                only("an object on casters"),
                "add `casters`, or leave it out",
            ),
            _ if OF_SLIDING.contains(&key) => (
                only("objects that slide or roll"),
                "add `sliding`, or `casters`",
            ),
            _ if self == Self::Slides && key.starts_with("wall") => (
                only("an object that rocks"),
                "leave it out: the room beside it is `clearance_left` and `clearance_right`, what it strikes there \
                 `stop_stiffness`",
            ),
            _ if self == Self::Slides => (
                only("an object that rocks"),
                "leave it out, or leave `sliding` or `casters` out",
            ),
            "initial_rotation" | "initial_velocity" => {
                (not(), "leave it out: a stack starts from rest")
            }
            "base_width" | "cg_height" | "cg_offset" | "inertia" => (
                not(),
                "leave it out: the object is uniform, on the edges of its base",
            ),
            _ if self == Self::Stack => (
                not(),
                "leave it out: a stack stands freely and moves in the plane of the thickness",
            ),
            _ => (not(), "leave it out"),
        }
    }
}

const OF_CUSHIONS: [&str; 6] = [
    "tangential_stiffness",
    "tangential_ratio",
    "no_slip",
    "contacts",
    "cg_rise",
    "at_point",
];
const OF_SLIDING: [&str; 8] = [
    "sliding",
    "casters",
    "rolling_resistance",
    "brakes",
    "friction_kinetic",
    "clearance_left",
    "clearance_right",
    "stop_stiffness",
];
pub(super) const OF_SPACE: [&str; 4] = ["width", "motion_y", "components", "orientation"];
pub(super) const OF_STACK: [&str; 5] = [
    "upper_height",
    "upper_thickness",
    "upper_mass",
    "interface_stiffness",
    "interface_friction",
];
