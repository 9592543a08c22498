//! `cargo xtask texts`: every text that a user or a newcomer reads, in one listing to be read from first to last, and the
//! places of words for which there are better ones.
//!
//! Of Rust files of the crates: string literals of at least two words, which are messages, help and sentences of reports,
//! and doc comments; tests left out. Then Markdown files, and lines of TOML and JSON files that say something in words.

use std::io::Write;
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};

use crate::source::{self, Files};

/// Words to look at, in lower case, and better ones. `…` is for other words of the same sentence.
const WORDS: &[(&str, &str)] = &[
    ("behind", "after, past, appended to, follows"),
    ("stand", "withstand, are"),
    ("stands", "withstands, is"),
    ("is no", "is not a"),
    ("are no", "are not"),
    ("be no", "not be a"),
    ("is none", "is not one"),
    ("none of", "not; say who does what"),
    ("nothing of", "say who does what"),
    ("of ours", "written by freestand"),
    ("as meant", "resolved, validated"),
    ("in the median", "half of the motions"),
    ("hold … against", "check … against"),
    ("holds … against", "checks … against"),
    ("held … against", "checked … against"),
    ("way that", "distance"),
    ("off all cushions", "airborne"),
    ("g across", "g horizontal"),
    ("upright", "vertical"),
    ("lifts overturned", "overturns it"),
    ("not known", "not given"),
    ("still to be", "not assessed"),
    ("allow to", "allow …ing"),
    ("allows to", "allows …ing"),
    ("belong into", "belong in"),
    ("belongs into", "belongs in"),
    ("hear of", "called after"),
    ("hears of", "called after"),
    ("ends in its", "is incomplete"),
    ("end in its", "are incomplete"),
    ("goes on", "continues"),
    ("go on", "continue"),
    ("beside", "compared with, next to"),
    ("for want of", "because there is no"),
    ("at hand", "available"),
    ("wish", "variation"),
    ("wishes", "variations"),
    ("topple", "overturn"),
    ("topples", "overturns"),
    ("tips over", "overturns"),
];

/// The flag of a plural after a count that is filled in.
const PLURAL: (&str, &str) = ("{count} things", "write the singular where the count is 1");

/// The most characters that `…` takes.
const MAX_GAP: usize = 60;

struct Text {
    file: String,
    line: usize,
    text: String,
}

/// Prints the texts of the files whose path begins with one of those given, or of all; with `--flagged` only those with a
/// word to look at. How often each word occurs comes last.
pub fn print(root: &Path, arguments: &[String]) -> Result<(), String> {
    let (options, places): (Vec<&String>, Vec<&String>) =
        arguments.iter().partition(|text| text.starts_with("--"));
    if let Some(unknown) = options.iter().find(|option| **option != "--flagged") {
        return Err(format!(
            "{unknown} is not an option of `texts`; there is --flagged"
        ));
    }
    let files = source::read(root, "", |path| {
        let ending = path.rsplit('.').next().unwrap_or_default();
        path.starts_with("crates/") && ["rs", "toml", "json"].contains(&ending)
            || path.starts_with("examples/") && ending == "toml"
            || ending == "md"
    })?;
    let mut texts = texts(&files)?;
    texts.retain(|text| {
        places.is_empty()
            || places
                .iter()
                .any(|place| text.file.starts_with(place.as_str()))
    });
    if texts.is_empty() {
        return Err("no file of the workspace with a text has such a path".to_owned());
    }
    let words: Vec<_> = WORDS.iter().chain([&PLURAL]).collect();
    let mut counts = vec![0; words.len()];
    let mut listing = String::new();
    for Text { file, line, text } in &texts {
        let flags = flags(text);
        for (count, more) in counts.iter_mut().zip(&flags) {
            *count += more;
        }
        let found = words.iter().zip(&flags).filter(|(_, count)| **count > 0);
        let found: Vec<&str> = found.map(|((word, _), _)| *word).collect();
        if options.is_empty() {
            listing.push_str(&format!("{file}:{line}: {text}\n"));
        } else if !found.is_empty() {
            listing.push_str(&format!("{file}:{line}: [{}] {text}\n", found.join(", ")));
        }
    }
    listing.push_str(&format!("\n{} texts; words to look at:\n", texts.len()));
    for ((word, better), count) in words.iter().zip(counts).filter(|(_, count)| *count > 0) {
        listing.push_str(&format!("{count:>6}  {word:<18} {better}\n"));
    }
    match std::io::stdout().write_all(listing.as_bytes()) {
        // The reader has seen enough (`| head`).
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        written => written.map_err(|error| error.to_string()),
    }
}

