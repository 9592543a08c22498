//! Small numerical pieces that several models share.
