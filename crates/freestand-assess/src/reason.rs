//! Why a decision was made, and what else there is to know of an object, as data: `freestand-report` has the
//! words.

use freestand_input::words::listed;
use freestand_study::study::Unstated;
use serde::{Deserialize, Serialize};
use strum::{EnumCount, IntoStaticStr, VariantArray};

/// Why an object has its decision. The numbers are those of its [`Assessment`](crate::result::Assessment)
/// where a reason has none of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, EnumCount)]
#[serde(rename_all = "kebab-case")]
pub enum Reason {
    /// It is reported as anchored, and nothing was assessed.
    Anchored,
    /// The study has no motion for its floor.
    NoMotion,
    /// What is not known, without which nothing is assessed.
    NotGiven(Vec<Missing>),
    /// It rolls or slides.
    Travels,
    /// Whether it falls.
    Falling {
        /// Whether an edge lifts in any world, by any model.
        lifts: bool,
    },
    /// Nothing but falling was asked.
    OnlyFalling {
        /// Because it has no tolerance.
        lacks_tolerance: bool,
    },
    /// What is not known, without which its shock is not.
    ShockUnknown(Vec<Missing>),
    /// Whether its tolerance is exceeded, by the criterion that governs.
    Shock(Option<Criterion>),
    /// Its tolerance was not checked against its source, and cannot decide.
    Unchecked,
    /// A softer pad was looked for.
    SofterPad,
    /// What exceeds its tolerance is the acceleration of the floor.
    FloorTooStrong,
    /// No softer pad would help.
    NoPadHelps(NoPad),
    /// Its stiffness is a range from the cushion library.
    StiffnessIsRange,
    /// It ends leaning on its wall.
    Leans {
        /// Worlds at whose end it leans.
        worlds: u32,
        /// Worlds in which it was followed.
        followed: u32,
    },
    /// Beside a wall its pads are not followed.
    PadsNotFollowed,
    /// It goes farther than it has room.
    NoRoom {
        /// How far it may slide where the list gives no clearance \[m\].
        room_m: Option<f64>,
    },
    /// Nobody stated the place or the building.
    Unstated(Unstated),
    /// Its friction is less than rocking needs, and its pads answer for both models.
    Slips(Slips),
    /// It moves in three dimensions.
    InSpace,
    /// Another object stands on it.
    Stacked,
    /// It falls, although the force of the code would not lift it.
    BeyondCode {
        /// Worlds in which it falls.
        overturned: u32,
        /// All worlds.
        worlds: u32,
    },
    /// What a wall would change for which the list gives none.
    BeforeWall,
    /// The other spectrum of the national annex decides, by its type.
    Spectrum(u8),
    /// The run was stopped before its worlds sufficed.
    Stopped {
        /// The worlds that it lived through.
        worlds: u32,
    },
}

/// What is not known of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, VariantArray)]
#[serde(rename_all = "kebab-case")]
pub enum Missing {
    /// A person's word for a size that nobody would believe.
    Confirmation,
    /// The height of its floor over that of the building.
    Level,
    /// Its height.
    Height,
    /// Its thickness.
    Thickness,
    /// Sizes that a block can have.
    Geometry,
    /// A shape, feet or a scan that can be used.
    Shape,
    /// Its width.
    Width,
    /// Its mass.
    Mass,
    /// The mass of what stands on it.
    UpperMass,
    /// The stiffness of its pads.
    Stiffness,
    /// What it withstands.
    Tolerance,
    /// The stiffness of its stop.
    StopStiffness,
}

impl Missing {
    /// What it is, such as `its mass`.
    pub fn words(self) -> &'static str {
        match self {
            Self::Confirmation => "a confirmation of its size",
            Self::Level => "its floor level",
            Self::Height => "its height",
            Self::Thickness => "its thickness",
            Self::Geometry => "a size that a block can have",
            Self::Shape => "a shape that can be used",
            Self::Width => "its width",
            Self::Mass => "its mass",
            Self::UpperMass => "the mass of what stands on it",
            Self::Stiffness => "its cushion",
            Self::Tolerance => "its tolerance",
            Self::StopStiffness => "the stiffness of its wall",
        }
    }

    /// The names of several.
    pub fn listed(all: &[Self]) -> String {
        let names: Vec<&str> = all.iter().map(|one| one.words()).collect();
        listed(&names)
    }
}

