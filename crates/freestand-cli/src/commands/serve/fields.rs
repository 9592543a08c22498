//! Messages in the words of the page: whoever reads them sees fields, and has no command line.

/// Fields whose labels are not the words of their flags.
const LABELS: &[(&str, &str)] = &[
    ("thickness", "Depth"),
    ("on", "Pads under one edge"),
    ("pga", "Peak ground acceleration"),
    ("site", "Soil"),
    ("cg-height", "Height of the centre of gravity"),
    ("tolerance", "Withstands"),
    ("friction", "Friction on the floor"),
    ("wall-gap", "Gap to the wall behind it"),
    ("wall-height", "Height of the wall"),
    ("neighbour-gap", "Gap to its neighbours"),
    ("clearance", "Room to slide or roll"),
    ("casters", "Stands on"),
    ("upper-height", "Height of the object on top"),
    ("upper-thickness", "Depth of the object on top"),
    ("upper-mass", "Mass of the object on top"),
];

/// The label of the field of a flag.
fn label(flag: &str) -> String {
    if let Some((_, label)) = LABELS.iter().find(|(name, _)| *name == flag) {
        return (*label).to_owned();
    }
    let words = flag.replace('-', " ");
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A message with the labels of fields in place of flags and of what follows a flag in a usage line.
pub(super) fn named(text: &str) -> String {
    let (mut told, mut rest) = (String::with_capacity(text.len()), text);
    while let Some((before, tail)) = rest.split_once("--") {
        let end =
            tail.find(|c: char| !(c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')).unwrap_or(tail.len());
        let (flag, after) = tail.split_at(end);
        let is_flag = flag.starts_with(|c: char| c.is_ascii_lowercase())
            && !before.ends_with(|c: char| c.is_alphanumeric() || c == '-');
        if !is_flag {
            told.push_str(before);
            told.push_str("--");
            rest = tail;
            continue;
        }
        // clap quotes a flag with its value: '--storeys <N>'.
        let (before, is_quoted) = before.strip_suffix('\'').map_or((before, false), |before| (before, true));
        let value = after.strip_prefix(" <").and_then(|value| value.split_once('>'));
        let after = value.map_or(after, |(_, after)| after.trim_start_matches("..."));
        let after = if is_quoted { after.strip_prefix('\'').unwrap_or(after) } else { after };
        told.push_str(before);
        told.push('“');
        told.push_str(&label(flag));
        told.push('”');
        rest = after;
    }
    told.push_str(rest);
    told
}

/// A remedy without the parts that send its reader to a command line.
pub(super) fn hint(text: &str) -> String {
    let is_of_shell = |part: &&str| {
        part.contains("--help") || part.starts_with("usage:") || part.split("freestand ").skip(1).any(begins_with_word)
    };
    let kept: Vec<&str> = text.split("; ").filter(|part| !is_of_shell(part)).collect();
    match kept.is_empty() {
        true => "correct this entry".to_owned(),
        false => named(&kept.join("; ")),
    }
}

/// Whether the word after the name of the program is that of a command.
fn begins_with_word(rest: &str) -> bool {
    rest.starts_with(|c: char| c.is_ascii_lowercase())
}

#[cfg(test)]
mod tests {
    use super::{hint, named};

    #[test]
    fn flags_are_fields() {
        assert_eq!(named("--height: \"1800\" needs a unit"), "“Height”: \"1800\" needs a unit");
        assert_eq!(named("invalid value 'x' for '--storeys <N>': no"), "invalid value 'x' for “Storeys”: no");
        assert_eq!(named("--wall-gap and --on"), "“Gap to the wall behind it” and “Pads under one edge”");
        assert_eq!(named("a--b, 3 -- 4, sheet--old.csv"), "a--b, 3 -- 4, sheet--old.csv");
    }

    #[test]
    fn a_hint_sends_nobody_to_a_command_line() {
        let told = "freestand place list shows all places; for another hazard give --pga, or a study";
        assert_eq!(hint(told), "for another hazard give “Peak ground acceleration”, or a study");
        assert_eq!(hint("usage: freestand object; see --help"), "correct this entry");
        assert_eq!(hint("write \"1800 mm\""), "write \"1800 mm\"");
    }
}
