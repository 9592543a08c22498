//! Changes the text of a study, so that it can be run again from the folder of its outputs.

use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, TableLike, Value, value};

use freestand_input::keys::Words;
use freestand_input::problem::{Problem, ProblemKind};

/// The text with this seed of the synthetic motions; everything else is kept, comments too.
///
/// # Errors
/// A text that is not TOML, or a seed that TOML cannot hold.
///
/// # Example
/// ```
/// use freestand_study::rerun::with_seed;
/// let text = with_seed("[ground]\nseed = 1 # drawn by lot\n", 7)?;
/// assert_eq!(text, "[ground]\nseed = 7 # drawn by lot\n");
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn with_seed(toml: &str, seed: u64) -> Result<String, Problem> {
    let mut study = parse(toml)?;
    let seed = i64::try_from(seed).map_err(|_| broken(format!("{seed} is too large for TOML")))?;
    let ground = table(&mut study, "ground")?;
    match ground.get_mut("seed").and_then(Item::as_value_mut) {
        Some(old) if old.as_integer() == Some(seed) => {}
        Some(old) => replace(old, seed),
        None => {
            ground.insert("seed", value(seed));
        }
    }
    Ok(study.to_string())
}

/// The text with these keys of `[ground]` in place of `removed`.
///
/// # Errors
/// A text that is not TOML, or in which `ground` is not a table.
pub(crate) fn with_hazard(toml: &str, removed: &[&str], words: &Words) -> Result<String, Problem> {
    let mut study = parse(toml)?;
    let ground = table(&mut study, "ground")?;
    let is = |name: &str, key: &str| {
        name.strip_prefix(key)
            .is_some_and(|unit| unit.is_empty() || unit.starts_with('_'))
    };
    let old: Vec<String> = ground.iter().map(|(name, _)| name.to_owned()).collect();
    // A key may end in its unit. `spectrum` also begins `spectrum_type`; both are removed together.
    for name in old
        .iter()
        .filter(|name| removed.iter().any(|key| is(name, key)))
    {
        ground.remove(name);
    }
    insert_words(ground, words, "return_period_years");
    Ok(study.to_string())
}

/// The text with this number of storeys in `[building]`, and with this height of each; without a name where
/// it is that of another building.
///
/// # Errors
/// A text that is not TOML, or in which `building` is not a table.
pub(crate) fn with_storeys(
    toml: &str,
    storeys: u16,
    height: Option<&str>,
    is_renamed: bool,
) -> Result<String, Problem> {
    let mut study = parse(toml)?;
    let building = table(&mut study, "building")?;
    if is_renamed {
        building.remove("name");
    }
    building.insert("storeys", value(i64::from(storeys)));
    if let Some(height) = height {
        building.insert("storey_height", value(height));
    }
    Ok(study.to_string())
}

/// The text with this code of the building's period.
///
/// # Errors
/// A text that is not TOML, or in which `building` is not a table.
pub fn with_period_code(toml: &str, code: &str) -> Result<String, Problem> {
    let mut study = parse(toml)?;
    let building = table(&mut study, "building")?;
    building.insert("period_code", value(code));
    Ok(study.to_string())
}

/// The text with `[ground]` replaced by motions from files, which are in m/s² and scaled; with the
/// files of their vertical components, if there are any; with a step between the directions \[degrees\] if each file has two components.
///
/// # Errors
/// A text that is not TOML.
pub fn with_motions(
    toml: &str,
    files: &[String],
    verticals: Option<&[String]>,
    rotation_step_deg: Option<f64>,
) -> Result<String, Problem> {
    let mut study = parse(toml)?;
    let mut ground = Table::new();
    ground.insert("motions", value(one_a_line(files)));
    if let Some(mut key) = ground.key_mut("motions") {
        key.leaf_decor_mut()
            .set_prefix("# As the run used them: component chosen, scaled, in m/s2.\n");
    }
    if let Some(files) = verticals {
        ground.insert("vertical", value(one_a_line(files)));
    }
    two_components(&mut ground, rotation_step_deg);
    replace_ground(&mut study, ground);
    Ok(study.to_string())
}

/// The motions of one level.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelFiles {
    /// Its name.
    pub name: String,
    /// Its height as a share of the building's, if it is known.
    pub level_ratio: Option<f64>,
    /// Its files.
    pub motions: Vec<String>,
}

