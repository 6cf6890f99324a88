//! Mappings that are too long for their PDO, have too many entries, or contain gaps that the device does not support.

use lexibus_drives::{demo_drive, vector_step};

lexibus::pdo! {
    pub struct TooLong: vector_step::pdo::RxPdo3 {
        target_position,
        velocity: profile_velocity,
        controlword,
    }
}

lexibus::pdo! {
    pub struct TooMany: demo_drive::pdo::RxPdo1 { controlword, modes_of_operation }
}

lexibus::pdo! {
    pub struct NoDummyOfThree: demo_drive::pdo::RxPdo2 { controlword, _: 3 }
}

lexibus::pdo! {
    pub struct NoDummyInATpdo: demo_drive::pdo::TxPdo2 { statusword, _: 8 }
}

fn main() {}
