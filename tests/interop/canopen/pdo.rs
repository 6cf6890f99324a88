//! Tests generated PDO structs. The node must accept their configuration, and both sides must decode the same values
//! from a frame.

use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort};
use lexibus::pdo::{PdoParameters, TransmissionType};
use lexibus::{AbortCode, Int, Pdo, SdoWrite, Uint};
use serde_json::{json, Value};

use super::all_types::pdo::*;
use super::refusals::assert_aborted;
use super::{node_id, start, Error, Node, NODE, PATIENCE};
use crate::python::Script;

const FILE: &str = "tests/interop/all-types.toml";

/// Returns the PDO parameters that the Python library reads from the objects of its node.
pub fn used(script: &mut Script, direction: &str, number: u32) -> Value {
    script.ask(json!({ "do": "pdo", "direction": direction, "number": number }))
}

/// Returns the PDO parameters that the Python library should read after the configuration of a PDO struct.
pub fn expected<P: Pdo>(cob_id: u32, transmission_type: u8) -> Value {
    let entry = |entry: &lexibus::MappedEntry| json!([entry.index, entry.sub_index, entry.bits]);
    let bits: u32 = P::MAPPING.iter().map(|entry| entry.bits).sum();
    let entries: Vec<Value> = P::MAPPING.iter().map(entry).collect();
    json!({ "cob_id": cob_id, "enabled": true, "type": transmission_type, "bits": bits, "entries": entries })
}

/// Sends the SDO writes of a configuration.
pub fn configure(node: &mut Node, steps: impl IntoIterator<Item = SdoWrite>) -> Result<(), Error> {
    Ok(steps.into_iter().try_for_each(|step| step.send(node))?)
}

/// Creates a CAN frame. `id` is its CAN-ID.
pub fn frame(id: u32, data: &[u8]) -> CanFrame {
    CanFrame::new(id, data).expect("a frame")
}

pub fn receive(node: &mut Node, id: u32) -> CanFrame {
    let received = node.port().receive(PATIENCE, &mut |frame| frame.id() == id).expect("a line");
    received.unwrap_or_else(|| panic!("no frame with the identifier {id:#x}"))
}

/// Configures an RPDO and sends it. Checks the values that the Python library decodes.
macro_rules! received {
    ($script:ident, $node:ident, $number:literal by $configuration:expr, at $id:expr, $pdo:ident $fields:tt, $values:tt) => {
        configure(&mut $node, $configuration)?;
        assert_eq!(used(&mut $script, "rx", $number), expected::<$pdo>($id, 255));
        $node.send(&frame($id, &$pdo $fields.pack()))?;
        let values = $script.ask(json!({ "do": "receive", "number": $number }));
        assert_eq!(values, json!($values), stringify!($pdo));
    };
}

/// Configures a TPDO and makes the Python library send it. Checks the values that the generated struct decodes.
macro_rules! transmitted {
    ($script:ident, $node:ident, $number:literal by $configuration:expr, at $id:expr, $pdo:ident $fields:tt, $values:tt) => {
        configure(&mut $node, $configuration)?;
        assert_eq!(used(&mut $script, "tx", $number), expected::<$pdo>($id, 255));
        $script.ask(json!({ "do": "load", "number": $number, "values": $values }));
        $script.ask(json!({ "do": "transmit", "number": $number }));
        let frame = receive(&mut $node, $id);
        assert_eq!($pdo::unpack(frame.data())?, $pdo $fields);
        assert_eq!(frame.data(), $pdo $fields.pack(), stringify!($pdo));
    };
}

fn int<const BITS: u32>(value: i64) -> Int<BITS> {
    Int::new(value).expect("in range")
}

fn uint<const BITS: u32>(value: u64) -> Uint<BITS> {
    Uint::new(value).expect("in range")
}

