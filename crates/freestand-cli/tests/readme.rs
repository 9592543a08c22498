//! The README and the pages in `docs/` show what their commands really print.

use std::path::Path;

#[test]
fn commands_of_the_documentation_print_what_it_says() {
    // The records that the commands name are relative to the repository.
    std::env::set_current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")).unwrap();
    trycmd::TestCases::new().case("README.md").case("docs/*.md");
}
