//! One draw of everything that is not known of an object in a world.

use std::f64::consts::TAU;

use freestand::block::Block;
use freestand::cushion::{ContactLaw, Cushion};
use freestand::fragility::{log_uniform_draw, lognormal_draw, lognormal_probability, uniform_draw};
use freestand::hull::shake::Contact;
use freestand::respond::Along;
use freestand::rocking::Restitution;
use freestand::wall::Walls;
use freestand::worlds::{
    Group, WallDraw, is_first_side_along_x, object_stream, restitution_at, restitution_draw,
    wall_cushion_at, wall_draw, wall_restitution_at,
};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use freestand_study::study::assessment::{Settings, Spread};

use super::object::{AxisGeometry, Subject, Way};

/// Standard deviation of the logarithm of a damping ratio that a drop test found (assumed).
const MEASURED_DAMPING_SPREAD: f64 = 0.2;

/// The values of an object in one world.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Draw {
    /// Whether its thickness lies along x; if not, it lies along y.
    pub(super) is_thickness_along_x: bool,
    /// How far it is turned from x to y of the floor, where that is not one of two directions \[rad\].
    pub(super) yaw_rad: f64,
    /// Of each axis, for landings on its right edge and on its left one.
    restitution: [[f64; 2]; 2],
    heights: f64,
    sides: [f64; 2],
    mass: f64,
    pub(super) stiffness: f64,
    pub(super) pad_damping_ratio: f64,
    /// The error of Eq. (5).
    pub(super) model: f64,
    /// The factor on peak accelerations on the compliant base.
    pub(super) compliant: f64,
    /// μ under it, and between it and what stands on it, or the resistance of its casters; `None`:
    /// nothing depends on it.
    pub(super) friction_ratio: Option<f64>,
    /// `None`: it has no wall within reach.
    pub(super) wall: Option<WallDraw>,
    /// Factors of the mass, height and thickness of what stands on it.
    pub(super) upper: [f64; 3],
    /// `None`: it is not followed on its hull.
    pub(super) hull: Option<HullDraw>,
}

/// How a body on its hull stands, and how it touches the floor.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct HullDraw {
    /// Its friction is that of the draw.
    pub(super) contact: Contact,
    /// How much higher the centre of gravity of a scan is, over its height.
    pub(super) cg_ratio: f64,
    /// The error of the surface of a scan: directions and phases of waves \[rad\].
    pub(super) waves_rad: [[f64; 2]; WAVES],
}

/// Waves in the error of a scan, each of 5 cm: about as long as what a scanner smooths.
pub(super) const WAVES: usize = 3;
pub(super) const WAVE_M: f64 = 0.05;

/// The height of the centre of gravity of a scan, which is taken to be uniform, is known to this share.
const CG_RATIO: f64 = 0.1;

/// The ranges of what is not known of a contact, both uniform in their logarithms: as for the tests on a shake table
/// (validation/shake-table/README.md). Less damping and softer contacts are less favourable.
const CONTACT_DAMPING_RATIO: (f64, f64) = (0.05, 0.5);
const CONTACT_SINKING_M: (f64, f64) = (5e-5, 5e-4);

impl HullDraw {
    /// `of_body` draws what belongs to its geometry.
    fn new(
        settings: &Settings,
        object: u64,
        world: u32,
        change: Change,
        mut of_body: impl FnMut(f64, f64) -> f64,
    ) -> Self {
        let stream = |group: Group| {
            let repetition = change.repetition(group);
            object_stream(settings.seed, world, object, group, repetition)
        };
        let (least, most) = CONTACT_DAMPING_RATIO;
        let (low_m, high_m) = CONTACT_SINKING_M;
        let mut random = stream(Group::Pad);
        let mut damping_ratio = log_uniform_draw(&mut random, least, most);
        let mut sinking_m = log_uniform_draw(&mut random, low_m, high_m);
        if let Some(normal) = change.normal(Group::Pad) {
            let share = lognormal_probability(normal.exp(), 1.0, 1.0);
            damping_ratio = most * (least / most).powf(share);
            sinking_m = low_m * (high_m / low_m).powf(share);
        }
        Self {
            contact: Contact {
                damping_ratio,
                sinking_m,
                ..Contact::default()
            },
            cg_ratio: of_body(-CG_RATIO, CG_RATIO),
            waves_rad: std::array::from_fn(|_| [0, 1].map(|_| of_body(0.0, TAU))),
        }
    }
}

/// An object with the values of one draw.
#[derive(Clone, Copy)]
pub(super) struct Drawn<'a> {
    pub(super) subject: &'a Subject,
    pub(super) draw: &'a Draw,
}

