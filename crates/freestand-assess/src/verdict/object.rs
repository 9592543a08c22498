//! One object as the models see it: its blocks about both axes, its cushion and its tolerance, or
//! what is missing.

use freestand::G0_M_S2;
use std::sync::Arc;

use freestand::block::Block;
use freestand::cushion::{ContactLaw, Cushion};
use freestand::hull::shapes::Outline;
use freestand::impact::ImpactModel;
use freestand::rocking::{Restitution, RockingSummary};
use freestand::sliding::Friction;
use freestand::spectra::{BEYOND_ALL_G, landings};
use freestand::worlds::WallDraw;

use freestand::wall::{Wall, Walls};
use freestand_study::hull::body::Upright;
use freestand_study::hull::{BodyInPose, BodyKind};
use freestand_study::sliding::DEFAULT_ROLLING_RESISTANCE;
use freestand_study::study::assessment::{Dimensions, Settings, WallUse};

use crate::reason::{Flat, Missing, unknown};
use crate::result::{Axis, TooMild};
use freestand_inventory::{Casters, Item, ItemShape, Surroundings, UpperBody};
use serde::{Deserialize, Serialize};

use crate::capacity::Capacity;

/// What the models need of an [`Item`].
#[derive(Debug, Clone)]
pub(crate) struct Subject {
    pub(crate) level_ratio: f64,
    /// The thickness comes first.
    pub(super) axes: Vec<AxisGeometry>,
    pub(super) restitution: Restitution,
    /// Of its base on the floor, lowest and highest; `None`: the list does not give it.
    pub(super) friction_ratio: Option<(f64, f64)>,
    pub(super) mass_kg: Option<f64>,
    pub(super) body: Option<Body>,
    pub(super) capacity: Option<Capacity>,
    pub(super) way: Way,
    /// Why it moves in a plane where the study asks for three dimensions.
    pub(super) flat: Option<Flat>,
    /// Why it may fall where it stands in its calculation.
    pub(super) too_mild: Option<TooMild>,
}

/// The model that answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Model {
    /// A rigid base and Eq. (5).
    Rigid,
    /// The compliant base.
    Pads,
}

/// The way in which an object is followed.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Way {
    /// It rocks about one axis at a time, with nothing within its reach: on a rigid base, and on its
    /// pads where they are known.
    Planar,
    /// The same beside a wall or neighbours, on a rigid base only.
    Walled(Beside),
    /// It rolls on free casters.
    Rolls(Gliding),
    /// It slides before an edge could lift.
    Slides(Gliding),
    /// In three dimensions on its pads, beside the wall behind it where it has one within its reach.
    Spatial(Option<Beside>),
    /// With another body on it, in the plane of the thickness, both on pads.
    Stack(Upper),
    /// In three dimensions on the points of its hull, on a stiff floor, beside what it has within its reach.
    Hull(Arc<BodyInPose>, Option<Beside>),
}

/// How far an object may slide where the list gives no clearance \[m\]: what stands beside furniture is
/// seldom nearer, and cables and pipes give way so far.
const SLIDING_ROOM_M: f64 = 0.05;

impl Way {
    /// How far it may roll or slide; `None`: it rocks, or it rolls and the list does not say \[m\].
    pub(super) fn room_m(&self) -> Option<f64> {
        match self {
            Self::Rolls(gliding) => gliding.clearance_m,
            Self::Slides(gliding) => Some(gliding.clearance_m.unwrap_or(SLIDING_ROOM_M)),
            Self::Planar | Self::Walled(_) | Self::Spatial(_) | Self::Stack(_) | Self::Hull(..) => {
                None
            }
        }
    }

    /// Whether a model can answer.
    pub(super) fn asks(&self, model: Model) -> bool {
        match self {
            Self::Planar => true,
            // Beside a wall, on casters and while it slides its pads are not followed.
            Self::Walled(_) | Self::Rolls(_) | Self::Slides(_) | Self::Hull(..) => {
                model == Model::Rigid
            }
            Self::Spatial(_) | Self::Stack(_) => model == Model::Pads,
        }
    }

