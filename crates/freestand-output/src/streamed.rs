//! Output that does not fit in memory: a file that grows under a temporary name, and a document
//! whose rows are written in pieces.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::json;
use tempfile::TempPath;

use crate::facts::JsonColumn;
use crate::json::document;
use crate::paths::{clear_leftovers, io_problem, no_name, prefix_next_to, real_path, refuse_input};
use freestand_input::problem::{Problem, ProblemKind};

/// A file that is not complete yet. It gets its name on [`finish`](StreamedFile::finish). If it is
/// dropped before that, it is removed, and an existing file of that name is unchanged.
#[derive(Debug)]
pub struct StreamedFile {
    file: io::BufWriter<fs::File>,
    /// The name in messages: the one that the user gave.
    path: PathBuf,
    /// The temporary name, which tempfile removes, and the final one. `None` for a file that is
    /// written under its final name: a device, or a file in a staging folder.
    rename: Option<(TempPath, PathBuf)>,
}

impl StreamedFile {
    /// Begins the file that will become `path`, under a temporary name next to it. Files in
    /// `inputs` are never replaced.
    ///
    /// # Errors
    /// A folder that does not exist or is not writable, a folder with the file's name, or an input.
    pub fn begin(path: &Path, inputs: &[PathBuf]) -> Result<Self, Problem> {
        let inputs: Vec<PathBuf> = inputs
            .iter()
            .filter_map(|input| fs::canonicalize(input).ok())
            .collect();
        refuse_input(&inputs, path, "name another file to write")?;
        let failed = |error: io::Error| io_problem(path, "cannot write the file", &error);
        if path.is_dir() {
            return Err(Problem::new(ProblemKind::Io, "is a folder, not a file")
                .in_file(path)
                .hint("name a file"));
        }
        // A device such as /dev/null, or a pipe, is written to, not replaced by a file.
        if fs::metadata(path).is_ok_and(|data| !data.is_file()) {
            let device = fs::OpenOptions::new()
                .write(true)
                .open(path)
                .map_err(failed)?;
            return Ok(Self::of(device, path));
        }
        // A link remains a link: its target is replaced.
        let target = std::path::absolute(real_path(path)).map_err(failed)?;
        let (prefix, folder) = prefix_next_to(&target)
            .zip(target.parent())
            .ok_or_else(|| no_name(path))?;
        clear_leftovers(&target, true);
        // Created here, the file has the permissions that the umask of the user allows; tempfile
        // would give it 0600.
        let temporary = tempfile::Builder::new()
            .prefix(&prefix)
            .make_in(folder, |path| fs::File::create_new(path));
        let (file, temporary) = temporary.map_err(failed)?.into_parts();
        // Locked during writing, so that no other process takes it for a leftover. If files cannot
        // be locked, the process number shows whose it is.
        let _ = file.try_lock();
        let mut file = Self::of(file, path);
        file.rename = Some((temporary, target));
        Ok(file)
    }

    /// A file that is written under its final name; `path` is its name in messages.
    pub fn of(file: fs::File, path: &Path) -> Self {
        Self {
            file: io::BufWriter::with_capacity(1 << 16, file),
            path: path.to_path_buf(),
            rename: None,
        }
    }

    /// Appends and flushes, so that a full disk is reported here.
    ///
    /// # Errors
    /// A disk that is full.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), Problem> {
        self.file
            .write_all(bytes)
            .and_then(|()| self.file.flush())
            .map_err(|error| self.failed(&error))
    }

    /// Ends the file and gives it its name.
    ///
    /// # Errors
    /// A disk that is full, or a folder that was removed.
    pub fn finish(mut self) -> Result<(), Problem> {
        self.file.flush().map_err(|error| self.failed(&error))?;
        if let Some((temporary, target)) = self.rename.take() {
            // Else the name may reach the disk before the content does.
            self.file
                .get_ref()
                .sync_data()
                .map_err(|error| self.failed(&error))?;
            temporary
                .persist(target)
                .map_err(|error| self.failed(&error.error))?;
        }
        Ok(())
    }

    fn failed(&self, error: &io::Error) -> Problem {
        io_problem(&self.path, "cannot write the file", error)
    }
}

/// For writers of binary formats, which have a buffer of their own.
impl Write for StreamedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// The [`document`] of a body `{"rows": […], …}`, up to and including the opening of its rows.
///
/// # Errors
/// None in practice: a schema is a text.
pub fn rows_head(schema: &str) -> Result<String, Problem> {
    let (head, _) = split(schema, &json!({}), &[])?;
    Ok(format!("{head}  \"rows\": ["))
}

