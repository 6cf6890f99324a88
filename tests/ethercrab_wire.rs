//! Tests the wire traits of `ethercrab` on a handwritten PDO struct, a struct of `pdo!` and a generated struct.

use lexibus::LengthError;

/// Outputs of a drive: controlword and target position.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Outputs {
    controlword: u16,
    target_position: i32,
}

impl Outputs {
    const LEN: usize = 6;

    fn pack(&self) -> [u8; 6] {
        let [a, b] = self.controlword.to_le_bytes();
        let [c, d, e, f] = self.target_position.to_le_bytes();
        [a, b, c, d, e, f]
    }

    fn unpack(data: &[u8]) -> Result<Self, LengthError> {
        let &[a, b, c, d, e, f, ..] = data else { return Err(LengthError::new(Self::LEN, data.len())) };
        Ok(Self { controlword: u16::from_le_bytes([a, b]), target_position: i32::from_le_bytes([c, d, e, f]) })
    }
}

lexibus::pdo! {
    /// A user-defined mapping.
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Fast: lexibus_drives::demo_drive::pdo::RxPdo2 { target_position }
}

lexibus::ethercrab_wire!(Outputs, Outputs::LEN);

const OUTPUTS: Outputs = Outputs { controlword: 0x000F, target_position: -2 };
const BYTES: [u8; 6] = [0x0F, 0, 0xFE, 0xFF, 0xFF, 0xFF];

/// Calls to `pack` and `unpack` must still use the struct's own methods, and not those of the traits.
#[test]
fn own_methods() {
    assert_eq!(OUTPUTS.pack(), BYTES);
    assert_eq!(Outputs::unpack(&BYTES), Ok(OUTPUTS));
    let fast = Fast { target_position: 7 };
    assert_eq!(Fast::unpack(&fast.pack()), Ok(fast));
}

#[cfg(feature = "ethercat")]
mod with_ethercrab {
    use ethercrab::{
        EtherCrabWireRead, EtherCrabWireReadSized, EtherCrabWireReadWrite, EtherCrabWireWrite, EtherCrabWireWriteSized,
    };

    use super::*;

    /// Encodes a value and decodes it again with the methods of the traits, as `ethercrab` does.
    fn echo<T: EtherCrabWireReadWrite + EtherCrabWireReadSized + EtherCrabWireWriteSized>(value: &T) -> T {
        let mut buffer = T::buffer();
        assert_eq!(buffer.as_ref().len(), T::PACKED_LEN);
        assert_eq!(value.packed_len(), T::PACKED_LEN);
        assert_eq!(value.pack_to_slice(buffer.as_mut()).expect("a buffer"), T::pack(value).as_ref());
        T::unpack_from_slice(buffer.as_ref()).expect("a buffer")
    }

    #[test]
    fn round_trip() {
        assert_eq!(echo(&OUTPUTS), OUTPUTS);
        let fast = Fast { target_position: i32::MIN };
        assert_eq!(echo(&fast), fast);
        let generated = lexibus_drives::eco::pdo::Position::unpack(&BYTES).expect("six bytes");
        assert_eq!(echo(&generated).pack(), BYTES);
        assert_eq!(<Outputs as EtherCrabWireWriteSized>::pack(&OUTPUTS), BYTES);
    }

    #[test]
    fn buffers() {
        let mut long = [0xAA; 8];
        assert_eq!(OUTPUTS.pack_to_slice(&mut long).map(<[u8]>::len), Ok(6));
        assert_eq!((&long[..6], &long[6..]), (BYTES.as_slice(), [0xAA; 2].as_slice()));
        assert_eq!(Outputs::unpack_from_slice(&long), Ok(OUTPUTS));
        assert!(OUTPUTS.pack_to_slice(&mut [0; 5]).is_err());
        assert!(Outputs::unpack_from_slice(&long[..5]).is_err());
    }
}