    /// Whether its histories are followed one by one, and take long.
    pub(super) fn is_slow(&self) -> bool {
        matches!(self, Self::Spatial(_) | Self::Stack(_) | Self::Hull(..))
    }

    /// Whether it rocks and lands.
    pub(super) fn rocks(&self) -> bool {
        match self {
            Self::Planar | Self::Walled(_) | Self::Spatial(_) | Self::Stack(_) | Self::Hull(..) => {
                true
            }
            Self::Rolls(_) | Self::Slides(_) => false,
        }
    }

    /// What stands beside it and counts.
    pub(super) fn walls(&self) -> Option<&Beside> {
        match self {
            Self::Walled(beside) | Self::Spatial(Some(beside)) | Self::Hull(_, Some(beside)) => {
                Some(beside)
            }
            Self::Planar
            | Self::Rolls(_)
            | Self::Slides(_)
            | Self::Spatial(None)
            | Self::Stack(_)
            | Self::Hull(_, None) => None,
        }
    }

    /// How it rolls or slides; `None`: it rocks.
    pub(super) fn glides(&self) -> Option<&Gliding> {
        match self {
            Self::Rolls(gliding) | Self::Slides(gliding) => Some(gliding),
            Self::Planar | Self::Walled(_) | Self::Spatial(_) | Self::Stack(_) | Self::Hull(..) => {
                None
            }
        }
    }
}

/// Friction under a body on its hull where the list gives none, lowest and highest: as for the tests on a
/// shake table.
pub const HULL_FRICTION_RATIO: (f64, f64) = (0.4, 0.8);

/// An object nearer to a wall than this touches it: its back is not flat to a centimetre \[m\].
const TOUCHING_M: f64 = 0.01;

/// The body that stands on an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Upper {
    pub(super) height_m: f64,
    pub(super) thickness_m: f64,
    pub(super) mass_kg: f64,
}

/// The middle of a range.
pub fn middle((low, high): (f64, f64)) -> f64 {
    0.5 * (low + high)
}

/// What a shock depends on besides the motion of the block.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub(super) mass_kg: f64,
    pub(super) cushion: Cushion,
    pub(super) pad_thickness_m: Option<f64>,
    /// Standard deviation of ln k; `None`: the study's.
    pub(super) stiffness_spread: Option<f64>,
    /// ζ of the cushion as it was given; `None`: not measured.
    pub(super) damping_ratio: Option<f64>,
}

/// The object in one plane of motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AxisGeometry {
    pub(super) axis: Axis,
    pub(super) height_m: f64,
    pub(super) side_m: f64,
    base_m: Option<f64>,
    cg_height_m: Option<f64>,
    pub(super) block: Block,
}

impl AxisGeometry {
    fn new(
        axis: Axis,
        height_m: f64,
        side_m: f64,
        base_m: Option<f64>,
        cg_height_m: Option<f64>,
    ) -> Option<Self> {
        let mut block = Block::uniform(height_m, side_m).ok()?;
        if let Some(base_m) = base_m {
            // In an inventory feet never reach beyond their object, but options may add such feet.
            block = block.with_outriggers(base_m).ok()?;
        }
        if let Some(cg_height_m) = cg_height_m {
            block = block.with_cg_height(cg_height_m).ok()?;
        }
        Some(Self {
            axis,
            height_m,
            side_m,
            base_m,
            cg_height_m,
            block,
        })
    }

    /// Of a block of any shape, to which no factor applies.
    pub(super) fn of_block(block: Block) -> Self {
        let (height_m, side_m) = (block.height_m(), block.base_width_m());
        Self {
            axis: Axis::Thickness,
            height_m,
            side_m,
            base_m: None,
            cg_height_m: None,
            block,
        }
    }

