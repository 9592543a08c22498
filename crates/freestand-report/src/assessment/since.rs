//! What has changed since an earlier assessment: which objects are new, gone, done, or worse.

use std::collections::{BTreeMap, VecDeque};
use std::fs::File;
use std::path::{Path, PathBuf};

use freestand_assess::portfolio::Row;
use freestand_assess::reason::Reason;
use freestand_assess::result::Decision;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::{counted, percent_significant};
use freestand_output::answer;
use freestand_output::answer::table_of;
use freestand_output::folder::{MANIFEST, OutputFolder};
use freestand_output::html::{list, table, words};
use freestand_output::paths::io_problem;
use maud::{Markup, html};
use serde_json::Value;
use strum::IntoStaticStr;

use super::csv::CSV_NAME;
use crate::table::table as text_table;

/// The file of the changes.
pub const CHANGES_NAME: &str = "changes.csv";

/// Rows of a table of changes on the console and in the report; all of them are in the file.
const MOST_ROWS: usize = 20;

/// How an object has changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Changed {
    /// Its verdict is more urgent.
    Worse,
    /// It was not in the list.
    New,
    /// Something had to be done, and now it is left as it is, or is anchored.
    Done,
    /// Its verdict is less urgent, but not *leave*.
    Better,
    /// It had a verdict and has none.
    Unknown,
    /// It is not in the list any more.
    Gone,
}

impl Changed {
    const ALL: [Self; 6] = [
        Self::Worse,
        Self::New,
        Self::Done,
        Self::Better,
        Self::Unknown,
        Self::Gone,
    ];

    /// How one verdict followed on another; `None`: they are the same. What is anchored now has no verdict: where
    /// something had to be done, it is done.
    fn between(before: Decision, now: Decision, is_anchored: bool) -> Option<Self> {
        match (before, now) {
            (Decision::NoVerdict | Decision::Leave, _) if is_anchored => None,
            _ if is_anchored => Some(Self::Done),
            _ if before == now => None,
            (_, Decision::NoVerdict) => Some(Self::Unknown),
            // Where nothing was known, nothing was better.
            (Decision::NoVerdict, Decision::Leave) => Some(Self::Better),
            (Decision::NoVerdict, _) => Some(Self::Worse),
            (_, Decision::Leave) => Some(Self::Done),
            // The most urgent verdict is the first.
            _ if now < before => Some(Self::Worse),
            _ => Some(Self::Better),
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Worse => "Worse",
            Self::New => "New",
            Self::Done => "Done",
            Self::Better => "Better",
            Self::Unknown => "No verdict any more",
            Self::Gone => "Gone",
        }
    }
}

answer! {
    /// An object that is not as it was.
    pub struct Change named {
        change: &'static str,
        id: String,
        item: String,
        /// The verdict of the earlier assessment.
        decision_before: Option<&'static str>,
        decision: Option<&'static str>,
        /// Whether the list says that it is anchored.
        anchored: bool,
        /// Upper end of the interval of the probability that it falls, in the earlier assessment.
        p_overturn_high_before: Option<f64>,
        p_overturn_high: Option<f64>,
    }
}

answer! {
    /// What has changed since an earlier assessment.
    pub struct Since named {
        /// Folder of the earlier assessment.
        folder: String,
        /// Version of the program that made it.
        version: String,
        /// Whether the study, its records or its seeds were others, so that verdicts may differ for this reason.
        other_study: bool,
        /// Objects with the same verdict.
        unchanged: usize,
        /// Objects that are not as they were, the worst changes first.
        changes: Vec<Change>,
    }
}

/// An object of the earlier assessment.
struct Was {
    item: String,
    decision: Decision,
    p_overturn_high: Option<f64>,
}

/// An earlier assessment.
pub struct Earlier {
    folder: PathBuf,
    version: String,
    inputs: Value,
    /// By id; where several objects have one id, in the order of the list.
    objects: BTreeMap<String, VecDeque<Was>>,
}

/// What is needed of the parts of `inputs` of a manifest for the same verdicts.
const OF_STUDY: [&str; 4] = ["study", "records", "motion_seed", "draw_seed"];

/// The beginning of the id of a row that has none.
const NO_ID: &str = "row-";

impl Earlier {
    /// Reads the folder of an assessment.
    ///
    /// # Errors
    /// A folder without a complete assessment, or whose `objects.csv` cannot be read.
    pub fn read(folder: &Path) -> Result<Self, Problem> {
        let path = folder.join(MANIFEST);
        let no_assessment = |message: &str| {
            Problem::new(ProblemKind::Format, message)
                .in_file(&path)
                .hint("name the folder that an earlier `freestand assess` wrote")
        };
        let bytes =
            std::fs::read(&path).map_err(|error| io_problem(&path, "cannot be read", &error))?;
        let manifest: Value =
            serde_json::from_slice(&bytes).map_err(|_| no_assessment("is no JSON document"))?;
        if manifest["schema"] != "freestand.assess/1" {
            return Err(no_assessment("is not that of an assessment"));
        }
        if manifest["complete"] != true {
            let message = "is that of an assessment that was stopped before its end";
            return Err(no_assessment(message).hint("continue it first with `resume`"));
        }
        Ok(Self {
            folder: folder.to_owned(),
            version: manifest["version"].as_str().unwrap_or_default().to_owned(),
            inputs: manifest["inputs"].clone(),
            objects: objects(&folder.join(CSV_NAME))?,
        })
    }

