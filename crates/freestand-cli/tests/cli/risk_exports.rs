//! Fragilities for other programs.

use super::risk::{example, json, write};
use crate::program::{execute, refused};
use serde_json::Value;
use std::fs;

#[test]
fn exports_are_refused_where_they_would_mislead() {
    let folder = tempfile::tempdir().unwrap();
    let outcomes = example("outcomes.csv");
    let base = [
        "fragility",
        "--outcomes",
        &outcomes,
        "--bootstrap",
        "0",
        "--out",
        "o",
    ];
    let with = |args: &[&'static str]| -> Vec<&str> { [&base[..], args].concat() };
    assert!(
        refused(
            folder.path(),
            &with(&["--fit", "separate", "--format", "pelicun"])
        )
        .contains("separate fits may cross")
    );
    assert!(refused(folder.path(), &with(&["--format", "openquake"])).contains("needs --demand"));
    assert!(
        refused(
            folder.path(),
            &with(&["--format", "pelicun", "--demand", "0.4 g"])
        )
        .contains("--demand"),
        "another unit"
    );
    let floor = "object,motion,pfv [m/s],outcome\na,m,0.1,rocked\na,m,0.2,overturned\na,m,0.3,rocked\na,m,0.4,overturned\n";
    write(folder.path(), "floor.csv", floor);
    let args = [
        "fragility",
        "--outcomes",
        "floor.csv",
        "--format",
        "openquake",
        "--out",
        "o",
        "--demand",
        "0.4 m/s",
    ];
    let of_floor = refused(
        folder.path(),
        &[&args[..], &["--site-coordinates", "1,2"]].concat(),
    );
    assert!(
        of_floor.contains("OpenQuake has no measure pfv of the floor"),
        "{of_floor}"
    );
    assert!(
        !folder.path().join("o").exists(),
        "nothing is written where anything is refused"
    );
    let step = "object,motion,pgv [m/s],outcome\na-1,m,0.1,no-uplift\na-1,m,0.4,overturned\n";
    write(folder.path(), "step.csv", step);
    let args = [
        "fragility",
        "--outcomes",
        "step.csv",
        "--format",
        "pelicun",
        "--out",
        "o",
        "--demand",
        "0.4 m/s",
    ];
    assert!(refused(folder.path(), &args).contains("overturns is a step"));
    assert!(
        execute(
            folder.path(),
            &[&args[..], &["--beta", "0.3", "--realizations", "5"]].concat()
        )
        .status
        .success()
    );
    let written = fs::read_to_string(folder.path().join("o/pelicun/fragility.csv")).unwrap();
    assert_eq!(
        written.lines().nth(1).unwrap(),
        "FS.a_1,0,Peak Ground Velocity,mps,0,1,lognormal,0.2,0.3,,,,,"
    );
}

/// A folder for pelicun has quantities and floors as blocks and locations, costs where there are any, and ids without
/// hyphens.
#[test]
fn a_folder_for_pelicun_has_what_the_inventory_says() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        "floors.csv",
        "object,motion,pfv [m/s],outcome\na-1,m,0.1,rocked\na-1,n,0.2,exceeded\na-1,m,0.25,rocked\na-1,n,0.3,overturned\n\
         a-1,m,0.35,exceeded\na-1,n,0.4,overturned\nb,m,0.1,rocked\nb,m,0.2,overturned\nb,m,0.3,rocked\nb,m,0.4,overturned\n",
    );
    write(
        folder.path(),
        "costs.csv",
        "id,quantity,floor,repair_cost [AUD],replacement_cost [AUD],downtime [day]\na-1,3,2,100,900,4\nb,,,,50,\n",
    );
    let base = [
        "fragility",
        "--outcomes",
        "floors.csv",
        "--bootstrap",
        "0",
        "--out",
        "o",
        "--format",
        "pelicun",
    ];
    let with = |args: &[&'static str]| execute(folder.path(), &[&base[..], args].concat());
    let output = with(&[
        "--inventory",
        "costs.csv",
        "--demand",
        "0.3 m/s",
        "--realizations",
        "3",
    ]);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && told.contains("pelicun writes every cost as USD"),
        "{told}"
    );
    let read = |name: &str| fs::read_to_string(folder.path().join("o/pelicun").join(name)).unwrap();
    assert_eq!(
        read("CMP_QNT.csv"),
        "ID,Units,Location,Direction,Theta_0,Blocks,Comment\nFS.a_1,ea,3,1,3,3,a-1\nFS.b,ea,1,1,1,1,b\n"
    );
    // A component takes the demand of the floor below its location.
    assert_eq!(
        read("demand.csv"),
        ",1-PFV-0-1,1-PFV-2-1\nUnits,mps,mps\n0,0.3,0.3\n1,0.3,0.3\n2,0.3,0.3\n"
    );
    assert_eq!(
        read("consequence_repair.csv"),
        "ID,Incomplete,Quantity-Unit,DV-Unit,DS1-Family,DS1-Theta_0,DS1-Theta_1,DS2-Family,DS2-Theta_0,DS2-Theta_1\n\
         FS.a_1-Cost,0,1 EA,USD,,100,,,900,\nFS.a_1-Time,0,1 EA,worker_day,,0,,,4,\nFS.b-Cost,0,1 EA,USD,,50,,,,\n"
    );
    let config: Value = serde_json::from_str(&read("config.json")).unwrap();
    assert_eq!(config["DL"]["Asset"]["NumberOfStories"], 3);
    assert_eq!(
        config["DL"]["Losses"]["Repair"]["ConsequenceDatabasePath"],
        "consequence_repair.csv"
    );
    assert!(
        read("fragility.csv")
            .lines()
            .skip(1)
            .all(|line| line.contains(",Peak Floor Velocity,mps,0,1,lognormal,"))
    );

    assert!(
        with(&["--demand", "0.3 m/s", "--realizations", "3"])
            .status
            .success()
    );
    let config: Value = serde_json::from_str(&read("config.json")).unwrap();
    assert!(
        config["DL"]["Losses"].is_null() && config["DL"]["Outputs"]["Loss"].is_null(),
        "no costs, no losses"
    );

    write(folder.path(), "costs.csv", "id,quantity\na-1,2.5\n");
    let halves = [&base[..], &["--inventory", "costs.csv"]].concat();
    assert!(refused(folder.path(), &halves).contains("not 2.5"));
}

