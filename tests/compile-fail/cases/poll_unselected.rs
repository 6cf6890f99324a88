//! A poll is available only after the request that selects it. While the value that `select` returns is in use, no other
//! selection can be sent.

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
