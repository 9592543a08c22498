//! What a request means: the object with the solver that follows it, in SI, and its motions.

use std::f64::consts::PI;

use freestand::block::Block;
use freestand::compliant::CompliantBase;
use freestand::motion::Motion;
use freestand::respond::{
    Along, HistoryOptions, Pads, Plane, Planes, Release, RigidPlane, Settings,
};
use freestand::rocking::RockingModel;
use freestand::spatial::{Shape, SpatialObject, Stack, StackBody, Support};
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::compliant::{CompliantRequest, Turned, start, with_tangential_stiffness};
use freestand_study::cushion::EdgeCushion;
use freestand_study::doubt::HistoryNote;
use freestand_study::hull::{BodyKind, HullRequest};
use freestand_study::recorded::Second;
use freestand_study::rock::{RockRequest, until};
use freestand_study::sliding::{Contact, SlideRequest, StopShock};
use freestand_study::spatial::{SpatialRequest, StackRequest, interface, shape, walls_on_cushions};
use freestand_study::walls::{GivenCushion, needs_a_gap};

use super::kind::{Kind, OF_SPACE, OF_STACK};
use super::{BASES, BaseName, Rock};
use crate::files::Files;
use crate::records::{NamedRecords, ReadMotions, components};
use crate::request::{Question, Request, unknown};
use crate::{block, body, sliding, walls};

/// What is asked, in SI.
#[derive(Debug, Clone)]
pub struct Meant {
    /// The object, without its motions.
    pub asked: Asked,
    /// Its motions.
    pub motions: ReadMotions,
}

/// An object, by the solver that follows it.
#[derive(Debug, Clone)]
pub enum Asked {
    /// On a rigid base.
    Rigid(RockRequest),
    /// Sliding or rolling.
    Slides(SlideRequest),
    /// On its cushions, in a plane.
    OnPads(CompliantRequest),
    /// On its cushions, in three dimensions or at a wall.
    InSpace(SpatialRequest),
    /// A stack of two.
    Stack(StackRequest),
    /// A body on its hull, in three dimensions.
    Hull(HullRequest),
}

/// Reads a request.
struct Reader<'r, 'w> {
    request: &'r Rock,
    files: &'r Files,
    read: WordReader<'w>,
}

/// An object on its cushions.
struct Supported {
    mass_kg: f64,
    /// How the cushion was read.
    edge: EdgeCushion,
    support: Support,
}

/// What every object has; `None` where it is missing or wrong.
struct Object {
    size: Option<(f64, f64)>,
    mass_kg: Option<f64>,
    settings: Settings,
}

impl Question for Rock {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let Judged {
            asked,
            named,
            second,
        } = judged(self, files)?;
        let across = self.space.motion_y.as_ref().map(Written::text);
        let mut motions = named.read(second, across.as_deref())?;
        motions.inputs.extend(self.pad.input(files));
        motions
            .inputs
            .extend(files.path_of(self.shape.scan.as_ref()));
        motions.inputs.extend(self.records.inputs(files));
        Ok(Meant { asked, motions })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        judged(self, files).map(drop)
    }
}

/// What a request means, with records that have not been read.
struct Judged<'f> {
    asked: Asked,
    named: NamedRecords<'f>,
    /// Where the second component is.
    second: Second,
}

/// What a request means.
fn judged<'f>(request: &Rock, files: &'f Files) -> Result<Judged<'f>, Problems> {
    let words = request.words();
    let mut reader = Reader {
        request,
        files,
        read: WordReader::new(&words),
    };
    unknown::<Rock>(&request.unknown).for_each(|problem| reader.read.problems.push(problem));
    let (kind, contact) = reader.kind();
    reader.read.one("vertical");
    let vertical = (request.vertical.as_slice(), &request.upward);
    let named = request
        .records
        .named(&mut reader.read, &request.motion, vertical, files);
    let is_still = named.is_none();
    let (kind, asked) = match kind {
        Kind::Shape | Kind::Scan => (kind, reader.hull(is_still)),
        _ => reader.on_its_edges(kind, contact, is_still),
    };
    let second = reader.second(kind);
    if named.count() > 1 {
        reader.of_several(kind);
    }
    let Reader { mut read, .. } = reader;
    for key in read.unread() {
        let (message, hint) = kind.refusal(key);
        read.note(&[key], message, hint);
    }
    Ok(Judged {
        asked: read.problems.finish(asked)?,
        named,
        second,
    })
}