/// The text with the motions of floors from files, which are in m/s² and scaled, as in
/// [`with_motions`].
///
/// # Errors
/// A text that is not TOML, or without `[building]`.
pub fn with_floor_motions(
    toml: &str,
    levels: &[LevelFiles],
    rotation_step_deg: Option<f64>,
) -> Result<String, Problem> {
    let mut study = parse(toml)?;
    let mut ground = Table::new();
    two_components(&mut ground, rotation_step_deg);
    replace_ground(&mut study, ground);
    let mut entries = Array::new();
    for level in levels {
        let mut entry = InlineTable::new();
        entry.insert("name", level.name.as_str().into());
        if let Some(ratio) = level.level_ratio {
            entry.insert("level_ratio", ratio.into());
        }
        entry.insert("motions", level.motions.iter().collect::<Array>().into());
        entries.push(entry);
    }
    broken_lines(&mut entries);
    let building = own_table(&mut study, "building")?;
    building.insert("levels", value(entries));
    Ok(study.to_string())
}

fn two_components(ground: &mut Table, rotation_step_deg: Option<f64>) {
    if let Some(step_deg) = rotation_step_deg {
        ground.insert("components", value("both"));
        ground.insert("rotation_step", value(format!("{step_deg} deg")));
    }
}

fn one_a_line(files: &[String]) -> Array {
    let mut list: Array = files.iter().collect();
    broken_lines(&mut list);
    list
}

fn broken_lines(list: &mut Array) {
    for entry in list.iter_mut() {
        entry.decor_mut().set_prefix("\n    ");
    }
    list.set_trailing("\n");
    list.set_trailing_comma(true);
}

/// Replaces the table ground.
fn replace_ground(study: &mut DocumentMut, mut ground: Table) {
    if let Some(old) = study.get("ground").and_then(Item::as_table) {
        *ground.decor_mut() = old.decor().clone();
        ground.set_position(old.position());
    }
    study.insert("ground", Item::Table(ground));
}

/// The text with the words of a cushion file instead of its name, so that the file is not needed.
///
/// # Errors
/// A text that is not TOML, or without `[objects]`.
pub fn with_cushion(toml: &str, words: &Words) -> Result<String, Problem> {
    let mut study = parse(toml)?;
    let objects = own_table(&mut study, "objects")?;
    objects.remove("cushion");
    insert_words(objects, words, "pads_per_edge");
    Ok(study.to_string())
}

/// A table of a building in another file.
#[derive(Debug, Clone, Copy)]
pub struct MovedTable<'a> {
    /// Whether it is of the second axis.
    pub is_across: bool,
    /// The key that names it.
    pub key: &'a str,
    /// The file.
    pub file: &'a str,
}

/// The text with the building's tables in other files.
///
/// # Errors
/// A text that is not TOML, or without the keys.
pub fn with_building_tables<'a>(
    toml: &str,
    tables: impl IntoIterator<Item = MovedTable<'a>>,
) -> Result<String, Problem> {
    let mut study = parse(toml)?;
    for MovedTable {
        is_across,
        key,
        file,
    } in tables
    {
        let mut axis = study.get_mut("building");
        if is_across {
            axis = axis.and_then(|building| building.get_mut("across"));
        }
        let Some(old) = axis
            .and_then(|axis| axis.get_mut(key))
            .and_then(Item::as_value_mut)
        else {
            return Err(broken(format!("it has no {key}")));
        };
        replace(old, file);
    }
    Ok(study.to_string())
}

/// The text with the spectrum of synthetic motions from this file.
///
/// # Errors
/// A text that is not TOML, or without `[ground]`.
pub fn with_spectrum(toml: &str, file: &str, is_held: bool) -> Result<String, Problem> {
    let mut study = parse(toml)?;
    let ground = own_table(&mut study, "ground")?;
    ground.insert("spectrum", value(file));
    // What chose the spectrum of a hazard file has no part in its table.
    for key in [
        "place",
        "city",
        "latitude",
        "longitude",
        "return_period_years",
    ] {
        ground.remove(key);
    }
    if is_held {
        ground.insert("beyond", value("hold"));
    }
    Ok(study.to_string())
}

/// A table of the study, which is added if it has none.
fn table<'s>(study: &'s mut DocumentMut, name: &str) -> Result<&'s mut dyn TableLike, Problem> {
    study.entry(name).or_insert_with(toml_edit::table);
    own_table(study, name)
}

/// A table that the study has.
fn own_table<'s>(study: &'s mut DocumentMut, name: &str) -> Result<&'s mut dyn TableLike, Problem> {
    let own = study.get_mut(name).and_then(Item::as_table_like_mut);
    own.ok_or_else(|| broken(format!("{name} is not a table")))
}

