//! How pairs of functions are declared and called.

/// What the functions read: bytes that look random.
pub type Frame = [u8; 32];

/// A pair of functions.
pub struct Twins {
    /// What is packed, unpacked or accessed.
    pub case: &'static str,
    /// What is done with it.
    pub action: &'static str,
    /// Calls both functions with what a frame holds, and panics where they don't do the same.
    pub call: fn(&Frame),
}

/// A number for a name: FNV-1a.
pub const fn number(name: &str) -> u32 {
    let (bytes, mut at, mut hash) = (name.as_bytes(), 0, 0x811C_9DC5_u32);
    while at < bytes.len() {
        hash = (hash ^ bytes[at] as u32).wrapping_mul(0x0100_0193);
        at += 1;
    }
    hash
}

/// Declares a module with the functions `ours` and `hand`, which do the same with an argument that is made of a
/// [`Frame`], and `call`, which calls both and compares what they return.
///
/// Neither is inlined, so that its instructions can be told from those of others, and each begins with a number of its
/// own: LLVM merges functions that are alike, and would leave one of them nothing but a jump. Both are called
/// through a pointer, so that neither is made for the arguments that it gets here. Both pay the same for it.
macro_rules! pair {
    ($name:ident, $frame:ident,
     ours ($ours:ident: $ours_in:ty = $ours_make:expr) -> $ours_out:ty $ours_body:block
     hand ($hand:ident: $hand_in:ty = $hand_make:expr) -> $hand_out:ty $hand_body:block
     same ($left:ident, $right:ident) $same:expr) => {
        /// Both versions.
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

/// All pairs of modules that hold some, in one list.
macro_rules! list {
    ($($case:ident: $($action:ident),*;)*) => {
        /// All pairs.
        pub const ALL: &[$crate::twins::Twins] = &[$($(
            $crate::twins::Twins { case: stringify!($case), action: stringify!($action), call: $case::$action::call },
        )*)*];
    };
}
