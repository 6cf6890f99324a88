//! X08 to X10, X19, X20, X22, X26, X29, X30: sync managers, PDOs, clocks, the mailbox.

use lexibus_codegen::ir::{Access, PdoEntryKind, SyncManagerPurpose, Type};

use crate::support::*;

#[test]
fn x08_indices_in_every_spelling() {
    for (text, index) in [("4339", 4339), ("#x10F3", 0x10F3), ("0x10f3", 0x10F3), ("04339", 4339)] {
        let checked = device(&tx_pdo("#x1A00", &entry(text, 1, 8, "USINT")));
        assert_eq!(checked.pdo(0x1A00).entries[0].index, index, "{text}");
        assert_eq!(checked.found(), NOTHING);
    }
    let sub = |text: &str| {
        let entry = entry("#x6000", 77, 8, "USINT").replace("<SubIndex>77", &format!("<SubIndex>{text}"));
        device(&tx_pdo("#x1A00", &entry))
    };
    for (text, expected) in [("#x0b", 11), ("11", 11), ("01", 1), ("", 0)] {
        let checked = sub(text);
        assert_eq!(checked.pdo(0x1A00).entries[0].sub_index, expected, "{text}");
        assert_eq!(checked.found(), NOTHING);
    }
    let bare = sub("2E");
    assert_eq!(bare.pdo(0x1A00).entries[0].sub_index, 0x2E);
    assert_eq!(bare.found(), ["ESI003 3:103"]);
    assert_eq!(bare.only("ESI003").fix.as_deref(), Some("#x2E"));
    let padding = device(&tx_pdo("#x1A00", "<Entry><Index>0</Index><BitLen>7</BitLen></Entry>"));
    assert_eq!(padding.found(), NOTHING);
}

#[test]
fn x09_padding_with_a_name_and_a_type() {
    let entries =
        format!("{}{}{}", entry("#x6000", 1, 3, "BIT3"), entry("0", 0, 5, "BIT5"), entry("#x6000", 2, 8, "USINT"));
    let checked = device(&tx_pdo("#x1A00", &entries));
    let pdo = checked.pdo(0x1A00);
    let all: Vec<_> = pdo.entries.iter().map(|entry| (entry.kind, entry.bit_offset, entry.bits)).collect();
    let (item, padding) = (PdoEntryKind::Item, PdoEntryKind::Padding);
    assert_eq!(all, [(item, 0, 3), (padding, 3, 5), (item, 8, 8)]);
    assert!(checked.device().object(0).is_none(), "padding is no object");
    assert_eq!(checked.found(), NOTHING);
}

#[test]
fn x10_entries_without_type_or_name() {
    let plain =
        |bits: u32| format!("<Entry><Index>#x6000</Index><SubIndex>1</SubIndex><BitLen>{bits}</BitLen></Entry>");
    for (bits, ty) in
        [(1, Type::Unsigned(1)), (16, Type::Unsigned(16)), (64, Type::Unsigned(64)), (65, Type::Opaque(None))]
    {
        let checked = device(&tx_pdo("#x1A00", &plain(bits)));
        assert_eq!(checked.pdo(0x1A00).entries[0].ty, ty);
        assert_eq!(checked.item(0x6000, 1).ty, ty);
        assert_eq!(checked.found(), NOTHING);
    }
    let no_index = device(&tx_pdo("#x1A00", "\n<Entry><BitLen>8</BitLen></Entry>"));
    assert_eq!(no_index.pdo(0x1A00).entries[0].kind, PdoEntryKind::Padding);
    assert_eq!(no_index.found(), ["ESI033 4:1"]);
}

