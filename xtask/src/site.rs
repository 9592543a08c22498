//! The site: one folder of pages that loads nothing from elsewhere. mdBook makes it from the documents of the repository;
//! the pages of commands follow from the program and its schemas, those of the libraries come from pdoc and rustdoc.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::tools::{ended, run, told};
use crate::{documents, python};

/// What lists the pages, and how they look.
pub const SOURCE: &str = "xtask/site";
/// Where mdBook is installed: it is needed for this alone.
const TOOLS: &str = "target/tools";
const MDBOOK: &str = "0.5.4";
/// The first page: mdBook copies it to the root, and its links would lead elsewhere from there.
const START: &str = "docs/start.md";
/// A file that a page shows or offers, at most \[bytes\].
const LARGEST: u64 = 4_000_000;

/// Builds the site into a folder, and follows every link.
pub fn site(root: &Path, out: &Path) -> Result<(), String> {
    documents::check(root)?;
    let book = root.join(TOOLS).join("bin/mdbook");
    if !book.exists() {
        let version = ["install", "mdbook", "--locked", "--version", MDBOOK];
        let lean = [
            "--no-default-features",
            "--features",
            "search",
            "--root",
            TOOLS,
        ];
        run(root, "cargo", &[&version[..], &lean].concat())?;
    }
    let staged = root.join("target/site");
    if staged.exists() {
        fs::remove_dir_all(&staged).map_err(told(&staged))?;
    }
    let pages = Pages {
        root: root.to_owned(),
        to: staged.join("src"),
    };
    let commands = pages.commands()?;
    let summary = read(&root.join(SOURCE).join("SUMMARY.md"))?.replace("{commands}\n", &commands);
    pages.write("SUMMARY.md", &as_page(&summary))?;
    pages.write(
        "reference/python.md",
        "# Python API\n\n[Every function and class, with its parameters, results and examples](../python/freestand.html).\n",
    )?;
    pages.write(
        "reference/rust.md",
        "# Rust API\n\n[The crate `freestand`](../rust/freestand/index.html): the science, each equation with its source.\n",
    )?;
    pages.notebooks()?;
    let written: Vec<&str> = links(&summary).collect();
    for page in written
        .iter()
        .filter(|page| !page.starts_with("reference/"))
    {
        pages.page(page, &written)?;
    }
    for name in ["book.toml", "site.css", "site.js"] {
        let to = staged.join(name);
        fs::copy(root.join(SOURCE).join(name), &to).map_err(told(&to))?;
    }
    run(&staged, &book.to_string_lossy(), &["build"])?;
    let built = staged.join("book");

    run(
        root,
        "cargo",
        &[
            "doc",
            "--locked",
            "--quiet",
            "--no-deps",
            "--package",
            "freestand",
            "--package",
            "freestand-rocking",
        ],
    )?;
    copy_folder(&python::target(root).join("doc"), &built.join("rust"))?;
    python::pages(root, &built)?;

    let faults = faults(&built)?;
    if !faults.is_empty() {
        return Err(faults.join("\n"));
    }
    if out.exists() {
        // Only a site is replaced.
        if !out.join("searchindex.js").exists() && !has_search(out) && !is_empty(out) {
            return Err(format!("{} has other files than a site", out.display()));
        }
        fs::remove_dir_all(out).map_err(told(out))?;
    }
    copy_folder(&built, out)?;
    println!("{}: open index.html there", out.display());
    Ok(())
}

fn is_empty(folder: &Path) -> bool {
    fs::read_dir(folder).is_ok_and(|mut files| files.next().is_none())
}

/// mdBook names the index of its search after its content.
fn has_search(folder: &Path) -> bool {
    let files = fs::read_dir(folder).into_iter().flatten().flatten();
    files.into_iter().any(|file| {
        file.file_name()
            .to_string_lossy()
            .starts_with("searchindex")
    })
}

/// Where pages come from and go to.
struct Pages {
    root: PathBuf,
    to: PathBuf,
}

impl Pages {
    fn write(&self, page: &str, text: &str) -> Result<(), String> {
        let to = self.to.join(as_page(page));
        if let Some(folder) = to.parent() {
            fs::create_dir_all(folder).map_err(told(folder))?;
        }
        fs::write(&to, text).map_err(told(&to))
    }

