//! The skeleton of a report and pieces of HTML. Arguments called `html` are markup
//! already; those called `text` are escaped here.

/// The style of every report on a screen.
const SCREEN_CSS: &str = include_str!("style.css");

/// The style of every report on paper. A browser makes the PDF: freestand has no typesetter.
pub const PRINT_CSS: &str = include_str!("print.css");

/// The style of a report that fits on one sheet, A4 or Letter: small type and narrow margins on
/// paper. The `css` of such a report begins with it.
pub const ONE_PAGE_CSS: &str = include_str!("one_page.css");

/// Everything before the content of a report: the shared styles, the report's own `css`, the title.
/// On paper the title is repeated at the top of every page after the first, and the subtitle is at
/// the foot of every page.
pub fn opening(title: &str, subtitle: &str, css: &str) -> String {
    let (heading, below) = (escape(title), escape(subtitle));
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n\
         <meta charset=\"utf-8\" />\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n\
         <title>{heading}</title>\n<style>\n{SCREEN_CSS}{PRINT_CSS}\
         @page {{\n  @top-left {{ content: {}; }}\n  @bottom-left {{ content: {}; }}\n}}\n{css}</style>\n\
         </head>\n<body>\n<header>\n<h1>{heading}</h1>\n<p class=\"sub\">{below}</p>\n</header>\n<main>\n",
        css_string(title),
        css_string(subtitle),
    )
}

/// The end of a report that [`opening`] began.
pub const CLOSING: &str = "</main>\n</body>\n</html>\n";

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
    html: String,
    class: &'static str,
    columns: usize,
}

/// A cell of words.
pub fn words(text: &str) -> Cell {
    Cell {
        html: escape(text),
        class: "",
        columns: 1,
    }
}

/// A cell of a number, aligned to the right.
pub fn figure(text: impl AsRef<str>) -> Cell {
    Cell {
        html: escape(text.as_ref()),
        class: "n",
        columns: 1,
    }
}

/// A cell of markup.
pub fn markup(html: String, class: &'static str) -> Cell {
    Cell {
        html,
        class,
        columns: 1,
    }
}

impl Cell {
    /// Makes the cell span several columns.
    pub fn over(mut self, columns: usize) -> Self {
        self.columns = columns;
        self
    }

    fn write(&self, html: &mut String, tag: &str, scope: &str) {
        html.push('<');
        html.push_str(tag);
        if !scope.is_empty() {
            html.push_str(&format!(" scope=\"{scope}\""));
        }
        if !self.class.is_empty() {
            html.push_str(&format!(" class=\"{}\"", self.class));
        }
        if self.columns > 1 {
            html.push_str(&format!(" colspan=\"{}\"", self.columns));
        }
        html.push('>');
        html.push_str(&self.html);
        html.push_str(&format!("</{tag}>"));
    }
}

/// A table that scrolls on a narrow screen: heading rows, then rows whose first cell is a heading.
pub fn table(caption: &str, headings: &[Vec<Cell>], rows: &[Vec<Cell>]) -> String {
    classed_table("plain", caption, headings, rows)
}

/// The same with a style class.
pub fn classed_table(
    class: &str,
    caption: &str,
    headings: &[Vec<Cell>],
    rows: &[Vec<Cell>],
) -> String {
    let mut html = format!("<div class=\"scroll\" tabindex=\"0\"><table class=\"{class}\">");
    if !caption.is_empty() {
        html.push_str(&format!("<caption>{}</caption>", escape(caption)));
    }
    html.push_str(if headings.is_empty() { "" } else { "<thead>" });
    for row in headings {
        html.push_str("<tr>");
        for cell in row {
            cell.write(
                &mut html,
                "th",
                if cell.columns > 1 { "colgroup" } else { "col" },
            );
        }
        html.push_str("</tr>");
    }
    html.push_str(if headings.is_empty() {
        "<tbody>"
    } else {
        "</thead><tbody>"
    });
    for row in rows {
        html.push_str("<tr>");
        for (i, cell) in row.iter().enumerate() {
            let (tag, scope) = if i == 0 { ("th", "row") } else { ("td", "") };
            cell.write(&mut html, tag, scope);
        }
        html.push_str("</tr>");
    }
    html.push_str("</tbody></table></div>\n");
    html
}

/// A table of names and values without a heading row; empty values are left out.
pub fn properties(caption: &str, rows: &[(&str, String)]) -> String {
    let rows: Vec<Vec<Cell>> = rows
        .iter()
        .filter(|(_, value)| !value.is_empty())
        .map(|(name, value)| vec![words(name), words(value)])
        .collect();
    classed_table("pairs", caption, &[], &rows)
}

/// A paragraph of words.
pub fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", escape(text))
}

/// A bulleted list of words.
pub fn list<S: AsRef<str>>(items: &[S]) -> String {
    let mut html = String::from("<ul>\n");
    for item in items {
        html.push_str(&format!("<li>{}</li>\n", escape(item.as_ref())));
    }
    html.push_str("</ul>\n");
    html
}

/// A section with its heading; `id` is the target of links.
pub fn section(id: &str, heading: &str, html: &str) -> String {
    format!(
        "<section id=\"{id}\">\n<h2>{}</h2>\n{html}</section>\n",
        escape(heading)
    )
}

/// A heading inside a section.
pub fn heading(text: &str) -> String {
    format!("<h3>{}</h3>\n", escape(text))
}

/// Escapes text for HTML: between tags and in quoted attributes. Characters that are not allowed in
/// a document are left out.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            '\n' | '\t' => escaped.push(c),
            '\u{fffe}' | '\u{ffff}' => {}
            c if c.is_control() => {}
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_is_escaped() {
        assert_eq!(
            escape("<a href='x'>&\u{0}\"</a>"),
            "&lt;a href=&#39;x&#39;&gt;&amp;&quot;&lt;/a&gt;"
        );
    }

    #[test]
    fn a_title_stays_a_text_in_a_style() {
        assert_eq!(
            css_string("a \"b\"\\ </style>&\nü"),
            "\"a \\22 b\\22 \\5c  \\3c /style\\3e \\26 \\a ü\""
        );
        let html = opening("]]> </style>", "\u{0}", "");
        assert_eq!(
            (
                html.matches("</style>").count(),
                html.matches("]]>").count()
            ),
            (1, 0)
        );
    }
}
