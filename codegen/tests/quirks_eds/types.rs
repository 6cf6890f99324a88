//! E50 to E57: values and types.

use lexibus_codegen::ir::{Access, ObjectCode, Shape, Type, Value};

use crate::support::*;

#[test]
fn e50_fraction_for_an_integer() {
    assert_default(U32, "0.0", Value::Int(0), &["EDS028"]);
    assert_default(I32, "-7.00", Value::Int(-7), &["EDS028"]);
    assert_default(U32, "2.5", raw("2.5"), &["EDS028"]);
}

#[test]
fn e51_real_numbers() {
    for (ty, text, value, codes) in [
        (REAL32, "1.5", 1.5, &[][..]),
        (REAL32, "0x3FC00000", 1.5, &[]),
        (REAL32, "1,5", 1.5, &["EDS029"]),
        (REAL32, "-3.402823E+38", -3.402_823E+38, &[]),
        (REAL32, "0x02", 2.0, &["EDS030"]),
        (REAL32, "7", 7.0, &[]),
        (REAL64, "0x3FF8000000000000", 1.5, &[]),
        (REAL64, "0x3FC00000", f64::from(0x3FC0_0000), &["EDS030"]),
        (REAL64, "0.1", 0.1, &[]),
    ] {
        assert_default(ty, text, Value::Real(value), codes);
    }
    for text in ["nan", "inf", "0x7FC00000", "0xFF800000", "one", "1,2,3"] {
        assert_default(REAL32, text, raw(text), &["EDS022"]);
    }
}

#[test]
fn e52_visible_strings() {
    for plain in ["abc", "1.0", "00000000000000000000", "0x10", "5 ; five", "a # b", "ä ß €", "$NODEID+1"] {
        assert_default(STRING, plain, text(plain), &[]);
    }
    // A mark that is taken off is a repair, here as in a name (E23).
    assert_default(STRING, "\"abc\"", text("abc"), &["EDS016"]);
    assert_default(STRING, "\"", text("\""), &[]);
}

#[test]
fn e53_octet_strings() {
    for text in ["01a105", "01 a1 05", "0x01a105", "01A105"] {
        assert_default(OCTETS, text, Value::Bytes(vec![0x01, 0xA1, 0x05]), &[]);
    }
    for text in ["01a", "xyz", "0", "0x", "1,5", "01-a1"] {
        assert_default(OCTETS, text, raw(text), &["EDS037"]);
    }
}

#[test]
fn e54_default_of_a_domain() {
    for text in ["0", "0x0000", "@ABCD", "a ; b # c"] {
        assert_default(DOMAIN, text, raw(text), &["EDS031"]);
    }
}

