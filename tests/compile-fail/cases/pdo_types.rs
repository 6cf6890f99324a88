//! Mappings that contain types instead of the names of objects.

lexibus::pdo! {
    pub struct Typed: lexibus_drives::demo_drive::pdo::RxPdo2 { controlword: u16 }
}

lexibus::pdo! {
    pub struct OwnType: lexibus_drives::demo_drive::pdo::RxPdo2 { controlword: types::Controlword }
}

fn main() {}
