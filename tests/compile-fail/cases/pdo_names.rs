//! Invalid names in mappings: an unknown object, an object that cannot be mapped, and an unknown PDO.

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
