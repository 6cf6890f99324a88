//! What tests of lints share: the heads of tables that passages are put into, and what findings say.

#![allow(dead_code)]

use lexibus_codegen::compile::Compilation;

pub const DEVICE: &str = r#"lexibus = 1
[device]
name = "Vector Step"
"#;
pub const CANOPEN: &str = r#"lexibus = 1
[device]
name = "Vector Step"
buses = ["canopen"]
"#;
pub const REGISTERS: &str = r#"lexibus = 1
[device]
name = "Vector Step"
[defaults]
access = "rw"
[spaces.register]
canopen = { index = 0x2000 }
modbus = {}
[[chapters]]
[chapters.registers]
"#;
pub const OBJECTS: &str = "[[chapters]]\n[chapters.objects]\n";

/// What the finding with this number says.
pub fn message(compilation: &Compilation, at: usize) -> &str {
    &compilation.diagnostics.list()[at].message
}

/// What the finding with this number says to do.
pub fn help(compilation: &Compilation, at: usize) -> &str {
    compilation.diagnostics.list()[at].help.as_deref().unwrap_or_default()
}
