//! Section 4 of the notes on the Kollmorgen AKD's manual: each passage that contradicts itself, transcribed as it is printed, has
//! its finding at its row. The number in a test's name is that of the notes; `cite` has the manual's lines. `akd_items` is the
//! overview of all 48 items: those that are here, and those that only a doubt can tell.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Level;
use lexibus_codegen::source::Source;

const HEAD: &str = "lexibus = 1\n[device]\nname = \"AKD\"\nbuses = [\"ethercat\"]\n[defaults]\naccess = \"rw\"\n";
const REGISTERS: &str = "[[chapters]]\n[chapters.registers]\n";
const OBJECTS: &str = "[[chapters]]\n[chapters.objects]\n";

fn compile(text: &str, wanted: &[&str]) -> Compilation {
    let mut options = Options { no_profiles: true, ..Options::default() };
    // A fixture is no whole device.
    for code in ["missing-mandatory-object", "no-sub0"] {
        options.levels.set(code, Level::Allow).unwrap();
    }
    for code in wanted {
        options.levels.set(code, Level::Warn).unwrap();
    }
    check(Source::new("akd.toml", text.as_bytes().to_vec()), &options)
}

/// The findings about rows, exactly these: code, and how the text that is marked begins.
#[track_caller]
fn flags_with(wanted: &[&str], rows: &str, expected: &[(&str, &str)]) -> Compilation {
    let found = compile(&format!("{HEAD}{rows}"), wanted);
    let source = &found.sources[0];
    let list = found.diagnostics.list();
    let marked = |at: lexibus_codegen::source::Span| source.text().get(at.range()).unwrap_or_default();
    let shown: Vec<_> = list.iter().map(|own| (own.code.id, marked(own.span), &own.message)).collect();
    let begins = |(own, (code, at)): (&(&str, &str, &String), &(&str, &str))| own.0 == *code && own.1.starts_with(at);
    let same = shown.len() == expected.len() && shown.iter().zip(expected).all(begins);
    assert!(same, "expected {expected:#?}\nfound {shown:#?}");
    found
}

#[track_caller]
fn registers(rows: &str, expected: &[(&str, &str)]) -> Compilation {
    flags_with(&[], &format!("{REGISTERS}{rows}"), expected)
}

#[track_caller]
fn objects(rows: &str, expected: &[(&str, &str)]) -> Compilation {
    flags_with(&[], &format!("{OBJECTS}{rows}"), expected)
}

fn message(compilation: &Compilation, at: usize) -> &str {
    &compilation.diagnostics.list()[at].message
}

