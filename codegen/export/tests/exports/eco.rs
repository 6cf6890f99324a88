//! Tests the EDS export of a register table that was transcribed from a drive's manual.

use std::collections::BTreeSet;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::Bus;
use lexibus_codegen::source::Source;
use lexibus_export::eds::{export, Flavor, NoteKind};

use crate::eco_support::{base, device, items, object, table};

/// The exported EDS must cause no diagnostics and contain all CANopen objects of the table.
#[test]
fn its_eds_has_the_objects_of_canopen() {
    let compilation = table();
    let catalog = compilation.catalog.as_ref().expect("a catalog");
    let eds = export(catalog, &catalog.devices[0], Flavor::Eds).expect("objects");
    let lost = eds.notes.iter().find(|note| note.kind == NoteKind::CoeOnly);
    assert_eq!(lost.map(|note| note.count), Some(4));
    let back = check(Source::new("eco.eds", eds.text.into_bytes()), &Options::default());
    let reports: Vec<String> = back.diagnostics.list().iter().map(|found| back.one_line(found)).collect();
    assert_eq!(reports, Vec::<String>::new());
    let exported = device(&back);
    let indices: BTreeSet<u16> = exported.groups.iter().filter_map(|group| group.index()).collect();
    assert_eq!(indices.len(), 92);
    let original = device(&compilation);
    for item in items(exported) {
        let address = item.object().expect("an object");
        let printed = object(original, address.0, address.1).unwrap_or_else(|| panic!("{address:X?}"));
        let lengths = (base(exported, item.ty).bits(), base(original, printed.ty).bits());
        assert_eq!((item.access, lengths.0), (printed.access_on(Bus::CanOpen), lengths.1), "{}", item.name);
    }
}
