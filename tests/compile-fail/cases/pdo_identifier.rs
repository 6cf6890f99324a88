//! A PDO on EtherCAT, and a PDO without a default COB-ID, have no CANopen configuration.

#[allow(non_camel_case_types)]
mod device {
    pub mod mappable {
        pub type speed = lexibus::Mappable<i16, lexibus::AnyPdo, 0x2000_0010>;
    }

    pub mod remappable {
        pub enum Outputs {}

        impl lexibus::Remappable for Outputs {
            type Direction = lexibus::Rpdo;
            type CobId = lexibus::pdo::OnEtherCat;
            const INDEX: u16 = 0x1600;
            const ENTRIES: usize = 8;
        }

        pub enum RxPdo9 {}

        impl lexibus::Remappable for RxPdo9 {
            type Direction = lexibus::Rpdo;
            type CobId = lexibus::pdo::NoCobId;
            const INDEX: u16 = 0x1608;
            const ENTRIES: usize = 8;
        }
    }
}

lexibus::pdo! {
    pub struct OnEtherCat: device::pdo::Outputs { speed }
}

lexibus::pdo! {
    pub struct Unidentified: device::pdo::RxPdo9 { speed }
}

fn main() {
    let _ = OnEtherCat::configuration_as(0x201);
    let _ = Unidentified::configuration_as(0x201);
    let _ = Unidentified::configuration(lexibus::NodeId::new(1).unwrap());
}
