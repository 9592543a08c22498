//! Requests as all shells fill them.

mod assessments;
mod requests;
mod schemas;
mod typed;
