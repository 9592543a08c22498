//! `worklist.csv`: what has to be done, floor by floor and room by room.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};

use freestand_assess::result::{Assessment, Decision, RestraintForce};
use freestand_input::problem::Problem;
use freestand_input::words::number;
use freestand_inventory::Item;
use freestand_output::folder::OutputFolder;
use freestand_output::paths::io_problem;
use freestand_output::rows::{broken, csv_writer};

use super::csv::push_field;
use super::floors::{FloorKey, floor_key, floor_words};
use super::hold::how_to_hold;
use super::reasons::why;
use super::table::{Cell, Line};
use freestand_assess::reason::{Missing, Reason};

/// The file's name.
pub const WORKLIST_NAME: &str = "worklist.csv";

/// The columns. `done` is empty: whoever does the work fills it in.
const HEADER: &str = "floor,room,id,item,quantity,action,how,force_n,anchor_tension_n,why,done\n";

/// What has to be done about an object.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Task {
    /// 1 is the most urgent.
    pub rank: usize,
    /// Its floor, in a form that sorts.
    pub floor: FloorKey,
    /// 0 ground, 1 roof.
    pub level_ratio: Option<f64>,
    /// Its room.
    pub room: String,
    /// Identifier of the object.
    pub id: String,
    /// What it is.
    pub item: String,
    /// How many such objects there are.
    pub quantity: u32,
    /// What to do.
    pub action: Decision,
    /// How to do it, in a sentence.
    pub how: String,
    /// Force of a restraint \[N\].
    pub force_n: Option<f64>,
    /// Tension of all anchors along one edge together \[N\].
    pub anchor_tension_n: Option<f64>,
    /// Why, in one or two sentences.
    pub why: String,
}

/// The task of a row; `None` where nothing has to be done, or where it was not assessed.
pub(super) fn task(line: &Line) -> Option<Task> {
    let (rank, found) = line.found?;
    if found.decision == Decision::Leave {
        return None;
    }
    let (item, force) = (line.item, found.design_force());
    Some(Task {
        rank,
        floor: floor_key(item),
        level_ratio: item.level_ratio.filter(|level| level.is_finite()),
        room: item.room.clone(),
        id: item.id.clone(),
        item: item.item.clone(),
        quantity: item.quantity,
        action: found.decision,
        how: how(item, found, force),
        force_n: force.map(|force| force.force_n),
        anchor_tension_n: force.map(|force| force.anchor_tension_n),
        why: format!("{}{}", why(item, found), doubted(item)),
    })
}

fn how(item: &Item, found: &Assessment, force: Option<&RestraintForce>) -> String {
    match (found.decision, force) {
        (Decision::Leave, _) => String::new(),
        (Decision::Lock, _) => give_room(found, "Lock it, tether it, or"),
        (Decision::Restrain, _) if found.rolled.is_some() => {
            give_room(found, "Tether it or restrain it, or")
        }
        (Decision::Restrain, Some(force)) => how_to_hold(item, force),
        (Decision::Restrain, None) => {
            "Find out its mass: the force of the restraint depends on it.".to_owned()
        }
        (Decision::Soften, _) => {
            let stiffness = found
                .softening
                .as_ref()
                .and_then(|softening| softening.max_stiffness_n_m);
            stiffness.map_or_else(
                || "Put it on a softer pad.".to_owned(),
                |stiffness_n_m| {
                    format!(
                        "Put pads of at most {} N/mm in total under each edge.",
                        number(1e-3 * stiffness_n_m, 3)
                    )
                },
            )
        }
        (Decision::NoVerdict, _) => find_out(item, found),
    }
}

/// What to do about an object that rolls or slides farther than it has room.
fn give_room(found: &Assessment, or_else: &str) -> String {
    let needed_m = found.rolled.map_or(0.0, |rolled| rolled.clearance_needed_m);
    format!(
        "{or_else} give it at least {} mm of room on every side.",
        number((1e3 * needed_m).ceil(), 6)
    )
}

/// What is doubtful about the row of an object, after the reason of its verdict.
fn doubted(item: &Item) -> String {
    let kinds: Vec<&str> = item.doubts.iter().map(|doubt| doubt.name()).collect();
    if kinds.is_empty() {
        String::new()
    } else {
        format!(" Check the input: {}.", kinds.join(", "))
    }
}

