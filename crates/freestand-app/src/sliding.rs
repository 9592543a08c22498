//! Objects that slide or stand on casters.

use clap::ArgAction;
use freestand::sliding::Clearance;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_study::sliding::{Contact, Surface, SurfaceGiven};

use crate::request::{Switch, request};

request! {
    /// What is under an object that does not rock.
    pub struct Sliding under "Sliding and casters" {
        /// The object slides and does not rock: its friction is at most its thickness divided by its
        /// height
        pub sliding = switch,
        /// Coefficient of friction while it slides, at most --friction [default: equal to --friction]
        pub friction_kinetic = "RATIO",
        /// The object stands on casters that swivel, and rolls
        #[arg(long, alias = "castors", action = ArgAction::SetTrue, help_heading = "Sliding and casters")]
        pub casters: Switch,
        /// Rolling resistance of the casters: 0.01 on a hard floor, 0.05 on carpet [default: 0.02]
        pub rolling_resistance = "RATIO",
        /// The casters are braked: the wheels slide at --friction, or hold until the object rocks on
        /// them (--base-width is the distance between them); halve the friction if half of them are
        /// braked
        pub brakes = switch,
        /// Room to the left: the time and the speed at which the object reaches it are reported
        pub clearance_left = "LENGTH",
        /// Room to the right
        pub clearance_right = "LENGTH",
        /// Stiffness of what it reaches there; with --mass it gives the shock of that stop
        pub stop_stiffness = "STIFFNESS",
    }
}

/// What is under an object that was said to slide or to stand on casters; `None` if it was not.
pub(crate) fn contact(read: &mut WordReader<'_>) -> Option<Contact> {
    read.exclusive("sliding", "casters");
    let (sliding, casters, brakes) = (
        read.flag("sliding"),
        read.flag("casters"),
        read.flag("brakes"),
    );
    let needs_casters = |read: &mut WordReader<'_>, key: &'static str| {
        let (message, hint) = (
            format!("`{key}` applies only to an object on casters"),
            if read.has("sliding") {
                "give `casters` in place of `sliding`, or leave it out"
            } else {
                "add `casters`, or leave it out"
            },
        );
        read.note(&[key], message, hint);
    };
    if brakes && !casters {
        needs_casters(read, "brakes");
    }
    if read.has("rolling_resistance") {
        if !casters {
            needs_casters(read, "rolling_resistance");
        }
        read.exclusive("rolling_resistance", "brakes");
    }
    match (sliding, casters, brakes) {
        (true, ..) => Some(Contact::Base),
        (_, true, true) => Some(Contact::BrakedCasters),
        (_, true, false) => Some(Contact::Casters),
        (false, false, _) => None,
    }
}

/// The key of the coefficient of a contact.
pub(crate) fn coefficient(contact: Contact) -> &'static str {
    match contact {
        Contact::Casters => "rolling_resistance",
        Contact::Base | Contact::BrakedCasters => "friction",
    }
}

/// The surface under an object that slides or rolls; `None` if something is wrong.
pub(crate) fn surface(read: &mut WordReader<'_>, contact: Contact) -> Option<Surface> {
    if contact == Contact::Casters {
        for key in ["friction", "friction_kinetic"] {
            if read.has(key) {
                let message =
                    format!("`{key}` is that of a base or of braked wheels, and these roll");
                read.note(
                    &[key],
                    message,
                    "give `rolling_resistance`, or add `brakes`",
                );
            }
        }
    }
    let given = SurfaceGiven {
        contact,
        friction: read.non_negative("friction", Dimension::Ratio),
        friction_kinetic: read.non_negative("friction_kinetic", Dimension::Ratio),
        rolling_resistance: read.positive("rolling_resistance", Dimension::Ratio),
        clearance: Clearance {
            left_m: read.non_negative("clearance_left", Dimension::Length),
            right_m: read.non_negative("clearance_right", Dimension::Length),
        },
    };
    let key = if contact == Contact::Casters {
        "rolling_resistance"
    } else {
        "friction_kinetic"
    };
    let surface = Surface::new(&given).map_err(|problem| problem.of(&[key]));
    read.problems.keep(surface)
}
