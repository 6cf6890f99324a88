//! X25, X28: modular devices, pictures, and what else a device says.

use std::fmt::Write;
use std::time::Instant;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Fit, ModuleId, Type};
use lexibus_codegen::source::Source;

use crate::support::*;

const MODULE: &str = "<Module><Type ModuleIdent='#x30' ModuleClass='Di' ModulePdoGroup='1'>DI4</Type><Name>4 inputs</Name>\
    <TxPdo Fixed='1' Sm='3'><Index DependOnSlot='1'>#x1A00</Index><Name>Inputs</Name>\
    <Entry><Index DependOnSlot='1'>#x6000</Index><SubIndex>1</SubIndex><BitLen>1</BitLen><Name>In 1</Name>\
    <DataType>BOOL</DataType></Entry></TxPdo>\
    <Mailbox><CoE SdoInfo='1'><InitCmd><Transition>PS</Transition><Index DependOnSlot='1'>#x8000</Index>\
    <SubIndex>1</SubIndex><Data>05</Data></InitCmd></CoE></Mailbox>\
    <Profile><ProfileNo>5001</ProfileNo><Dictionary><DataTypes><DataType><Name>FILTER</Name><BaseType>USINT</BaseType>\
    <BitSize>8</BitSize><EnumInfo><Text>Slow</Text><Enum>5</Enum></EnumInfo></DataType></DataTypes><Objects><Object>\
    <Index DependOnSlot='1'>#x8000</Index><Name>Filter</Name><Type>FILTER</Type><Flags><Access>rw</Access></Flags></Object>\
    </Objects></Dictionary></Profile></Module>";

fn coupler(slots: &str) -> Checked {
    read_text(&file(&format!(
        "<Devices><Device Physics='YK'><Type ProductCode='1'>K</Type>{slots}</Device></Devices><Modules>{MODULE}\
         <Module><Type ModuleIdent='49'>DO</Type><Name>Outputs</Name></Module></Modules>"
    )))
}

#[test]
fn x25_slots() {
    let checked = coupler(
        "<Slots MaxSlotCount='#x20' SlotIndexIncrement='#x10' SlotPdoIncrement='8' DownloadModuleIdentList='1'>\
         <Slot MinInstances='0' MaxInstances='4'><Name>Bay</Name><ModuleIdent Default='1'>#x30</ModuleIdent>\
         <ModuleIdent>49</ModuleIdent></Slot><Slot MinInstances='1' MaxInstances='1' SlotGroup='1' SlotIndexIncrement='64' \
         SlotPdoIncrement='0'><ModuleClass><Class>Di</Class></ModuleClass></Slot>\
         <SlotGroupData SlotGroup='1'><Name>Axis</Name></SlotGroupData>\
         <ModulePdoGroup Alignment='16' RxPdo='#x1700' TxPdo='#x1B00'/>\
         <SlotSelections><Name>Both</Name><ModuleIdent>48</ModuleIdent><ModuleIdent>49</ModuleIdent></SlotSelections></Slots>",
    );
    let [bay, axis] = &checked.device().slots[..] else { panic!("two slots") };
    assert_eq!((bay.number, bay.instances, bay.index_increment, bay.pdo_increment), (0, (0, 4), 0x10, 8));
    assert_eq!((axis.number, axis.group, axis.index_increment, axis.pdo_increment), (4, Some(1), 64, 0));
    assert_eq!(
        (&bay.fits[..], bay.default.as_ref()),
        (&[Fit::Ident(0x30), Fit::Ident(49)][..], Some(&Fit::Ident(0x30)))
    );
    assert_eq!(axis.fits[..], [Fit::Class("Di".into())]);
    let rules = checked.settings().slots.as_ref().unwrap();
    assert_eq!((rules.max_slots, rules.download_idents, rules.download_transition.as_str()), (Some(32), true, "PS"));
    assert_eq!((rules.pdo_groups[0].alignment, rules.pdo_groups[0].tx_pdo), (16, Some(0x1B00)));
    assert_eq!(rules.groups[..], [(1, "Axis".into())]);
    assert_eq!(rules.selections[..], [("Both".into(), vec![48, 49])]);
    let uses: Vec<_> = checked.device().modules.iter().map(|own| (own.module, own.places.allowed.0.to_vec())).collect();
    assert_eq!(uses, [(ModuleId(0), vec![(0, 4)]), (ModuleId(1), vec![(0, 3)])]);
    assert_eq!(checked.found(), NOTHING);
}

