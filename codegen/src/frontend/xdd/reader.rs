//! The state of reading one file, and the reading of single attributes, labels and elements.

use std::borrow::Cow;

use compact_str::{format_compact, CompactString};

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::frontend::canopen::number;
use crate::frontend::canopen::value::Converter;
use crate::ir::{self, Documentation, Extension, Extensions, LocalText};
use crate::source::Span;
use crate::syntax::xml::{Attribute, Cursor, Event, Tag};
use crate::text::brief as shortened;

/// A result that ends the reading of the file with one diagnostic.
pub(super) type Read<T> = Result<T, Box<Diagnostic>>;

pub(super) struct Reader<'a, 'd> {
    pub cursor: Cursor<'a>,
    /// The whole file.
    pub text: &'a str,
    pub diagnostics: &'d mut Diagnostics,
    pub aliases: &'d [String],
}

/// What an attribute says, and where. What is empty isn't given.
#[derive(Clone, Debug)]
pub(super) struct Given<'a> {
    pub text: Cow<'a, str>,
    pub span: Span,
}

/// Labels and descriptions in the languages of the source.
#[derive(Clone, Debug, Default)]
pub(super) struct Texts {
    pub labels: Vec<LocalText>,
    pub descriptions: Vec<LocalText>,
}

impl Texts {
    /// The English label, or the first.
    pub fn label(&self) -> CompactString {
        first(&self.labels).map_or_else(CompactString::default, |text| text.text.clone())
    }

    /// The labels that aren't `name`.
    pub fn names(&self, name: &str) -> ir::Texts {
        self.labels.iter().filter(|label| label.text != name).cloned().collect()
    }

    /// The descriptions, the English or the first one in front.
    pub fn documentation(&self) -> Option<Box<Documentation>> {
        let main = first(&self.descriptions)?;
        let others = self.descriptions.iter().filter(|other| !std::ptr::eq(*other, main));
        let (text, translations) = (main.text.to_string(), others.cloned().collect());
        Some(Box::new(Documentation { text, translations, ..Documentation::default() }))
    }
}

fn first(texts: &[LocalText]) -> Option<&LocalText> {
    let english = |text: &&LocalText| text.language == "en" || text.language.starts_with("en-");
    texts.iter().find(english).or(texts.first())
}

