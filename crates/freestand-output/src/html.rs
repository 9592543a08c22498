//! The skeleton of a report, its tables and its figures, as markup of `maud`: it escapes every text,
//! and markup has a type of its own, so neither is taken for the other.

use maud::{DOCTYPE, Markup, PreEscaped, Render, html};

use crate::figure::Figure;

/// The style of every report on a screen.
const SCREEN_CSS: &str = include_str!("style.css");

/// The style of every report on paper. A browser makes the PDF: freestand has no typesetter.
pub const PRINT_CSS: &str = include_str!("print.css");

/// The style of a report that fits on one sheet, A4 or Letter: small type and narrow margins on
/// paper. The `css` of such a report begins with it.
pub const ONE_PAGE_CSS: &str = include_str!("one_page.css");

/// A report: the shared styles, its own `css`, its title and its content. On paper the title is
/// repeated at the top of every page after the first, and the subtitle is at the foot of every page.
pub fn document(title: &str, subtitle: &str, css: &str, content: &Markup) -> String {
    without_forbidden(html! { (opening(title, subtitle, css)) (content) (CLOSING) })
}

/// What comes before the content, for a report that is written piece by piece.
pub fn opening(title: &str, subtitle: &str, css: &str) -> Markup {
    let (top, foot) = (css_string(title), css_string(subtitle));
    let style = format!(
        "{SCREEN_CSS}{PRINT_CSS}@page {{\n  @top-left {{ content: {top}; }}\n  \
         @bottom-left {{ content: {foot}; }}\n}}\n{css}"
    );
    html! {
        (DOCTYPE)
        (PreEscaped("<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">"))
        head {
            (META)
            title { (title) }
            style { (PreEscaped(style)) }
        }
        (PreEscaped("<body>"))
        header { h1 { (title) } p.sub { (subtitle) } }
        (PreEscaped("<main>"))
    }
}

/// The end of a report that [`opening`] began.
pub const CLOSING: PreEscaped<&str> = PreEscaped("</main></body></html>\n");

// `maud` writes void elements as HTML does (`<br>`). A report must be well-formed XML too (`<br />`), so
// they are written here.

const META: PreEscaped<&str> = PreEscaped(
    "<meta charset=\"utf-8\" />\
     <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />",
);

/// A line break.
pub const BREAK: PreEscaped<&str> = PreEscaped("<br />");

/// A box to tick.
pub fn checkbox(id: &'static str, is_checked: bool) -> Markup {
    let checked = if is_checked {
        " checked=\"checked\""
    } else {
        ""
    };
    PreEscaped(format!("<input type=\"checkbox\" id=\"{id}\"{checked} />"))
}

/// Markup as it goes into a file, without the characters that HTML and XML forbid: untidy lists
/// contain them, and `maud` keeps them.
pub fn without_forbidden(markup: Markup) -> String {
    let mut html = markup.into_string();
    html.retain(|c| {
        matches!(c, '\n' | '\t') || !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}')
    });
    html
}

/// A text as a string of CSS. Characters with a meaning in CSS, HTML or XML are written as their
/// code points.
fn css_string(text: &str) -> String {
    let has_meaning = |c: char| c.is_control() || "\"\\<>&\u{fffe}\u{ffff}".contains(c);
    let written = |c: char| {
        if has_meaning(c) {
            format!("\\{:x} ", u32::from(c))
        } else {
            c.to_string()
        }
    };
    format!("\"{}\"", text.chars().map(written).collect::<String>())
}

/// A cell of a table.
#[derive(Debug, Clone)]
pub struct Cell {
    content: Markup,
    class: Option<&'static str>,
    columns: Option<usize>,
}

/// A cell of words.
pub fn words(content: impl Render) -> Cell {
    Cell {
        content: content.render(),
        class: None,
        columns: None,
    }
}

/// A cell of a number, aligned to the right.
pub fn figure(content: impl Render) -> Cell {
    words(content).class("n")
}

impl Cell {
    /// Sets the style classes of the cell, in place of earlier ones.
    pub fn class(mut self, class: &'static str) -> Self {
        self.class = Some(class);
        self
    }

    /// Makes the cell span several columns.
    pub fn over(mut self, columns: usize) -> Self {
        self.columns = Some(columns);
        self
    }
}

/// A table that scrolls on a narrow screen: a heading row, then rows whose first cell is a heading.
pub fn table(
    caption: &str,
    headings: &[Cell],
    rows: impl IntoIterator<Item = impl AsRef<[Cell]>>,
) -> Markup {
    classed_table("plain", caption, &[headings], rows)
}

/// The same with a style class and any number of heading rows.
pub fn classed_table(
    class: &str,
    caption: &str,
    headings: &[&[Cell]],
    rows: impl IntoIterator<Item = impl AsRef<[Cell]>>,
) -> Markup {
    html! {
        div.scroll tabindex="0" {
            table.(class) {
                @if !caption.is_empty() { caption { (caption) } }
                @if !headings.is_empty() {
                    thead {
                        @for row in headings {
                            tr {
                                @for Cell { content, class, columns } in *row {
                                    @let scope = if columns.is_some() { "colgroup" } else { "col" };
                                    th scope=(scope) class=[class] colspan=[columns] { (content) }
                                }
                            }
                        }
                    }
                }
                tbody {
                    @for row in rows {
                        tr {
                            @for (i, Cell { content, class, columns }) in row.as_ref().iter().enumerate() {
                                @if i == 0 {
                                    th scope="row" class=[class] colspan=[columns] { (content) }
                                } @else {
                                    td class=[class] colspan=[columns] { (content) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// A table of names and values without a heading row; empty values are left out.
pub fn properties<N: Render, V: AsRef<str>>(caption: &str, rows: &[(N, V)]) -> Markup {
    let stated = rows.iter().filter(|(_, value)| !value.as_ref().is_empty());
    let rows = stated.map(|(name, value)| [words(name), words(value.as_ref())]);
    classed_table("pairs", caption, &[], rows)
}

/// A part of a report that its contents name.
pub struct Section {
    /// Its name in a link.
    id: &'static str,
    /// What stands above it.
    heading: &'static str,
    /// All below the heading.
    content: Markup,
}

impl Section {
    /// One with these values.
    pub fn new(id: &'static str, heading: &'static str, content: Markup) -> Self {
        Self {
            id,
            heading,
            content,
        }
    }
}

/// Links to sections.
pub fn contents(sections: &[Section]) -> Markup {
    html! {
        nav aria-label="Contents" {
            @for Section { id, heading, .. } in sections { a href={ "#" (id) } { (heading) } "\n" }
        }
    }
}

/// Sections with their headings, each on a line of its own.
pub fn sections(sections: &[Section]) -> Markup {
    html! {
        @for Section { id, heading, content } in sections {
            "\n" section #(id) { h2 { (heading) } (content) }
        }
    }
}

/// A bulleted list.
pub fn list(items: impl IntoIterator<Item = impl Render>) -> Markup {
    html! {
        ul { @for item in items { li { (item) } } }
    }
}

/// The drawing of a figure, which scrolls on a narrow screen. Its title is for readers who do not
/// see it.
pub fn drawing(figure: &Figure) -> Markup {
    let title = html! { (figure.title) }.into_string();
    let labelled = format!("<svg role=\"img\" aria-label=\"{title}\" ");
    let svg = figure.svg.replacen("<svg ", &labelled, 1);
    html! {
        div.scroll tabindex="0" { (PreEscaped(svg)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stay_texts() {
        let text = "<a href=\"x\">&\u{0}\r\u{ffff}\n</a>";
        assert_eq!(
            without_forbidden(html! { p title=(text) { (text) } }),
            "<p title=\"&lt;a href=&quot;x&quot;&gt;&amp;\n&lt;/a&gt;\">\
             &lt;a href=&quot;x&quot;&gt;&amp;\n&lt;/a&gt;</p>"
        );
    }

    #[test]
    fn a_title_stays_a_text_in_a_style() {
        assert_eq!(
            css_string("a \"b\"\\ </style>&\nü"),
            "\"a \\22 b\\22 \\5c  \\3c /style\\3e \\26 \\a ü\""
        );
        let html = document("]]> </style>", "\u{0}", "", &Markup::default());
        assert_eq!(
            (
                html.matches("</style>").count(),
                html.matches("]]>").count()
            ),
            (1, 0)
        );
    }
}
