//! The documents as they are written: each is a page of the site, and each link leads to a file and a
//! heading that are there.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::site::{self, normal};
use crate::tools::told;

/// Where every document is a page of the site.
const FOLDERS: [&str; 2] = ["docs", "docs/for"];
/// Documents beside these folders.
const OTHERS: [&str; 7] = [
    "README.md",
    "ARCHITECTURE.md",
    "CONTRIBUTING.md",
    "DESIGN.md",
    "CHANGELOG.md",
    "SECURITY.md",
    "benches/README.md",
];

/// Folders whose `README.md`, at any depth, are followed as the other documents are.
const WITH_READMES: [&str; 2] = ["examples", "validation"];

/// Compares the documents with the list of pages, follows the links between them, and compares the
/// version that people are asked to cite.
///
/// # Errors
/// A document that is no page, a link that leads nowhere, another version.
pub fn check(root: &Path) -> Result<(), String> {
    let summary = site::read(&root.join(site::SOURCE).join("SUMMARY.md"))?;
    let mut texts = BTreeMap::new();
    for folder in FOLDERS {
        for path in site::files_of(&root.join(folder))? {
            if path.extension().is_some_and(|ending| ending == "md") {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                texts.insert(format!("{folder}/{name}"), site::read(&path)?);
            }
        }
    }
    let listed: BTreeSet<&str> = site::links(&summary).collect();
    let mut faults: Vec<String> = texts
        .keys()
        .filter(|page| !listed.contains(page.as_str()))
        .map(|page| format!("{page} is not in {}/SUMMARY.md", site::SOURCE))
        .collect();
    let readmes = WITH_READMES
        .iter()
        .map(|folder| readmes(root, Path::new(folder)))
        .collect::<Result<Vec<_>, _>>()?;
    let others = OTHERS.iter().map(|&page| page.to_owned());
    for page in others.chain(readmes.into_iter().flatten()) {
        let text = site::read(&root.join(&page))?;
        texts.insert(page, text);
    }
    for (page, text) in &texts {
        for link in site::links(&prose(text)) {
            if !leads_somewhere(root, page, link, &texts)? {
                faults.push(format!("{page}: {link} leads nowhere"));
            }
        }
    }
    let cargo = site::read(&root.join("Cargo.toml"))?;
    let citation = site::read(&root.join("CITATION.cff"))?;
    let [version, cited] = [(&cargo, "version = "), (&citation, "version: ")].map(|(text, key)| {
        let value = text.lines().find_map(|line| line.strip_prefix(key));
        value.unwrap_or("none").trim_matches('"').to_owned()
    });
    if version != cited {
        faults.push(format!(
            "CITATION.cff has version {cited}, but Cargo.toml {version}"
        ));
    }
    if faults.is_empty() {
        Ok(())
    } else {
        Err(faults.join("\n"))
    }
}

/// The `README.md` of a folder and of the folders in it.
fn readmes(root: &Path, folder: &Path) -> Result<Vec<String>, String> {
    let mut found = Vec::new();
    for path in site::files_of(&root.join(folder))? {
        let name = path.file_name().unwrap_or_default();
        let inside = folder.join(name);
        // An environment of Python beside a script has documents of others.
        if name.to_string_lossy().starts_with('.') {
            continue;
        }
        if path.is_dir() {
            found.extend(readmes(root, &inside)?);
        } else if inside.ends_with("README.md") {
            found.push(inside.to_string_lossy().replace('\\', "/"));
        }
    }
    Ok(found)
}

fn leads_somewhere(
    root: &Path,
    page: &str,
    link: &str,
    texts: &BTreeMap<String, String>,
) -> Result<bool, String> {
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    if file.contains(':') {
        return Ok(true);
    }
    let target = if file.is_empty() {
        Path::new(page).to_path_buf()
    } else {
        normal(&Path::new(page).parent().unwrap_or(Path::new("")).join(file))
    };
    let path = root.join(&target);
    if !path.exists() {
        return Ok(false);
    }
    if anchor.is_empty() {
        return Ok(true);
    }
    let name = target.to_string_lossy().replace('\\', "/");
    let other;
    let text = match texts.get(&name) {
        Some(text) => text,
        None => {
            other = fs::read_to_string(&path).map_err(told(&path))?;
            &other
        }
    };
    Ok(anchors(text).contains(anchor))
}

/// A document without its blocks of code and without code in its lines.
fn prose(text: &str) -> String {
    let mut is_code = false;
    let mut prose = String::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        } else if !is_code {
            // A pair of backticks holds code, but for the text of a link, which stays.
            for (place, part) in line.split('`').enumerate() {
                if place % 2 == 0 {
                    prose += part;
                }
            }
            prose.push('\n');
        }
    }
    prose
}

/// The anchors of the headings, as mdBook and the sites that host repositories name them.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut is_code = false;
    let mut anchors = BTreeSet::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        }
        let heading = line.trim_start_matches('#');
        if is_code || heading.len() == line.len() || !heading.starts_with(' ') {
            continue;
        }
        let anchor: String = heading
            .trim()
            .to_lowercase()
            .chars()
            .filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter))
            .map(|letter| if letter == ' ' { '-' } else { letter })
            .collect();
        anchors.insert(anchor);
    }
    anchors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_have_anchors() {
        let text = "# One `code`, two!\n\n```sh\n# no heading\n```\n## a\n#b\n";
        let expected = ["a", "one-code-two"].map(str::to_owned);
        assert_eq!(anchors(text), BTreeSet::from(expected));
    }

    #[test]
    fn readmes_are_found_at_any_depth() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let found = readmes(root, Path::new("validation")).unwrap();
        assert!(found.contains(&"validation/cushion/README.md".to_owned()));
        assert!(found.iter().all(|page| page.ends_with("/README.md")));
    }

    #[test]
    fn links_in_code_do_not_count() {
        let text = "See [a](b.md), `x[0](y)` and [`c`](d.md).\n```\n[e](f.md)\n```\n";
        let found = prose(text);
        assert_eq!(site::links(&found).collect::<Vec<_>>(), ["b.md", "d.md"]);
    }
}
