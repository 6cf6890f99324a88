//! Generated accessors and PDOs against programs that nobody of this project wrote: a node of the Python library `canopen`,
//! and servers of `pymodbus`. What runs here, and how, is in `README.md`.
#![cfg(unix)]

mod canopen;
mod modbus;
mod pty;
mod python;
mod slcan;
