//! Tests of the cursor.

use super::{Cursor, Error, Event};
use crate::diagnostics::Diagnostics;
use crate::limits;
use crate::source::FileId;

fn cursor(text: &str) -> Cursor<'_> {
    Cursor::new(text, FileId(0))
}

/// Returns the events in short form: `+name`, `-`, `"text"`.
fn events(text: &str) -> Result<Vec<String>, Error> {
    let mut cursor = cursor(text);
    let mut list = Vec::new();
    while let Some(event) = cursor.read()? {
        list.push(match event {
            Event::Start(tag) => {
                for attribute in tag.attributes() {
                    attribute?;
                }
                format!("+{}", tag.name)
            }
            Event::End => "-".into(),
            Event::Text(text) => format!("{:?}", text.value(&mut Diagnostics::default())),
        });
    }
    Ok(list)
}

fn error(text: &str) -> (&'static str, String) {
    let diagnostic = events(text).expect_err(text).into_diagnostic();
    (diagnostic.code.id, text[diagnostic.span.range()].to_owned())
}

#[test]
fn blanks_around_references_and_comments() {
    // An element can follow a reference and a space. Spaces within a text are a part of the text.
    assert!(events("<a>x&amp; <b/></a>").unwrap().iter().any(|event| event.contains('b')));
    assert_eq!(events("<a> x &amp; y <!-- --> z </a>").unwrap()[1..3], ["\" x & y \"", "\" z \""]);
}

#[test]
fn elements_text_and_what_is_passed_over() {
    let text = "\u{feff}<?xml version='1.0'?><!DOCTYPE r [<!ENTITY e 'x'>]>\n<r>\n <!-- c --> <p:a/>t<?pi x?>u<b >v</b\n></r>\n";
    let expected = ["+r", "+a", "-", "\"t\"", "\"u\"", "+b", "\"v\"", "-", "-"];
    assert_eq!(events(text).unwrap(), expected);
    assert_eq!(
        events("<r>a&amp;b<![CDATA[<&amp;>\r\n]]>&#x41;</r>").unwrap()[1..4],
        ["\"a&b\"", "\"<&amp;>\\n\"", "\"A\""]
    );
}

#[test]
fn spans_point_at_names_and_values() {
    let text = "<r>\r\n<n:a x = \"1\" n:yy='&lt;2'>  text </n:a>\r<b/></r>";
    let mut cursor = cursor(text);
    let root = cursor.root().unwrap();
    let a = cursor.child(&root).unwrap().unwrap();
    assert_eq!((a.name, a.prefix, a.depth, &text[a.name_span().range()]), ("a", "n", 2, "n:a"));
    assert!(text[a.span.range()].starts_with("<n:a") && text[a.span.range()].ends_with("2'>"));
    let attributes: Vec<_> = a.attributes().map(Result::unwrap).collect();
    assert_eq!(attributes.iter().map(|a| &text[a.name_span.range()]).collect::<Vec<_>>(), ["x", "n:yy"]);
    assert_eq!(attributes.iter().map(|a| &text[a.span.range()]).collect::<Vec<_>>(), ["1", "&lt;2"]);
    assert_eq!(attributes[1].value(&mut Diagnostics::default()), "<2");
    assert_eq!(a.attribute("yy").unwrap().unwrap().prefix, "n");
    assert_eq!(cursor.path().collect::<Vec<_>>(), ["r", "a"]);
    let content = cursor.only_text().unwrap();
    assert_eq!((content.raw, &text[content.span.range()]), ("  text ", "  text "));
    let b = cursor.child(&root).unwrap().unwrap();
    assert_eq!((cursor.origin(&b).line, cursor.origin(&a).line, cursor.origin(&b).line), (3, 2, 3));
    assert!(b.empty && cursor.child(&b).unwrap().is_none() && cursor.depth() == 1);
    assert!(cursor.child(&root).unwrap().is_none() && cursor.read().unwrap().is_none());
}

#[test]
fn an_element_can_be_read_once_more() {
    let text = "<r><skip>x</skip>\n<a><b/>t</a></r>";
    let mut first = cursor(text);
    let root = first.root().unwrap();
    first.child(&root).unwrap();
    let a = first.child(&root).unwrap().unwrap();
    let mut again = Cursor::resume(text, first.origin(&a));
    let tag = again.root().unwrap();
    assert_eq!((tag.name, tag.span, tag.depth, again.origin(&tag).line), ("a", a.span, 1, 2));
    assert!(matches!((again.only_text(), again.child(&tag)), (None, Ok(Some(child))) if child.name == "b"));
    assert!(again.child(&tag).unwrap().is_none());
}

