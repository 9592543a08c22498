//! Fragilities as a folder that the OpenQuake engine runs as it is.

use freestand::fragility::LimitState;
use freestand_input::problem::Problem;
use freestand_input::words::shortest;
use freestand_output::json::document;
use freestand_output::rows::csv;
use serde_json::json;

use super::FragilityReport;
use super::measure::{At, Measure};
use super::pelicun::{check_ordered, exported, plain_ids};

/// A folder for the OpenQuake engine.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenQuakeRequest {
    /// Intensity of the scenario, in the unit of the measure.
    pub demand: f64,
    /// Longitude and latitude of all objects \[degrees\].
    pub site_deg: (f64, f64),
    /// β for states that have none; `None`: such an object is refused.
    pub beta: Option<f64>,
}

/// The name of a measure in OpenQuake, and the factor from our unit to its.
fn imt_of(measure: Measure, at: At) -> Result<(String, f64), Problem> {
    let name = measure.name();
    let refused = || {
        let message = format!("OpenQuake has no measure {name} of the {}", at.name());
        Problem::value(message, "fit the outcomes against a measure of the ground, such as pgv, with `at = \"ground\"`")
    };
    match (measure, at) {
        (_, At::Floor) => Err(refused()),
        (Measure::Pga, At::Ground) => Ok(("PGA".to_owned(), 1.0)),
        (Measure::Sa { period_s }, At::Ground) => Ok((format!("SA({})", shortest(period_s)), 1.0)),
        (Measure::Pgv, At::Ground) => Ok(("PGV".to_owned(), 100.0)),
        _ => Err(refused()),
    }
}

