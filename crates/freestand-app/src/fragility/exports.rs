//! Folders of fragilities for other programs.

use std::path::PathBuf;

use freestand_assess::export::{ExportFormat, ExportRequest, FORMATS, check_export};
use freestand_assess::fragility::HazardSource;
use freestand_assess::inventory::CellsRequest;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;

use crate::request::from_one;

/// The folders that are asked for, without the quantities and costs of objects.
pub(super) fn judged(
    read: &mut WordReader<'_>,
    hazard: Option<&HazardSource>,
    site_deg: Option<(f64, f64)>,
) -> Vec<ExportRequest> {
    let formats = read.choices("format", FORMATS);
    let demand = read.one("demand").map(str::to_owned);
    let realizations = from_one(read, "realizations");
    let beta = read.positive("beta", Dimension::Ratio);
    let is_discrete = read.flag("discrete");
    // A wrong name has been told, and may be that of a program.
    if !formats.is_empty() || !read.has("format") {
        refuse_idle(read, &formats);
    }
    let request = |format: ExportFormat| ExportRequest {
        format,
        list: CellsRequest::default(),
        demand: demand.clone(),
        realizations: realizations.map(|many| u32::try_from(many).unwrap_or(u32::MAX)),
        beta,
        is_discrete,
        site_deg,
        inventory: None,
        hazard: hazard
            .cloned()
            .filter(|_| format == ExportFormat::OpenQuake),
    };
    formats.into_iter().map(request).collect()
}

/// What no program reads.
fn refuse_idle(read: &mut WordReader<'_>, formats: &[ExportFormat]) {
    let has = |format| formats.contains(&format);
    let has_program = has(ExportFormat::Pelicun) || has(ExportFormat::OpenQuake);
    let takes_demand = has(ExportFormat::Pelicun) && read.has("demand");
    let takes_site = has(ExportFormat::OpenQuake) || read.has("hazard");
    let of_program = "it is for a `format` other than csv";
    let idle = [
        ("demand", has_program, of_program),
        ("beta", has_program, of_program),
        ("discrete", has_program, of_program),
        (
            "realizations",
            takes_demand,
            "it is for `format = \"pelicun\"` with `demand`",
        ),
        (
            "site_coordinates",
            takes_site,
            "it is for a file of `hazard` and for `format = \"openquake\"`",
        ),
    ];
    for (key, is_read, why) in idle {
        if read.has(key) && !is_read {
            read.note(
                &[key],
                format!("`{key}` has no effect: {why}"),
                "leave it out",
            );
        }
    }
}

/// The same with the quantities and costs of an inventory, checked as far as it can be without fits.
pub(super) fn with_costs(
    exports: Vec<ExportRequest>,
    inventory: Option<PathBuf>,
    cells: &CellsRequest,
) -> Result<Vec<ExportRequest>, Problems> {
    let exports = exports.into_iter().map(|one| ExportRequest {
        inventory: inventory.clone(),
        list: cells.clone(),
        ..one
    });
    let exports: Vec<ExportRequest> = exports.collect();
    exports.iter().try_for_each(check_export)?;
    Ok(exports)
}
