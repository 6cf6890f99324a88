//! Items that the Eco has only on some buses. The item for the following error (position deviation) has no Modbus register,
//! the EtherCAT error codes have no CANopen object, and the Modbus register `save_to_flash` has no object.

use lexibus::{CanOpen, Client, CoE, Modbus};
use lexibus_drives::eco::{objects, Eco};

fn on_modbus<C: Client<Bus = Modbus>>(mut client: C) {
    let _ = objects::STATUS_WORD.at(&mut client).read();
    let _ = objects::FOLLOWING_ERROR_ACTUAL_VALUE.at(&mut client).read();
}

fn on_canopen<C: Client<Bus = CanOpen>>(mut client: C) {
    let _ = objects::STATUS_WORD.at(&mut client).read();
    let _ = objects::ERROR_CODES.at(&mut client).read();
}

fn on_ethercat<C: Client<Bus = CoE>>(client: C) {
    let mut drive = Eco::new(client);
    let _ = drive.error_codes().read();
    let _ = drive.save_parameters().write(0x11);
    let _ = drive.save_to_flash().write(0x11);
}

fn main() {}
