//! An object of a list with the values of one draw, as it is followed ([`freestand::respond`]), and
//! what its response means in its world. [`Way`] decides how it is followed; an object in a plane is
//! followed about both of its axes, and the worse one counts.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use freestand::G0_M_S2;
use freestand::compliant::{CompliantBase, EdgeSide};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::hull::poses::StablePose;
use freestand::hull::shake::Contact;
use freestand::hull::wall::HullWall;
use freestand::respond::{
    Glide, Glider, Object, OnHull, Outcome, Pads, Plane, Planes, Response, RigidPlane, Settings,
    Shaking, Springs, respond,
};
use freestand::sliding::{Clearance, Friction};
use freestand::spatial::{Shape, SpatialObject, Stack, StackBody, Support, Wall};

use freestand_study::drawn_body::Drawing;
use freestand_study::hull::BodyInPose;

use crate::result::Axis;
use crate::worlds::FloorOfWorld;

use super::draw::{Draw, Drawn, WAVE_M, WAVES};
use super::object::{Beside, Gliding, Upper, Way};
use super::response::{
    Lost, ModelResponse, PadMotion, PadResponse, RigidResponse, axis_motion, glided, on_hull,
    pad_motion,
};

impl Drawn<'_> {
    /// On a rigid base, or rolling or sliding.
    pub(super) fn on_rigid_base(self) -> Result<Object, Lost> {
        let subject = self.subject;
        let object = match &subject.way {
            Way::Rolls(gliding) => self.glider(gliding).map(Object::Rolls),
            Way::Slides(gliding) => self.glider(gliding).map(Object::Slides),
            Way::Hull(body, beside) => {
                let on = self.on_hull(body, beside.as_ref());
                on.map(|on| Object::Hull(Box::new(on)))
            }
            Way::Planar | Way::Walled(_) | Way::Spatial(_) | Way::Stack(_) => {
                let plane = |axis| self.rigid_plane(axis);
                self.about_axes(plane).map(Object::Rigid)
            }
        };
        object.ok_or_else(Lost::missing)
    }

    /// About one axis on a rigid base.
    pub(super) fn rigid_plane(self, axis: usize) -> Option<RigidPlane> {
        let Drawn { subject, draw } = self;
        let (block, restitution) = draw.block(subject, axis)?;
        let along = draw.along(axis);
        Some(RigidPlane {
            plane: Plane { along, block },
            restitution,
            walls: draw.walls(subject, axis),
        })
    }

    /// On its pads; in a plane with this friction.
    pub(super) fn on_pads(self, friction_ratio: Option<f64>) -> Result<Object, Lost> {
        let along = self.draw.along(0);
        let object = match &self.subject.way {
            Way::Spatial(beside) => {
                let object = self.in_space(beside.as_ref());
                object.map(|object| Object::Spatial(object, along))
            }
            Way::Stack(upper) => self.stack(upper).map(|stack| Object::Stack(stack, along)),
            Way::Planar | Way::Walled(_) | Way::Rolls(_) | Way::Slides(_) | Way::Hull(..) => {
                self.in_planes(friction_ratio)
            }
        };
        object.ok_or_else(Lost::missing)
    }

    fn in_planes(self, friction_ratio: Option<f64>) -> Option<Object> {
        let Drawn { subject, draw } = self;
        let planes = self.planes()?;
        let (mass_kg, cushion) = draw.body(subject)?;
        let stiffness_n_m = cushion.linear_stiffness_n_m();
        if let Some(stiffness_n_m) = stiffness_n_m.filter(|_| friction_ratio.is_none()) {
            return Some(Object::Springs(Springs {
                planes,
                mass_kg,
                stiffness_n_m,
                damping_n_s_m: draw.pad_damping_n_s_m(stiffness_n_m, mass_kg),
            }));
        }
        self.pads(friction_ratio).map(Object::Pads)
    }

    /// On its pads in a plane, for the solver of any law.
    pub(super) fn pads(self, friction_ratio: Option<f64>) -> Option<Pads> {
        let (mass_kg, cushion) = self.draw.damped_body(self.subject)?;
        let base = CompliantBase {
            friction_ratio,
            ..CompliantBase::new(mass_kg, cushion)
        };
        let planes = self.planes()?;
        Some(Pads { planes, base })
    }

    fn planes(self) -> Option<Planes<Plane>> {
        let Drawn { subject, draw } = self;
        self.about_axes(|axis| {
            let (block, _) = draw.block(subject, axis)?;
            let along = draw.along(axis);
            Some(Plane { along, block })
        })
    }

    /// `of` about each axis; `None` where one has none.
    fn about_axes<T>(self, of: impl FnMut(usize) -> Option<T>) -> Option<Planes<T>> {
        let axes = (0..self.subject.axes.len()).map(of);
        Planes::of(axes.collect::<Option<Vec<_>>>()?)
    }

    /// How the surface of a body is drawn that is followed on its hull; its error is too small to be seen.
    pub(super) fn drawing(self, body: &BodyInPose) -> Drawing {
        let (height, side) = self.draw.factors();
        let pose = body.standing.scaled([side, side, height], 1.0);
        let pose = pose.pose();
        let up_m = self.cg_rise_m(body, pose);
        Drawing {
            scale_ratio: [side, side, height],
            shift_m: pose.down.map(|x| up_m * x),
        }
    }

    /// How much higher than that of a uniform body its centre of gravity is drawn, of a scan of which nobody stated it \[m\].
    fn cg_rise_m(self, body: &BodyInPose, pose: &StablePose) -> f64 {
        let drawn = self
            .draw
            .hull
            .filter(|_| body.kind.is_scan() && !body.is_cg_stated);
        drawn.map_or(0.0, |drawn| drawn.cg_ratio * pose.cg_height_m)
    }

    pub(super) fn on_hull(self, body: &BodyInPose, beside: Option<&Beside>) -> Option<OnHull> {
        let drawn = self.draw.hull?;
        let (height, side) = self.draw.factors();
        let mut standing = body.standing.scaled([side, side, height], self.draw.mass());
        if body.kind.is_scan() {
            // The amplitude of the sum of waves is the error, as the root of its mean square.
            let amplitude_m = body.scan_error_m * (2.0 / WAVES as f64).sqrt();
            let waves = drawn.waves_rad.map(|[toward, phase]| {
                let (sin, cos) = toward.sin_cos();
                let per_m = TAU / WAVE_M;
                ([per_m * cos, per_m * sin], phase, amplitude_m)
            });
            let waves = match body.scan_error_m > 0.0 {
                true => &waves[..],
                false => &[],
            };
            let up_m = self.cg_rise_m(body, standing.pose());
            standing = standing.uneven(up_m, waves);
        }
        let contact = Contact {
            friction_ratio: self.draw.friction_ratio?,
            sinking_m: drawn.contact.sinking_m * body.sinking_ratio(),
            ..drawn.contact
        };
        let beside = beside.zip(self.draw.wall.as_ref());
        let walls = beside.map(|(beside, drawn)| {
            let edge_n_m = contact.edge_n_m(standing.mass_kg(), G0_M_S2);
            // A stated stiffness counts only where the mass is known.
            let stated = beside
                .stiffness_n_m
                .filter(|_| self.subject.mass_kg.is_some())
                .map(|given_n_m| contact.wall_n_m(given_n_m, standing.mass_kg(), G0_M_S2));
            let wall = |(toward_rad, gap_m): (f64, Option<f64>)| {
                Some(HullWall {
                    toward_rad,
                    gap_m: gap_m?,
                    stiffness_n_m: stated.unwrap_or(drawn.stiffness_ratio * edge_n_m),
                    damping_ratio: drawn.damping_ratio,
                })
            };
            let behind = if drawn.is_on_left { PI } else { 0.0 };
            let all = [
                (behind, beside.wall_gap_m),
                (FRAC_PI_2, beside.neighbour_gap_m),
                (-FRAC_PI_2, beside.neighbour_gap_m),
            ];
            all.into_iter().filter_map(wall).collect()
        });
        Some(OnHull {
            body: standing.beside(walls.unwrap_or_default()),
            contact,
            yaw_rad: self.draw.yaw_rad,
        })
    }

    fn glider(self, gliding: &Gliding) -> Option<Glider> {
        Some(Glider {
            planes: self.planes()?,
            friction: Friction::uniform(self.resistance_ratio(gliding)).ok()?,
            clearance: Clearance {
                left_m: gliding.clearance_m,
                right_m: gliding.clearance_m,
            },
            yaw_rad: self.draw.yaw_rad,
        })
    }

    /// μ_r, or the friction of its base.
    fn resistance_ratio(self, gliding: &Gliding) -> f64 {
        let drawn = self.draw.friction_ratio;
        drawn.unwrap_or(gliding.resistance_ratio.1)
    }

    fn in_space(self, beside: Option<&Beside>) -> Option<SpatialObject> {
        let Drawn { subject, draw } = self;
        let (mass_kg, cushion) = draw.damped_body(subject)?;
        let (height_m, thickness_m) = draw.size_m(subject, 0);
        let (_, width_m) = draw.size_m(subject, 1);
        Some(SpatialObject {
            shape: Shape::Prism {
                thickness_m,
                width_m,
                height_m,
            },
            mass_kg,
            walls: beside
                .into_iter()
                .flat_map(|beside| walls(beside, draw, mass_kg, &cushion))
                .collect(),
            support: Support {
                friction_ratio: draw.friction_ratio,
                ..Support::new(cushion)
            },
        })
    }

    pub(super) fn stack(self, upper: &Upper) -> Option<Stack> {
        let Drawn { subject, draw } = self;
        let (mass_kg, cushion) = draw.damped_body(subject)?;
        let (height_m, thickness_m) = draw.size_m(subject, 0);
        let support = Support {
            friction_ratio: draw.friction_ratio,
            ..Support::new(cushion)
        };
        let [mass, height, thickness] = draw.upper;
        Some(Stack {
            lower: StackBody {
                height_m,
                thickness_m,
                mass_kg,
            },
            upper: StackBody {
                height_m: upper.height_m * height,
                thickness_m: upper.thickness_m * thickness,
                mass_kg: upper.mass_kg * mass,
            },
            interface: support.clone(),
            support,
        })
    }

    /// What a response on a rigid base means in this world, about every axis.
    pub(super) fn rigid_response(
        self,
        floor: &FloorOfWorld,
        found: Result<Response, Lost>,
    ) -> RigidResponse {
        let Drawn { subject, draw } = self;
        let body = draw.body(subject);
        let found = found?;
        let outcome = found.outcome();
        let axes = match (found, subject.way.glides()) {
            (Response::Rigid(planes), _) => {
                let motion = |(axis, rocking)| {
                    let (block, _) = draw.block(subject, axis)?;
                    let body = body.as_ref();
                    let floor_m_s2 = floor.pfa_m_s2;
                    Some(axis_motion(self, axis, &block, rocking, body, floor_m_s2))
                };
                planes.into_iter().enumerate().filter_map(motion).collect()
            }
            (Response::Rolled(planes) | Response::Slid(planes), Some(gliding)) => {
                // No more than its resistance gets through to it.
                let through_m_s2 = (self.resistance_ratio(gliding) * G0_M_S2).min(floor.pfa_m_s2);
                let motion = |glide: Glide| glided(self, gliding, glide, through_m_s2);
                planes.into_iter().map(motion).collect()
            }
            (Response::Hull(found), _) => vec![on_hull(self, found, floor.pfa_m_s2)],
            _ => return Err(Lost::no_history()),
        };
        Ok(ModelResponse { outcome, axes })
    }

    /// What a response on its pads means in this world, about every axis or of the whole body.
    pub(super) fn pad_response(
        self,
        floor: &FloorOfWorld,
        found: Result<Response, Lost>,
    ) -> PadResponse {
        let motion = |found| pad_motion(self, found, floor.pfa_m_s2);
        let found = found?;
        let outcome = found.outcome();
        let axes = match found {
            Response::Pads(planes) => planes.into_iter().map(motion).collect(),
            Response::Spatial(body, space) => vec![PadMotion {
                space,
                ..motion(body)
            }],
            Response::Stack(lower, fallen) => vec![PadMotion {
                fallen,
                ..motion(lower)
            }],
            Response::Rigid(_) | Response::Rolled(_) | Response::Slid(_) | Response::Hull(_) => {
                return Err(Lost::no_history());
            }
        };
        Ok(ModelResponse { outcome, axes })
    }
}

