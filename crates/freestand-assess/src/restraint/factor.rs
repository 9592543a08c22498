//! The factors of a force, and who says so.

use freestand_input::words::number;

/// A factor of a formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Factor {
    /// Its name in outputs.
    pub(crate) key: &'static str,
    /// Its symbol in the code.
    pub(crate) symbol: &'static str,
    pub(crate) value: f64,
    /// `g` or `1`.
    pub(crate) unit: &'static str,
    pub(crate) source: FactorSource,
}

/// Who states a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FactorSource {
    /// The user.
    Given,
    /// freestand, for this reason; may be empty.
    Assumed(&'static str),
    /// It follows from this.
    Found(&'static str),
}

impl FactorSource {
    /// `given`, `assumed: a rigid bracket`, `from the hazard`.
    pub(crate) fn words(self) -> String {
        match self {
            Self::Given => "given".to_owned(),
            Self::Assumed("") => "assumed: an ordinary object".to_owned(),
            Self::Assumed(reason) => format!("assumed: {reason}"),
            Self::Found(from) => format!("from {from}"),
        }
    }
}

impl Factor {
    /// The stated value, or the assumed one with its reason.
    pub(super) fn new(
        key: &'static str,
        symbol: &'static str,
        stated: Option<f64>,
        assumed: f64,
        reason: &'static str,
    ) -> Self {
        let source = if stated.is_some() { FactorSource::Given } else { FactorSource::Assumed(reason) };
        Self { key, symbol, value: stated.unwrap_or(assumed), unit: "1", source }
    }

    /// A value that follows from something else.
    pub(super) fn found(
        key: &'static str,
        symbol: &'static str,
        value: f64,
        unit: &'static str,
        from: &'static str,
    ) -> Self {
        Self { key, symbol, value, unit, source: FactorSource::Found(from) }
    }

    pub(crate) fn number(&self) -> String {
        number(self.value, 4)
    }
}

/// ` Assumed: a_p = 1 (rigid). Stated in the study: R_p = 2.` with `stated` for the second title.
pub(super) fn said(factors: &[Factor], stated: &str) -> String {
    let list = |title: &str, wanted: fn(FactorSource) -> Option<&'static str>| {
        let chosen = factors.iter().filter_map(|factor| Some((factor, wanted(factor.source)?)));
        let each = chosen.map(|(factor, reason)| match reason {
            "" => format!("{} = {}", factor.symbol, factor.number()),
            reason => format!("{} = {} ({reason})", factor.symbol, factor.number()),
        });
        let each: Vec<String> = each.collect();
        if each.is_empty() { String::new() } else { format!(" {title}: {}.", each.join(", ")) }
    };
    let assumed =
        list("Assumed", |source| if let FactorSource::Assumed(reason) = source { Some(reason) } else { None });
    assumed + &list(stated, |source| (source == FactorSource::Given).then_some(""))
}
