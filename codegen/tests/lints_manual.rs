//! Section 4 of the notes on the AEC Vector Step's manual: each passage that contradicts itself, transcribed as it is printed,
//! has its finding at its row. The number in a test's name is that of the notes; `cite` has the manual's lines. Items that have
//! their test in `lints_table` are listed at the end with the others, so that each of the 60 is accounted for.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Level;
use lexibus_codegen::source::Source;

const DEVICE: &str = r#"lexibus = 1
[device]
name = "Vector Step"
"#;
const CANOPEN: &str = r#"lexibus = 1
[device]
name = "Vector Step"
buses = ["canopen"]
"#;
const REGISTERS: &str = r#"lexibus = 1
[device]
name = "Vector Step"
[defaults]
access = "rw"
[spaces.register]
canopen = { index = 0x2000 }
modbus = {}
[[chapters]]
[chapters.registers]
"#;
const OBJECTS: &str = "[[chapters]]\n[chapters.objects]\n";

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

fn message(compilation: &Compilation, at: usize) -> &str {
    &compilation.diagnostics.list()[at].message
}

fn help(compilation: &Compilation, at: usize) -> &str {
    compilation.diagnostics.list()[at].help.as_deref().unwrap_or_default()
}

/// The boxes of a receive PDO (L954-1044), of which the procedure speaks, and what it maps.
const RPDO: &str = r#"0x1401 = { name = "RxPDO2 parameter", code = "record", cite = 954 }
"0x1401:0" = { name = "number_of_entries", type = "u8", access = "ro", min = 0x02, max = 0x02, default = 0x02 }
"0x1401:1" = { name = "RxPDO COB-ID", type = "u32", access = "rw", default = "$NODEID+0x300", cite = 971 }
"0x1401:2" = { name = "Transmission_type", type = "u8", access = "rw", default = 0xFE }
0x1601 = { name = "RxPDO2 mapping", code = "record", cite = 1026 }
"0x1601:0" = { name = "number_of_entries", type = "u8", access = "ro", min = 0x00, max = 0x08, cite = 1037 }
"0x1601:1..8" = { name = "PDO mapping {sub}", type = "u32", access = "rw", min = 0x00000000, max = 0xFFFFFFFF, cite = 1040 }
0x1800 = { name = "TxPDO1 parameter", code = "record", cite = 1064 }
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
        RPDO.replace(r#"access = "ro", min = 0x00, max = 0x08"#, r#"access = "rw", min = 0x00"#)
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