#[test]
fn references_are_resolved_or_kept() {
    let mut diagnostics = Diagnostics::default();
    let text = "<r a='&#65;&#x42;&quot;\t&apos;\r\n&gt;' b='&nbsp; &a;b &amp R&D &#0; &#xD800; &#+5; &;'/>";
    let mut cursor = cursor(text);
    let tag = cursor.root().unwrap();
    let mut value = |name: &str| tag.attribute(name).unwrap().unwrap().value(&mut diagnostics).into_owned();
    assert_eq!(value("a"), "AB\" ' >");
    assert_eq!(value("b"), "&nbsp; &a;b &amp R&D &#0; &#xD800; &#+5; &;");
    let found: Vec<_> = diagnostics.list().iter().map(|d| (d.code.id, &text[d.span.range()])).collect();
    let expected = ["&nbsp;", "&a;", "&", "&", "&#0;", "&#xD800;", "&", "&"];
    assert_eq!(found, expected.map(|text| ("XML002", text)));
}

#[test]
fn values_of_every_length_end_at_their_quotation_mark() {
    for length in 0..40 {
        for (at, mark) in
            (0..length).flat_map(|at| ["&lt;", "\t", "\u{1}", "'", "µ", "\u{7f}", " "].map(|mark| (at, mark)))
        {
            let value = format!("{}{mark}{}", "x".repeat(at), "y".repeat(length - at));
            let text = format!("<a b=\"{value}\" c=\"&amp;\"/>");
            let tag = cursor(&text).root().unwrap();
            let attribute = tag.attribute("b").unwrap().unwrap();
            let expected = value.replace("&lt;", "<").replace('\t', " ");
            assert_eq!((attribute.raw, &*attribute.value(&mut Diagnostics::default())), (&*value, &*expected));
        }
    }
}

#[test]
fn a_bare_ampersand_is_text() {
    assert_eq!(events("<r>a & b&c</r>").unwrap()[1], "\"a & b&c\"");
    assert_eq!(events("<r>&</r>").unwrap()[1], "\"&\"");
}

#[test]
fn what_is_not_well_formed_is_told_at_its_place() {
    let malformed = |text, place: &str| assert_eq!(error(text), ("XML001", place.to_owned()), "{text}");
    malformed("", "");
    malformed(" <!-- x -->", ">");
    malformed("<r><a></r>", "</r>");
    malformed("<r></r></r>", "</r>");
    malformed("<r/><s/>", "<s/>");
    malformed("<r/> x ", "x");
    malformed("x<r/>", "x");
    malformed("<r><a>x", "x");
    malformed("<r", "<");
    malformed("<r><!-- ", "<");
    malformed("<r/><?x ", "<");
    malformed("<?><r/>?>", "<?>");
    malformed("<r><![CDATA[ ", "<");
    malformed("<r a=\"1", "<");
    malformed("<>", "<>");
    malformed("<1/>", "<1");
    malformed("<a <b/>", "<a");
    malformed("<r a=1/>", "a");
    malformed("<r a/>", "a");
    malformed("<r a='1'b='2'/>", "b");
    malformed("<r a='1' a='2'/>", "a");
    malformed("<r ='1'/>", "=");
}

#[test]
fn nesting_is_bounded() {
    let deep = |depth| format!("{}{}", "<a>".repeat(depth), "</a>".repeat(depth));
    assert_eq!(events(&deep(limits::MAX_XML_DEPTH)).unwrap().len(), 2 * limits::MAX_XML_DEPTH);
    assert_eq!(error(&deep(limits::MAX_XML_DEPTH + 1)), ("IO003", "<a>".into()));
    assert_eq!(error(&"<a>".repeat(1_000_000)).0, "IO003");
}

#[test]
fn damage_anywhere_ends_in_an_error_at_worst() {
    let text = "<?xml version='1.0'?><!DOCTYPE r><r a='&lt;'>é&amp;<b/><![CDATA[x]]><!-- c --><c>t</c></r>";
    for at in 0..text.len() {
        let _ = events(text.get(..at).unwrap_or(""));
        for byte in [b'<', b'>', b'&', b'\'', b'/', b'!', b'?', b'-', b']', b' '] {
            let mut bytes = text.as_bytes().to_vec();
            bytes[at] = byte;
            if let Ok(text) = std::str::from_utf8(&bytes) {
                let _ = events(text);
            }
        }
    }
}
