//! The items of a simulated device with their values.

use std::collections::BTreeMap;
use std::vec::Vec;

use super::values;
use crate::abort::AbortCode;
use crate::axes::Axes;
use crate::bus::Object;
use crate::data_type::DataType;
use crate::node_id::NodeId;
use crate::register::Register;
use crate::table::{Entry, RawInitial};

/// The list of errors, the pre-defined error field (CiA 301 7.5.2.4).
pub(super) const ERRORS: u16 = 0x1003;

/// An item and its value.
#[derive(Clone, Debug)]
pub(super) struct Slot {
    pub entry: Entry,
    /// The least significant byte first.
    pub value: Vec<u8>,
    /// What the test gives it after power-on, in place of what the description says.
    pub initial: Option<Vec<u8>>,
    /// What was stored, which is there again after power-on.
    pub stored: Option<Vec<u8>>,
}

/// All items, found by their places.
#[derive(Clone, Debug, Default)]
pub(super) struct Slots {
    list: Vec<Slot>,
    objects: BTreeMap<Object, usize>,
    registers: BTreeMap<Register, usize>,
}

impl Slots {
    pub fn new(entries: &[Entry]) -> Self {
        let mut slots = Self::default();
        entries.iter().for_each(|entry| slots.add(*entry));
        slots
    }

    fn add(&mut self, entry: Entry) {
        let at = self.list.len();
        if let Some(object) = entry.object {
            self.objects.entry(object).or_insert(at);
        }
        if let Some(register) = entry.register {
            self.registers.entry(register).or_insert(at);
        }
        self.list.push(Slot { entry, value: Vec::new(), initial: None, stored: None });
    }

    /// Adds the objects of further axes: those of the first at other places. They are no registers.
    pub fn add_axes(&mut self, axes: &Axes) {
        let first: Vec<Entry> = self.list.iter().map(|slot| slot.entry).collect();
        for axis in 2..=axes.count {
            for entry in &first {
                let Some(object) = entry.object.and_then(|object| axes.object(axis, object)) else { continue };
                if !self.objects.contains_key(&object) {
                    self.add(Entry { object: Some(object), register: None, ..*entry });
                }
            }
        }
    }

    /// Gives the items that `which` names the values of power-on: those that were stored, or those of the test, or
    /// those of the description.
    pub fn power_on(&mut self, node: NodeId, which: impl Fn(&Entry) -> bool) {
        for at in 0..self.list.len() {
            let Slot { entry, initial, stored, .. } = &self.list[at];
            if !which(entry) {
                continue;
            }
            let known = stored.as_ref().or(initial.as_ref()).cloned();
            let value = known.or_else(|| self.count(entry)).unwrap_or_else(|| values::initial(entry, node));
            self.list[at].value = value;
        }
    }

    /// What sub-index 0 holds of an object with further ones whose description doesn't give it: how many of a mapping
    /// are given by the description, and else the highest sub-index. The list of errors (CiA 301 7.5.2.4) is empty, whatever
    /// the description gives: that is for how many it has room (`CompactSubObj` of CiA 306).
    fn count(&self, entry: &Entry) -> Option<Vec<u8>> {
        let is_count = |object: &Object| object.sub_index == 0 && entry.data_type == DataType::Unsigned8;
        let is_meant = |object: &Object| object.index == ERRORS || entry.initial == RawInitial::Unknown;
        let object = entry.object.filter(|object| is_count(object) && is_meant(object))?;
        let subs = self.objects.range(Object::new(object.index, 1)..=Object::new(object.index, u8::MAX));
        let is_mapping = matches!(object.index, 0x1600..=0x17FF | 0x1A00..=0x1BFF | 0x1C12..=0x1C2F);
        let is_given = |at: usize| matches!(self.list[at].entry.initial, RawInitial::Bytes(bytes) if bytes != [0; 4]);
        let last = match object.index {
            ERRORS => Some(0),
            _ if is_mapping => subs.take_while(|(_, at)| is_given(**at)).last().map(|(object, _)| object.sub_index),
            _ => subs.last().map(|(object, _)| object.sub_index),
        };
        last.map(|count| [count].to_vec())
    }

    pub fn len(&self) -> usize {
        self.list.len()
    }

    pub fn get(&self, at: usize) -> &Slot {
        &self.list[at]
    }

    pub fn get_mut(&mut self, at: usize) -> &mut Slot {
        &mut self.list[at]
    }

    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Slot> {
        self.list.iter_mut()
    }

    /// The item that is this object.
    pub fn of_object(&self, object: Object) -> Result<usize, AbortCode> {
        if let Some(at) = self.objects.get(&object) {
            return Ok(*at);
        }
        let of_index = Object::new(object.index, 0)..=Object::new(object.index, u8::MAX);
        match self.objects.range(of_index).next() {
            Some(_) => Err(AbortCode::NO_SUB_INDEX),
            None => Err(AbortCode::NO_OBJECT),
        }
    }

    /// The item that is this register.
    pub fn of_register(&self, register: Register) -> Option<usize> {
        self.registers.get(&register).copied()
    }

    /// The objects of a range of indices, in ascending order.
    pub fn objects(&self, first: u16, last: u16) -> impl Iterator<Item = Object> + '_ {
        self.objects.range(Object::new(first, 0)..=Object::new(last, u8::MAX)).map(|(object, _)| *object)
    }

    /// An object's number; `None` where there is no such object, or it is none.
    pub fn number(&self, index: u16, sub_index: u8) -> Option<u64> {
        let slot = self.get(self.of_object(Object::new(index, sub_index)).ok()?);
        values::byte_length(slot.entry.data_type)?;
        Some(crate::pdo::from_bytes(&slot.value))
    }
}
