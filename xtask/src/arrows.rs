//! Arrows of use, between crates and between the files of each folder of a crate: they run one way.
//!
//! Read from `use` lines and from paths in code (`crate::x::`, `super::`, `freestand_x::`), tests left out. A name that the
//! crate root passes on (`pub use x::Name`) counts as the module that it comes from.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use proc_macro2::{Delimiter, TokenTree};

use crate::source::{self, Files, Module};

/// What a crate may use of ours, outside tests. A crate that does not exist yet takes no part.
const MAY_USE: &[(&str, &[&str])] = &[
    ("freestand-rocking", &[]),
    ("freestand", &["freestand-rocking"]),
    ("freestand-input", &[]),
    ("freestand-output", &["freestand-input"]),
    ("freestand-records", &["freestand", "freestand-input"]),
    ("freestand-scan", &["freestand", "freestand-input"]),
    (
        "freestand-study",
        &[
            "freestand",
            "freestand-input",
            "freestand-output",
            "freestand-records",
            "freestand-scan",
        ],
    ),
    (
        "freestand-inventory",
        &[
            "freestand",
            "freestand-input",
            "freestand-scan",
            "freestand-study",
        ],
    ),
    (
        "freestand-assess",
        &[
            "freestand",
            "freestand-input",
            "freestand-output",
            "freestand-records",
            "freestand-scan",
            "freestand-study",
            "freestand-inventory",
        ],
    ),
    (
        "freestand-risk",
        &[
            "freestand",
            "freestand-input",
            "freestand-output",
            "freestand-records",
            "freestand-scan",
            "freestand-study",
            "freestand-inventory",
            "freestand-assess",
        ],
    ),
    (
        "freestand-report",
        &[
            "freestand",
            "freestand-input",
            "freestand-output",
            "freestand-records",
            "freestand-scan",
            "freestand-study",
            "freestand-inventory",
            "freestand-assess",
            "freestand-risk",
        ],
    ),
    (
        "freestand-app",
        &[
            "freestand",
            "freestand-input",
            "freestand-output",
            "freestand-records",
            "freestand-scan",
            "freestand-study",
            "freestand-inventory",
            "freestand-assess",
            "freestand-risk",
            "freestand-report",
        ],
    ),
    // It knows no command.
    ("freestand-page", &["freestand-input"]),
    ("freestand-py", SHELL),
    // The command line starts the page, which is handed a function that runs a request.
    (
        "freestand-cli",
        &[
            "freestand",
            "freestand-input",
            "freestand-output",
            "freestand-records",
            "freestand-study",
            "freestand-inventory",
            "freestand-assess",
            "freestand-risk",
            "freestand-report",
            "freestand-app",
            "freestand-page",
        ],
    ),
];

const SHELL: &[&str] = &[
    "freestand",
    "freestand-input",
    "freestand-output",
    "freestand-records",
    "freestand-scan",
    "freestand-study",
    "freestand-inventory",
    "freestand-assess",
    "freestand-risk",
    "freestand-report",
    "freestand-app",
];

/// The most that one crate may hold of the lines of code.
const MAX_SHARE: f64 = 0.4;

/// How many circles of a crate are printed.
const MAX_CIRCLES: usize = 12;

/// The node of what `lib.rs` or `main.rs` holds itself.
const ROOT: &str = "(crate root)";

/// `file:line`
type Site = String;

/// The names of modules from the crate root, which itself has none.
type Place = Vec<String>;

/// A user, what it uses, and where it does so first.
type Arrows = BTreeMap<String, BTreeMap<String, Site>>;

/// The files that the check reads.
pub fn wanted(path: &str) -> bool {
    path.ends_with(".rs") || path.ends_with("/Cargo.toml")
}

