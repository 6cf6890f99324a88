//! The items of a simulated device and their values.

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

/// Index of the error list, the pre-defined error field (CiA 301 7.5.2.4).
pub(super) const ERRORS: u16 = 0x1003;

/// An item and its value.
#[derive(Clone, Debug)]
pub(super) struct Slot {
    pub entry: Entry,
    /// Current value, the least significant byte first.
    pub value: Vec<u8>,
    /// Initial value that the test has set, instead of the initial value in the device description.
    pub initial: Option<Vec<u8>>,
    /// Stored value, which is restored at power-on.
    pub stored: Option<Vec<u8>>,
}

/// All items, accessible by position, object or register.
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

    /// Adds the objects of further axes at the addresses of these axes. The added items have no registers.
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

    /// Resets the items that `which` selects. An item gets the first of these values that exists: its stored value, the
    /// initial value that the test has set, or the initial value in the description.
    pub fn power_on(&mut self, node: NodeId, which: impl Fn(&Entry) -> bool) {
        for at in 0..self.list.len() {
            let Slot { entry, initial, stored, .. } = self.get(at);
            if !which(entry) {
                continue;
            }
            let known = stored.as_ref().or(initial.as_ref()).cloned();
            let value = known.or_else(|| self.count(entry)).unwrap_or_else(|| values::initial(entry, node));
            self.get_mut(at).value = value;
        }
    }

    /// Returns the initial value of a sub-index 0 that contains the number of entries, if the device description
    /// declares no value. In a mapping or assignment object, the initial value is the number of leading entries whose
    /// value in the description isn't 0. In all other objects, the initial value is the highest sub-index.
    ///
    /// The error list (CiA 301 7.5.2.4) is empty after power-on. For this list, a value in the description is the
    /// capacity (`CompactSubObj` of CiA 306), not the number of errors.
    fn count(&self, entry: &Entry) -> Option<Vec<u8>> {
        let is_count = |object: &Object| object.sub_index == 0 && entry.data_type == DataType::Unsigned8;
        let is_meant = |object: &Object| object.index == ERRORS || entry.initial == RawInitial::Unknown;
        let object = entry.object.filter(|object| is_count(object) && is_meant(object))?;
        let subs = self.objects.range(Object::new(object.index, 1)..=Object::new(object.index, u8::MAX));
        let is_mapping = matches!(object.index, 0x1600..=0x17FF | 0x1A00..=0x1BFF | 0x1C12..=0x1C2F);
        let is_given = |at: usize| matches!(self.get(at).entry.initial, RawInitial::Bytes(bytes) if bytes != [0; 4]);
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

    #[expect(clippy::indexing_slicing, reason = "positions are those of the list, from which no slot is removed")]
    pub fn get(&self, at: usize) -> &Slot {
        &self.list[at]
    }

    #[expect(clippy::indexing_slicing, reason = "positions are those of the list, from which no slot is removed")]
    pub fn get_mut(&mut self, at: usize) -> &mut Slot {
        &mut self.list[at]
    }

    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Slot> {
        self.list.iter_mut()
    }

    /// Returns the position of the item with this object.
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

    /// Returns the position of the item with this register.
    pub fn of_register(&self, register: Register) -> Option<usize> {
        self.registers.get(&register).copied()
    }

    /// Returns the objects of an index range, in ascending order.
    pub fn objects(&self, first: u16, last: u16) -> impl Iterator<Item = Object> + '_ {
        self.objects.range(Object::new(first, 0)..=Object::new(last, u8::MAX)).map(|(object, _)| *object)
    }

    /// Returns the value of an object as a number, or `None` if the object doesn't exist or isn't a number.
    pub fn number(&self, index: u16, sub_index: u8) -> Option<u64> {
        let slot = self.get(self.of_object(Object::new(index, sub_index)).ok()?);
        values::byte_length(slot.entry.data_type)?;
        Some(crate::pdo::from_bytes(&slot.value))
    }
}
