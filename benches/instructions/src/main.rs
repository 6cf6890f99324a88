//! Calls all pairs of functions while `valgrind` counts their instructions. Prints the names of the pairs.

#[macro_use]
mod twins;

mod bits;
mod frames;
mod items;
mod views;

use twins::Frame;

/// Number of calls of each function. Each call gets a different input frame.
const CALLS: u64 = 100;

/// Returns pseudo-random bytes. All runs use the same bytes.
fn noise(seed: u64) -> Frame {
    let mut state = seed.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    core::array::from_fn(|_| {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 56) as u8
    })
}

fn all() -> impl Iterator<Item = &'static twins::Twins> {
    [frames::ALL, views::ALL, bits::ALL, items::ALL].into_iter().flatten()
}

fn main() {
    for twins in all() {
        println!("{} {}", twins.case, twins.action);
        (0..CALLS).for_each(|seed| (twins.call)(&noise(seed)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Calls all pairs. A call panics if the results of the two functions differ.
    #[test]
    fn generated_code_does_what_a_person_would_write() {
        all().for_each(|twins| (0..CALLS).for_each(|seed| (twins.call)(&noise(seed))));
        assert!(all().count() >= 40);
    }

    /// An enumeration field must not read the adjacent bits. Packing a value that is too large for the field must not
    /// change these bits.
    #[test]
    fn enumerations_leave_their_neighbors_alone() {
        use lexibus_instructions::axis::{pdo::Encoder, types::Mode};

        let zero = Encoder::unpack(&[0; 6]).unwrap();
        assert_eq!(Encoder::unpack(&[0xF1, 0xFF, 0, 0, 0, 0]).unwrap().mode, Mode::Off);
        assert_eq!(Encoder { mode: Mode::Unknown(0xFF), ..zero }.pack(), [0x0E, 0, 0, 0, 0, 0]);
    }
}