/// Lines that say how large each crate is, and a text for each problem.
pub fn check(files: &Files) -> Result<(Vec<String>, Vec<String>), String> {
    let mut problems = Vec::new();
    let mut lines = BTreeMap::new();
    for name in source::crates(files) {
        let modules = source::modules(files, name)?;
        lines.insert(
            name,
            modules
                .iter()
                .map(|module| source::code_lines(&module.tokens))
                .sum(),
        );
        problems.extend(wrong_order(files, name, &modules));
        match module_arrows(name, &modules) {
            Ok(arrows) => problems.extend(
                arrows
                    .iter()
                    .flat_map(|(place, arrows)| circles(&in_words(name, place), arrows)),
            ),
            Err(hidden) => problems.push(hidden),
        }
    }
    let (shares, too_big) = shares(&lines);
    problems.extend(too_big);
    Ok((shares, problems))
}

/// A folder of modules as messages name it.
fn in_words(crate_name: &str, place: &[String]) -> String {
    let names = std::iter::once(crate_name).chain(place.iter().map(String::as_str));
    names.collect::<Vec<_>>().join("::")
}

/// What each crate has of the code, and which one has too much.
fn shares(lines: &BTreeMap<&str, usize>) -> (Vec<String>, Option<String>) {
    let all: usize = lines.values().sum();
    let share = |count: usize| count as f64 / all.max(1) as f64;
    let listed = lines
        .iter()
        .map(|(name, &count)| format!("{name:<20}{count:>7} lines{:>6.1} %", 100.0 * share(count)));
    let too_big = lines.iter().find(|&(_, &count)| share(count) >= MAX_SHARE).map(|(name, &count)| {
        let (is, most) = (100.0 * share(count), 100.0 * MAX_SHARE);
        format!("{name} holds {is:.1} % of the code ({count} of {all} lines); it must be under {most:.0} %")
    });
    (listed.collect(), too_big)
}

/// What a crate uses of ours and may not, in its manifest and in its code.
fn wrong_order(files: &Files, name: &str, modules: &[Module]) -> Vec<String> {
    let Some((_, allowed)) = MAY_USE.iter().find(|(of, _)| *of == name) else {
        return vec![format!(
            "{name}: what it may use is not stated in MAY_USE of xtask/src/arrows.rs"
        )];
    };
    let mut used: BTreeMap<String, Site> = BTreeMap::new();
    let manifest = format!("crates/{name}/Cargo.toml");
    for (dependency, line) in dependencies(&files[&manifest]) {
        used.entry(dependency)
            .or_insert(format!("{manifest}:{line}"));
    }
    for module in modules {
        for named in named_paths(module) {
            let first = named.segments[0].replace('_', "-");
            if first != name && MAY_USE.iter().any(|(of, _)| *of == first) {
                used.entry(first)
                    .or_insert(format!("{}:{}", module.file, named.line));
            }
        }
    }
    let wrong = used
        .iter()
        .filter(|(dependency, _)| !allowed.contains(&dependency.as_str()));
    wrong
        .map(|(dependency, site)| format!("{name} may not use {dependency}\n  {site}"))
        .collect()
}

/// The crates of ours among the dependencies of a manifest, those for tests left out, with their lines.
fn dependencies(manifest: &str) -> Vec<(String, usize)> {
    let mut found = Vec::new();
    let mut section = String::new();
    for (i, line) in manifest.lines().enumerate() {
        let mut add = |name: &str| {
            if MAY_USE.iter().any(|(of, _)| *of == name) {
                found.push((name.to_owned(), i + 1));
            }
        };
        if let Some(header) = line.trim().strip_prefix('[') {
            section = header.trim_end_matches(']').to_owned();
            if let Some((_, name)) = section
                .rsplit_once('.')
                .filter(|(above, _)| is_of_dependencies(above))
            {
                add(name);
            }
        } else if is_of_dependencies(&section) {
            add(line.split(['.', '=', ' ']).next().unwrap_or_default());
            if let Some((_, renamed)) = line.split_once("package = \"") {
                add(renamed.split('"').next().unwrap_or_default());
            }
        }
    }
    found
}

/// `dependencies`, `build-dependencies` and `target.….dependencies`.
fn is_of_dependencies(section: &str) -> bool {
    section.ends_with("dependencies") && !section.ends_with("dev-dependencies")
}

