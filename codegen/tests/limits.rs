//! Tests the documented limits: a short input must not create more elements than allowed.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::limits;
use lexibus_codegen::source::Source;

fn codes(compilation: &Compilation) -> Vec<&'static str> {
    compilation.diagnostics.list().iter().map(|found| found.code.id).collect()
}

fn checked(name: &str, text: String) -> Compilation {
    check(Source::new(name, text.into_bytes()), &Options::default())
}

/// Returns the number of diagnostics with the given code.
fn count(compilation: &Compilation, code: &str) -> usize {
    codes(compilation).iter().filter(|entry| **entry == code).count()
}

fn items(compilation: &Compilation) -> usize {
    let devices = compilation.catalog.iter().flat_map(|catalog| &catalog.devices);
    devices.flat_map(|device| &device.groups).map(|group| group.items.len()).sum()
}

/// Compiles a table with `count` rows. Each row has the maximum number of parameters and a separate parameter space.
fn rows(count: u32) -> Compilation {
    let mut table = "lexibus = 1\n[device]\nname = \"X\"\nbuses = [\"serial\"]\n".to_owned();
    for row in 0..count {
        table += &format!("[spaces.s{row}]\nparameter = {{}}\n");
    }
    for row in 0..count {
        table += &format!(
            "[[chapters]]\nspace = \"s{row}\"\n[chapters.registers]\n\
             \"a{row} {{n}}\" = {{ reg = 0, count = {}, type = \"u8\", access = \"ro\" }}\n",
            limits::MAX_REPEAT
        );
    }
    checked("rows.toml", table)
}

#[test]
fn rows_that_stand_for_many_items() {
    let full = limits::MAX_DERIVED_ITEMS / limits::MAX_REPEAT as usize;
    let compilation = rows(full as u32 + 50);
    assert_eq!(count(&compilation, "IO003"), 1);
    assert_eq!(items(&compilation), full * limits::MAX_REPEAT as usize + 50);
}

#[test]
fn rows_that_stand_for_too_many() {
    let table = |count: u32| {
        checked(
            "row.toml",
            format!(
                "lexibus = 1\n[device]\nname = \"X\"\nbuses = [\"serial\"]\n[spaces.s]\nparameter = {{}}\n\
                 [[chapters]]\nspace = \"s\"\n[chapters.registers]\n\
                 \"a {{n}}\" = {{ reg = 0, count = {count}, type = \"u8\", access = \"ro\" }}\n"
            ),
        )
    };
    let most = table(limits::MAX_REPEAT);
    assert_eq!((items(&most), count(&most, "TAB004")), (limits::MAX_REPEAT as usize, 0));
    assert_eq!(count(&table(limits::MAX_REPEAT + 1), "TAB004"), 1);
}

/// Compiles an EDS with `count` objects of 254 elements each.
fn compact_objects(count: usize) -> Compilation {
    let mut text = "[DeviceInfo]\nProductName=X\n".to_owned();
    for number in 0..count {
        let index = 0x2000 + number;
        text += &format!("[{index:X}]\nParameterName=A\nObjectType=8\nDataType=5\nAccessType=rw\nCompactSubObj=254\n");
    }
    checked("compact.eds", text)
}

#[test]
fn objects_that_stand_for_many_elements() {
    let most = limits::MAX_DERIVED_ITEMS / 255;
    assert_eq!(count(&compact_objects(most), "IO003"), 0);
    let beyond = compact_objects(most + 50);
    assert_eq!(count(&beyond, "IO003"), 1);
    assert!(items(&beyond) <= limits::MAX_DERIVED_ITEMS + 255, "{} items", items(&beyond));
}

#[test]
fn pdos_that_follow_from_a_number() {
    let text = "[DeviceInfo]\nProductName=X\nCompactPDO=0x3F\nNrOfRXPDO=600\nNrOfTXPDO=0\n\
                [2000]\nParameterName=A\nDataType=5\nAccessType=rw\n";
    let compilation = checked("pdos.eds", text.to_owned());
    let device = &compilation.catalog.as_ref().expect("a catalog").devices[0];
    let made = device.groups.iter().filter(|group| group.index().is_some_and(|index| index < 0x1600)).count();
    assert_eq!(made, usize::from(limits::MAX_IMPLICIT_PDOS));
    assert_eq!(count(&compilation, "PDO010"), 1, "{:?}", codes(&compilation));
}