#[test]
fn received_pdos() -> Result<(), Error> {
    let Some((mut script, mut node)) = start("rpdos", FILE) else { return Ok(()) };
    let id = u32::from(NODE);
    received!(
        script, node, 1 by RxPdo1::configuration(node_id()), at 0x200 + id,
        RxPdo1 {
            bits_bit_1: true, bits_bit_2: false, bits_bit_3: true, bits_bit_4: true,
            bits_bit_5: false, bits_bit_6: false, bits_bit_7: false, bits_bit_8: true,
            integer24: int(-0x12_3456),
            unsigned32: 0x89AB_CDEF,
        },
        [true, false, true, true, false, false, false, true, -0x12_3456, 0x89AB_CDEF_u32]
    );
    received!(
        script, node, 2 by RxPdo2::configuration(node_id()), at 0x300 + id,
        RxPdo2 { integer40: int(-0x12_3456_789A), unsigned24: uint(0xFE_DCBA) },
        [-0x12_3456_789A_i64, 0xFE_DCBA]
    );
    received!(
        script, node, 3 by RxPdo3::configuration(node_id()), at 0x400 + id,
        RxPdo3 { real32: -1.5, integer16: -2, unsigned8: 0xA5, integer8: -128 },
        [-1.5, -2, 0xA5, -128]
    );
    received!(
        script, node, 4 by RxPdo4::configuration(node_id()), at 0x500 + id,
        RxPdo4 { real64: -0.1 },
        [-0.1]
    );
    // These PDOs have no default COB-ID.
    received!(
        script, node, 5 by RxPdo5::configuration_as(0x321), at 0x321,
        RxPdo5 { unsigned64: 0xFEDC_BA98_7654_3210 },
        [0xFEDC_BA98_7654_3210_u64]
    );
    received!(
        script, node, 6 by RxPdo6::configuration_as(0x322), at 0x322,
        RxPdo6 { integer56: int(-0x12_3456_789A_BCDE), unsigned8: 0x5A },
        [-0x12_3456_789A_BCDE_i64, 0x5A]
    );
    received!(
        script, node, 7 by RxPdo7::configuration_as(0x323), at 0x323,
        RxPdo7 { unsigned40: uint(0xFE_DCBA_9876), integer24: int(-2) },
        [0xFE_DCBA_9876_u64, -2]
    );
    received!(
        script, node, 8 by RxPdo8::configuration_as(0x324), at 0x324,
        RxPdo8 { unsigned48: uint(0xFEDC_BA98_7654), integer16: i16::MIN },
        [0xFEDC_BA98_7654_u64, -0x8000]
    );
    Ok(())
}

#[test]
fn transmitted_pdos() -> Result<(), Error> {
    let Some((mut script, mut node)) = start("tpdos", FILE) else { return Ok(()) };
    let id = u32::from(NODE);
    transmitted!(
        script, node, 1 by TxPdo1::configuration(node_id()), at 0x180 + id,
        TxPdo1 {
            bits_bit_1: false, bits_bit_2: true, bits_bit_3: true, bits_bit_4: false,
            bits_bit_5: true, bits_bit_6: false, bits_bit_7: true, bits_bit_8: false,
            unsigned24: uint(0xFE_DCBA),
            integer32: -0x1234_5678,
        },
        [false, true, true, false, true, false, true, false, 0xFE_DCBA, -0x1234_5678]
    );
    transmitted!(
        script, node, 2 by TxPdo2::configuration(node_id()), at 0x280 + id,
        TxPdo2 { integer48: int(-0x1234_5678_9ABC), unsigned16: 0xA55A },
        [-0x1234_5678_9ABC_i64, 0xA55A]
    );
    transmitted!(
        script, node, 3 by TxPdo3::configuration(node_id()), at 0x380 + id,
        TxPdo3 { unsigned56: uint(0xFE_DCBA_9876_5432), integer8: -3 },
        [0xFE_DCBA_9876_5432_u64, -3]
    );
    transmitted!(
        script, node, 4 by TxPdo4::configuration(node_id()), at 0x480 + id,
        TxPdo4 { integer64: -0x0123_4567_89AB_CDEF },
        [-0x0123_4567_89AB_CDEF_i64]
    );
    transmitted!(
        script, node, 5 by TxPdo5::configuration_as(0x331), at 0x331,
        TxPdo5 { real32: 0.25, unsigned32: 0x89AB_CDEF },
        [0.25, 0x89AB_CDEF_u32]
    );
    transmitted!(
        script, node, 6 by TxPdo6::configuration_as(0x332), at 0x332,
        TxPdo6 { unsigned40: uint(0xFE_DCBA_9876), unsigned24: uint(1) },
        [0xFE_DCBA_9876_u64, 1]
    );
    transmitted!(
        script, node, 7 by TxPdo7::configuration_as(0x333), at 0x333,
        TxPdo7 { integer40: int(-2), integer24: int(0x12_3456) },
        [-2, 0x12_3456]
    );
    transmitted!(
        script, node, 8 by TxPdo8::configuration_as(0x334), at 0x334,
        TxPdo8 { unsigned32: 1, integer32: -1 },
        [1, -1]
    );
    Ok(())
}

