//! One snapshot for each case of a test, with a name that says which.

/// Compares every case with its own snapshot. The name is that of the test, the number of the case
/// and the beginning of its first line: the command that was called.
pub(crate) fn each(test: &str, cases: &[String]) {
    for (index, case) in cases.iter().enumerate() {
        let command = case
            .lines()
            .next()
            .unwrap_or_default()
            .trim_start_matches("$ freestand ");
        let words: Vec<&str> = command
            .split(|c: char| !c.is_ascii_alphanumeric())
            .filter(|word| !word.is_empty())
            .collect();
        let mut name = format!("{test}__{:02}_{}", index + 1, words.join("_"));
        name.truncate(100);
        insta::assert_snapshot!(name, case);
    }
}
