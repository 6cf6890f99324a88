//! Declares pairs of equivalent functions and calls them.

/// Input of both functions: pseudo-random bytes.
pub type Frame = [u8; 32];

/// A pair of equivalent functions.
pub struct Twins {
    /// Name of the value that is packed, unpacked or accessed.
    pub case: &'static str,
    /// Name of the operation.
    pub action: &'static str,
    /// Calls both functions with arguments that are created from a frame. Panics if the results differ.
    pub call: fn(&Frame),
}

/// Returns the FNV-1a hash of a name.
pub const fn number(name: &str) -> u32 {
    let (bytes, mut at, mut hash) = (name.as_bytes(), 0, 0x811C_9DC5_u32);
    while at < bytes.len() {
        hash = (hash ^ bytes[at] as u32).wrapping_mul(0x0100_0193);
        at += 1;
    }
    hash
}

/// Declares a module with the equivalent functions `ours` and `hand`. The argument of both functions is created from a
/// [`Frame`]. The function `call` calls both and compares their results.
///
/// The functions are not inlined, so their instructions can be counted separately. Each function starts with a unique
/// number, because LLVM would merge equal functions. `call` calls both functions through pointers, so the compiler
/// cannot specialize them for their arguments. The overhead is the same for both functions.
macro_rules! pair {
    ($name:ident, $frame:ident,
     ours ($ours:ident: $ours_in:ty = $ours_make:expr) -> $ours_out:ty $ours_body:block
     hand ($hand:ident: $hand_in:ty = $hand_make:expr) -> $hand_out:ty $hand_body:block
     same ($left:ident, $right:ident) $same:expr) => {
        /// A pair of equivalent functions.
        pub mod $name {
            #[allow(unused_imports)]
            use super::*;
            use core::hint::black_box;

            const NUMBER: u32 = $crate::twins::number(module_path!());

            #[inline(never)]
            fn ours($ours: $ours_in) -> $ours_out {
                black_box(NUMBER);
                $ours_body
            }

            #[inline(never)]
            fn hand($hand: $hand_in) -> $hand_out {
                black_box(!NUMBER);
                $hand_body
            }

            pub fn call($frame: &$crate::twins::Frame) {
                let (mut left, mut right) = (*$frame, *$frame);
                let $left = {
                    #[allow(unused_variables)]
                    let $frame = &mut left;
                    black_box(ours as fn($ours_in) -> $ours_out)(black_box($ours_make))
                };
                let $right = {
                    #[allow(unused_variables)]
                    let $frame = &mut right;
                    black_box(hand as fn($hand_in) -> $hand_out)(black_box($hand_make))
                };
                assert!($same, "{} of {:02X?}", module_path!(), $frame);
            }
        }
    };
}

/// Declares `ALL`, the list of the pairs in the given modules.
macro_rules! list {
    ($($case:ident: $($action:ident),*;)*) => {
        /// All pairs of these modules.
        pub const ALL: &[$crate::twins::Twins] = &[$($(
            $crate::twins::Twins { case: stringify!($case), action: stringify!($action), call: $case::$action::call },
        )*)*];
    };
}
