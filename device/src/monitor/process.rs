//! Names and values of PDOs.

use lexibus::clients::canopen::CanFrame;
use lexibus_codegen::facts::pdo::{buses, title};
use lexibus_codegen::ir::{Direction, Pdo, PdoEntryKind, Type, Value};

use super::event::{Event, EventKind, Named};
use crate::description::Description;
use crate::parameter::Parameter;

/// Bits of a COB-ID that are not part of the identifier: bit 31 (disabled) and bit 30 (no RTR).
const FLAGS: u32 = 0xC000_0000;

/// The PDOs of all nodes that have a description, except PDOs without a valid COB-ID.
#[derive(Debug)]
pub(super) struct Pdos<'d> {
    /// COB-ID, node-ID, name and fields of each PDO.
    list: Vec<Known<'d>>,
}

#[derive(Debug)]
struct Known<'d> {
    id: u32,
    node: u8,
    title: String,
    fields: Vec<Field<'d>>,
}

/// A field of a PDO.
#[derive(Debug)]
struct Field<'d> {
    parameter: Parameter<'d>,
    offset: u32,
    bits: u32,
}

impl<'d> Pdos<'d> {
    pub(super) fn new(nodes: &[(u8, &'d Description)]) -> Self {
        let known = nodes.iter().flat_map(|(node, description)| {
            description.device().process_data.pdos.iter().filter_map(|pdo| Known::new(*node, description, pdo))
        });
        let mut list: Vec<Known<'d>> = known.collect();
        // If a TPDO and RPDOs have the same COB-ID, the event names the TPDO and its node, because this node sent the frame.
        list.sort_by_key(|known| known.title.starts_with("RPDO"));
        Self { list }
    }

    /// Returns the event of a PDO, or `None` if no PDO has the COB-ID of the frame.
    pub(super) fn event(&self, frame: &CanFrame) -> Option<Event> {
        let known = self.list.iter().find(|known| known.id == frame.id())?;
        let values = known.fields.iter().filter_map(|field| field.named(frame.data())).collect();
        Some(Event { values, ..Event::new(Some(known.node), EventKind::Pdo, known.title.clone()) })
    }
}

impl<'d> Known<'d> {
    /// Returns a PDO with its configured COB-ID, or with its default COB-ID if none is configured. Returns `None` if the PDO
    /// has no valid COB-ID, or if its CAN-ID is 0.
    fn new(node: u8, description: &'d Description, pdo: &Pdo) -> Option<Self> {
        let communication = pdo.communication.as_ref()?;
        let item = description.object(communication.index, 1).map(|parameter| parameter.item());
        let value = item.and_then(|item| item.configured_value()).or(communication.cob_id.as_ref())?;
        let number = u32::try_from(value.resolved(node).as_int()?).ok()?;
        let id = number & !FLAGS;
        let fields = pdo.entries.iter().filter(|entry| entry.kind == PdoEntryKind::Item).filter_map(|entry| {
            let parameter = description.object(entry.index, entry.sub_index)?;
            Some(Field { parameter, offset: entry.bit_offset, bits: entry.bits })
        });
        let direction = if pdo.direction == Direction::Transmit { "" } else { " (to the node)" };
        let title = title(pdo, buses(description.device())) + direction;
        (id != 0).then(|| Self { id, node, title, fields: fields.collect() })
    }
}

impl Field<'_> {
    /// Returns the value of the field with its name, or `None` if the frame is too short.
    fn named(&self, data: &[u8]) -> Option<Named> {
        let bytes = self.bytes(data)?;
        let value = match self.parameter.basic() {
            Type::Boolean => Some(Value::Bool(bytes.first().is_some_and(|byte| byte & 1 != 0))),
            _ => self.parameter.decode(&bytes),
        };
        let value = match value {
            Some(Value::Bytes(_)) | None => lexibus_codegen::number::bytes(&bytes),
            Some(value) => self.parameter.text(&value),
        };
        Some(Named { address: self.parameter.address_text(), name: self.parameter.name(), value })
    }

    /// Returns the bits of the field, or `None` if the frame is too short. The first bit of the field becomes bit 0 of
    /// the first returned byte.
    fn bytes(&self, data: &[u8]) -> Option<Vec<u8>> {
        let (first, end) = (self.offset as usize, (self.offset + self.bits) as usize);
        if end > 8 * data.len() {
            return None;
        }
        let mut bytes = vec![0; (self.bits as usize).div_ceil(8)];
        for bit in 0..end - first {
            let from = first + bit;
            bytes[bit / 8] |= (data[from / 8] >> (from % 8) & 1) << (bit % 8);
        }
        Some(bytes)
    }
}
