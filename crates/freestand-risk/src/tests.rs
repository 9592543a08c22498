//! What people write for money, years and rates.

use crate::{amount, yearly_rate, years};

/// Units stand after the number with or without a space.
#[test]
fn a_space_before_the_unit_is_not_needed() {
    let aud = |text| amount(text).map_err(|problem| problem.message);
    assert_eq!(aud("3000AUD"), Ok((3000.0, "AUD".to_owned())));
    assert_eq!(aud("3e3 EUR"), Ok((3000.0, "EUR".to_owned())));
    assert_eq!(aud("3e3EUR"), Ok((3000.0, "EUR".to_owned())));
    assert_eq!(aud("0 AUD"), Ok((0.0, "AUD".to_owned())));
    // Three digits after each comma: thousands, since no amount has three decimals.
    assert_eq!(aud("1,020,000 AUD"), Ok((1_020_000.0, "AUD".to_owned())));
    // As registers have them: an amount of money never has three decimals.
    for fifteen_thousand in [
        "15 000 AUD",
        "15.000 AUD",
        "AUD 15000",
        "$15,000.00 AUD",
        "15000 aud",
    ] {
        assert_eq!(
            aud(fifteen_thousand),
            Ok((15e3, "AUD".to_owned())),
            "{fifteen_thousand}"
        );
    }
    assert_eq!(aud("€20.000"), Ok((20e3, "€".to_owned())));
    assert_eq!(aud("3000 kr"), Ok((3e3, "kr".to_owned())));
    for wrong in [
        "3000",
        "-1 AUD",
        "AUD",
        "1,0000 AUD",
        "1,000,00 AUD",
        ",000 AUD",
        "",
        "inf AUD",
        "é AUD",
        "15k AUD",
        "15 Tsd AUD",
        "1.5 Mio AUD",
        "2 CAD AUD",
        "€5 NZD",
    ] {
        assert!(amount(wrong).is_err(), "{wrong}");
    }
    assert_eq!(
        [years("50yr"), years("40 years"), years("40")].map(Result::ok),
        [Some(50.0), Some(40.0), Some(40.0)]
    );
    assert!(years("0 yr").is_err() && years("5 days").is_err());
    assert_eq!(yearly_rate("1e-4/yr").ok(), Some(1e-4));
}
