//! `--plot`: the figures of motions and their files.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_output::figure::Figure;
use freestand_output::folder::write_file;

use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::files::path_text;

/// Whether and where to draw.
#[derive(Debug, Default, Args)]
pub(crate) struct PlotArgs {
    /// Draw a figure as FILE.svg or FILE.png; without a name, as both in the folder of --out
    #[arg(long, value_name = "FILE", num_args = 0..=1)]
    plot: Option<Option<PathBuf>>,
}

/// Where the figures are written.
#[derive(Debug)]
pub(crate) enum Target {
    Svg(PathBuf),
    Png(PathBuf),
    /// The folder of `--out`.
    Folder,
}

impl PlotArgs {
    /// The file that is named.
    pub(crate) fn file(&self) -> Option<&Path> {
        self.plot.as_ref()?.as_deref()
    }

    /// Where the figures are written; `None`: nothing is drawn.
    pub(crate) fn target(&self, global: &GlobalArgs) -> Result<Option<Target>, Failure> {
        let Some(name) = &self.plot else {
            return Ok(None);
        };
        let Some(path) = name else {
            if global.out.is_none() {
                return Err(Failure::usage(
                    "--plot needs a file or a folder to write to",
                    "name a file, --plot FILE.svg or FILE.png, or a folder with --out",
                ));
            }
            return Ok(Some(Target::Folder));
        };
        let extension = path
            .extension()
            .map(|extension| extension.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("svg") => Ok(Some(Target::Svg(path.clone()))),
            Some("png") => Ok(Some(Target::Png(path.clone()))),
            _ => Err(Failure::usage(
                format!(
                    "--plot {}: a figure is written as .svg or .png",
                    path.display()
                ),
                "write --plot FILE.svg; without a name, put --plot after the record files and add --out",
            )),
        }
    }
}

/// Writes figures, each with its name, and returns their paths.
pub(crate) fn place(
    target: &Target,
    figures: Vec<(String, Figure)>,
    files: &Files,
    inputs: &[PathBuf],
) -> Result<Vec<String>, Failure> {
    let mut paths = Vec::new();
    for (name, figure) in figures {
        match target {
            Target::Svg(path) => {
                write_file(path, figure.svg.as_bytes(), inputs)?;
                paths.push(path_text(path));
            }
            Target::Png(path) => {
                write_file(path, &figure.png, inputs)?;
                paths.push(path_text(path));
            }
            Target::Folder => paths.extend(files.drawn(&name, &figure)?),
        }
    }
    Ok(paths)
}

impl Target {
    /// Refuses one file name for several figures.
    pub(crate) fn check(&self, count: usize) -> Result<(), Failure> {
        if count == 1 || matches!(self, Self::Folder) {
            return Ok(());
        }
        Err(Failure::usage(
            format!("--plot names one file, but there are {count} motions"),
            "choose one with --component, or write --plot without a name and a folder with --out",
        ))
    }
}
