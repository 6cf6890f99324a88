//! A short line that stands for many elements stands for so many and no more, and the book says how many.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::limits;
use lexibus_codegen::source::Source;

fn codes(compilation: &Compilation) -> Vec<&'static str> {
    compilation.diagnostics.list().iter().map(|found| found.code.id).collect()
}

fn items(compilation: &Compilation) -> usize {
    let devices = compilation.catalog.iter().flat_map(|catalog| &catalog.devices);
    devices.flat_map(|device| &device.groups).map(|group| group.items.len()).sum()
}

/// A table of so many rows, each of as many parameters as a row may stand for, in spaces of their own.
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
    check(Source::new("rows.toml", table.into_bytes()), &Options::default())
}

#[test]
fn rows_that_stand_for_many_items() {
    let full = limits::MAX_DERIVED_ITEMS / limits::MAX_REPEAT as usize;
    let compilation = rows(full as u32 + 50);
    assert_eq!(codes(&compilation).iter().filter(|code| **code == "IO003").count(), 1);
    assert_eq!(items(&compilation), full * limits::MAX_REPEAT as usize + 50);
}

/// The EDS that has these lines, and as many bytes more as any has.
fn eds(lines: &str) -> Compilation {
    let text = format!("[FileInfo]\nFileName=a\n{lines}");
    check(Source::new("a.eds", text.into_bytes()), &Options::default())
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
    assert_eq!(codes(&beyond).iter().filter(|code| **code == "IO003").count(), 1);
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
    assert_eq!(codes(&beyond).iter().filter(|code| **code == "IO003").count(), 1);
    assert!(items(&beyond) <= 255 + 1, "{}", items(&beyond));
    // What has sections of its own stays, in order.
    let described = "[2000sub1]\nParameterName=B\nDataType=5\nAccessType=ro\n";
    let beyond = eds(&(object(0x2000, 5_000) + described));
    let items = &beyond.catalog.as_ref().expect("the file is usable").devices[0].groups[0].items;
    assert_eq!(items.iter().map(|item| item.name.as_str()).collect::<Vec<_>>(), ["NrOfObjects", "B"]);
}

/// The others have their tests at the quirks of their formats; here they are held against the book.
#[test]
fn the_book_has_each_limit() {
    let chapter = include_str!("../../docs/src/limits.md");
    let limits = [
        limits::MAX_INPUT_BYTES,
        limits::MAX_REFERENCES,
        limits::MAX_REPEAT as usize,
        limits::MAX_DERIVED_ITEMS,
        limits::MAX_IMPLICIT_PDOS.into(),
        limits::MAX_COPIES_PER_BYTE,
        limits::MAX_XML_DEPTH,
        limits::MAX_MODULE_USES,
        limits::MAX_TEXT_COPIES_PER_BYTE,
        limits::MIN_TEXT_COPIES,
    ];
    for limit in limits {
        let digits = limit.to_string();
        let groups: Vec<&str> =
            digits.as_bytes().rchunks(3).rev().map(|group| std::str::from_utf8(group).expect("digits")).collect();
        let written = groups.join(",");
        let is_there = chapter.lines().filter(|line| line.starts_with('|')).any(|line| {
            line.split(|letter: char| !letter.is_ascii_digit() && letter != ',').any(|number| number == written)
        });
        assert!(is_there, "{written} isn't in the table of docs/src/limits.md");
    }
}
