//! E01 to E21: numbers, formulas, and comments behind them.

use lexibus_codegen::compile::Options;
use lexibus_codegen::ir::{ObjectCode, Type, Value};

use crate::support::*;

/// [DeviceInfo] with its own number of the vendor, which stands at line 3, column 14.
fn vendor(number: &str) -> String {
    format!(
        "[DeviceInfo]\nVendorName=Maker\nVendorNumber={number}\nProductName=Pump\nProductNumber=2\nRevisionNumber=3\n\
         [1018sub1]\nParameterName=Vendor\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\n"
    )
}

#[test]
fn e01_leading_zeros_in_vendor_number() {
    let checked = read(&vendor("001"));
    assert_eq!(checked.device().identity.vendor_id, Some(1));
    assert_eq!(checked.codes(), [""; 0]);
    // Where the zero makes another number of it, silence would be wrong.
    let octal = read(&vendor("010"));
    assert_eq!(octal.device().identity.vendor_id, Some(8));
    assert_eq!(octal.places("EDS020"), [(3, 14)]);
    let decimal = read(&vendor("018"));
    assert_eq!(decimal.device().identity.vendor_id, Some(18));
    assert_eq!(decimal.codes(), ["EDS021"]);
}

#[test]
fn e02_octal_default() {
    assert_default(U16, "012", Value::Int(10), &["EDS020"]);
    let checked = with_default(U16, "012");
    assert_eq!(checked.only("EDS020").fix.as_deref(), Some("10"));
}

#[test]
fn e03_leading_zero_that_is_not_octal() {
    assert_default(U16, "018", Value::Int(18), &["EDS021"]);
    assert_default(U32, "00000005", Value::Int(5), &["EDS021"]);
    assert_default(U32, "000000", Value::Int(0), &["EDS021"]);
    assert_default(BOOLEAN, "01", Value::Bool(true), &["EDS021"]);
    assert_default(U8, "0", Value::Int(0), &[]);
}

#[test]
fn e04_upper_case_prefix() {
    assert_default(U16, "0X1a", Value::Int(26), &[]);
}

#[test]
fn e05_empty_default_is_missing() {
    for ty in [U8, REAL32, STRING, OCTETS, BOOLEAN, DOMAIN, TIME] {
        assert_default(ty, "", None, &[]);
    }
    let limits = read(&var(U8, "LowLimit=\nHighLimit="));
    assert!(limits.item(0x2000, 0).limits.is_empty());
    assert_eq!(limits.codes(), [""; 0]);
}