fn texts(files: &Files) -> Result<Vec<Text>, String> {
    let mut texts = Vec::new();
    for name in source::crates(files) {
        for module in source::modules(files, name)? {
            add_rust(&module.file, &module.tokens, &mut texts);
        }
    }
    for (file, text) in files
        .iter()
        .filter(|(file, _)| !file.ends_with(".rs") && !file.ends_with("Cargo.toml"))
    {
        if file.ends_with(".md") {
            add_paragraphs(
                file,
                text.lines()
                    .enumerate()
                    .map(|(i, line)| (i + 1, line.to_owned())),
                &mut texts,
            );
        } else {
            let said = text.lines().enumerate().filter(|(_, line)| is_said(line));
            texts.extend(said.map(|(i, line)| Text {
                file: file.clone(),
                line: i + 1,
                text: joined(line),
            }));
        }
    }
    Ok(texts)
}

/// Doc comments and string literals, in their order.
fn add_rust(file: &str, tokens: &TokenStream, texts: &mut Vec<Text>) {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    let mut at = 0;
    while at < tokens.len() {
        let mut doc = Vec::new();
        while let Some((attribute, length)) = source::attribute(&tokens[at..])
            && let Some(text) = source::doc_comment(attribute)
        {
            let line = tokens[at].span().start().line;
            doc.extend(
                text.lines()
                    .enumerate()
                    .map(|(i, text)| (line + i, text.trim_start().to_owned())),
            );
            at += length;
        }
        if !doc.is_empty() {
            add_paragraphs(file, doc.into_iter(), texts);
            continue;
        }
        match &tokens[at] {
            TokenTree::Group(group) => add_rust(file, &group.stream(), texts),
            TokenTree::Literal(literal) => {
                let line = literal.span().start().line;
                let text = source::string(&literal.to_string()).filter(|text| is_said(text));
                texts.extend(text.map(|text| Text {
                    file: file.to_owned(),
                    line,
                    text: joined(&text),
                }));
            }
            _ => {}
        }
        at += 1;
    }
}

/// Paragraphs, items of lists and rows of tables, each as one line; what is between code fences is left out.
fn add_paragraphs(file: &str, lines: impl Iterator<Item = (usize, String)>, texts: &mut Vec<Text>) {
    let mut paragraph: Option<Text> = None;
    let mut in_code = false;
    for (line, text) in lines {
        let is_fence = text.trim_start().starts_with("```");
        in_code ^= is_fence;
        let begins = ["#", "|", "* ", "- "]
            .iter()
            .any(|mark| text.trim_start().starts_with(mark));
        if is_fence || in_code || begins || text.trim().is_empty() {
            texts.extend(paragraph.take());
        }
        if is_fence || in_code || text.trim().is_empty() {
            continue;
        }
        let text = joined(&text);
        match &mut paragraph {
            Some(paragraph) => paragraph.text.extend([" ", &text]),
            None => {
                paragraph = Some(Text {
                    file: file.to_owned(),
                    line,
                    text,
                })
            }
        }
    }
    texts.extend(paragraph);
}

