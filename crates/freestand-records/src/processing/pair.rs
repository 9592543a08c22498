//! Two horizontal components of a record, taken together.

use freestand::signal::rotate::{Pair, RotateError};

use super::align::{Aligned, aligned};
use super::{Processed, Processing, Scale, finish, refused};
use crate::formats::{Component, Direction, MotionFile};
use crate::notes::{Note, NoteKind};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::number;

/// A component and its azimuth \[degrees clockwise from north\].
pub type Bearing<'f> = (&'f Component, f64);

/// The two horizontal components of a file, with the azimuths that the file states.
///
/// # Errors
/// More or fewer than two components with an azimuth; the message says which component has none.
pub fn horizontal_pair(file: &MotionFile) -> Result<(Bearing<'_>, Bearing<'_>), Problem> {
    let horizontal: Vec<Bearing<'_>> = file
        .components
        .iter()
        .filter_map(|one| azimuth_of(one).map(|azimuth_deg| (one, azimuth_deg)))
        .collect();
    if let [first, second] = horizontal[..] {
        return Ok((first, second));
    }
    let silent = file.components.iter().filter(|one| one.direction.is_none());
    let message = match horizontal.len() {
        count if count > 2 => format!(
            "has {count} horizontal components, but two are needed: {}",
            names(horizontal.iter().map(|one| one.0))
        ),
        _ if silent.clone().next().is_some() => {
            format!("the file does not state the direction of {}", names(silent))
        }
        1 => "has 1 horizontal component, but two are needed".to_owned(),
        count => format!("has {count} horizontal components, but two are needed"),
    };
    Err(Problem::value(
        message,
        "use freestand motion rotate with two files, or two components of one, and their azimuths",
    )
    .in_file(&file.path))
}

/// The azimuth that the file states \[degrees clockwise from north\].
pub fn azimuth_of(component: &Component) -> Option<f64> {
    match component.direction {
        Some(Direction::Azimuth(azimuth_deg)) => Some(azimuth_deg),
        _ => None,
    }
}

fn names<'f>(components: impl Iterator<Item = &'f Component>) -> String {
    const MAX: usize = 8;
    let mut listed: Vec<String> = components
        .take(MAX + 1)
        .map(|one| shorten(&one.name))
        .collect();
    if let Some(more) = listed.get_mut(MAX) {
        "…".clone_into(more);
    }
    listed.join(", ")
}

/// Two components of one file: those requested by name or number, else the only two that have an
/// azimuth, else the only two that do not point up.
///
/// # Errors
/// No such pair.
pub fn pair_of_one<'f>(
    file: &'f MotionFile,
    called: Option<(&str, &str)>,
) -> Result<(&'f Component, &'f Component), Problem> {
    if let Some((first, second)) = called {
        let (first, second) = (file.select(Some(first))?, file.select(Some(second))?);
        if std::ptr::eq(first, second) {
            return Err(Problem::value(
                format!("\"{}\" is named twice", shorten(&first.name)),
                "name two different components",
            )
            .in_file(&file.path));
        }
        return Ok((first, second));
    }
    let of = |is_it: fn(&&Component) -> bool| -> Vec<&'f Component> {
        file.components.iter().filter(is_it).collect()
    };
    let with_azimuth = of(|one| azimuth_of(one).is_some());
    let level = of(|one| one.direction != Some(Direction::Up));
    match (with_azimuth.as_slice(), level.as_slice()) {
        ([first, second], _) | (_, [first, second]) => Ok((first, second)),
        (_, [only]) => {
            let message = format!("the file has only one horizontal component, {}", only.name);
            let hint = "give the file with the second component too, or use a file with both";
            Err(Problem::value(message, hint).in_file(&file.path))
        }
        _ => {
            let message = format!(
                "cannot tell which two components are meant: {}",
                names(file.components.iter())
            );
            Err(
                Problem::value(message, "name two with `components`, or give two files")
                    .in_file(&file.path),
            )
        }
    }
}

/// Two components with their azimuths: those given, else those that the files state.
///
/// # Errors
/// A component whose azimuth is neither given nor stated.
pub fn with_azimuths<'f>(
    pair: (&'f Component, &'f Component),
    given_deg: Option<(f64, f64)>,
) -> Result<(Bearing<'f>, Bearing<'f>), Problem> {
    let (first, second) = pair;
    if let Some((one_deg, two_deg)) = given_deg {
        return Ok(((first, one_deg), (second, two_deg)));
    }
    let bearing = |component: &'f Component| {
        azimuth_of(component)
            .map(|azimuth_deg| (component, azimuth_deg))
            .ok_or_else(|| {
                let name = shorten(&component.name);
                Problem::value(
                    format!("the file does not state the direction of {name}"),
                    "give both azimuths, such as `azimuths = \"0 deg, 90 deg\"`",
                )
            })
    };
    Ok((bearing(first)?, bearing(second)?))
}

/// Both components of a pair, each processed separately. `names` are their names in words;
/// notes about both are with the first.
///
/// # Errors
/// A scale that depends on the record, which would differ between the two; otherwise as
/// [`super::process`].
pub fn process_pair(
    (first, second): (&Component, &Component),
    names: (&str, &str),
    processing: &Processing,
) -> Result<(Processed, Processed), Problem> {
    if !matches!(processing.scale, Scale::Factor(_)) {
        let message = "two components cannot be scaled to a target: each would get its own factor";
        return Err(Problem::value(
            message,
            "give the factor itself with `scale`",
        ));
    }
    let [one, two] = aligned((first, second), names, processing.keep_mean)?;
    let finished = |one: Aligned| finish(one.motion, one.notes, None, processing);
    Ok((finished(one)?, finished(two)?))
}

/// A warning if components that are treated as perpendicular are not.
pub fn not_perpendicular(first: &Component, second: &Component) -> Option<Note> {
    let turn = (azimuth_of(first)? - azimuth_of(second)?).rem_euclid(180.0);
    let between = turn.min(180.0 - turn);
    (between < 89.0).then(|| {
        let words = format!(
            "the components are {between} degrees apart, but spectra over all directions treat them as perpendicular"
        );
        Note::new(NoteKind::NotPerpendicular, words)
    })
}

/// The component at an azimuth, from two others, processed. The means of raw ones are removed
/// first; the times that only one has are left out. `names` are their names in words.
///
/// # Errors
/// Different time steps, components nearly parallel; otherwise as [`super::process`].
pub fn turned(
    first: Bearing<'_>,
    second: Bearing<'_>,
    names: (&str, &str),
    azimuth_deg: f64,
    processing: &Processing,
) -> Result<Processed, Problem> {
    let [
        Aligned {
            motion: one,
            notes: mut unasked,
        },
        two,
    ] = aligned((first.0, second.0), names, processing.keep_mean)?;
    unasked.extend(two.notes);
    let rotated = Pair::new(&one, &two.motion)
        .and_then(|pair| pair.component_at(first.1, second.1, azimuth_deg));
    let motion = rotated.map_err(|error| {
        let hint = match error {
            RotateError::Steps { .. } => {
                "first resample one of them to the step of the other with freestand motion convert"
            }
            _ => "give the two horizontal components of one record, and their azimuths",
        };
        refused("azimuth", error, hint)
    })?;
    let step = format!(
        "components {} ({} deg) and {} ({} deg) rotated to {} deg",
        names.0,
        number(first.1, 6),
        names.1,
        number(second.1, 6),
        number(azimuth_deg, 6)
    );
    finish(motion, unasked, Some(step), processing)
}