/// A number that depends on a text alone: random numbers belong to the names of objects, not to
/// their places.
pub(super) fn key(text: &str) -> u64 {
    let digest = Sha256::digest(text.as_bytes());
    digest
        .iter()
        .take(8)
        .fold(0, |key, byte| key << 8 | u64::from(*byte))
}

/// What is different from the draw of the world itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Change {
    /// Nothing.
    None,
    /// This group is drawn again.
    Again(Group),
    /// The values of this group are all at this number of standard deviations, on the side where a
    /// positive number is less favourable to slender objects: a narrower and higher object, a
    /// stiffer pad with less damping, less energy lost in an impact.
    At(Group, f64),
}

impl Change {
    /// What of it changes the motions of floors.
    pub(super) fn of_floors(self) -> Self {
        match self {
            Self::Again(Group::Motion | Group::Building) | Self::At(Group::Building, _) => self,
            Self::None | Self::Again(_) | Self::At(..) => Self::None,
        }
    }

    fn repetition(self, group: Group) -> u32 {
        u32::from(self == Self::Again(group))
    }

    /// Whether an object on its pads lives on as it did in the worlds without a change: no impact of a
    /// rigid base loses energy there.
    pub(super) fn leaves_pads(self) -> bool {
        matches!(
            self,
            Self::Again(Group::Restitution) | Self::At(Group::Restitution, _)
        )
    }

    /// The number of standard deviations of a group, where that is fixed.
    pub(super) fn normal(self, group: Group) -> Option<f64> {
        match self {
            Self::At(changed, normal) if changed == group => Some(normal),
            _ => None,
        }
    }
}

/// The draw of an object, given by its [`key`], in a world.
pub(super) fn draw(
    settings: &Settings,
    subject: &Subject,
    object: u64,
    world: u32,
    change: Change,
) -> Draw {
    let stream = |group: Group| {
        object_stream(
            settings.seed,
            world,
            object,
            group,
            change.repetition(group),
        )
    };
    let Spread {
        restitution,
        stiffness,
        mass,
        geometry,
        model,
        compliant,
    } = settings.spread;

    // One random number for both axes: they land on the same floor.
    let normal = change.normal(Group::Restitution).map(|normal| -normal);
    let about = |median: f64| match normal {
        Some(normal) => restitution_at(median, restitution, normal),
        None => restitution_draw(&mut stream(Group::Restitution), median, restitution),
    };
    // About that of the unchanged block, so that an uncertain height does not count twice.
    let of_axis = |axis: &AxisGeometry| {
        let medians = subject.restitution.ratios(&axis.block);
        medians.map_or([0.0; 2], |medians| medians.map(about))
    };
    let restitution = [0, 1].map(|axis| subject.axes.get(axis).map_or([0.0; 2], of_axis));

    let mut random = stream(Group::Pad);
    let own = subject
        .body
        .as_ref()
        .and_then(|body| body.stiffness_spread)
        .unwrap_or(stiffness);
    let (low, high) = settings.pad_damping_ratio;
    let measured = subject.body.as_ref().and_then(|body| body.damping_ratio);
    let mut stiffness = lognormal_draw(&mut random, 1.0, own);
    let mut pad_damping_ratio = match measured {
        Some(measured) => lognormal_draw(&mut random, measured, MEASURED_DAMPING_SPREAD),
        None => log_uniform_draw(&mut random, low, high),
    };
    // The share of pads that have less damping.
    if let Some(normal) = change.normal(Group::Pad) {
        stiffness = (own * normal).exp();
        pad_damping_ratio = match measured {
            Some(measured) => measured * (-MEASURED_DAMPING_SPREAD * normal).exp(),
            None => low * (high / low).powf(lognormal_probability((-normal).exp(), 1.0, 1.0)),
        };
    }

    random = stream(Group::Body);
    let mut next = |spread: f64| lognormal_draw(&mut random, 1.0, spread);
    let of_mass = mass;
    let (mut mass, mut heights, mut sides) = (
        next(of_mass),
        next(geometry),
        [next(geometry), next(geometry)],
    );
    let mut upper = [next(of_mass), next(geometry), next(geometry)];
    if let Some(normal) = change.normal(Group::Body) {
        mass = (of_mass * normal).exp();
        heights = (geometry * normal).exp();
        sides = [(-geometry * normal).exp(); 2];
        upper = [mass, heights, sides[0]];
    }

    // What is under it: drawn again together with its pads.
    let friction_ratio = subject.drawn_friction_ratio(settings).map(|(low, high)| {
        let repetition = change.repetition(Group::Pad);
        let mut under = object_stream(settings.seed, world, object, Group::Friction, repetition);
        match change.normal(Group::Pad) {
            // More friction lets a slender object rock where it would have slid.
            Some(normal) => low + (high - low) * lognormal_probability(normal.exp(), 1.0, 1.0),
            None => uniform_draw(&mut under, low, high),
        }
    });

    let hull = matches!(subject.way, Way::Hull(..)).then(|| {
        let of_body = |low: f64, high: f64| uniform_draw(&mut random, low, high);
        HullDraw::new(settings, object, world, change, of_body)
    });

    random = stream(Group::Model);
    let mut next = |median: f64, spread: f64| lognormal_draw(&mut random, median, spread);
    let (model, compliant) = (next(1.0, model), next(settings.compliant_factor, compliant));
    Draw {
        is_thickness_along_x: is_first_side_along_x(settings.seed, world, object, 0),
        yaw_rad: uniform_draw(&mut stream(Group::Orientation), 0.0, TAU),
        restitution,
        heights,
        sides,
        mass,
        stiffness,
        pad_damping_ratio,
        model,
        compliant,
        friction_ratio,
        wall: subject
            .way
            .walls()
            .map(|_| wall(settings, object, world, change)),
        upper,
        hull,
    }
}

