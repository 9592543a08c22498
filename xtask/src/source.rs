//! The Rust source of the crates as tokens, without tests: what the arrows are read from.
//!
//! Tokens, not syntax trees: a parser of Rust would take longer to compile than everything else here.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

/// Texts of files by their paths from the workspace, which are written with `/`.
pub type Files = BTreeMap<String, String>;

/// The files under `folder` (`""`: all) that the name lets pass. Build outputs and hidden folders are left out.
pub fn read(root: &Path, folder: &str, wanted: fn(&str) -> bool) -> Result<Files, String> {
    let mut files = Files::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let problem = |error: std::io::Error| format!("{}: {error}", root.join(&folder).display());
        for entry in std::fs::read_dir(root.join(&folder)).map_err(problem)? {
            let entry = entry.map_err(problem)?;
            let name = entry.file_name().to_string_lossy().into_owned();
            let path = if folder.is_empty() {
                name.clone()
            } else {
                format!("{folder}/{name}")
            };
            if entry.file_type().map_err(problem)?.is_dir() {
                // Cargo marks what it builds; a module of ours is named `target`.
                if !entry.path().join("CACHEDIR.TAG").exists() && !name.starts_with('.') {
                    folders.push(path);
                }
            } else if wanted(&path) {
                files.insert(
                    path,
                    std::fs::read_to_string(entry.path()).map_err(problem)?,
                );
            }
        }
    }
    Ok(files)
}

/// The names of the crates under `crates/`.
pub fn crates(files: &Files) -> BTreeSet<&str> {
    let manifests = files
        .keys()
        .filter_map(|path| path.strip_prefix("crates/")?.strip_suffix("/Cargo.toml"));
    manifests.filter(|name| !name.contains('/')).collect()
}

/// A file of a crate, without its tests.
pub struct Module {
    pub file: String,
    /// Names of modules from the crate root, which itself has none.
    pub path: Vec<String>,
    pub tokens: TokenStream,
}

/// The modules that a crate is compiled from, found as the compiler finds them: by `mod` from `lib.rs` and `main.rs`.
pub fn modules(files: &Files, crate_name: &str) -> Result<Vec<Module>, String> {
    let mut modules = Vec::new();
    let folder = format!("crates/{crate_name}/src");
    for root in ["lib.rs", "main.rs"].map(|name| format!("{folder}/{name}")) {
        if files.contains_key(&root) {
            add_file(files, root, &folder, Vec::new(), &mut modules)?;
        }
    }
    Ok(modules)
}

/// Adds a file and the files that it declares, which lie in `folder`.
fn add_file(
    files: &Files,
    file: String,
    folder: &str,
    path: Vec<String>,
    modules: &mut Vec<Module>,
) -> Result<(), String> {
    let tokens: TokenStream = files[&file]
        .parse()
        .map_err(|error: proc_macro2::LexError| {
            format!("{file}:{}: {error}", error.span().start().line)
        })?;
    let tokens = outside_tests(tokens);
    let place = modules.len();
    add_declared(files, &file, folder, &path, &tokens, modules)?;
    modules.insert(place, Module { file, path, tokens });
    Ok(())
}

/// Adds the files that `tokens` declare, also within modules that are written in place.
fn add_declared(
    files: &Files,
    file: &str,
    folder: &str,
    path: &[String],
    tokens: &TokenStream,
    modules: &mut Vec<Module>,
) -> Result<(), String> {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    for window in tokens.windows(3) {
        let [TokenTree::Ident(keyword), TokenTree::Ident(name), body] = window else {
            continue;
        };
        if keyword != "mod" {
            continue;
        }
        let folder = format!("{folder}/{name}");
        let path: Vec<String> = path.iter().cloned().chain([name.to_string()]).collect();
        match body {
            TokenTree::Group(body) => {
                add_declared(files, file, &folder, &path, &body.stream(), modules)?
            }
            _ => {
                let places = [format!("{folder}.rs"), format!("{folder}/mod.rs")];
                let Some(child) = places.into_iter().find(|place| files.contains_key(place)) else {
                    return Err(format!(
                        "{file}:{}: no file for the module {name}",
                        name.span().start().line
                    ));
                };
                add_file(files, child, &folder, path, modules)?;
            }
        }
    }
    Ok(())
}

