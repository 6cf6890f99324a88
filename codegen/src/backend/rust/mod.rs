//! The Rust back end: one module a device.
//!
//! [`emit`] turns a device into plain data (`model`), which the template `templates/rust/device.rs.txt` writes down.
//! The template is the shape of the output; `layout` then breaks the lines that are too long, where and how
//! `prettyplease` would.

mod docs;
mod layout;
mod literal;
mod model;
mod options;
mod pdo;
mod profinet;
mod value_type;

pub use options::{Presence, RustOptions};

use askama::Template;

use crate::ir::{Catalog, Device, FileInfo, Format};
use model::Model;

/// The number of the interface between generated code and the runtime: `lexibus::interface::VERSION`.
pub const INTERFACE_VERSION: u32 = 1;

#[derive(Template)]
#[template(path = "rust/device.rs.txt", escape = "none")]
struct DeviceTemplate<'a> {
    m: Model<'a>,
}

/// The Rust module for all of `catalog`; `None` where it describes nothing that code could be generated for.
///
/// One device is the module itself; several are a module each.
pub fn emit_catalog(catalog: &Catalog, options: &RustOptions) -> Option<String> {
    let file = catalog.files.first()?;
    if file.format == Format::Gsdml {
        return profinet::emit(catalog, file, options);
    }
    Some(emit(catalog.devices.first()?, file, options))
}

/// The Rust module for `device`, which `file` describes.
///
/// The text is the content of a module: it can be a file of its own or be included inside of `mod name { … }`.
pub fn emit(device: &Device, file: &FileInfo, options: &RustOptions) -> String {
    let model = Model::new(device, file, options);
    let mut text = String::with_capacity(model.size_hint());
    // Writing to a String can't fail, and the template calls nothing that does.
    let _ = DeviceTemplate { m: model }.render_into(&mut text);
    layout::fit(&text)
}

/// The name of the device's type, and so of its file, where nobody chose another one.
pub fn device_name(device: &Device, file: &FileInfo) -> String {
    model::device_name(device, file, None)
}

/// The name of the module for `device`: its type's in the case of modules.
pub fn module_name(device: &Device, file: &FileInfo) -> String {
    model::module_name(device, file)
}

/// The name of the file for an input of this stem: its words in the case of modules; `None` where it has none.
pub fn file_name(stem: &str) -> Option<String> {
    model::stem_name(stem)
}