/// The text after the last row: the other keys of the body, and the warnings.
///
/// # Errors
/// A body that is not JSON: a defect.
pub fn rows_tail<T: Serialize>(
    schema: &str,
    others: &T,
    warnings: &[String],
) -> Result<String, Problem> {
    let (_, tail) = split(schema, others, warnings)?;
    Ok(format!("\n  ],\n{tail}"))
}

/// A document whose rows are one array for each column; `tail` is the text after its rows.
///
/// # Errors
/// None in practice: see [`rows_head`].
pub fn rows_in_columns(
    schema: &str,
    columns: &[JsonColumn],
    tail: &str,
) -> Result<Vec<u8>, Problem> {
    let mut text = rows_head(schema)?.trim_end_matches('[').as_bytes().to_vec();
    text.push(b'{');
    for (i, (name, values)) in columns.iter().enumerate() {
        text.extend(format!("{}\n    \"{name}\": [", if i == 0 { "" } else { "," }).bytes());
        // No comma precedes the first member of an array.
        text.extend(values.get(1..).unwrap_or_default());
        text.push(b']');
    }
    text.extend(b"\n  }");
    text.extend(tail.trim_start().trim_start_matches(']').bytes());
    Ok(text)
}

/// A document, split after its `schema`.
fn split<T: Serialize>(
    schema: &str,
    body: &T,
    warnings: &[String],
) -> Result<(String, String), Problem> {
    let text = document(schema, body, warnings)?;
    // The first line is the brace, the second the schema; a line end within a text is escaped.
    let end = text
        .match_indices('\n')
        .nth(1)
        .map_or(text.len(), |(index, _)| index + 1);
    let (head, tail) = text.split_at(end);
    Ok((head.to_owned(), tail.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::facts::{Facts, json_rows};

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap());
        entries.collect()
    }

    #[test]
    fn a_file_has_its_name_when_it_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rows.csv");
        fs::write(&path, "before").unwrap();
        let mut file = StreamedFile::begin(&path, &[]).unwrap();
        file.write(&vec![b'x'; 1 << 20]).unwrap();
        assert_eq!(
            (names(folder.path()).len(), fs::read(&path).unwrap()),
            (2, b"before".to_vec())
        );
        drop(file);
        assert_eq!(
            (names(folder.path()), fs::read(&path).unwrap()),
            (vec!["rows.csv".into()], b"before".to_vec())
        );
        let mut file = StreamedFile::begin(&path, &[]).unwrap();
        file.write(b"after").unwrap();
        file.finish().unwrap();
        assert_eq!(
            (names(folder.path()), fs::read(&path).unwrap()),
            (vec!["rows.csv".into()], b"after".to_vec())
        );
        // Of a process that was killed, and of one that runs: no process has a number above 2^22,
        // and 1 always runs.
        for process in [4_194_999, 1] {
            fs::write(
                folder.path().join(format!(".rows.csv.partial-{process}-0")),
                "left",
            )
            .unwrap();
        }
        drop(StreamedFile::begin(&path, &[]).unwrap());
        let mut left = names(folder.path());
        left.sort();
        if cfg!(target_os = "linux") {
            assert_eq!(left, [".rows.csv.partial-1-0", "rows.csv"]);
        }
        assert!(StreamedFile::begin(&path, std::slice::from_ref(&path)).is_err());
        assert!(StreamedFile::begin(folder.path(), &[]).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_file_has_the_permissions_of_any_new_file() {
        use std::os::unix::fs::MetadataExt;
        let folder = tempfile::tempdir().unwrap();
        let (plain, ours) = (folder.path().join("plain"), folder.path().join("ours"));
        fs::write(&plain, "").unwrap();
        StreamedFile::begin(&ours, &[]).unwrap().finish().unwrap();
        assert_eq!(
            fs::metadata(&ours).unwrap().mode(),
            fs::metadata(&plain).unwrap().mode()
        );
    }

    /// The pieces make the document that is written in one.
    #[test]
    fn rows_in_pieces_are_the_document() {
        let row = |name: &'static str, value: Option<f64>, count: usize, flag: bool| {
            Facts::default()
                .key("name", name)
                .key("value", value)
                .key("count", count)
                .key("flag", flag)
        };
        let rows = [
            row("a \"b\"\nü", Some(1e-300), 3, true),
            row("", None, 0, false),
        ];
        let timing = json!({"solve_s": 1.0});
        let warnings = ["one".to_owned()];
        let mut text = rows_head("s/1").unwrap();
        text += &String::from_utf8(json_rows(rows.iter().cloned()).unwrap()).unwrap()[1..];
        text += &rows_tail("s/1", &json!({"timing": timing}), &warnings).unwrap();
        assert_eq!(
            text,
            document("s/1", &json!({"rows": rows, "timing": timing}), &warnings).unwrap()
        );
    }
}
