//! Links between codes and other elements: items that have a code as a named value, and items, messages and states that
//! a code table mentions.

use std::collections::{HashMap, HashSet};

use super::codes::Codes;
use super::link::{Link, Relation};
use super::references::Targets;
use lexibus_codegen::facts::mentions::{Mention, Mentions};
use lexibus_codegen::facts::referrers::Part;
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{CodeRow, Device, ItemId};

/// First number, last number and name of a code or named value.
type CodeKey<'d> = (i128, Option<i128>, &'d str);

/// For each number and name of a code, the items that have this number and name as a named value, and the position of
/// the value.
struct Values<'d>(HashMap<CodeKey<'d>, Vec<(ItemId, Part)>>);

impl<'d> Values<'d> {
    fn new(device: &'d Device) -> Self {
        let types = Owner::of_types(&device.types);
        let items = (0..).zip(&device.groups).flat_map(|(position, group)| group.items_at(position));
        let mut values: HashMap<_, Vec<_>> = HashMap::new();
        for (id, item) in items {
            for (at, value) in types.enumeration(item.ty).map_or(&[][..], |(values, _)| values).iter().enumerate() {
                let key = (value.value, value.last, value.name.as_str());
                values.entry(key).or_default().push((id, Part::Value(at)));
            }
        }
        Values(values)
    }

    fn of(&self, row: &'d CodeRow) -> &[(ItemId, Part)] {
        self.0.get(&(row.code, row.last, row.name.as_str())).map_or(&[], Vec::as_slice)
    }
}

/// Links from items to codes.
#[derive(Default)]
pub(super) struct CodesOfItems {
    links: HashMap<ItemId, Vec<Link>>,
    /// Pairs of an item and the position of a table to which the item has a link.
    tables: HashSet<(ItemId, usize)>,
}

impl CodesOfItems {
    /// Returns the links of an item to the code tables that mention the item or contain codes that the item reports.
    /// Also returns the links to the codes whose descriptions mention the item.
    pub fn of(&self, id: ItemId) -> Option<Relation> {
        Relation::new("Codes", self.links.get(&id).into_iter().flatten())
    }

    /// Adds the link to a table. If a table has several pages, adds only the link to the first page that mentions the
    /// item.
    fn add_table(&mut self, items: impl IntoIterator<Item = ItemId>, table: usize, link: &Link) {
        for id in items {
            if self.tables.insert((id, table)) {
                self.add(id, link);
            }
        }
    }

    fn add(&mut self, id: ItemId, link: &Link) {
        let links = self.links.entry(id).or_default();
        if links.last() != Some(link) {
            links.push(link.clone());
        }
    }
}

/// Returns the items that a text mentions.
fn items(mentions: &[Mention]) -> impl Iterator<Item = ItemId> + '_ {
    mentions.iter().filter_map(|mention| match mention {
        Mention::Item(id) | Mention::Bit(id, _) | Mention::Object(_, id) => Some(*id),
        _ => None,
    })
}

/// Returns the link to a named value. The title of the link is that of the item, because the code and the value have
/// the same name.
fn to_value(targets: &Targets<'_>, id: ItemId, part: Part) -> Option<Link> {
    let (item, value) = (targets.item(Some(id))?, targets.part(id, part)?);
    Some(Link { title: item.title.clone(), target: value.target.clone() })
}

/// Adds relations to the tables and codes on these pages. `pages` contains the file and the tables of each page.
/// Returns the links from items to codes.
pub(super) fn link(targets: &Targets<'_>, pages: &mut [(String, String, Vec<Codes>)]) -> CodesOfItems {
    let (values, mentions) = (Values::new(targets.device), Mentions::new(targets.device));
    let relation = |title: &'static str, mentions: &[Mention]| {
        Relation::new(title, mentions.iter().filter_map(|mention| targets.mentioned(*mention)))
    };
    let mut of_items = CodesOfItems::default();
    for (file, shown) in pages.iter_mut().flat_map(|(file, _, tables)| tables.iter_mut().map(|table| (&*file, table))) {
        let Some(table) = targets.device.code_tables.get(shown.position) else { continue };
        let link = |anchor: &str, title: &str| Link { title: title.to_owned(), target: format!("{file}#{anchor}") };
        let (of_table, to_table) = (mentions.of_table(table), link(&shown.anchor, &shown.title));
        if !shown.is_continued {
            of_items.add_table(items(&of_table), shown.position, &to_table);
            shown.relations = relation("See", &of_table).into_iter().collect();
        }
        for code in &mut shown.rows {
            let Some(row) = table.rows.get(code.position) else { continue };
            let (values, of_row) = (values.of(row), mentions.of_row(table, row));
            of_items.add_table(values.iter().map(|(id, _)| *id), shown.position, &to_table);
            let to_row = link(&code.anchor, &format!("{} {}", code.number, code.name));
            items(&of_row).for_each(|id| of_items.add(id, &to_row));
            let to_values: Vec<Link> = values.iter().filter_map(|&(id, part)| to_value(targets, id, part)).collect();
            let value_of = Relation::new("Value of", &to_values);
            code.relations = [value_of, relation("See", &of_row)].into_iter().flatten().collect();
        }
    }
    of_items
}