/// A path as it is written, at a place.
struct Named {
    segments: Vec<String>,
    line: usize,
    /// The module that it is written in.
    module: Vec<String>,
    /// The name that a `use` gives it, and whether the name is passed on.
    used_as: Option<(String, bool)>,
}

fn named_paths(module: &Module) -> Vec<Named> {
    let mut found = Vec::new();
    let tokens: Vec<TokenTree> = module.tokens.clone().into_iter().collect();
    read_paths(&tokens, &module.path, &mut found);
    found
}

fn is_punct(token: Option<&TokenTree>, c: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == c)
}

/// The two colons of a path, which the colon of a type is not.
fn is_path_separator(tokens: &[TokenTree], at: usize) -> bool {
    let joint = matches!(tokens.get(at), Some(TokenTree::Punct(punct)) if punct.spacing() == proc_macro2::Spacing::Joint);
    joint && is_punct(tokens.get(at), ':') && is_punct(tokens.get(at + 1), ':')
}

fn read_paths(tokens: &[TokenTree], module: &[String], found: &mut Vec<Named>) {
    let mut at = 0;
    while at < tokens.len() {
        match &tokens[at] {
            TokenTree::Ident(word) if word == "use" && !is_punct(tokens.get(at + 1), '<') => {
                let end = tokens[at..]
                    .iter()
                    .position(|token| is_punct(Some(token), ';'));
                let end = end.map_or(tokens.len(), |length| at + length);
                let passed_on = match at.checked_sub(1).map(|before| &tokens[before]) {
                    Some(TokenTree::Ident(before)) => before == "pub",
                    // `pub(crate)`
                    Some(TokenTree::Group(before)) => before.delimiter() == Delimiter::Parenthesis,
                    _ => false,
                };
                read_use(&tokens[at + 1..end], &[], (module, passed_on), found);
                at = end;
            }
            TokenTree::Ident(word) if word == "pub" && is_visibility(tokens.get(at + 1)) => at += 1,
            TokenTree::Ident(word) if word == "mod" => {
                if let (Some(TokenTree::Ident(name)), Some(TokenTree::Group(body))) =
                    (tokens.get(at + 1), tokens.get(at + 2))
                {
                    let inner: Vec<String> =
                        module.iter().cloned().chain([name.to_string()]).collect();
                    read_paths(
                        &body.stream().into_iter().collect::<Vec<_>>(),
                        &inner,
                        found,
                    );
                    at += 2;
                }
            }
            TokenTree::Ident(first) => {
                let mut segments = vec![first.to_string()];
                let begins = at < 2 || !is_path_separator(tokens, at - 2);
                while is_path_separator(tokens, at + 1)
                    && let Some(TokenTree::Ident(next)) = tokens.get(at + 3)
                {
                    segments.push(next.to_string());
                    at += 3;
                }
                if begins && segments.len() > 1 {
                    let line = first.span().start().line;
                    found.push(Named {
                        segments,
                        line,
                        module: module.to_vec(),
                        used_as: None,
                    });
                }
            }
            TokenTree::Group(group) => read_paths(
                &group.stream().into_iter().collect::<Vec<_>>(),
                module,
                found,
            ),
            _ => {}
        }
        at += 1;
    }
}

/// What follows `pub` in `pub(in crate::x)`: it names a module and uses nothing of it.
fn is_visibility(token: Option<&TokenTree>) -> bool {
    let Some(TokenTree::Group(group)) = token else {
        return false;
    };
    let first = group
        .stream()
        .into_iter()
        .next()
        .map(|token| token.to_string());
    group.delimiter() == Delimiter::Parenthesis
        && ["crate", "super", "self", "in"]
            .iter()
            .any(|word| first.as_deref() == Some(word))
}

