//! Flags of objects that slide or stand on casters, shared by `rock` and `spectrum`.

use clap::Args;
use freestand::sliding::Clearance;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_study::sliding::{Contact, Surface, SurfaceGiven};

use crate::args::Named;
use crate::failure::Failure;
use crate::values::{Given, Reads, Values};

/// What is under an object that does not rock.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Sliding and casters")]
pub(crate) struct SlidingArgs {
    /// The object slides and does not rock: its friction is at most its thickness divided by its
    /// height
    #[arg(long, conflicts_with = "casters")]
    sliding: bool,
    /// Coefficient of friction while it slides, at most --friction [default: equal to --friction]
    #[arg(long, non_negative = Dimension::Ratio)]
    friction_kinetic: Option<Given>,
    /// The object stands on casters that swivel, and rolls
    #[arg(long, alias = "castors")]
    casters: bool,
    /// Rolling resistance of the casters: 0.01 on a hard floor, 0.05 on carpet [default: 0.02]
    #[arg(long, positive = Dimension::Ratio, requires = "casters", conflicts_with = "brakes")]
    rolling_resistance: Option<Given>,
    /// The casters are braked: the wheels slide at --friction, or hold until the object rocks on
    /// them (--base-width is the distance between them); halve the friction if half of them are
    /// braked
    #[arg(long, requires = "casters")]
    brakes: bool,
    /// Room to the left: the time and the speed at which the object reaches it are reported
    #[arg(long, non_negative = Dimension::Length)]
    clearance_left: Option<Given>,
    /// Room to the right
    #[arg(long, non_negative = Dimension::Length)]
    clearance_right: Option<Given>,
    /// Stiffness of what it reaches there; with --mass it gives the shock of that stop
    #[arg(long, positive = Dimension::Stiffness)]
    pub(super) stop_stiffness: Option<Given>,
}

impl SlidingArgs {
    /// Whether the object slides or rolls.
    pub(crate) fn is_given(&self) -> bool {
        self.sliding || self.casters
    }

    fn contact(&self) -> Option<Contact> {
        match (self.sliding, self.casters, self.brakes) {
            (true, ..) => Some(Contact::Base),
            (_, true, true) => Some(Contact::BrakedCasters),
            (_, true, false) => Some(Contact::Casters),
            (false, false, _) => None,
        }
    }

    /// What is under the object; problems are added to `values`.
    pub(crate) fn surface(&self, friction: Option<f64>, values: &mut Values) -> Option<Surface> {
        let contact = self.contact()?;
        // clap does not ask for --casters where --sliding excludes them.
        let of_casters = [
            (self.rolling_resistance.is_some(), "rolling-resistance"),
            (self.brakes, "brakes"),
        ];
        if let Some((_, flag)) = of_casters
            .into_iter()
            .find(|(is_given, _)| *is_given && contact == Contact::Base)
        {
            let message = format!("--{flag} applies only to an object on casters");
            values.push(Problem::value(
                message,
                "give --casters in place of --sliding, or leave it out",
            ));
        }
        if contact == Contact::Casters && (friction.is_some() || self.friction_kinetic.is_some()) {
            let message = "--friction and --friction-kinetic are those of a base or of braked wheels, and these roll";
            values.push(Problem::value(
                message,
                "give --rolling-resistance, or add --brakes",
            ));
        }
        let given = SurfaceGiven {
            contact,
            friction,
            friction_kinetic: values.read(&self.friction_kinetic),
            rolling_resistance: values.read(&self.rolling_resistance),
            clearance: Clearance {
                left_m: values.read(&self.clearance_left),
                right_m: values.read(&self.clearance_right),
            },
        };
        values.take(Surface::new(&given))
    }
}

impl Named<SlidingArgs> {
    /// The error where these flags do not apply.
    pub(crate) fn refused(&self, is_compliant: bool) -> Option<Failure> {
        let first = self.given.first()?;
        if is_compliant {
            let hint = "leave it out: on cushions, --friction decides whether the object slides";
            return Some(Failure::usage(
                format!("--{first} applies only to a rigid base"),
                hint,
            ));
        }
        let hint = "add --sliding, or --casters";
        (!self.is_given()).then(|| {
            Failure::usage(
                format!("--{first} applies only to objects that slide or roll"),
                hint,
            )
        })
    }
}
