//! Reads elements that occur in many parent elements: texts with a language, images, vendor-specific elements.

use compact_str::format_compact;

use super::number;
use super::reader::{Lcid, Names, Reader};
use crate::frontend::xml::Read;
use crate::ir::{CompactString, Extension};
use crate::syntax::xml::{Event, Tag};

impl<'a> Reader<'a, '_> {
    /// Reads a text with its language and adds it to `names`.
    pub fn name(&mut self, tag: &Tag<'a>, names: &mut Names<'a>) -> Read<()> {
        let [given] = self.attributes(tag, ["LcId"])?;
        let lcid = number::parse(&given.text).and_then(|number| u32::try_from(number.value).ok());
        if lcid.is_none() && !given.is_empty() {
            let action = "read as a text without a language; expected a number, such as 1033 for English";
            self.bad(&given, "Windows language identifier", action);
        }
        let given = self.content()?;
        if !given.is_empty() {
            names.push(Lcid(lcid), given);
        }
        Ok(())
    }

    /// Stores the text of an element as an extension with the element's name as the key.
    pub fn note_text(&mut self, tag: &Tag<'a>) -> Read<()> {
        let given = self.text(tag)?;
        self.note(tag.name, &given);
        Ok(())
    }

    /// Stores the children of a `VendorSpecific` element as extensions, with attributes and texts. Elements inside the
    /// children are dropped because only the vendor's tool uses them.
    pub fn vendor_specific(&mut self, tag: &Tag<'a>) -> Read<()> {
        while let Some(child) = self.child(tag)? {
            self.keep_attributes(&child)?;
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
            self.extensions.push(Extension { key, value, span });
        }
        Ok(())
    }

    /// Stores the size of an embedded image, or the name of an image file, as an extension.
    pub fn image(&mut self, tag: &Tag<'a>) -> Read<()> {
        let given = self.text(tag)?;
        let value = if tag.name.contains("Data") {
            let digits = given.text.bytes().filter(u8::is_ascii_hexdigit).count();
            format_compact!("{} bytes", digits / 2)
        } else {
            given.compact()
        };
        self.extensions.push(Extension { key: tag.name.into(), value, span: given.span.or(tag.span) });
        Ok(())
    }
}
