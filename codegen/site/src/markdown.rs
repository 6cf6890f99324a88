//! Pages of Markdown, for repositories and `mdBook`. Texts go through [`Escape`], which `askama.toml` names.

use std::collections::HashSet;
use std::fmt::{self, Write};

use askama::Template;

use super::area::Area;
use super::assumptions::Ranked;
use super::codes::Codes;
use super::findings::Finding;
use super::machines::{Machine, Sequence, ANY_STATE};
use super::modules::ModuleModel;
use super::overview::{Contents, Overview};
use super::pages::{Around, Catalogue, List, Listed, Pages, FIRST};
use super::process::{Frame, SyncManager};
use super::protocol::Protocol;
use super::Page;
use lexibus_codegen::facts::markdown;

/// Shows texts as they are, on one line, whatever marks of Markdown or HTML are in them.
#[derive(Clone, Copy)]
pub(super) struct Escape;

impl askama::filters::Escaper for Escape {
    fn write_escaped_str<W: Write>(&self, mut target: W, text: &str) -> fmt::Result {
        target.write_str(&markdown::escape(text, is_visible))
    }
}

/// Whether a letter shows what it is: neither a control character, nor one that changes how others are shown.
fn is_visible(letter: char) -> bool {
    let is_invisible =
        matches!(letter, '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2060}'..='\u{206F}' | '\u{FEFF}');
    !letter.is_control() && !is_invisible
}

#[derive(Template)]
#[template(path = "markdown/overview.md")]
struct OverviewPage<'p> {
    title: &'p str,
    own: &'p Overview,
    contents: &'p Contents,
    links: &'p [&'p (String, String)],
}

#[derive(Template)]
#[template(path = "markdown/area.md")]
struct AreaPage<'p> {
    own: &'p Area,
}

#[derive(Template)]
#[template(path = "markdown/process.md")]
struct ProcessPage<'p> {
    frames: &'p [Frame],
    sync_managers: &'p [SyncManager],
}

#[derive(Template)]
#[template(path = "markdown/protocol.md")]
struct ProtocolPage<'p> {
    own: &'p Protocol,
}

#[derive(Template)]
#[template(path = "markdown/codes.md")]
struct CodesPage<'p> {
    tables: &'p [Codes],
}

#[derive(Template)]
#[template(path = "markdown/machines.md")]
struct MachinesPage<'p> {
    machines: &'p [Machine],
    sequences: &'p [Sequence],
}

#[derive(Template)]
#[template(path = "markdown/modules.md")]
struct ModulesPage<'p> {
    modules: &'p [ModuleModel],
}

#[derive(Template)]
#[template(path = "markdown/assumptions.md")]
struct AssumptionsPage<'p> {
    ranked: &'p [Ranked<'p>],
}

#[derive(Template)]
#[template(path = "markdown/findings.md")]
struct FindingsPage<'p> {
    findings: &'p [Finding],
}

#[derive(Template)]
#[template(path = "markdown/list.md")]
struct ListPage<'p> {
    title: &'p str,
    devices: &'p [Listed],
    links: &'p [&'p (String, String)],
}

#[derive(Template)]
#[template(path = "markdown/summary.md")]
struct SummaryPage<'p> {
    catalogs: &'p [Catalogue],
}

