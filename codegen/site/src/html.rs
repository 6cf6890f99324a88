//! Pages of HTML, with drawings and a search. Texts go through askama's escaper for HTML.

use askama::Template;

use super::area::Area;
use super::assumptions::Ranked;
use super::bits::{self, Grids};
use super::codes::Codes;
use super::findings::Finding;
use super::machines::{Machine, Sequence};
use super::modules::ModuleModel;
use super::overview::{Contents, Overview};
use super::pages::{Around, Catalogue, Frameset, List, Listed, Pages};
use super::process::{Frame, SyncManager};
use super::protocol::Protocol;
use super::Page;

/// What pages look like.
const STYLE: &str = include_str!("../templates/site.css");

/// Search, theme, language and copying.
const SCRIPT: &str = include_str!("../templates/site.js");

#[derive(Template)]
#[template(path = "overview.html")]
struct OverviewPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    own: &'p Overview,
    contents: &'p Contents,
}

#[derive(Template)]
#[template(path = "area.html")]
struct AreaPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    own: &'p Area,
    grids: &'p Grids,
}

#[derive(Template)]
#[template(path = "process.html")]
struct ProcessPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    frames: &'p [Frame],
    sync_managers: &'p [SyncManager],
}

#[derive(Template)]
#[template(path = "protocol.html")]
struct ProtocolPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    own: &'p Protocol,
    grids: &'p Grids,
}

#[derive(Template)]
#[template(path = "codes.html")]
struct CodesPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    tables: &'p [Codes],
}

#[derive(Template)]
#[template(path = "machines.html")]
struct MachinesPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    machines: &'p [Machine],
    sequences: &'p [Sequence],
}

#[derive(Template)]
#[template(path = "modules.html")]
struct ModulesPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    modules: &'p [ModuleModel],
    grids: &'p Grids,
}

#[derive(Template)]
#[template(path = "assumptions.html")]
struct AssumptionsPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    ranked: &'p [Ranked<'p>],
}

#[derive(Template)]
#[template(path = "findings.html")]
struct FindingsPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    findings: &'p [Finding],
}

#[derive(Template)]
#[template(path = "list.html")]
struct ListPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    devices: &'p [Listed],
    root: &'p str,
    index: &'p str,
}

/// Templates don't fail on what they are given.
fn written(template: &impl Template) -> String {
    template.render().unwrap_or_default()
}

/// Pages of HTML.
pub(super) struct Html;

impl Pages for Html {
    fn ending(&self) -> &'static str {
        ".html"
    }

    fn front(&self) -> &'static str {
        "index"
    }

    fn overview(&self, Around { set: around, file }: Around<'_>, own: &Overview, contents: &Contents) -> String {
        written(&OverviewPage { around, file, own, contents })
    }

    fn area(&self, Around { set: around, file }: Around<'_>, own: &Area) -> String {
        let rows = own.sections.iter().flat_map(|section| &section.rows);
        let grids = &bits::grids(rows.filter_map(|row| row.bits.as_ref()));
        written(&AreaPage { around, file, own, grids })
    }

    fn process(
        &self,
        Around { set: around, file }: Around<'_>,
        frames: &[Frame],
        sync_managers: &[SyncManager],
    ) -> String {
        written(&ProcessPage { around, file, frames, sync_managers })
    }

    fn protocol(&self, Around { set: around, file }: Around<'_>, own: &Protocol) -> String {
        let parts = own.messages.iter().flat_map(|own| own.request.iter().chain(&own.reply));
        let grids = &bits::grids(parts.filter_map(|part| part.bits.as_ref()));
        written(&ProtocolPage { around, file, own, grids })
    }

    fn codes(&self, Around { set: around, file }: Around<'_>, tables: &[Codes]) -> String {
        written(&CodesPage { around, file, tables })
    }

    fn machines(
        &self,
        Around { set: around, file }: Around<'_>,
        machines: &[Machine],
        sequences: &[Sequence],
    ) -> String {
        written(&MachinesPage { around, file, machines, sequences })
    }

    fn modules(&self, Around { set: around, file }: Around<'_>, modules: &[ModuleModel]) -> String {
        let rows = modules.iter().flat_map(|own| &own.sections).flat_map(|(_, section)| &section.rows);
        let grids = &bits::grids(rows.filter_map(|row| row.bits.as_ref()));
        written(&ModulesPage { around, file, modules, grids })
    }

    fn assumptions(&self, Around { set: around, file }: Around<'_>, ranked: &[Ranked<'_>]) -> String {
        written(&AssumptionsPage { around, file, ranked })
    }

    fn findings(&self, Around { set: around, file }: Around<'_>, findings: &[Finding]) -> String {
        written(&FindingsPage { around, file, findings })
    }

    fn list(&self, Around { set: around, file }: Around<'_>, list: List<'_>) -> String {
        written(&ListPage { around, file, devices: list.devices, root: list.root, index: list.index })
    }

    fn of_catalog(&self, search: &dyn Fn() -> String) -> Vec<Page> {
        vec![Page::new("search.js", search())]
    }

    fn of_site(&self, _: &[Catalogue], search: Option<&dyn Fn() -> String>) -> Vec<Page> {
        let mut pages = vec![Page::new("site.css", STYLE.to_owned()), Page::new("site.js", SCRIPT.to_owned())];
        pages.extend(search.map(|search| Page::new("search.js", search())));
        pages
    }
}