/// The paths of a `use`, braces taken apart.
fn read_use(
    tokens: &[TokenTree],
    above: &[String],
    place: (&[String], bool),
    found: &mut Vec<Named>,
) {
    for piece in tokens.split(|token| is_punct(Some(token), ',')) {
        let (mut segments, mut line, mut braced, mut name) = (above.to_vec(), 0, false, None);
        let mut words = piece.iter();
        while let Some(token) = words.next() {
            match token {
                TokenTree::Ident(word) if word == "as" => {
                    name = words.next().map(ToString::to_string)
                }
                TokenTree::Ident(word) => {
                    (segments, line) = ([segments, vec![word.to_string()]].concat(), start(token))
                }
                TokenTree::Punct(punct) if punct.as_char() == '*' => {
                    (segments, line) = ([segments, vec!["*".to_owned()]].concat(), start(token));
                }
                TokenTree::Group(group) => {
                    read_use(
                        &group.stream().into_iter().collect::<Vec<_>>(),
                        &segments,
                        place,
                        found,
                    );
                    braced = true;
                }
                _ => {}
            }
        }
        if !braced && segments.len() > above.len() {
            let last = segments
                .iter()
                .rev()
                .find(|segment| *segment != "self")
                .cloned();
            let used_as = Some((name.or(last).unwrap_or_default(), place.1));
            found.push(Named {
                segments,
                line,
                module: place.0.to_vec(),
                used_as,
            });
        }
    }
}

fn start(token: &TokenTree) -> usize {
    token.span().start().line
}

/// A path from the crate root: `["a", "b"]` of `crate::a::b`, of `super::b` in the module `a::c`, and of `b` in `a`.
fn from_root(named: &Named, crate_name: &str, known: &BTreeSet<Place>) -> Option<Place> {
    let (segments, module) = (named.segments.as_slice(), named.module.as_slice());
    let first = segments[0].as_str();
    if first == "crate" || first == crate_name.replace('-', "_") {
        return Some(segments[1..].to_vec());
    }
    let after_self = usize::from(first == "self");
    let supers = segments[after_self..].iter();
    let supers = supers.take_while(|segment| *segment == "super").count();
    if after_self + supers == 0 {
        let child = [module, &segments[..1]].concat();
        return known.contains(&child).then(|| [module, segments].concat());
    }
    let above = module.len().checked_sub(supers)?;
    Some([&module[..above], &segments[after_self + supers..]].concat())
}

/// What names stand for that a module takes from elsewhere; nothing, if from another crate.
type Taken = BTreeMap<(Place, String), Option<Place>>;

/// The module that a path leads to, by the names that modules pass on; `None`: it is of another crate.
fn module_of(mut path: Place, known: &BTreeSet<Place>, taken: &Taken) -> Option<Place> {
    // As many as there are modules: names that stand for each other in a circle do not compile.
    for _ in 0..known.len() {
        let depth = (0..=path.len()).rev();
        let depth = depth.into_iter().find(|&n| known.contains(&path[..n]))?;
        let name = path.get(depth).cloned();
        match name.and_then(|name| taken.get(&(path[..depth].to_vec(), name))) {
            None => return Some(path[..depth].to_vec()),
            Some(None) => return None,
            Some(Some(from)) => path = [from.as_slice(), &path[depth + 1..]].concat(),
        }
    }
    None
}