/// A folder for OpenQuake has numbers, values and coordinates of the inventory, PGV in cm/s, and a hazard with at least
/// 300 levels.
#[test]
fn a_folder_for_openquake_has_what_the_inventory_says() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        "costs.csv",
        "id,quantity,replacement_cost [AUD],longitude,latitude\ncabinet,4,9000,151.2,-33.9\nserver-rack,2,60000,,\n",
    );
    let (outcomes, hazard) = (example("outcomes.csv"), example("hazard.csv"));
    let base = [
        "fragility",
        "--outcomes",
        &outcomes,
        "--bootstrap",
        "0",
        "--out",
        "o",
        "--format",
        "openquake",
    ];
    let with = |args: &[&str]| -> Vec<String> {
        [&base[..], args]
            .concat()
            .iter()
            .map(|arg| (*arg).to_owned())
            .collect()
    };
    let call = |args: Vec<String>| {
        execute(
            folder.path(),
            &args.iter().map(String::as_str).collect::<Vec<_>>(),
        )
    };
    let given = [
        "--inventory",
        "costs.csv",
        "--demand",
        "0.4 m/s",
        "--hazard",
        &hazard,
    ];
    let without_site = call(with(&given));
    let told = String::from_utf8(without_site.stderr).unwrap();
    assert!(
        without_site.status.code() == Some(2) && told.contains("object server-rack has none"),
        "{told}"
    );
    assert!(
        call(with(
            &[&given[..], &["--site-coordinates", "150.5,-33.5"]].concat()
        ))
        .status
        .success()
    );
    let read =
        |name: &str| fs::read_to_string(folder.path().join("o/openquake").join(name)).unwrap();
    assert_eq!(
        read("exposure.csv"),
        "id,lon,lat,taxonomy,number,contents\ncabinet,151.2,-33.9,cabinet,4,36000\n\
         server-rack,150.5,-33.5,server-rack,2,120000\n"
    );
    assert!(read("exposure.xml").contains("unit=\"AUD\""));
    assert_eq!(
        read("gmf.csv"),
        "rlzi,sid,eid,gmv_PGV\n0,0,0,40\n0,1,0,40\n"
    );
    assert!(read("job_scenario_damage.ini").contains("sites = 151.2 -33.9, 150.5 -33.5\n"));
    let job = read("job_classical_damage.ini");
    assert!(
        job.contains("calculation_mode = classical_damage")
            && job.contains("risk_investigation_time = 50"),
        "{job}"
    );
    let written = read("hazard.csv");
    let header = written.lines().nth(1).unwrap();
    assert!(
        header.split(',').count() > 303 && written.lines().count() == 4,
        "{header}"
    );
    // freestand reads what it writes: the rates are those of the first file.
    let copy = folder.path().join("o/openquake/hazard.csv");
    let rates = |hazard: &str| {
        let args = [
            "risk",
            "--fragility",
            "o/fragility.csv",
            "--hazard",
            hazard,
            "--site-coordinates",
            "151.2,-33.9",
        ];
        json(folder.path(), &args)["objects"][0]["limit_states"][2]["annual_rate"]
            .as_f64()
            .unwrap()
    };
    let (own, other) = (rates(&hazard), rates(&copy.to_string_lossy()));
    // The tail beyond the last point is at 1.000001 times it.
    assert!((own / other - 1.0).abs() < 1e-5, "{own} {other}");
    write(
        folder.path(),
        "pga.csv",
        "pga [g],annual_rate\n0.1,0.1\n1,0.001\n",
    );
    let wrong = call(with(&["--site-coordinates", "1,2", "--hazard", "pga.csv"]));
    let told = String::from_utf8(wrong.stderr).unwrap();
    assert!(
        wrong.status.code() == Some(2)
            && told.contains("pga of the ground, and the outcomes are for pgv"),
        "{told}"
    );
}