/// Restitution at the wall is one of the restitutions, and its cushion is one of the pads: what an answer depends on
/// counts them together.
fn wall(settings: &Settings, object: u64, world: u32, change: Change) -> WallDraw {
    let mut drawn = wall_draw(
        settings.seed,
        world,
        object,
        change.repetition(Group::Restitution),
        change.repetition(Group::Pad),
    );
    let share = |group| {
        let normal = change.normal(group)?;
        Some(lognormal_probability(f64::exp(normal), 1.0, 1.0))
    };
    if let Some(share) = share(Group::Restitution) {
        drawn.restitution_ratio = wall_restitution_at(share);
    }
    if let Some(share) = share(Group::Pad) {
        (drawn.stiffness_ratio, drawn.damping_ratio) = wall_cushion_at(share);
    }
    drawn
}

impl Draw {
    /// The larger restitution of both edges about its first axis.
    pub(super) fn restitution(&self) -> f64 {
        let [[right, left], _] = self.restitution;
        right.max(left)
    }

    /// The block about an axis, and its restitution.
    pub(super) fn block(&self, subject: &Subject, axis: usize) -> Option<(Block, Restitution)> {
        let geometry: &AxisGeometry = subject.axes.get(axis)?;
        let block = geometry.scaled(self.heights, self.sides.get(axis).copied().unwrap_or(1.0));
        let of_edges = self.restitution.get(axis).copied().unwrap_or_default();
        Some((block, Restitution::Edges(of_edges.map(|r| r.min(1.0)))))
    }

    /// The same with the sizes and masses of the list.
    pub(super) fn without_factors(self) -> Self {
        Self {
            heights: 1.0,
            sides: [1.0; 2],
            mass: 1.0,
            stiffness: 1.0,
            upper: [1.0; 3],
            ..self
        }
    }

    /// The factors of its height and of its first side.
    pub(super) fn factors(&self) -> (f64, f64) {
        (self.heights, self.sides[0])
    }

    /// The factor of its mass.
    pub(super) fn mass(&self) -> f64 {
        self.mass
    }

    /// What stands beside the object in the plane of an axis.
    pub(super) fn walls(&self, subject: &Subject, axis: usize) -> Walls {
        let beside = subject
            .way
            .walls()
            .zip(self.wall.as_ref())
            .zip(subject.axes.get(axis));
        beside.map_or(Walls::NONE, |((beside, drawn), geometry)| {
            beside.walls(geometry.axis, drawn)
        })
    }

    /// The component of the floor that moves an axis.
    pub(super) fn along(&self, axis: usize) -> Along {
        if (axis == 0) == self.is_thickness_along_x {
            Along::X
        } else {
            Along::Y
        }
    }

    /// Mass, where it is known \[kg\].
    pub(super) fn mass_kg(&self, subject: &Subject) -> Option<f64> {
        Some(subject.mass_kg? * self.mass)
    }

    /// Mass \[kg\] and cushion under one edge; `None` where they are not known.
    pub(super) fn body(&self, subject: &Subject) -> Option<(f64, Cushion)> {
        let body = subject.body.as_ref()?;
        Some((
            body.mass_kg * self.mass,
            body.cushion.times(self.stiffness).ok()?,
        ))
    }

