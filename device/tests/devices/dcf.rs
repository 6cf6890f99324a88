//! Backups as DCF: values that the export of a description has to keep.

use crate::support::described;
use lexibus::AbortCode;
use lexibus_device::backup::{backup, Backup, Options};
use lexibus_device::{Address, Connection, Failure, Network};

/// An EDS in which the PDO has no sections: its objects follow from NrOfTXPDO and CompactPDO.
const EDS: &str =
    "[FileInfo]\nFileName=compact.eds\nEDSVersion=4.0\n[DeviceInfo]\nVendorName=Example\nVendorNumber=1\n\
    ProductName=Compact\nProductNumber=2\nRevisionNumber=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nCompactPDO=0x3\nGranularity=8\n\
    [ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\
    [2000]\nParameterName=Value\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\nPDOMapping=1\n";

/// A device that returns one byte with the value 1 for 0x1800:02 and for sub-index 0 of all objects except 0x2000. For all other
/// objects and sub-indices, it returns four bytes with the value 7.
struct Sevens;

impl Connection for Sevens {
    fn network(&self) -> Network {
        Network::CanOpen
    }

    fn read(&mut self, address: Address, _: usize) -> Result<Vec<u8>, Failure> {
        match address.object().map(|object| (object.index, object.sub_index)) {
            Some((0x1800, 2) | (_, 0)) if address.object().is_some_and(|object| object.index != 0x2000) => Ok(vec![1]),
            Some(_) => Ok(vec![7, 0, 0, 0]),
            None => Err(Failure::Abort(AbortCode::NO_OBJECT)),
        }
    }

    fn write(&mut self, _: Address, _: &[u8]) -> Result<(), Failure> {
        Err(Failure::Abort(AbortCode::READ_ONLY))
    }
}

#[test]
fn implicit_pdos_keep_their_saved_parameters() {
    let description = described("compact.eds", EDS, Network::CanOpen);
    let saved = backup(&description, &mut Sevens, &Options::default()).expect("a backup");
    assert!(saved.entries.iter().any(|entry| entry.address_text == "0x1800:01"), "{saved:?}");
    let dcf = saved.dcf(&description).expect("a DCF");
    assert_eq!(dcf.lost, [], "{}", dcf.text);
    let read = Backup::of_description(&described("backup.dcf", &dcf.text, Network::CanOpen));
    assert_eq!(read.values(), saved.values());
}