    /// What has changed since then. `inputs` are those of the present assessment, as in its manifest.
    ///
    /// # Errors
    /// The first problem of `rows`.
    pub fn since<'a>(
        mut self,
        inputs: &Value,
        rows: impl Iterator<Item = Result<Row<'a>, Problem>>,
    ) -> Result<Since, Problem> {
        let mut changes = Vec::new();
        let mut unchanged = 0;
        for row in rows {
            let Row { item, found, .. } = row?;
            let was = self.objects.get_mut(&item.id).and_then(|same| {
                // A row without an id may have moved.
                let is_it = |was: &Was| !item.id.starts_with(NO_ID) || was.item == item.item;
                let at = same.iter().position(is_it)?;
                same.remove(at)
            });
            let anchored = found.why.contains(&Reason::Anchored);
            let change = match &was {
                None => Some(Changed::New),
                Some(was) => Changed::between(was.decision, found.decision, anchored),
            };
            let Some(change) = change else {
                unchanged += 1;
                continue;
            };
            changes.push((
                change,
                Change {
                    change: change.into(),
                    id: item.id.clone(),
                    item: item.item.clone(),
                    decision_before: was.as_ref().map(|was| was.decision.name()),
                    decision: Some(found.decision.name()),
                    anchored,
                    p_overturn_high_before: was.and_then(|was| was.p_overturn_high),
                    p_overturn_high: found.p_overturn.map(|p| p.high),
                },
            ));
        }
        let left = self.objects.into_iter();
        let left = left.flat_map(|(id, same)| same.into_iter().map(move |was| (id.clone(), was)));
        changes.extend(left.map(|(id, was)| {
            let gone = Change {
                change: Changed::Gone.into(),
                id,
                item: was.item,
                decision_before: Some(was.decision.name()),
                decision: None,
                anchored: false,
                p_overturn_high_before: was.p_overturn_high,
                p_overturn_high: None,
            };
            (Changed::Gone, gone)
        }));
        // The order of the list within each kind.
        changes.sort_by_key(|(change, _)| *change);
        Ok(Since {
            folder: self.folder.display().to_string(),
            version: self.version,
            other_study: OF_STUDY.iter().any(|key| self.inputs[key] != inputs[key]),
            unchanged,
            changes: changes.into_iter().map(|(_, change)| change).collect(),
        })
    }
}

/// The objects of an `objects.csv`.
fn objects(path: &Path) -> Result<BTreeMap<String, VecDeque<Was>>, Problem> {
    let wrong = |message: String| {
        Problem::new(ProblemKind::Format, message)
            .in_file(path)
            .hint("assess the earlier list again into that folder")
    };
    let file = File::open(path).map_err(|error| io_problem(path, "cannot be read", &error))?;
    let mut reader = csv::Reader::from_reader(std::io::BufReader::new(file));
    let header = reader
        .headers()
        .map_err(|error| wrong(error.to_string()))?
        .clone();
    let column = |name: &str| {
        let at = header.iter().position(|one| one == name);
        at.ok_or_else(|| wrong(format!("has no column {name}")))
    };
    let [id, item, decision, high] = [
        column("id")?,
        column("item")?,
        column("decision")?,
        column("p_overturn_high")?,
    ];
    let mut objects: BTreeMap<String, VecDeque<Was>> = BTreeMap::new();
    for (i, record) in reader.into_records().enumerate() {
        let record = record.map_err(|error| wrong(error.to_string()))?;
        let cell = |at: usize| freestand_input::formula::unguarded(record.get(at).unwrap_or(""));
        let name = record.get(decision).unwrap_or_default();
        let decided = Decision::ALL.into_iter().find(|one| one.name() == name);
        let decision =
            decided.ok_or_else(|| wrong(format!("has no verdict {name:?}")).at_line(i + 2))?;
        let was = Was {
            item: cell(item).to_owned(),
            decision,
            p_overturn_high: cell(high).parse().ok(),
        };
        objects
            .entry(cell(id).to_owned())
            .or_default()
            .push_back(was);
    }
    Ok(objects)
}

/// Writes `changes.csv`.
///
/// # Errors
/// A full disk.
pub(super) fn write(folder: &OutputFolder, since: &Since) -> Result<(), Problem> {
    folder.write(CHANGES_NAME, table_of(&since.changes)?.as_ref())
}

