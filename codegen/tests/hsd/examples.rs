//! Tests the worked examples of the manual and compares the defaults of both parameter sets.

use lexibus_codegen::ir::{Device, GivenNumber, GivenRef, Item, MessageField, Scale};

use super::hsd_support::{chapter, device, message, table};
use super::parameters::of_model;

/// Recalculates the worked examples of the manual with the scales of the register table. If the manual misprints a number, the
/// test expects the correct number.
#[test]
fn worked_examples() {
    let compilation = table();
    let device = device(&compilation);
    let given = |name: &str| device.given.iter().find(|given| given.name == name).expect("a given number");
    let model = |given_number: &GivenNumber, name: &str| {
        given_number.models.iter().find(|(model, _)| model == name).and_then(|(_, value)| value.as_real())
    };
    assert_eq!(model(given("counts per turn"), "SM137 rev. C"), Some(800.0));
    assert_eq!(model(given("counts per turn"), "SM140"), Some(2000.0));
    let (pitch, turn) = (0.32, 800.0);
    let field = |name: &str, is_reply: bool, field: &str| {
        let actual = message(device, name);
        let fields = if is_reply { &actual.reply } else { &actual.request };
        fields
            .iter()
            .find_map(|entry| match entry {
                MessageField::Value(value) if value.item.name == field => Some(value.item.clone()),
                _ => None,
            })
            .expect("the field")
    };
    let machine = |item: &Item, raw: f64, turn: f64| {
        physical(device, item, "SM137 rev. C", raw, &[("screw pitch", pitch), ("counts per turn", turn)])
    };
    // Section 3.6 misprints 6780.8465 mm as 6766.8176 mm. Sections 3.9 and 3.10 misprint 00 1B 6F 9E as 01 1B 6F 9E. Results in
    // sections 3.8 and 3.10 are truncated.
    let position = field("CmdMazz", false, "position");
    assert_eq!((6780.8465 / machine(&position, 1.0, turn)) as i64, 0x0102_AB34);
    let target = field("CmdTraj", false, "target");
    assert_eq!((1150.75 / machine(&target, 1.0, 500.0)) as i64, 0x001B_6F9E);
    let speed = field("CmdJogN", false, "speed");
    assert_eq!((-185.0 / machine(&speed, 1.0, turn)) as i16, 0xFDBEu16 as i16);
    let speed = field("CmdTrajVel", false, "speed");
    assert_eq!((150.0 / machine(&speed, 1.0, turn)) as u16, 0x01D4);
    // Section 3.11 contains a position and speeds that are read from the motor.
    let close = |one: f64, other: f64| assert!((one - other).abs() < 6e-5, "{one} {other}");
    close(
        machine(&field("Poll theoretical position", true, "theoretical position"), 163_647_659.0, turn),
        65_459.063_6,
    );
    close(machine(&field("Poll speeds", true, "theoretical speed"), 0x09C1 as f64, turn), 195.0781);
    close(machine(&field("Poll speeds", true, "real speed"), 0x10AB as f64, turn), 333.3594);
    // Section 5.3 encodes -185 mm/min as a fraction of 8000 rpm.
    let speed = field("CmdJog", false, "speed");
    assert_eq!((-185.0 / machine(&speed, 1.0, turn)) as i16, 0xF6C0u16 as i16);
    // Section 4.2 contains an override of 90 %, and section 4.16 the firmware version 103.
    assert_eq!(physical(device, &field("CmdSetOverr", false, "override"), "SM140", 0x5A as f64, &[]), 90.0);
    assert_eq!(physical(device, &field("CmdGetVer", true, "version"), "SM140", 0x67 as f64, &[]), 103.0);
    // In "Passo 1", 200 means 48.8 rpm. In "Rappresentazione di un numero in notazione [Q15]", the manual truncates the raw value
    // of 5 A. The result is 14482 with the printed base of 11.313 A, and 14481 with the exact base.
    let items = |title: &str, name: &str| {
        chapter(device, title).items.iter().find(|item| item.name == name).expect("an item").clone()
    };
    let rpm = physical(device, &items("Parameters", "RESERVED1"), "SM140", 200.0, &[]);
    assert_eq!((rpm * 10.0).trunc() / 10.0, 48.8);
    let amperes = physical(device, &items("Low-level parameters", "KVELLIMAX"), "SM137 rev. C", 1.0, &[]);
    let (truncated, nearest) = ((5.0 / amperes) as i32, (5.0 / amperes).round() as i32);
    assert_eq!((truncated, nearest, (5.0 / 11.313 * 32768.0) as i32), (14_481, 14_482, 14_482));
    // "Notazione mantissa-esponente [ME15]" contains two notations of 15.5. "Guadagni dei regolatori …" contains 0.58, 15 %,
    // and 0.08 / 0.58. The manual prints the rounded raw value of the quotient, 4520.
    let Some(Scale::Exponent { base: 2, fraction: 15, exponent }) =
        &items("Low-level parameters", "KVELPIMANT").quantity.expect("a scale").scale.clone()
    else {
        panic!("mantissa and exponent");
    };
    assert_eq!(exponent, "KVELPIEXP");
    let me15 = |mantissa: f64, exponent: i32| mantissa / 32768.0 * 2f64.powi(exponent);
    assert_eq!((me15(31_744.0, 4), me15(15_872.0, 5)), (15.5, 15.5));
    assert_eq!((0.58 / me15(1.0, 0)) as i32, 19_005);
    assert_eq!((15.0 / physical(device, &items("Low-level parameters", "KVELKFF"), "SM140", 1.0, &[])) as i32, 4915);
    let kcor = 0.08 / 0.58 / physical(device, &items("Low-level parameters", "KVELKCOR"), "SM140", 1.0, &[]);
    assert_eq!((kcor as i32, kcor.round() as i32), (4519, 4520));
    // In "Quantizzazione SM137", 430 mm/s² contains 17 whole steps of 78.125 turns/s², that is, 425 mm/s².
    assert_eq!((430.0 / pitch / 78.125_f64).trunc() * 78.125 * pitch, 425.0);
    // In sections 3.9 and 3.10, a position can be at most 67108863 counts away from 1000.
    assert_eq!((1000 - 67_108_863, 1000 + 67_108_863), (-67_107_863, 67_109_863));
}

