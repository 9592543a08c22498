//! The folders of other programs: their files, and what there is to know besides.

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, name_of, some};
use freestand_output::json::document;
use freestand_risk::export::{ExportDoubt, ExportFormat, Exported, FORMATS, Metadata};

use super::doubts::{cost_doubt, hazard_doubt};

/// The files of a folder for another program.
#[derive(Debug)]
pub struct ExportFiles {
    /// Their contents, by their paths in the output folder.
    pub files: Vec<(String, Vec<u8>)>,
    /// What to know beside them.
    pub warnings: Vec<String>,
}

/// A folder with what there is to know of it.
///
/// # Errors
/// None in practice: metadata that are no JSON.
pub fn export_files(exported: Exported) -> Result<ExportFiles, Problem> {
    let Exported {
        mut files,
        metadata,
        doubts,
    } = exported;
    let warnings: Vec<String> = doubts.iter().map(doubt).collect();
    if let Some(Metadata { path, schema, body }) = metadata {
        files.push((path, document(schema, &body, &warnings)?.into_bytes()));
    }
    Ok(ExportFiles { files, warnings })
}

pub(super) fn doubt(doubt: &ExportDoubt) -> String {
    match doubt {
        ExportDoubt::Cost(doubt) => cost_doubt(doubt),
        ExportDoubt::Hazard(doubt) => hazard_doubt(doubt),
        ExportDoubt::NotInInventory(id) => {
            format!("{id}: not in the inventory, so one object without costs is exported")
        }
        ExportDoubt::NoneOfIt(id) => format!("{id}: its quantity is 0, so it is not exported"),
        ExportDoubt::ChangedIds {
            format,
            count,
            id,
            exported,
            allowed,
            longest,
        } => {
            let folder = name_of(FORMATS, *format);
            let program = match format {
                ExportFormat::OpenQuake => "OpenQuake",
                ExportFormat::Pelicun | ExportFormat::Csv => folder,
            };
            let verb = if *count == 1 { "was" } else { "were" };
            let others: Vec<String> = allowed.chars().map(String::from).collect();
            let longest = longest.map_or(String::new(), |most| {
                format!(", and at most {most} characters")
            });
            format!(
                "{} {verb} changed for {program}, such as \"{}\" to \"{exported}\": it accepts only letters from a \
                 to z, digits, {}{longest}; {folder}/ids.csv lists both",
                counted(*count, "id"),
                shorten(id),
                others.join(" and ")
            )
        }
        ExportDoubt::InDollars(currency) => format!(
            "pelicun writes every cost as USD, but these costs are in {currency}, as in the inventory"
        ),
        ExportDoubt::NoReplacement(ids) => {
            let ids: Vec<String> = ids.iter().map(|id| shorten(id)).collect();
            format!(
                "{}: no replacement_cost in the inventory, so exposure.csv has the value 0 and OpenQuake counts no \
                 loss",
                some(&ids, 1)
            )
        }
    }
}