impl Reader<'_, '_> {
    /// An object that stands on the edges of its base.
    fn on_its_edges(
        &mut self,
        kind: Kind,
        contact: Option<Contact>,
        is_still: bool,
    ) -> (Kind, Option<Asked>) {
        let object = self.object(kind);
        let (kind, asked) = match (kind, contact) {
            (Kind::Slides, Some(contact)) => self.slides(&object, contact, is_still),
            (Kind::OnPads, _) => (kind, self.on_pads(&object, is_still)),
            (Kind::InSpace | Kind::AtWallOnPads, _) => {
                (kind, self.in_space(kind, &object, is_still))
            }
            (Kind::Stack, _) => (kind, self.stack(&object, is_still)),
            _ => {
                let block = self.block(&object);
                (kind, self.rigid(&object, block, is_still))
            }
        };
        if object.settings.model == RockingModel::Linearised && kind != Kind::Rigid {
            let (message, hint) = kind.refusal("model");
            self.read.note(&["model"], message, hint);
        }
        (kind, asked)
    }

    /// A body on its hull.
    fn hull(&mut self, is_still: bool) -> Option<Asked> {
        let read = &mut self.read;
        let mass_kg = read.positive("mass", Dimension::Mass);
        let gravity_m_s2 = block::gravity(read);
        let orientation = read.quantity("orientation", Dimension::Angle);
        let body = body::body(read, mass_kg, self.files);
        let contact = body::contact(read, body.as_deref());
        if body
            .as_ref()
            .is_some_and(|body| body.kind == BodyKind::Scan)
        {
            let why = "one history has the scan as it was measured; a verdict draws its error";
            self.read.idle(&["scan_error"], why);
        }
        // The wall on the left is behind it, on its −x.
        let read = &mut self.read;
        let gaps = [("wall_gap_left", PI), ("wall_gap_right", 0.0)];
        let walls = gaps.map(|(key, toward_rad)| {
            Some((toward_rad, read.non_negative(key, Dimension::Length)?))
        });
        let stiffness_n_m = read.positive("wall_stiffness", Dimension::Stiffness);
        if stiffness_n_m.is_some() && mass_kg.is_none() {
            read.missing(
                &["mass"],
                "the stiffness of the walls counts beside the mass of the object, which is missing",
                "add `mass`, or leave `wall_stiffness` out",
            );
        }
        if stiffness_n_m.is_some() && walls == [None; 2] {
            read.problems.push(needs_a_gap().of(&["wall_gap_left"]));
        }
        let wall_cushion = GivenCushion {
            stiffness_n_m,
            damping_ratio: self.wall_damping(),
        };
        if is_still {
            self.nothing_moves("give `motion`");
        }
        Some(Asked::Hull(HullRequest {
            body: body?,
            contact: contact?,
            walls: walls.into_iter().flatten().collect(),
            wall_cushion,
            motions: [None, None],
            vertical: None,
            orientation_rad: orientation.unwrap_or(0.0),
            gravity_m_s2,
            is_sampled: false,
        }))
    }

    /// What the request is about.
    fn kind(&mut self) -> (Kind, Option<Contact>) {
        let is_compliant = self.read.choice("base", BASES) == Some(BaseName::Compliant);
        let has_any = |keys: &[&str]| keys.iter().any(|key| self.read.has(key));
        let (in_space, stack) = (
            has_any(&OF_SPACE) || has_any(&["shape", "diameter"]),
            has_any(&OF_STACK),
        );
        let at_wall = has_any(&[
            "wall_gap_left",
            "wall_gap_right",
            "wall_height",
            "wall_stiffness",
            "wall_damping",
        ]);
        if is_compliant {
            let kind = match (stack, in_space, at_wall) {
                (true, ..) => Kind::Stack,
                (_, true, _) => Kind::InSpace,
                (.., true) => Kind::AtWallOnPads,
                _ => Kind::OnPads,
            };
            return (kind, None);
        }
        if has_any(&["sliding", "casters"]) {
            let contact = sliding::contact(&mut self.read);
            return (Kind::Slides, contact);
        }
        let kind = match has_any(&["shape", "diameter", "feet"]) {
            _ if self.read.has("scan") => Kind::Scan,
            true => Kind::Shape,
            false => Kind::Rigid,
        };
        (kind, None)
    }

