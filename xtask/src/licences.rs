//! Licences and sources of what the program is made of, by cargo-deny, which is installed only when someone wants it.

use std::path::Path;
use std::process::Command;

/// Why the check cannot run.
pub fn missing() -> Option<String> {
    let version = Command::new("cargo").args(["deny", "--version"]).output();
    let is_there = version.is_ok_and(|output| output.status.success());
    (!is_there).then(|| "`cargo install cargo-deny` fetches the tool".to_owned())
}

/// Compares all dependencies with `deny.toml`, without a network.
pub fn check(root: &Path) -> Result<(), String> {
    let arguments = ["deny", "--offline", "check", "licenses", "bans", "sources"];
    let status = Command::new("cargo")
        .args(arguments)
        .current_dir(root)
        .status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(status.to_string()),
        Err(error) => Err(format!("cannot run cargo: {error}")),
    }
}
