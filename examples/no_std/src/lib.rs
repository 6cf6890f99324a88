//! Common code of both programs: a simulated CAN controller and expedited SDO transfers.
//!
//! Frames of 8 bytes are sent through the standard output; replies arrive through the standard input. Only this crate
//! has `unsafe` code, for system calls without a C library.

#![no_std]

mod linux;

pub use linux::{exchange, exit};

/// Defines the start of the program: calls a function of type `fn() -> u8` and exits with its result.
#[macro_export]
macro_rules! entry {
    ($main:path) => {
        extern "C" fn start() -> ! {
            $crate::exit($main())
        }

        // The stack is aligned to 16 bytes here; a call gives functions the alignment that they expect.
        core::arch::global_asm!(".globl _start", "_start:", "call {}", sym start);
    };
}

/// Returns an SDO request: a download of at most 4 bytes, or an upload (CiA 301 7.2.4.3.3 and 7.2.4.3.5).
#[must_use]
pub fn request(command: u8, index: u16, sub_index: u8, data: &[u8]) -> [u8; 8] {
    let [low, high] = index.to_le_bytes();
    let mut frame = [command, low, high, sub_index, 0, 0, 0, 0];
    for (to, from) in frame[4..].iter_mut().zip(data) {
        *to = *from;
    }
    frame
}
