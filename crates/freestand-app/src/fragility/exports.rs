//! Folders of fragilities for other programs.

use std::path::PathBuf;

use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_inventory::CellsRequest;
use freestand_risk::export::{
    ExportFormat, ExportRequest, FORMATS, check_export, check_realizations,
};
use freestand_risk::fragility::HazardSource;

/// The folders that are asked for, without the quantities and costs of objects.
pub(super) struct Exports {
    pub(super) requests: Vec<ExportRequest>,
    /// Whether all names of formats are known, so that it is known what nobody reads.
    are_known: bool,
}

impl Exports {
    /// Whether no program is named that takes a hazard.
    pub(super) fn lack_hazard(&self) -> bool {
        self.are_known && !self.take_hazard()
    }

    /// Whether a program is named that takes the coordinates of objects.
    pub(super) fn take_site(&self) -> bool {
        self.take_hazard()
    }

    /// Whether a program is named that takes a hazard.
    pub(super) fn take_hazard(&self) -> bool {
        let mut requests = self.requests.iter();
        requests.any(|one| one.format == ExportFormat::OpenQuake)
    }
}

/// What is asked for.
pub(super) fn judged(
    read: &mut WordReader<'_>,
    hazard: Option<&HazardSource>,
    site_deg: Option<(f64, f64)>,
) -> Exports {
    let formats = read.choices("format", FORMATS);
    let named = read.words.all("format").flat_map(|text| text.split(','));
    let are_known = named.count() == formats.len();
    let demand = read.one("demand").map(str::to_owned);
    let realizations = read.whole_within("realizations", 1..);
    read.problems.keep(check_realizations(realizations));
    let beta = read.positive("beta", Dimension::Ratio);
    let is_discrete = read.flag("discrete");
    if are_known {
        refuse_idle(read, &formats);
    }
    let request = |format: ExportFormat| ExportRequest {
        format,
        list: CellsRequest::default(),
        demand: demand.clone(),
        realizations,
        beta,
        is_discrete,
        site_deg,
        inventory: None,
        hazard: hazard
            .cloned()
            .filter(|_| format == ExportFormat::OpenQuake),
    };
    Exports {
        requests: formats.into_iter().map(request).collect(),
        are_known,
    }
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
        if !is_read {
            read.idle(&[key], why);
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
