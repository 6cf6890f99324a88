//! Tests of the common XML reader with a minimal format.

use super::{Format, Given, Reader};
use crate::diagnostics::{codes, Code, Diagnostics};
use crate::source::FileId;
use crate::syntax::xml::{Cursor, Tag};

struct Plain<const EMPTY_IS_MISSING: bool>;

impl<const EMPTY: bool> Format for Plain<EMPTY> {
    const STANDARD: &'static str = "no standard";
    const UNKNOWN: &'static Code = &codes::ESI_UNKNOWN_ELEMENT;
    const ELEMENTS: &'static [&'static str] = &["Object", "PdoMapping"];
    const VALUE: &'static Code = &codes::ESI_VALUE;
    const CASE: Option<&'static Code> = Some(&codes::ATTRIBUTE_CASE);
    const EMPTY_IS_MISSING: bool = EMPTY;
    const ENGLISH: (&'static str, &'static str) = ("lang", "en");
}

/// Calls `read` with the root element of `text`.
fn read<'a, const EMPTY: bool, T>(
    text: &'a str,
    diagnostics: &mut Diagnostics,
    read: impl FnOnce(&mut Reader<'a, '_, Plain<EMPTY>>, &Tag<'a>) -> T,
) -> T {
    let mut reader = Reader::new(Cursor::new(text, FileId(0)), diagnostics, Plain);
    let root = reader.cursor.root().expect("a root");
    read(&mut reader, &root)
}

fn content(text: &str) -> Given<'_> {
    read::<true, _>(text, &mut Diagnostics::default(), |reader, _| reader.content()).expect("a text")
}

#[test]
fn blanks_around_references_and_comments() {
    assert_eq!(content("<a> x &amp; y <!-- --> z </a>").text, "x & y  z");
    assert_eq!(content("<a> &lt; <!-- --> &gt; </a>").text, "<  >");
    assert_eq!(content("<a>\n <![CDATA[ x ]]>\n</a>").text, "x");
    assert_eq!(content("<a>&amp;  </a>").text, "&");
    let text = "<a>  text </a>";
    let given = content(text);
    assert_eq!((&*given.text, &text[given.span.range()]), ("text", "text"));
    assert!(content("<a>  </a>").is_missing() && content("<a/>").is_missing());
}

#[test]
fn attributes_by_name_and_the_others_as_extensions() {
    let text = "<a xmlns='x' x:b='1' one='1' Two=' 2 ' empty='' other='3' lang='en'><b lang='en' c='4'>t<d/></b></a>";
    let mut diagnostics = Diagnostics::default();
    read::<false, _>(text, &mut diagnostics, |reader, root| {
        let [one, two, empty, missing] = reader.attributes(root, ["one", "two", "empty", "missing"]).unwrap();
        assert_eq!([&one.text, &two.text, &empty.text], ["1", "2", ""]);
        assert_eq!((empty.is_missing(), missing.is_missing(), &text[empty.span.range()]), (false, true, "''"));
        reader.no_children(root).unwrap();
        let extensions = reader.extensions_since(0);
        let extensions: Vec<_> =
            extensions.iter().map(|extension| (extension.key.as_str(), extension.value.as_str())).collect();
        assert_eq!(extensions, [("other", "3"), ("lang", "en"), ("a/b@c", "4"), ("a/b", "t"), ("b/d", "")]);
    });
    assert_eq!(
        diagnostics.list().iter().map(|diagnostic| diagnostic.code.id).collect::<Vec<_>>(),
        [codes::ATTRIBUTE_CASE.id]
    );
    read::<true, _>(text, &mut Diagnostics::default(), |reader, root| {
        let [empty] = reader.attributes(root, ["EMPTY"]).unwrap();
        assert!(empty.is_missing());
    });
}

#[test]
fn each_element_takes_the_extensions_within_it() {
    let text = "<a><b><x>1</x></b><c>2</c><b><x>3</x></b></a>";
    let mut of_elements = Vec::new();
    read::<true, _>(text, &mut Diagnostics::default(), |reader, root| {
        let each = reader.each(root, "b", |reader, tag| {
            let start = reader.extensions.len();
            reader.no_children(tag)?;
            of_elements.push(reader.extensions_since(start).len());
            Ok(())
        });
        each.unwrap();
        assert_eq!((of_elements, reader.extensions.len()), (vec![1, 1], 1));
    });
}

#[test]
fn words_and_numbers_are_flags() {
    let mut diagnostics = Diagnostics::default();
    read::<true, _>("<a t='true' o='1' y='YES' n='#x10' f='00' w='no'/>", &mut diagnostics, |reader, root| {
        let flags = reader.attributes(root, ["t", "o", "y", "n", "f", "w", "missing"]).unwrap();
        assert_eq!(flags.map(|given| reader.flag(&given)), [true, true, true, true, false, false, false]);
    });
    assert_eq!(diagnostics.list().len(), 4);
}