#[test]
fn x25_modules() {
    let checked = coupler("");
    let module = checked.module();
    assert_eq!((module.number, module.id.as_str(), module.class.as_str()), (0x30, "DI4", "Di"));
    assert_eq!((module.name.as_str(), module.pdo_group, &module.profiles[..]), ("4 inputs", Some(1), &[5001][..]));
    let pdo = &module.process_data.pdos[0];
    assert!(pdo.depends_on_slot && pdo.entries[0].depends_on_slot);
    assert_eq!(pdo.entries[0].ty, Type::Boolean);
    let command = &module.init_commands[0];
    assert_eq!((command.index, &command.data[..], command.depends_on_slot), (0x8000, &[5][..], true));
    // The one that is described, and the one that is mapped.
    let [inputs, filter] = &module.groups[..] else { panic!("two objects") };
    assert_eq!((inputs.index(), inputs.origin.line, inputs.depends_on_slot), (Some(0x6000), 0, true));
    assert_eq!((filter.index(), filter.depends_on_slot, module.types.len()), (Some(0x8000), true, 1));
    assert_eq!(value_of(&module.extensions, "CoE@SdoInfo"), Some("true"));
    assert!(checked.device().modules.is_empty(), "without slots nothing fits");
    assert_eq!(checked.found(), NOTHING);
}

#[test]
fn what_a_module_and_a_record_say_beside() {
    let mailbox =
        "<Mailbox DataLinkLayer='1'><CoE DiagHistory='1'/><SoE ChannelCount='2'><InitCmd><Transition>PS</Transition>\
                   <IDN>7</IDN><Data>0102</Data></InitCmd></SoE><FoE/></Mailbox>";
    let text = file(&format!("<Modules>{}</Modules>", MODULE.replace("</Module>", &format!("{mailbox}</Module>"))));
    let extensions = &read_text(&text).module().extensions.clone();
    for (key, value) in [
        ("Mailbox@DataLinkLayer", "true"),
        ("CoE@DiagHistory", "true"),
        ("SoE@ChannelCount", "2"),
        ("SoE/InitCmd", "PS: 7:0 = 0102"),
        ("Mailbox/FoE", "true"),
    ] {
        assert_eq!(value_of(extensions, key), Some(value), "{key}");
    }
    let record = format!("<DataType><Name>R</Name><BitSize>8</BitSize>{}</DataType>", sub_item(0, "N", "USINT", 8, 0));
    let object = "<Object><Index>#x2000</Index><Name>O</Name><Type>R</Type><BitSize>8</BitSize>\
                  <Info><DisplayName LcId='1031'>Ofen</DisplayName></Info></Object>";
    let checked = read_text(&device_file(&profile(&record, object)));
    assert_eq!(checked.device().groups[0].names[0].text, "Ofen");
}

#[test]
fn modules_that_do_not_fit_and_twice() {
    let none = coupler("\n<Slots><Slot MinInstances='0' MaxInstances='1'><ModuleIdent>7</ModuleIdent></Slot></Slots>");
    assert_eq!(none.found(), ["ESI051 2:10"]);
    let twice = read_text(&file(&format!("<Modules>{MODULE}\n{MODULE}<Module/></Modules>")));
    assert_eq!(twice.found(), ["ESI050 3:1", "ESI033 3:875"]);
}

#[test]
fn x28_pictures_and_large_files() {
    let picture = "424D E600\n0000".repeat(10);
    let checked = device(&format!("<ImageData16x14>{picture}</ImageData16x14>"));
    assert_eq!(value_of(&checked.device().extensions, "ImageData16x14"), Some("60 bytes"));
    let mut devices = String::new();
    for product in 0..400 {
        let objects: String = (0..40).map(|n| var(&format!("#x{:04x}", 0x2000 + n), "UINT", "")).collect();
        let _ = write!(devices, "<Device><Type ProductCode='{product}'>T</Type>{}</Device>", profile("", &objects));
    }
    let text = file(&format!("<Devices>{devices}</Devices>"));
    let start = Instant::now();
    let checked = read_text(&text);
    assert_eq!(checked.catalog().devices.len(), 400);
    assert!(start.elapsed().as_secs() < 60, "{} bytes took {:?}", text.len(), start.elapsed());
}

