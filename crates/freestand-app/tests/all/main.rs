//! Requests as all shells fill them, and assessments from end to end.

mod assessments;
mod requests;
mod schemas;
mod typed;