    /// The block with its heights and sides multiplied by these factors; unchanged where the result
    /// is not a block.
    pub(super) fn scaled(&self, heights: f64, sides: f64) -> Block {
        if heights == 1.0 && sides == 1.0 {
            return self.block;
        }
        let times = |length_m: Option<f64>, factor: f64| length_m.map(|length_m| length_m * factor);
        let (base_m, cg_m) = (times(self.base_m, sides), times(self.cg_height_m, heights));
        Self::new(
            self.axis,
            self.height_m * heights,
            self.side_m * sides,
            base_m,
            cg_m,
        )
        .map_or(self.block, |scaled| scaled.block)
    }

    /// Whether Eqs. (5) and (6) hold as printed.
    pub(super) fn is_uniform(&self) -> bool {
        self.base_m.is_none() && self.cg_height_m.is_none()
    }
}

/// What stands beside an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Beside {
    /// Behind it, in the direction of the thickness \[m\].
    pub(super) wall_gap_m: Option<f64>,
    /// On both sides of it, in the direction of the width \[m\].
    pub(super) neighbour_gap_m: Option<f64>,
    pub(super) height_m: Option<f64>,
    /// `None`: drawn in each world.
    restitution_ratio: Option<f64>,
    /// k_w \[N/m\].
    pub(super) stiffness_n_m: Option<f64>,
}

impl Beside {
    fn new(of: &Surroundings) -> Self {
        Self {
            wall_gap_m: of.wall_gap_m,
            neighbour_gap_m: of.neighbour_gap_m,
            height_m: of.wall_height_m,
            restitution_ratio: of.wall_restitution,
            stiffness_n_m: of.wall_stiffness_n_m,
        }
    }

    /// The walls in the plane of an axis, with the values of a world.
    pub(super) fn walls(&self, axis: Axis, drawn: &WallDraw) -> Walls {
        let restitution_ratio = self.restitution_ratio.unwrap_or(drawn.restitution_ratio);
        let wall = |gap_m: f64| Wall {
            gap_m,
            height_m: self.height_m,
            restitution_ratio,
        };
        match axis {
            Axis::Thickness => {
                let behind = Walls {
                    left: self.wall_gap_m.map(wall),
                    right: None,
                };
                if drawn.is_on_left {
                    behind
                } else {
                    behind.mirrored()
                }
            }
            Axis::Width => {
                let beside = self.neighbour_gap_m.map(wall);
                Walls {
                    left: beside,
                    right: beside,
                }
            }
        }
    }

    /// How the object is followed beside it: what is out of its reach does not count.
    fn way(self, axes: &[AxisGeometry]) -> Way {
        if self.is_within_reach(axes) {
            Way::Walled(self)
        } else {
            Way::Planar
        }
    }

    /// Whether the object touches any of it.
    fn touches(&self) -> bool {
        let gaps_m = [self.wall_gap_m, self.neighbour_gap_m];
        gaps_m.into_iter().flatten().any(|gap_m| gap_m < TOUCHING_M)
    }

    /// Whether a body of this height may reach any of it.
    fn is_near(&self, height_m: f64) -> bool {
        let gaps_m = [self.wall_gap_m, self.neighbour_gap_m];
        gaps_m.into_iter().flatten().any(|gap_m| gap_m < height_m)
    }

    fn is_lower_than(&self, height_m: f64) -> bool {
        self.height_m.is_some_and(|wall_m| wall_m < height_m)
    }

    /// Whether the object can touch any of it.
    fn is_within_reach(&self, axes: &[AxisGeometry]) -> bool {
        let any = WallDraw {
            is_on_left: true,
            restitution_ratio: 0.0,
            stiffness_ratio: 1.0,
            damping_ratio: 0.0,
        };
        axes.iter().any(|one| {
            let contacts = self.walls(one.axis, &any).contacts(&one.block);
            // What cannot be used is for the solver to refuse.
            contacts.map_or(true, |contacts| contacts.iter().any(Option::is_some))
        })
    }
}

/// How an object rolls on its casters, or slides on its base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gliding {
    /// μ_r, or the friction of its base: lowest and highest.
    pub(super) resistance_ratio: (f64, f64),
    /// Whether the list gives it.
    pub(super) is_stated: bool,
    /// The way to a stop, on each side; `None`: nothing stops it \[m\].
    pub(super) clearance_m: Option<f64>,
    /// k_s of the stop \[N/m\].
    pub(super) stop_stiffness_n_m: Option<f64>,
}

