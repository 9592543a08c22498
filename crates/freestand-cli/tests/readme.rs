//! The README shows what its commands really print.

use std::path::Path;

#[test]
fn commands_of_the_readme_print_what_it_says() {
    // The records that it names are relative to the repository.
    std::env::set_current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")).unwrap();
    trycmd::TestCases::new().case("README.md");
}
