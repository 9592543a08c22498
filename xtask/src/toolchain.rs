//! The version of Rust: `rust-version` in Cargo.toml is the one that everything is tested with, no older
//! and no newer one.

use std::path::Path;
use std::process::Command;

use crate::site;
use crate::tools::ended;

/// Compares the version with the one that CI installs.
///
/// # Errors
/// Another one, or none.
pub fn check(root: &Path) -> Result<(), String> {
    let version = stated(root)?;
    for path in site::files_of(&root.join(".github/workflows"))? {
        for installed in installed(&site::read(&path)?) {
            if installed != version {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                return Err(format!(
                    "{name} installs Rust {installed}, but rust-version in Cargo.toml is {version}"
                ));
            }
        }
    }
    Ok(())
}

/// Why what is tested here says nothing of `rust-version`: the compiler is another one.
///
/// # Errors
/// No compiler.
pub fn differs(root: &Path) -> Result<Option<String>, String> {
    let version = stated(root)?;
    let output = Command::new("rustc").arg("--version").output();
    let text = ended("rustc --version", output)?;
    let text = String::from_utf8_lossy(&text);
    Ok(other(&version, text.trim())
        .then(|| format!("{} is here, the checks are for Rust {version}", text.trim())))
}

/// Whether a compiler has another version than `1.95`.
fn other(version: &str, compiler: &str) -> bool {
    let number = compiler.split_whitespace().nth(1).unwrap_or_default();
    let rest = number.strip_prefix(version);
    !rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

fn stated(root: &Path) -> Result<String, String> {
    let text = site::read(&root.join("Cargo.toml"))?;
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("rust-version = \""));
    let version = line.and_then(|line| line.split('"').next());
    version
        .map(str::to_owned)
        .ok_or_else(|| "Cargo.toml has no rust-version".to_owned())
}

/// The versions that a workflow installs.
fn installed(workflow: &str) -> Vec<&str> {
    workflow
        .split("rustup toolchain install ")
        .skip(1)
        .filter_map(|rest| rest.split_whitespace().next())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_compared_as_numbers() {
        for (compiler, is_other) in [
            ("rustc 1.95.0 (abc 2026-04-14)", false),
            ("rustc 1.95.1", false),
            ("rustc 1.96.0 (abc 2026-04-14)", true),
            ("rustc 1.950.0", true),
            ("rustc", true),
        ] {
            assert_eq!(other("1.95", compiler), is_other, "{compiler}");
        }
        let text =
            "- run: rustup toolchain install 1.95 --profile minimal && rustup default 1.95\n";
        assert_eq!(installed(text), ["1.95"]);
    }
}