/// The counts, and what the comparison depends on.
fn sentences(since: &Since) -> Vec<String> {
    let mut counts: Vec<String> = Changed::ALL
        .into_iter()
        .map(|one| (one, of(since, one).count()))
        .filter(|(_, count)| *count > 0)
        .map(|(one, count)| format!("{} {count}", one.title().to_lowercase()))
        .collect();
    counts.push(format!("unchanged {}", since.unchanged));
    let mut said = vec![format!(
        "Compared with {}: {}.",
        since.folder,
        counts.join(", ")
    )];
    let done = of(since, Changed::Done);
    let (anchored, only_lists) = done.fold((0, 0), |(a, o), change| match change.anchored {
        true => (a + 1, o),
        false => (a, o + 1),
    });
    if anchored > 0 {
        said.push(format!(
            "Done by anchors: {}, as the list says; nobody has calculated whether the anchors hold.",
            counted(anchored, "object")
        ));
    }
    if only_lists > 0 {
        said.push(format!(
            "{} counted as done without an anchor: other values of the list or of the study changed the verdict.",
            counted(only_lists, "object")
        ));
    }
    if since.other_study {
        said.push(
            "The study, its records or its seeds have changed: verdicts may differ for this reason alone."
                .to_owned(),
        );
    }
    if since.version != env!("CARGO_PKG_VERSION") {
        said.push(format!(
            "The earlier assessment was made by version {}: verdicts may differ for this reason alone.",
            since.version
        ));
    }
    said
}

fn of(since: &Since, changed: Changed) -> impl Iterator<Item = &Change> {
    let name: &str = changed.into();
    since
        .changes
        .iter()
        .filter(move |change| change.change == name)
}

const HEADINGS: [&str; 6] = ["change", "id", "item", "before", "now", "falls, at most"];

fn cells(change: &Change) -> [String; 6] {
    let word = |name: Option<&str>| name.unwrap_or("–").to_owned();
    let share = |p: Option<f64>| p.map_or_else(|| "–".to_owned(), |p| percent_significant(p, 2));
    let now = match change.anchored {
        true => "anchored".to_owned(),
        false => word(change.decision),
    };
    let high = [change.p_overturn_high_before, change.p_overturn_high];
    [
        change.change.to_owned(),
        change.id.clone(),
        change.item.clone(),
        word(change.decision_before),
        now,
        high.map(share).join(" → "),
    ]
}

/// The changes on the console.
pub(super) fn since_text(since: &Since) -> String {
    let mut text = sentences(since).join("\n") + "\n";
    let shown = since.changes.iter().take(MOST_ROWS);
    let rows: Vec<Vec<String>> = shown.map(|change| cells(change).to_vec()).collect();
    if !rows.is_empty() {
        text.push_str(&format!("\n{}", text_table(&HEADINGS, &rows)));
    }
    if since.changes.len() > MOST_ROWS {
        let more = since.changes.len() - MOST_ROWS;
        text.push_str(&format!("{more} more in {CHANGES_NAME}\n"));
    }
    text
}

/// The changes in the report.
pub(super) fn since_html(since: &Since) -> Markup {
    let headings = HEADINGS.map(words);
    html! {
        (list(sentences(since)))
        @for changed in Changed::ALL {
            @let all = of(since, changed).count();
            @if all > 0 {
                @let rows = of(since, changed).take(MOST_ROWS).map(|change| cells(change).map(words));
                (table(changed.title(), &headings, rows))
            }
            @if all > MOST_ROWS { p { (all - MOST_ROWS) " more in " (CHANGES_NAME) "." } }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Changed;
    use freestand_assess::result::Decision;

    /// Every pair of verdicts has one meaning, and only equal ones have none.
    #[test]
    fn one_verdict_follows_on_another() {
        use Decision::{Leave, Lock, NoVerdict, Restrain, Soften};
        let expected = [
            (Leave, Restrain, Some(Changed::Worse)),
            (Lock, Soften, Some(Changed::Worse)),
            (NoVerdict, Lock, Some(Changed::Worse)),
            (Restrain, Leave, Some(Changed::Done)),
            (Lock, Leave, Some(Changed::Done)),
            (NoVerdict, Leave, Some(Changed::Better)),
            (Restrain, Lock, Some(Changed::Better)),
            (Restrain, NoVerdict, Some(Changed::Unknown)),
            (Leave, NoVerdict, Some(Changed::Unknown)),
            (Soften, Soften, None),
        ];
        for (before, now, change) in expected {
            assert_eq!(
                Changed::between(before, now, false),
                change,
                "{before:?} to {now:?}"
            );
        }
        let anchored = [Restrain, Soften, Lock, NoVerdict, Leave]
            .map(|before| Changed::between(before, NoVerdict, true));
        let done = Some(Changed::Done);
        assert_eq!(anchored, [done, done, done, None, None]);
        for one in Decision::ALL {
            for other in Decision::ALL {
                assert_eq!(Changed::between(one, other, false).is_none(), one == other);
            }
        }
    }
}
