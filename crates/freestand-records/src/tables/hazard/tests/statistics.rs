//! Means, quantiles and realizations: tests.

use super::*;

/// A quantile is read as it is, and says so; the mean needs no word.
#[test]
fn the_statistic_of_a_file_is_known() {
    let curves = "lon,lat,poe-0.1,poe-0.2\n-123.23738,49.27479,0.2,0.1\n";
    let of = |kind: &str| {
        let head = HEAD.replace("rlz-001", kind);
        assert!(kind == "rlz-001" || head != HEAD);
        let head = head.replace("investigation_time", "imt='PGA', investigation_time");
        anywhere(&format!("{head}{curves}"))
    };
    for (kind, meant, name) in [
        (
            "quantile-0.95",
            Statistic::Quantile(0.95),
            "the 95 % quantile",
        ),
        (
            "quantile-0.999999",
            Statistic::Quantile(0.999_999),
            "the 99.9999 % quantile",
        ),
        ("rlz-001", Statistic::Realization, "one realization"),
        ("max", Statistic::Other("max".to_owned()), "\"max\""),
        (
            "quantile-95",
            Statistic::Other("quantile-95".to_owned()),
            "\"quantile-95\"",
        ),
    ] {
        let site = of(kind).unwrap();
        let found = site.other_than_mean().unwrap();
        assert_eq!(
            (found, found.name_with_article()),
            (&meant, name.to_owned())
        );
    }
    for mean in ["mean", "Mean"] {
        assert_eq!(of(mean).unwrap().other_than_mean(), None);
    }
    assert!(
        of("std")
            .unwrap_err()
            .message
            .contains("standard deviations")
    );
    let quantile = NRML.replace("statistics=\"mean\"", "statistics=\"quantile\"");
    let site = read(&quantile, &at(44.43, 26.1)).unwrap();
    assert_eq!(site.other_than_mean(), Some(&Statistic::Quantile(0.5)));
}

/// OpenQuake writes a realization with the branches of its logic trees and without `statistics`: it is not the mean.
#[test]
fn a_realization_of_nrml_is_not_the_mean() {
    let field = |attributes: &str, imt: &str| {
        format!(
            "<hazardCurves {attributes} IMT=\"{imt}\" investigationTime=\"50.0\"><IMLs>0.1 0.5</IMLs><hazardCurve>\
             <gml:Point><gml:pos>26.0 44.4</gml:pos></gml:Point><poEs>0.5 0.1</poEs></hazardCurve></hazardCurves>"
        )
    };
    let document = |fields: &[String]| {
        format!(
            "<?xml version=\"1.0\"?><nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\" \
             xmlns:gml=\"http://www.opengis.net/gml\">{}</nrml>",
            fields.concat()
        )
    };
    let of = |attributes: &str| anywhere(&document(&[field(attributes, "PGA")])).unwrap();
    for branches in [
        "sourceModelTreePath=\"b1\" gsimTreePath=\"b2\"",
        "sourceModelTreePath=\"b1\"",
        "gsimTreePath=\"b2\"",
    ] {
        assert_eq!(
            of(branches).other_than_mean(),
            Some(&Statistic::Realization),
            "{branches}"
        );
    }
    assert_eq!(
        of("statistics=\"mean\" sourceModelTreePath=\"\"").other_than_mean(),
        None
    );
    assert_eq!(of("").other_than_mean(), None);
    // Statistics of one site differ in either order.
    let quantile = "statistics=\"quantile\" quantileValue=\"0.95\"";
    for [one, two] in [
        ["", quantile],
        [quantile, ""],
        ["gsimTreePath=\"b2\"", ""],
        ["gsimTreePath=\"b2\"", "gsimTreePath=\"b3\""],
    ] {
        let fields = [field(one, "PGA"), field(two, "PGV")];
        let problem = anywhere(&document(&fields)).unwrap_err();
        assert!(
            problem.message.contains("several statistics"),
            "{one}, then {two}: {problem}"
        );
    }
    let two_measures = [field(quantile, "PGA"), field(quantile, "PGV")];
    assert_eq!(anywhere(&document(&two_measures)).unwrap().curves.len(), 2);
}
