//! Items, objects, messages and states that the texts of code tables mention.

use super::referrers::Part;
use crate::collections::{HashMap, HashSet};
use crate::ir::owner::Owner;
use crate::ir::{BitFieldEntry, CodeRow, CodeTable, Device, Documentation, ItemId, Shape};

/// An element of a device that a text mentions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mention {
    /// An item.
    Item(ItemId),
    /// A bit or bit field of an item.
    Bit(ItemId, Part),
    /// The index of an object, and the first item of this object.
    Object(u16, ItemId),
    /// The position of a message.
    Message(usize),
    /// The positions of a state machine and of its state.
    State(usize, usize),
}

/// The names that texts can mention.
#[derive(Debug)]
pub struct Mentions<'d> {
    device: &'d Device,
    /// Items and messages whose names are not ordinary words.
    identifiers: HashMap<&'d str, Vec<Mention>>,
    /// Items and messages whose names have a capital only as the first letter, like the first word of a sentence.
    capitalized: HashMap<&'d str, Vec<Mention>>,
    objects: HashMap<u16, Mention>,
    /// States, which texts mention in quotes.
    states: HashMap<&'d str, Vec<Mention>>,
    /// Items whose descriptions contain the name of a code table in quotes.
    of_tables: HashMap<&'d str, Vec<Mention>>,
}

impl<'d> Mentions<'d> {
    /// Collects the names of a device.
    pub fn new(device: &'d Device) -> Self {
        let (identifiers, capitalized, objects, states, of_tables) = Default::default();
        let mut mentions = Mentions { device, identifiers, capitalized, objects, states, of_tables };
        let tables: HashSet<&str> = device.code_tables.iter().map(|table| table.name.as_str()).collect();
        for (position, group) in (0..).zip(&device.groups) {
            for (id, item) in group.items_at(position) {
                mentions.add(item.name.as_str(), Mention::Item(id));
                let text = Documentation::text_of(item.documentation.as_deref());
                for table in quoted(text).filter(|name| tables.contains(name)) {
                    mentions.of_tables.entry(table).or_default().push(Mention::Item(id));
                }
                if let Some((index, _)) = item.object() {
                    mentions.objects.entry(index).or_insert(Mention::Object(index, id));
                }
            }
        }
        for (at, message) in device.messages.iter().enumerate() {
            mentions.add(message.name.as_str(), Mention::Message(at));
        }
        for (machine, states) in device.machines.iter().map(|machine| &machine.states).enumerate() {
            for (at, state) in states.iter().enumerate() {
                mentions.states.entry(state.name.as_str()).or_default().push(Mention::State(machine, at));
            }
        }
        mentions
    }

    fn add(&mut self, name: &'d str, mention: Mention) {
        let is_word = words(name).eq([name]);
        if is_word && is_identifier(name) {
            self.identifiers.entry(name).or_default().push(mention);
        } else if is_word && is_capitalized(name) {
            self.capitalized.entry(name).or_default().push(mention);
        }
    }

    /// Returns the elements that the description of a code table mentions, and the items whose descriptions name the
    /// table in quotes.
    pub fn of_table(&self, table: &CodeTable) -> Vec<Mention> {
        let mut all = self.of_documentation(table.documentation.as_deref());
        let known: HashSet<Mention> = all.iter().copied().collect();
        let items = self.of_tables.get(table.name.as_str()).into_iter().flatten();
        all.extend(items.filter(|mention| !known.contains(mention)));
        all
    }

    /// Returns the elements that a row of a code table mentions: in its description, in its cells, and in a column that
    /// lists objects.
    pub fn of_row(&self, table: &CodeTable, row: &CodeRow) -> Vec<Mention> {
        let mut all = self.of_documentation(row.documentation.as_deref());
        for (at, column) in table.columns.iter().enumerate() {
            let cell = super::code::cell(row, at);
            all.extend(self.of_text(&cell));
            if matches!(column.as_str(), "object" | "objects") {
                all.extend(words(&cell).filter_map(|word| self.object(word)));
            }
        }
        all
    }

    fn of_documentation(&self, documentation: Option<&Documentation>) -> Vec<Mention> {
        documentation.map_or_else(Vec::new, |documentation| self.of_text(&documentation.text))
    }

