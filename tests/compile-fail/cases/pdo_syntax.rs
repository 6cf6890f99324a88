//! Syntax errors in mappings.

use lexibus_drives::demo_drive;
use lexibus_drives::demo_drive::pdo;

lexibus::pdo! {
    pub struct NoDevice: pdo::RxPdo1 { controlword }
}

lexibus::pdo! {
    pub struct Semicolons: demo_drive::pdo::RxPdo2 { controlword; target_position }
}

lexibus::pdo! {
    pub struct Nothing: demo_drive::pdo::RxPdo2 {}
}

lexibus::pdo! {
    pub enum NoStruct: demo_drive::pdo::RxPdo2 { controlword }
}

fn main() {
    let _: pdo::RxPdo1;
}