    /// A document as it is, but for links to what the site has elsewhere, with the files that it shows.
    fn page(&self, page: &str, pages: &[&str]) -> Result<(), String> {
        let mut text = read(&self.root.join(page))?;
        let folder = Path::new(page).parent().unwrap_or(Path::new(""));
        let targets: BTreeSet<String> = links(&text).map(str::to_owned).collect();
        for target in targets {
            let (path, anchor) = target.split_once('#').unwrap_or((&target, ""));
            if path.is_empty() || path.contains(':') {
                continue;
            }
            let from_root = normal(&folder.join(path));
            let source = self.root.join(&from_root);
            let readme = from_root.join("README.md");
            let readme_text = readme.to_string_lossy().replace('\\', "/");
            let new = if source.is_dir() && pages.contains(&readme_text.as_str()) {
                as_page(&format!("{}/README.md", path.trim_end_matches('/')))
            } else if source.is_dir() && self.root.join(&readme).exists() {
                // Only some documents are pages; the others are read as they are.
                self.file(&readme)?;
                format!("{}/README.txt", path.trim_end_matches('/'))
            } else if source.is_dir() {
                text = text.replace(
                    &format!("]({target})"),
                    &format!("] (`{}`)", from_root.display()),
                );
                continue;
            } else if from_root == Path::new(START) {
                let depth = Path::new(page).components().count() - 1;
                format!("{}start.md", "../".repeat(depth))
            } else if path.ends_with(".md") && pages.contains(&from_root.to_string_lossy().as_ref())
            {
                as_page(path)
            } else {
                self.file(&from_root)
                    .map_err(|problem| format!("{page}: {problem}"))?;
                match path.ends_with(".md") {
                    true => format!("{}.txt", path.trim_end_matches(".md")),
                    false => continue,
                }
            };
            let hash = if anchor.is_empty() { "" } else { "#" };
            text = text.replace(&format!("]({target})"), &format!("]({new}{hash}{anchor})"));
        }
        if page == START {
            let targets: BTreeSet<String> = links(&text).map(str::to_owned).collect();
            for target in targets.iter().filter(|target| !target.contains(':')) {
                text = text.replace(&format!("]({target})"), &format!("](docs/{target})"));
            }
        }
        self.write(page, &text)
    }

    /// A file that a page shows or offers; a document that is no page, as text.
    fn file(&self, from_root: &Path) -> Result<(), String> {
        let from = self.root.join(from_root);
        let size = fs::metadata(&from).map_err(told(&from))?.len();
        if size > LARGEST {
            return Err(format!("{} is too large for the site", from_root.display()));
        }
        let mut to = self.to.join(from_root);
        if from_root.extension().is_some_and(|ending| ending == "md") {
            to.set_extension("txt");
        }
        if let Some(folder) = to.parent() {
            fs::create_dir_all(folder).map_err(told(folder))?;
        }
        fs::copy(&from, &to).map(|_| ()).map_err(told(&to))
    }

    /// A page for each command: its help, what a request may contain, and what its document has. The lines of the
    /// summary for them.
    fn commands(&self) -> Result<String, String> {
        let mut names: Vec<String> = files_of(&self.root.join("docs/schema"))?
            .iter()
            .filter_map(|path| {
                let name = path.file_name()?.to_string_lossy().into_owned();
                Some(name.strip_suffix(".response.json")?.to_owned())
            })
            .collect();
        names.sort();
        run(
            &self.root,
            "cargo",
            &["build", "--quiet", "--locked", "--package", "freestand-cli"],
        )?;
        let program = python::target(&self.root)
            .join("debug")
            .join(format!("freestand{}", std::env::consts::EXE_SUFFIX));
        let mut summary = String::new();
        for name in names {
            // The name of a schema does not say where its first word ends, and that of a spectrum of a code leaves it out.
            let ways = [
                vec![name.as_str()],
                name.splitn(2, '-').collect(),
                vec!["motion", name.as_str()],
            ];
            let found = ways.iter().find_map(|words| help(&program, words).ok());
            let (help, words) = found.ok_or_else(|| format!("{name}: no such command"))?;
            let mut page = format!("# freestand {words}\n\n```text\n{}\n```\n", help.trim_end());
            for (kind, title, lead) in [
                (
                    "request",
                    "Keys of a request",
                    "The same as flags, as keys of a JSON request to the page's server, and as arguments in Python.",
                ),
                (
                    "response",
                    "Values of the JSON document",
                    "What `--json` prints, and the attributes of the result in Python.",
                ),
            ] {
                let from = PathBuf::from(format!("docs/schema/{name}.{kind}.json"));
                if !self.root.join(&from).exists() {
                    continue;
                }
                self.file(&from)?;
                let schema: Value = serde_json::from_str(&read(&self.root.join(&from))?)
                    .map_err(|error| format!("{}: {error}", from.display()))?;
                page += &format!(
                    "\n## {title}\n\n{lead} [JSON schema](../../docs/schema/{name}.{kind}.json)\n\n"
                );
                page += &table(&schema);
            }
            self.write(&format!("reference/commands/{name}.md"), &page)?;
            summary += &format!("  - [{words}](reference/commands/{name}.md)\n");
        }
        Ok(summary)
    }

    /// Links to the notebooks, which are run for the site.
    fn notebooks(&self) -> Result<(), String> {
        let mut page =
            "# Notebooks\n\nEach was run for this page: code, results and figures.\n\n".to_owned();
        for path in files_of(&self.root.join("examples/notebooks"))? {
            let name = path
                .file_stem()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            if name.starts_with(|first: char| first.is_ascii_digit()) {
                let text = read(&path)?;
                let title = text
                    .lines()
                    .find_map(|line| line.strip_prefix("# # "))
                    .unwrap_or(&name);
                page += &format!("* [{title}](../notebooks/{name}.html)\n");
            }
        }
        self.write("reference/notebooks.md", &page)
    }
}