impl Gliding {
    /// `None`: its largest resistance would let it rock.
    fn new(
        of: &Surroundings,
        axes: &[AxisGeometry],
        resistance_ratio: (f64, f64),
        is_stated: bool,
    ) -> Option<Self> {
        let most = Friction::uniform(resistance_ratio.1).ok()?;
        axes.iter()
            .all(|axis| most.is_below_uplift(&axis.block))
            .then_some(Self {
                resistance_ratio,
                is_stated,
                clearance_m: of.clearance_m,
                stop_stiffness_n_m: of.wall_stiffness_n_m,
            })
    }

    /// `None`: it has no free casters, or they resist so much that it would rock.
    fn on_casters(of: &Surroundings, axes: &[AxisGeometry]) -> Option<Self> {
        let stated = of.rolling_resistance_ratio;
        let ratio = stated.unwrap_or(DEFAULT_ROLLING_RESISTANCE);
        (of.casters == Some(Casters::Free))
            .then(|| Self::new(of, axes, (ratio, ratio), stated.is_some()))?
    }

    /// `None`: the list gives no friction of its base, or some of it would let it rock.
    fn on_its_base(item: &Item, axes: &[AxisGeometry]) -> Option<Self> {
        let of = &item.surroundings;
        // With free casters its base is not on the floor.
        let friction_ratio = item
            .friction_ratio
            .filter(|_| of.casters != Some(Casters::Free))?;
        Self::new(of, axes, friction_ratio, true)
    }
}

/// Where an object stands, and its sizes.
pub(crate) struct Sizes {
    pub(super) level_ratio: f64,
    height_m: f64,
    thickness_m: f64,
    /// The thickness comes first.
    pub(super) axes: Vec<AxisGeometry>,
}

impl Sizes {
    /// The sizes, or what is not known of them.
    pub(crate) fn of(item: &Item) -> Result<Self, Vec<Missing>> {
        // A size that nobody would believe is none until a person has confirmed it.
        if !item.to_confirm.is_empty() {
            return Err(vec![Missing::Confirmation]);
        }
        let sides = match &item.shape {
            ItemShape::Unknown => return Err(vec![Missing::Shape]),
            // Its symmetric block stands for it in the numbers of one plane.
            ItemShape::Body(body) => [
                (Axis::Thickness, Some(body.thickness_m()), None),
                (Axis::Width, None, None),
            ],
            ItemShape::Block | ItemShape::Round => [
                (Axis::Thickness, item.thickness_m, item.base_thickness_m),
                (Axis::Width, item.width_m, item.base_width_m),
            ],
        };
        let (Some(level_ratio), Some(height_m), Some(thickness_m)) =
            (item.level_ratio, item.height_m, item.thickness_m)
        else {
            return Err(unknown([
                (item.level_ratio.is_some(), Missing::Level),
                (item.height_m.is_some(), Missing::Height),
                (item.thickness_m.is_some(), Missing::Thickness),
            ]));
        };
        let mut axes = Vec::new();
        for (axis, side_m, base_m) in sides {
            let Some(side_m) = side_m else { continue };
            // The reader of inventories has refused what is not a block.
            let geometry = AxisGeometry::new(axis, height_m, side_m, base_m, item.cg_height_m);
            axes.push(geometry.ok_or_else(|| vec![Missing::Geometry])?);
        }
        Ok(Self {
            level_ratio,
            height_m,
            thickness_m,
            axes,
        })
    }
}

impl Subject {
    /// Whether it rocks: it neither rolls nor slides to a stop.
    pub(crate) fn rocks(&self) -> bool {
        self.way.rocks()
    }

    /// Whether a model is asked; `with_pads`: the pads of an object that rocks on a rigid base as well.
    pub(super) fn asks(&self, model: Model, with_pads: bool) -> bool {
        let is_known = match model {
            Model::Rigid => true,
            // Without a rigid base they are its only model.
            Model::Pads => (with_pads || !self.way.asks(Model::Rigid)) && self.body.is_some(),
        };
        is_known && self.way.asks(model)
    }

