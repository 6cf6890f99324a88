//! Tests names that contain markup of the exported format. Reading an exported file must give the structure of the
//! original.

use std::sync::Arc;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Catalog, Documentation, Group, Pdo};
use lexibus_codegen::source::Source;
use lexibus_export::{eds, esi, gsdml};

use crate::corpus_support::lane;
use crate::corpus_support::root::root;

/// Names with line ends, sections, keys, comments, elements, attributes, entities and control characters.
const HOSTILE: [&str; 12] = [
    "a\nAccessType=wo",
    "b\r\n[6FFF]\r\nParameterName=x",
    "c]\n[DeviceInfo]",
    "d\rDataType=1",
    "e; comment = # x",
    "f\" Evil=\"1",
    "g' Evil='1",
    "h</Name><Name>again",
    "i]]></Name><!-- ",
    "j--><Evil/>&lt;&#0;&evil;",
    "k<![CDATA[ <Evil> ",
    "l\u{0}\u{1b}[2J\u{202e}\u{feff}\u{2028}",
];

fn catalog(path: &str) -> Catalog {
    let path = root().join(path);
    let compilation = check(Source::read(&path).expect("a description"), &Options::default());
    compilation.catalog.expect("a catalog")
}

/// Renames all elements of a catalog. `name` returns the new name of the element with a given number.
fn rename(catalog: &mut Catalog, name: impl Fn(usize) -> String) {
    let mut number = 0;
    let mut next = || {
        number += 1;
        name(number)
    };
    fn groups(groups: &mut [Group], next: &mut dyn FnMut() -> String) {
        for group in groups {
            group.name = next().into();
            for item in &mut group.items {
                item.name = next().into();
                let text = next();
                item.documentation = Some(Arc::new(Documentation { text: text.into(), ..Documentation::default() }));
            }
        }
    }
    fn pdos(pdos: &mut [Pdo], next: &mut dyn FnMut() -> String) {
        for pdo in pdos {
            pdo.name = next().into();
            pdo.entries.iter_mut().for_each(|entry| entry.name = next().into());
        }
    }
    for device in &mut catalog.devices {
        device.name = next().into();
        device.identity.order_code = next().into();
        groups(&mut device.groups, &mut next);
        pdos(&mut device.process_data.pdos, &mut next);
    }
    for module in &mut catalog.modules {
        module.name = next().into();
        groups(&mut module.groups, &mut next);
        pdos(&mut module.process_data.pdos, &mut next);
    }
    for submodule in &mut catalog.submodules {
        submodule.name = next().into();
        groups(&mut submodule.records, &mut next);
        for data in [&mut submodule.input, &mut submodule.output].into_iter().flatten() {
            data.image.fields.iter_mut().for_each(|field| field.name = next().into());
        }
    }
}

/// Returns facts of a catalog that do not depend on its texts.
fn structure(catalog: &Catalog) -> Vec<String> {
    fn groups(groups: &[Group], lines: &mut Vec<String>) {
        for group in groups {
            lines.push(format!("group {:?}", group.index()));
            let of_item = |item: &lexibus_codegen::ir::Item| {
                format!("  {:?} {:?} {:?} {:?} {:?}", item.object(), item.ty, item.access, item.default, item.limits)
            };
            lines.extend(group.items.iter().map(of_item));
        }
    }
    fn pdos(pdos: &[Pdo], lines: &mut Vec<String>) {
        for pdo in pdos {
            let entries = pdo.entries.iter().map(|entry| (entry.index, entry.sub_index, entry.bits));
            lines.push(format!("pdo {:04X} {:?}", pdo.mapping_index, entries.collect::<Vec<_>>()));
        }
    }
    let mut lines = Vec::new();
    for device in &catalog.devices {
        lines.push(format!("device {:?}", device.identity.product_code));
        groups(&device.groups, &mut lines);
        pdos(&device.process_data.pdos, &mut lines);
    }
    for module in &catalog.modules {
        lines.push(format!("module {}", module.number));
        groups(&module.groups, &mut lines);
        pdos(&module.process_data.pdos, &mut lines);
    }
    for submodule in &catalog.submodules {
        lines.push(format!("submodule {}", submodule.ident));
        groups(&submodule.records, &mut lines);
        for data in [&submodule.input, &submodule.output].into_iter().flatten() {
            let fields = data.image.fields.iter().map(|field| (field.bit_offset, field.bits));
            lines.push(format!("data of {} bytes: {:?}", data.image.length, fields.collect::<Vec<_>>()));
        }
    }
    lines
}

/// Renames the elements of a catalog, exports the catalog and reads the export. Returns the structure of the result.
fn again(path: &str, name: &str, write: &dyn Fn(&Catalog) -> String, names: impl Fn(usize) -> String) -> Vec<String> {
    let mut renamed = catalog(path);
    rename(&mut renamed, names);
    let text = write(&renamed);
    let read = check(Source::new(name, text.clone().into()), &Options::default());
    let reports: Vec<String> = read.diagnostics.list().iter().map(|found| read.one_line(found)).collect();
    structure(&read.catalog.unwrap_or_else(|| panic!("{path}: {reports:?}\n{text}")))
}

fn hold(path: &str, name: &str, write: &dyn Fn(&Catalog) -> String) {
    let expected = again(path, name, write, |number| format!("name {number}"));
    assert!(expected.len() > 5, "{path}: {expected:?}");
    let step = if lane::is_full() { 1 } else { 3 };
    for at in (0..HOSTILE.len()).step_by(step) {
        let found = again(path, name, write, |number| format!("{number} {}", HOSTILE[(number + at) % HOSTILE.len()]));
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found, expected, "{path}, {at}");
        }
        assert_eq!(found.len(), expected.len(), "{path}, {at}: {:?}", found.last());
    }
}

#[test]
fn names_do_not_change_the_structure_of_an_eds() {
    for path in ["dictionaries/demo-drive.eds", "dictionaries/aec-vector-step.toml", "tests/data/coupler.esi.xml"] {
        for flavor in [eds::Flavor::Eds, eds::Flavor::Dcf] {
            let write = |catalog: &Catalog| eds::export(catalog, &catalog.devices[0], flavor).expect("an EDS").text;
            hold(path, "again.dcf", &write);
        }
    }
}

#[test]
fn names_do_not_change_the_structure_of_an_esi() {
    for path in ["tests/data/coupler.esi.xml", "benches/instructions/axis.esi.xml"] {
        let write = |catalog: &Catalog| esi::export(catalog, &esi::Options::default()).expect("an ESI").text;
        hold(path, "again.xml", &write);
    }
}

#[test]
fn names_do_not_change_the_structure_of_a_gsdml() {
    for path in ["tests/data/drive.gsdml.xml", "tests/data/safe.gsdml.xml"] {
        let write = |catalog: &Catalog| gsdml::export(catalog, &gsdml::Options::default()).expect("a GSDML").text;
        hold(path, "GSDML-again.xml", &write);
    }
}
