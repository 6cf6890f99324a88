//! Clients: adapters to bus libraries, with one feature per adapter.
//!
//! | feature | module | library |
//! |---|---|---|
//! | `canopen` | `canopen` | `embedded-can` for the interface |
//! | `socketcan` | `canopen` | the same, with SocketCAN on Linux |
//! | `ethercat` | `ethercat` | `ethercrab`; needs Rust 1.85 |
//! | `modbus` | `modbus` | `tokio-modbus`, RTU and TCP, blocking and async |
//! | `serial` | `serial` | `embedded-io`, blocking and async |

#[cfg(feature = "canopen")]
pub mod canopen;
#[cfg(feature = "ethercat")]
pub mod ethercat;
#[cfg(feature = "modbus")]
pub mod modbus;
#[cfg(feature = "serial")]
pub mod serial;