    /// The same with the middle of its friction in place of the range, where numbers depend on it.
    pub(crate) fn with_middle_friction(self, settings: &Settings) -> Self {
        match self.way {
            Way::Spatial(_) | Way::Stack(_) | Way::Hull(..) => {
                let friction = self.drawn_friction_ratio(settings).map_or(0.0, middle);
                Self {
                    friction_ratio: Some((friction, friction)),
                    ..self
                }
            }
            _ => self,
        }
    }

    /// The ends of the range in which a world draws the coefficient; `None`: nothing depends on it.
    pub(super) fn drawn_friction_ratio(&self, settings: &Settings) -> Option<(f64, f64)> {
        match &self.way {
            Way::Rolls(gliding) | Way::Slides(gliding) => Some(gliding.resistance_ratio),
            Way::Spatial(_) | Way::Stack(_) => {
                Some(self.friction_ratio.unwrap_or(settings.friction_ratio))
            }
            Way::Hull(..) => Some(self.friction_ratio.unwrap_or(HULL_FRICTION_RATIO)),
            // An assumed friction changes no number.
            Way::Planar | Way::Walled(_) => self.friction_ratio,
        }
    }

    /// The same object on the points of its hull, beside what it has within its reach.
    pub(crate) fn on_hull(mut self, body: Arc<BodyInPose>) -> Self {
        self.axes.truncate(1);
        // Its pads are not followed.
        self.body = None;
        self.too_mild = Some(match body.kind {
            _ if body.is_hull_of_scan => TooMild::UnseenBase,
            kind if kind.is_unseen() => TooMild::UnseenBase,
            BodyKind::Cylinder => TooMild::Round,
            _ => TooMild::OnHull,
        });
        self.flat = None;
        self.way = Way::Hull(body, self.way.walls().copied());
        self
    }

    /// A box that touches a wall, on the points of its hull; `None`: it does not, or the wall is too low for that.
    pub(super) fn on_stiff_floor(&self, item: &Item) -> Option<Self> {
        let Way::Walled(beside) = &self.way else {
            return None;
        };
        let thickness = self.axes.first()?;
        let height_m = thickness.height_m;
        if !beside.touches() || item.is_round() || beside.is_lower_than(height_m) {
            return None;
        }
        // Where the width is not known, it does not rock along it: as in the plane.
        let width = self.axes.get(1);
        let sides_m = [
            thickness.side_m,
            width.map_or(height_m, |width| width.side_m),
        ];
        let base_m = [
            thickness.base_m.unwrap_or(sides_m[0]),
            width.and_then(|width| width.base_m).unwrap_or(sides_m[1]),
        ];
        let corners_m = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
            .map(|(x, y)| [0.5 * x * base_m[0], 0.5 * y * base_m[1]]);
        let upright = Upright {
            outline: Outline::Box(sides_m),
            height_m,
            cg_height_m: thickness.cg_height_m,
            feet_m: (base_m != sides_m).then(|| corners_m.to_vec()),
            mass_kg: self.mass_kg,
        };
        let body = upright.body().ok()?;
        Some(Self {
            way: Way::Hull(Arc::new(body), Some(*beside)),
            axes: vec![*thickness],
            body: None,
            capacity: None,
            too_mild: None,
            ..self.clone()
        })
    }

    /// The same object with a wall at this gap behind it.
    pub(super) fn before_wall(&self, of: &Surroundings, gap_m: f64) -> Self {
        let beside = Beside {
            wall_gap_m: Some(gap_m),
            ..Beside::new(of)
        };
        Self {
            way: beside.way(&self.axes),
            ..self.clone()
        }
    }

    /// The same object with its casters locked, or held where it would slide: it rocks.
    pub(super) fn locked(&self, of: &Surroundings, settings: &Settings) -> Self {
        let beside = Some(Beside::new(of)).filter(|_| settings.walls == WallUse::AsListed);
        let way = beside.map_or(Way::Planar, |beside| beside.way(&self.axes));
        Self {
            way,
            friction_ratio: None,
            ..self.clone()
        }
    }

