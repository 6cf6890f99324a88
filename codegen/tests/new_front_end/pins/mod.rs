//! The front end of PINS, a format with one line per object. The format was invented for the test `new_front_end`.

mod object;
mod read;

pub use read::read;
