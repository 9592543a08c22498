//! ASCE 7: the two-parameter design spectrum.

use super::{CodeSpectrumError, class_named, positive, within};

/// Edition of ASCE 7; the spectrum is the same, but the rules for parts and components differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Asce7Edition {
    /// ASCE 7-16.
    Asce7_16,
    /// ASCE 7-22, which prefers the multi-period spectrum: use a table for that.
    #[default]
    Asce7_22,
}

impl Asce7Edition {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Asce7_16 => "ASCE 7-16",
            Self::Asce7_22 => "ASCE 7-22 (two-period spectrum)",
        }
    }
}

/// Site class of ASCE 7-16, chapter 20. Class F has no coefficients and is not part of this list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
pub enum Asce7Site {
    /// Hard rock.
    A,
    /// Rock.
    B,
    /// Very dense soil and soft rock.
    C,
    /// Stiff soil.
    D,
    /// Soft clay soil.
    E,
}

impl Asce7Site {
    /// All classes, from hard to soft.
    pub const ALL: [Self; 5] = [Self::A, Self::B, Self::C, Self::D, Self::E];

    /// The class as the code writes it.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The class in words.
    pub fn description(self) -> &'static str {
        match self {
            Self::A => "hard rock",
            Self::B => "rock",
            Self::C => "very dense soil and soft rock",
            Self::D => "stiff soil",
            Self::E => "soft clay soil",
        }
    }

    /// The class with a given name, in upper or lower case.
    ///
    /// # Errors
    /// A name that is not one of the five classes.
    pub fn parse(name: &str) -> Result<Self, CodeSpectrumError> {
        class_named(&Self::ALL, name, "A, B, C, D, E")
    }

    /// Fa at the values of Ss in [`SS_G`]; of class E the table has three, and refers to 11.4.8 for
    /// the rest.
    fn short_period_ratios(self) -> &'static [f64] {
        match self {
            Self::A => &[0.8, 0.8, 0.8, 0.8, 0.8, 0.8],
            Self::B => &[0.9, 0.9, 0.9, 0.9, 0.9, 0.9],
            Self::C => &[1.3, 1.3, 1.2, 1.2, 1.2, 1.2],
            Self::D => &[1.6, 1.4, 1.2, 1.1, 1.0, 1.0],
            Self::E => &[2.4, 1.7, 1.3],
        }
    }

    /// Fv at the values of S1 in [`S1_G`].
    fn long_period_ratios(self) -> &'static [f64] {
        match self {
            Self::A | Self::B => &[0.8, 0.8, 0.8, 0.8, 0.8, 0.8],
            Self::C => &[1.5, 1.5, 1.5, 1.5, 1.5, 1.4],
            Self::D => &[2.4, 2.2, 2.0, 1.9, 1.8, 1.7],
            Self::E => &[4.2, 3.3, 2.8, 2.4, 2.2, 2.0],
        }
    }
}

/// The columns of Table 11.4-1 \[g\].
const SS_G: [f64; 6] = [0.25, 0.5, 0.75, 1.0, 1.25, 1.5];
/// The columns of Table 11.4-2 \[g\].
const S1_G: [f64; 6] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
/// From this S1 on, 11.4.8 asks for a site-specific study on classes D and E \[g\].
const STUDY_FROM_S1_G: f64 = 0.2;
/// Fa is at least this where class D is taken because nothing is known (11.4.4).
const LEAST_ASSUMED_FA_RATIO: f64 = 1.2;

/// The site coefficients of a class, and what the code says about their use.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SiteCoefficients {
    /// Fa, of the short periods.
    pub fa_ratio: f64,
    /// Fv, of 1 s.
    pub fv_ratio: f64,
    /// Whether 11.4.8 asks for a site-specific study in place of Fv: class D with S1 ≥ 0.2 g. Its
    /// exception, with SM1 raised by half (Supplement 3), is not applied.
    pub asks_for_study: bool,
}

