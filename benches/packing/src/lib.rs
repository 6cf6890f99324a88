//! The same two frames in the words of other libraries. The second is beyond most of them: fields of `ethercrab-wire` that
//! have more than a byte start with one, and a number of 24 bits at bit 5 that `deku` reads (with `bit_order = "lsb"`) isn't
//! what it writes back.

/// A word and a number of 32 bits.
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
        /// Its constructor is private.
        #[inline]
        pub fn of(word: u16, long: u32) -> Self {
            Self::new(word, long)
        }
    }
}

/// Single bits, three bits with names, and a signed number of 24 bits at bit 5.
pub mod odd_bits {
    use bilge::prelude::*;

    #[bitsize(3)]
    #[derive(Clone, Copy, FromBits)]
    pub enum Mode {
        Off,
        Position,
        /// The fallback of `bilge` excludes numbers of one's own.
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
        /// Its constructor is private.
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