    /// The object, or what is not known of it.
    pub(crate) fn new(item: &Item, settings: &Settings) -> Result<Self, Vec<Missing>> {
        let Sizes {
            level_ratio,
            height_m,
            thickness_m,
            axes,
        } = Sizes::of(item)?;
        let body = item
            .mass_kg
            .zip(item.cushion.as_ref())
            .map(|(mass_kg, edge)| Body {
                mass_kg,
                cushion: edge.cushion.clone(),
                pad_thickness_m: edge.pad_thickness_m,
                stiffness_spread: item.cushion_log_sd,
                damping_ratio: own_damping_ratio(&edge.cushion, mass_kg),
            });
        let capacity = item.tolerance.as_ref().and_then(Capacity::new);
        let beside =
            Some(Beside::new(&item.surroundings)).filter(|_| settings.walls == WallUse::AsListed);
        // A wall ends a rotation, and what rolls or slides does not rotate.
        let rolls = Gliding::on_casters(&item.surroundings, &axes).map(Way::Rolls);
        let (way, flat) = match (rolls, item.surroundings.upper) {
            // What stands on it decides, also where the casters would let it roll.
            (_, Some(_)) => (Way::Stack(upper(item)?), Some(Flat::Stack)),
            (Some(rolls), None) => (rolls, None),
            (None, None) => match (Gliding::on_its_base(item, &axes), flat(item, &axes, beside)) {
                (Some(slides), _) => (Way::Slides(slides), None),
                (None, None) if settings.dimensions == Dimensions::Three => (
                    Way::Spatial(beside.filter(|beside| beside.is_within_reach(&axes))),
                    None,
                ),
                (None, why) => (beside.map_or(Way::Planar, |beside| beside.way(&axes)), why),
            },
        };
        // Walls on the hull are taller than the object.
        let has_low_wall = way
            .walls()
            .is_some_and(|beside| beside.is_lower_than(height_m));
        let way = match (way, &item.shape, beside) {
            // Its symmetric block would reach less far than the body, and has no width.
            (Way::Planar | Way::Walled(_) | Way::Spatial(_), ItemShape::Body(_), Some(beside)) => {
                match beside.is_near(height_m) && !beside.is_lower_than(height_m) {
                    true => Way::Walled(beside),
                    false => Way::Planar,
                }
            }
            (way, ..) => way,
        };
        let on_hull = match (&way, &item.shape) {
            (Way::Planar | Way::Walled(_) | Way::Spatial(_), ItemShape::Round) if !has_low_wall => {
                // Feet of a round base are on a circle.
                let diameter_m = item.base_thickness_m.unwrap_or(thickness_m);
                round_body(height_m, diameter_m, item.cg_height_m, item.mass_kg).map(Arc::new)
            }
            (Way::Rolls(_) | Way::Stack(_), _) => None,
            (_, ItemShape::Body(body)) => Some(Arc::clone(body)),
            _ => None,
        };
        let too_mild = item.is_round().then_some(TooMild::Round);
        let subject = Self {
            level_ratio,
            axes,
            too_mild,
            restitution: item.restitution,
            mass_kg: item.mass_kg,
            body,
            capacity,
            way,
            friction_ratio: item.friction_ratio,
            flat: flat.filter(|_| settings.dimensions == Dimensions::Three),
        };
        Ok(match on_hull {
            Some(body) => subject.on_hull(body),
            None => subject,
        })
    }
}

/// A round object; `None`: it is no body.
pub(crate) fn round_body(
    height_m: f64,
    diameter_m: f64,
    cg_height_m: Option<f64>,
    mass_kg: Option<f64>,
) -> Option<BodyInPose> {
    let upright = Upright {
        outline: Outline::Circle(diameter_m),
        height_m,
        cg_height_m,
        feet_m: None,
        mass_kg,
    };
    upright.body().ok()
}

