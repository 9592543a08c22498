//! Pieces of text files that readers share: lines, numbers, tables, headings, units, time steps.
//! Nothing here knows a format.

pub(crate) mod cells;
pub(crate) mod dialect;
pub(crate) mod digit_style;
pub(crate) mod direction;
pub(crate) mod even_grid;
pub(crate) mod fixed_width;
pub(crate) mod fortran;
pub(crate) mod gaps;
pub(crate) mod head;
pub(crate) mod headings;
pub(crate) mod keyed;
pub(crate) mod line_width;
pub(crate) mod lines;
pub(crate) mod pairs;
pub(crate) mod rows;
pub(crate) mod sampling;
pub(crate) mod sensitivity;
pub(crate) mod stated_step;
pub(crate) mod table;
pub(crate) mod units;
