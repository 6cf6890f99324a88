//! Tests the stages after the front ends, and the builder that runs all stages.

#[path = "../corpus_support/mod.rs"]
mod corpus_support;

mod builder;
mod levels;
mod numbers;
mod origins;
mod profiles;
