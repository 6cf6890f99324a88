//! Objects that cannot be mapped into a PDO: wrong direction, or a length that is not a multiple of the granularity.

#[allow(non_camel_case_types)]
mod device {
    pub mod mappable {
        pub type flag = lexibus::Mappable<bool, lexibus::AnyPdo, 0x2000_0001>;
    }

    pub mod remappable {
        pub enum RxPdo1 {}

        impl lexibus::Remappable for RxPdo1 {
            type Direction = lexibus::Rpdo;
            type CobId = lexibus::pdo::NoCobId;
            const INDEX: u16 = 0x1600;
            const ENTRIES: usize = 8;
            const GRANULARITY: u32 = 8;
        }
    }
}

lexibus::pdo! {
    pub struct OtherDirection: lexibus_drives::demo_drive::pdo::RxPdo2 {
        controlword,
        position: position_actual_value,
    }
}

lexibus::pdo! {
    pub struct FinerThanTheDevice: device::pdo::RxPdo1 {
        flag,
    }
}

fn main() {}
