//! The EDS of a drive that is transcribed from its manual.

use std::collections::BTreeSet;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::Bus;
use lexibus_codegen::source::Source;
use lexibus_export::eds::{export, Flavour, NoteKind};

use crate::eco_support::{base, device, items, object, table};

/// The EDS of the table is one without findings, and has what CANopen has.
#[test]
fn its_eds_has_the_objects_of_canopen() {
    let compilation = table();
    let catalog = compilation.catalog.as_ref().expect("a catalogue");
    let eds = export(catalog, &catalog.devices[0], Flavour::Eds).expect("objects");
    let lost = eds.notes.iter().find(|note| note.kind == NoteKind::CoeOnly);
    assert_eq!(lost.map(|note| note.count), Some(4));
    let back = check(Source::new("eco.eds", eds.text.into_bytes()), &Options::default());
    let found: Vec<String> = back.diagnostics.list().iter().map(|found| back.one_line(found)).collect();
    assert_eq!(found, Vec::<String>::new());
    let there = device(&back);
    let indices: BTreeSet<u16> = there.groups.iter().filter_map(|group| group.index()).collect();
    assert_eq!(indices.len(), 92);
    let own = device(&compilation);
    for item in items(there) {
        let place = item.object().expect("an object");
        let printed = object(own, place.0, place.1).unwrap_or_else(|| panic!("{place:X?}"));
        let lengths = (base(there, item.ty).bits(), base(own, printed.ty).bits());
        assert_eq!((item.access, lengths.0), (printed.access_on(Bus::CanOpen), lengths.1), "{}", item.name);
    }
}