/// A path, or a text with paths, whose README is called otherwise: mdBook gives a README the name index.html, but links to
/// it another one.
fn as_page(text: &str) -> String {
    text.replace("README.md", "overview.md")
        .replace(START, "start.md")
}

/// The help of a command, and its name.
fn help(program: &Path, words: &[&str]) -> Result<(String, String), String> {
    let output = Command::new(program).args(words).arg("--help").output();
    let text = ended(&words.join(" "), output)?;
    Ok((String::from_utf8_lossy(&text).into_owned(), words.join(" ")))
}

/// Names, types and meanings of the values of a schema, with those inside of objects and lists.
fn table(schema: &Value) -> String {
    let mut rows = Vec::new();
    add_rows(&mut rows, "", schema);
    if rows.is_empty() {
        return String::new();
    }
    format!(
        "| name | type | meaning |\n|---|---|---|\n{}",
        rows.concat()
    )
}

fn add_rows(rows: &mut Vec<String>, outer: &str, schema: &Value) {
    for (name, value) in schema["properties"].as_object().into_iter().flatten() {
        let kinds: Vec<&str> = match &value["type"] {
            Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
            kind => kind.as_str().into_iter().collect(),
        };
        let meaning = value["description"]
            .as_str()
            .unwrap_or_default()
            .replace('|', "\\|")
            .replace('<', "&lt;")
            .replace('\n', " ");
        let row = format!("| `{outer}{name}` | {} | {meaning} |\n", kinds.join(", "));
        // A document with several forms has some names in each.
        if !rows.contains(&row) {
            rows.push(row);
        }
        add_rows(rows, &format!("{outer}{name}."), value);
        add_rows(rows, &format!("{outer}{name}[]."), &value["items"]);
    }
    for form in schema["anyOf"].as_array().into_iter().flatten() {
        add_rows(rows, outer, form);
    }
}

/// Where the links of a document lead; what has a space in it is code.
pub fn links(text: &str) -> impl Iterator<Item = &str> {
    let parts = text.split("](").skip(1);
    parts.filter_map(|part| {
        let target = part.split_once(')')?.0;
        (!target.contains(char::is_whitespace)).then_some(target)
    })
}

/// What is wrong with links and sources of the built pages: what they name must be there, and nothing is loaded from
/// elsewhere.
fn faults(built: &Path) -> Result<Vec<String>, String> {
    let mut faults = Vec::new();
    let mut folders = vec![built.to_owned()];
    while let Some(folder) = folders.pop() {
        for path in files_of(&folder)? {
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            // rustdoc and pdoc check their own.
            let is_ours =
                !path.starts_with(built.join("rust")) && !path.starts_with(built.join("python"));
            if path.extension().is_none_or(|ending| ending != "html") || !is_ours {
                continue;
            }
            let text = read(&path)?;
            for attribute in ["href=\"", "src=\""] {
                for part in text.split(attribute).skip(1) {
                    let target = part.split('"').next().unwrap_or_default();
                    let is_elsewhere = target.contains("://");
                    if is_elsewhere && attribute == "src=\"" {
                        faults.push(format!("{} loads {target}", path.display()));
                    }
                    let file = target.split(['#', '?']).next().unwrap_or_default();
                    if is_elsewhere || file.is_empty() || file.contains(':') {
                        continue;
                    }
                    let named = path
                        .parent()
                        .unwrap_or(built)
                        .join(file.replace("%20", " "));
                    // The page for what is not found speaks from the root of a server.
                    if !named.exists() && !path.ends_with("404.html") {
                        faults.push(format!(
                            "{} names {target}, which is not there",
                            path.display()
                        ));
                    }
                }
            }
        }
    }
    Ok(faults)
}

/// A path without `.` and `..`.
pub fn normal(path: &Path) -> PathBuf {
    let mut parts = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => _ = parts.pop(),
            Component::CurDir => {}
            part => parts.push(part),
        }
    }
    parts
}

pub fn files_of(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let files = fs::read_dir(folder).map_err(told(folder))?;
    let mut files: Vec<PathBuf> = files.flatten().map(|file| file.path()).collect();
    files.sort();
    Ok(files)
}

fn copy_folder(from: &Path, to: &Path) -> Result<(), String> {
    fs::create_dir_all(to).map_err(told(to))?;
    for path in files_of(from)? {
        let to = to.join(path.file_name().unwrap_or_default());
        match path.is_dir() {
            true => copy_folder(&path, &to)?,
            false => _ = fs::copy(&path, &to).map_err(told(&to))?,
        }
    }
    Ok(())
}

pub fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(told(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_hold_what_is_inside_of_lists_and_of_each_form() {
        let schema = serde_json::json!({
            "properties": {"schema": {"type": "string"}},
            "anyOf": [{"properties": {"rows": {"type": "array", "items": {
                "properties": {"rank": {"type": ["integer", "null"], "description": "1 is first"}}
            }}}}]
        });
        let table = table(&schema);
        assert!(table.contains("| `schema` | string |  |\n"));
        assert!(table.contains("| `rows[].rank` | integer, null | 1 is first |\n"));
    }
}