    /// Mass \[kg\] and damped cushion under one edge; `None` where they are not known.
    pub(super) fn damped_body(&self, subject: &Subject) -> Option<(f64, Cushion)> {
        let (mass_kg, cushion) = self.body(subject)?;
        // A law that is not a spring brings its own damping.
        let damped = cushion.linear_stiffness_n_m().and_then(|stiffness_n_m| {
            let damping_n_s_m = self.pad_damping_n_s_m(stiffness_n_m, mass_kg);
            let law = ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            };
            Cushion::new(law).ok()
        });
        Some((mass_kg, damped.unwrap_or(cushion)))
    }

    /// Height and side in the plane of an axis \[m\].
    pub(super) fn size_m(&self, subject: &Subject, axis: usize) -> (f64, f64) {
        let factor = self.sides.get(axis).copied().unwrap_or(1.0);
        subject.axes.get(axis).map_or((0.0, 0.0), |one| {
            (one.height_m * self.heights, one.side_m * factor)
        })
    }

    /// c = 2 ζ √(k m) of the pads under one edge \[N s/m\].
    pub(super) fn pad_damping_n_s_m(&self, stiffness_n_m: f64, mass_kg: f64) -> f64 {
        2.0 * self.pad_damping_ratio * (stiffness_n_m * mass_kg).sqrt()
    }

    /// e: rebound over impact velocity of an edge that lands on its pads, an upper envelope of
    /// landings computed on the compliant base at lifts of 10 mm to 30 mm.
    pub(super) fn rebound_restitution(&self) -> f64 {
        (0.63 - 1.2 * (self.pad_damping_ratio - 0.05)).clamp(0.4, 0.7)
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;
    use freestand_inventory::library::Libraries;
    use freestand_inventory::{ReadOptions, read_inventory};

    /// A change of these numbers changes every result: random numbers belong to the seed, the world,
    /// the group and the name of an object alone. To 12 digits, because the last ones differ between
    /// the mathematical libraries of machines.
    #[test]
    fn the_draws_of_objects() {
        let list = "id,level_ratio,height [mm],thickness [mm],width [mm],base_thickness [mm],cg_height [mm],mass [kg],\
                    stiffness [N/mm],restitution,restitution_factor,casters,wall_gap [mm],upper_height [mm],\
                    upper_thickness [mm],upper_mass [kg]\n\
                    cabinet,0,1700,450,,,,110,4380,,,,,,,\n\
                    trolley,0.25,1720,455,800,350,900,111,4380,0.9,,free,,,,\n\
                    case on a desk,0.5,1740,460,800,,,112,4380,,0.95,,50,400,300,20\n\
                    shelf at a wall,0.75,1760,465,800,,,113,4380,,,,50,,,\n";
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("list.csv");
        std::fs::write(&path, list).unwrap();
        let libraries = Libraries::with_files(None, None).unwrap();
        let read = libraries.looked_up(|lookup| read_inventory(&path, &ReadOptions::new(lookup)));
        let settings = Settings::default();
        let mut told = String::new();
        for item in read.unwrap().items {
            let subject = Subject::new(&item, &settings).unwrap();
            for (world, change) in [
                (0, Change::None),
                (7, Change::None),
                (7, Change::Again(Group::Pad)),
                (7, Change::At(Group::Body, 1.0)),
            ] {
                let draw = draw(&settings, &subject, key(&item.id), world, change);
                writeln!(told, "{}, world {world}, {change:?}\n{draw:.12?}", item.id).unwrap();
            }
        }
        insta::assert_snapshot!(told);
    }

    /// A centre of gravity off the middle has another restitution at each edge, as in `rock`.
    #[test]
    fn each_edge_has_its_own_restitution() {
        let list = "id,level_ratio,height [mm],thickness [mm]\nrack,0,1800,500\n";
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("list.csv");
        std::fs::write(&path, list).unwrap();
        let libraries = Libraries::with_files(None, None).unwrap();
        let read = libraries.looked_up(|lookup| read_inventory(&path, &ReadOptions::new(lookup)));
        let mut settings = Settings::default();
        settings.spread.restitution = 0.0;
        let item = &read.unwrap().items[0];
        let mut subject = Subject::new(item, &settings).unwrap();
        let block = &mut subject.axes[0].block;
        *block = block.with_cg_offset(0.06).unwrap();
        let draw = draw(&settings, &subject, key(&item.id), 3, Change::None);
        let (_, drawn) = draw.block(&subject, 0).unwrap();
        let block = &subject.axes[0].block;
        let [drawn, stated] = [drawn, Restitution::Housner].map(|one| one.ratios(block).unwrap());
        assert!((stated[0] - stated[1]).abs() > 0.02);
        // Through the logit of the loss and back.
        for edge in [0, 1] {
            assert!(
                (drawn[edge] - stated[edge]).abs() < 1e-12,
                "{drawn:?} {stated:?}"
            );
        }
    }
}
