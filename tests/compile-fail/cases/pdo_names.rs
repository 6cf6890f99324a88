//! Objects and PDOs that can't be mapped: one that doesn't exist, one that the device doesn't map, a PDO that it doesn't have.

lexibus::pdo! {
    pub struct Misspelt: lexibus_drives::demo_drive::pdo::RxPdo2 {
        controlword,
        target_postion,
    }
}

lexibus::pdo! {
    pub struct NotMappable: lexibus_drives::demo_drive::pdo::RxPdo2 {
        controlword,
        acceleration: profile_acceleration,
    }
}

lexibus::pdo! {
    pub struct NoSuchPdo: lexibus_drives::demo_drive::pdo::RxPdo3 { controlword }
}

fn main() {}