impl<'a, 'd> Reader<'a, 'd> {
    pub(super) fn converter(&mut self) -> Converter<'_> {
        Converter { diagnostics: self.diagnostics, aliases: self.aliases }
    }

    /// The attributes called `names`, by their position there; further ones become extensions.
    pub(super) fn fields<const N: usize>(
        &mut self,
        tag: &Tag<'a>,
        names: &[&str; N],
        extensions: &mut Extensions,
    ) -> Read<[Option<Given<'a>>; N]> {
        let mut fields = [const { None }; N];
        for attribute in tag.attributes() {
            let attribute = attribute?;
            // Attributes with a prefix are those of XML Schema and of XML itself.
            if attribute.is_namespace() || !attribute.prefix.is_empty() {
                continue;
            }
            // XML tells cases apart, but a `PDOMapping` can't mean anything else.
            match names.iter().position(|name| name.eq_ignore_ascii_case(attribute.name)) {
                Some(at) => fields[at] = self.given(&attribute),
                None => {
                    if self.diagnostics.wants(&codes::UNKNOWN_ELEMENT) {
                        let message = format!("<{}> has no such attribute in CiA 311", shortened(tag.name));
                        self.diagnostics.push(
                            Diagnostic::new(&codes::UNKNOWN_ELEMENT, attribute.name_span, message)
                                .label("kept as an extension attribute"),
                        );
                    }
                    let value = attribute.value(self.diagnostics).into();
                    extensions.push(Extension { key: attribute.name.into(), value, span: attribute.span });
                }
            }
        }
        Ok(fields)
    }

    /// The attribute `name`.
    pub(super) fn field(&mut self, tag: &Tag<'a>, name: &str) -> Read<Option<Given<'a>>> {
        Ok(tag.attribute(name)?.and_then(|attribute| self.given(&attribute)))
    }

    fn given(&mut self, attribute: &Attribute<'a>) -> Option<Given<'a>> {
        let text = match attribute.value(self.diagnostics) {
            Cow::Borrowed(text) => Cow::Borrowed(text.trim()),
            Cow::Owned(text) => Cow::Owned(text.trim().to_owned()),
        };
        (!text.is_empty()).then_some(Given { text, span: attribute.span })
    }

    /// The text of an element.
    pub(super) fn content(&mut self, tag: &Tag<'a>) -> Read<Option<Given<'a>>> {
        let content = self.cursor.content(tag, self.diagnostics)?;
        Ok((!content.text.is_empty()).then_some(Given { text: content.text, span: content.span }))
    }

    /// Reads a label or description; false for any other element.
    pub(super) fn texts(&mut self, tag: &Tag<'a>, texts: &mut Texts) -> Read<bool> {
        let list = match tag.name {
            "label" => &mut texts.labels,
            "description" => &mut texts.descriptions,
            _ => return Ok(false),
        };
        let language = match tag.attribute("lang")? {
            Some(attribute) => attribute.value(self.diagnostics).trim().into(),
            None => CompactString::default(),
        };
        if let Some(content) = self.content(tag)? {
            list.push(LocalText { language, text: content.text.into() });
        }
        Ok(true)
    }

    /// Keeps an element that CiA 311 doesn't have at this place.
    pub(super) fn unknown(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        if self.diagnostics.wants(&codes::UNKNOWN_ELEMENT) {
            self.diagnostics.push(
                Diagnostic::new(&codes::UNKNOWN_ELEMENT, tag.name_span(), "CiA 311 has no such element here")
                    .label("kept as extension attributes"),
            );
        }
        self.keep(tag, extensions)
    }

    /// Keeps the attributes and texts of an element and of those within it as `parent/element@attribute` extensions.
    pub(super) fn keep(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
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

    /// The length in bytes of an element that was just read to its end.
    pub(super) fn length(&self, tag: &Tag<'a>) -> usize {
        self.cursor.offset().saturating_sub(tag.span.start) as usize
    }

    /// Reads an element that has no children in CiA 311 to its end.
    pub(super) fn no_children(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        while let Some(child) = self.cursor.child(tag)? {
            self.unknown(&child, extensions)?;
        }
        Ok(())
    }

    fn keep_attributes(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        for attribute in tag.attributes() {
            let attribute = attribute?;
            let is_english = attribute.name == "lang" && attribute.raw == "en";
            if attribute.is_namespace() || is_english || attribute.raw.is_empty() {
                continue;
            }
            let key = format_compact!("{}@{}", self.cursor.innermost(), shortened(attribute.name));
            let value = attribute.value(self.diagnostics).into();
            extensions.push(Extension { key, value, span: attribute.span });
        }
        Ok(())
    }

    /// Reports an attribute or text whose form CiA 311 doesn't allow.
    pub(super) fn bad(&mut self, given: &Given<'_>, what: &str, label: impl Into<String>) {
        let message = format!("`{}` is no {what}", shortened(&given.text));
        self.diagnostics.push(Diagnostic::new(&codes::XDD_VALUE, given.span, message).label(label));
    }

    /// A number up to `max`; anything else is reported.
    pub(super) fn unsigned(&mut self, given: Option<&Given<'_>>, max: u32, what: &str) -> Option<u32> {
        let given = given?;
        let value = integer(&given.text).and_then(|value| u32::try_from(value).ok()).filter(|&value| value <= max);
        if value.is_none() {
            self.bad(given, what, format!("left out; expected a number from 0 to {max}"));
        }
        value
    }

    /// Hexadecimal digits (hexBinary of XML Schema).
    pub(super) fn hex(&mut self, given: Option<&Given<'_>>, max: u32, what: &str) -> Option<u32> {
        let given = given?;
        let text = given.text.as_ref();
        let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")).unwrap_or(text);
        let value = if digits.starts_with('+') { None } else { u64::from_str_radix(digits, 16).ok() };
        let value = value.and_then(|value| u32::try_from(value).ok()).filter(|&value| value <= max);
        match value {
            None => self.bad(given, what, "left out; expected hexadecimal digits"),
            Some(value) if digits.len() != text.len() => {
                let message = format!("{text} has a prefix, which CiA 311 doesn't want here");
                self.diagnostics.push(
                    Diagnostic::new(&codes::XDD_VALUE, given.span, message)
                        .label(format!("read as {value:#06x}"))
                        .fix(digits),
                );
            }
            Some(_) => {}
        }
        value
    }

    /// `true` or `false`, also as 1 or 0; not given is false.
    pub(super) fn flag(&mut self, given: Option<&Given<'_>>) -> bool {
        let Some(given) = given else { return false };
        match given.text.as_ref() {
            "true" | "1" => return true,
            "false" | "0" => return false,
            _ => {}
        }
        let value = ["true", "yes"].iter().any(|word| word.eq_ignore_ascii_case(&given.text));
        self.bad(given, "`true` or `false`", format!("read as {value}"));
        value
    }

    /// A real number.
    pub(super) fn real(&mut self, given: Option<&Given<'_>>, what: &str) -> Option<f64> {
        let given = given?;
        let value = given.text.parse::<f64>().ok().filter(|value| value.is_finite());
        if value.is_none() {
            self.bad(given, what, "left out");
        }
        value
    }
}

/// Keeps something that was read as an extension.
pub(super) fn note(key: &str, given: Option<&Given<'_>>, extensions: &mut Extensions) {
    if let Some(given) = given {
        extensions.push(Extension { key: key.into(), value: given.text.as_ref().into(), span: given.span });
    }
}
/// An integer as XML Schema writes it: it has no octal numbers, so that a leading zero says nothing. Prefixes are taken as well.
pub(super) fn integer(text: &str) -> Option<i128> {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    match !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()) {
        true => text.parse().ok(),
        false => number::parse(text, &[]).int(),
    }
}