/// Leaves out what is compiled for tests only.
fn outside_tests(tokens: TokenStream) -> TokenStream {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut kept = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let start = at;
        let mut test = false;
        while let Some((attribute, length)) = attribute(&tokens[at..]) {
            let is_test = is_test(attribute);
            if is_test && length == 3 {
                return TokenStream::new(); // `#![cfg(test)]`
            }
            test |= is_test;
            at += length;
        }
        if test {
            let ends = |token: &TokenTree| match token {
                TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
                TokenTree::Punct(punct) => punct.as_char() == ';',
                _ => false,
            };
            at = tokens[at..]
                .iter()
                .position(ends)
                .map_or(tokens.len(), |length| at + length + 1);
            continue;
        }
        kept.extend_from_slice(&tokens[start..at]);
        if let Some(token) = tokens.get(at) {
            kept.push(match token {
                TokenTree::Group(group) => {
                    let mut inner = Group::new(group.delimiter(), outside_tests(group.stream()));
                    inner.set_span(group.span());
                    TokenTree::Group(inner)
                }
                other => other.clone(),
            });
            at += 1;
        }
    }
    kept.into_iter().collect()
}

/// The attribute that the tokens begin with, and how many of them it takes: one more for `#![…]`.
pub fn attribute(tokens: &[TokenTree]) -> Option<(&Group, usize)> {
    let is = |at: usize, c: char| matches!(tokens.get(at), Some(TokenTree::Punct(punct)) if punct.as_char() == c);
    let length = if is(0, '#') && is(1, '!') { 3 } else { 2 };
    match tokens.get(length - 1) {
        Some(TokenTree::Group(group)) if is(0, '#') && group.delimiter() == Delimiter::Bracket => {
            Some((group, length))
        }
        _ => None,
    }
}

fn is_test(attribute: &Group) -> bool {
    let text: String = attribute.stream().to_string().split_whitespace().collect();
    ["test", "cfg(test)", "cfg(doctest)"].contains(&text.as_str())
        || text.starts_with("cfg(all(test,")
}

/// The content of an attribute that is a doc comment.
pub fn doc_comment(attribute: &Group) -> Option<String> {
    let tokens: Vec<TokenTree> = attribute.stream().into_iter().collect();
    match tokens.as_slice() {
        [TokenTree::Ident(doc), _, TokenTree::Literal(text)] if doc == "doc" => {
            string(&text.to_string())
        }
        _ => None,
    }
}

/// The text of a string literal, or nothing for another literal. An escape that is not text, as `\u{…}`, stays as written.
pub fn string(literal: &str) -> Option<String> {
    if let Some(raw) = literal.strip_prefix('r') {
        return Some(
            raw.trim_matches('#')
                .strip_prefix('"')?
                .strip_suffix('"')?
                .to_owned(),
        );
    }
    let mut rest = literal.strip_prefix('"')?.strip_suffix('"')?;
    let mut text = String::new();
    while let Some(at) = rest.find('\\') {
        text.push_str(&rest[..at]);
        rest = &rest[at + 1..];
        let escaped = rest.chars().next()?;
        rest = &rest[escaped.len_utf8()..];
        match escaped {
            '\n' => rest = rest.trim_start(),
            'n' => text.push('\n'),
            't' => text.push('\t'),
            '"' | '\'' | '\\' => text.push(escaped),
            _ => text.extend(['\\', escaped]),
        }
    }
    Some(text + rest)
}

