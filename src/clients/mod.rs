//! Clients: thin adapters to libraries that carry the bytes, one feature each.
//!
//! | feature | module | library |
//! |---|---|---|
//! | `canopen` | `canopen` | `canopen-sdo` for the SDO protocol, `embedded-can` for the interface |
//! | `socketcan` | `canopen` | the same with SocketCAN of Linux |
//! | `ethercat` | `ethercat` | `ethercrab`; needs Rust 1.85 |
//! | `modbus` | `modbus` | `tokio-modbus`, RTU and TCP, blocking and not |
//! | `serial` | `serial` | `embedded-io`, blocking and not |

#[cfg(feature = "canopen")]
pub mod canopen;
#[cfg(feature = "ethercat")]
pub mod ethercat;
#[cfg(feature = "modbus")]
pub mod modbus;
#[cfg(feature = "serial")]
pub mod serial;
