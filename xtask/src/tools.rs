//! Other programs, and files that cannot be read or written, in words.

use std::path::Path;
use std::process::Command;

/// Runs a program in a folder.
pub fn run(folder: &Path, program: &str, arguments: &[&str]) -> Result<(), String> {
    let status = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .status();
    let name = format!("{program} {}", arguments.join(" "));
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{status}: {name}")),
        Err(error) => Err(format!("cannot run {name}: {error}")),
    }
}

/// The output of a program that ended well.
pub fn ended(name: &str, output: std::io::Result<std::process::Output>) -> Result<Vec<u8>, String> {
    match output {
        Ok(output) if output.status.success() => Ok(output.stdout),
        Ok(output) => Err(format!(
            "{name}: {}: {}",
            output.status,
            String::from_utf8_lossy(&output.stderr)
        )),
        Err(error) => Err(format!("cannot run {name}: {error}")),
    }
}

/// A problem with a file.
pub fn told(path: &Path) -> impl Fn(std::io::Error) -> String + '_ {
    move |error| format!("{}: {error}", path.display())
}