#[test]
fn e55_domain_with_nothing_but_a_name() {
    let checked = read("[2000]\nParameterName=Program\nObjectType=2\n");
    let item = checked.item(0x2000, 0);
    assert_eq!(checked.group(0x2000).object_code(), Some(ObjectCode::Domain));
    assert_eq!((item.ty, item.access), (Type::Domain, Access::ReadWrite));
    assert_eq!(checked.codes(), [""; 0]);
    // The same holds for a sub-index.
    let checked = read(
        "[2000]\nParameterName=Programs\nObjectType=9\nSubNumber=2\n\
         [2000sub0]\nParameterName=Count\nDataType=0x0005\nAccessType=ro\n\
         [2000sub1]\nParameterName=Program\nObjectType=0x2\n",
    );
    assert_eq!((checked.item(0x2000, 1).ty, checked.item(0x2000, 1).access), (Type::Domain, Access::ReadWrite));
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e56_booleans_times_and_unknown_types() {
    for (text, value) in [("true", true), ("TRUE", true), ("1", true), ("0", false), ("0x1", true), ("False", false)] {
        assert_default(BOOLEAN, text, Value::Bool(value), &[]);
    }
    assert_default(BOOLEAN, "2", Value::Int(2), &["EDS025"]);
    assert_default(BOOLEAN, "maybe", raw("maybe"), &["EDS022"]);
    assert_default(TIME, "0", Value::Time { milliseconds: 0, days: 0 }, &[]);
    assert_default(TIME, "0x000300000007", Value::Time { milliseconds: 7, days: 3 }, &[]);
    // Four bits between milliseconds and days mean nothing.
    assert_default(TIME, "0x10000000", raw("0x10000000"), &["EDS025"]);
    for code in [0x40, 0x00] {
        let checked = with_default(code, "5");
        let item = checked.item(0x2000, 0);
        assert_eq!((item.ty, item.access), (Type::Opaque(Some(code)), Access::ReadWrite));
        assert_eq!(item.default, Some(raw("5")));
        assert_eq!(checked.codes(), ["EDS036"]);
        assert_eq!(checked.places("EDS036"), [(4, 10)]);
    }
}

#[test]
fn e56_numbers_that_are_no_code() {
    for (code, found) in [("-1", "EDS036"), ("0x100000007", "EDS036"), ("$NODEID+7", "EDS036"), ("UNSIGNED8", "EDS022")]
    {
        let checked = read(&format!("[2000]\nParameterName=Speed\nObjectType=7\nDataType={code}\nAccessType=rw\n"));
        let item = checked.item(0x2000, 0);
        assert_eq!((item.ty, item.access), (Type::Opaque(None), Access::ReadOnly), "{code}");
        assert_eq!((checked.codes(), checked.places(found)), (vec![found], vec![(4, 10)]), "{code}");
    }
}

#[test]
fn e57_type_of_the_file() {
    let deftype = |more: &str| {
        read(&format!(
            "[00A0]\nParameterName=Speed\nObjectType=5\n{more}\n\
             [2000]\nParameterName=Limit\nObjectType=7\nDataType=0x00A0\nAccessType=rw\n\
             [OptionalObjects]\nSupportedObjects=0\n"
        ))
    };
    for (more, ty, bits) in [
        ("DataType=0x0004\nAccessType=ro", Type::Integer(32), Some(32)),
        ("DataType=0x0007\nAccessType=ro\nDefaultValue=32", Type::Unsigned(32), Some(32)),
        // What it gives to read is the length in bits, and so it isn't another name of UNSIGNED32.
        ("DataType=0x0007\nAccessType=ro\nDefaultValue=12", Type::Opaque(Some(0xA0)), Some(12)),
        ("", Type::Opaque(Some(0xA0)), None),
    ] {
        let checked = deftype(more);
        assert_eq!(checked.item(0x2000, 0).ty, ty, "{more}");
        let defined = &checked.device().types[0];
        assert_eq!((defined.name.as_str(), defined.code, defined.bits), ("Speed", Some(0xA0), bits), "{more}");
        assert_eq!(defined.shape, Shape::Alias(ty));
        assert_eq!(checked.codes(), [""; 0], "{more}");
    }
}

#[test]
fn e57_type_with_subs() {
    let deftype = |kind: u8, first: &str| {
        read(&format!(
            "[A0]\nParameterName=Percentage\nObjectType={kind}\nSubNumber=2\n\
             [A0sub0]\nParameterName=Number of entries\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n\
             [A0sub1]\nParameterName={first}\nDataType=0x0005\nAccessType=ro\nDefaultValue=0x4\n\
             [2000]\nParameterName=Limit\nObjectType=7\nDataType=0x00A0\nAccessType=rw\n"
        ))
    };
    // The count of its entries isn't the type that it stands for.
    let named = deftype(5, "Type");
    assert_eq!(named.item(0x2000, 0).ty, Type::Integer(32));
    assert_eq!(named.codes(), ["EDS010"; 3]);
    for checked in [deftype(5, "Something"), deftype(6, "Type")] {
        assert_eq!(checked.item(0x2000, 0).ty, Type::Opaque(Some(0xA0)));
        assert_eq!(checked.codes(), ["EDS010"; 3]);
    }
}