    fn object(&mut self, kind: Kind) -> Object {
        let read = &mut self.read;
        let size = match kind {
            Kind::InSpace if read.has("diameter") => block::height(read).zip(body::diameter(read)),
            _ => block::sizes(read),
        };
        let mass_kg = read.positive("mass", Dimension::Mass);
        let accuracy = block::accuracy(read);
        let settings = Settings {
            model: block::model(read),
            accuracy,
            on_pads: accuracy.into(),
            gravity_m_s2: block::gravity(read),
            until: until(read.positive("duration", Dimension::Time)),
        };
        Object {
            size,
            mass_kg,
            settings,
        }
    }

    /// The cushion under an edge; `None` if there is none, or something is wrong.
    fn edge(&mut self, object: &Object) -> Option<EdgeCushion> {
        self.request
            .pad
            .resolve(&mut self.read, object.mass_kg, self.files)
    }

    fn block(&mut self, object: &Object) -> Option<Block> {
        block::block(&mut self.read, object.size, object.mass_kg)
    }

    /// The state from which the object is released.
    fn release(&mut self) -> Release {
        Release {
            rotation_rad: self
                .read
                .quantity("initial_rotation", Dimension::Angle)
                .unwrap_or(0.0),
            omega_rad_s: self
                .read
                .quantity("initial_velocity", Dimension::AngularVelocity)
                .unwrap_or(0.0),
        }
    }

    fn nothing_moves(&mut self, hint: &str) {
        // What does not apply here was meant to move it.
        let others = ["cg_rise", "initial_rotation", "initial_velocity"];
        if others.iter().any(|key| self.read.unread().contains(key)) {
            return;
        }
        self.read
            .missing(&["motion"], "nothing moves the object", hint);
    }

    fn rigid(&mut self, object: &Object, block: Option<Block>, is_still: bool) -> Option<Asked> {
        let edge = self.edge(object);
        let pad = self.request.pad.words();
        if !pad.is_empty() && !self.read.has("mass") {
            let message =
                "the cushion is used for the shock, which also needs the mass of the object";
            self.read
                .missing(&["mass"], message, "add `mass`, or leave the cushion out");
        }
        let model = object.settings.model;
        let friction = self.read.positive("friction", Dimension::Ratio);
        let start = self.release();
        let (walls, wall) =
            walls::walls(&mut self.read, block.as_ref(), object.mass_kg, Some(model));
        let restitution = block::restitution(&mut self.read, block.as_slice());
        if is_still && start.is_at_rest() {
            self.nothing_moves("give `motion`, or `initial_rotation` or `initial_velocity`");
        }
        Some(Asked::Rigid(RockRequest {
            object: RigidPlane::along_x(block?, restitution, walls),
            horizontal: None,
            vertical: None,
            how: HistoryOptions {
                settings: object.settings,
                start,
                ..HistoryOptions::default()
            },
            cushion: object.mass_kg.zip(edge),
            wall,
            friction,
        }))
    }