#[test]
fn x19_sync_managers_with_other_texts() {
    let sm = |control: &str, text: &str| format!("<Sm StartAddress='#x1000' {control} Enable='1'>{text}</Sm>\n");
    let four = format!(
        "{}{}{}{}",
        sm("ControlByte='#x26'", "MBoxOut"),
        sm("ControlByte='#x22'", "MBoxIn"),
        sm("ControlByte='#x64'", "OrbitaOut"),
        sm("ControlByte='#x20'", "OrbitaIn")
    );
    let checked = device(&four);
    let managers = &checked.device().process_data.sync_managers;
    use SyncManagerPurpose::{Inputs, MailboxIn, MailboxOut, Outputs};
    let purposes: Vec<_> = managers.iter().map(|manager| manager.purpose).collect();
    assert_eq!(purposes, [MailboxOut, MailboxIn, Outputs, Inputs]);
    assert_eq!((managers[3].number, managers[3].label.as_str(), managers[3].enable), (3, "OrbitaIn", true));
    assert_eq!(checked.found(), ["ESI040 5:57", "ESI040 6:57"]);
    // Without a control byte the place decides.
    let bare = device("<Sm/><Sm/><Sm/><Sm/>");
    let purposes: Vec<_> = bare.device().process_data.sync_managers.iter().map(|manager| manager.purpose).collect();
    assert_eq!(purposes, [MailboxOut, MailboxIn, Outputs, Inputs]);
    assert_eq!(bare.found().len(), 4);
    let all = "<Sm MinSize='34' MaxSize='#x100' DefaultSize='128' OpOnly='1' Virtual='true' Watchdog='1'>Inputs</Sm>";
    let all = device(all);
    let manager = &all.device().process_data.sync_managers[0];
    assert_eq!((manager.default_size, manager.size_range), (Some(128), (Some(34), Some(256))));
    assert!(manager.op_only && manager.is_virtual && !manager.enable);
    assert_eq!(value_of(&all.device().extensions, "Sm@Watchdog"), Some("1"));
}

#[test]
fn x20_no_sync_manager() {
    let checked = read_text(&device_file(&tx_pdo("#x1A00", &entry("#x6000", 1, 8, "USINT"))).replace("'YY'", "'BB'"));
    assert!(checked.device().process_data.sync_managers.is_empty());
    assert_eq!((checked.settings().physics.as_str(), checked.pdo(0x1A00).sync_manager), ("BB", Some(3)));
    assert_eq!(checked.found(), NOTHING);
}

#[test]
fn x22_pdos_without_index_or_name_and_twice() {
    let unnamed = device("<RxPdo><Index>#x1600</Index><Name></Name></RxPdo>");
    assert_eq!(unnamed.found(), ["ESI043 3:1"]);
    let old =
        device("<RxPdo Ref='4' Chn='1'><Name>N</Name><Entry><Index>#x7000</Index><BitLen>1</BitLen></Entry></RxPdo>");
    let pdo = &old.device().process_data.pdos[0];
    assert_eq!((pdo.mapping_index, pdo.bits()), (0, 1));
    assert_eq!(
        (value_of(&pdo.extensions, "RxPdo@Ref"), value_of(&pdo.extensions, "RxPdo@Chn")),
        (Some("4"), Some("1"))
    );
    assert_eq!(old.found(), ["ESI041 3:1"]);
    let one = "<RxPdo Sm='0'><Index>#x1602</Index><Name>A</Name></RxPdo>\n";
    let twice = device(&format!("{one}{}", one.replace("Sm='0'", "Sm='1'")));
    let sms: Vec<_> = twice.device().process_data.pdos.iter().map(|pdo| pdo.sync_manager).collect();
    assert_eq!(sms, [Some(0), Some(1)]);
    assert_eq!(twice.found(), ["ESI042 4:1"]);
}

#[test]
fn x22_entries_of_objects_that_do_not_exist() {
    let object = var("#x6000", "UINT", "");
    let pdo = |index: &str, bits: u32| tx_pdo("#x1A00", &entry(index, 0, bits, "UINT"));
    let with = |pdo: &str| device(&format!("{}\n{pdo}", profile(&basic("UINT", 16), &object)));
    let known = with(&pdo("#x6000", 16));
    assert_eq!((known.pdo(0x1A00).entries[0].kind, known.found()), (PdoEntryKind::Item, vec![]));
    let missing = with(&pdo("#x6001", 16));
    assert_eq!(missing.found(), ["PDO001 6:65"]);
    // What is mapped is there, though nobody described it.
    let implied = missing.group(0x6001);
    assert_eq!(
        (implied.origin.line, implied.items[0].access, implied.items[0].mappable.tpdo),
        (0, Access::ReadOnly, true)
    );
    let long = with(&pdo("#x6000", 32));
    assert_eq!(long.found(), ["PDO005 6:65", "ESI044 6:159"]);
}

