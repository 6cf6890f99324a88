//! E38 to E49: objects and their sub-indices.

use lexibus_codegen::ir::{Access, ObjectCode, Type, Value};

use crate::support::*;

/// A sub-index of 0x2000.
fn sub(number: &str, ty: u32, more: &str) -> String {
    format!("[2000sub{number}]\nParameterName=S{number}\nObjectType=0x7\nDataType={ty:#06x}\nAccessType=rw\n{more}\n")
}

/// A RECORD at 0x2000 with sub-index 0 (up to `highest`) and these others. The lines `more` begin with line 4.
fn record(more: &str, highest: u8, subs: &[&str]) -> String {
    let mut text = format!("[2000]\nParameterName=Speeds\nObjectType=0x9\n{more}\n");
    text += &sub("0", U8, &format!("DefaultValue={highest}"));
    subs.iter().for_each(|number| text += &sub(number, U16, ""));
    text
}

#[test]
fn e38_sparse_subs() {
    let checked = read(&record("SubNumber=2", 4, &["4"]));
    assert_eq!(checked.subs(0x2000), [0, 4]);
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e39_wrong_sub_number() {
    for (announced, subs) in [(1, ["1", "2"]), (6, ["1", "2"]), (0, ["1", "2"])] {
        let checked = read(&record(&format!("SubNumber={announced}"), 2, &subs));
        assert_eq!(checked.subs(0x2000), [0, 1, 2], "the sections win");
        assert_eq!(checked.codes(), ["EDS046"], "{announced}");
        assert_eq!(checked.places("EDS046"), [(4, 11)]);
        assert_eq!(checked.only("EDS046").fix.as_deref(), Some("3"));
    }
    let garbage = read(&record("SubNumber=two", 2, &["1", "2"]));
    assert_eq!(garbage.codes(), ["EDS022"]);
}

#[test]
fn e40_no_sub_number() {
    for more in ["", "SubNumber="] {
        let checked = read(&record(more, 2, &["1", "2"]));
        assert_eq!(checked.subs(0x2000), [0, 1, 2]);
        assert_eq!(checked.codes(), [""; 0]);
    }
}

#[test]
fn e41_leading_zero_of_a_sub_index() {
    let checked = read(&record("SubNumber=3", 0x10, &["01", "10"]));
    assert_eq!(checked.subs(0x2000), [0, 1, 0x10]);
    assert_eq!(checked.codes(), ["EDS010"]);
    assert_eq!(checked.places("EDS010"), [(11, 2)]);
    assert_eq!(checked.only("EDS010").fix.as_deref(), Some("2000sub1"));
    let zero = read(&record("SubNumber=1", 0, &[]).replace("2000sub0", "2000sub00"));
    assert_eq!(zero.subs(0x2000), [0]);
    assert_eq!(zero.codes(), ["EDS010"]);
}

#[test]
fn e42_var_with_subs() {
    let checked = read(&record("SubNumber=3", 2, &["1", "2"]).replace("ObjectType=0x9", "ObjectType=7"));
    assert_eq!(checked.group(0x2000).object_code(), Some(ObjectCode::Record));
    assert_eq!(checked.subs(0x2000), [0, 1, 2]);
    assert_eq!(checked.codes(), ["EDS047"]);
    assert_eq!(checked.places("EDS047"), [(3, 12)]);
    // One that has a type of its own has a value of its own.
    let typed = read(&format!("{}[2000sub1]\nParameterName=S1\nDataType=0x0006\nAccessType=ro\n", var(I32, "")));
    assert_eq!(typed.names(0x2000), ["Speed", "S1"]);
    assert_eq!(typed.item(0x2000, 0).ty, Type::Integer(32));
    assert_eq!(typed.codes(), ["EDS047"]);
}

#[test]
fn e43_compact_sub_objects() {
    let checked = read(
        "[2000]\nParameterName=Arr\nObjectType=8\nDataType=0x0003\nAccessType=rw\nDefaultValue=5\nLowLimit=-9\n\
         PDOMapping=1\nObjFlags=2\nCompactSubObj=3\n",
    );
    assert_eq!(checked.names(0x2000), ["NrOfObjects", "Arr1", "Arr2", "Arr3"]);
    let count = checked.item(0x2000, 0);
    assert_eq!(
        (count.ty, count.access, count.default.clone()),
        (Type::Unsigned(8), Access::ReadOnly, Some(Value::Int(3)))
    );
    for sub in 1..=3 {
        let element = checked.item(0x2000, sub);
        assert_eq!((element.ty, element.access), (Type::Integer(16), Access::ReadWrite));
        assert_eq!((element.default.clone(), element.limits.low.clone()), (Some(Value::Int(5)), Some(Value::Int(-9))));
        assert!(element.mappable.any() && element.flags == 2);
    }
    assert_eq!(checked.group(0x2000).flags, 2);
    assert_eq!(checked.codes(), [""; 0]);
    assert_eq!(checked.info()["devices"][0]["entries"], 1 + 1 + 4 + 4);
}

#[test]
fn e43_counts_that_no_object_has() {
    let compact = |count: &str| {
        read(&format!(
            "[2000]\nParameterName=Arr\nObjectType=8\nDataType=0x0005\nAccessType=rw\nSubNumber=0\n\
             CompactSubObj={count}\n"
        ))
    };
    let most = compact("0xFE");
    assert_eq!((most.subs(0x2000).len(), most.codes()), (255, vec![]));
    let too_many = compact("300");
    assert_eq!((too_many.subs(0x2000).len(), too_many.codes()), (255, vec!["EDS064"]));
    assert_eq!(too_many.places("EDS064"), [(7, 15)]);
    assert_eq!(compact("three").codes(), ["EDS057", "EDS022"]);
    // 0 is how tools write that there are none.
    assert_eq!(read(&var(U8, "CompactSubObj=0\nSubNumber=0")).codes(), [""; 0]);
}

#[test]
fn e44_names_and_values_of_compact_sub_objects() {
    let checked = read_dcf(
        "[2000]\nParameterName=Arr\nObjectType=8\nDataType=0x0005\nAccessType=rw\nCompactSubObj=3\n\
         [2000Name]\nNrOfEntries=1\n3=Third\n\
         [2000Value]\nNrOfEntries=1\n2=0x99 ; set\n\
         [2000Denotation]\nNrOfEntries=1\n2=Größe\n\
         [DeviceComissioning]\nNodeID=5\nBaudrate=125\n",
    );
    assert_eq!(checked.names(0x2000), ["NrOfObjects", "Arr1", "Arr2", "Third"]);
    let second = checked.item(0x2000, 2);
    let configured = second.configured.as_ref().unwrap();
    assert_eq!((configured.value.clone(), configured.denotation.as_deref()), (Some(Value::Int(0x99)), Some("Größe")));
    assert_eq!((second.initial(), second.default.as_ref()), (Some(&Value::Int(0x99)), None));
    assert_eq!(value_of(&second.extensions, ";"), Some("set"));
    assert!(checked.item(0x2000, 1).configured.is_none());
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e45_compact_and_described_subs() {
    let text =
        "[2000]\nParameterName=Arr\nObjectType=8\nDataType=0x0005\nAccessType=ro\nSubNumber=2\nCompactSubObj=3\n";
    let checked = read(&(text.to_owned() + &sub("2", U16, "DefaultValue=9")));
    assert_eq!(checked.names(0x2000), ["NrOfObjects", "Arr1", "S2", "Arr3"]);
    assert_eq!(checked.item(0x2000, 2).ty, Type::Unsigned(16));
    assert_eq!(checked.places("EDS048"), [(6, 11)]);
    assert_eq!(checked.codes(), ["EDS048", "EDS059"], "the elements differ, too");
}

#[test]
fn e46_no_object_type() {
    let checked = read("[2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\n");
    assert_eq!(checked.group(0x2000).object_code(), Some(ObjectCode::Var));
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e47_access_in_any_case() {
    for (text, access) in [
        ("RO", Access::ReadOnly),
        ("Const", Access::Constant),
        ("CONST", Access::Constant),
        ("Wo", Access::WriteOnly),
        ("RWR", Access::ReadWriteInput),
        ("rwW", Access::ReadWriteOutput),
    ] {
        let checked = read(&format!("[2000]\nParameterName=Speed\nDataType=0x0005\nAccessType={text}\n"));
        assert_eq!(checked.item(0x2000, 0).access, access, "{text}");
        assert_eq!(checked.codes(), [""; 0], "{text}");
    }
}

#[test]
fn e48_other_access() {
    for (text, access, codes) in [
        ("r", Access::ReadOnly, &["EDS033"][..]),
        ("R", Access::ReadOnly, &["EDS033"]),
        ("w", Access::WriteOnly, &["EDS033"]),
        ("readable", Access::ReadOnly, &["EDS033"]),
        ("rw; both ways", Access::ReadWrite, &[]),
        ("rw;", Access::ReadWrite, &[]),
        ("rw # both ways", Access::ReadWrite, &["EDS014"]),
    ] {
        let checked = read(&format!("[2000]\nParameterName=Speed\nDataType=0x0005\nAccessType={text}\n"));
        assert_eq!(checked.item(0x2000, 0).access, access, "{text}");
        assert_eq!(checked.codes(), codes, "{text}");
        if codes == ["EDS033"] {
            assert_eq!(checked.places("EDS033"), [(4, 12)], "{text}");
        }
        if text.contains("both") {
            assert_eq!(value_of(&checked.group(0x2000).extensions, ";"), Some("both ways"), "{text}");
        }
    }
    let empty = read("[2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=\n");
    assert_eq!(empty.item(0x2000, 0).access, Access::ReadOnly);
    assert_eq!(empty.codes(), ["EDS034"]);
    assert_eq!(empty.places("EDS034"), [(4, 1)]);
}

#[test]
fn e49_no_access_and_no_data_type() {
    let checked = read("[2000]\nParameterName=Speed\nObjectType=7\nDataType=0x0005\n");
    assert_eq!(checked.item(0x2000, 0).access, Access::ReadOnly);
    assert_eq!(checked.codes(), ["EDS034"]);
    assert_eq!(checked.places("EDS034"), [(1, 2)]);
    for missing in ["", "DataType=\n"] {
        let checked =
            read(&format!("[2000]\nParameterName=Speed\nObjectType=7\nAccessType=rw\nDefaultValue=0x12\n{missing}"));
        let item = checked.item(0x2000, 0);
        assert_eq!((item.ty, item.access), (Type::Opaque(None), Access::ReadOnly), "kept read-only, whatever it says");
        assert_eq!(item.default, Some(raw("0x12")));
        assert_eq!(checked.codes(), ["EDS035"]);
        assert!(checked.rust().contains("ReadOnly<rt::Opaque>"), "{}", checked.rust());
    }
    let sub = read(
        "[2000]\nParameterName=Speeds\nObjectType=9\nSubNumber=1\n[2000sub0]\nParameterName=Count\nAccessType=ro\n",
    );
    assert_eq!(sub.item(0x2000, 0).ty, Type::Opaque(None));
    assert_eq!(sub.places("EDS035"), [(5, 2)]);
    assert_eq!(sub.codes(), ["EDS035"]);
}
