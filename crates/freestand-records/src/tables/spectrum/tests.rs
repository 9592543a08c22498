use super::*;
use freestand::G0_M_S2;

fn read(text: &str) -> Result<Vec<SpectrumRow>, Problem> {
    parse_spectrum(text.as_bytes().to_vec())
}

/// Half a g at 0.2 s and 0.3 g at 1.5 s, as many hands write it.
#[test]
fn spectra_of_many_hands_are_one() {
    let expected = [(0.2, 0.5 * G0_M_S2), (1.5, 0.3 * G0_M_S2)];
    for (text, first_line) in [
        ("period_s,psa_g\n0.2,0.5\n1.5,0.3\n", 2),
        ("period [s]; PSA [g]\n0.2; 0.5\n1.5; 0.3\n", 2),
        ("period [s]; PSA [g]\r\n0,2; 0,5\r\n1,5; 0,3\r\n", 2),
        ("\u{feff}T (s),Sa (g)\n0.2,0.5\n1.5,0.3\n", 2),
        (
            "# UHS, 500 years\n# 5 %\nPeriod [ms]\tSa [mg]\n200\t500\n1500\t300\n",
            4,
        ),
        ("T        Sa\n[s]      [g]\n0.2      0.5\n1.5      0.3", 3),
        ("# T [s]  Sa [g]\n0.2 0.5\n1.5 0.3\n", 2),
        ("Sa [g], T [s]\n0.5, 0.2\n0.3, 1.5\n", 2),
        ("T [s], rotd50_g\n0.2, 0.5\n1.5, 0.3\n", 2),
        ("T [s];PGA [g];Sa [g]\n0.2;0.9;0.5\n1.5;0.9;0.3\n", 2),
        ("\"T, s\";\"Sa, g\"\n0,2;0,5\n1,5;0,3\n", 2),
    ] {
        let rows = read(text).unwrap_or_else(|problem| panic!("{text}: {problem:?}"));
        assert_eq!(rows.len(), 2, "{text}");
        for (row, (period_s, psa_m_s2)) in rows.iter().zip(expected) {
            // Two roundings at most, of the unit.
            assert!(
                (row.period_s - period_s).abs() < 1e-15 && (row.psa_m_s2 - psa_m_s2).abs() < 1e-14,
                "{text}: {row:?}"
            );
            assert_eq!(row.damping_ratio, None);
        }
        assert_eq!(rows.first().map(|row| row.line), Some(first_line), "{text}");
    }
}

/// What `freestand motion spectrum --out` writes: PSA is taken, not Sa; each row has its damping
/// and its line.
#[test]
fn our_own_spectra_are_read() {
    let text = "period_s,sd_m,psv_m_s,psa_g,sa_g,damping_ratio\n0.5,0.1,0.2,0.25,9,0.02\n\n0.5,0.1,0.2,0.125,9,0.05\n";
    let rows = read(text).unwrap();
    let row = |line, psa_g: f64, damping_ratio| SpectrumRow {
        line,
        period_s: 0.5,
        psa_m_s2: psa_g * G0_M_S2,
        damping_ratio: Some(damping_ratio),
    };
    assert_eq!(rows, [row(2, 0.25, 0.02), row(4, 0.125, 0.05)]);
    let percent = read("T [s];Sa [g];damping [%]\n0.5;0.25;2\n").unwrap();
    assert_eq!(
        percent.first().and_then(|row| row.damping_ratio),
        Some(0.02)
    );
}

#[test]
fn what_is_no_spectrum_is_refused_with_line_and_remedy() {
    for (text, line, says) in [
        (
            "T,Sa\n0.2,0.5\n",
            Some(1),
            "the unit of \"T\" is not stated",
        ),
        (
            "T [s],Sa\n0.2,0.5\n",
            Some(1),
            "the unit of \"Sa\" is not stated",
        ),
        (
            "T [s];PSA;PGA [g]\n0.2;0.5;0.4\n",
            Some(1),
            "the unit of \"PSA\" is not stated",
        ),
        (
            "T [s],value\n0.2,0.5\n",
            Some(1),
            "the unit of \"value\" is not stated",
        ),
        ("0.2,0.5\n1.5,0.3\n", Some(1), "there are no headings"),
        (
            "f [Hz],Sa [g]\n0.2,0.5\n",
            Some(1),
            "no column holds periods",
        ),
        (
            "T [s],Sd [m]\n0.2,0.5\n",
            Some(1),
            "no column holds an acceleration",
        ),
        (
            "T [s],PSA [cm]\n0.2,0.5\n",
            Some(1),
            "\"PSA\" is a length (cm)",
        ),
        (
            "time [s],a [g]\n0.01,0.1\n0.02,0.2\n",
            Some(1),
            "\"time\" is not a period",
        ),
        (
            "time_s,accel_m_s2\n0.01,0.1\n",
            Some(1),
            "\"time_s\" is not a period",
        ),
        (
            "T [s],t [s],Sa [g]\n0.2,0.5,1\n",
            Some(1),
            "several columns hold a time",
        ),
        (
            "period_s,rotd50_g,rotd100_g\n1,2,3\n",
            Some(1),
            "several columns hold a spectral acceleration: rotd50_g, rotd100_g",
        ),
        (
            "T [s],Sa [g]\n0.2,0.5\n1.5\n",
            Some(3),
            "the first row has 2 values, this one has 1",
        ),
        (
            "T [s];Sa [g]\n0,2;0,5\n1,5;o,3\n",
            Some(3),
            "\"o,3\" is not a number",
        ),
        (
            "T [s],Sa [g]\n0.2,0.5\n1.5,\n",
            Some(3),
            "a value is missing",
        ),
        ("T [s],Sa [g]\n", None, "no row of numbers"),
        (
            "T [s]\n0.2\n",
            Some(2),
            "is not a table of periods and accelerations",
        ),
        ("", None, "the file is empty"),
        ("\u{0}\u{1}", None, "binary"),
    ] {
        let problem = read(text).expect_err(text);
        assert!(
            problem.message.contains(says) && problem.hint.is_some(),
            "{text}: {problem:?}"
        );
        assert_eq!(problem.line, line, "{text}: {problem:?}");
    }
}

/// A device may have no end, and is not read.
#[cfg(unix)]
#[test]
fn a_file_without_end_is_refused() {
    let long = tempfile::NamedTempFile::new().unwrap();
    long.as_file().set_len((16 << 20) + 1).unwrap();
    let problem = load_spectrum(long.path()).unwrap_err();
    assert!(
        problem.message.contains("longer than 16 MiB") && problem.hint.is_some(),
        "{problem:?}"
    );
    let problem = load_spectrum("/dev/zero".as_ref()).unwrap_err();
    assert!(
        problem.message.contains("is a device") && problem.hint.is_some(),
        "{problem:?}"
    );
}