    /// Returns the elements that a text mentions.
    fn of_text(&self, text: &str) -> Vec<Mention> {
        /// Words that precede the index of an object or a capitalized name. Without such a word, a hexadecimal number can be a
        /// code, and a capitalized word can start a sentence.
        const BEFORE: [&str; 4] = ["in", "of", "object", "objects"];
        let mut all: Vec<Mention> =
            words(text).filter_map(|word| self.identifiers.get(word)).flatten().copied().collect();
        let pairs = words(text).zip(words(text).skip(1)).filter(|(before, _)| BEFORE.contains(before));
        for (_, word) in pairs {
            all.extend(self.object(word));
            all.extend(self.capitalized.get(word).into_iter().flatten());
        }
        all.extend(quoted(text).filter_map(|name| self.states.get(name)).flatten());
        let bits: Vec<Mention> = self.bits_of(text).collect();
        let has_bit = |id| bits.iter().any(|bit| matches!(bit, Mention::Bit(other, _) if *other == id));
        all.retain(|mention| !matches!(mention, Mention::Item(id) if has_bit(*id)));
        all.extend(bits);
        all
    }

    /// Returns the bits that a text mentions, such as `bit 3 of status_word`.
    fn bits_of<'t>(&'t self, text: &'t str) -> impl Iterator<Item = Mention> + 't {
        let all: Vec<&str> = words(text).collect();
        let items = |name| [&self.identifiers, &self.capitalized].into_iter().filter_map(move |names| names.get(name));
        let found = (3..all.len()).filter_map(move |last| {
            let is_bit = all[last - 3].eq_ignore_ascii_case("bit") && all[last - 1] == "of";
            let number: u32 = all[last - 2].parse().ok().filter(|_| is_bit)?;
            Some(items(all[last]).flatten().filter_map(move |mention| self.bit(*mention, number)))
        });
        found.flatten()
    }

    /// Returns the field that contains bit `number` of an item. Ignores fields that depend on a condition, because the number does
    /// not determine which of them applies.
    fn bit(&self, mention: Mention, number: u32) -> Option<Mention> {
        let Mention::Item(id) = mention else { return None };
        let owner = Owner { types: &self.device.types, groups: &[self.device.groups.as_slice()] };
        let Shape::BitField { fields, .. } = &owner.definition(owner.item(id)?.ty)?.shape else { return None };
        let has_bit = |field: &BitFieldEntry| {
            let first = u32::from(field.offset);
            (first..first + u32::from(field.bits)).contains(&number) && field.when.is_none()
        };
        Some(Mention::Bit(id, Part::Bit(fields.iter().position(has_bit)?)))
    }

    fn object(&self, word: &str) -> Option<Mention> {
        let digits = word.strip_prefix("0x").filter(|digits| digits.len() == 4)?;
        self.objects.get(&u16::from_str_radix(digits, 16).ok()?).copied()
    }
}

/// Returns the parts of a text that are in quotes.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('"').skip(1).step_by(2)
}

/// Returns the words of a text. A word can contain `_` and `.`, but neither begin nor end with `.`.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let is_separator = |letter: char| !(letter.is_alphanumeric() || matches!(letter, '_' | '.'));
    text.split(is_separator)
        .flat_map(|word| word.split(".."))
        .map(|word| word.trim_matches('.'))
        .filter(|word| !word.is_empty())
}

/// Returns whether a word is not an ordinary word: `digital_inputs`, `DRV.OPMODE`, `CmdGetAlarm`, `MAXTORQUE`, `c8`.
/// Abbreviations such as `CAN` and `PDOs` are ordinary words.
fn is_identifier(word: &str) -> bool {
    /// Names of networks and organizations that are spelled like identifiers.
    const PROPER_NAMES: [&str; 7] = ["CiA", "DeviceNet", "EtherCAT", "EtherNet", "POWERLINK", "PROFIBUS", "PROFINET"];
    /// Minimum number of letters of a word in capitals that counts as an identifier. Shorter words in capitals are abbreviations.
    const LONG: usize = 8;
    let has_digit = word.chars().any(|letter| letter.is_ascii_digit()) && word.chars().any(char::is_alphabetic);
    let mut pairs = word.chars().zip(word.chars().skip(1));
    let is_compound = pairs.any(|(before, after)| before.is_lowercase() && after.is_uppercase());
    let is_long = word.chars().count() >= LONG && word.chars().all(char::is_uppercase);
    let is_proper = PROPER_NAMES.iter().any(|name| name.eq_ignore_ascii_case(word));
    word.contains(['_', '.']) || has_digit || ((is_compound || is_long) && !is_proper)
}

