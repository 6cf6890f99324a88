//! Two frames, declared with other libraries. Only `bilge` is used for the second frame. `ethercrab-wire` requires that
//! fields of more than eight bits are byte-aligned. `deku` (with `bit_order = "lsb"`) cannot read back a 24-bit number
//! that it has written at bit 5.

/// A frame with a word and a 32-bit number.
pub mod whole_bytes {
    use bilge::prelude::*;
    use deku::prelude::*;
    use ethercrab_wire::EtherCrabWireReadWrite;
    use packed_struct::prelude::*;

    #[derive(Clone, Copy, EtherCrabWireReadWrite)]
    #[wire(bytes = 6)]
    pub struct EtherCrab {
        #[wire(bytes = 2)]
        pub word: u16,
        #[wire(bytes = 4)]
        pub long: i32,
    }

    #[derive(Clone, Copy, DekuRead, DekuWrite)]
    #[deku(endian = "little")]
    pub struct Deku {
        pub word: u16,
        pub long: i32,
    }

    #[derive(Clone, Copy, PackedStruct)]
    #[packed_struct(endian = "lsb")]
    pub struct Packed {
        pub word: u16,
        pub long: i32,
    }

    #[bitsize(48)]
    #[derive(Clone, Copy, FromBits)]
    pub struct Bilge {
        pub word: u16,
        pub long: u32,
    }

    impl Bilge {
        /// Creates the struct. The constructor that `bilge` generates is private, so other crates cannot call it.
        #[inline]
        pub fn of(word: u16, long: u32) -> Self {
            Self::new(word, long)
        }
    }
}

/// A frame with single bits, a 3-bit enumeration, and a signed 24-bit number at bit 5.
pub mod odd_bits {
    use bilge::prelude::*;

    #[bitsize(3)]
    #[derive(Clone, Copy, FromBits)]
    pub enum Mode {
        Off,
        Position,
        /// Placeholder for the unnamed value 2. `bilge` does not allow explicit numbers in an enumeration with a fallback.
        Two,
        Velocity,
        Torque,
        #[fallback]
        Unknown(u3),
    }

    #[bitsize(48)]
    #[derive(Clone, Copy, FromBits)]
    pub struct Bilge {
        pub ready: bool,
        pub mode: Mode,
        pub referenced: bool,
        pub position: u24,
        pub overflow: bool,
        pub quality: u2,
        pub speed: u16,
    }

    impl Bilge {
        /// Creates the struct. The constructor that `bilge` generates is private, so other crates cannot call it.
        #[inline]
        pub fn of(
            ready: bool,
            mode: Mode,
            referenced: bool,
            position: u24,
            overflow: bool,
            quality: u2,
            speed: u16,
        ) -> Self {
            Self::new(ready, mode, referenced, position, overflow, quality, speed)
        }
    }
}