/// What to find out about an object without a verdict.
fn find_out(item: &Item, found: &Assessment) -> String {
    if item.anchored == Some(true) {
        return "Check its anchors.".to_owned();
    }
    if !item.to_confirm.is_empty() {
        return format!(
            "Confirm or correct its size or mass: read {}.",
            item.to_confirm.join(", ")
        );
    }
    let remedy = found.why.iter().find_map(|reason| match reason {
        Reason::NotGiven(missing) | Reason::ShockUnknown(missing) => {
            Some(format!("Find out {}.", Missing::listed(missing)))
        }
        Reason::NoMotion => Some("Add a motion for its floor to the study.".to_owned()),
        Reason::Unchecked => Some("Confirm its tolerance.".to_owned()),
        Reason::Stopped { .. } => Some("Continue the run with --resume.".to_owned()),
        Reason::Unstated(unstated) => Some(format!(
            "State {}: give {}.",
            unstated.words(),
            unstated.keys()
        )),
        _ => None,
    });
    remedy.unwrap_or_else(|| "Complete its row of the list.".to_owned())
}

/// The place of a task in the file, and of its line in the temporary file.
struct Entry {
    floor: u32,
    room: u32,
    rank: u32,
    start: u64,
    bytes: u32,
}

/// The table as it is written. Its lines wait in a temporary file, because they are sorted and a
/// million of them do not fit into memory.
pub(super) struct Worklist {
    lines: BufWriter<File>,
    written: u64,
    entries: Vec<Entry>,
    floors: HashMap<FloorKey, (u32, Option<f64>)>,
    rooms: HashMap<String, u32>,
}

impl Worklist {
    /// Without a task yet.
    pub(super) fn begin(folder: &OutputFolder) -> Result<Self, Problem> {
        let path = folder.path_of(WORKLIST_NAME)?;
        let beside = path.parent().unwrap_or(&path);
        let file = tempfile::tempfile_in(beside).map_err(|error| unwritten(&error))?;
        Ok(Self {
            lines: BufWriter::new(file),
            written: 0,
            entries: Vec::new(),
            floors: HashMap::new(),
            rooms: HashMap::new(),
        })
    }

    /// Adds a task.
    pub(super) fn add(&mut self, task: &Task) -> Result<(), Problem> {
        let line = line(task)?;
        self.lines
            .write_all(&line)
            .map_err(|error| unwritten(&error))?;
        let next = self.floors.len() as u32;
        let (floor, _) = *self
            .floors
            .entry(task.floor.clone())
            .or_insert((next, task.level_ratio));
        let next = self.rooms.len() as u32;
        let room = match self.rooms.get(&task.room) {
            Some(room) => *room,
            None => *self.rooms.entry(task.room.clone()).or_insert(next),
        };
        let bytes = u32::try_from(line.len()).unwrap_or(u32::MAX);
        self.entries.push(Entry {
            floor,
            room,
            rank: task.rank as u32,
            start: self.written,
            bytes,
        });
        self.written += u64::from(bytes);
        Ok(())
    }