/// The arrows between the files of each folder of modules, by its place; what is in a folder within it counts as that
/// folder. The file of a folder says what its files share, and takes no part; that of the crate does.
fn module_arrows(crate_name: &str, modules: &[Module]) -> Result<BTreeMap<Place, Arrows>, String> {
    let paths = |module: &Module| named_paths(module).into_iter();
    let named: Vec<(&str, Named)> = modules
        .iter()
        .flat_map(|module| paths(module).map(|named| (&*module.file, named)))
        .collect();
    let files: BTreeMap<&[String], &str> = modules
        .iter()
        .map(|module| (module.path.as_slice(), &*module.file))
        .collect();
    let in_place = named.iter().map(|(_, named)| named.module.clone());
    let known: BTreeSet<Place> = modules
        .iter()
        .map(|module| module.path.clone())
        .chain(in_place)
        .collect();
    let mut taken = Taken::new();
    for (file, named) in &named {
        let Some((name, _)) = &named.used_as else {
            continue;
        };
        let from = from_root(named, crate_name, &known);
        if name == "*" && named.module.is_empty() && from.is_some() {
            let line = named.line;
            return Err(format!(
                "{crate_name}: a glob at the crate root hides what is used\n  {file}:{line}"
            ));
        }
        taken.insert((named.module.clone(), name.clone()), from);
    }
    let mut arrows: BTreeMap<Place, Arrows> = BTreeMap::new();
    for (file, named) in &named {
        let Some(path) = from_root(named, crate_name, &known) else {
            continue;
        };
        let site = format!("{file}:{}", named.line);
        if path == ["*"] {
            return Err(format!(
                "{crate_name}: `use crate::*` hides what is used\n  {site}"
            ));
        }
        let (user, passed_on) = (&named.module, named.used_as.as_ref());
        let Some(used) = module_of(path, &known, &taken) else {
            continue;
        };
        let is_same_file = files.get(used.as_slice()).is_none_or(|other| other == file);
        let passes_on = used.starts_with(user) && passed_on.is_some_and(|(_, is)| *is);
        if is_same_file || passes_on {
            continue;
        }
        let shared = user.iter().zip(&used).take_while(|(a, b)| a == b).count();
        if shared > 0 && shared == user.len().min(used.len()) {
            continue;
        }
        let node = |of: &Place| of.get(shared).map_or(ROOT, String::as_str).to_owned();
        arrows
            .entry(user[..shared].to_vec())
            .or_default()
            .entry(node(user))
            .or_default()
            .entry(node(&used))
            .or_insert(site);
    }
    Ok(arrows)
}

/// The shortest circles of a crate, one for each arrow that is part of any: each has to be cut.
fn circles(crate_name: &str, arrows: &Arrows) -> Vec<String> {
    let mut found: BTreeSet<(usize, Vec<&str>)> = BTreeSet::new();
    for (user, used) in arrows {
        for next in used.keys() {
            if let Some(mut circle) = way(arrows, next, user) {
                let smallest = circle
                    .iter()
                    .enumerate()
                    .min_by_key(|(_, name)| **name)
                    .map_or(0, |(i, _)| i);
                circle.rotate_left(smallest);
                found.insert((circle.len(), circle));
            }
        }
    }
    if found.is_empty() {
        return Vec::new();
    }
    let inside: BTreeSet<&str> = found
        .iter()
        .flat_map(|(_, circle)| circle.iter().copied())
        .collect();
    let mut text = format!(
        "{crate_name}: {} modules use each other in circles",
        inside.len()
    );
    for (_, circle) in found.iter().take(MAX_CIRCLES) {
        text.push_str("\n  a circle:");
        for (i, from) in circle.iter().enumerate() {
            let to = circle[(i + 1) % circle.len()];
            text.push_str(&format!(
                "\n    {:<40} {}",
                format!("{from} -> {to}"),
                arrows[*from][to]
            ));
        }
    }
    if found.len() > MAX_CIRCLES {
        text.push_str(&format!(
            "\n  and {} more circles",
            found.len() - MAX_CIRCLES
        ));
    }
    vec![text]
}