#[test]
fn e06_empty_object_type_and_vendor_number() {
    let checked = read("[2000]\nParameterName=Speed\nObjectType=\nDataType=0x0005\nAccessType=rw\n");
    assert_eq!(checked.group(0x2000).object_code(), Some(ObjectCode::Var));
    assert_eq!(checked.codes(), [""; 0]);
    let checked = read(&vendor(""));
    assert_eq!(checked.device().identity.vendor_id, None);
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e07_limit_as_the_bits_of_a_negative_number() {
    let checked = read(&var(I32, "LowLimit=0x80000000\nHighLimit=0x7FFFFFFF"));
    let limits = &checked.item(0x2000, 0).limits;
    assert_eq!(limits.low, Some(Value::Int(-2_147_483_648)));
    assert_eq!(limits.high, Some(Value::Int(2_147_483_647)));
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e08_default_as_the_bits_of_a_negative_number() {
    assert_default(I32, "0xFFFFFFFF", Value::Int(-1), &["EDS024"]);
    assert_default(I16, "0x8000", Value::Int(-32768), &["EDS024"]);
    assert_default(U32, "0xFFFFFFFF", Value::Int(0xFFFF_FFFF), &[]);
    assert_default(I32, "-1", Value::Int(-1), &[]);
    // In decimal nobody means the bits.
    assert_default(I32, "4294967295", Value::Int(4_294_967_295), &["EDS025"]);
}

#[test]
fn e09_negative_hexadecimal() {
    assert_default(I32, "-0x77359400", Value::Int(-2_000_000_000), &[]);
}

#[test]
fn e10_limits_of_24_bits() {
    let checked = read(&var(I24, "LowLimit=-8388608\nHighLimit=8388607"));
    let item = checked.item(0x2000, 0);
    assert_eq!(item.ty, Type::Integer(24));
    assert_eq!((&item.limits.low, &item.limits.high), (&Some(Value::Int(-8_388_608)), &Some(Value::Int(8_388_607))));
    assert_eq!(checked.codes(), [""; 0]);
    assert_default(U24, "0xFFFFFF", Value::Int(0xFF_FFFF), &[]);
    assert_default(U24, "0x1000000", Value::Int(0x100_0000), &["EDS025"]);
}

#[test]
fn e11_limit_beyond_the_type() {
    let checked = read(&var(U16, "LowLimit=5\nHighLimit=65536"));
    assert_eq!(checked.item(0x2000, 0).limits.high, Some(Value::Int(65536)));
    assert_eq!(checked.codes(), ["EDS025"]);
    assert_eq!(checked.places("EDS025"), [(7, 11)]);
    let rust = checked.rust();
    assert!(rust.contains("rt::Range::From(5)"), "the upper limit says nothing about a u16:\n{rust}");
    assert!(!rust.contains("Between(5"));
}

#[test]
fn e12_formula() {
    assert_default(U32, "$NODEID+0x180", Value::NodeId(0x180), &[]);
}

#[test]
fn e13_blanks_in_a_formula() {
    assert_default(U32, "$NODEID + 0x40000180", Value::NodeId(0x4000_0180), &[]);
    assert_default(U32, "$NODEID +0x200", Value::NodeId(0x200), &[]);
}

#[test]
fn e14_formula_in_any_case() {
    assert_default(U32, "$nodeid+0x180", Value::NodeId(0x180), &[]);
    assert_default(U32, "$NodeID + 384", Value::NodeId(0x180), &[]);
}

#[test]
fn e15_reversed_formula() {
    assert_default(U32, "0x80+$NODEID", Value::NodeId(0x80), &["EDS026"]);
    let checked = with_default(U32, "0x80 + $NODEID");
    assert_eq!(checked.only("EDS026").fix.as_deref(), Some("$NODEID+0x80"));
}

#[test]
fn e16_node_id_alone() {
    assert_default(U8, "$NODEID", Value::NodeId(0), &[]);
}

#[test]
fn e17_sum_of_several_numbers() {
    assert_default(U32, "$NODEID+1+2", Value::NodeId(3), &[]);
}

#[test]
fn e18_other_name_of_the_node_id() {
    assert_default(U32, "$MY_NODE_ID+0x200", raw("$MY_NODE_ID+0x200"), &["EDS027"]);
    let options = Options { node_id_aliases: vec!["$MY_NODE_ID".into()], ..Options::default() };
    let checked = read_as(&file(&var(U32, "DefaultValue=$MY_NODE_ID+0x200")), "pump.eds", &options);
    assert_eq!(checked.default(0x2000, 0), Some(Value::NodeId(0x200)));
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e19_hexadecimal_suffix_and_prose() {
    assert_default(U16, "0000h", Value::Int(0), &["EDS023"]);
    assert_default(U16, "1Fh", Value::Int(0x1F), &["EDS023"]);
    assert_default(U32, "CAN-ID: 200h + Node-ID", raw("CAN-ID: 200h + Node-ID"), &["EDS022"]);
}

#[test]
fn e20_comment_behind_a_number() {
    for (text, value, comment) in
        [("5 ; five", 5, "five"), ("0x3ED ; prevent homing", 0x3ED, "prevent homing"), ("7;", 7, "")]
    {
        let checked = with_default(U16, text);
        assert_eq!(checked.default(0x2000, 0), Some(Value::Int(value)), "{text}");
        let kept = value_of(&checked.group(0x2000).extensions, ";").unwrap_or("");
        assert_eq!(kept, comment, "{text}");
        assert_eq!(checked.codes(), [""; 0], "{text}");
    }
    // No comment is lost, whatever it stands behind.
    let checked = read(
        "[DeviceInfo]\nVendorName=Maker\nVendorNumber=1 ; assigned\nProductName=Pump\nProductNumber=2\n\
         Granularity=8 ; grain\n\
         [2000]\nParameterName=Speeds\nObjectType=0x8 ; array\nSubNumber=1 ; one\n\
         [2000sub0]\nParameterName=Count\nDataType=0x0005 ; byte\nAccessType=ro\nDefaultValue=0\n\
         [ManufacturerObjects]\nSupportedObjects=1 ; few\n1=0x2000 ; speeds\n",
    );
    let comments = |extensions: &[lexibus_codegen::ir::Extension]| -> Vec<String> {
        extensions.iter().filter(|found| found.key.ends_with(';')).map(|found| found.value.to_string()).collect()
    };
    assert_eq!(comments(&checked.device().extensions), ["assigned", "grain", "few", "speeds"]);
    assert_eq!(comments(&checked.group(0x2000).extensions), ["array", "one"]);
    assert_eq!(comments(&checked.item(0x2000, 0).extensions), ["byte"]);
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e21_hash_comment_behind_a_value() {
    let checked = read(
        "[2000]\nParameterName=Speed\nObjectType=0x07 # VAR\nDataType=0x0007 # UNSIGNED32\nAccessType=rw # both\n\
         PDOMapping=0 # No\nDefaultValue=5 # five\n",
    );
    let item = checked.item(0x2000, 0);
    assert_eq!(item.ty, Type::Unsigned(32));
    assert_eq!(item.access, lexibus_codegen::ir::Access::ReadWrite);
    assert!(!item.mappable.any());
    assert_eq!(item.default, Some(Value::Int(5)));
    assert_eq!(checked.codes(), ["EDS014"; 5]);
    assert_eq!(checked.places("EDS014"), [(3, 17), (4, 17), (5, 15), (6, 14), (7, 16)]);
    let comments: Vec<&str> = checked.group(0x2000).extensions.iter().map(|comment| comment.value.as_str()).collect();
    assert_eq!(comments, ["VAR", "UNSIGNED32", "both", "No", "five"], "in the order of the file");
    // Lines that start with `#` are one finding.
    let checked = read("# a\n[2000]\n# b\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\n");
    assert_eq!(checked.codes(), ["EDS014"]);
    assert_eq!(checked.places("EDS014"), [(1, 1)]);
}
