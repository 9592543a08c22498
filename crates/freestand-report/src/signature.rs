//! Where somebody signs a sheet: the lines to fill in, or, while the sheet rests on values that nobody has read, that
//! it is a draft.

use maud::{Markup, html};

/// How a sheet is signed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Signing {
    /// Whether whoever signs has confirmed the values that are quoted from memory.
    pub allows_recalled: bool,
}

impl Signing {
    /// Whether a sheet that rests on these recalled values is a draft.
    pub(crate) fn is_draft(self, recalled: &[String]) -> bool {
        !recalled.is_empty() && !self.allows_recalled
    }
}

/// Values that a sheet of its own names: all that one object or one room has.
pub(crate) const ON_A_SHEET: usize = 20;

/// The style of [`signature`].
pub(crate) const SIGNATURE_CSS: &str = "\
.draft { border: 2px solid #b00020; padding: .3rem .8rem; margin: 1rem 0; break-inside: avoid; }
";

/// The lines to sign on, or the notice of a draft where values are recalled and nobody has confirmed them.
/// The first `most` of them are named.
pub(crate) fn signature(
    lines: Markup,
    recalled: &[String],
    most: usize,
    signing: Signing,
) -> Markup {
    if recalled.is_empty() {
        return lines;
    }
    let first: Vec<&str> = recalled.iter().take(most).map(String::as_str).collect();
    let more = match recalled.len() - first.len() {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    let names = first.join("; ") + &more;
    html! {
        @if signing.allows_recalled {
            p { "Confidence: recalled, and confirmed by whoever signs: " (names) "." }
            (lines)
        } @else {
            div.draft {
                p {
                    b { "DRAFT" } ": contains values quoted from memory (confidence: recalled): " (names)
                    ". Once they are confirmed, " code { "--allow-recalled" }
                    " puts a line to sign on in place of this notice."
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_with_recalled_values_is_a_draft_until_they_are_confirmed() {
        let lines = "<div class=\"sign\"></div>";
        let sign = |recalled: &[String], signing| {
            let lines = html! { div.sign {} };
            signature(lines, recalled, ON_A_SHEET, signing).into_string()
        };
        let recalled = ["R_p: <other>".to_owned()];
        let draft = sign(&recalled, Signing::default());
        assert!(draft.contains("DRAFT") && draft.contains("R_p: &lt;other&gt;"));
        assert!(!draft.contains(lines));
        let confirmed = Signing {
            allows_recalled: true,
        };
        let signed = sign(&recalled, confirmed);
        assert!(signed.contains(lines) && signed.contains("recalled") && !signed.contains("DRAFT"));
        assert_eq!(sign(&[], Signing::default()), lines);
    }
}
