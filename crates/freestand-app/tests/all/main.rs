//! Requests as all shells fill them.

mod requests;
mod schemas;
mod typed;
