//! What every report needs to print well. The tests of the crates that write reports include this
//! file by its path: nothing that is only tested belongs in a library.

use freestand_output::html::PRINT_CSS;

/// The report carries the shared print style and `title` as its running header, and every table
/// that may continue on the next page has a header to repeat. The classes that the print styles
/// name must be in use: one that was renamed only in the markup is found here.
pub(crate) fn check_print(html: &str, title: &str, own_css: &str) {
    assert_eq!(html.matches(PRINT_CSS).count(), 1);
    assert!(
        html.contains(&format!("@top-left {{ content: \"{title}\"; }}")),
        "{title}"
    );
    for table in html.split("<table").skip(1) {
        let table = table.split("</table>").next().unwrap();
        assert!(
            table.contains("<thead>") || table.starts_with(" class=\"pairs\""),
            "{table}"
        );
    }
    let classes = html
        .split("class=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next());
    let classes: Vec<&str> = classes.flat_map(|names| names.split(' ')).collect();
    let (_, own_print) = own_css.split_once("@media print").unwrap_or_default();
    for css in [PRINT_CSS, own_print] {
        for class in css
            .split('.')
            .skip(1)
            .filter(|rest| rest.starts_with(|c: char| c.is_ascii_lowercase()))
        {
            let class = class
                .split(|c: char| !c.is_ascii_alphanumeric() && c != '-')
                .next()
                .unwrap();
            assert!(classes.contains(&class), "nothing has the class {class}");
        }
    }
}