/// How many lines hold code: neither blank lines nor comments count.
pub fn code_lines(tokens: &TokenStream) -> usize {
    fn add(tokens: &TokenStream, lines: &mut BTreeSet<usize>) {
        let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
        let mut at = 0;
        while at < tokens.len() {
            match (attribute(&tokens[at..]), &tokens[at]) {
                (Some((attribute, length)), _) if doc_comment(attribute).is_some() => {
                    at += length;
                    continue;
                }
                (_, TokenTree::Group(group)) => {
                    lines.extend([
                        group.span_open().start().line,
                        group.span_close().end().line,
                    ]);
                    add(&group.stream(), lines);
                }
                (_, token) => lines.extend(token.span().start().line..=token.span().end().line),
            }
            at += 1;
        }
    }
    let mut lines = BTreeSet::new();
    add(tokens, &mut lines);
    lines.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(files: &[(&str, &str)]) -> Files {
        files
            .iter()
            .map(|(path, text)| ((*path).to_owned(), (*text).to_owned()))
            .collect()
    }

    #[test]
    fn modules_are_found_as_the_compiler_finds_them() {
        let files = files(&[
            ("crates/x/Cargo.toml", ""),
            (
                "crates/x/src/lib.rs",
                "mod a; mod b { mod c; } #[cfg(test)] mod tests; #[cfg(doctest)] struct D;",
            ),
            ("crates/x/src/a/mod.rs", "mod d;"),
            ("crates/x/src/a/d.rs", "#![cfg(test)] fn f() {}"),
            ("crates/x/src/b/c.rs", ""),
            ("crates/x/src/unused.rs", "not even Rust: '"),
        ]);
        assert_eq!(crates(&files), BTreeSet::from(["x"]));
        let modules = modules(&files, "x").unwrap();
        let found: Vec<_> = modules
            .iter()
            .map(|module| (module.file.as_str(), module.path.join("::")))
            .collect();
        assert_eq!(
            found,
            [
                ("crates/x/src/lib.rs", String::new()),
                ("crates/x/src/a/mod.rs", "a".to_owned()),
                ("crates/x/src/a/d.rs", "a::d".to_owned()),
                ("crates/x/src/b/c.rs", "b::c".to_owned()),
            ]
        );
        assert!(modules[2].tokens.is_empty());
    }

    #[test]
    fn a_missing_file_is_named() {
        let files = files(&[("crates/x/src/lib.rs", "\nmod gone;")]);
        assert_eq!(
            modules(&files, "x").err().unwrap(),
            "crates/x/src/lib.rs:2: no file for the module gone"
        );
    }

    #[test]
    fn tests_are_left_out_and_nothing_else() {
        let text = "#[test] fn a() {} /// Doc.\n #[inline] fn b(x: [u8; 2]) {} #[cfg(test)] use c::d; \
                    impl E { #[cfg(all(test, unix))] #[inline] fn f() {} fn g() {} } #[cfg(not(test))] fn h() {}";
        let kept = outside_tests(text.parse().unwrap()).to_string();
        for (name, stays) in [
            ("a", false),
            ("b", true),
            ("f", false),
            ("g", true),
            ("h", true),
        ] {
            assert_eq!(
                kept.contains(&format!("fn {name}")),
                stays,
                "{name}: {kept}"
            );
        }
        assert!(!kept.contains("use"), "{kept}");
    }

    #[test]
    fn lines_of_code_are_neither_blank_nor_comments() {
        let text = "//! Doc.\n\n// A comment.\n/// Doc.\nfn f() {\n\n    g(\"two\n lines\");\n}\n";
        assert_eq!(code_lines(&text.parse().unwrap()), 4);
    }

    #[test]
    fn strings_are_read_as_the_program_prints_them() {
        assert_eq!(
            string(
                r#""say \"x\" \
            \n end \u{b0}""#
            )
            .unwrap(),
            "say \"x\" \n end \\u{b0}"
        );
        assert_eq!(string(r###"r#"a "raw" one"#"###).unwrap(), "a \"raw\" one");
        assert!(string("'x'").is_none() && string("b\"x\"").is_none() && string("1.5").is_none());
    }
}