/// The damping ratio c/(2√(k m)) that a cushion brings with it.
pub(super) fn own_damping_ratio(cushion: &Cushion, mass_kg: f64) -> Option<f64> {
    match *cushion.law() {
        ContactLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        } => Some(damping_n_s_m / (2.0 * (stiffness_n_m * mass_kg).sqrt()))
            .filter(|ratio| *ratio > 0.0),
        _ => None,
    }
}

/// What stands on an object, or what is not known of both.
fn upper(item: &Item) -> Result<Upper, Vec<Missing>> {
    match (item.surroundings.upper, item.mass_kg, &item.cushion) {
        (
            Some(UpperBody {
                height_m,
                thickness_m,
                mass_kg: Some(mass_kg),
            }),
            Some(_),
            Some(_),
        ) => Ok(Upper {
            height_m,
            thickness_m,
            mass_kg,
        }),
        (upper, mass_kg, cushion) => {
            let is_known = upper.is_some_and(|upper| upper.mass_kg.is_some());
            Err(unknown([
                (mass_kg.is_some(), Missing::Mass),
                (cushion.is_some(), Missing::Stiffness),
                (is_known, Missing::UpperMass),
            ]))
        }
    }
}

/// Why an object cannot move in three dimensions.
fn flat(item: &Item, axes: &[AxisGeometry], beside: Option<Beside>) -> Option<Flat> {
    let missing = unknown([
        (item.mass_kg.is_some(), Missing::Mass),
        (item.cushion.is_some(), Missing::Stiffness),
        (item.width_m.is_some(), Missing::Width),
    ]);
    let neighbours = beside.map(|beside| Beside {
        wall_gap_m: None,
        ..beside
    });
    if !missing.is_empty() {
        Some(Flat::Missing(missing))
    } else if !axes.iter().all(AxisGeometry::is_uniform) {
        Some(Flat::NotUniform)
    } else {
        neighbours
            .filter(|beside| beside.is_within_reach(axes))
            .map(|_| Flat::Neighbours)
    }
}

/// The hardest landing of a history, from either source and on either edge.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Hit {
    pub(super) uplift_g: f64,
    pub(super) impact_velocity_g: f64,
    pub(super) velocity_change_m_s: f64,
    pub(super) duration_s: f64,
    pub(super) compression_m: f64,
}

impl Hit {
    pub(super) fn larger_g(&self) -> f64 {
        self.uplift_g.max(self.impact_velocity_g)
    }
}

/// The shock of a history without overturning; `None` where the cushion bottoms, so that no number
/// can be relied on.
pub(super) fn hit(
    block: &Block,
    rocking: &RockingSummary,
    mass_kg: f64,
    cushion: &Cushion,
) -> Option<Hit> {
    let mut found = Hit {
        uplift_g: 0.0,
        impact_velocity_g: 0.0,
        velocity_change_m_s: 0.0,
        duration_s: 0.0,
        compression_m: 0.0,
    };
    for (landing, side) in landings(block, ImpactModel::Paper)
        .iter()
        .zip(rocking.sides)
    {
        let from_uplift = landing.pivot.largest_rise_m(side.peak_rotation_rad);
        let from_velocity = landing.equivalent_rise_m(side.impact_omega_rad_s, G0_M_S2);
        let impact = landing.impact(mass_kg, cushion, from_uplift.max(from_velocity), G0_M_S2);
        let shock_g = |rise_m: f64| {
            landing.edge_acceleration_m_s2(mass_kg, cushion, rise_m, G0_M_S2) / G0_M_S2
        };
        let (uplift_g, velocity_g) = (shock_g(from_uplift), shock_g(from_velocity));
        let is_number = |shock_g: f64| shock_g <= BEYOND_ALL_G;
        if !is_number(uplift_g) || !is_number(velocity_g) {
            return None;
        }
        found.uplift_g = found.uplift_g.max(uplift_g);
        found.impact_velocity_g = found.impact_velocity_g.max(velocity_g);
        found.velocity_change_m_s = found.velocity_change_m_s.max(impact.velocity_change_m_s);
        found.duration_s = found.duration_s.max(impact.pulse_duration_s);
        found.compression_m = found.compression_m.max(impact.compression_m);
    }
    Some(found)
}