#[test]
fn x26_more_than_255_entries() {
    let entries: String =
        (0..300).map(|n| entry(&format!("#x{:04x}", 0x6000 + n / 200), (n % 200) as u8, 1, "BOOL")).collect();
    let checked = device(&tx_pdo("#x1A00", &format!("{entries}{}", entry("0", 0, 70_000, "BOOL"))));
    let pdo = checked.pdo(0x1A00);
    assert_eq!((pdo.entries.len(), pdo.bits()), (301, 70_300));
    assert_eq!(pdo.entries[299].bit_offset, 299);
    assert_eq!(checked.found(), NOTHING);
}

#[test]
fn x26_lengths_that_no_number_holds() {
    let entry = entry("#x6000", 1, u32::MAX, "BOOL");
    let checked = device(&tx_pdo("#x1A00", &entry.repeat(3)));
    let pdo = checked.pdo(0x1A00);
    assert_eq!((pdo.bits(), pdo.entries[2].bit_offset), (u32::MAX, u32::MAX));
}

#[test]
fn x29_single_bits_and_gaps() {
    let entries = [
        entry("#x6000", 1, 1, "BOOL"),
        "<Entry><Index>#x0</Index><BitLen>2</BitLen></Entry>".into(),
        entry("#x6000", 2, 5, "BIT5"),
        entry("#x6010", 0, 24, "UINT24"),
        entry("#x6020", 0, 12, "BIT12"),
    ];
    let checked = device(&tx_pdo("#x1A00", &entries.concat()));
    let places: Vec<_> = checked.pdo(0x1A00).entries.iter().map(|entry| (entry.bit_offset, entry.ty)).collect();
    let unsigned = Type::Unsigned;
    let expected =
        [(0, Type::Boolean), (1, Type::Opaque(None)), (3, unsigned(5)), (8, unsigned(24)), (32, unsigned(12))];
    assert_eq!(places, expected);
    assert_eq!(checked.pdo(0x1A00).bytes(), 6);
    assert_eq!(checked.found(), NOTHING);
}

#[test]
fn x30_assign_activate() {
    let mode = |value: &str| {
        format!(
            "<OpMode><Name>DC</Name><AssignActivate>{value}</AssignActivate><CycleTimeSync0 Factor='1'>0</CycleTimeSync0>\
             <ShiftTimeSync0 Input='1'>-100</ShiftTimeSync0><Sm No='2'><SyncType>2</SyncType><Pdo OSFac='4'>#x1A00</Pdo>\
             </Sm></OpMode>"
        )
    };
    let checked = device(&format!("<Dc UnknownFRMW='1'>{}{}</Dc>", mode("#x0300"), mode("768")));
    let clocks = checked.settings().clocks.as_ref().unwrap();
    assert_eq!(clocks.attributes, [("UnknownFRMW".into(), "1".into())]);
    for mode in &clocks.modes {
        assert_eq!(mode.assign_activate, 0x300);
        assert_eq!(
            (mode.cycle_sync0.factor, mode.shift_sync0.nanoseconds, mode.shift_sync0.input),
            (Some(1), -100, true)
        );
        assert_eq!((mode.sync_managers[0].number, mode.sync_managers[0].pdos[0]), (2, (0x1A00, Some(4))));
    }
    assert_eq!(checked.found(), NOTHING);
}

