//! Tests generated accessors and PDOs with independent implementations: a node of the Python library `canopen`, and
//! servers and clients of `pymodbus`. `README.md` explains the tests.
#![cfg(unix)]

#[macro_use]
mod ways;

mod canopen;
mod modbus;
mod modbus_broadcast;
mod modbus_client;
mod pty;
mod python;
mod slcan;

use std::future::Future;
use std::time::Duration;

/// Runs `work`. Fails if `work` takes longer than a minute.
fn block_on<T>(work: impl Future<Output = T>) -> T {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
    runtime.block_on(async { tokio::time::timeout(Duration::from_secs(60), work).await.expect("in time") })
}
