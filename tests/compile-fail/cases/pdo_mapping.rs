//! Mappings that are too long for their PDO, have too many entries, or contain gaps that the device does not support.

use lexibus_drives::{demo_drive, vector_step};

#[allow(non_camel_case_types)]
mod device {
    pub mod mappable {
        pub type position = lexibus::Mappable<i64, lexibus::AnyPdo, 0x2000_0040>;
    }

    pub mod remappable {
        pub enum RxPdo1 {}

        impl lexibus::Remappable for RxPdo1 {
            type Direction = lexibus::Rpdo;
            type CobId = lexibus::pdo::NoCobId;
            const INDEX: u16 = 0x1600;
            const ENTRIES: usize = 8;
            const DUMMIES: u32 = 1 << 6;
        }
    }
}

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

lexibus::pdo! {
    pub struct GapAtTheEnd: device::pdo::RxPdo1 { position, _: 16 }
}

fn main() {}
