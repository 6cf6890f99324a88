//! Uses three of a drive's 585 registers through generated accessors.

#![no_std]
#![no_main]

use lexibus::{AbortCode, CanOpen, Client, Error, Object};
use lexibus_drives::vector_step::types::ModesOfOperation;
use lexibus_drives::vector_step::VectorStep;

/// A client for expedited SDO transfers. A program needs this code if its CAN library has no SDO client.
struct Sdo;

impl Client for Sdo {
    type Bus = CanOpen;
    type Error = ();

    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<()>> {
        let reply = no_std::exchange(&no_std::request(0x40, object.index, object.sub_index, &[]));
        let [command, _, _, _, data @ ..] = reply;
        match command {
            0x80 => Err(AbortCode(u32::from_le_bytes(data)).into()),
            0x43 | 0x47 | 0x4B | 0x4F => {
                for (to, from) in buffer.iter_mut().zip(data) {
                    *to = from;
                }
                Ok(4 - usize::from(command >> 2 & 3))
            }
            _ => Err(Error::UnexpectedReply),
        }
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<()>> {
        let unused = 4_u8.saturating_sub(data.len() as u8);
        let reply = no_std::exchange(&no_std::request(0x23 | unused << 2, object.index, object.sub_index, data));
        let [command, _, _, _, code @ ..] = reply;
        match command {
            0x80 => Err(AbortCode(u32::from_le_bytes(code)).into()),
            0x60 => Ok(()),
            _ => Err(Error::UnexpectedReply),
        }
    }
}

fn move_to(position: i32) -> Result<bool, Error<()>> {
    let mut drive = VectorStep::new(Sdo);
    drive.modes_of_operation().write(ModesOfOperation::ProfilePosition)?;
    drive.target_position().write(position)?;
    Ok(drive.statusword().read()?.fault())
}

fn main() -> u8 {
    match move_to(100_000) {
        Ok(false) => 0,
        Ok(true) => 1,
        Err(_) => 2,
    }
}

no_std::entry!(main);