/// Fa and Fv of a site class, linear between the columns of the tables; `is_assumed` where the class
/// is taken because nothing is known, which makes Fa at least 1.2.
///
/// # Reference
/// ASCE 7-16 with Supplement 1, Tables 11.4-1 and 11.4-2, 11.4.4 and 11.4.8. The tables were
/// compared with two public copies (ideCAD's manual; S. K. Ghosh Associates, 13 April 2020); the 1.2
/// of 11.4.4 and the increase of Supplement 3 are recalled.
///
/// # Limitation
/// The coefficients of class B are those for a measured shear-wave velocity.
///
/// # Errors
/// Mapped accelerations that are not positive and finite; class E where the code requires a
/// site-specific study (Ss above 0.75 g, where Table 11.4-1 ends, or S1 ≥ 0.2 g).
///
/// # Example
/// Salt Lake City, class D: Fa of Ss = 1.494 g is 1.0, Fv of S1 = 0.543 g is 1.8 − 0.43·0.1.
/// ```
/// use freestand::code_spectrum::{Asce7Site, site_coefficients};
/// let found = site_coefficients(Asce7Site::D, 1.494, 0.543, false)?;
/// assert_eq!(found.fa_ratio, 1.0);
/// assert!((found.fv_ratio - 1.757).abs() < 1e-12 && found.asks_for_study);
/// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
/// ```
pub fn site_coefficients(
    site: Asce7Site,
    ss_g: f64,
    s1_g: f64,
    is_assumed: bool,
) -> Result<SiteCoefficients, CodeSpectrumError> {
    let (ss_g, s1_g) = (positive("Ss", ss_g)?, positive("S1", s1_g)?);
    if site == Asce7Site::E && (ss_g > 0.75 || s1_g >= STUDY_FROM_S1_G) {
        return Err(CodeSpectrumError::SiteStudy { ss_g, s1_g });
    }
    let fa_ratio = between(&SS_G, site.short_period_ratios(), ss_g);
    let fv_ratio = between(&S1_G, site.long_period_ratios(), s1_g);
    Ok(SiteCoefficients {
        fa_ratio: if is_assumed {
            fa_ratio.max(LEAST_ASSUMED_FA_RATIO)
        } else {
            fa_ratio
        },
        fv_ratio,
        asks_for_study: site == Asce7Site::D && s1_g >= STUDY_FROM_S1_G,
    })
}

/// Straight lines between the columns of a table; constant outside them.
pub(super) fn between(columns: &[f64], ratios: &[f64], value: f64) -> f64 {
    let last = ratios.last().copied().unwrap_or(f64::NAN);
    let ends = columns.windows(2).zip(ratios.windows(2));
    for (at, ratio) in ends {
        if let ([from, to], [low, high]) = (at, ratio)
            && value < *to
        {
            let share = ((value - from) / (to - from)).max(0.0);
            return low + share * (high - low);
        }
    }
    last
}

/// A design spectrum of ASCE 7, 5 % damping.
///
/// `SDS (0.4 + 0.6 T/T0)` below T0 = 0.2 TS, `SDS` up to TS = SD1/SDS, `SD1/T` up to TL,
/// `SD1 TL/T²` above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asce7 {
    edition: Asce7Edition,
    sds_g: f64,
    sd1_g: f64,
    long_period_s: f64,
    site: Option<Asce7Site>,
}