/// What objects do, each under its motion; an object that could not be made, or of which it is not
/// certain what becomes of it, has its reason.
pub(super) fn responses<'a>(
    objects: impl IntoIterator<Item = Result<(Object, Shaking<'a>), Lost>>,
) -> Vec<Result<Response, Lost>> {
    let mut known = Vec::new();
    let made = objects
        .into_iter()
        .map(|one| one.map(|one| known.push(one)));
    let made: Vec<Result<(), Lost>> = made.collect();
    let mut found = respond(&known, &Settings::default()).into_iter();
    let mut next = || match found.next().ok_or_else(Lost::no_history)?? {
        open if open.outcome() == Outcome::Unresolved => Err(Lost::failed(
            "the object is neither at rest nor down long after the motion",
        )),
        response => Ok(response),
    };
    made.into_iter()
        .map(|made| made.and_then(|()| next()))
        .collect()
}

/// The wall behind an object on its pads, on the side and with the cushion that were drawn.
fn walls(beside: &Beside, draw: &Draw, mass_kg: f64, pad: &Cushion) -> Vec<Wall> {
    let Some(drawn) = &draw.wall else {
        return Vec::new();
    };
    let walls = beside.walls(Axis::Thickness, drawn);
    let edge_n_m = pad.tangent_stiffness_n_m(pad.static_compression_m(0.5 * mass_kg * G0_M_S2));
    let stiffness_n_m = beside
        .stiffness_n_m
        .unwrap_or(drawn.stiffness_ratio * edge_n_m);
    let law = ContactLaw::KelvinVoigt {
        stiffness_n_m,
        damping_n_s_m: 2.0 * drawn.damping_ratio * (stiffness_n_m * mass_kg).sqrt(),
    };
    let cushion = Cushion::new(law).ok();
    let wall = |(side, wall): (EdgeSide, Option<freestand::wall::Wall>)| {
        let wall = wall?;
        Some(Wall {
            side,
            gap_m: wall.gap_m,
            height_m: wall.height_m.unwrap_or(f64::INFINITY),
            cushion: cushion.clone(),
        })
    };
    [(EdgeSide::Left, walls.left), (EdgeSide::Right, walls.right)]
        .into_iter()
        .filter_map(wall)
        .collect()
}

