//! Expected texts of the manufacturer hardware version and software version.

use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::ir::Device;

use super::object::find;
use crate::declared::{DeclaredNode, ObjectName};
use crate::syntax::At;

/// Indices of the manufacturer hardware version and of the manufacturer software version.
const VERSIONS: [u16; 2] = [0x1009, 0x100A];

/// Returns the expected hardware version and software version. Reports an expected version if the
/// device does not have its object.
pub(super) fn resolve(device: &Device, declared: &DeclaredNode, diagnostics: &mut Diagnostics) -> [Option<String>; 2] {
    let mut versions = [None, None];
    for ((expected, index), version) in declared.versions.iter().zip(VERSIONS).zip(&mut versions) {
        let Some(expected) = expected else { continue };
        let object = At::new(ObjectName::Address(index, 0), expected.span);
        *version = find(device, &object, diagnostics).map(|_| expected.value.clone());
    }
    versions
}
