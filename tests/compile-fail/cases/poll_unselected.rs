//! A poll is unavailable before its selection is sent, and another selection can't be sent while the device is in
//! use.

use lexibus::message::MessageClient;
use lexibus_drives::hsd::HsdMotor;

fn poll<C: MessageClient>(motor: &mut HsdMotor<C>) {
    let _ = motor.poll_speeds().send();
    let Ok(mut speeds) = motor.cmd_get_vel().select() else { return };
    let _ = speeds.poll_speeds().send();
    let _ = speeds.poll_position().send();
    let _ = speeds.cmd_get_pos().send();
}

fn select_another<C: MessageClient>(motor: &mut HsdMotor<C>) {
    let Ok(mut speeds) = motor.cmd_get_vel().select() else { return };
    let _ = motor.cmd_get_pos().send();
    let _ = speeds.poll_speeds().send();
}

fn main() {}