/// A page, with one empty line where the template leaves several. Templates don't fail on what they are given.
fn written(template: &impl Template) -> String {
    let rendered = template.render().unwrap_or_default();
    let mut text = String::with_capacity(rendered.len());
    let mut was_empty = true;
    for line in rendered.lines().map(str::trim_end) {
        if !(was_empty && line.is_empty()) {
            text.push_str(line);
            text.push('\n');
        }
        was_empty = line.is_empty();
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

/// Pages of Markdown.
pub(super) struct Markdown;

impl Pages for Markdown {
    fn ending(&self) -> &'static str {
        ".md"
    }

    /// What repositories show of a folder. Further down, links to a page of that name lead nowhere in `mdBook`, which calls it
    /// otherwise.
    fn front(&self) -> &'static str {
        "README"
    }

    fn overview(&self, around: Around<'_>, own: &Overview, contents: &Contents) -> String {
        // The overview itself is the first of them; areas, process data and slots have lists of their own.
        let areas: HashSet<&str> = contents.areas.iter().map(|(area, ..)| area.as_str()).collect();
        let shown = |file: &str| areas.contains(file) || file == around.file;
        let links: Vec<_> = links(around).into_iter().filter(|(file, _)| !shown(file)).collect();
        written(&OverviewPage { title: &around.set.title, own, contents, links: &links })
    }

    fn area(&self, _: Around<'_>, own: &Area) -> String {
        written(&AreaPage { own })
    }

    fn process(&self, _: Around<'_>, frames: &[Frame], sync_managers: &[SyncManager]) -> String {
        written(&ProcessPage { frames, sync_managers })
    }

    fn protocol(&self, _: Around<'_>, own: &Protocol) -> String {
        written(&ProtocolPage { own })
    }

    fn codes(&self, _: Around<'_>, tables: &[Codes]) -> String {
        written(&CodesPage { tables })
    }

    fn machines(&self, _: Around<'_>, machines: &[Machine], sequences: &[Sequence]) -> String {
        written(&MachinesPage { machines, sequences })
    }

    fn modules(&self, _: Around<'_>, modules: &[ModuleModel]) -> String {
        written(&ModulesPage { modules })
    }

    fn assumptions(&self, _: Around<'_>, ranked: &[Ranked<'_>]) -> String {
        written(&AssumptionsPage { ranked })
    }

    fn findings(&self, _: Around<'_>, findings: &[Finding]) -> String {
        written(&FindingsPage { findings })
    }

    fn list(&self, around: Around<'_>, list: List<'_>) -> String {
        written(&ListPage { title: &around.set.title, devices: list.devices, links: &links(around) })
    }

    fn of_catalog(&self, _: &dyn Fn() -> String) -> Vec<Page> {
        Vec::new()
    }

    fn of_site(&self, catalogs: &[Catalogue], _: Option<&dyn Fn() -> String>) -> Vec<Page> {
        vec![Page::new("SUMMARY.md", written(&SummaryPage { catalogs }))]
    }
}

/// The pages that one leads to. The first of a folder leads to all of them: most others lead to none.
fn links<'s>(around: Around<'s>) -> Vec<&'s (String, String)> {
    let is_first = around.file.strip_suffix(".md") == Some(FIRST);
    if is_first {
        around.set.all()
    } else {
        around.set.near(around.file)
    }
}

impl Machine {
    /// The transitions as lines of a state diagram of Mermaid, which has its own rules of what a name is.
    fn lines(&self) -> Vec<String> {
        let label = |text: &str| -> String {
            let is_plain = |letter: char| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_' | '.' | '/');
            text.chars().map(|letter| if is_plain(letter) { letter } else { ' ' }).collect()
        };
        let place = |name: &str| self.states.iter().position(|own| own.name == name);
        let mut lines: Vec<String> = Vec::new();
        for (at, state) in self.states.iter().enumerate() {
            lines.push(format!("state \"{}\" as s{at}", label(&state.name)));
        }
        lines.extend(self.initial.as_deref().and_then(place).map(|at| format!("[*] --> s{at}")));
        let any = self.states.len();
        if self.transitions.iter().any(|way| way.from.is_none()) {
            lines.push(format!("state \"{ANY_STATE}\" as s{any}"));
        }
        for way in &self.transitions {
            let from = way.from.as_deref().map_or(Some(any), place);
            let Some((from, to)) = from.zip(place(&way.to)) else { continue };
            lines.push(format!("s{from} --> s{to}: {} {}", label(&way.number), label(&way.command)));
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use askama::filters::Escaper;

    use super::super::links::Links;
    use super::super::pages::Frameset;
    use super::*;

    fn shown(text: &str) -> String {
        let mut target = String::new();
        Escape.write_escaped_str(&mut target, text).expect("a text");
        target
    }

    #[test]
    fn the_first_page_leads_to_all_of_very_many() {
        let pages = (0..1000).map(|at| (format!("modules-{at}.md"), format!("Modules {at}"))).collect();
        let set = Frameset {
            title: "Coupler".to_owned(),
            own: Rc::default(),
            shared: Rc::new(Links::new(pages, 0..1000)),
            languages: Vec::new(),
        };
        let linked = |file: &str| {
            let list = List { devices: &[], root: "", index: "" };
            Markdown.list(Around { set: &set, file }, list).matches("](modules-").count()
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
