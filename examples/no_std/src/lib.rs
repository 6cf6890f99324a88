//! What both binaries stand on: a CAN controller of sorts, and expedited SDO transfers over it.
//!
//! Frames of 8 bytes go out through the standard output, and replies come in through the standard input. This is the only
//! place with `unsafe` code: there is no C library to do the calls of the system.

#![no_std]

mod linux;

pub use linux::{exchange, exit};

/// Calls a function of type `fn() -> u8` where the program starts, and exits with what it returns.
#[macro_export]
macro_rules! entry {
    ($main:path) => {
        extern "C" fn start() -> ! {
            $crate::exit($main())
        }

        // The stack is aligned to 16 bytes here, and a call keeps it as functions expect it.
        core::arch::global_asm!(".globl _start", "_start:", "call {}", sym start);
    };
}

/// A request of an SDO download of at most 4 bytes, or an upload (CiA 301 7.2.4.3.3 and 7.2.4.3.5).
#[must_use]
pub fn request(command: u8, index: u16, sub_index: u8, data: &[u8]) -> [u8; 8] {
    let [low, high] = index.to_le_bytes();
    let mut frame = [command, low, high, sub_index, 0, 0, 0, 0];
    for (to, from) in frame[4..].iter_mut().zip(data) {
        *to = *from;
    }
    frame
}
