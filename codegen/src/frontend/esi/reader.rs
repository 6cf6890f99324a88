//! The state of reading one file, and the reading of single texts, attributes, numbers and names.

use std::borrow::Cow;

use compact_str::{format_compact, CompactString};
use smallvec::SmallVec;

use super::language;
use super::number::{self, Fault, Number};
use super::templates::Templates;
use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::{Documentation, Extension, Extensions, LocalText, Texts};
use crate::limits;
use crate::source::Span;
use crate::syntax::xml::{Cursor, Event, Tag, Text};
pub(super) use crate::text::brief as shortened;

/// A result that ends the reading of the file with one diagnostic.
pub(super) type Read<T> = Result<T, Box<Diagnostic>>;

pub(super) struct Reader<'a, 'd> {
    pub cursor: Cursor<'a>,
    pub diagnostics: &'d mut Diagnostics,
    pub budget: &'d mut Budget,
    pub templates: &'d Templates<'a>,
}

/// What data types may still add to objects, and a vendor to devices: short references can stand for much.
#[derive(Debug)]
pub(super) struct Budget {
    /// Items that no element of their own describes.
    items: usize,
    /// Bytes of text that are copied into items.
    bytes: usize,
    exceeded: bool,
}

impl Budget {
    /// For a file of so many bytes.
    pub fn new(length: usize) -> Self {
        Budget {
            items: limits::MAX_DERIVED_ITEMS,
            bytes: length.saturating_mul(limits::MAX_COPIES_PER_BYTE),
            exceeded: false,
        }
    }

    /// Adds what a further file of so many bytes brings along.
    pub fn extend(&mut self, length: usize) {
        self.bytes = self.bytes.saturating_add(length.saturating_mul(limits::MAX_COPIES_PER_BYTE));
    }

    /// Whether the budget still has so many items and bytes.
    pub fn take(&mut self, (items, bytes): (usize, usize)) -> bool {
        match (self.items.checked_sub(items), self.bytes.checked_sub(bytes)) {
            (Some(items), Some(bytes)) if !self.exceeded => {
                (self.items, self.bytes) = (items, bytes);
                true
            }
            _ => false,
        }
    }
}

/// A text without blanks around it, and where it stands. What is empty isn't given.
#[derive(Clone, Debug, Default)]
pub(super) struct Given<'a> {
    pub text: Cow<'a, str>,
    pub span: Span,
}

impl Given<'_> {
    pub fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    pub fn compact(&self) -> CompactString {
        CompactString::from(self.text.as_ref())
    }
}

/// A text in the languages of the source.
#[derive(Clone, Debug, Default)]
pub(super) struct Names<'a>(SmallVec<[(Option<u32>, Given<'a>); 1]>);

impl<'a> Names<'a> {
    /// Position of the text that serves as the name.
    fn best(&self) -> usize {
        let ranks = self.0.iter().enumerate().map(|(at, (lcid, _))| (language::rank(*lcid), at));
        ranks.min().map_or(0, |(_, at)| at)
    }

    fn given(&self) -> Option<&Given<'a>> {
        self.0.get(self.best()).map(|(_, given)| given)
    }

    pub fn name(&self) -> CompactString {
        self.given().map_or_else(CompactString::default, Given::compact)
    }

    /// Where the name stands.
    pub fn span(&self) -> Span {
        self.given().map_or_else(Span::default, |given| given.span)
    }

    /// The texts that aren't the name.
    pub fn others(&self) -> Texts {
        if self.0.len() < 2 {
            return Texts::default();
        }
        let best = self.best();
        let others = self.0.iter().enumerate().filter(|(at, _)| *at != best);
        others.map(|(_, (lcid, given))| local(*lcid, given)).collect()
    }

    /// Whether both have a text in the same language. So has what is in more languages than there are.
    pub fn shares_language(&self, other: &Names<'_>) -> bool {
        let is_same = |own: &Option<u32>, lcid: &Option<u32>| language::tag(*own) == language::tag(*lcid);
        self.0.len() > 255 || self.0.iter().any(|(own, _)| other.0.iter().any(|(lcid, _)| is_same(own, lcid)))
    }

    pub fn append(&mut self, mut other: Names<'a>) {
        self.0.append(&mut other.0);
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Bytes that a copy of all texts takes.
    pub fn weight(&self) -> usize {
        self.0.iter().map(|(_, given)| size_of::<LocalText>() + given.text.len()).sum()
    }

    /// The texts, each with its language.
    pub fn all(&self) -> impl Iterator<Item = LocalText> + '_ {
        self.0.iter().map(|(lcid, given)| local(*lcid, given))
    }

    /// The texts as what a source says of an element.
    pub fn documentation(&self) -> Option<Box<Documentation>> {
        let main = self.given()?;
        let text = main.text.to_string();
        Some(Box::new(Documentation { text, translations: self.others(), ..Documentation::default() }))
    }
}