    /// Writes the file: from the top floor down, room by room, the most urgent first.
    pub(super) fn finish(self, folder: &OutputFolder) -> Result<(), Problem> {
        let Self {
            lines,
            mut entries,
            floors,
            rooms,
            ..
        } = self;
        let mut lines = lines
            .into_inner()
            .map_err(|error| unwritten(error.error()))?;
        let mut named: Vec<(&FloorKey, u32, Option<f64>)> = floors
            .iter()
            .map(|(key, (number, level))| (key, *number, *level))
            .collect();
        sort_floors(&mut named, |(key, _, level)| (*level, *key));
        let buildings: std::collections::HashSet<&str> =
            floors.keys().map(|key| key.building.as_str()).collect();
        let mut floor_order = vec![(0u32, String::new()); named.len()];
        for (place, (key, number, _)) in (0u32..).zip(&named) {
            if let Some(slot) = floor_order.get_mut(*number as usize) {
                *slot = (place, floor_words(key, buildings.len() > 1));
            }
        }
        let mut sorted: Vec<(&String, u32)> =
            rooms.iter().map(|(room, number)| (room, *number)).collect();
        sorted.sort_unstable();
        let mut room_order = vec![0u32; sorted.len()];
        for (place, (_, number)) in (0u32..).zip(&sorted) {
            if let Some(slot) = room_order.get_mut(*number as usize) {
                *slot = place;
            }
        }
        let place = |entry: &Entry| {
            let floor = floor_order
                .get(entry.floor as usize)
                .map_or(0, |(place, _)| *place);
            (
                floor,
                room_order.get(entry.room as usize).copied().unwrap_or(0),
                entry.rank,
            )
        };
        entries.sort_unstable_by_key(place);
        let mut file = folder.begin(WORKLIST_NAME)?;
        let mut pending = HEADER.as_bytes().to_vec();
        for entry in &entries {
            let name = floor_order
                .get(entry.floor as usize)
                .map_or("", |(_, name)| name.as_str());
            pending.extend(field(name)?);
            lines
                .seek(SeekFrom::Start(entry.start))
                .map_err(|error| unwritten(&error))?;
            let from = pending.len();
            pending.resize(from + entry.bytes as usize, 0);
            if let Some(place) = pending.get_mut(from..) {
                lines.read_exact(place).map_err(|error| unwritten(&error))?;
            }
            if pending.len() > 1 << 20 {
                file.write(&pending)?;
                pending.clear();
            }
        }
        file.write(&pending)?;
        file.finish()
    }
}

/// Sorts floors from the top down, those without a level last, and then by their names.
pub(super) fn sort_floors<T>(floors: &mut [T], of: impl Fn(&T) -> (Option<f64>, &FloorKey)) {
    floors.sort_by(|a, b| {
        let ((level, key), (other_level, other_key)) = (of(a), of(b));
        let height = |level: Option<f64>| level.unwrap_or(f64::NEG_INFINITY);
        height(other_level)
            .total_cmp(&height(level))
            .then_with(|| key.cmp(other_key))
    });
}

/// A field and its comma.
fn field(text: &str) -> Result<Vec<u8>, Problem> {
    let mut written = row([Cell::text(text)])?;
    // The end of the line.
    written.pop();
    written.push(b',');
    Ok(written)
}

/// A number for people: four digits. `objects.csv` has all of them.
fn to_read(value: f64) -> f64 {
    number(value, 4).parse().unwrap_or(value)
}

/// The line of a task, without its floor: how that is called is known at the end.
fn line(task: &Task) -> Result<Vec<u8>, Problem> {
    row([
        Cell::text(&task.room),
        Cell::text(&task.id),
        Cell::text(&task.item),
        Cell::Count(task.quantity.into()),
        Cell::text(task.action.name()),
        Cell::text(&task.how),
        Cell::number(task.force_n.map(to_read)),
        Cell::number(task.anchor_tension_n.map(to_read)),
        Cell::text(&task.why),
        Cell::Missing,
    ])
}

fn row<const N: usize>(cells: [Cell; N]) -> Result<Vec<u8>, Problem> {
    let mut writer = csv_writer();
    let mut text = String::new();
    for cell in &cells {
        text.clear();
        push_field(&mut text, cell);
        writer.write_field(&text).map_err(broken)?;
    }
    writer.write_record(None::<&[u8]>).map_err(broken)?;
    writer
        .into_inner()
        .map_err(|error| broken(csv::Error::from(error.into_error())))
}