/// Puts another value in place of one, and keeps the comments about it.
fn replace(old: &mut Value, new: impl Into<Value>) {
    let decor = old.decor().clone();
    *old = new.into();
    *old.decor_mut() = decor;
}

/// Writes keys as text, and one of them as a whole number where it is one.
fn insert_words(table: &mut dyn TableLike, words: &Words, whole: &str) {
    for (key, text) in words.entries() {
        match text.parse::<i64>() {
            Ok(number) if key == whole => table.insert(key, value(number)),
            _ => table.insert(key, value(text)),
        };
    }
}

fn parse(toml: &str) -> Result<DocumentMut, Problem> {
    toml.parse()
        .map_err(|error: toml_edit::TomlError| broken(error.message()))
}

fn broken(why: impl std::fmt::Display) -> Problem {
    Problem::new(
        ProblemKind::Format,
        format!("the study cannot be written: {why}"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resolve::builtin_toml;

    /// Several layers in series come as one list.
    #[test]
    fn a_cushion_file_is_written_out() {
        let words = Words::from_iter([
            ("pad_stiffness", "2190 N/mm"),
            ("pads_per_edge", "2"),
            ("series_stiffness", "4380 N/mm, 9000 N/mm"),
        ]);
        let text = with_cushion(
            "[objects]\ncushion = \"pad.toml\" # ours\nmass = \"1 kg\"\n",
            &words,
        )
        .unwrap();
        let expected = "[objects]\nmass = \"1 kg\"\npad_stiffness = \"2190 N/mm\"\npads_per_edge = \
                        2\nseries_stiffness = \"4380 N/mm, 9000 N/mm\"\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn tables_of_buildings_get_their_new_places() {
        let study = "[building]\nstorey_table = \"/x/a.csv\" # ours\nacross = { mode_table = \"b.csv\", damping = 0.02 }\n";
        let tables = [
            (false, "storey_table", "building/along.csv"),
            (true, "mode_table", "c.csv"),
        ]
        .map(|(is_across, key, file)| MovedTable {
            is_across,
            key,
            file,
        });
        let expected = study
            .replace("/x/a.csv", "building/along.csv")
            .replace("b.csv", "c.csv");
        assert_eq!(with_building_tables(study, tables).unwrap(), expected);
        let study = "[building.across]\nmode_table = \"b.csv\"\n";
        assert_eq!(
            with_building_tables(study, [tables[1]]).unwrap(),
            study.replace("b.csv", "c.csv")
        );
        assert!(with_building_tables(study, tables).is_err());
    }

    #[test]
    fn only_the_ground_changes() {
        assert_eq!(with_seed(builtin_toml(), 1).unwrap(), builtin_toml());
        assert_eq!(
            with_seed(builtin_toml(), 7).unwrap(),
            builtin_toml().replacen("\nseed = 1\n", "\nseed = 7\n", 1)
        );
        assert_eq!(with_seed("", 7).unwrap(), "[ground]\nseed = 7\n");
        assert!(with_seed("", u64::MAX).is_err());
        let ground = "[ground]\n# As the run used them: component chosen, scaled, in m/s2.\nmotions = [\n    \
                      \"motions/a.csv\",\n]\n";
        let study = "# mine\n[ground]\nmotions = [\"/x/a\"]\nscale = 2.0\n# hers\n[objects]\nmass = \"1 kg\" # 1\n";
        let text = with_motions(study, &["motions/a.csv".to_owned()], None, None).unwrap();
        assert_eq!(
            text,
            format!("# mine\n{ground}# hers\n[objects]\nmass = \"1 kg\" # 1\n")
        );
        // Other spellings of a table, and none.
        for study in [
            "",
            "ground = { seed = 3 }\nobjects.mass_kg = 1\n",
            "ground.seed = 3\nobjects.mass_kg = 1\n",
            "[objects]\n",
        ] {
            let text = with_motions(study, &["motions/a.csv".to_owned()], None, None).unwrap();
            let (options, problems) = crate::options::parse(&text, None, None);
            assert!(problems.is_empty(), "{text}: {problems}");
            assert!(
                options
                    .ground
                    .motions
                    .is_some_and(|files| files.value.len() == 1)
                    && options.ground.seed.is_none()
            );
            assert_eq!(
                options.objects.mass_kg.is_some(),
                study.contains("mass"),
                "{text}"
            );
        }
    }
}
