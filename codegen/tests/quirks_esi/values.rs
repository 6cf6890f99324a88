//! X15, X16: defaults and limits.

use lexibus_codegen::ir::{Type, Value};

use crate::support::*;

/// The default of an object of this type, and what was found.
fn value(ty: &str, bits: u32, info: &str) -> (Option<Value>, Vec<String>) {
    let checked = dictionary(&basic(ty, bits), &var("#x2000", ty, info));
    (checked.default(0x2000, 0), checked.found())
}

fn data(ty: &str, bits: u32, digits: &str) -> (Option<Value>, Vec<String>) {
    value(ty, bits, &format!("<DefaultData>{digits}</DefaultData>"))
}

fn number(ty: &str, bits: u32, text: &str) -> (Option<Value>, Vec<String>) {
    value(ty, bits, &format!("<DefaultValue>{text}</DefaultValue>"))
}

fn some(value: Value) -> (Option<Value>, Vec<String>) {
    (Some(value), vec![])
}

#[test]
fn x15_data_is_in_the_order_of_memory() {
    assert_eq!(data("UDINT", 32, "89130200"), some(Value::Int(0x21389)));
    assert_eq!(data("INT", 16, "FFFF"), some(Value::Int(-1)));
    assert_eq!(data("BOOL", 1, "01"), some(Value::Bool(true)));
    assert_eq!(data("REAL", 32, "0000C03F"), some(Value::Real(1.5)));
    assert_eq!(data("LREAL", 64, "000000000000F83F"), some(Value::Real(1.5)));
    assert_eq!(data("STRING(4)", 32, "41424300"), some(Value::Text("ABC".into())));
    assert_eq!(data("BIT4", 4, "05"), some(Value::Int(5)));
    assert_eq!(data("UDINT", 32, "89\n 13 02\n00"), some(Value::Int(0x21389)));
    assert_eq!(data("GUID", 128, "0102"), some(Value::Bytes(vec![1, 2])));
}

#[test]
fn x15_odd_and_short_data() {
    let (default, found) = data("USINT", 8, "5");
    assert_eq!((default, &found[..]), (int(5), &["ESI020 5:85".to_owned()][..]));
    let (default, found) = data("UDINT", 32, "0A");
    assert_eq!((default, &found[..]), (int(10), &["ESI021 5:85".to_owned()][..]));
    let (default, found) = data("USINT", 8, "0A000000");
    assert_eq!((default, found.len()), (int(10), 1));
    let (default, found) = data("USINT", 8, "0A01");
    assert_eq!((default, found.len()), (Some(Value::Bytes(vec![10, 1])), 1));
    let (default, found) = data("USINT", 8, "0G");
    assert_eq!((default, &found[..]), (None, &["ESI001 5:85".to_owned()][..]));
}

#[test]
fn x16_numbers_of_every_type() {
    assert_eq!(number("UDINT", 32, "#x01901389"), some(Value::Int(0x0190_1389)));
    assert_eq!(number("DINT", 32, "#xFFFFFFFF"), some(Value::Int(-1)));
    assert_eq!(number("DINT", 32, "-9999"), some(Value::Int(-9999)));
    assert_eq!(number("ULINT", 64, "18446744073709551615"), some(Value::Int(u64::MAX.into())));
    assert_eq!(number("ULINT", 64, "#xFFFFFFFFFFFFFFFF"), some(Value::Int(u64::MAX.into())));
    assert_eq!(number("REAL", 32, "2.5"), some(Value::Real(2.5)));
    assert_eq!(number("REAL", 32, "#x3FC00000"), some(Value::Real(1.5)));
    assert_eq!(number("BOOL", 1, "1"), some(Value::Bool(true)));
    let first = |(value, found): (Option<Value>, Vec<String>)| (value, found.into_iter().next());
    assert_eq!(first(number("UDINT", 32, "-1")), (int(u32::MAX.into()), Some("ESI024 5:86".into())));
    assert_eq!(first(number("UINT", 16, "70000")), (int(70000), Some("ESI022 5:85".into())));
    assert_eq!(first(number("UINT", 16, "2.0")), (int(2), Some("ESI023 5:85".into())));
    assert_eq!(first(number("UINT", 16, "2.5")), (Some(Value::Raw("2.5".into())), Some("ESI023 5:85".into())));
    assert_eq!(first(number("REAL", 32, "#x2")), (Some(Value::Real(2.0)), Some("ESI023 5:85".into())));
    assert_eq!(first(number("UINT", 16, "1F")), (int(31), Some("ESI003 5:85".into())));
}

#[test]
fn x16_limits() {
    let info = "<MinValue>-9999</MinValue><MaxValue>#x7FFF</MaxValue><DefaultValue>0</DefaultValue>";
    let checked = dictionary(&basic("INT", 16), &var("#x2000", "INT", info));
    let limits = &checked.item(0x2000, 0).limits;
    assert_eq!((limits.low.clone(), limits.high.clone()), (int(-9999), int(0x7FFF)));
    assert_eq!(checked.found(), NOTHING);
    let data = "<MinData>00000080</MinData><MaxData>FFFFFF7F</MaxData>";
    let checked = dictionary(&basic("DINT", 32), &var("#x2000", "DINT", data));
    let limits = &checked.item(0x2000, 0).limits;
    assert_eq!((limits.low.clone(), limits.high.clone()), (int(i32::MIN.into()), int(i32::MAX.into())));
    assert_eq!(checked.found(), NOTHING);
    let unsigned = "<MinValue>-5</MinValue><MaxValue>-1</MaxValue>";
    let checked = dictionary(&basic("UINT", 16), &var("#x2000", "UINT", unsigned));
    assert_eq!(checked.item(0x2000, 0).limits.high, int(0xFFFF));
    assert_eq!(checked.found(), ["ESI022 5:81", "ESI024 5:104"]);
}

#[test]
fn texts_and_units() {
    let string = value("STRING(8)", 64, "<DefaultString>A &amp; B</DefaultString>");
    assert_eq!(string, some(Value::Text("A & B".into())));
    let (default, found) = value("UINT", 16, "<DefaultString>7</DefaultString>");
    assert_eq!((default, found), (int(7), vec!["ESI023 5:86".to_owned()]));
    let (default, found) = value("STRING(8)", 64, "<DefaultValue>7</DefaultValue>");
    assert_eq!((default, found.len()), (Some(Value::Text("7".into())), 1));
    let unit = |text: &str| {
        let checked = dictionary(&basic("UINT", 16), &var("#x2000", "UINT", &format!("<Unit>{text}</Unit>")));
        (checked.item(0x2000, 0).quantity.as_ref().unwrap().unit.to_string(), checked.found())
    };
    assert_eq!(unit("#xfd260000"), ("mV".into(), vec![]));
    assert_eq!(unit("#x00ff0000"), ("#x00ff0000".into(), vec![]));
    assert_eq!(unit("volts"), ("volts".into(), vec!["ESI001 5:77".to_owned()]));
    let own = "<UnitTypes><UnitType><NotationIndex>#xA1</NotationIndex><Symbol>mG</Symbol></UnitType></UnitTypes>";
    let types = format!("{own}<DataTypes>{}</DataTypes>", basic("UINT", 16));
    let object = var("#x2000", "UINT", "<Unit>#x00a10000</Unit>");
    let checked = device(&format!("<Profile><Dictionary>{types}<Objects>{object}</Objects></Dictionary></Profile>"));
    assert_eq!(checked.item(0x2000, 0).quantity.as_ref().unwrap().unit, "mG");
    assert_eq!(checked.item(0x2000, 0).ty, Type::Unsigned(16));
}