/// Returns whether only the first letter of a word is a capital.
fn is_capitalized(word: &str) -> bool {
    word.starts_with(char::is_uppercase) && !word.chars().skip(1).any(char::is_uppercase)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::ir::{
        Binding, BitMeaning, Condition, Group, Item, Message, ObjectCode, Pattern, StateMachine, Type, TypeDef, TypeId,
    };
    use compact_str::CompactString;

    #[test]
    fn items_that_name_a_table() {
        let mut group = Group::object(0x2000, ObjectCode::Var);
        group.items.push(Item::new(Binding::canopen(0x2000, 0)));
        let text = "Number of the alarm. The code table \"alarms\" lists the numbers".into();
        group.items[0].documentation = Some(Arc::new(Documentation { text, ..Documentation::default() }));
        let mut device = Device { groups: vec![group], ..Device::default() };
        let table = |name: &str| CodeTable { name: name.into(), ..CodeTable::default() };
        device.code_tables.extend([table("alarms"), table("numbers")]);
        let mentions = Mentions::new(&device);
        assert_eq!(mentions.of_table(&table("alarms")), [Mention::Item(ItemId { group: 0, item: 0 })]);
        assert_eq!(mentions.of_table(&table("numbers")), []);
    }

    #[test]
    fn bits_of_items() {
        let flag = |offset, name: &str| {
            BitFieldEntry::new(CompactString::from(name), offset, 1, BitMeaning::Flag { inverted: false })
        };
        let condition = Condition { item: "mode".into(), values: Vec::new(), names: Vec::new(), mask: None };
        let conditional = BitFieldEntry { when: Some(Box::new(condition)), ..flag(4, "start") };
        let fields = vec![flag(3, "alarm"), conditional];
        let shape = Shape::BitField { base: Type::Unsigned(16), fields };
        let mut group = Group::object(0x2000, ObjectCode::Var);
        group.items.push(Item {
            name: "Statusword".into(),
            ty: Type::Named(TypeId(0)),
            ..Item::new(Binding::canopen(0x2000, 0))
        });
        let types = vec![TypeDef::new("Status", shape, None)];
        let device = Device { groups: vec![group], types, ..Device::default() };
        let mentions = Mentions::new(&device);
        let id = ItemId { group: 0, item: 0 };
        let bit = Mention::Bit(id, Part::Bit(0));
        assert_eq!(mentions.of_text("Bit 3 of Statusword reports an alarm"), [bit]);
        assert_eq!(mentions.of_text("Bit 4 of Statusword, bits 3 to 5"), [Mention::Item(id)]);
        assert_eq!(mentions.of_text("bits 3 to 4 of Statusword"), [Mention::Item(id)]);
        assert_eq!(mentions.of_text("bit 3 in Statusword, bit 3 of"), [Mention::Item(id)]);
    }

    #[test]
    fn names_indices_and_states() {
        let item = |index, name: &str| {
            let mut group = Group::object(index, ObjectCode::Var);
            group.items.push(Item { name: name.into(), ..Item::new(Binding::canopen(index, 0)) });
            group
        };
        let names = [
            "digital_inputs",
            "Rhsts",
            "current",
            "c8",
            "CAN",
            "PDOs",
            "CANopen",
            "EtherCAT",
            "PROFINET",
            "OpMode",
            "MAXTORQUE",
        ];
        let groups = names.iter().zip(0x2000..).map(|(name, index)| item(index, name));
        let mut device = Device { groups: groups.collect(), ..Device::default() };
        device.messages.push(Message { name: "CmdGetAlarm".into(), ..Message::default() });
        let states = vec![Pattern { name: "alarm".into(), ..Pattern::default() }].into();
        device.machines.push(StateMachine {
            name: "motor".into(),
            status_item: "digital_inputs".into(),
            control_item: "digital_inputs".into(),
            states,
            ..StateMachine::default()
        });
        let mentions = Mentions::new(&device);
        let item = |group| Mention::Item(ItemId { group, item: 0 });
        let object = Mention::Object(0x2001, ItemId { group: 1, item: 0 });
        let of = |text| mentions.of_text(text);
        assert_eq!(of("Bits 0 to 7 of Rhsts show the cause"), [item(1)]);
        assert_eq!(of("Rhsts, current and 0x2001"), []);
        assert_eq!(of("A bit in digital_inputs for each value of c8."), [item(0), item(3)]);
        assert_eq!(of("error codes in 0x2001, object 0x3000"), [object]);
        // These words are not mentions, although items have these names.
        assert_eq!(of("CAN error: fault of CAN, too many PDOs in CANopen, EtherCAT or PROFINET"), []);
        assert_eq!(of("Not possible in this OpMode: increase MAXTORQUE"), [item(9), item(10)]);
        assert_eq!(of("CmdGetAlarm leaves \"alarm\", not alarm"), [Mention::Message(0), Mention::State(0, 0)]);
    }
}
