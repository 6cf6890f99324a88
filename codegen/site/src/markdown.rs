//! Writes Markdown pages for repositories and `mdBook`. All texts are escaped by [`Escape`], which `askama.toml`
//! configures.

use std::collections::HashSet;
use std::fmt::{self, Write};

use askama::Template;

use super::diagram::ANY_STATE;
use super::listed::ListedCatalog;
use super::machines::Machine;
use super::overview::Contents;
use super::pages::{Content, Frameset, Pages, FIRST};
use super::search::Index;
use super::{written, Page};
use lexibus_codegen::facts::markdown;

/// Escapes Markdown and HTML characters and joins the lines of a text.
#[derive(Clone, Copy)]
pub(super) struct Escape;

impl askama::filters::Escaper for Escape {
    fn write_escaped_str<W: Write>(&self, mut target: W, text: &str) -> fmt::Result {
        target.write_str(&markdown::escape(text, is_visible))
    }
}

/// Returns whether a character is visible. Control characters, line separators, zero-width characters and direction marks are
/// invisible.
fn is_visible(letter: char) -> bool {
    let is_invisible =
        matches!(letter, '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2060}'..='\u{206F}' | '\u{FEFF}');
    !letter.is_control() && !is_invisible
}

#[derive(Template)]
#[template(path = "markdown/summary.md")]
struct SummaryPage<'p> {
    catalogs: &'p [ListedCatalog],
    further: &'p [(String, String)],
}

/// The Markdown format.
pub(super) struct Markdown;

impl Pages for Markdown {
    fn ending(&self) -> &'static str {
        ".md"
    }

    fn page(&self, frame: &Frameset, file: &str, content: Content<'_>) -> String {
        content.markdown(frame, file)
    }

    fn of_site(&self, catalogs: &[ListedCatalog], further: &[(String, String)], _: Option<&Index>) -> Vec<Page> {
        vec![Page::new("SUMMARY.md", written::markdown(&SummaryPage { catalogs, further }))]
    }
}

/// Returns the links of a page. The first page of a folder links to all pages. If there are very many pages, any other
/// page links only to some of them.
pub(super) fn links<'s>(frame: &'s Frameset, file: &str) -> Vec<&'s (String, String)> {
    let is_first = file.strip_suffix(".md") == Some(FIRST);
    if is_first {
        frame.all()
    } else {
        frame.near(file)
    }
}

/// Returns the links of the overview of a device, without the link to the overview itself and the links to the areas, which
/// have their own list.
pub(super) fn links_of_overview<'s>(frame: &'s Frameset, file: &str, contents: &Contents) -> Vec<&'s (String, String)> {
    let areas: HashSet<&str> = contents.areas.iter().map(|(area, ..)| area.as_str()).collect();
    let mut links = links(frame, file);
    links.retain(|(linked, _)| !areas.contains(linked.as_str()) && linked != file);
    links
}

impl Machine {
    /// Returns the transitions as lines of a Mermaid state diagram. Spaces replace most punctuation in the labels,
    /// because Mermaid restricts their characters.
    pub fn lines(&self) -> Vec<String> {
        let label = |text: &str| -> String {
            let is_plain = |letter: char| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_' | '.' | '/');
            text.chars().map(|letter| if is_plain(letter) { letter } else { ' ' }).collect()
        };
        let position = |name: &str| self.states.iter().position(|state| state.name == name);
        let mut lines: Vec<String> = Vec::new();
        for (at, state) in self.states.iter().enumerate() {
            lines.push(format!("state \"{}\" as s{at}", label(&state.name)));
        }
        lines.extend(self.initial.as_deref().and_then(position).map(|at| format!("[*] --> s{at}")));
        let any = self.states.len();
        if self.transitions.iter().any(|transition| transition.from.is_none()) {
            lines.push(format!("state \"{ANY_STATE}\" as s{any}"));
        }
        for transition in &self.transitions {
            let from = transition.from.as_deref().map_or(Some(any), position);
            let Some((from, to)) = from.zip(position(&transition.to)) else { continue };
            lines.push(format!("s{from} --> s{to}: {} {}", label(&transition.number), label(&transition.command)));
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use askama::filters::Escaper;

    use super::super::links::Links;
    use super::*;

    fn shown(text: &str) -> String {
        let mut target = String::new();
        Escape.write_escaped_str(&mut target, text).expect("a text");
        target
    }

    #[test]
    fn the_first_page_has_links_to_all_pages() {
        let pages = (0..1000).map(|at| (format!("modules-{at}.md"), format!("Modules {at}"))).collect();
        let frame = Frameset {
            title: "Coupler".to_owned(),
            shared: Rc::new(Links::new(pages, 0..1000)),
            ..Frameset::default()
        };
        let linked = |file: &str| {
            Markdown.page(&frame, file, Content::List { devices: &[], is_part: false }).matches("](modules-").count()
        };
        assert_eq!(linked("index.md"), 1000);
        assert_eq!(linked("drive.md"), 21);
    }

    #[test]
    fn texts_are_no_markup() {
        assert_eq!(shown("<b>|`x`\n# y"), r"\<b\>\|\`x\` \# y");
        assert_eq!(shown("3 … 4 → 5 ≤ °C"), "3 … 4 → 5 ≤ °C");
        assert_eq!(shown("a\u{202E}b\u{7}c"), "a b c");
    }
}