fn unwritten(error: &std::io::Error) -> Problem {
    io_problem(
        std::path::Path::new(WORKLIST_NAME),
        "cannot be written",
        error,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assessment::fixture::{
        HOSTILE, TABLES, hostile_items, inventory, item, read, written,
    };

    fn worklist(items: Vec<Item>) -> Vec<Vec<String>> {
        let count = items.len();
        let (folder, names) = written(&inventory(items), count, TABLES);
        assert!(names.iter().any(|name| name == WORKLIST_NAME));
        let bytes = read(&folder, WORKLIST_NAME);
        let mut reader = csv::Reader::from_reader(&bytes[..]);
        assert_eq!(
            reader
                .headers()
                .unwrap()
                .iter()
                .collect::<Vec<_>>()
                .join(",")
                + "\n",
            HEADER
        );
        reader
            .records()
            .map(|row| row.unwrap().iter().map(str::to_owned).collect())
            .collect()
    }

    /// Of 24 items six may be left; the fixture ranks backwards, on five floors.
    #[test]
    fn the_work_is_sorted_by_floor_and_room() {
        let mut items: Vec<Item> = (0..24).map(item).collect();
        for one in &mut items {
            one.room = ["10", "2", "1"][one.row as usize % 3].to_owned();
        }
        let rows = worklist(items);
        assert_eq!(rows.len(), 18);
        let mut places: Vec<(i32, &str, i32)> = Vec::new();
        for row in &rows {
            let floor: i32 = row[0].strip_prefix("Level ").unwrap().parse().unwrap();
            let number: i32 = row[2].strip_prefix("O-").unwrap().parse().unwrap();
            places.push((-floor, &row[1], -number));
        }
        assert!(places.is_sorted(), "{places:?}");
        for row in &rows {
            assert!(
                ["restrain", "soften", "no-verdict"].contains(&row[5].as_str())
                    && row[10].is_empty()
            );
            assert_eq!(row[5] == "restrain", !row[7].is_empty(), "{row:?}");
        }
        let restrain = rows.iter().find(|row| row[5] == "restrain").unwrap();
        assert_eq!((restrain[7].as_str(), restrain[8].as_str()), ("410", "950"));
        assert!(
            restrain[6].contains("bracket at a height of 1350 mm"),
            "{restrain:?}"
        );
        let soften = rows.iter().find(|row| row[5] == "soften").unwrap();
        assert!(soften[6].contains("1100 N/mm"), "{soften:?}");
        let unknown = rows.iter().find(|row| row[5] == "no-verdict").unwrap();
        assert_eq!(unknown[6], "Find out its tolerance.");
    }

    /// The weight alone would hold it against the force of the code: the anchors are those of the
    /// computed floor. Where its weight holds it against that too, the list says so.
    #[test]
    fn what_falls_is_not_held_by_its_weight() {
        let item = item(0);
        let mut found = crate::assessment::fixture::assessment(&item, 0);
        found.restraint[0].anchor_tension_n = 0.0;
        found.restraint[1].source.kind = freestand_assess::restraint::source::SourceKind::Floor;
        let made = |found: &Assessment| {
            task(&Line {
                item: &item,
                found: Some((1, found)),
            })
            .unwrap()
        };
        let of_floor = made(&found);
        assert_eq!(
            (of_floor.force_n, of_floor.anchor_tension_n),
            (Some(530.0), Some(720.0))
        );
        assert!(
            of_floor.how.starts_with("Anchor it along both edges"),
            "{}",
            of_floor.how
        );
        found.restraint[1].anchor_tension_n = 0.0;
        let of_code = made(&found);
        assert_eq!(
            (of_code.force_n, of_code.anchor_tension_n),
            (Some(410.0), Some(0.0))
        );
        assert!(
            of_code
                .how
                .starts_with("No tension: its weight holds it down."),
            "{}",
            of_code.how
        );
    }

    #[test]
    fn floors_of_two_buildings_are_told_apart() {
        // The second is to be left.
        let mut items: Vec<Item> = (0..3).map(item).collect();
        items
            .iter_mut()
            .for_each(|item| item.floor = "1".to_owned());
        items[2].building = "Annex".to_owned();
        let floors: Vec<String> = worklist(items)
            .into_iter()
            .map(|row| row[0].clone())
            .collect();
        assert_eq!(floors.len(), 2);
        assert!(
            floors.contains(&"Main, 1".to_owned()) && floors.contains(&"Annex, 1".to_owned()),
            "{floors:?}"
        );
    }

    #[test]
    fn no_text_becomes_a_formula() {
        for field in worklist(hostile_items()).iter().flatten() {
            assert!(!field.starts_with(['=', '+', '-', '@']), "{field}");
        }
        assert!(HOSTILE.iter().any(|text| text.starts_with('=')));
    }
}
