//! Section 4 of the notes on the AEC Vector Step's manual: each passage that contradicts itself, transcribed as it is printed,
//! has its finding at its row. The number in a test's name is that of the notes; `cite` has the manual's lines. `manual_items` is
//! the overview of all 60 items: those that are here, in `lints_table` and in `import`, and those that only a doubt can tell.

#[path = "table_support/heads.rs"]
mod heads;

use heads::*;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Level;
use lexibus_codegen::source::Source;

fn compile(text: &str) -> Compilation {
    let mut options = Options { no_profiles: true, ..Options::default() };
    // A fixture is no whole device.
    options.levels.set("missing-mandatory-object", Level::Allow).unwrap();
    options.levels.set("half-a-pdo", Level::Allow).unwrap();
    check(Source::new("table.toml", text.as_bytes().to_vec()), &options)
}

/// A finding: code, line (counted from the first row) and the text that is marked.
type Found<'a> = (&'a str, u32, &'a str);

/// The findings: exactly these, in the order of the text.
#[track_caller]
fn flags(head: &str, rows: &str, expected: &[Found<'_>]) -> Compilation {
    let found = compile(&format!("{head}{rows}"));
    let source = &found.sources[0];
    let above = head.lines().count() as u32;
    let own = |at: lexibus_codegen::source::Span| {
        let marked = source.text().get(at.range()).unwrap_or_default();
        (source.position(at.start).line.saturating_sub(above), marked.lines().next().unwrap_or_default().trim_end())
    };
    let list = found.diagnostics.list();
    let shown: Vec<_> = list.iter().map(|found| (found.code.id, own(found.span).0, own(found.span).1)).collect();
    let said: Vec<_> = list.iter().map(|found| &found.message).collect();
    assert_eq!(shown, expected, "\n{said:#?}");
    found
}

#[track_caller]
fn registers(rows: &str, expected: &[Found<'_>]) -> Compilation {
    flags(REGISTERS, rows, expected)
}

#[track_caller]
fn objects(rows: &str, expected: &[Found<'_>]) -> Compilation {
    flags(&format!("{DEVICE}{OBJECTS}"), rows, expected)
}

/// The same of a CANopen device.
#[track_caller]
fn canopen(rows: &str, expected: &[Found<'_>]) -> Compilation {
    flags(&format!("{CANOPEN}{OBJECTS}"), rows, expected)
}

/// The boxes of a receive PDO (L954-1044), of which the procedure speaks, and what it maps.
const RPDO: &str = r#"0x1401 = { name = "RxPDO2 parameter", code = "record", cite = 954 }
"0x1401:0" = { name = "number_of_entries", type = "u8", access = "ro", min = 0x02, max = 0x02, default = 0x02 }
"0x1401:1" = { name = "RxPDO COB-ID", type = "u32", access = "rw", default = "$NODEID+0x300", cite = 971 }
"0x1401:2" = { name = "Transmission_type", type = "u8", access = "rw", default = 0xFE }
0x1601 = { name = "RxPDO2 mapping", code = "record", cite = 1026 }
"0x1601:0" = { name = "number_of_entries", type = "u8", access = "ro", min = 0x00, max = 0x08, cite = 1037 }
"0x1601:1..8" = { name = "PDO mapping {sub}", type = "u32", access = "rw", min = 0x00000000, max = 0xFFFFFFFF, cite = 1040 }
0x1800 = { name = "TxPDO1 parameter", code = "record", cite = 1064, allow = ["EDS058"] }
"0x1800:1" = { name = "TxPDO COB-ID", type = "u32", access = "rw", default = "$NODEID+0x180", cite = 1081 }
0x6040 = { name = "Controlword", type = "u16", access = "rw", pdo = "rx" }
0x6041 = { name = "Statusword", type = "u16", access = "ro", pdo = "tx" }
0x6060 = { name = "Modes of operation", type = "i8", access = "rw", pdo = "rx" }
"#;

#[test]
fn items_01_04_05_the_mapping_procedure() {
    let rows = format!(
        r#"{RPDO}[procedures.mapping]
cite = "557-560"
steps = [
    {{ write = "0x1601:0", value = 0 }},
    {{ write = "0x1401:1", value = 0x181 }},
    {{ write = "0x1401:2", value = 0xFE }},
    {{ write = "0x1601:1", value = 0x604000010 }},
    {{ write = "0x1601:2", value = 0x60600008 }},
    {{ write = "0x1601:0", value = 0x02 }},
]
"#
    );
    let expected = [
        ("TAB033", 16, r#"{ write = "0x1601:0", value = 0 }"#),
        ("TAB033", 17, r#"{ write = "0x1401:1", value = 0x181 }"#),
        ("TAB033", 19, r#"{ write = "0x1601:1", value = 0x604000010 }"#),
        ("TAB033", 21, r#"{ write = "0x1601:0", value = 0x02 }"#),
    ];
    let found = objects(&rows, &expected);
    assert_eq!(message(&found, 0), "`mapping`: writes `0x1601:0`, which is ro");
    assert_eq!(message(&found, 1), "`mapping` gives 0x1401 the COB-ID 0x181, which is that of 0x1800");
    assert_eq!(message(&found, 2), "`mapping`: writes 0x604000010 to `0x1601:1`, which is UNSIGNED32");
}

#[test]
fn item_01_nine_digits_of_a_default() {
    let rows = r#"0x1600 = { name = "RxPDO1 mapping", code = "record", cite = 1026, allow = ["EDS058"] }
"0x1600:1" = { name = "PDO mapping 1", type = "u32", access = "rw", default = 0x604000010, cite = 559 }
"#;
    let found = objects(rows, &[("TAB012", 2, "0x604000010"), ("EDS025", 2, "0x604000010")]);
    assert_eq!(message(&found, 0), "`0x604000010` has 9 digits, and UNSIGNED32 has 8");
}

#[test]
fn what_a_procedure_maps_is_held_against_the_objects() {
    let rows = format!(
        r#"{}[procedures.mapping]
steps = [
    {{ write = "0x1601:0", value = 0 }},
    {{ write = "0x1601:1", value = 0x60400008 }},
    {{ write = "0x1601:2", value = 0x60690020 }},
    {{ write = "0x1601:3", value = 0x60410010 }},
    {{ write = "0x1601:4", value = 0x60600008 }},
    {{ write = "0x1601:5", value = 0x00050008 }},
    {{ write = "0x1601:0", value = 9 }},
]
"#,
        RPDO.replace(r#"access = "ro", min = 0x00, max = 0x08"#, r#"access = "rw""#)
    );
    let expected = [
        ("PDO005", 16, r#"{ write = "0x1601:1", value = 0x60400008 }"#),
        ("PDO001", 17, r#"{ write = "0x1601:2", value = 0x60690020 }"#),
        ("PDO003", 18, r#"{ write = "0x1601:3", value = 0x60410010 }"#),
        ("TAB033", 21, r#"{ write = "0x1601:0", value = 9 }"#),
        ("PDO004", 21, r#"{ write = "0x1601:0", value = 9 }"#),
    ];
    let found = objects(&rows, &expected);
    assert_eq!(message(&found, 2), "0x6041 sub-index 0x0 is ro and can't be mapped into an RPDO");
    assert_eq!(message(&found, 3), "`mapping`: writes 9 as the number of entries of 0x1601, which has 8");
}

#[test]
fn what_mapping_objects_map_without_canopen() {
    let rows = r#"0x1600 = { name = "RxPDO1 mapping", code = "record" }
"0x1600:0" = { name = "number_of_entries", type = "u8", access = "rw", default = 2 }
"0x1600:1" = { name = "entry 1", type = "u32", access = "rw", default = 0x60410008 }
"0x1600:2" = { name = "entry 2", type = "u32", access = "rw", default = 0x60990110 }
"0x1600:3" = { name = "entry 3", type = "u32", access = "rw", default = 0x60990110 }
0x6041 = { name = "Statusword", type = "u16", access = "ro", pdo = "tx" }
"#;
    let expected = [("PDO005", 3, "0x60410008"), ("PDO003", 3, "0x60410008"), ("PDO001", 4, "0x60990110")];
    objects(rows, &expected);
    let ethercat = CANOPEN.replace("canopen", "ethercat") + OBJECTS;
    flags(&ethercat, rows, &expected);
}

#[test]
fn item_22_a_number_of_two_registers() {
    let rows = r#"Rhwconfig = { reg = 278, type = "u16", until = "6.15", replaced_by = "10034-35", cite = 2173 }
Rencabsmode = { reg = 10034, type = "u16", cite = 2577 }
Rencabsctrl = { reg = 10035, type = "u16", cite = 2578 }
"#;
    let found = registers(rows, &[("TAB005", 1, r#""10034-35""#)]);
    assert_eq!(message(&found, 0), "registers 10034-35 are not one item, but `Rencabsmode`, `Rencabsctrl`");
}

#[test]
fn numbers_where_names_are_wanted() {
    let rows = r#"Rposwrtime = { reg = 258, type = "u16" }
Rold = { reg = 1, type = "u16", until = "6", replaced_by = "258" }
Rolder = { reg = 2, type = "u16", until = "6", replaced_by = "10015" }
Rlong = { reg = "63-64", type = "u32", same_as = "64" }
"#;
    let found = registers(rows, &[("TAB005", 2, r#""258""#), ("TAB005", 3, r#""10015""#), ("TAB005", 4, r#""64""#)]);
    assert_eq!(message(&found, 0), "register 258 is `Rposwrtime`, and its name is wanted");
    assert_eq!(help(&found, 0), "write `Rposwrtime`");
    assert_eq!(message(&found, 1), "there is no register 10015");
    assert_eq!(message(&found, 2), "register 64 is `Rlong`, and its name is wanted");
    let rows = r#"Rposwrtime = { reg = "258-59", type = "u32", doc = "Da firmware 6 sostituito da registro 10015; see register 259." }
"#;
    let found = registers(rows, &[("TAB025", 1, rows.trim_end())]);
    assert_eq!(message(&found, 0), "register 10015 is mentioned, and the table doesn't have it");
}

#[test]
fn item_29_names_spelled_otherwise_where_they_are_used() {
    let rows = r#"doc = """Dopo il tempo impostato nel registro Rposwrntime, viene attivato il bit 3 del registro Rwarning (L2344).
Rmaskvrn (b3): disattiva la segnalazione nel registro Rwarning (L2388). Rflwtemp: errore inseguimento massimo (L2402)."""
[chapters.registers]
Rposwrtime = { reg = 258, type = "u16", unit = "ms", min = 0, max = 32000, cite = 2306 }
Rflwvrn = { reg = "253-254", type = "u32", min = 0, max = 32000, cite = 2301 }
Rflwmemp = { reg = 266, type = "u16", min = 0, max = 65535, cite = 2310 }
Rextencotovel = { reg = 89, type = "u16", cite = 2529 }
Rmodelantaios = { reg = 10142, type = "u16", cite = 2869 }
Rwarning = { reg = 228, type = "u16", cite = 2276, bits = { 3 = { name = "Errore di posizione", doc = "per tempo Rposwrntime con velocita' richiesta = 0" }, 4 = { name = "Errore di inseguimento", doc = "maggiore di Rflwrrn" } } }
Rmaskwrn = { reg = 257, type = "u16", cite = 2305, bits = { 3 = { name = "Errore di posizione", doc = "per tempo Rposwrtime" }, 4 = { name = "Errore di inseguimento", doc = "maggiore di Rflwwrn" } } }
Rwarning32 = { reg = "561-62", type = "u32", cite = 2317, bits = { 4 = { name = "Errore di inseguimento", doc = "maggiore di Rflwwrn" } } }
Rstsflg1 = { reg = 200, type = "u16", cite = 2163, bits = { 13 = "Registro aggiornato", 14 = "Registro Rextencvtopvel aggiornato" } }
Rloadsav = { reg = 194, type = "u16", cite = 2597, orig = "Salva Rmodelanatios" }
"#;
    let head = REGISTERS.replace("[chapters.registers]\n", "");
    let expected = [
        ("TAB025", 0, "[[chapters]]"),
        ("TAB025", 0, "[[chapters]]"),
        ("TAB025", 0, "[[chapters]]"),
        ("TAB025", 9, "Rwarning"),
        ("TAB025", 9, "Rwarning"),
        ("TAB025", 10, "Rmaskwrn"),
        ("TAB025", 11, "Rwarning32"),
        ("TAB025", 12, "Rstsflg1"),
        ("TAB025", 13, r#"Rloadsav = { reg = 194, type = "u16", cite = 2597, orig = "Salva Rmodelanatios" }"#),
    ];
    let found = flags(&head, rows, &expected);
    let meant: Vec<&str> = (0..9).map(|at| help(&found, at).split('`').nth(1).unwrap_or_default()).collect();
    let names = ["Rposwrtime", "Rmaskwrn", "Rflwmemp", "Rposwrtime", "Rflwvrn", "Rflwvrn", "Rflwvrn", "Rextencotovel"];
    assert_eq!(meant, [names.as_slice(), &["Rmodelantaios"]].concat());
    let said = "`Rposwrntime` is mentioned in `Errore di posizione`, and no item is called so";
    assert_eq!((message(&found, 3), help(&found, 3)), (said, "did you mean `Rposwrtime`?"));
}

#[test]
fn words_that_are_no_names() {
    let rows = r#"Rposact = { reg = 1, type = "i16", doc = "Reset, Rotor and Position; Rposreq and Rdefinpx are told" }
Rposreq = { reg = 2, type = "i16", doc = "Posact, Rposrez5 or RPOSACT" }
Rdefinp0 = { reg = 3, type = "i16", doc = "Rdefinp1, Rdefinp, Rposacts" }
Rdefinp2 = { reg = 4, type = "i16" }
"#;
    registers(rows, &[]);
    // Without a letter in front of all of them, names are words like others.
    let rows = r#"Speed = { reg = 1, type = "i16", doc = "Speeds of the Spindle" }
Spindles = { reg = 2, type = "i16" }
target_speed = { reg = 3, type = "i16", doc = "the traget_speed" }
"#;
    registers(rows, &[("TAB025", 3, "target_speed = { reg = 3, type = \"i16\", doc = \"the traget_speed\" }")]);
}

#[test]
fn item_24_rows_without_a_name_and_one_with_its_description() {
    let rows = r#"Rstsprg = { reg = 204, type = "u16", cite = 3196 }
"Rprgrunmode Run mode User Programmare 0 = Stop 1 = Single step 2 = Run" = { reg = 205, type = "u16", min = 0, max = 2, cite = 3197 }
"" = { reg = "2011-6998", type = "u16[4988]", cite = 3216 }
[[chapters]]
[chapters.registers]
"" = { reg = 6999, type = "u16", cite = 3217 }
"Rprgrunmode Run mode User Programmare Stop or Run" = { reg = 206, type = "u16" }
"#;
    let pasted = r#""Rprgrunmode Run mode User Programmare 0 = Stop 1 = Single step 2 = Run""#;
    let long = r#""Rprgrunmode Run mode User Programmare Stop or Run""#;
    let expected = [
        ("TAB041", 2, pasted),
        ("EDS038", 3, r#""""#),
        ("TAB007", 6, r#""""#),
        ("EDS038", 6, r#""""#),
        ("TAB041", 7, long),
    ];
    let found = registers(rows, &expected);
    let said = "`Rprgrunmode Run mode User Programmare 0 = Stop 1 = Single step 2` has values in it";
    assert_eq!((message(&found, 0), help(&found, 0)), (said, "write the name alone, and the rest as `doc`"));
    // Where registers are called by several words, a long name is one.
    let words = r#""Maximum charging current of the first battery bank" = { reg = 1, type = "u16" }
"Low-pass filter" = { reg = 2, type = "u16" }
low-pass = { reg = 3, type = "u16" }
CO-alarm = { reg = 4, type = "u16" }
"#;
    registers(words, &[]);
}

/// The 44 rows whose name has the hyphen of a line break, as they are printed.
const BROKEN: [(u32, &str); 44] = [
    (2446, "Rstpout-maxfreq"),
    (2458, "Rstepout-time"),
    (2459, "Rstepout-count"),
    (2549, "Renc2top-sample"),
    (2687, "Rveladjo- penmode"),
    (2725, "Rpidposin-pact"),
    (2726, "Rpidpospro-pact"),
    (2728, "Rpidposde-ract"),
    (2731, "Rpidposou-tact"),
    (2732, "Rpidvelin-pact"),
    (2733, "Rpidvelpro-pact"),
    (2753, "Rmottens-nom"),
    (2951, "Rtouchpro- befunc"),
    (2952, "Rtouchpro- bestatus"),
    (2953, "Rtouchpro- bepos1pos"),
    (2954, "Rtouchpro- bepos1neg"),
    (2955, "Rtouchpro- bepos2pos"),
    (2963, "Rtouchpro- befunc"),
    (2964, "Rtouchpro- bestatus"),
    (2965, "Rtouchpro- bepos1pos"),
    (2966, "Rtouchpro- bepos1neg"),
    (2970, "Rtouchprobe1time-stamppos"),
    (2971, "Rtouchprobe1time-stampneg"),
    (2972, "Rtouchprobe1posed-gecnt"),
    (2973, "Rtouchprobe1neged-gecnt"),
    (2979, "Rtouchprobe2time-stamppos"),
    (2980, "Rtouchprobe2time-stampneg"),
    (2981, "Rtouchprobe2time-stampneg"),
    (2982, "Rtouchprobe2posed-gecnt"),
    (2983, "Rtouchprobe2neged-gecnt"),
    (3105, "Rcaptvel-max"),
    (3124, "Rcamst-spmstmm-pulse"),
    (3125, "Rcamst-spslvmm-step"),
    (3126, "Rcamst-spcor"),
    (3127, "Rcamst-spaccspace"),
    (3128, "Rcamstspc-trl"),
    (3129, "Rcamst-spstatus"),
    (3130, "Rcamst-splowquotestlv"),
    (3132, "Rcamst-splowquotemst"),
    (3134, "Rcammode-select"),
    (3135, "Rcamst-spsimvel"),
    (3136, "Rcamst-spdecspace"),
    (3137, "Rcamst-spstartdly"),
    (3138, "Rcamst-spstopdly"),
];

#[test]
fn item_27_the_hyphen_of_a_line_break() {
    let row = |at: usize, (line, name): (u32, &str)| {
        format!("\"{name}\" = {{ reg = {at}, type = \"u16\", cite = {line} }}\n")
    };
    // The old and the new registers of the touch probe have one name (item 28): each row is a table of its own.
    for (at, &(line, name)) in BROKEN.iter().enumerate() {
        let found = registers(&row(at, (line, name)), &[("TAB041", 1, &format!("\"{name}\""))]);
        let whole = name.replace("- ", "").replace('-', "");
        assert_eq!(help(&found, 0), format!("write `{whole}`, if the manual's text does"), "L{line}");
    }
}

#[test]
fn item_03_how_many_objects_can_be_mapped() {
    let rows = r#"0x1600 = { name = "Receive PDO mapping 1", code = "record", cite = 1026, summary = { subs = 5, cite = 602 } }
"0x1600:0" = { name = "number_of_entries", type = "u8", access = "ro", min = 0x00, max = 0x08, cite = 1034,
    summary = [ { max = 4, cite = 559 }, { max = 8, cite = [1020, 1022] } ] }
"0x1600:1..8" = { name = "PDO mapping {sub}", type = "u32", access = "rw", cite = 1040 }
0x1601 = { name = "Receive PDO mapping 2", code = "record", cite = 1026, summary = { subs = 9, cite = 603 } }
"0x1601:0..8" = { name = "PDO mapping {sub}", type = "u32", access = "rw", cite = 1040 }
"#;
    let found = objects(rows, &[("TAB021", 1, "5"), ("TAB021", 3, "4")]);
    assert_eq!(message(&found, 0), "the summary says 5 sub-indices, and 9 are described");
    assert_eq!(message(&found, 1), "the summary says 4, and the row 8");
}

#[test]
fn item_06_sub_indices_of_the_summary_and_of_the_boxes() {
    let rows = r#"0x1003 = { name = "pre_defined_error_field", code = "array", summary = [ { subs = 3, cite = 583 }, { subs = 3, cite = 656 } ] }
"0x1003:0..2" = { name = "error {sub}", type = "u32", access = "ro" }
0x1018 = { name = "identity", code = "array", summary = [ { subs = 4, cite = 596 }, { subs = 5, cite = 879 } ] }
"0x1018:0..4" = { name = "identity {sub}", type = "u32", access = "ro" }
0x1400 = { name = "Receive PDO parameter", code = "record", summary = [ { subs = 5, cite = 598 }, { subs = 3, cite = 956 } ] }
"0x1400:0..2" = { name = "parameter {sub}", type = "u32", access = "rw" }
0x1800 = { name = "Transmit PDO parameter 1", code = "record", summary = [ { subs = 9, cite = 606 }, { subs = 3, cite = 1066 } ] }
"0x1800:0..5" = { name = "parameter {sub}", type = "u32", access = "rw" }
0x1801 = { name = "Transmit PDO parameter 2", code = "record", summary = [ { subs = 6, cite = 607 }, { subs = 3, cite = 1066 } ] }
"0x1801:0..5" = { name = "parameter {sub}", type = "u32", access = "rw" }
"#;
    let expected = [("TAB021", 3, "4"), ("TAB021", 5, "5"), ("TAB021", 7, "9"), ("TAB021", 7, "3"), ("TAB021", 9, "3")];
    objects(rows, &expected);
}

#[test]
fn items_14_16_symbols_twice_in_one_object_and_a_default_that_counts_others() {
    let rows = r#"0x1003 = { name = "pre_defined_error_field", code = "array", cite = 655 }
"0x1003:0" = { name = "number_of_errors", type = "u8", access = "rw", default = 0x00, cite = 663 }
"0x1003:1" = { name = "standard_error_field", type = "u32", access = "ro", cite = 669 }
"0x1003:2" = { name = "standard_error_field", type = "u32", access = "ro", cite = 675 }
0x1016 = { name = "Consumer_heartbeat_time", code = "array", cite = 828 }
"0x1016:0" = { name = "number_of_entries", type = "u8", access = "ro", min = 0x00, max = 0x02, default = 0x00, cite = 836 }
"0x1016:1" = { name = "Consumer_heartbeat_time", type = "u32", access = "rw", cite = 842 }
"0x1016:2" = { name = "Consumer_heartbeat_time", type = "u32", access = "rw", cite = 848 }
0x23E8 = { name = "read_write_variable", code = "record", summary = { subs = 7, cite = 3227 }, cite = 3226 }
"0x23E8:0" = { name = "number_of_entries", type = "u8", access = "ro", pdo = "no", default = 0x02, cite = 3236 }
"0x23E8:1" = { name = "variable_number", type = "u16", access = "rw", pdo = "no", default = 0x0001, cite = 3244 }
"0x23E8:2" = { name = "variable_value", type = "i32", access = "rw", pdo = "no", default = 0x00000000, cite = 3250 }
"0x23E8:3" = { name = "variable_number", type = "u16", access = "rw", pdo = "rx", default = 0x0001, cite = 3260 }
"0x23E8:4" = { name = "variable_value", type = "i32", access = "rw", pdo = "rx", default = 0x00000000, cite = 3266 }
"0x23E8:5" = { name = "variable_number", type = "u16", access = "rw", pdo = "rx", default = 0x0001, cite = 3276 }
"0x23E8:6" = { name = "variable_value", type = "i32", access = "rw", pdo = "tx", default = 0x00000000, cite = 3282 }
"#;
    let expected = [
        ("TAB040", 4, r#""0x1003:2""#),
        ("EDS049", 6, "0x00"),
        ("TAB040", 8, r#""0x1016:2""#),
        ("EDS049", 10, "0x02"),
        ("TAB040", 13, r#""0x23E8:3""#),
        ("TAB040", 14, r#""0x23E8:4""#),
        ("TAB040", 15, r#""0x23E8:5""#),
        ("TAB040", 16, r#""0x23E8:6""#),
    ];
    canopen(rows, &expected);
}

#[test]
fn item_14_prefixes_with_a_capital_letter() {
    // TOML has no such number; in quotation marks it stands as it is printed.
    let found = objects("0x1005 = { type = \"u32\", min = 0X00000000, cite = 710 }\n", &[("TAB002", 1, "0X")]);
    assert!(message(&found, 0).starts_with("this is no TOML: "), "{}", message(&found, 0));
    let rows = r#"0x1005 = { name = "COD_ID_SYNC", type = "u32", access = "rw", pdo = "no", min = "0X00000000", max = 0xFFFFFFFF, cite = 710 }
"#;
    let found = objects(rows, &[("TAB012", 1, r#""0X00000000""#)]);
    assert_eq!(message(&found, 0), "`0X00000000` begins with `0X`, and other numbers with `0x`");
    let rows = r#"Rwindquotelleft = { reg = "478-79", obj = "0X21DE", type = "u32", min = 0, max = 0x7FFFFFFF, cite = 3150 }
Rwindrevpause = { reg = "491-92", obj = "0X21EB", type = "u32", min = 0, max = 0x7FFFFFFF, cite = 3157 }
"#;
    registers(rows, &[("TAB012", 1, r#""0X21DE""#), ("TAB012", 2, r#""0X21EB""#)]);
}

#[test]
fn item_21_an_index_printed_as_a_range_and_rows_without_one() {
    let rows = r#"Rrslvrawangleout = { reg = "10194-95", obj = "0x47D2-D3", type = "i32", access = "ro", cite = 2590 }
Rrslvsinfirot = { reg = "10196-97", obj = "0x47D4-D5", type = "i32", access = "ro", cite = 2591 }
Rrslvcosfirot = { reg = "10198-99", obj = "0x47D6-D7", type = "i32", access = "ro", cite = 2592 }
"#;
    let expected = [("TAB006", 1, r#""0x47D2-D3""#), ("TAB006", 2, r#""0x47D4-D5""#), ("TAB006", 3, r#""0x47D6-D7""#)];
    registers(rows, &expected);
    let rows = r#"Rprgcnt = { reg = 207, obj = 0x20CF, type = "u16", pdo = "no", min = 0, max = 4998, cite = 3199 }
Rprgccflag = { reg = 208, obj = 0x20D0, type = "u16", pdo = "no", cite = 3200 }
Rprgeventcounterptr = { reg = 578, obj = 0x2242, type = "u16", min = 0, max = 4988, cite = 3201 }
Rprgusrpsw = { reg = 2000, type = "u16", cite = 3203 }
Rprgcmd = { reg = 2001, type = "u16", cite = 3204 }
"#;
    let found = registers(rows, &[("TAB001", 4, "2000"), ("TAB001", 5, "2001")]);
    let said = "the row says no object, as others here do, and the rule of its space gives 0x27D0";
    assert_eq!(message(&found, 0), said);
}

#[test]
fn item_23_how_many_locations_a_program_has() {
    // Locations 0 to 4988, the last of which would be at 6998.
    let rows = r#""Locazione 0 programma utente" = { reg = 2010, type = "u16", cite = 3215 }
"Locazione {n+1} programma utente" = { reg = 2011, count = 4988, type = "u16", cite = 3216 }
"Locazione 4988 programma utente" = { reg = 6999, type = "u16", cite = 3217 }
"#;
    let found = registers(rows, &[("TAB007", 3, r#""Locazione 4988 programma utente""#)]);
    assert_eq!(message(&found, 0), "the name `Locazione 4988 programma utente` occurs twice");
}

#[test]
fn item_39_elements_that_exclude_sub_index_0() {
    let rows = r#"0x60C1 = { name = "Interpolation_data_record", code = "record", cite = 1822, summary = [
    { code = "array", subs = 2, access = "rw", pdo = "rx", cite = 1240 }, { type = "u32", subs = 2, cite = [1823, 1824] } ] }
"0x60C1:1" = { name = "1 st _ip_function_parameter", type = "i32", access = "rw", pdo = "rx", cite = 1829 }
"0x60C1:2" = { name = "2 nd _ip_function_parameter", type = "i32", access = "rw", pdo = "rx", cite = 1835 }
0x60C2 = { name = "Interpolation_time_period", code = "record", cite = 1848, summary = [
    { code = "array", subs = 3, access = "rw", pdo = "rx", cite = 1241 }, { subs = 2, cite = 1849 } ] }
"0x60C2:1" = { name = "ip_time_units", type = "u8", access = "rw", pdo = "rx", min = 0x01, max = 0x0A, default = 0x04, cite = 1855 }
"0x60C2:2" = { name = "ip_time_index", type = "u8", access = "rw", pdo = "no", min = 0xFD, max = 0xFD, default = 0xFD, cite = 1861 }
0x60C3 = { name = "Interpolation_sync_definition", code = "array", cite = 1872, summary = [
    { code = "array", subs = 3, access = "rw", cite = 1242 }, { subs = 2, cite = 1873 } ] }
"0x60C3:1" = { name = "sincronize_on_group", type = "u8", access = "rw", pdo = "no", min = 0x00, max = 0x00, default = 0x00, cite = 1879 }
"0x60C3:2" = { name = "ip_sync_every_n_event", type = "u8", access = "rw", pdo = "no", min = 0x01, max = 0x01, default = 0x01, cite = 1885 }
0x60C4 = { name = "Interpolation_data_config", code = "record", cite = 1894, summary = [
    { code = "array", subs = 7, access = "rw", pdo = "rx", cite = 1243 }, { subs = 6, cite = 1895 } ] }
"0x60C4:1" = { name = "max_buffer_size", type = "u8", access = "ro", pdo = "no", min = 0x02, max = 0x02, default = 0x02, cite = 1901 }
"0x60C4:2" = { name = "actual_size", type = "u8", access = "rw", pdo = "no", min = 0x00, max = 0x02, default = 0x00, cite = 1907 }
"0x60C4:3" = { name = "buffer_organisation", type = "u8", access = "rw", pdo = "no", min = 0x00, max = 0x00, default = 0x00, cite = 1913 }
"0x60C4:4" = { name = "buffer_position", type = "u8", access = "rw", pdo = "rx", min = 0x00, max = 0x01, default = 0x00, cite = 1919 }
"0x60C4:5" = { name = "size_of_data_record", type = "u8", access = "ro", pdo = "no", min = 0x01, max = 0x01, default = 0x01, cite = 1925 }
"0x60C4:6" = { name = "buffer_clear", type = "u8", access = "wo", pdo = "no", min = 0x00, max = 0x01, default = 0x00, cite = 1931 }
0x60FE = { name = "Digital_outputs", code = "record", cite = 1966, summary = [
    { code = "array", type = "u32", subs = 3, access = "rw", pdo = "rx", cite = 1245 }, { subs = 2, cite = 1967 } ] }
"0x60FE:1" = { name = "Physical_output", type = "u32", access = "rw", pdo = "rx", min = 0x00000000, max = 0x00FF0000, default = 0x00000000, cite = 1973 }
"0x60FE:2" = { name = "bitmask", type = "u32", access = "rw", pdo = "rx", min = 0x00000000, max = 0xFFFFFFFF, default = 0x00FF0000, cite = 1979 }
"#;
    let expected = [
        ("EDS058", 1, "0x60C1"),
        ("TAB021", 2, r#""array""#),
        ("TAB021", 2, r#""u32""#),
        ("EDS058", 5, "0x60C2"),
        ("TAB021", 6, r#""array""#),
        ("TAB021", 6, "3"),
        ("TAB021", 6, r#""rx""#),
        ("EDS058", 9, "0x60C3"),
        ("TAB021", 10, "3"),
        ("EDS058", 13, "0x60C4"),
        ("TAB021", 14, r#""array""#),
        ("TAB021", 14, "7"),
        ("TAB021", 14, r#""rw""#),
        ("TAB021", 14, r#""rx""#),
        ("EDS058", 21, "0x60FE"),
        ("TAB021", 22, r#""array""#),
        ("TAB021", 22, "3"),
    ];
    let found = canopen(rows, &expected);
    assert_eq!(message(&found, 1), "the summary says code array, and the row record");
    assert_eq!(message(&found, 5), "the summary says 3 sub-indices, and 2 are described");
    assert_eq!(message(&found, 6), "the summary says rx, and sub-index 2 no");
}

#[test]
fn item_41_a_mode_without_bits() {
    let rows = r#"0x6060 = { name = "Modes of operation", type = "i8", access = "wo", pdo = "rx", default = 0x01, cite = 1456, enum = "Mode" }
0x6040 = { name = "Controlword", type = "u16", access = "rw", cite = 1278, bits = "Control" }
0x6041 = { name = "Statusword", type = "u16", access = "ro", cite = 1321, bits = "Status" }
[bits.Control.at]
4 = [ { name = "Nuovo setpoint", when = { "Modes of operation" = [1] }, cite = 1290 }, { name = "Homing operation start", when = { "Modes of operation" = [6] } }, { name = "Start", when = { "Modes of operation" = [-1] } } ]
[bits.Status.at]
12 = [ { name = "Setpoint acquisito", when = { "Modes of operation" = [1] }, cite = 1341 }, { name = "Home eseguito", when = { "Modes of operation" = [6] } }, { name = "Motore fermo", when = { "Modes of operation" = [-1] } } ]
[enums.Mode.values]
"-128..-2" = { zone = "reserved" }
-1 = "AEC velocity"
0 = { zone = "reserved" }
1 = "profile position"
"2..5" = { zone = "reserved" }
6 = "homing"
7 = "interpolated"
"8..127" = { zone = "reserved", cite = 1469 }
"#;
    let found = objects(rows, &[("TAB037", 4, "Control"), ("TAB037", 6, "Status")]);
    assert_eq!(message(&found, 0), "`Control` has no bits for `Modes of operation` = 7 (`interpolated`)");
}

/// The control word of the touch probe in its row (L2951), in English as it is printed.
const TOUCH_PROBE: &str = r#"Rtouchprobefunc = { reg = 331, type = "u16", pdo = "rx", min = 0, max = 65535, cite = 2951, bits = "Func331" }
[chapters.objects]
0x60B8 = { name = "Touch probe function", type = "u16", access = "rw", pdo = "rx", cite = 1690, same_as = "Rtouchprobefunc", bits = "Func60B8" }
[bits.Func331.at]
0 = { name = "touch probe 1", values = { 0 = "Switch off touch probe 1", 1 = "Enable touch probe 1" } }
1 = { name = "event 1", values = { 0 = "Trigger first event", 1 = "Continuous" } }
"3-2" = { name = "trigger 1", values = { 0b00 = "touch probe 1 by input 0", 0b01 = "TOP encoder", 0b10 = "source defined by object 0x60D0", 0b11 = { zone = "reserved" } } }
4 = { name = "positive edge 1", values = { 0 = "Switch off sampling at positive edge", 1 = "Enable sampling at positive edge" } }
5 = { name = "negative edge 1", values = { 0 = "Switch off sampling at negative edge", 1 = "Enable sampling at negative edge" } }
"7-6" = { name = "source 1", values = { 0b00 = "Touch Rposact", 0b01 = "Touch Encoder 1", 0b10 = "Touch Encoder 2", 0b11 = "Touch Absolute Encoder" } }
8 = { name = "touch probe 2", values = { 0 = "Switch off touch probe2", 1 = "Enable touch probe 2" } }
13 = { name = "negative edge 2", values = { 0 = "Switch off sampling at negative edge", 1 = "Enable sampling at negative edge" } }
[bits.Func60B8.at]
0 = { name = "touch probe 1", values = { 0 = "Definition", 1 = "Disabilita touch probe 1" }, cite = 1699 }
1 = { name = "evento 1", values = { 0 = "Trigger primo evento", 1 = "Continuo" } }
2 = { name = "trigger 1", values = { 0 = "input touch probe 1", 1 = "segnale TOP encoder" }, cite = 1703 }
3 = { reserved = "keep", cite = 1705 }
4 = { name = "campionamento 1", values = { 0 = "Disabilita campionamento al touch probe 1", 1 = "Abilita campionamento al touch probe 1" }, cite = 1706 }
5 = { reserved = "keep", doc = "Non supportato", cite = 1708 }
"7-6" = { name = "sorgente 1", values = { 0b00 = "Touch Rposact", 0b01 = "Touch Encoder 1", 0b10 = "Touch Encoder 2", 0b11 = "Touch Absolute Encoder" } }
8 = { name = "touch probe 2", values = { 0 = "Disabilita touch probe 2", 1 = "Abilita touch probe 2" }, cite = 1713 }
13 = { reserved = "keep", doc = "Non supportato", cite = 1722 }
"#;

#[test]
fn items_42_43_the_control_word_of_the_touch_probe() {
    let row = TOUCH_PROBE.lines().nth(2).unwrap_or_default();
    let found = registers(TOUCH_PROBE, &[("TAB022", 3, row), ("TAB025", 7, r#""3-2""#), ("TAB041", 14, "0")]);
    let differs = message(&found, 0);
    assert!(differs.contains("differs: the bits 2, 2 to 3, 5, 13 have a meaning in one of them only"), "{differs}");
    assert_eq!(message(&found, 1), "object 0x60D0 is mentioned, and the table doesn't have it");
    // The title of the column stands for 0, and so the bit reads inverted.
    assert_eq!(message(&found, 2), "`Definition` of `Func60B8 touch probe 1` is the title of a column");
}

#[test]
fn item_43_two_bits_called_the_same() {
    let rows = r#"Rtouchprobestatus = { reg = 10085, type = "u16", min = 0, max = 65535, cite = 2964, bits = "Status" }
[bits.Status.at]
2 = "Touch Probe 1 negative edge position stored"
"6-3" = { reserved = "keep" }
9 = "Touch Probe 2 positive edge position stored"
10 = "Touch Probe 1 negative edge position stored"
"#;
    let found = registers(rows, &[("TAB040", 2, "Status")]);
    let said = "bit 2 and bit 10 of `Status` are both called `Touch Probe 1 negative edge position stored`";
    assert_eq!(message(&found, 0), said);
}

#[test]
fn item_46_access_that_contradicts_storage_and_mapping() {
    let rows = r#"Rtouchprobe1inpdef = { reg = 341, type = "i16", access = "ro", pdo = "rx", cite = 2959 }
Rtouchprobe2inpdef = { reg = 342, type = "i16", access = "ro", pdo = "rx", cite = 2960 }
Rposactsaved = { reg = "55-56", type = "i32", access = "ro", pdo = "no", save = true, order = "low_first", cite = 2134 }
Rtouchprobestatus = { reg = 332, type = "u16", access = "ro", pdo = "tx", until = "6", replaced_by = "Rtouchprobestatus_v6", cite = 2952 }
Rtouchprobestatus_v6 = { reg = 10085, type = "u16", access = "rw", save = true, min = 0, max = 65535, since = "6", cite = 2964 }
Rswrevariantaios = { reg = 10140, type = "u16", access = "rw", save = true, cite = 2867 }
Rhwrevariantaios = { reg = 10141, type = "u16", access = "rw", save = true, cite = 2868 }
Rmodelantaios = { reg = 10142, type = "u16", access = "rw", save = true, cite = 2869 }
Rfgvalmin = { reg = "316-17", type = "i32", access = "ro", pdo = "no", min = 0x80000000, max = 0x7FFFFFFF, order = "low_first", cite = 3184 }
Rfgvalmax = { reg = "318-19", type = "i32", access = "ro", pdo = "no", min = 0x80000000, max = 0x7FFFFFFF, order = "low_first", cite = 3185 }
Rfgcmd = { reg = 322, type = "u16", pdo = "no", save = true, min = 0, max = 1, enum = { 0 = "FG stop", 1 = "FG start" }, cite = 3188 }
"#;
    let expected =
        [("TAB024", 1, r#""rx""#), ("TAB024", 2, r#""rx""#), ("TAB024", 3, r#""ro""#), ("TAB022", 4, r#""ro""#)];
    let found = registers(rows, &expected);
    assert_eq!(message(&found, 0), "`Rtouchprobe1inpdef` is ro and may come in an RPDO");
    assert_eq!(message(&found, 2), "`Rposactsaved` is ro and saved, though nobody can write it");
    let replaced = "`Rtouchprobestatus` is ro, and `Rtouchprobestatus_v6`, which replaces it, rw";
    assert_eq!(message(&found, 3), replaced);
}

#[test]
fn item_60_defaults_in_the_cell_of_the_limit() {
    let cells = [
        (10014, "-4 (Default -4)", 2320),
        (428, "Default 65535", 2449),
        (577, "(Default 4)", 2495),
        (10010, "(Default 0)", 2496),
        (10026, "Default 512", 2539),
        (10028, "Default 25", 2570),
        (10029, "Default 12", 2571),
        (10030, "Default 13", 2572),
        (10012, "Default 1", 3158),
        (42, "1234567890 0x499602D2", 2795),
    ];
    for (reg, cell, line) in cells {
        let row = format!("Rrow = {{ reg = {reg}, type = \"i16\", min = \"{cell}\", cite = {line} }}\n");
        registers(&row, &[("TAB004", 1, &format!("\"{cell}\""))]);
    }
    let rows = r#"Rtim4 = { reg = "536-37", type = "u32", unit = "ms", min = 0, cite = 2765 }
Rtim5 = { reg = "538-39", type = "u32", unit = "ms", min = 0, cite = 2766 }
Rtim6 = { reg = "540-41", type = "u32", unit = "ms", min = 0, cite = 2767 }
Rtim7 = { reg = "542-43", type = "u32", unit = "ms", min = 0, cite = 2768 }
Rfreerun = { reg = "10154-55", type = "u32", access = "ro", unit = "ms", min = 0, max = 0xFFFFFFFF, cite = 2769 }
"#;
    let found = registers(rows, &[1, 2, 3, 4].map(|line| ("TAB042", line, "0")));
    assert_eq!(message(&found, 0), "`Rtim4` has the limit 0, which is that of its type, and no upper one");
    // One limit that says something is a limit.
    registers("Rone = { reg = 1, type = \"u16\", min = 1 }\nRmost = { reg = 2, type = \"u16\", max = 100 }\n", &[]);
}