impl Asce7 {
    /// The spectrum for the design accelerations SDS and SD1 and the transition period TL.
    ///
    /// # Reference
    /// ASCE 7-16, 11.4.6; ASCE 7-22, 11.4.5.2.
    ///
    /// # Errors
    /// A value that is not positive and finite, or a TL below TS = SD1/SDS.
    ///
    /// # Example
    /// SDS = 1 g, SD1 = 0.6 g, TL = 8 s: TS = 0.6 s, T0 = 0.12 s.
    /// ```
    /// use freestand::code_spectrum::{Asce7, Asce7Edition};
    /// let code = Asce7::new(Asce7Edition::Asce7_22, 1.0, 0.6, 8.0)?;
    /// assert!((code.sa_g(0.06) - 0.7).abs() < 1e-15);
    /// assert!((code.sa_g(2.0) - 0.3).abs() < 1e-15);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn new(
        edition: Asce7Edition,
        sds_g: f64,
        sd1_g: f64,
        long_period_s: f64,
    ) -> Result<Self, CodeSpectrumError> {
        let (sds_g, sd1_g) = (positive("SDS", sds_g)?, positive("SD1", sd1_g)?);
        let long_period_s = positive("TL", long_period_s)?;
        let fine = long_period_s >= sd1_g / sds_g;
        within(fine, "TL", "at least TS = SD1/SDS", long_period_s)?;
        Ok(Self {
            edition,
            sds_g,
            sd1_g,
            long_period_s,
            site: None,
        })
    }

    /// The spectrum for the mapped accelerations: SDS = ⅔ Fa Ss and SD1 = ⅔ Fv S1.
    ///
    /// # Reference
    /// ASCE 7-16, 11.4.4 and 11.4.5.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    ///
    /// # Example
    /// Ss = 1.5 g, Fa = 1: SDS = 1 g.
    /// ```
    /// use freestand::code_spectrum::{Asce7, Asce7Edition};
    /// let code = Asce7::from_mapped(Asce7Edition::Asce7_16, (1.5, 1.0), (0.6, 1.5), 12.0)?;
    /// assert!((code.sds_g() - 1.0).abs() < 1e-15);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn from_mapped(
        edition: Asce7Edition,
        (ss_g, fa_ratio): (f64, f64),
        (s1_g, fv_ratio): (f64, f64),
        long_period_s: f64,
    ) -> Result<Self, CodeSpectrumError> {
        let short = positive("Ss", ss_g)? * positive("Fa", fa_ratio)?;
        let second = positive("S1", s1_g)? * positive("Fv", fv_ratio)?;
        Self::new(
            edition,
            2.0 * short / 3.0,
            2.0 * second / 3.0,
            long_period_s,
        )
    }

    /// The same spectrum, with the site class that its coefficients belong to.
    pub fn on_site(self, site: Asce7Site) -> Self {
        Self {
            site: Some(site),
            ..self
        }
    }

    /// The site class, if the coefficients are those of one.
    pub fn site(&self) -> Option<Asce7Site> {
        self.site
    }

    /// Edition of the code.
    pub fn edition(&self) -> Asce7Edition {
        self.edition
    }

    /// Design acceleration at short periods, SDS \[g\].
    pub fn sds_g(&self) -> f64 {
        self.sds_g
    }

    /// Design acceleration at 1 s, SD1 \[g\].
    pub fn sd1_g(&self) -> f64 {
        self.sd1_g
    }

    /// Long-period transition TL \[s\].
    pub fn long_period_s(&self) -> f64 {
        self.long_period_s
    }

    /// T0, TS and TL \[s\].
    pub fn corner_periods_s(&self) -> [f64; 3] {
        let ts_s = self.sd1_g / self.sds_g;
        [0.2 * ts_s, ts_s, self.long_period_s]
    }

    /// Spectral acceleration, 5 % damping \[g\]; NaN for a negative period.
    pub fn sa_g(&self, period_s: f64) -> f64 {
        let [t0_s, ts_s, tl_s] = self.corner_periods_s();
        match period_s {
            t if (0.0..t0_s).contains(&t) => self.sds_g * (0.4 + 0.6 * t / t0_s),
            t if t >= t0_s && t <= ts_s => self.sds_g,
            t if t > ts_s && t <= tl_s => self.sd1_g / t,
            t if t > tl_s => self.sd1_g * tl_s / (t * t),
            _ => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every value of the tables, and the middle between two columns.
    #[test]
    fn coefficients_are_those_of_the_tables() {
        for site in Asce7Site::ALL
            .into_iter()
            .filter(|site| *site != Asce7Site::E)
        {
            for (i, (ss_g, s1_g)) in SS_G.into_iter().zip(S1_G).enumerate() {
                let found = site_coefficients(site, ss_g, s1_g, false).unwrap();
                let want = (site.short_period_ratios()[i], site.long_period_ratios()[i]);
                // A share of exactly 0: no rounding.
                assert_eq!(
                    (found.fa_ratio, found.fv_ratio),
                    want,
                    "{site:?} {ss_g} {s1_g}"
                );
                assert_eq!(found.asks_for_study, site == Asce7Site::D && s1_g >= 0.2);
            }
        }
        let found = site_coefficients(Asce7Site::D, 0.625, 0.15, false).unwrap();
        // One interpolation: a few ulp.
        assert!((found.fa_ratio - 1.3).abs() < 1e-14 && (found.fv_ratio - 2.3).abs() < 1e-14);
        let low = site_coefficients(Asce7Site::C, 0.01, 0.01, false).unwrap();
        let high = site_coefficients(Asce7Site::C, 9.0, 9.0, false).unwrap();
        assert_eq!(
            (low.fa_ratio, low.fv_ratio, high.fa_ratio, high.fv_ratio),
            (1.3, 1.5, 1.2, 1.4)
        );
    }

    #[test]
    fn a_site_that_is_not_known_has_at_least_1_2() {
        for (ss_g, fa_ratio) in [(1.5, 1.2), (0.25, 1.6)] {
            assert_eq!(
                site_coefficients(Asce7Site::D, ss_g, 0.1, true)
                    .unwrap()
                    .fa_ratio,
                fa_ratio
            );
        }
    }

    #[test]
    fn soft_clay_is_left_to_a_study() {
        let found = site_coefficients(Asce7Site::E, 0.75, 0.1, false).unwrap();
        assert_eq!(
            (found.fa_ratio, found.fv_ratio, found.asks_for_study),
            (1.3, 4.2, false)
        );
        for (ss_g, s1_g) in [(0.76, 0.1), (0.3, 0.2), (1.5, 0.6)] {
            let refused = site_coefficients(Asce7Site::E, ss_g, s1_g, false);
            assert_eq!(refused, Err(CodeSpectrumError::SiteStudy { ss_g, s1_g }));
        }
        assert!(Asce7Site::parse("F").is_err() && Asce7Site::parse(" d ") == Ok(Asce7Site::D));
        assert!(site_coefficients(Asce7Site::D, f64::NAN, 0.1, false).is_err());
    }

    /// SDS = 0.8 g, SD1 = 0.4 g, TL = 6 s: TS = 0.5 s, T0 = 0.1 s. By hand: 0.32 at 0, 0.56 at
    /// T0/2, 0.8, 0.8, 0.4 at 1 s, 0.4/6 at TL, 0.4 · 6/144 = 1/60 at 12 s.
    #[test]
    fn every_corner_and_between() {
        let code = Asce7::new(Asce7Edition::Asce7_16, 0.8, 0.4, 6.0).unwrap();
        assert_eq!(code.corner_periods_s(), [0.1, 0.5, 6.0]);
        let cases = [
            (0.0, 0.32),
            (0.05, 0.56),
            (0.1, 0.8),
            (0.3, 0.8),
            (0.5, 0.8),
            (1.0, 0.4),
            (6.0, 0.4 / 6.0),
            (12.0, 1.0 / 60.0),
        ];
        for (period_s, sa_g) in cases {
            // Two or three multiplications.
            assert!((code.sa_g(period_s) - sa_g).abs() < 4e-16, "{period_s}");
        }
        for corner in code.corner_periods_s() {
            let (before, after) = (code.sa_g(corner.next_down()), code.sa_g(corner.next_up()));
            assert!((after / before - 1.0).abs() < 1e-14, "{corner}");
        }
    }

    #[test]
    fn mapped_values_are_two_thirds() {
        let code =
            Asce7::from_mapped(Asce7Edition::Asce7_22, (1.2, 1.02), (0.45, 1.85), 8.0).unwrap();
        // ⅔ · 1.2 · 1.02 = 0.816, ⅔ · 0.45 · 1.85 = 0.555.
        assert!((code.sds_g() - 0.816).abs() < 1e-15 && (code.sd1_g() - 0.555).abs() < 1e-15);
        assert!(Asce7::from_mapped(Asce7Edition::Asce7_22, (1.2, 0.0), (0.45, 1.85), 8.0).is_err());
        assert!(Asce7::new(Asce7Edition::Asce7_22, 0.5, 0.5, 0.9).is_err());
        assert!(Asce7::new(Asce7Edition::Asce7_22, f64::NAN, 0.5, 8.0).is_err());
    }
}
