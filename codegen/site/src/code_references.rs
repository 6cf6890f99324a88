//! Links between codes and the elements that report them: items that have a code as a named value, and items, messages and states that a
//! code table mentions.

use std::collections::HashMap;

use super::codes::Codes;
use super::link::{Link, Relation};
use super::references::Targets;
use lexibus_codegen::facts::mentions::{Mention, Mentions};
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{CodeRow, Device, ItemId};

/// The items that have a value with the same number and name as a code.
struct Values<'d>(HashMap<(i128, Option<i128>, &'d str), Vec<ItemId>>);

impl<'d> Values<'d> {
    fn new(device: &'d Device) -> Self {
        let types = Owner::of_types(&device.types);
        let items = (0..).zip(&device.groups).flat_map(|(position, group)| group.items_at(position));
        let mut values: HashMap<_, Vec<ItemId>> = HashMap::new();
        for (id, item) in items {
            for value in types.enumeration(item.ty).map_or(&[][..], |(values, _)| values) {
                values.entry((value.value, value.last, value.name.as_str())).or_default().push(id);
            }
        }
        Values(values)
    }

    fn of(&self, row: &'d CodeRow) -> &[ItemId] {
        self.0.get(&(row.code, row.last, row.name.as_str())).map_or(&[], Vec::as_slice)
    }
}

/// Links from items to codes.
#[derive(Default)]
pub(super) struct CodesOfItems(HashMap<ItemId, Vec<Link>>);

impl CodesOfItems {
    /// Returns the relation of an item to the codes that it reports, or whose description mentions it.
    pub fn of(&self, id: ItemId) -> Option<Relation> {
        Relation::new("Codes", self.0.get(&id).cloned().unwrap_or_default())
    }

    fn add(&mut self, mentions: &[Mention], link: &Link) {
        for mention in mentions {
            if let Mention::Item(id) | Mention::Object(_, id) = mention {
                self.0.entry(*id).or_default().push(link.clone());
            }
        }
    }
}

/// Adds the relations of the codes on these pages, each with the file of the page. Returns the links in the other direction.
pub(super) fn link<'p>(
    targets: &Targets<'_>,
    pages: impl IntoIterator<Item = (&'p str, &'p mut Vec<Codes>)>,
) -> CodesOfItems {
    let (values, mentions) = (Values::new(targets.device), Mentions::new(targets.device));
    let relation = |title: &'static str, mentions: &[Mention]| {
        Relation::new(title, mentions.iter().filter_map(|mention| targets.mentioned(*mention)).cloned().collect())
    };
    let mut of_items = CodesOfItems::default();
    for (file, shown) in pages.into_iter().flat_map(|(file, tables)| tables.iter_mut().map(move |table| (file, table)))
    {
        let Some(table) = targets.device.code_tables.get(shown.position) else { continue };
        let link = |anchor: &str, title: &str| Link { title: title.to_owned(), target: format!("{file}#{anchor}") };
        let (of_table, to_table) = (mentions.of_table(table), link(&shown.anchor, &shown.title));
        if !shown.is_continued {
            of_items.add(&of_table, &to_table);
            shown.relations = relation("See", &of_table).into_iter().collect();
        }
        for shown in &mut shown.rows {
            let Some(row) = table.rows.get(shown.position) else { continue };
            let values: Vec<Mention> = values.of(row).iter().copied().map(Mention::Item).collect();
            let of_row = mentions.of_row(table, row);
            of_items.add(&values, &to_table);
            of_items.add(&of_row, &link(&shown.anchor, &format!("{} {}", shown.number, shown.name)));
            shown.relations = [relation("Value of", &values), relation("See", &of_row)].into_iter().flatten().collect();
        }
    }
    of_items
}