/// Mean and standard deviation of a lognormal capacity: θ e^{β²/2} and mean √(e^{β²} − 1).
fn moments((median, beta): (f64, f64)) -> (f64, f64) {
    let mean = median * (0.5 * beta * beta).exp();
    (mean, mean * (beta * beta).exp_m1().sqrt())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The files of a folder for OpenQuake, by their names in it: a scenario with one ground motion
/// field.
///
/// Its limit states are common to all objects, `exceeds` and `overturns`; of an object without a
/// tolerance `exceeds` repeats `overturns`.
///
/// # Reference
/// OpenQuake engine 3.26, scenario damage; NRML 0.5.
///
/// # Errors
/// Separate fits, a state without a curve, a measure of a floor.
pub fn openquake_files(
    report: &FragilityReport,
    request: &OpenQuakeRequest,
) -> Result<Vec<(String, Vec<u8>)>, Problem> {
    check_ordered(report)?;
    let (imt, factor) = imt_of(report.table.measure, report.at)?;
    let ids = plain_ids(report.objects.iter().map(|object| object.id.as_str()), "", "_-");
    let mut functions = String::new();
    let mut assets = Vec::new();
    let mut listed = Vec::new();
    let (lon, lat) = request.site_deg;
    for (object, id) in report.objects.iter().zip(&ids) {
        let Some(overturns) = exported(object, LimitState::Overturns, request.beta)? else { continue };
        let exceeds = exported(object, LimitState::Exceeds, request.beta)?.unwrap_or(overturns);
        let params = |state: &str, curve: (f64, f64)| {
            let (mean, stddev) = moments((factor * curve.0, curve.1));
            format!("      <params ls=\"{state}\" mean=\"{mean:.16e}\" stddev=\"{stddev:.16e}\"/>\n")
        };
        // A level below minIML would be raised to it.
        functions += &format!(
            "    <fragilityFunction id=\"{id}\" format=\"continuous\" shape=\"logncdf\">\n      \
             <imls imt=\"{imt}\" minIML=\"1e-6\" maxIML=\"1e3\"/>\n{}{}    </fragilityFunction>\n",
            params("exceeds", exceeds),
            params("overturns", overturns)
        );
        assets.push(vec![id.clone(), shortest(lon), shortest(lat), id.clone(), "1".to_owned(), "1".to_owned()]);
        listed.push(json!({
            "id": object.id, "openquake_id": id, "im": report.table.measure.name(), "imt": imt,
            "factor_to_imt": factor, "fit": "ordered", "exceeds": exceeds, "overturns": overturns,
            "motions": object.outcomes.motions(),
        }));
    }
    let fragility = format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n  \
         <fragilityModel id=\"freestand\" assetCategory=\"contents\" lossCategory=\"contents\">\n    \
         <description>{}</description>\n    <limitStates>exceeds overturns</limitStates>\n{functions}  \
         </fragilityModel>\n</nrml>\n",
        escaped(&format!("fragilities of free-standing objects by freestand {}", env!("CARGO_PKG_VERSION")))
    );
    let exposure = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n  \
                    <exposureModel id=\"freestand\" category=\"contents\">\n    <description>free-standing \
                    objects</description>\n    <conversions>\n      <costTypes>\n        <costType name=\"contents\" \
                    type=\"aggregated\" unit=\"USD\"/>\n      </costTypes>\n    </conversions>\n    \
                    <assets>exposure.csv</assets>\n  </exposureModel>\n</nrml>\n";
    let level = shortest(factor * request.demand);
    let fields = csv(
        &["rlzi", "sid", "eid", &format!("gmv_{imt}")],
        std::iter::once(vec!["0".to_owned(), "0".to_owned(), "0".to_owned(), level]),
    )?;
    let job = format!(
        "[general]\ndescription = free-standing objects, one scenario\ncalculation_mode = scenario_damage\n\n\
         [geometry]\nsites = {} {}\n\n[hazard]\ngmfs_csv = gmf.csv\nnumber_of_ground_motion_fields = 1\n\n\
         [risk]\nexposure_file = exposure.xml\ncontents_fragility_file = fragility.xml\nasset_hazard_distance = 20\n",
        shortest(lon),
        shortest(lat)
    );
    let metadata = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "objects": listed,
        "units": "fragility.xml has means and standard deviations in the unit of OpenQuake (PGV in cm/s), not medians",
        "sources": [{"path": report.table.file.path.display().to_string(), "sha256": report.table.file.sha256}],
    });
    let header = ["id", "lon", "lat", "taxonomy", "number", "contents"];
    Ok(vec![
        ("fragility.xml".to_owned(), fragility.into_bytes()),
        ("exposure.xml".to_owned(), exposure.as_bytes().to_vec()),
        ("exposure.csv".to_owned(), csv(&header, assets.into_iter())?),
        ("gmf.csv".to_owned(), fields),
        ("job_scenario_damage.ini".to_owned(), job.into_bytes()),
        ("metadata.json".to_owned(), document("freestand.openquake/1", &metadata, &[])?.into_bytes()),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// mean and standard deviation of a lognormal number give back its median and β.
    #[test]
    fn moments_are_those_of_the_median() {
        let (mean, stddev) = moments((30.0, 0.25));
        let beta = (1.0 + (stddev / mean).powi(2)).ln().sqrt();
        assert!((beta - 0.25).abs() < 1e-14 && (mean * (-0.5 * beta * beta).exp() - 30.0).abs() < 1e-12);
    }

    #[test]
    fn only_measures_of_the_ground_are_exported() {
        assert_eq!(imt_of(Measure::Pgv, At::Ground), Ok(("PGV".to_owned(), 100.0)));
        assert_eq!(imt_of(Measure::Sa { period_s: 0.5 }, At::Ground).map(|imt| imt.0), Ok("SA(0.5)".to_owned()));
        for (measure, at) in [(Measure::Pfv, At::Floor), (Measure::Sa { period_s: 0.5 }, At::Floor)] {
            assert!(imt_of(measure, at).unwrap_err().hint.is_some_and(|hint| hint.contains("pgv")));
        }
    }
}