    /// An object that slides or rolls; on braked casters that hold, it rocks on a rigid base.
    fn slides(
        &mut self,
        object: &Object,
        contact: Contact,
        is_still: bool,
    ) -> (Kind, Option<Asked>) {
        let block = self.block(object);
        let surface = sliding::surface(&mut self.read, contact);
        let stiffness_n_m = self.read.positive("stop_stiffness", Dimension::Stiffness);
        let stop = surface.and_then(|surface| {
            let stop = StopShock::new(stiffness_n_m, object.mass_kg, &surface.clearance);
            self.read
                .problems
                .keep(stop.map_err(|problem| problem.of(&["stop_stiffness"])))
        });
        let carries = |read: &mut WordReader<'_>, block: Option<Block>| {
            let carries = surface?
                .carries(&block?)
                .map_err(|problem| problem.of(&[sliding::coefficient(contact)]));
            read.problems.keep(carries)
        };
        if carries(&mut self.read, block) == Some(false) {
            return (Kind::Rigid, self.rigid(object, block, is_still));
        }
        let has_across = ["motion_y", "components", "orientation"]
            .map(|key| self.read.has(key))
            .contains(&true);
        let has_width = self.read.has("width");
        if has_across && has_width {
            // Across the thickness it must not rock either.
            let width_m = self.read.positive("width", Dimension::Length);
            let across = object.size.zip(width_m);
            let across =
                across.and_then(|((height_m, _), width_m)| Block::uniform(height_m, width_m).ok());
            if carries(&mut self.read, across) == Some(false) {
                self.read.note(
                    &["width"],
                    "it rocks across its width before it slides or rolls, which is not calculated under two directions",
                    "leave the second direction out, or give the friction that lets it slide",
                );
            }
        }
        let orientation_rad = self.read.quantity("orientation", Dimension::Angle);
        if is_still {
            self.nothing_moves("give `motion`");
        }
        let asked = |block, surface, stop| {
            Asked::Slides(SlideRequest {
                block,
                surface,
                horizontal: None,
                across: None,
                vertical: None,
                orientation_rad: orientation_rad.unwrap_or(0.0),
                slides_across: has_width,
                stop,
                how: HistoryOptions {
                    settings: object.settings,
                    ..HistoryOptions::default()
                },
            })
        };
        let whole = block.zip(surface).zip(stop);
        (
            Kind::Slides,
            whole.map(|((block, surface), stop)| asked(block, surface, stop)),
        )
    }

    /// The mass and the cushion that a compliant base needs.
    fn cushioned(&mut self, object: &Object) -> Option<(f64, EdgeCushion)> {
        let pad = self.request.pad.words();
        if !self.read.has("mass") || pad.is_empty() {
            let message = "a compliant base needs a mass and a stiffness";
            let hint = "give `mass` and the `stiffness` of the whole cushion under one edge, or `base = \"rigid\"`";
            let key = if self.read.has("mass") {
                "stiffness"
            } else {
                "mass"
            };
            self.read.missing(&[key], message, hint);
        }
        object.mass_kg.zip(self.edge(object))
    }

    /// The mass, the cushion, and what the object stands on; `None` if something is missing or wrong.
    fn base(&mut self, object: &Object) -> Option<(EdgeCushion, CompliantBase)> {
        let cushioned = self.cushioned(object);
        let read = &mut self.read;
        read.exclusive("tangential_stiffness", "tangential_ratio");
        if read.flag("no_slip") {
            read.exclusive("no_slip", "friction");
        }
        let friction_ratio = read.non_negative("friction", Dimension::Ratio);
        let tangential = read.positive("tangential_stiffness", Dimension::Stiffness);
        let ratio = read.positive("tangential_ratio", Dimension::Ratio);
        let (mass_kg, edge) = cushioned?;
        let mut base = CompliantBase {
            friction_ratio,
            ..CompliantBase::new(mass_kg, edge.cushion.clone())
        };
        base.tangential_stiffness_ratio = ratio.unwrap_or(base.tangential_stiffness_ratio);
        if let Some(stiffness_n_m) = tangential {
            base = with_tangential_stiffness(base, stiffness_n_m, object.settings.gravity_m_s2);
        }
        Some((edge, base))
    }

    fn on_pads(&mut self, object: &Object, is_still: bool) -> Option<Asked> {
        let block = self.block(object);
        let base = self.base(object);
        self.read.exclusive("cg_rise", "initial_rotation");
        let contacts = self.read.whole("contacts");
        let rise = self
            .read
            .positive("cg_rise", Dimension::Length)
            .map(Turned::CgRise);
        let rotation = self.read.quantity("initial_rotation", Dimension::Angle);
        let turned = rise.or(rotation.map(Turned::Rotation));
        let omega = self
            .read
            .quantity("initial_velocity", Dimension::AngularVelocity);
        let at = block::point(&mut self.read);
        let start = block.and_then(|block| {
            let start = start(&block, turned, omega.unwrap_or(0.0));
            self.read
                .problems
                .keep(start.map_err(|problem| problem.of(&["cg_rise"])))
        });
        if is_still && start.is_some_and(|start| start.is_at_rest()) {
            self.nothing_moves(
                "give `motion`, or `cg_rise`, `initial_rotation` or `initial_velocity`",
            );
        }
        let (edge, mut base) = base?;
        base.contacts = contacts.map_or(base.contacts, |contacts| contacts as usize);
        let along = Along::X;
        Some(Asked::OnPads(CompliantRequest {
            object: Pads {
                planes: Planes::single(Plane {
                    along,
                    block: block?,
                }),
                base,
            },
            pad_thickness_m: edge.pad_thickness_m,
            notes: edge.notes.into_iter().map(HistoryNote::Cushion).collect(),
            horizontal: None,
            vertical: None,
            how: HistoryOptions {
                settings: object.settings,
                start: start?,
                points_m: at.into_iter().collect(),
                is_sampled: false,
            },
        }))
    }

    /// What an object in space or a stack stands on; `None` if something is missing or wrong.
    fn support(&mut self, object: &Object) -> Option<Supported> {
        let (edge, base) = self.base(object)?;
        let support = Support {
            cushion: base.cushion,
            tangential_stiffness_ratio: base.tangential_stiffness_ratio,
            friction_ratio: base.friction_ratio,
        };
        Some(Supported {
            mass_kg: base.mass_kg,
            edge,
            support,
        })
    }

    fn in_space(&mut self, kind: Kind, object: &Object, is_still: bool) -> Option<Asked> {
        let start = self.release();
        let width = self.read.positive("width", Dimension::Length);
        let named = body::on_cushions(&mut self.read);
        let orientation = self.read.quantity("orientation", Dimension::Angle);
        if is_still && !self.read.has("duration") {
            self.nothing_moves("give `motion`, or `initial_rotation` with `duration`");
        }
        let support = self.support(object);
        let shape = object.size.and_then(|(height_m, thickness_m)| match kind {
            Kind::AtWallOnPads => Some(Shape::Plane {
                thickness_m,
                height_m,
            }),
            // A wrong width has been said.
            _ if width.is_none() && self.read.has("width") => None,
            _ => {
                let shape = shape(named, height_m, thickness_m, width);
                self.read
                    .problems
                    .keep(shape.map_err(|problem| problem.of(&["width"])))
            }
        });
        let block = object
            .size
            .and_then(|(height_m, thickness_m)| Block::uniform(height_m, thickness_m).ok());
        let (walls, wall) = walls::walls(&mut self.read, block.as_ref(), object.mass_kg, None);
        let damping_ratio = self.wall_damping();
        let Supported {
            mass_kg,
            edge,
            support,
        } = support?;
        let wall_cushion = GivenCushion {
            stiffness_n_m: wall.stiffness_n_m,
            damping_ratio,
        };
        let walls = walls_on_cushions(&walls, wall_cushion, &support.cushion, mass_kg);
        let walls = self
            .read
            .problems
            .keep(walls.map_err(|problem| problem.of(&["wall_stiffness"])));
        Some(Asked::InSpace(SpatialRequest {
            object: SpatialObject {
                shape: shape?,
                mass_kg,
                support,
                walls: walls?,
            },
            edge,
            wall_cushion,
            motions: [None, None],
            vertical: None,
            orientation_rad: orientation.unwrap_or(0.0),
            how: HistoryOptions {
                settings: object.settings,
                start,
                ..HistoryOptions::default()
            },
        }))
    }

    /// ζ_w of walls beside the object.
    fn wall_damping(&mut self) -> Option<f64> {
        let is_beside = self.read.has("wall_gap_left") || self.read.has("wall_gap_right");
        if self.read.has("wall_damping") && !is_beside {
            self.read
                .problems
                .push(needs_a_gap().of(&["wall_gap_left"]));
        }
        self.read.accepted(
            "wall_damping",
            Dimension::Ratio,
            |ratio| (0.0..=1.0).contains(&ratio),
            ["from 0 to 100 %", "such as \"10 %\""],
        )
    }

    fn stack(&mut self, object: &Object, is_still: bool) -> Option<Asked> {
        let read = &mut self.read;
        let needed = ["upper_height", "upper_thickness", "upper_mass"];
        let missing: Vec<&'static str> = needed.into_iter().filter(|key| !read.has(key)).collect();
        if !missing.is_empty() {
            let message = "the upper body of the stack is incomplete";
            let hint = "give `upper_height`, `upper_thickness` and `upper_mass`, all three";
            read.missing(&missing, message, hint);
        }
        let height = read.positive("upper_height", Dimension::Length);
        let thickness = read.positive("upper_thickness", Dimension::Length);
        let mass = read.positive("upper_mass", Dimension::Mass);
        let stiffness = read.positive("interface_stiffness", Dimension::Stiffness);
        let friction_ratio = read.non_negative("interface_friction", Dimension::Ratio);
        if is_still && !read.has("duration") {
            self.nothing_moves("give `motion`");
        }
        let support = self.support(object);
        let Supported {
            mass_kg: lower_kg,
            edge,
            support,
        } = support?;
        let cushion = interface(&edge.cushion, stiffness, lower_kg, mass?);
        let cushion = cushion.map_err(|problem| problem.of(&["interface_stiffness"]));
        let cushion = self.read.problems.keep(cushion);
        let body = |(height_m, thickness_m), mass_kg| StackBody {
            height_m,
            thickness_m,
            mass_kg,
        };
        Some(Asked::Stack(StackRequest {
            stack: Stack {
                lower: body(object.size?, lower_kg),
                upper: body(height.zip(thickness)?, mass?),
                interface: Support {
                    cushion: cushion?,
                    friction_ratio,
                    ..support.clone()
                },
                support,
            },
            edge,
            horizontal: None,
            vertical: None,
            how: HistoryOptions {
                settings: object.settings,
                ..HistoryOptions::default()
            },
        }))
    }

    /// Where the second horizontal component is.
    fn second(&mut self, kind: Kind) -> Second {
        if !(matches!(kind, Kind::InSpace | Kind::Slides) || kind.is_body()) {
            return Second::None;
        }
        self.read.one("motion_y");
        self.read.exclusive("components", "component");
        self.read.exclusive("components", "motion_y");
        let second = self.read.text("components").map(components);
        let second = second.and_then(|second| self.read.keep("components", second));
        let is_across = self.read.has("components") || self.read.has("motion_y");
        if is_across && self.request.motion.is_empty() {
            let message = "the motion along the width has no motion along the thickness";
            self.read.missing(
                &["motion"],
                message,
                "name the motion along the thickness with `motion`",
            );
        }
        second.unwrap_or_default()
    }

    /// What several motions exclude.
    fn of_several(&mut self, kind: Kind) {
        if !(matches!(kind, Kind::Rigid | Kind::Slides) || kind.is_body()) {
            let message = format!("several motions do not apply to {}", kind.words());
            self.read.note(&["motion"], message, "name one motion");
        } else if self.read.has("motion_y") {
            let message = "`motion_y` belongs to one motion, but several are given";
            self.read.note(
                &["motion_y"],
                message,
                "give one `motion` with its `motion_y` at a time, or `components` of each file",
            );
        } else if self.read.has("vertical") {
            let message = "`vertical` belongs to one motion, but several are given";
            self.read.note(
                &["vertical"],
                message,
                "give one `motion` with its `vertical` at a time",
            );
        }
    }
}

