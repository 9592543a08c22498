//! The second horizontal component of records.

use std::path::PathBuf;

use freestand_input::word_reader::WordReader;
use freestand_input::words::counted;
use freestand_input::written::Written;
use freestand_study::recorded::Second;

use crate::files::Files;
use crate::records::components;
use crate::request::{paths, request};

request! {
    /// Two horizontal components, and the directions in which objects may rock.
    pub struct SecondKeys under "Two horizontal components" {
        /// Use two horizontal components of each file: "both", or two by name or number, such as "1, 2"
        pub components = "both|NAME, NAME",
        /// Files with the second component, one for each file of the first
        #[arg(long, value_name = "FILE", num_args = 1.., help_heading = "Two horizontal components")]
        pub across: Vec<Written>,
        /// Step between the directions, from 0 to 180 degrees, in which objects may rock [default: 15
        /// deg]
        pub rotation_step = "ANGLE",
    }
}

impl SecondKeys {
    /// Where the second components of so many motions are.
    pub(crate) fn second(
        &self,
        read: &mut WordReader<'_>,
        motions: usize,
        files: &Files,
    ) -> Second {
        read.exclusive("components", "component");
        read.exclusive("components", "across");
        let second = read.text("components").map(components);
        let second = second.and_then(|second| read.keep("components", second));
        match self.across.as_slice() {
            [] => second.unwrap_or_default(),
            all => Second::Files(beside(read, ("across", all), motions, files)),
        }
    }
}

/// Files of which there is one for each motion.
pub(crate) fn beside(
    read: &mut WordReader<'_>,
    (key, names): (&'static str, &[Written]),
    motions: usize,
    files: &Files,
) -> Vec<PathBuf> {
    if names.len() != motions {
        read.note(
            &[key],
            format!(
                "`{key}` has {}, `motion` {motions}",
                counted(names.len(), "file")
            ),
            "name one file for each file of `motion`, in the same order",
        );
    }
    paths(read, key, names, files)
}