/// Those of these that are not known.
pub(crate) fn unknown<const N: usize>(known: [(bool, Missing); N]) -> Vec<Missing> {
    let open = known.into_iter().filter(|(is_known, _)| !is_known);
    open.map(|(_, missing)| missing).collect()
}

/// The criteria by which a tolerance can be exceeded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum Criterion {
    /// The peak of the shock.
    Peak,
    /// Peak and velocity change together.
    DamageBoundary,
    /// The velocity change of the shock.
    VelocityChange,
    /// The shock response spectrum of the pulse that the object withstands.
    Spectrum,
    /// The uplift.
    EdgeLift,
    /// The acceleration of the floor itself.
    FloorAcceleration,
    /// Overturning, which exceeds every tolerance.
    Overturning,
}

impl Criterion {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Why no softer pad helps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NoPad {
    /// It rolls on its casters.
    Rolls,
    /// It slides on its base.
    Slides,
    /// Its pads are not known.
    NoPads,
    /// Its uplift on a rigid base does not depend on the stiffness.
    Uplift,
    /// Its cushion is not a spring.
    NoSpring,
    /// What exceeds its tolerance does not depend on the pad.
    Other,
}

/// Worlds in which friction is less than rocking needs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Slips {
    /// How many.
    pub worlds: u32,
    /// Of how many.
    pub of: u32,
    /// The range of the friction.
    pub friction_ratio: (f64, f64),
}

/// What there is to know beside the reasons.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, EnumCount)]
#[serde(rename_all = "kebab-case")]
pub enum Note {
    /// The shock at its wall is not compared with its tolerance: mass or stiffness of the wall are not given.
    WallShockUnknown,
    /// The shock at its wall is not compared with its tolerance in three dimensions.
    WallShockNotCompared,
    /// Histories that failed.
    Failed {
        /// On its pads, else on a rigid base.
        on_pads: bool,
        /// How many.
        worlds: u32,
        /// Of how many.
        of: u32,
        /// The reason of the first.
        why: String,
    },
    /// Worlds in which it does not stand on its hull even before the floor moves, and which count as falls.
    TipsAtRest {
        /// How many.
        worlds: u32,
        /// Of how many.
        of: u32,
    },
    /// Worlds in which it flies, and its pads answer for both models.
    Flies {
        /// How many.
        worlds: u32,
        /// Of how many.
        of: u32,
    },
    /// It flies, and its pads are not known.
    FliesWithoutPads,
    /// Its friction is less than rocking needs, and no pads answer.
    SlipsWithoutPads {
        /// The worlds.
        slips: Slips,
        /// Why no pads answer.
        why: WithoutPads,
    },
    /// It moves in a plane where the study asks for three dimensions.
    Flat(Flat),
    /// In three dimensions one history is one realisation.
    OneRealisation,
    /// Its floor moves in one direction only.
    OneComponent,
    /// It is followed on the points of its hull, which is too mild; its pads do not count, and no shock is calculated.
    OnHull,
    /// The wall beside a body is lower than it, and is left out.
    LowWall,
    /// A stack moves in the plane of the thickness.
    StackInPlane,
    /// On the ground, synthetic worlds may have fewer of the rarest falls than recorded motions.
    LowestTail,
}

/// Why no pads answer where an object slides while it rocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WithoutPads {
    /// Beside a wall they are not followed.
    BesideWall,
    /// Mass or pads are not given.
    NotGiven,
    /// They are not followed.
    NotFollowed,
}

/// Why an object moves in a plane where the study asks for three dimensions.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Flat {
    /// These are not given.
    Missing(Vec<Missing>),
    /// Its base or its centre of gravity is not that of a uniform block.
    NotUniform,
    /// There are neighbours within its reach.
    Neighbours,
    /// Another body stands on it.
    Stack,
}
