//! Design values of the web services of USGS.

use freestand_input::problem::Problem;
use serde_json::Value as Json;

use super::numbers::{Value, spectrum};
use super::sites::{Chosen, Site, Wanted, chosen};
use super::usgs::{document, numbers, request, site_of};
use super::{CodeValues, HazardFormat, ReturnSpectrum, SiteHazard};

/// `response.data.{ss, s1}`, which was `data.data` before; of ASCE 7-22 also
/// `multiPeriodDesignSpectrum.{periods, ordinates}`, the spectrum on the site.
pub(super) fn read(bytes: &[u8], wanted: &Wanted) -> Result<SiteHazard, Problem> {
    let document = document(bytes)?;
    let paths: [&[&str]; 5] = [
        &["response", "data"],
        &["data", "data"],
        &["output", "data"],
        &["data"],
        &[],
    ];
    let at_path = |path: &[&str]| path.iter().try_fold(&document, |one, key| one.get(key));
    let is_it =
        |one: &&Json| one.get("ss").is_some() || one.get("multiPeriodDesignSpectrum").is_some();
    let Some(data) = paths.into_iter().filter_map(at_path).find(is_it) else {
        let message = "the document has no `response.data` with `ss` and `s1`";
        return Err(Problem::format(message, "download the file again"));
    };
    let positive = |name: &'static str| {
        let number = data.get(name).and_then(Json::as_f64);
        number
            .filter(|number| *number > 0.0 && number.is_finite())
            .ok_or_else(|| {
                let shown = data
                    .get(name)
                    .map_or_else(|| "missing".to_owned(), Json::to_string);
                let message = format!("data.{name} is {shown}, not an acceleration above 0");
                Problem::value(
                    message,
                    "download the file again; the service gives null outside its maps",
                )
            })
    };
    let site = site_of(&[request(&document), data, &document])?;
    let sites = [Site {
        line: None,
        name: None,
        at: site,
    }];
    let Chosen { distance_km, .. } = chosen(&sites, wanted)?;
    let mut out = SiteHazard {
        at: site,
        distance_km,
        ..SiteHazard::of(HazardFormat::UsgsDesign)
    };
    match data
        .get("multiPeriodDesignSpectrum")
        .filter(|one| one.is_object())
    {
        Some(one) => out.spectra.push(multi_period(one)?),
        None => {
            out.code = Some(CodeValues::Asce7 {
                ss_g: positive("ss")?,
                s1_g: positive("s1")?,
                long_period_s: long_period_s(data)?,
                site_class: site_class(&document),
            });
        }
    }
    Ok(out)
}

/// `tl`, which is null outside the map of the transition.
fn long_period_s(data: &Json) -> Result<Option<f64>, Problem> {
    match data.get("tl") {
        None | Some(Json::Null) => Ok(None),
        Some(value) => {
            let found = value
                .as_f64()
                .filter(|seconds| *seconds > 0.0 && seconds.is_finite());
            let message = || format!("data.tl is {value}, not a period above 0");
            found
                .map(Some)
                .ok_or_else(|| Problem::value(message(), "download the file again"))
        }
    }
}

/// `D-default` and `B-estimated` are D and B.
fn site_class(document: &Json) -> Option<String> {
    let class = request(document).get("siteClass")?.as_str()?;
    let letter = class.split(['-', ' ']).next()?;
    (!letter.is_empty()).then(|| letter.to_owned())
}

fn multi_period(of: &Json) -> Result<ReturnSpectrum, Problem> {
    const PLACE: &str = "multiPeriodDesignSpectrum";
    let periods = numbers(of.get("periods"), &format!("{PLACE}.periods"))?;
    let ordinates = numbers(of.get("ordinates"), &format!("{PLACE}.ordinates"))?;
    if periods.len() != ordinates.len() {
        let (periods, ordinates) = (periods.len(), ordinates.len());
        let message = format!("{PLACE} has {periods} periods and {ordinates} ordinates");
        return Err(Problem::format(message, "download the file again"));
    }
    let values = periods
        .into_iter()
        .zip(ordinates)
        .map(|(period, value): (Value, Value)| (period.number, value));
    spectrum(None, values)
}