/// Converts a raw value to a physical value. If `numbers` contains the constants of a machine, the result is in the machine's
/// unit.
fn physical(device: &Device, item: &Item, model: &str, raw: f64, numbers: &[(&str, f64)]) -> f64 {
    let Some(quantity) = item.quantity.as_ref() else { return raw };
    let constant = |name: &str| {
        let model = device.variants.iter().find(|variant| variant.name == model).expect("the model");
        let (_, value) = model.constants.iter().find(|(constant, _)| constant == name).expect("a constant");
        value.as_real().expect("a number")
    };
    let physical = match &quantity.scale {
        None => raw,
        Some(Scale::Linear { factor, offset }) => raw * factor + offset,
        Some(Scale::Fraction { bits, base }) => raw / f64::from(1u32 << bits) * constant(base),
        other => panic!("{other:?}"),
    };
    let given = |name: &str| numbers.iter().find(|(number, _)| *number == name).map(|(_, value)| *value);
    let Some(machine) = quantity.machine.as_ref().filter(|_| !numbers.is_empty()) else { return physical };
    let product = |list: &[GivenRef]| list.iter().map(|name| given(name).expect("given")).product::<f64>();
    physical * product(&machine.times) / product(&machine.over)
}

/// The defaults of both parameter sets must agree within a thousandth, unless a `doubt` entry explains the difference.
#[test]
fn defaults_of_both_chapters_agree() {
    let compilation = table();
    let device = device(&compilation);
    let value = |title: &str, name: &str, model: &str| {
        let item = chapter(device, title).items.iter().find(|item| item.name == name).expect("a parameter");
        let raw = of_model(item, model)[0].expect("a default") as f64;
        physical_of(device, item, title, model, raw)
    };
    let (mut compared, mut wrong) = (0, Vec::new());
    for model in ["SM137 rev. C", "SM140"] {
        let high = |name: &str| value("Parameters", name, model);
        let low = |name: &str| value("Low-level parameters", name, model);
        let turn = if model == "SM140" { 2000.0 } else { 800.0 };
        let pairs = [
            ("KIQDPIMANT", high("KP_I") + high("KI_I"), low("KIQDPIMANT")),
            ("KIQDKCOR", high("KI_I") / (high("KP_I") + high("KI_I")), low("KIQDKCOR")),
            ("KVELPIMANT", high("KP_VEL") + high("KI_VEL"), low("KVELPIMANT")),
            ("KVELKCOR", high("KI_VEL") / (high("KP_VEL") + high("KI_VEL")), low("KVELKCOR")),
            ("KPOSPIMANT", high("KP_POS") + high("KI_POS"), low("KPOSPIMANT")),
            ("KPOSKCOR", high("KI_POS") / (high("KP_POS") + high("KI_POS")), low("KPOSKCOR")),
            ("KVELKFF", high("KFF_VEL"), low("KVELKFF")),
            ("KPOSKFF", high("KFF_POS"), low("KPOSKFF")),
            ("KIQDLIMIN", high("PIMIN_I"), low("KIQDLIMIN")),
            ("KIQDLIMAX", high("PIMAX_I"), low("KIQDLIMAX")),
            ("KVELLIMIN", high("PIMIN_VEL"), low("KVELLIMIN")),
            ("KVELLIMAX", high("PIMAX_VEL"), low("KVELLIMAX")),
            ("KPOSLIMMIN", high("PIMIN_POS"), low("KPOSLIMMIN")),
            ("KPOSLIMAX", high("PIMAX_POS"), low("KPOSLIMAX")),
            ("AMAXHOLD", high("AMAX") / turn, low("AMAXHOLD")),
            ("AMAXTRAJ", high("AMAXPOS") / turn, low("AMAXTRAJ")),
            ("VMAXTRAJ", high("VMAXPOS"), low("VMAXTRAJ")),
            ("MAXERRORV", high("MAXERRORV"), low("MAXERRORV_LOW")),
            ("MAXTORQUE", high("MAXTORQ"), low("MAXTORQUE")),
            ("TIMEOUTMAXTORQUE", high("TIM_MAXTORQ"), low("TIMEOUTMAXTORQUE")),
        ];
        for (name, high, low) in pairs {
            compared += 1;
            if (high - low).abs() > 0.001 * high.abs().max(low.abs()) {
                wrong.push((model, name));
            }
        }
    }
    // The defaults of PIMIN_I and PIMAX_I on the SM140 are -19.5 V and 19.5 V, but the voltage base is 19.6 V. `doubt` entries
    // explain the difference.
    assert_eq!((compared, wrong), (40, vec![("SM140", "KIQDLIMIN"), ("SM140", "KIQDLIMAX")]));
}

/// Converts a default to a physical value. If the raw value is a mantissa, the result also depends on its exponent.
fn physical_of(device: &Device, item: &Item, title: &str, model: &str, raw: f64) -> f64 {
    match item.quantity.as_ref().and_then(|quantity| quantity.scale.as_ref()) {
        Some(Scale::Exponent { exponent, base: 2, fraction }) => {
            let other = chapter(device, title).items.iter().find(|item| item.name == *exponent).expect("the exponent");
            let exponent = of_model(other, model)[0].expect("a default") as i32;
            raw / f64::from(1u32 << fraction) * 2f64.powi(exponent)
        }
        _ => physical(device, item, model, raw, &[]),
    }
}
