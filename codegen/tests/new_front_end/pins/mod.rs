//! PINS: a format of one line per object, made up for the test `new_front_end`.

mod object;
mod read;

pub use read::read;
