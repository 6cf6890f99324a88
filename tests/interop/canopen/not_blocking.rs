//! Tests asynchronous accessors with the Python node: all kinds of transfers, NMT states and PDOs.

use lexibus::clients::canopen::{AsyncCanPort, NmtCommand, NmtState};
use lexibus::{AbortCode, Int};
use serde_json::json;

use super::all_types::pdo::{RxPdo3, TxPdo7};
use super::all_types::AllTypes;
use super::pdo::{expected, frame, used};
use super::refusals::{assert_aborted, naive};
use super::{node_id, start_async, Error, NODE, PATIENCE};
use crate::block_on;

const FILE: &str = "tests/interop/all-types.toml";

#[test]
fn transfers() -> Result<(), Error> {
    block_on(async {
        let Some((mut script, node, _cable)) = start_async("async-transfers", FILE) else { return Ok(()) };
        let mut device = AllTypes::new(node);
        device.integer24().write_async(-0x12_3456).await?;
        assert_eq!(script.get(0x2010, 0), -0x12_3456);
        script.set(0x2015, 0, json!(-2));
        assert_eq!(device.integer64().read_async().await?, -2);
        let text = "a text that takes more than one segment";
        device.visible_string().write_async(text).await?;
        assert_eq!(script.get(0x2009, 0), text);
        let name = "A node that has an object of every type";
        assert_eq!(device.device_name().read_into_async(&mut [0; 64]).await?, name);
        let mut scratch = [0; 64];
        device.unicode_string().write_async("日本語のテキスト", &mut scratch).await?;
        assert_eq!(script.get(0x200B, 0), "日本語のテキスト");
        assert!(matches!(
            device.limited_signed().write_async(201).await.map_err(Error::from),
            Err(Error::OutOfRange(_))
        ));
        let refused = naive::<i16>(0x2203, 0).at(device.client()).write_async(201).await;
        assert_aborted(refused, AbortCode::TOO_HIGH);
        assert_aborted(device.never_set().read_async().await, AbortCode::NO_RESOURCE);
        Ok(())
    })
}

#[test]
fn states_and_pdos() -> Result<(), Error> {
    block_on(async {
        let Some((mut script, mut node, _cable)) = start_async("async-pdos", FILE) else { return Ok(()) };
        assert_eq!(node.heartbeat_async(PATIENCE).await?, Some(NmtState::BootUp));
        for write in RxPdo3::configuration(node_id()).into_iter().chain(TxPdo7::configuration_as(0x333)) {
            write.send_async(&mut node).await?;
        }
        let id = 0x400 + u32::from(NODE);
        assert_eq!(used(&mut script, "rx", 3), expected::<RxPdo3>(id, 255));
        assert_eq!(used(&mut script, "tx", 7), expected::<TxPdo7>(0x333, 255));
        node.nmt_async(NmtCommand::Start).await?;
        let sent = RxPdo3 { real32: -1.5, integer16: -2, unsigned8: 0xA5, integer8: -128 };
        node.send_async(&frame(id, &sent.pack())).await?;
        assert_eq!(script.ask(json!({ "do": "receive", "number": 3 })), json!([-1.5, -2, 0xA5, -128]));
        assert_eq!(script.ask(json!({ "do": "state" })), "OPERATIONAL");

        script.ask(json!({ "do": "load", "number": 7, "values": [-0x12_3456_789A_i64, 0x12_3456] }));
        script.ask(json!({ "do": "transmit", "number": 7 }));
        script.ask(json!({ "do": "emergency", "code": 0x8110, "register": 0x11, "data": "" }));
        let emergency = node.emergency_async(PATIENCE).await?.expect("an emergency message");
        assert_eq!((emergency.code, emergency.register), (0x8110, 0x11));
        let received = node.port().receive(PATIENCE, &mut |frame| frame.id() == 0x333).await.expect("a line");
        let (integer40, integer24) = (Int::new(-0x12_3456_789A).unwrap(), Int::new(0x12_3456).unwrap());
        assert_eq!(TxPdo7::unpack(received.expect("a frame").data())?, TxPdo7 { integer40, integer24 });
        Ok(())
    })
}
