//! Writes HTML pages with drawings and a search. Askama's HTML escaper escapes all texts.

use std::fmt;

use askama::Template;

use super::area::{Area, Section};
use super::bits::{self, Grids};
use super::list::Column;
use super::listed::{Listed, ListedCatalog};
use super::modules::ModuleModel;
use super::pages::{Content, Frameset, Pages};
use super::protocol::Protocol;
use super::search::Index;
use super::{written, Page};

/// The style sheet of the pages.
const STYLE: &str = include_str!("../templates/site.css");

/// The script. Its parts share one scope, because browsers do not load JavaScript modules from disk.
const SCRIPT: &str = concat!(
    include_str!("../templates/script/frame.js"),
    include_str!("../templates/script/devices.js"),
    include_str!("../templates/script/rows.js"),
    include_str!("../templates/script/value.js"),
    include_str!("../templates/script/requests.js"),
    include_str!("../templates/script/decoder.js"),
    include_str!("../templates/script/builder.js"),
    include_str!("../templates/script/machines.js"),
    include_str!("../templates/script/index.js"),
    include_str!("../templates/script/search.js"),
    include_str!("../templates/script/start.js"),
);

/// A section of a page, rendered only to measure its size.
#[derive(Template)]
#[template(
    ext = "html",
    source = "{% import \"parts.html\" as parts %}{% call parts::section(section) %}{% endcall %}"
)]
struct SectionPart<'p> {
    section: &'p Section,
}

/// A module on a page, rendered only to measure its size.
#[derive(Template)]
#[template(ext = "html", source = "{% import \"parts.html\" as parts %}{% call parts::module(module) %}{% endcall %}")]
struct ModulePart<'p> {
    module: &'p ModuleModel,
}

/// A row of a list, rendered only to measure its size.
#[derive(Template)]
#[template(
    ext = "html",
    source = "{% import \"parts.html\" as parts %}{% call parts::device(device, columns, root) %}{% endcall %}"
)]
struct DevicePart<'p> {
    device: &'p Listed,
    columns: &'p [Column],
    root: &'static str,
}

/// Counts the bytes that are written.
struct Counter(usize);

impl fmt::Write for Counter {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0 += text.len();
        Ok(())
    }
}

fn size(template: &impl Template) -> usize {
    let mut counter = Counter(0);
    // Rendering cannot fail, see `written`.
    let _ = template.render_into(&mut counter);
    counter.0
}

/// Returns the size in bytes of a section. The links to related elements are not included, because they are added
/// later.
pub(super) fn size_of_section(section: &Section) -> usize {
    size(&SectionPart { section })
}

/// Returns the size of a module in bytes.
pub(super) fn size_of_module(module: &ModuleModel) -> usize {
    size(&ModulePart { module })
}

/// Returns the size in bytes of a device's row in the list of all devices.
pub(super) fn size_of_device(device: &Listed, columns: &[Column]) -> usize {
    size(&DevicePart { device, columns, root: "." })
}

#[derive(Template)]
#[template(path = "latest.html")]
struct LatestPage<'p> {
    title: &'p str,
    target: &'p str,
}

/// The script of [`LatestPage`].
const LATEST: &str = include_str!("../templates/script/latest.js");

/// The HTML format.
pub(super) struct Html;

impl Pages for Html {
    fn ending(&self) -> &'static str {
        ".html"
    }

    fn page(&self, frame: &Frameset, file: &str, content: Content<'_>) -> String {
        content.html(frame, file)
    }

    fn redirection(&self, title: &str, target: &str) -> Option<String> {
        Some(written::html(&LatestPage { title, target }))
    }

    fn of_catalog(&self, index: &Index) -> Vec<Page> {
        vec![Page::new("search.js", index.script())]
    }

    fn of_site(&self, _: &[ListedCatalog], _: &[(String, String)], index: Option<&Index>) -> Vec<Page> {
        let files = [("site.css", STYLE), ("site.js", SCRIPT), ("latest.js", LATEST)];
        let mut pages: Vec<Page> = files.iter().map(|(path, text)| Page::new(path, (*text).to_owned())).collect();
        if let Some(index) = index {
            pages.push(Page::new("search-first.js", index.first_script()));
            pages.push(Page::new("search.js", index.script()));
        }
        pages
    }
}

/// Returns the bit grids that the bit fields in these sections need.
fn grids<'p>(sections: impl IntoIterator<Item = &'p Section>) -> Grids {
    let rows = sections.into_iter().flat_map(|section| &section.rows);
    bits::grids(rows.filter_map(|row| row.bits.as_ref()))
}

impl Area {
    pub fn grids(&self) -> Grids {
        grids(&self.sections)
    }
}

impl Protocol {
    pub fn grids(&self) -> Grids {
        let messages = self.messages.iter();
        let parts = messages.flat_map(|message| message.request.iter().chain(&message.reply));
        bits::grids(parts.filter_map(|part| part.bits.as_ref()))
    }
}

pub(super) fn grids_of_modules(modules: &[ModuleModel]) -> Grids {
    let sections = modules.iter().flat_map(|module| &module.sections);
    grids(sections.map(|(_, section)| section))
}