impl Asked {
    /// The object under one of the motions; `across` is along its width.
    #[must_use]
    pub fn under(
        &self,
        motion: Option<Motion>,
        across: Option<Motion>,
        upward: Option<Motion>,
        is_sampled: bool,
    ) -> Self {
        let mut asked = self.clone();
        match &mut asked {
            Self::Rigid(RockRequest {
                horizontal,
                vertical,
                how,
                ..
            })
            | Self::OnPads(CompliantRequest {
                horizontal,
                vertical,
                how,
                ..
            })
            | Self::Stack(StackRequest {
                horizontal,
                vertical,
                how,
                ..
            }) => {
                (*horizontal, *vertical, how.is_sampled) = (motion, upward, is_sampled);
            }
            Self::Slides(request) => {
                (request.horizontal, request.across) = (motion, across);
                (request.vertical, request.how.is_sampled) = (upward, is_sampled);
            }
            Self::InSpace(SpatialRequest {
                motions,
                vertical,
                how,
                ..
            }) => {
                (*motions, *vertical, how.is_sampled) = ([motion, across], upward, is_sampled);
            }
            Self::Hull(request) => {
                (request.motions, request.vertical) = ([motion, across], upward);
                request.is_sampled = is_sampled;
            }
        }
        asked
    }
}