#[test]
fn item_01_an_access_that_is_none() {
    let rows = r#"Controllo_AL = { esc = 0x0120, length = 2, type = "u16", access = "senza", pdi = "ro", cite = 609 }
Stato_AL = { esc = 0x0130, length = 2, type = "u16", access = "ro", pdi = "senza", cite = 621 }
"#;
    registers(rows, &[("TAB004", r#""senza""#), ("TAB004", r#""senza""#)]);
}

#[test]
fn item_02_two_tables_with_another_access() {
    let rows = r#"Controllo_AL = { esc = 0x0120, length = 2, type = "u16", access = "rw", cite = 533, summary = { access = "wo", cite = 609 } }
"#;
    let found = registers(rows, &[("TAB021", r#""wo""#)]);
    assert!(message(&found, 0).contains("wo"), "{}", message(&found, 0));
}

/// The table of the interrupt enable register, with the printed bits of its reserved row.
const ENABLE: &str = r#"Registro = { esc = 0x0204, length = 2, type = "u16", bits = "Enable", cite = 536 }
[bits.Enable]
address = 0x204
[bits.Enable.at]
"0x204:0" = { name = "Evento di controllo AL", cite = 567 }
"0x204:1" = { reserved = 0, cite = 568 }
"0x204:2" = { name = "DC Sync0", cite = 569 }
"0x204:3" = { name = "DC Sync1", cite = 570 }
"0x204:4" = { name = "Modifica del registro", cite = 571 }
"0x204:5" = { name = "Evento di emulazione EEPROM", cite = 572 }
"0x204:3-7" = { reserved = 0, cite = 573 }
"#;

#[test]
fn item_04_reserved_bits_that_have_names() {
    let place = r#""0x204:3-7""#;
    let expected = [r#""0x204:3""#, r#""0x204:4""#, r#""0x204:5""#];
    let found = compile(&format!("{HEAD}{REGISTERS}{ENABLE}"), &[]);
    let overlaps = found.diagnostics.list().iter().filter(|own| own.code.id == "TAB014").count();
    assert_eq!((overlaps, found.diagnostics.list().len()), (expected.len(), expected.len()), "{place}");
    let corrected = ENABLE.replace("0x204:3-7", "0x204:7-6");
    registers(&corrected, &[]);
}

#[test]
fn items_05_06_bytes_outside_of_the_register() {
    let rows = r#"Evento_AL = { esc = 0x0220, length = 2, type = "u16", bits = "Event", cite = 537 }
[bits.Event]
address = 0x220
[bits.Event.at]
"0x221:0" = { name = "Evento SyncManager 0", cite = 591 }
"0x221:1" = { name = "Evento SyncManager 1", cite = 592 }
"0x201:2" = { name = "Evento SyncManager 2", cite = 593 }
"0x201:3" = { name = "Evento SyncManager 3", cite = 594 }
"0x221:4-7" = { reserved = 0, cite = 596 }
"0x222:0..7" = { reserved = 0, cite = 598 }
"#;
    let expected = [("TAB013", r#""0x201:2""#), ("TAB013", r#""0x201:3""#), ("TAB013", r#""0x222:0..7""#)];
    let found = registers(rows, &expected);
    assert_eq!(message(&found, 0), "the byte 0x0201 lies outside of UNSIGNED16 at 0x0220");
}

#[test]
fn item_06_a_length_that_is_not_that_of_the_type() {
    let rows = r#"Evento_AL = { esc = 0x0220, length = 2, type = "u24", cite = [537, 598] }
"#;
    registers(rows, &[("TAB020", r#""u24""#)]);
}

#[test]
fn item_08_a_bit_without_a_row() {
    let rows = r#"Evento_AL = { esc = 0x0220, length = 1, type = "u8", bits = "Event", cite = 537 }
[bits.Event.at]
0 = { name = "Evento di controllo AL", cite = 585 }
2 = { name = "DC Sync0", cite = 586 }
"7-3" = { reserved = 0, cite = 590 }
"#;
    flags_with(&["unnamed-bits"], &format!("{REGISTERS}{rows}"), &[("TAB036", "Event")]);
}

#[test]
fn item_13_a_command_that_is_two_others_as_well() {
    let rows = r#"0x6040 = { name = "Parola di controllo", type = "u16", cite = 984 }
0x6041 = { name = "Parola di stato", type = "u16", access = "ro", cite = 994 }
[machines.drive]
status = "Parola di stato"
control = "Parola di controllo"
[machines.drive.commands]
Accensione = { mask = 0x07, value = 0x07, cite = 697 }
Disabilitazione = { mask = 0x0F, value = 0x07, cite = 700 }
Abilitazione = { mask = 0x0F, value = 0x0F, cite = 701 }
"#;
    let expected = [("TAB029", "Disabilitazione"), ("TAB029", "Abilitazione")];
    flags_with(&["commands-overlap"], &format!("{OBJECTS}{rows}"), &expected);
}

#[test]
fn item_16_a_mode_without_a_meaning_of_bit_4() {
    let rows = r#"0x6040 = { name = "Parola di controllo", type = "u16", bits = "Control", cite = 984 }
0x6060 = { name = "Modalità", type = "i8", enum = { 1 = "pp", 3 = "pv", 6 = "hm", 7 = "ip" }, cite = 708 }
[bits.Control.at]
4 = [ { name = "new_setpoint", when = { "Modalità" = [1] }, cite = 711 }, { reserved = "keep", when = { "Modalità" = [3] }, cite = 712 }, { name = "homing_operation_start", when = { "Modalità" = [6] }, cite = 714 } ]
"#;
    let found = compile(&format!("{HEAD}{OBJECTS}{rows}"), &[]);
    let codes: Vec<_> = found.diagnostics.list().iter().map(|own| own.code.id).collect();
    assert_eq!(codes, ["TAB037"]);
}

#[test]
fn item_17_an_object_that_is_no_index() {
    let rows = r#""20subindex" = { name = "Avvertenze del produttore", type = "u32", cite = 758 }
"#;
    objects(rows, &[("TAB006", r#""20subindex""#)]);
}

#[test]
fn item_19_two_modes_with_the_same_parameters() {
    let rows = r#"[codes.modes]
columns = ["DRV.OPMODE", "DRV.CMDSOURCE"]
distinct = true
[codes.modes.rows]
3 = { name = "Velocità del profilo", cells = [2, 1], cite = 1006 }
7 = { name = "Posizione interpolata", cells = [2, 1], cite = 1007 }
6 = { name = "Ritorno al punto di partenza", cells = [2, 0], cite = 1008 }
"#;
    let found = flags_with(&[], rows, &[("TAB045", "7")]);
    assert_eq!(message(&found, 0), "the codes 3 and 7 have the same cells");
    flags_with(&[], &rows.replace("distinct = true\n", ""), &[]);
}

/// Assignment objects, and a mapping that the example assigns.
const ASSIGNMENTS: &str = r#"0x1C12 = { name = "RxPDO assign", code = "array" }
"0x1C12:1" = { name = "RxPDO 1", type = "u16" }
0x1C13 = { name = "TxPDO assign", code = "array" }
"0x1C13:1" = { name = "TxPDO 1", type = "u16" }
0x1A00 = { name = "TxPDO mapping", code = "record" }
"0x1A00:0" = { name = "Entries", type = "u8" }
"0x1A00:1" = { name = "Entry 1", type = "u32" }
0x6041 = { name = "Parola di stato", type = "u16", access = "ro", pdo = "tx", cite = 994 }
[[pdos]]
index = 0x1B01
direction = "tx"
entries = ["0x6041:0/16"]
fixed = true
"#;

#[test]
fn item_22_a_pdo_that_is_assigned_and_never_described() {
    let rows = format!(
        "{ASSIGNMENTS}[procedures.example]\ncite = 1223\nsteps = [{{ write = \"0x1C12:1\", value = 0x1704 }}]\n"
    );
    let found = objects(&rows, &[("TAB034", "{ write = \"0x1C12:1\"")]);
    assert_eq!(message(&found, 0), "the PDO 0x1704 is assigned, and isn't described");
}

#[test]
fn item_26_an_object_of_32_bits_in_two_bytes() {
    let rows = r#"0x60FE = { name = "Uscite digitali", code = "record", cite = 987 }
"0x60FE:1" = { name = "Uscite", type = "u32", pdo = "rx", cite = 987 }
[[pdos]]
index = 0x1720
direction = "rx"
entries = ["0x60FE:1/16"]
cite = 781
"#;
    objects(rows, &[("PDO005", "\"0x60FE:1/16\"")]);
    // The doubt takes it upon the PDO.
    objects(&rows.replace("cite = 781", "allow = [\"mapped-length\"]"), &[]);
}

#[test]
fn item_29_a_mapping_that_is_not_assigned() {
    let rows = format!(
        "{ASSIGNMENTS}[procedures.start_up]\ncite = \"926-943\"\nsteps = [\n    {{ write = \"0x1A00:1\", value = 0x60410010 }},\n    \
         {{ write = \"0x1C13:1\", value = 0x1B01 }},\n]\n"
    );
    let found = objects(&rows, &[("TAB035", "{ write = \"0x1A00:1\"")]);
    assert_eq!(message(&found, 0), "`start_up` maps 0x1A00, and assigns other PDOs");
    objects(&rows.replace("0x1B01 }", "0x1A00 }"), &[]);
}

#[test]
fn item_33_indices_without_a_prefix() {
    let rows = r#"2050 = { name = "Seconda retroazione di posizione", type = "i32", access = "ro", cite = 995 }
"20a0" = { name = "Fronte positivo della posizione di blocco", type = "i32", access = "ro", cite = 998 }
"60FD" = { name = "Ingressi digitali", type = "u32", access = "ro", cite = 996 }
"#;
    let found = objects(rows, &[("TAB012", "2050"), ("TAB006", "\"20a0\""), ("TAB006", "\"60FD\"")]);
    assert_eq!(message(&found, 0), "the index `2050` is decimal: 0x0802");
}

#[test]
fn item_34_an_index_in_a_byte() {
    let rows = r#"0x1C12 = { name = "RxPDO assign", code = "array" }
"0x1C12:1" = { name = "RxPDO 1", type = "u8" }
[[pdos]]
index = 0x1701
direction = "rx"
entries = ["pad/8"]
[procedures.fixed]
cite = "772-774"
steps = [{ write = "0x1C12:1", value = 0x1701 }]
"#;
    objects(rows, &[("TAB033", "{ write = \"0x1C12:1\"")]);
}

#[test]
fn items_40_41_a_bit_that_is_left_out() {
    let rows = r#"0x20A5 = { name = "Stato del blocco", type = "u16", access = "ro", bits = "Latch", cite = 1000 }
[bits.Latch.at]
"3-0" = { name = "valido", number = true, cite = "1090-1093" }
"7-5" = { reserved = "keep", cite = 1095 }
"11-8" = { name = "acquisizione", number = true, cite = "1096-1099" }
"15-12" = { name = "ingressi", number = true, cite = "1100-1103" }
"#;
    flags_with(&["unnamed-bits"], &format!("{OBJECTS}{rows}"), &[("TAB036", "Latch")]);
}

/// The frames of the mailbox; the examples are put behind.
const MAILBOX: &str = r#"[bits.Header.at]
"8-0" = { name = "Numero PDO", number = true }
"11-9" = { reserved = 0 }
"15-12" = { name = "Tipo", values = { 1 = "messaggio di emergenza", 2 = "richiesta SDO", 3 = "risposta SDO" } }
[enums.Command.values]
0x2B = "scrittura di 2 byte"
0x40 = "lettura"
[enums.Result.values]
0x60 = "scrittura OK"
0x80 = "errore"
[[messages]]
name = "SDO"
request = [
    { field = "length", type = "u16", order = "BA", counts = "header" },
    { pad = 3 },
    { bytes = [0x03] },
    { field = "header", type = "u16", order = "BA", bits = "Header", fixed = 0x2000 },
    { field = "command", type = "u8", enum = "Command" },
    { field = "index", type = "u16", order = "BA" },
    { field = "sub index", type = "u8" },
    { field = "data", type = "u32", order = "DCBA" },
]
reply = [
    { field = "length", type = "u16", order = "BA", counts = "header" },
    { pad = 3 },
    { bytes = [0x03] },
    { field = "header", type = "u16", order = "BA", bits = "Header", fixed = 0x3000 },
    { field = "result", type = "u8", enum = "Result" },
    { echo = "index" },
    { echo = "sub index" },
    { field = "data", type = "u32", order = "DCBA" },
]
"#;
const REQUEST: &str = "0x0A, 0x00, 0x00, 0x00, 0x00, 0x03, 0x00, 0x20, 0x2B, 0x12, 0x1C, 0x01, 0x04, 0x17, 0x00, 0x00";

#[track_caller]
fn mailbox(request: &str, reply: &str) -> Vec<String> {
    let rows = format!("{HEAD}{MAILBOX}examples = [{{ request = [{request}], reply = [{reply}] }}]\n");
    let found = compile(&rows, &[]);
    let list = found.diagnostics.list();
    assert!(list.iter().all(|own| own.code.id == "TAB044"), "{list:#?}");
    list.iter().map(|own| own.message.clone()).collect()
}

#[test]
fn items_45_46_the_reply_of_the_mailbox() {
    let printed = "0x0E, 0x00, 0x00, 0x00, 0x00, 0x03, 0x00, 0x20, 0x60, 0x12, 0x1C, 0x01, 0x00, 0x00, 0x00, 0x00";
    let expected = [
        "`SDO`: the reply has 14 for `length`, and 10 bytes are counted",
        "`SDO`: the reply has 0x2000 for `header`, which is always 0x3000",
    ];
    assert_eq!(mailbox(REQUEST, printed), expected);
    let corrected = printed.replacen("0x0E", "0x0A", 1).replacen("0x20,", "0x30,", 1);
    assert_eq!(mailbox(REQUEST, &corrected), [""; 0]);
}

#[test]
fn what_else_an_example_can_have_wrong() {
    let reply = "0x0A, 0x00, 0x00, 0x00, 0x00, 0x03, 0x00, 0x30, 0x60, 0x12, 0x1C, 0x01, 0x00, 0x00, 0x00, 0x00";
    let one = |from: &str, to: &str| mailbox(REQUEST, &reply.replacen(from, to, 1));
    assert_eq!(one("0x12", "0x13"), ["`SDO`: the reply has 13 1C for `index`, and 12 1C was sent"]);
    assert_eq!(one("0x60", "0x61"), ["`SDO`: the reply has 0x61 for `result`, which has no name"]);
    assert_eq!(one("0x03", "0x02"), ["`SDO`: the reply has 02 for 03"]);
    assert_eq!(
        mailbox(REQUEST, &reply[..reply.len() - 6]).len(),
        2,
        "fewer bytes than fields, and than the length says"
    );
    assert_eq!(
        mailbox(REQUEST, &format!("{reply}, 0x00")).len(),
        2,
        "more bytes than fields, and than the length says"
    );
    let request = REQUEST.replacen("0x20", "0x22", 1);
    let expected = [
        "`SDO`: the request has 0x2200 for `header`, which is always 0x2000",
        "`SDO`: the request sets reserved bits of `header` to 0x1",
    ];
    assert_eq!(mailbox(&request, reply), expected);
}

#[test]
fn lengths_count_from_fields_that_there_are() {
    let found = compile(&format!("{HEAD}{}", MAILBOX.replacen("counts = \"header\"", "counts = \"heder\"", 1)), &[]);
    let list = found.diagnostics.list();
    assert_eq!(list.iter().map(|own| own.code.id).collect::<Vec<_>>(), ["TAB005"]);
    assert_eq!(list[0].help.as_deref(), Some("did you mean `header`?"));
}

#[test]
fn item_48_a_buffer_of_another_length_than_its_frames() {
    let rows = r#"Buffer = { esc = 0x1800, length = 512, type = "bytes(16)", cite = [549, 1125] }
"#;
    registers(rows, &[("TAB020", r#""bytes(16)""#)]);
}

#[test]
fn lengths_of_pdos_that_the_manual_and_its_tool_print() {
    let rows = r#"0x6041 = { name = "Parola di stato", type = "u16", access = "ro", pdo = "tx" }
[[pdos]]
index = 0x1B01
direction = "tx"
entries = ["? Valore effettivo di posizione/32", "0x6041:0/16"]
length = [6, 8]
[[pdos]]
index = 0x1A00
direction = "tx"
entries = ["? a/32", "? b/32", "0x6041:0/16"]
max = 8
[[pdos]]
index = 0x1A01
direction = "tx"
entries = ["? /16", "? c"]
"#;
    let expected = [("TAB020", "[6, 8]"), ("PDO004", "[[pdos]]"), ("TAB006", "\"? /16\""), ("TAB006", "\"? c\"")];
    let found = objects(rows, &expected);
    assert_eq!(message(&found, 0), "the PDO 0x1B01 is printed with 8 bytes, and its entries have 48 bits");
}

#[test]
fn mistakes_in_what_is_said_of_ethercat() {
    let rows = r#"[ethercat]
coe = true
[[ethercat.sync_managers]]
number = 2
purpose = "output"
start = 0x1100
[[ethercat.sync_managers]]
number = 3
purpose = "inputs"
start = 0x1140
size = 70
max = 64
[[ethercat.sync_managers]]
number = 3
purpose = "inputs"
start = 0x1140
[[chapters]]
[chapters.registers]
speed = { ascii = "V", type = "u16", pdi = "ro" }
[bits.B.at]
"0x220:1" = "a"
"#;
    let found = compile(&format!("{HEAD}{rows}"), &[]);
    let codes: Vec<_> = found.diagnostics.list().iter().map(|own| (own.code.id, own.message.as_str())).collect();
    let expected = [
        ("TAB004", "a sync manager has a `number`, a `start` and a `purpose`"),
        ("TAB004", "`output` is no purpose"),
        ("TAB004", "the sync manager 3 is longer by default than it can be"),
        ("TAB007", "there are two sync managers with the number 3"),
        ("TAB004", "`pdi` is about the memory of a slave controller, and the row has no address there"),
        ("TAB006", "`0x220:1` are no bits of a byte"),
    ];
    assert_eq!(codes, expected);
    let elsewhere = rows.replace("coe = true", "");
    let found = compile(&format!("{}{elsewhere}", HEAD.replace("ethercat", "canopen")), &[]);
    assert!(found.diagnostics.list().iter().any(|own| own.message == "the device isn't on EtherCAT"));
}
