//! The keys under which a person writes values: the same in files and in flags.

/// How a key is called in messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum KeyStyle {
    /// `pad_stiffness`.
    #[default]
    File,
    /// `--pad-stiffness`.
    Flag,
}
