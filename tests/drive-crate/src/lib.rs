//! The driver of a pump, generated from its EDS.
#![no_std]
#![deny(warnings, missing_docs, clippy::all)]

/// The bindings that `build.rs` generates.
pub mod pump {
    include!(concat!(env!("OUT_DIR"), "/pump.rs"));
}

lexibus::dictionary! {
    /// The bindings that the macro generates.
    pub mod by_macro = "pump.eds" { device_name: "MacroPump", serde: true, defmt: true }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use lexibus::{CanOpen, Client, Error, NodeId, Object};
    use std::collections::BTreeMap;
    use std::vec::Vec;

    use super::by_macro::MacroPump;
    use super::pump::{self, pdo, Pump};

    /// A simulated device: the value of each object, by index and sub-index.
    #[derive(Default)]
    struct Memory(BTreeMap<(u16, u8), Vec<u8>>);

    impl Client for Memory {
        type Bus = CanOpen;
        type Error = &'static str;

        fn read(&mut self, at: Object, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>> {
            let value = self.0.get(&(at.index, at.sub_index)).ok_or(Error::Client("no such object"))?;
            buffer.get_mut(..value.len()).ok_or(Error::Client("too long"))?.copy_from_slice(value);
            Ok(value.len())
        }

        fn write(&mut self, at: Object, data: &[u8]) -> Result<(), Error<Self::Error>> {
            self.0.insert((at.index, at.sub_index), data.to_vec());
            Ok(())
        }
    }

    #[test]
    fn values_go_through_a_client() {
        let mut drive = Pump::new(Memory::default());
        drive.speed().write(1500).unwrap();
        assert_eq!(drive.speed().read().unwrap(), 1500);
        assert!(
            matches!(drive.speed().write(9000).map_err(Error::from), Err(Error::OutOfRange(_))),
            "the limit is 3000"
        );
        drive.label().write("P1").unwrap();
        let mut buffer = [0; 16];
        assert_eq!(drive.label().read_into(&mut buffer).unwrap(), "P1");
        drive.client().0.insert((0x1018, 1), std::vec![0x34, 0x12, 0, 0]);
        assert_eq!(drive.identity().vendor_id().read().unwrap(), 0x1234);
        assert_eq!(drive.into_client().0[&(0x2000, 0)], [0xDC, 0x05]);
    }

    #[test]
    fn both_entry_points_give_the_same_handles() {
        let mut drive = MacroPump::new(Memory::default());
        drive.speed().write(7).unwrap();
        assert_eq!(drive.into_client().0[&(0x2000, 0)], [7, 0]);
        assert_eq!(super::by_macro::IDENTITY, pump::IDENTITY);
        let (one, other) = (pump::objects::SPEED, super::by_macro::objects::SPEED);
        assert_eq!((one.name(), one.range(), one.initial()), (other.name(), other.range(), other.initial()));
    }

    #[test]
    fn types_have_the_traits_of_other_crates() {
        fn both<T: serde::Serialize + for<'d> serde::Deserialize<'d> + defmt::Format>() {}
        both::<super::by_macro::pdo::RxPdo1>();
    }

    #[test]
    fn pdos_pack_to_the_bytes_on_the_wire() {
        let set_points = pdo::RxPdo1 { speed: 0x0102, enable: true };
        assert_eq!(set_points.pack(), [0x02, 0x01, 0x01]);
        assert_eq!(pdo::RxPdo1::unpack(&[0x02, 0x01, 0x01]).unwrap(), set_points);
        assert!(pdo::RxPdo1::unpack(&[0x02, 0x01]).is_err());
    }

    #[test]
    fn a_pdo_is_configured_in_the_order_of_cia_301() {
        let node = NodeId::new(5).unwrap();
        let writes: Vec<_> = pdo::RxPdo1::configuration(node)
            .iter()
            .map(|write| (write.object().index, write.object().sub_index, write.data().to_vec()))
            .collect();
        assert_eq!(
            writes,
            [
                (0x1400, 1, std::vec![0x05, 0x02, 0x00, 0x80]),
                (0x1600, 0, std::vec![0]),
                (0x1600, 1, std::vec![0x10, 0x00, 0x00, 0x20]),
                (0x1600, 2, std::vec![0x01, 0x00, 0x01, 0x20]),
                (0x1600, 0, std::vec![2]),
                (0x1400, 2, std::vec![255]),
                (0x1400, 1, std::vec![0x05, 0x02, 0x00, 0x00]),
            ]
        );
    }

    #[test]
    fn tools_find_entries_in_the_table() {
        let entry = lexibus::table::find(pump::ENTRIES, 0x2000, 0).unwrap();
        assert_eq!((entry.name, entry.unit), ("Speed", ""));
        assert!(lexibus::table::find(pump::ENTRIES, 0x2000, 1).is_none());
    }
}
