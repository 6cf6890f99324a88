//! Code that both programs use: a simulated CAN controller and expedited SDO transfers.
//!
//! The programs send frames of 8 bytes to standard output and receive replies from standard input. Only this crate
//! contains `unsafe` code, which makes system calls without a C library.

#![no_std]

mod linux;

pub use linux::{exchange, exit};

/// Defines the entry point of the program. The entry point calls a function of type `fn() -> u8` and exits with the
/// result.
#[macro_export]
macro_rules! entry {
    ($main:path) => {
        extern "C" fn start() -> ! {
            $crate::exit($main())
        }

        // The stack is aligned to 16 bytes at the entry point. The call instruction gives the function the alignment
        // that it expects.
        core::arch::global_asm!(".globl _start", "_start:", "call {}", sym start);
    };
}

/// Returns an SDO request: a download of up to 4 bytes, or an upload (CiA 301 7.2.4.3.3 and 7.2.4.3.5).
#[must_use]
pub fn request(command: u8, index: u16, sub_index: u8, data: &[u8]) -> [u8; 8] {
    let [low, high] = index.to_le_bytes();
    let mut frame = [command, low, high, sub_index, 0, 0, 0, 0];
    for (to, from) in frame[4..].iter_mut().zip(data) {
        *to = *from;
    }
    frame
}