/// The node checks the order of the writes and the mapped objects. The node must reject a configuration with missing or
/// reordered writes.
#[test]
fn another_order_is_refused() -> Result<(), Error> {
    let Some((script, mut node)) = start("order", FILE) else { return Ok(()) };
    let [disable, clear, map, count, ..] = RxPdo4::configuration(node_id());
    assert_aborted(map.send(&mut node), AbortCode::DEVICE_STATE);
    assert_aborted(clear.send(&mut node), AbortCode::DEVICE_STATE);
    disable.send(&mut node)?;
    assert_aborted(map.send(&mut node), AbortCode::DEVICE_STATE);
    clear.send(&mut node)?;
    SdoWrite::new_u32(0x1603, 1, 0x2FFF_0010).send(&mut node)?;
    assert_aborted(count.send(&mut node), AbortCode::NO_OBJECT);
    SdoWrite::new_u32(0x1603, 1, 0x2201_0020).send(&mut node)?;
    assert_aborted(count.send(&mut node), AbortCode::NOT_MAPPABLE);
    map.send(&mut node)?;
    SdoWrite::new_u32(0x1603, 2, 0x2005_0008).send(&mut node)?;
    assert_aborted(SdoWrite::new_u8(0x1603, 0, 2).send(&mut node), AbortCode::PDO_LENGTH);
    configure(&mut node, RxPdo4::configuration(node_id()))?;
    // The node does not allow changing the COB-ID of an enabled PDO.
    let moved = SdoWrite::new_u32(0x1403, 1, 0x321);
    assert_aborted(moved.send(&mut node), AbortCode::DEVICE_STATE);
    drop(script);
    Ok(())
}

/// The node accepts communication parameters only while the PDO is disabled. The library reads them back. The PDOs of the
/// exported EDS have no inhibit time.
#[test]
fn communication_parameters() -> Result<(), Error> {
    let Some((mut script, mut node)) = start("parameters", FILE) else { return Ok(()) };
    let timing = |script: &mut Script| script.ask(json!({ "do": "timing", "number": 1 }));
    let event = PdoParameters::new().transmission(TransmissionType::ManufacturerEvent).remote_requests(false);
    let configuration = event.configure(TxPdo1::configuration(node_id())).expect("valid parameters");
    configuration.clone().send(&mut node)?;
    assert_eq!(timing(&mut script), json!([true, false, 254]));
    // The configuration disables the PDO first, so the PDO can be configured again.
    let cyclic = PdoParameters::new().transmission(TransmissionType::EverySync(240)).remote_requests(true);
    cyclic.configure(TxPdo1::configuration(node_id())).expect("valid parameters").send(&mut node)?;
    assert_eq!(timing(&mut script), json!([true, true, 240]));
    let write = { configuration }.nth(1).expect("the transmission type");
    assert_aborted(write.send(&mut node), AbortCode::DEVICE_STATE);
    let inhibited = event.inhibit_time(Duration::from_micros(1500)).configure(TxPdo1::configuration(node_id()));
    assert_aborted(inhibited.expect("valid parameters").send(&mut node), AbortCode::NO_SUB_INDEX);
    assert_eq!(timing(&mut script)[0], json!(false), "the PDO stays disabled");
    Ok(())
}
