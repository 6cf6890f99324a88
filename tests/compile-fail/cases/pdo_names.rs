//! Names that can't be mapped: an unknown object, an object that can't be mapped, an unknown PDO.

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
