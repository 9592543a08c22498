//! `validate`: Table I of the paper and the closed forms. Nothing is asked.

use freestand_input::problem::Problems;

use crate::files::Files;
use crate::request::{Question, Request as _, reader, request};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.validate/1";

request! { question
    /// All checks.
    pub struct Validate {}
}

impl Question for Validate {
    type Meant = ();

    fn resolve(&self, _: &Files) -> Result<(), Problems> {
        let words = self.words();
        reader::<Self>(&words, &self.unknown)
            .problems
            .finish(Some(()))
    }
}