#[test]
fn small_files_do_not_grow() {
    // A long array, and very many objects of that type.
    let array =
        "<DataType><Name>A</Name><BaseType>USINT</BaseType><BitSize>2040</BitSize><ArrayInfo><LBound>1</LBound>\
                 <Elements>255</Elements></ArrayInfo></DataType>";
    let record = format!(
        "<DataType><Name>R</Name><BitSize>2048</BitSize>{}<SubItem><Name>E</Name><Type>A</Type><BitSize>2040</BitSize>\
         <BitOffs>8</BitOffs></SubItem></DataType>",
        sub_item(0, "N", "USINT", 8, 0)
    );
    let objects: String = (0..3000)
        .map(|n| format!("<Object><Index>{}</Index><Name>O</Name><Type>R</Type></Object>\n", 0x2000 + n))
        .collect();
    let text = device_file(&profile(&format!("{array}{record}"), &objects));
    let checked = Checked(check(Source::new("slave.xml", text.into_bytes()), &Options::default()));
    let items: usize = checked.device().groups.iter().map(|group| group.items.len()).sum();
    assert!(items <= lexibus_codegen::limits::MAX_DERIVED_ITEMS, "{items} items");
    assert_eq!(checked.only("IO003").notes.len(), 0);
}

#[test]
fn what_else_a_device_says() {
    let checked = device(
        "<Info><StateMachine><Timeout><PreopTimeout>2000</PreopTimeout></Timeout></StateMachine>\
         <Electrical><EBusCurrent>100</EBusCurrent></Electrical></Info><GroupType>Drives</GroupType>\
         <ESC><Reg0108>#x1</Reg0108><Reg0420>500</Reg0420></ESC>\
         <Eeprom AssignToPdi='1'><ByteSize>2048</ByteSize><ConfigData>050603</ConfigData><BootStrap>0010</BootStrap>\
         <Category><CatNo>30</CatNo><DataUINT>258</DataUINT></Category></Eeprom>\
         <Comment>Fast</Comment><URL LcId='1031'>http://x.de</URL>\
         <VendorSpecific><TwinCAT a='1'><Deep><Deeper>x</Deeper></Deep></TwinCAT><Note>y</Note></VendorSpecific>",
    );
    let settings = checked.settings();
    assert_eq!(settings.timeouts, [("PreopTimeout".into(), 2000)]);
    assert_eq!((settings.group.as_str(), &settings.registers[..]), ("Drives", &[(0x108, 1), (0x420, 500)][..]));
    let eeprom = settings.eeprom.as_ref().unwrap();
    assert_eq!((eeprom.byte_size, &eeprom.config_data[..], eeprom.assign_to_pdi), (Some(2048), &[5, 6, 3][..], true));
    assert_eq!(eeprom.categories, [(30, vec![2, 1])]);
    let device = checked.device();
    assert_eq!(device.documentation.as_ref().unwrap().text, "Fast");
    for (key, value) in [
        ("Electrical/EBusCurrent", "100"),
        ("VendorSpecific/TwinCAT@a", "1"),
        ("VendorSpecific/Note", "y"),
        ("Device/URL", "http://x.de"),
        ("Device/URL@LcId", "1031"),
    ] {
        assert_eq!(value_of(&device.extensions, key), Some(value), "{key}");
    }
    assert!(value_of(&device.extensions, "Deep/Deeper").is_none());
    assert_eq!(checked.found(), NOTHING);
}

#[test]
fn groups_are_families() {
    let checked = read_text(&file(
        "<Groups><Group SortOrder='5' ParentGroup='P'><Type>Drives</Type><Name LcId='1031'>Antriebe</Name>\
         <Name LcId='1033'>Drives</Name><Comment>c</Comment></Group></Groups>",
    ));
    let family = &checked.catalog().families[0];
    assert_eq!((family.id.as_str(), family.name.as_str()), ("Drives", "Drives"));
    assert_eq!((family.names[0].text.as_str(), family.descriptions[0].text.as_str()), ("Antriebe", "c"));
    assert_eq!(value_of(&checked.catalog().extensions, "Group@ParentGroup"), Some("P"));
}

#[test]
fn unknown_elements_are_kept() {
    let text = device_file("<Own x='1'>y<In>z</In></Own>\n<Name own='2'>Other</Name>");
    let checked = read_with(&text, &["esi-unknown-element"]);
    assert_eq!(checked.found(), ["ESI002 3:2", "ESI002 4:7"]);
    for (key, value) in [("Device/Own", "y"), ("Device/Own@x", "1"), ("Own/In", "z"), ("Name@own", "2")] {
        assert_eq!(value_of(&checked.device().extensions, key), Some(value), "{key}");
    }
}
