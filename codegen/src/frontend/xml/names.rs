//! Text in the languages of a file.

use std::sync::Arc;

use compact_str::CompactString;
use smallvec::SmallVec;

use super::Given;
use crate::ir::{Documentation, LocalText, Texts};
use crate::source::Span;

/// Language of a text, in the notation of a file format.
pub trait Language {
    /// Returns the rank of the language. The text with the lowest rank becomes the name of the element.
    fn rank(&self) -> u8;

    /// Returns the BCP 47 tag of the language.
    fn tag(&self) -> CompactString;
}

/// Text in several languages.
#[derive(Clone, Debug)]
pub struct Names<'a, L>(SmallVec<[(L, Given<'a>); 1]>);

impl<L> Default for Names<'_, L> {
    fn default() -> Self {
        Names(SmallVec::new())
    }
}

impl<'a, L: Language> Names<'a, L> {
    /// Adds a text in the language `language`.
    pub fn push(&mut self, language: L, given: Given<'a>) {
        self.0.push((language, given));
    }

    /// Adds the texts of `other`.
    pub fn append(&mut self, mut other: Self) {
        self.0.append(&mut other.0);
    }

    /// Returns whether there is no text in any language.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the position of the text that serves as the name.
    fn best(&self) -> usize {
        let ranks = self.0.iter().enumerate().map(|(at, (language, _))| (language.rank(), at));
        ranks.min().map_or(0, |(_, at)| at)
    }

    /// Returns the text that serves as the name.
    pub fn given(&self) -> Option<&Given<'a>> {
        self.0.get(self.best()).map(|(_, given)| given)
    }

    /// Returns the text that serves as the name, or an empty string if there is no text.
    pub fn name(&self) -> CompactString {
        self.given().map_or_else(CompactString::default, Given::compact)
    }

    /// Returns the span of the text that serves as the name.
    pub fn span(&self) -> Span {
        self.given().map_or_else(Span::default, |given| given.span)
    }

    /// Returns all texts except the one that serves as the name.
    pub fn others(&self) -> Texts {
        if self.0.len() < 2 {
            return Texts::default();
        }
        let best = self.best();
        self.all().enumerate().filter(|(at, _)| *at != best).map(|(_, text)| text).collect()
    }

    /// Returns all texts that differ from `name`.
    pub fn except(&self, name: &str) -> Texts {
        self.all().filter(|text| text.text != name).collect()
    }

    /// Returns an iterator over all texts with their languages.
    pub fn all(&self) -> impl Iterator<Item = LocalText> + '_ {
        self.0.iter().map(|(language, given)| LocalText { language: language.tag(), text: given.compact() })
    }

    /// Returns the texts as documentation of an element: the text with the lowest rank as the description, and the
    /// others as translations. Returns `None` if there is no text.
    pub fn documentation(&self) -> Option<Arc<Documentation>> {
        let text = self.given()?.text.as_ref().into();
        Some(Arc::new(Documentation { text, translations: self.others(), ..Documentation::default() }))
    }

    /// Returns the number of bytes that a copy of all texts needs.
    pub fn weight(&self) -> usize {
        self.0.iter().map(|(_, given)| size_of::<LocalText>() + given.text.len()).sum()
    }

    /// Returns whether `self` and `other` have a text in the same language. Also returns true if `self` has more than
    /// 255 texts.
    pub fn shares_language(&self, other: &Names<'_, L>) -> bool {
        let has = |language: &L| other.0.iter().any(|(other, _)| other.tag() == language.tag());
        self.0.len() > 255 || self.0.iter().any(|(language, _)| has(language))
    }
}