/// Compiles an ESI with slots that all accept the same modules.
fn slots(slots: usize, modules: usize) -> Compilation {
    let slot =
        "<Slot MinInstances='0' MaxInstances='1'><Name>S</Name><ModuleClass>C</ModuleClass></Slot>".repeat(slots);
    let module: String = (0..modules)
        .map(|at| format!("<Module><Type ModuleIdent='{}' ModuleClass='C'>M</Type><Name>M</Name></Module>", at + 1))
        .collect();
    checked(
        "slots.xml",
        format!(
            "<EtherCATInfo><Vendor><Id>1</Id><Name>X</Name></Vendor><Descriptions><Devices><Device Physics='YY'>\
             <Type ProductCode='1' RevisionNo='1'>T</Type><Name>T</Name><Slots>{slot}</Slots></Device></Devices>\
             <Modules>{module}</Modules></Descriptions></EtherCATInfo>"
        ),
    )
}

#[test]
fn slots_that_take_many_modules() {
    assert_eq!(count(&slots(20, 100), "IO003"), 0);
    assert_eq!(count(&slots(500, limits::MAX_MODULE_USES / 500 + 1), "IO003"), 1);
}

/// Creates an empty folder for a test.
fn folder(name: &str) -> std::path::PathBuf {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    folder
}

#[test]
fn files_that_an_esi_refers_to() {
    let folder = folder("many-references");
    for at in 0..=limits::MAX_REFERENCES {
        std::fs::write(folder.join(format!("{at}.xml")), "<EtherCATInfo/>").expect("a file");
    }
    let refused = |count: usize| {
        let references: String = (0..count).map(|at| format!("<InfoReference>{at}.xml</InfoReference>")).collect();
        let text = format!("<EtherCATInfo>{references}<Vendor><Id>1</Id><Name>X</Name></Vendor></EtherCATInfo>");
        let source = Source::new("main.xml", text.into_bytes()).in_folder(&folder);
        let compilation = check(source, &Options::default());
        let list = compilation.diagnostics.list().iter();
        list.filter(|found| found.code.id == "XML005" && compilation.one_line(found).contains("more than")).count()
    };
    assert_eq!(refused(limits::MAX_REFERENCES), 0);
    assert_eq!(refused(limits::MAX_REFERENCES + 1), 1);
}

#[test]
fn files_that_are_too_large() {
    let path = folder("large").join("large.eds");
    // Use a sparse file, whose empty part takes no time to write and is not read by the compiler.
    std::fs::File::create(&path).and_then(|file| file.set_len(limits::MAX_INPUT_BYTES as u64 + 1)).expect("a file");
    let error = Source::read(&path).expect_err("it is too large");
    assert_eq!(error.kind(), std::io::ErrorKind::FileTooLarge);
    let _ = std::fs::remove_file(path);
}

/// Compiles an EDS that contains `lines` after the section `FileInfo`.
fn eds(lines: &str) -> Compilation {
    checked("a.eds", format!("[FileInfo]\nFileName=a\n{lines}"))
}

#[test]
fn names_of_sections_that_are_copied_to_each_entry() {
    let section = |letters: usize, entries: usize| format!("[{}]\n{}", "n".repeat(letters), "a=1\n".repeat(entries));
    let bytes = |compilation: &Compilation| {
        let device = &compilation.catalog.as_ref().expect("the file is usable").devices[0];
        device.extensions.iter().map(|extension| extension.key.len()).sum::<usize>()
    };
    let most = eds(&section(200, 1_000));
    assert_eq!((bytes(&most), codes(&most).contains(&"IO003")), (202 * 1_000, false));
    let beyond = eds(&section(4_000, 1_000));
    assert_eq!(count(&beyond, "IO003"), 1);
    let length = beyond.sources[0].text().len();
    assert!(bytes(&beyond) <= (limits::MAX_COPIES_PER_BYTE + 1) * length, "{} of {length}", bytes(&beyond));
}

