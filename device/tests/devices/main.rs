//! Tests of the functions that access devices, with simulated devices, the corpus and independent programs.

#[cfg(unix)]
mod adapter;
mod corpus;
mod dcf;
#[cfg(unix)]
mod interop;
mod protection;
#[cfg(unix)]
#[path = "../../../tests/interop/pty.rs"]
mod pty;
mod simulator;
mod support;
mod traffic;
