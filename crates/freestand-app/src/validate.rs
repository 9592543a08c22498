//! `validate`: Table I of the paper and the closed forms. Nothing is asked.

use clap::Args;
use freestand_input::problem::Problems;
use serde::Deserialize;

use crate::files::Files;
use crate::request::{Question, Request as _, Unknown, reader, request};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.validate/1";

/// All checks.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Args)]
#[serde(default)]
#[group(skip)]
pub struct Validate {
    /// Keys that are not known.
    #[arg(skip)]
    #[serde(flatten)]
    pub unknown: Unknown,
}

request!(Validate { ; unknown });

impl Question for Validate {
    type Meant = ();

    fn resolve(&self, _: &Files) -> Result<(), Problems> {
        let words = self.words();
        reader::<Self>(&words, &self.unknown)
            .problems
            .finish(Some(()))
    }
}