#[test]
fn texts_of_compact_sub_objects() {
    let object = |index: u16, letters: usize| {
        let text = "t".repeat(letters);
        format!("[{index:X}]\nParameterName=A\nObjectType=8\nDataType=9\nAccessType=ro\nCompactSubObj=254\nDefaultValue={text}\n")
    };
    let comments = format!(";{}\n", "c".repeat(10_000));
    let most = eds(&(comments.clone() + &object(0x2000, 2_000)));
    assert_eq!((items(&most), codes(&most).contains(&"IO003")), (255, false));
    let beyond = eds(&(comments + &object(0x2000, 5_000) + &object(0x2001, 5_000)));
    assert_eq!(count(&beyond, "IO003"), 1);
    assert!(items(&beyond) <= 255 + 1, "{}", items(&beyond));
    // Sub-indices that have separate sections must be kept even if the limit is exceeded.
    let described = "[2000sub1]\nParameterName=B\nDataType=5\nAccessType=ro\n";
    let beyond = eds(&(object(0x2000, 5_000) + described));
    let items = &beyond.catalog.as_ref().expect("the file is usable").devices[0].groups[0].items;
    assert_eq!(items.iter().map(|item| item.name.as_str()).collect::<Vec<_>>(), ["NrOfObjects", "B"]);
}

fn protocol(rest: &str) -> Compilation {
    checked("protocol.toml", format!("lexibus = 1\n[device]\nname = \"X\"\nbuses = [\"serial\"]\n{rest}"))
}

#[test]
fn keys_that_nobody_knows() {
    let codes = |number: usize| {
        let rows = (0..number).map(|at| format!("{at} = {{ name = \"c{at}\", severe = true }}\n"));
        let compilation = protocol(&format!("[codes.fault.rows]\n{}", rows.collect::<String>()));
        (count(&compilation, "TAB003"), count(&compilation, "TAB004"))
    };
    assert_eq!(codes(limits::MAX_UNKNOWN_KEYS), (limits::MAX_UNKNOWN_KEYS, 0));
    assert_eq!(codes(limits::MAX_UNKNOWN_KEYS + 1), (limits::MAX_UNKNOWN_KEYS, 1));
}

#[test]
fn messages_of_a_table() {
    let messages = |number: usize| {
        let all = (0..number).map(|at| format!("[[messages]]\nname = \"m{at}\"\nrequest = [{{ bytes = [1] }}]\n"));
        let compilation = protocol(&all.collect::<String>());
        let kept = compilation.catalog.as_ref().expect("a catalog").devices[0].messages.len();
        (count(&compilation, "IO003"), kept)
    };
    assert_eq!(messages(limits::MAX_MESSAGES), (0, limits::MAX_MESSAGES));
    assert_eq!(messages(limits::MAX_MESSAGES + 9), (1, limits::MAX_MESSAGES));
}

#[test]
fn rows_of_state_machines() {
    let machines = |from: usize, doc: usize| {
        let from = vec!["\"idle\""; from].join(", ");
        let compilation = protocol(&format!(
            "[enums.State]\ntype = \"u8\"\n[enums.State.values]\n0 = \"idle\"\n1 = \"run\"\n\
             [machines.a]\nstates = \"State\"\n[[machines.a.transitions]]\nfrom = [{from}]\nto = \"run\"\ndoc = \"{}\"\n\
             [machines.b]\nstates = \"State\"\n",
            "d".repeat(doc)
        ));
        let device = &compilation.catalog.as_ref().expect("a catalog").devices[0];
        (
            count(&compilation, "IO003"),
            device.machines.iter().map(|machine| machine.name.to_string()).collect::<Vec<_>>(),
        )
    };
    // A state machine and each of its two states also count as rows, in addition to the transitions.
    let most = limits::MAX_MACHINE_ROWS - 2 * 3;
    let names = |list: &[&str]| list.iter().map(|name| name.to_string()).collect::<Vec<_>>();
    assert_eq!(machines(most, 9), (0, names(&["a", "b"])));
    assert_eq!(machines(most + 1, 9), (1, names(&["a"])));
    // A long text of a state counts as several rows.
    assert_eq!(machines(most / 2 + 9, limits::ROW_BYTES_PER_ITEM), (1, Vec::new()));
}