fn local(lcid: Option<u32>, given: &Given<'_>) -> LocalText {
    LocalText { language: language::tag(lcid), text: given.compact() }
}

impl<'a> Reader<'a, '_> {
    /// Reads an element that has nothing but text to its end; whatever else it has becomes extensions.
    pub fn leaf(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<Given<'a>> {
        if has_attributes(tag) {
            self.keep_attributes(tag, extensions)?;
        }
        self.content(extensions)
    }

    /// The same for an element whose attributes were read.
    pub fn content(&mut self, extensions: &mut Extensions) -> Read<Given<'a>> {
        let mut given = Given::default();
        loop {
            match self.cursor.read()? {
                Some(Event::Text(piece)) => self.add(&mut given, &piece),
                Some(Event::Start(inner)) => self.unknown(&inner, extensions)?,
                Some(Event::End) | None => break,
            }
        }
        if let Cow::Owned(text) = &mut given.text {
            text.truncate(text.trim_ascii_end().len());
        }
        Ok(given)
    }

    fn add(&mut self, given: &mut Given<'a>, piece: &Text<'a>) {
        let value = piece.value(self.diagnostics);
        if given.span.is_empty() {
            let from_start = piece.raw.trim_ascii_start();
            let trimmed = from_start.trim_ascii_end();
            let start = piece.span.start + (piece.raw.len() - from_start.len()) as u32;
            given.span = Span { start, end: start + trimmed.len() as u32, ..piece.span };
            given.text = match value {
                Cow::Borrowed(_) => Cow::Borrowed(trimmed),
                Cow::Owned(text) => Cow::Owned(text.trim_ascii_start().to_owned()),
            };
        } else {
            // A comment or CDATA divides the text.
            given.text.to_mut().push_str(&value);
            given.span.end = piece.span.end;
        }
    }

    /// The attributes called `names`, by their position there; further ones become extensions.
    pub fn fields<const N: usize>(
        &mut self,
        tag: &Tag<'a>,
        names: &[&str; N],
        extensions: &mut Extensions,
    ) -> Read<[Given<'a>; N]> {
        let mut fields = std::array::from_fn(|_| Given::default());
        if !has_attributes(tag) {
            return Ok(fields);
        }
        for attribute in tag.attributes() {
            let attribute = attribute?;
            // Attributes with a prefix are those of XML Schema and of XML itself.
            if attribute.is_namespace() || !attribute.prefix.is_empty() {
                continue;
            }
            // XML tells cases apart, but a `revisionNo` can't mean anything else.
            let at = names.iter().position(|name| name.eq_ignore_ascii_case(attribute.name));
            match at.and_then(|at| fields.get_mut(at)) {
                Some(field) => {
                    let text = match attribute.value(self.diagnostics) {
                        Cow::Borrowed(text) => Cow::Borrowed(text.trim()),
                        Cow::Owned(text) => Cow::Owned(text.trim().to_owned()),
                    };
                    *field = Given { text, span: attribute.span };
                }
                None => {
                    let name = attribute.name;
                    self.lint(&codes::ESI_UNKNOWN_ELEMENT, attribute.name_span, || {
                        format!("<{}> has no attribute `{}` in ETG.2000", shortened(tag.name), shortened(name))
                    });
                    let key = format_compact!("{}@{}", shortened(tag.name), shortened(name));
                    let value = attribute.value(self.diagnostics).into();
                    extensions.push(Extension { key, value, span: attribute.span });
                }
            }
        }
        Ok(fields)
    }

    /// Reads a text with its language.
    pub fn name(&mut self, tag: &Tag<'a>, names: &mut Names<'a>, extensions: &mut Extensions) -> Read<()> {
        let mut lcid = None;
        if has_attributes(tag) {
            let [given] = self.fields(tag, &["LcId"], extensions)?;
            lcid = number::parse(&given.text).and_then(|number| u32::try_from(number.value).ok());
            if lcid.is_none() && !given.is_empty() {
                self.bad(&given, "number of a language", "read as if there were none");
            }
        }
        let given = self.content(extensions)?;
        if !given.is_empty() {
            names.0.push((lcid, given));
        }
        Ok(())
    }

    /// Files a finding that is off by default; it is phrased only where somebody asked for it.
    fn lint(&mut self, code: &'static Code, span: Span, message: impl FnOnce() -> String) {
        if self.diagnostics.wants(code) {
            self.diagnostics.push(Diagnostic::new(code, span, message()).label("kept as an extension attribute"));
        }
    }

    /// Keeps an element that ETG.2000 doesn't have at this place.
    pub fn unknown(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        self.lint(&codes::ESI_UNKNOWN_ELEMENT, tag.name_span(), || {
            format!("ETG.2000 has no element <{}> here", shortened(tag.name))
        });
        self.keep(tag, extensions)
    }

    /// Keeps the attributes and texts of an element and of those within it as `parent/element@attribute` extensions.
    pub fn keep(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        self.keep_attributes(tag, extensions)?;
        while self.cursor.depth() >= tag.depth {
            match self.cursor.read()? {
                Some(Event::Start(inner)) => self.keep_attributes(&inner, extensions)?,
                Some(Event::Text(text)) => {
                    let value = text.value(self.diagnostics);
                    let (key, value) = (self.cursor.innermost(), value.trim().into());
                    extensions.push(Extension { key, value, span: text.span });
                }
                Some(Event::End) => {}
                None => break,
            }
        }
        Ok(())
    }

    /// Keeps of VendorSpecific what stands on top: the name, the attributes and the text of each element in it. What is
    /// below has no meaning but to the tool of its vendor.
    pub fn vendor_specific(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        while let Some(child) = self.cursor.child(tag)? {
            self.keep_attributes(&child, extensions)?;
            let key = self.cursor.innermost();
            let (mut value, mut span) = (CompactString::default(), child.span);
            while self.cursor.depth() >= child.depth {
                match self.cursor.read()? {
                    Some(Event::Text(text)) if self.cursor.depth() == child.depth => {
                        value.push_str(text.value(self.diagnostics).trim());
                        span = text.span;
                    }
                    Some(_) => {}
                    None => break,
                }
            }
            extensions.push(Extension { key, value, span });
        }
        Ok(())
    }

    /// Notes the size of a picture that the file contains, or the name of one that it refers to.
    pub fn image(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        let given = self.leaf(tag, extensions)?;
        let value = if tag.name.contains("Data") {
            let digits = given.text.bytes().filter(u8::is_ascii_hexdigit).count();
            format_compact!("{} bytes", digits / 2)
        } else {
            given.compact()
        };
        extensions.push(Extension { key: tag.name.into(), value, span: given.span.or(tag.span) });
        Ok(())
    }

    /// Keeps the text of an element under its name.
    pub fn note(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        let given = self.leaf(tag, extensions)?;
        note(tag.name, &given, extensions);
        Ok(())
    }

    fn keep_attributes(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        if !has_attributes(tag) {
            return Ok(());
        }
        for attribute in tag.attributes() {
            let attribute = attribute?;
            let is_english = attribute.name == "LcId" && attribute.raw == "1033";
            if attribute.is_namespace() || is_english || attribute.raw.is_empty() {
                continue;
            }
            let key = format_compact!("{}@{}", self.cursor.innermost(), shortened(attribute.name));
            let value = attribute.value(self.diagnostics).into();
            extensions.push(Extension { key, value, span: attribute.span });
        }
        Ok(())
    }

    /// Whether so many items and bytes of texts may be copied. That they may not is told once.
    pub fn derive(&mut self, cost: (usize, usize), span: Span) -> bool {
        if self.budget.take(cost) {
            return true;
        }
        if !std::mem::replace(&mut self.budget.exceeded, true) {
            let message = "what is said once and counts for many would make the description many times longer";
            self.report(
                &codes::INPUT_TOO_LARGE,
                span,
                message,
                "it is left out from here on, and entries of objects with it",
            );
        }
        false
    }

    /// Reports a text whose form ETG.2000 doesn't allow.
    pub fn bad(&mut self, given: &Given<'_>, what: &str, label: impl Into<String>) {
        let message = format!("`{}` is no {what}", shortened(&given.text));
        self.report(&codes::ESI_VALUE, given.span, message, label);
    }

    pub fn report(&mut self, code: &'static Code, span: Span, message: impl Into<String>, label: impl Into<String>) {
        self.diagnostics.push(Diagnostic::new(code, span, message).label(label));
    }

    /// A number, however it is written; what is none is left to the caller to report.
    pub fn parse(&mut self, given: &Given<'_>) -> Option<Number> {
        let number = number::parse(&given.text)?;
        if let Some(fault) = number.fault {
            let text = shortened(&given.text);
            let (code, message, fix) = match fault {
                Fault::Bare => {
                    (&codes::BARE_HEX, format!("`{text}` has hexadecimal digits"), format!("#x{}", given.text))
                }
                Fault::TwoPrefixes => {
                    (&codes::ESI_VALUE, format!("`{text}` has two prefixes"), format!("#x{}", &given.text[4..]))
                }
            };
            let found = Diagnostic::new(code, given.span, message).label(format!("read as {:#x}", number.value));
            self.diagnostics.push(found.fix(fix));
        }
        Some(number)
    }

    /// A number that fits `T`; anything else is reported.
    pub fn int<T: TryFrom<i128>>(&mut self, given: &Given<'_>, what: &str) -> Option<T> {
        if given.is_empty() {
            return None;
        }
        let Some(number) = self.parse(given) else {
            self.bad(given, what, "left out; expected a decimal number or `#x` and hexadecimal digits");
            return None;
        };
        let value = T::try_from(number.value).ok();
        if value.is_none() {
            self.bad(given, what, "left out; the number is too large or negative");
        }
        value
    }

    /// The number in an element.
    pub fn number<T: TryFrom<i128>>(
        &mut self,
        tag: &Tag<'a>,
        what: &str,
        extensions: &mut Extensions,
    ) -> Read<Option<T>> {
        let given = self.leaf(tag, extensions)?;
        Ok(self.int(&given, what))
    }

    /// `true`, `false`, 1 or 0; not given is false.
    pub fn flag(&mut self, given: &Given<'_>) -> bool {
        match given.text.as_ref() {
            "" | "0" | "false" => return false,
            "1" | "true" => return true,
            _ => {}
        }
        let number = number::parse(&given.text).map(|number| number.value);
        let value = number.is_some_and(|value| value != 0)
            || ["true", "yes"].iter().any(|word| word.eq_ignore_ascii_case(&given.text));
        self.bad(given, "`true` or `false`", format!("read as {value}"));
        value
    }

    /// Pairs of hexadecimal digits, blanks between them allowed.
    pub fn octets(&mut self, given: &Given<'_>) -> Option<Vec<u8>> {
        let digits = given.text.bytes().filter(|byte| !byte.is_ascii_whitespace());
        let count = digits.clone().count();
        let mut octets = Vec::with_capacity(count / 2 + 1);
        let mut high = None;
        // Of an odd number of digits the first stands for a byte of its own.
        if count % 2 == 1 {
            high = Some(0);
        }
        for digit in digits {
            let Some(digit) = number::nibble(digit) else {
                self.bad(given, "row of hexadecimal digits", "left out");
                return None;
            };
            match high.take() {
                Some(high) => octets.push(high << 4 | digit),
                None => high = Some(digit),
            }
        }
        if count % 2 == 1 {
            self.diagnostics.push(
                Diagnostic::new(&codes::ODD_HEX, given.span, "the number of hexadecimal digits is odd")
                    .label("a zero was put in front")
                    .fix(format!("0{}", given.text)),
            );
        }
        Some(octets)
    }
}

/// Whether anything stands between the name of a tag and its end.
pub(super) fn has_attributes(tag: &Tag<'_>) -> bool {
    tag.span.end.saturating_sub(tag.name_span().end) > 1 + u32::from(tag.empty)
}

/// Keeps something that was read as an extension.
pub(super) fn note(key: &str, given: &Given<'_>, extensions: &mut Extensions) {
    if !given.is_empty() {
        extensions.push(Extension { key: key.into(), value: given.compact(), span: given.span });
    }
}
