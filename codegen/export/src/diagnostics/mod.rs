//! Diagnostics for other programs: JSON lines, SARIF and annotations of GitHub.
//!
//! The functions do not panic if a span of a diagnostic is outside its file.

pub mod github;
pub mod json;
mod ordered;
pub mod sarif;

#[cfg(test)]
mod tests;