/// The shortest way from one module to another, both named.
fn way<'a>(arrows: &'a Arrows, from: &'a str, to: &str) -> Option<Vec<&'a str>> {
    let mut ways = VecDeque::from([vec![from]]);
    let mut seen = BTreeSet::from([from]);
    while let Some(way) = ways.pop_front() {
        let last = *way.last()?;
        if last == to {
            return Some(way);
        }
        for next in arrows.get(last).into_iter().flat_map(BTreeMap::keys) {
            if seen.insert(next) {
                ways.push_back(way.iter().copied().chain([next.as_str()]).collect());
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The crate `freestand`, made of these files.
    fn arrows(files: &[(&str, &str)]) -> Result<BTreeMap<Place, Arrows>, String> {
        let files = files
            .iter()
            .map(|(path, text)| (format!("crates/freestand/src/{path}"), (*text).to_owned()));
        module_arrows(
            "freestand",
            &source::modules(&files.collect(), "freestand").unwrap(),
        )
    }

    fn text(files: &[(&str, &str)]) -> String {
        let arrows = arrows(files).unwrap();
        let found = arrows
            .iter()
            .flat_map(|(place, arrows)| circles(&in_words("freestand", place), arrows));
        found.collect::<Vec<_>>().join("\n")
    }

    /// `b` uses `a`, and the file `a.rs` is this: is that a circle?
    #[track_caller]
    fn is_circle(a: &str, expected: bool) {
        let lib = "mod a; mod b; pub use b::{Name, c::Other as Another}; pub use freestand_rocking::block;";
        let found = text(&[("lib.rs", lib), ("a.rs", a), ("b.rs", "use crate::a;")]);
        assert_eq!(found.contains("a -> b"), expected, "{a}: {found}");
    }

    #[test]
    fn every_way_to_name_a_module_is_an_arrow() {
        for a in [
            "use crate::b;",
            "use crate::b::X as Y;",
            "pub use crate::b::*;",
            "use crate::{x, b::{self, c}};",
            "use {std::fs, crate::b};",
            "use super::b;",
            "use super::{x, b};",
            "use self::super::b;",
            "use freestand::b;",
            "fn f() { crate::b::g() }",
            "fn f() -> Vec<super::b::X> { vec![] }",
            "macro_rules! m { () => { $crate::b::g() } }",
            "fn f() { println!(\"{}\", crate::b::X) }",
            "mod inner { use super::super::b; }",
            "mod inner { fn f() { super::super::b::g() } }",
            // By a name that the root passes on.
            "use crate::Name;",
            "fn f() { crate::Another::new() }",
        ] {
            is_circle(a, true);
        }
    }

    #[test]
    fn nothing_else_is_an_arrow() {
        for a in [
            "",
            "use crate::a::x;",
            "/// [`crate::b`]\nfn f() {}",
            "// use crate::b;",
            "const T: &str = \"crate::b::c\";",
            "#[cfg(test)] use crate::b;",
            "#[cfg(test)] mod tests { use crate::b; }",
            "#[test] fn f() { crate::b::g() }",
            "pub(in crate::b) fn f() {}",
            "mod inner { use super::b; }",
            "use std::b; fn f() { x::b::g(); x.b() }",
            "use crate::block;",
            "fn f() { b::g() }",
        ] {
            is_circle(a, false);
        }
    }

    #[test]
    fn a_circle_is_named_arrow_by_arrow() {
        let found = text(&[
            ("lib.rs", "mod a; mod b; mod c;"),
            ("a.rs", "\nuse crate::b;"),
            ("b/mod.rs", "mod inner;"),
            ("b/inner.rs", "\n\nfn f() { crate::c::g() }"),
            ("c.rs", "use crate::{\n  a,\n};"),
        ]);
        assert_eq!(
            found,
            "freestand: 3 modules use each other in circles\n  a circle:\
             \n    a -> b                                   crates/freestand/src/a.rs:2\
             \n    b -> c                                   crates/freestand/src/b/inner.rs:3\
             \n    c -> a                                   crates/freestand/src/c.rs:2"
        );
    }

    #[test]
    fn files_of_a_folder_are_asked_too() {
        let files = |b: &str, c: &str| {
            text(&[
                ("lib.rs", "mod a;"),
                ("a/mod.rs", "mod b; mod c; pub use b::X; struct Y;"),
                ("a/b.rs", b),
                ("a/c.rs", c),
            ])
        };
        for b in [
            "use super::c;",
            "use crate::a::c::f;",
            "fn f() { super::c::f() }",
        ] {
            // What the folder passes on is of the file that has it; what is its own is nobody's circle.
            let found = files(b, "use super::X;");
            assert!(found.starts_with("freestand::a: 2 modules"), "{b}: {found}");
            assert_eq!(files(b, "use super::Y;"), "", "{b}");
        }
    }

    #[test]
    fn the_root_takes_part_but_for_what_it_passes_on() {
        let a = ("a.rs", "use crate::{f, b::X};");
        let found = text(&[
            ("main.rs", "mod a; mod b; use b::X; fn f() { a::g() }"),
            a,
            ("b.rs", ""),
        ]);
        assert!(
            found.contains("(crate root) -> a") && found.contains("a -> (crate root)"),
            "{found}"
        );
        assert_eq!(
            text(&[
                ("lib.rs", "mod a; mod b; pub use a::g; fn f() {}"),
                a,
                ("b.rs", "")
            ]),
            ""
        );
    }

    #[test]
    fn what_hides_the_arrows_is_refused() {
        let lib = "mod a; mod b;";
        let error = arrows(&[("lib.rs", lib), ("a.rs", "use crate::*;"), ("b.rs", "")])
            .err()
            .unwrap();
        assert!(
            error.contains("use crate::*") && error.contains("a.rs:1"),
            "{error}"
        );
        let error = arrows(&[
            ("lib.rs", "mod a; mod b; pub use a::*;"),
            ("a.rs", ""),
            ("b.rs", ""),
        ])
        .err()
        .unwrap();
        assert!(
            error.contains("glob") && error.contains("lib.rs:1"),
            "{error}"
        );
    }

    /// Two crates; what is wrong with the order of the second one.
    fn order(name: &str, manifest: &str, code: &str) -> Vec<String> {
        let folder = format!("crates/{name}");
        let files: Files = [
            (format!("{folder}/Cargo.toml"), manifest.to_owned()),
            (format!("{folder}/src/lib.rs"), code.to_owned()),
        ]
        .into();
        wrong_order(&files, name, &source::modules(&files, name).unwrap())
    }

    #[test]
    fn a_wrong_arrow_between_crates_is_named() {
        for manifest in [
            "[dependencies]\nfreestand-study.workspace = true",
            "[dependencies]\nfreestand-study = { path = \"x\" }",
            "[dependencies.freestand-study]\npath = \"x\"",
            "[build-dependencies]\nstudy = { package = \"freestand-study\", path = \"x\" }",
            "[target.'cfg(unix)'.dependencies]\nfreestand-study = \"1\"",
        ] {
            let found = order("freestand-records", manifest, "");
            assert_eq!(found.len(), 1, "{manifest}");
            assert!(
                found[0].starts_with("freestand-records may not use freestand-study"),
                "{}",
                found[0]
            );
        }
        for code in [
            "use freestand_study::x;",
            "use {freestand_study as s};",
            "fn f() { freestand_study::g() }",
            "mod m { pub use freestand_study::{a, b}; }",
        ] {
            let found = order("freestand-input", "", &format!("\n{code}"));
            assert_eq!(
                found,
                [
                    "freestand-input may not use freestand-study\n  crates/freestand-input/src/lib.rs:2"
                ]
            );
        }
    }

    #[test]
    fn the_right_arrows_and_those_of_tests_pass() {
        let manifest = "[dependencies]\nfreestand.workspace = true\nserde = \"1\"\n[dev-dependencies]\n\
                        freestand-study.workspace = true\n[dev-dependencies.freestand-cli]\npath = \"x\"";
        let code = "use freestand::block; #[cfg(test)] mod tests { use freestand_study::x; }";
        assert_eq!(
            order("freestand-records", manifest, code),
            Vec::<String>::new()
        );
    }

    #[test]
    fn a_crate_without_a_place_in_the_order_is_refused() {
        assert!(order("freestand-new", "", "")[0].contains("MAY_USE"));
    }

    /// What may be used by way of others may be used: else the table has a hole. Nothing leads back.
    #[test]
    fn the_order_itself_has_no_circle() {
        let place = |name: &str| MAY_USE.iter().position(|(of, _)| *of == name).unwrap();
        for (name, allowed) in MAY_USE {
            assert!(
                allowed.iter().all(|used| place(used) < place(name)),
                "{name}"
            );
        }
    }

    #[test]
    fn one_crate_may_not_hold_too_much() {
        let (listed, too_big) = shares(&BTreeMap::from([("a", 39), ("b", 39), ("c", 22)]));
        assert_eq!((listed.len(), too_big), (3, None));
        let (_, too_big) = shares(&BTreeMap::from([("a", 40), ("b", 30), ("c", 30)]));
        assert_eq!(
            too_big.unwrap(),
            "a holds 40.0 % of the code (40 of 100 lines); it must be under 40 %"
        );
    }
}