#[cfg(test)]
mod tests {
    use freestand_inventory::library::Libraries;
    use freestand_inventory::{ReadOptions, read_inventory};
    use freestand_study::study::assessment::{Dimensions, Settings};

    use super::super::draw::{Change, draw, key};
    use super::super::object::Subject;
    use super::*;

    /// A wall has the stiffness and the damping that were drawn, in three dimensions on pads and on the hull; what the list
    /// gives is not drawn.
    #[test]
    fn walls_have_the_cushions_that_were_drawn() {
        let list = "id,level_ratio,height [mm],thickness [mm],width [mm],mass [kg],stiffness [N/mm],shape,\
                    wall_gap [mm],wall_stiffness [N/mm]\n\
                    shelf,0,1760,465,800,113,4380,,50,\nstated,0,1760,465,800,113,4380,,0,9000\n\
                    urn,0,1200,300,,40,,cylinder,20,\n";
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("list.csv");
        std::fs::write(&path, list).unwrap();
        let libraries = Libraries::with_files(None, None).unwrap();
        let read = libraries.looked_up(|lookup| read_inventory(&path, &ReadOptions::new(lookup)));
        let settings = Settings {
            dimensions: Dimensions::Three,
            ..Settings::default()
        };
        for item in read.unwrap().items {
            let subject = Subject::new(&item, &settings).unwrap();
            for world in 0..3 {
                let draw = draw(&settings, &subject, key(&item.id), world, Change::None);
                let drawn = Drawn {
                    subject: &subject,
                    draw: &draw,
                };
                let wall = draw.wall.unwrap();
                if item.is_round() {
                    let Object::Hull(on) = drawn.on_rigid_base().unwrap() else {
                        panic!("{} is followed on its hull", item.id)
                    };
                    let [found] = *on.body.walls() else {
                        panic!("it has one wall")
                    };
                    // 2 m g/(3 δ): two points.
                    let edge_n_m = 2.0 * on.body.mass_kg() * G0_M_S2 / (3.0 * on.contact.sinking_m);
                    let ratio = found.stiffness_n_m / edge_n_m;
                    assert!(
                        (ratio / wall.stiffness_ratio - 1.0).abs() < 1e-12,
                        "{found:?}"
                    );
                    assert_eq!(found.damping_ratio, wall.damping_ratio);
                    assert_eq!(found.gap_m, 0.02);
                    continue;
                }
                let Object::Spatial(object, _) = drawn.on_pads(None).unwrap() else {
                    panic!("{} is followed in three dimensions", item.id)
                };
                let [found] = &object.walls[..] else {
                    panic!("it has one wall")
                };
                let edge_n_m = 4.38e6 * draw.stiffness;
                let expected_n_m = match &*item.id {
                    "stated" => 9e6,
                    _ => wall.stiffness_ratio * edge_n_m,
                };
                let ContactLaw::KelvinVoigt {
                    stiffness_n_m,
                    damping_n_s_m,
                } = *found.cushion.as_ref().unwrap().law()
                else {
                    panic!("{found:?}")
                };
                let damping = damping_n_s_m / (2.0 * (stiffness_n_m * object.mass_kg).sqrt());
                assert!(
                    (stiffness_n_m / expected_n_m - 1.0).abs() < 1e-12,
                    "{found:?}"
                );
                assert!(
                    (damping / wall.damping_ratio - 1.0).abs() < 1e-12,
                    "{found:?}"
                );
            }
        }
    }
}
