//! The factors of a force, and who says so.

use freestand_input::words::number;

/// A factor of a formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Factor {
    /// Its name in outputs.
    pub key: &'static str,
    /// Its symbol in the code.
    pub symbol: &'static str,
    /// Its value.
    pub value: f64,
    /// `g` or `1`.
    pub unit: &'static str,
    /// Who says so.
    pub source: FactorSource,
}

/// Who states a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FactorSource {
    /// The user.
    Given,
    /// freestand, for this reason; may be empty.
    Assumed(&'static str),
    /// It follows from this.
    Found(&'static str),
    /// It was read here.
    Read(&'static str),
    /// Nobody has read it: an engineer must confirm it; what it is for, may be empty.
    Recalled(&'static str),
}

impl FactorSource {
    /// `given`, `assumed: a rigid bracket`, `from the hazard`.
    pub fn words(self) -> String {
        match self {
            Self::Given => "given".to_owned(),
            Self::Assumed("") => "assumed: an ordinary object".to_owned(),
            Self::Assumed(reason) => format!("assumed: {reason}"),
            Self::Found(from) => format!("from {from}"),
            Self::Read(source) => format!("read: {source}"),
            Self::Recalled("") => "to be confirmed".to_owned(),
            Self::Recalled(reason) => format!("to be confirmed: {reason}"),
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
        let source = if stated.is_some() {
            FactorSource::Given
        } else {
            FactorSource::Assumed(reason)
        };
        Self {
            key,
            symbol,
            value: stated.unwrap_or(assumed),
            unit: "1",
            source,
        }
    }

    /// The stated value, or that of a table with its source; without a source nobody has read it.
    pub(super) fn of_table(
        key: &'static str,
        symbol: &'static str,
        stated: Option<f64>,
        value: f64,
        source: Option<&'static str>,
    ) -> Self {
        let from = source.map_or(
            FactorSource::Recalled("the row of the table"),
            FactorSource::Read,
        );
        let source = if stated.is_some() {
            FactorSource::Given
        } else {
            from
        };
        Self {
            key,
            symbol,
            value: stated.unwrap_or(value),
            unit: "1",
            source,
        }
    }

    /// The stated value, or one that nobody has read.
    pub(super) fn recalled(
        key: &'static str,
        symbol: &'static str,
        stated: Option<f64>,
        value: f64,
        reason: &'static str,
    ) -> Self {
        let source = if stated.is_some() {
            FactorSource::Given
        } else {
            FactorSource::Recalled(reason)
        };
        Self {
            key,
            symbol,
            value: stated.unwrap_or(value),
            unit: "1",
            source,
        }
    }

    /// A value that follows from something else.
    pub(super) fn found(
        key: &'static str,
        symbol: &'static str,
        value: f64,
        unit: &'static str,
        from: &'static str,
    ) -> Self {
        Self {
            key,
            symbol,
            value,
            unit,
            source: FactorSource::Found(from),
        }
    }

    /// Its value to four digits.
    pub fn number(&self) -> String {
        number(self.value, 4)
    }
}

/// ` Assumed: a_p = 1 (rigid). Stated in the study: R_p = 2.` with `stated` for the second title.
pub(super) fn said(factors: &[Factor], stated: &str) -> String {
    let list = |title: &str, wanted: fn(FactorSource) -> Option<&'static str>| {
        let chosen = factors
            .iter()
            .filter_map(|factor| Some((factor, wanted(factor.source)?)));
        let each = chosen.map(|(factor, reason)| match reason {
            "" => format!("{} = {}", factor.symbol, factor.number()),
            reason => format!("{} = {} ({reason})", factor.symbol, factor.number()),
        });
        let each: Vec<String> = each.collect();
        if each.is_empty() {
            String::new()
        } else {
            format!(" {title}: {}.", each.join(", "))
        }
    };
    let assumed = list("Assumed", |source| {
        if let FactorSource::Assumed(reason) = source {
            Some(reason)
        } else {
            None
        }
    });
    let read = list("Read", |source| {
        if let FactorSource::Read(source) = source {
            Some(source)
        } else {
            None
        }
    });
    let recalled = list("To be confirmed by the engineer", |source| match source {
        FactorSource::Recalled(reason) => Some(reason),
        _ => None,
    });
    assumed
        + &read
        + &recalled
        + &list(stated, |source| {
            (source == FactorSource::Given).then_some("")
        })
}