/// On one line, with single spaces.
fn joined(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether a text says something: two words at least.
fn is_said(text: &str) -> bool {
    let is_word = |word: &&str| word.chars().filter(|c| c.is_alphabetic()).count() >= 2;
    text.trim().contains(char::is_whitespace)
        && text.split_whitespace().filter(is_word).count() >= 2
}

/// How often each of the words occurs, and last how often a plural follows a count that is filled in.
fn flags(text: &str) -> Vec<usize> {
    let text = text.to_lowercase();
    let plurals = text.split("} ").skip(1).filter(|rest| {
        let word = rest
            .split(|c: char| !c.is_alphabetic())
            .next()
            .unwrap_or_default();
        word.len() > 3
            && word.ends_with('s')
            && !word.ends_with("ss")
            && word != "does"
            && word != "this"
    });
    WORDS
        .iter()
        .map(|(words, _)| occurrences(&text, words))
        .chain([plurals.count()])
        .collect()
}

/// How often whole words occur in a text, both in lower case.
fn occurrences(text: &str, words: &str) -> usize {
    let (first, last) = words.split_once(" … ").unwrap_or((words, ""));
    let whole = |text: &str, at: usize, length: usize| {
        let outside =
            |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric() && c != '_' && c != '-');
        outside(text[..at].chars().next_back()) && outside(text[at + length..].chars().next())
    };
    let follows = |rest: &str| {
        let gap: String = rest
            .chars()
            .take_while(|c| !['.', ';', ':'].contains(c))
            .take(MAX_GAP)
            .collect();
        last.is_empty()
            || gap
                .match_indices(last)
                .any(|(at, _)| whole(&gap, at, last.len()))
    };
    let found = text
        .match_indices(first)
        .filter(|(at, _)| whole(text, *at, first.len()));
    found
        .filter(|(at, _)| follows(&text[at + first.len()..]))
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_people_read_is_listed_with_its_place() {
        let rust = "//! First,\n//! second.\n//!\n//! ```\n//! let code;\n//! ```\n//! Third one.\nmod a;\n\
                    /// Doc of `f`.\nfn f() { print!(\"{x} is \\\n   said\"); g(\"key\", \"a_b c_d\", \"12 m\") }\n\
                    #[cfg(test)] mod tests { const T: &str = \"not a message\"; }";
        let files = [
            ("crates/x/Cargo.toml", "description = \"two words\""),
            ("crates/x/src/lib.rs", rust),
            ("crates/x/src/a.rs", "#[error(\"no such file\")]\nstruct E;"),
            (
                "README.md",
                "# A title\ntext over\ntwo lines\n\n* an item\n* another",
            ),
            (
                "examples/study.toml",
                "# The study.\nkey = 1\nname = \"Two words\"",
            ),
        ];
        let files = files
            .iter()
            .map(|(path, text)| ((*path).to_owned(), (*text).to_owned()))
            .collect();
        let found = texts(&files).unwrap();
        let found: Vec<String> = found
            .iter()
            .map(|Text { file, line, text }| format!("{file}:{line}: {text}"))
            .collect();
        assert_eq!(
            found,
            [
                "crates/x/src/lib.rs:1: First, second.",
                "crates/x/src/lib.rs:7: Third one.",
                "crates/x/src/lib.rs:9: Doc of `f`.",
                "crates/x/src/lib.rs:10: {x} is said",
                "crates/x/src/lib.rs:11: a_b c_d",
                "crates/x/src/a.rs:1: no such file",
                "README.md:1: # A title text over two lines",
                "README.md:5: * an item",
                "README.md:6: * another",
                "examples/study.toml:1: # The study.",
                "examples/study.toml:3: name = \"Two words\"",
            ]
        );
    }

    #[test]
    fn words_are_found_whole_and_across_a_gap() {
        for (text, words, count) in [
            ("zeros behind the record, behind it", "behind", 2),
            ("understands and stands-alone stands.", "stands", 1),
            ("is none, is no folder", "is no", 1),
            ("hold the models against theirs", "hold … against", 1),
            ("hold them. against", "hold … against", 0),
        ] {
            assert_eq!(occurrences(text, words), count, "{text}");
        }
        let plural = |text: &str| *flags(text).last().unwrap();
        assert_eq!(
            [
                "{} motions",
                "{count} objects and {x:.1} s",
                "{x} is 3, {y} mass"
            ]
            .map(plural),
            [1, 1, 0]
        );
    }
}