#[test]
fn notes_of_many_cells() {
    let machine = |length: usize| {
        let states = (0..40).map(|at| format!("s{at} = {{ mask = 255, value = {at} }}\n")).collect::<String>();
        let list = (0..40).map(|at| format!("\"s{at}\"")).collect::<Vec<_>>().join(", ");
        let cells = ["{ to = \"same\", note = 1 }"; 40].join(", ");
        let rows = (0..40).map(|at| format!("c{at} = {{ cells = [{cells}] }}\n")).collect::<String>();
        let commands = (0..40).map(|at| format!("c{at} = {{ mask = 255, value = {at} }}\n")).collect::<String>();
        let compilation = protocol(&format!(
            "[machines.a.states]\n{states}[machines.a.commands]\n{commands}\
             [machines.a.matrix]\nstates = [{list}]\n[machines.a.matrix.notes]\n1 = \"{}\"\n[machines.a.matrix.rows]\n{rows}",
            "n".repeat(length)
        ));
        (count(&compilation, "IO003"), compilation.catalog.as_ref().expect("a catalog").devices[0].machines.len())
    };
    assert_eq!(machine(1000), (0, 1));
    assert_eq!(machine(2 * limits::ROW_BYTES_PER_ITEM), (1, 0));
}

/// Checks that the table in the book contains the values of these limits.
#[test]
fn the_book_has_each_limit() {
    let chapter = include_str!("../../docs/src/limits.md");
    let limits = [
        ("size of a file", limits::MAX_INPUT_BYTES),
        ("nested XML elements", limits::MAX_XML_DEPTH),
        ("`InfoReference`", limits::MAX_REFERENCES),
        ("items from `CompactSubObj`", limits::MAX_DERIVED_ITEMS),
        ("items that one row", limits::MAX_REPEAT as usize),
        ("`CompactPDO`", limits::MAX_IMPLICIT_PDOS.into()),
        ("modules that the slots", limits::MAX_MODULE_USES),
        ("copies of data types", limits::MAX_COPIES_PER_BYTE),
        ("unknown keys that the compiler reports", limits::MAX_UNKNOWN_KEYS),
        ("messages of a register table", limits::MAX_MESSAGES),
        ("state machines of a device", limits::MAX_MACHINE_ROWS),
        ("items that `import` creates", limits::MAX_DERIVED_ITEMS),
        ("names that `import` tries", limits::MAX_DERIVED_ITEMS),
        ("documentation page links to", limits::MAX_LINKED_PAGES),
        ("documentation page links to", limits::NEAR_LINKED_PAGES),
        ("`writable`", limits::MAX_LISTED_VALUES as usize),
        ("depth of folders", limits::MAX_FOLDER_DEPTH),
        ("unknown keys of a section", limits::MAX_COMPARED_EXTENSIONS),
        ("names of items, objects and chapters that `TAB025` compares", limits::MAX_SEARCHED_NAMES),
        ("different words in the texts", limits::MAX_SEARCHED_WORDS),
        ("bits of a PDO entry", limits::MAX_FIELD_BITS as usize),
        ("length in bytes of a PROFINET record", limits::MAX_RECORD_BYTES as usize),
        ("characters of a name", limits::MAX_IDENTIFIER),
        ("size in bytes of a row", limits::MAX_FREE_ROW_BYTES),
        ("size in bytes of a row", limits::ROW_BYTES_PER_ITEM),
        ("that a GSDML copies", limits::MAX_TEXT_COPIES_PER_BYTE),
        ("that a GSDML copies", limits::MIN_TEXT_COPIES),
    ];
    for (row, limit) in limits {
        let digits = limit.to_string();
        let groups: Vec<&str> =
            digits.as_bytes().rchunks(3).rev().map(|group| std::str::from_utf8(group).expect("digits")).collect();
        let written = groups.join(",");
        let line = chapter.lines().find(|line| line.starts_with('|') && line.contains(row));
        let line = line.unwrap_or_else(|| panic!("docs/src/limits.md has no row {row}"));
        let mut numbers = line.split(|letter: char| !letter.is_ascii_digit() && letter != ',');
        assert!(numbers.any(|number| number == written), "{written} is not in: {line}");
    }
}
