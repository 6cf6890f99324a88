//! Errors in the use of generated bindings: a write to a read-only object, a value of a wrong type, a misspelled name.

use lexibus::{CanOpen, Client, Error, Object};
use lexibus_drives::demo_drive::DemoDrive;

struct Bus;

impl Client for Bus {
    type Bus = CanOpen;
    type Error = ();

    fn read(&mut self, _: Object, _: &mut [u8]) -> Result<usize, Error<()>> {
        Ok(0)
    }

    fn write(&mut self, _: Object, _: &[u8]) -> Result<(), Error<()>> {
        Ok(())
    }
}

fn main() {
    let mut drive = DemoDrive::new(Bus);
    let _ = drive.statusword().write(Default::default());
    let _ = drive.target_position().write("far");
    let _ = drive.target_postion();
}
