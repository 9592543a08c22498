//! `freestand restrain`.

use crate::{cases, folder, freestand, freestand_in};

const RACK: [&str; 7] = ["restrain", "--mass", "360kg", "--height", "1.8m", "--thickness", "0.6m"];

#[test]
fn restrain_by_place_code_study_and_acceleration() {
    let study = "[ground]\nplace = \"Newcastle\"\n[building]\nstoreys = 8\n[restraint]\nresponse_ratio = 2.5\n";
    let folder = folder(&[("study.toml", study)]);
    let with = |more: &[&str]| freestand_in(folder.path(), &[&RACK[..], more].concat());
    let all = [
        with(&["--place", "Athens", "--floor", "2", "--storeys", "5", "--width", "3 ft"]),
        with(&["--code", "asce7", "--sds", "1 g", "--resonance", "1.8", "--building-ductility", "1.5", "--json"]),
        with(&["--study", "study.toml", "--floor", "roof", "--anchors-per-edge", "3"]),
        with(&["--floor-acceleration", "0.9 g", "--out", "out"]),
    ];
    cases::each("restrain_by_place_code_study_and_acceleration", &all);
    let sheet = std::fs::read_to_string(folder.path().join("out/restraint.html")).unwrap();
    assert!(sheet.contains("<svg") && sheet.contains("Date and signature"), "{sheet}");
}

#[test]
fn restrain_refuses_what_it_cannot_know() {
    let with = |more: &[&str]| freestand(&[&RACK[..], more].concat());
    let all = [
        with(&[]),
        with(&["--place", "Wellinton"]),
        with(&["--sds", "1 g"]),
        with(&["--code", "asce7", "--place", "Wellington"]),
        with(&["--code", "nzs1170.5"]),
        with(&["--place", "Melbourne", "--importance", "0"]),
        with(&["--place", "Melbourne", "--strength", "2", "--floor", "3"]),
        with(&["--floor-acceleration", "1 g", "--place", "Melbourne"]),
        with(&["--study", "study.toml", "--sds", "1 g"]),
    ];
    cases::each("restrain_refuses_what_it_cannot_know", &all);
}