/// Points in place of curves: the shares of runs, also where no lognormal curve can be exported.
#[test]
fn shares_are_exported_as_points() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        "o.csv",
        "object,motion,pga [g],outcome\na,m,0.1,rocked\na,n,0.1,rocked\na,m,0.2,rocked\na,n,0.2,overturned\n\
         a,m,0.4,overturned\na,n,0.4,overturned\n",
    );
    let args = [
        "fragility",
        "--outcomes",
        "o.csv",
        "--bootstrap",
        "0",
        "--discrete",
        "--out",
        "out",
        "--demand",
        "0.3 g",
    ];
    let formats = [
        "--format",
        "pelicun",
        "--format",
        "openquake",
        "--site-coordinates",
        "1,2",
        "--realizations",
        "2",
    ];
    assert!(
        execute(folder.path(), &[&args[..], &formats].concat())
            .status
            .success()
    );
    let pelicun = fs::read_to_string(folder.path().join("out/pelicun/fragility.csv")).unwrap();
    assert!(
        pelicun.ends_with("\nFS.a,0,Peak Ground Acceleration,g,0,1,multilinear_CDF,\"0.1,0.2,0.4|0,0.5,1\",,,,,,\n"),
        "{pelicun}"
    );
    let openquake = fs::read_to_string(folder.path().join("out/openquake/fragility.xml")).unwrap();
    assert!(
        openquake.contains("<imls imt=\"PGA\">1e-7 0.1 0.2 0.4</imls>"),
        "{openquake}"
    );
    assert!(
        openquake.contains("<poes ls=\"overturns\">0 0 0.5 1</poes>"),
        "{openquake}"
    );
}

/// Ids that OpenQuake or pelicun would refuse are changed; a table lists both ids, and a warning
/// names it.
#[test]
fn ids_are_mapped_for_other_programs() {
    let folder = tempfile::tempdir().unwrap();
    let long = "x".repeat(60);
    let rows: String = ["2 racks/Ä", &long, "plain"]
        .iter()
        .flat_map(|id| {
            [
                (0.1, "rocked"),
                (0.2, "overturned"),
                (0.3, "rocked"),
                (0.4, "overturned"),
            ]
            .map(|(x, outcome)| format!("{id},m{x},{x},{outcome}\n"))
        })
        .collect();
    write(
        folder.path(),
        "o.csv",
        &format!("object,motion,pgv [m/s],outcome\n{rows}"),
    );
    let formats = [
        "--format",
        "pelicun",
        "--format",
        "openquake",
        "--site-coordinates",
        "1,2",
        "--demand",
        "0.3 m/s",
    ];
    let base = [
        "fragility",
        "--outcomes",
        "o.csv",
        "--bootstrap",
        "0",
        "--out",
        "out",
    ];
    let output = execute(folder.path(), &[&base[..], &formats].concat());
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && told.contains("2 ids were changed for OpenQuake, such as"),
        "{told}"
    );
    assert!(told.contains("openquake/ids.csv lists both"), "{told}");
    let read = |name: &str| fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    let cut = "x".repeat(50);
    assert_eq!(
        read("openquake/ids.csv"),
        format!("id,exported_id\n2 racks/Ä,2_racks__\n{long},{cut}\nplain,plain\n")
    );
    assert!(read("pelicun/ids.csv").contains("2 racks/Ä,FS.2_racks__\n"));
    assert!(read("openquake/exposure.csv").contains(&format!("\n{cut},1,2,{cut},1,1\n")));
}