#[test]
fn all_that_a_pdo_says() {
    let checked = device(
        "<TxPdo Fixed='1' Mandatory='true' Virtual='0' Sm='3' Su='1' OSFac='2' OSMin='1' OSMax='8' OSIndexInc='16' \
         OverwrittenByModule='1' PdoOrder='2'><Index DependOnSlot='1' DependOnSlotGroup='true'>#x1A00</Index><Name>P</Name>\
         <Exclude>#x1A01</Exclude><Exclude>6658</Exclude><Entry Fixed='1'><Index DependOnSlot='1'>#x6000</Index>\
         <SubIndex>1</SubIndex><BitLen>16</BitLen><Name>E</Name><Comment>why</Comment>\
         <DataType DScale='+/-10' SwapData='Swap_HB_LB'>INT</DataType></Entry><ExcludedSm>2</ExcludedSm></TxPdo>",
    );
    let pdo = checked.pdo(0x1A00);
    assert!(pdo.fixed && pdo.mandatory && !pdo.is_virtual && pdo.overwritten_by_module);
    assert!(pdo.depends_on_slot && pdo.depends_on_slot_group && pdo.entries[0].fixed && pdo.entries[0].depends_on_slot);
    assert_eq!((pdo.sync_manager, pdo.sync_unit), (Some(3), Some(1)));
    assert_eq!((&pdo.excludes[..], &pdo.excluded_sync_managers[..]), (&[0x1A01, 0x1A02][..], &[2][..]));
    let oversampling = pdo.oversampling.as_ref().unwrap();
    assert_eq!((oversampling.factor, oversampling.index_increment), (Some(2), Some(16)));
    for (key, value) in [
        ("DataType@DScale", "+/-10"),
        ("DataType@SwapData", "Swap_HB_LB"),
        ("Entry/Comment", "why"),
        ("TxPdo@PdoOrder", "2"),
    ] {
        assert_eq!(value_of(&pdo.extensions, key), Some(value), "{key}");
    }
    // The object belongs to whatever module is in the slot.
    assert!(checked.device().object(0x6000).is_none());
    assert_eq!(checked.found(), ["PDO020 3:1"]);
}

#[test]
fn fmmus_sync_units_and_the_mailbox() {
    let checked = device(
        "<Fmmu OpOnly='1' Sm='2' Su='0'>Outputs</Fmmu><Fmmu>MBoxState</Fmmu><Su SeparateSu='1' FrameRepeatSupport='1'>U</Su>\
         <Mailbox DataLinkLayer='true'><CoE SdoInfo='1' PdoAssign='true' CompleteAccess='1' EdsFile='x.eds'>\
         <InitCmd Fixed='1' CompleteAccess='1'><Transition>PS</Transition><Transition>SO</Transition>\
         <Index DependOnSlot='1'>#x8000</Index><SubIndex>#x11</SubIndex><Data AdaptAutomatically='1'>01 02\n0A</Data>\
         <Comment>mode</Comment></InitCmd></CoE><EoE IP='1'/><SoE ChannelCount='2'><InitCmd Chn='1'>\
         <Transition>PS</Transition><IDN>32</IDN><Data>0B00</Data></InitCmd></SoE><FoE/></Mailbox>",
    );
    let settings = checked.settings();
    assert_eq!((settings.fmmus.len(), settings.fmmus[0].sync_manager, settings.fmmus[0].op_only), (2, Some(2), true));
    assert!(settings.sync_units[0].separate && settings.sync_units[0].frame_repeat);
    let mailbox = settings.mailbox.as_ref().unwrap();
    assert!(mailbox.data_link_layer && mailbox.foe.is_some() && mailbox.voe.is_none());
    let coe = mailbox.coe.as_ref().unwrap();
    assert!(coe.sdo_info && coe.pdo_assign && coe.complete_access && !coe.pdo_config);
    assert_eq!(coe.attributes, [("EdsFile".into(), "x.eds".into())]);
    let command = &coe.init_commands[0];
    assert_eq!((command.index, command.sub_index, &command.data[..]), (0x8000, 0x11, &[1, 2, 10][..]));
    assert_eq!(command.transitions, ["PS", "SO"]);
    assert!(command.fixed && command.complete_access && command.depends_on_slot && command.adapt);
    let soe = &mailbox.soe.as_ref().unwrap().init_commands[0];
    assert_eq!((soe.index, soe.sub_index, &soe.data[..]), (32, 1, &[11, 0][..]));
    assert_eq!(mailbox.eoe.as_ref().unwrap().attributes, [("IP".into(), "1".into())]);
    assert_eq!(checked.found(), NOTHING);
    let odd = device("<Mailbox><CoE><InitCmd><Transition>XX</Transition><Index>1</Index></InitCmd></CoE></Mailbox>");
    assert_eq!(odd.found(), ["ESI001 3:36"]);
}
