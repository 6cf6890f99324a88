//! Tests of the functions that access devices, with simulated devices, the corpus and independent programs.

mod corpus;
mod dcf;
#[cfg(unix)]
mod interop;
mod protection;
mod simulator;
mod support;
mod traffic;
