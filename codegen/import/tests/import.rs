//! Tests the import of register lists. The resulting tables must pass `check` and `generate`.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::{Levels, Severity};
use lexibus_codegen::ir::{Access, Binding, Device, Item, RegisterBinding, RegisterSpace, Scale, Shape, Type, Value};
use lexibus_codegen::limits;
use lexibus_codegen::source::Source;
use lexibus_import::{import, mapping, Import};
use proptest::prelude::*;

/// Imports `text` as the content of a file with the given name.
fn read_as(name: &str, text: impl Into<Vec<u8>>, options: &lexibus_import::Options) -> Import {
    import(Source::new(name, text.into()), options)
}

fn read(text: &str) -> Import {
    read_as("list.csv", text, &lexibus_import::Options::default())
}

/// Returns the line, column and code of each diagnostic of an import.
fn findings(import: &Import) -> Vec<(u32, u32, &'static str)> {
    let source = &import.compilation.sources[0];
    let list = import.compilation.diagnostics.list().iter();
    list.map(|diagnostic| {
        let at = source.position(diagnostic.span.start);
        (at.line, at.column, diagnostic.code.id)
    })
    .collect()
}

/// Imports a list and returns the device of its table. Neither the list nor the table may have diagnostics.
fn device(text: &str) -> Device {
    let import = read(text);
    assert_eq!(findings(&import), [], "{text}");
    accepted(&import)
}

/// Returns the device of an imported table. The table must pass `check` and `generate`.
fn accepted(import: &Import) -> Device {
    let table = import.table.as_ref().expect("a table");
    let options = Options::default();
    let compilation: Compilation = check(Source::new("list.toml", table.clone().into_bytes()), &options);
    let list = compilation.diagnostics.list().iter();
    let messages: Vec<String> = list.map(|diagnostic| compilation.one_line(diagnostic)).collect();
    assert_eq!(messages, Vec::<String>::new(), "{table}");
    assert!(compilation.rust(&options.rust).is_some(), "{table}");
    compilation.catalog.expect("a catalog").devices.remove(0)
}

fn item<'d>(device: &'d Device, name: &str) -> &'d Item {
    let mut items = device.groups.iter().flat_map(|group| &group.items);
    items.find(|item| item.name == name).unwrap_or_else(|| panic!("no {name}"))
}

fn register<'d>(device: &'d Device, name: &str) -> &'d RegisterBinding {
    match &item(device, name).bindings[0] {
        Binding::Register(register) => register,
        other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn a_list_as_vendors_write_it() {
    let list = "Name,Register,Data Type,R/W,Unit,Scale,Min,Max,Default,Description\n\
                Speed setpoint,40001,UINT16,R/W,rpm,1,0,3000,1500,Speed wanted\n\
                Temperature,40002,INT16,R,0.1 °C,,,,,\n\
                Mode,40003,ENUM16,RW,,,,,,\"0=Off, 1=Speed, 2=Pressure\"\n\
                Running time,40004-40005,uint32_t,RO,h,,,,,\n\
                Status,40006,BITFIELD16,R,,,,,,\"Bit 0: running; Bit 1: fault; Bits 2-15: reserved\"\n\
                Position,40007,INT32 swapped,R/W,mm,/1000,,,,\n\
                Serial,40010-40017,string16,R,,,,,,\n";
    let import = read(list);
    insta::assert_snapshot!(import.table.as_deref().unwrap_or_default());
    let device = device(list);
    assert_eq!(register(&device, "Speed setpoint").address, 0);
    assert_eq!((register(&device, "Running time").count, register(&device, "Serial").count), (2, 8));
    assert!(register(&device, "Position").low_word_first && !register(&device, "Running time").low_word_first);
    assert_eq!(item(&device, "Speed setpoint").limits.high, Some(Value::Int(3000)));
    assert_eq!(item(&device, "Speed setpoint").default, Some(Value::Int(1500)));
    let scale = item(&device, "Temperature").quantity.as_ref().and_then(|quantity| quantity.scale.clone());
    assert_eq!(scale, Some(Scale::Linear { factor: 0.1, offset: 0.0 }));
    let shapes: Vec<&Shape> = device.types.iter().map(|ty| &ty.shape).collect();
    assert!(matches!(shapes[..], [Shape::Enumeration { .. }, Shape::BitField { .. }]), "{shapes:?}");
}

#[test]
fn german_and_italian_lists() {
    let german = device(
        "Bezeichnung;Adresse;Datentyp;Zugriff;Einheit;Faktor;Minimalwert;Maximalwert\n\
         Drehzahl;100;UINT16;Lesen/Schreiben;U/min;0,5;0;3000\nTemperatur;101;INT16;Lesen;°C;0,1;;\n",
    );
    assert_eq!(item(&german, "Drehzahl").access, Access::ReadWrite);
    assert_eq!(item(&german, "Drehzahl").quantity.as_ref().map(|quantity| quantity.unit.as_str()), Some("rpm"));
    let italian = device(
        "Indirizzo;Descrizione;Tipo;U.M.;Fattore;Valore Minimo;Valore Massimo;Accesso\n;Misure;;;;;;\n\
         1000;Tensione L1;UINT16;V;0,1;;;Lettura\n;Impostazioni;;;;;;\n1100;Soglia;INT16;V;1;-5;5;L/S\n",
    );
    let titles: Vec<&str> = italian.groups.iter().map(|group| group.name.as_str()).collect();
    assert_eq!(titles, ["Misure", "Impostazioni"]);
    assert_eq!(item(&italian, "Soglia").limits.low, Some(Value::Int(-5)));
}

#[test]
fn any_delimiter_encoding_and_order_of_columns() {
    for list in [
        "Type,Name,Access,Address\nu16,Größe,ro,5\n",
        "sep=;\nType;Name;Access;Address\nu16;Größe;ro;5\n",
        "\u{feff}Access\tAddress\tName\tType\r\nro\t5\tGröße\tu16\r\n",
        "Pump 3000|||\n|||\nAddress|Access|Name|Type\n5|ro|Größe|u16\n",
        "Address;Access;Name;Type\n5;ro;\"Größe\";u16\n\nAddress;Access;Name;Type\n6;ro;b;u16\n",
    ] {
        assert_eq!(register(&device(list), "Größe").address, 5, "{list}");
    }
    let bytes = b"Name;Address;Type;Access\nGr\xF6\xDFe;5;u16;ro\n";
    let import = read_as("list.csv", *bytes, &lexibus_import::Options::default());
    assert_eq!(register(&accepted(&import), "Größe").address, 5);
}

#[test]
fn tables_of_modbus_and_what_numbers_count_from() {
    let by_digit = device("Name,Address,Type,Access\na,40001,u16,rw\nb,30005,i16,\nc,10003,bool,\nd,00002,bool,rw\n");
    let place = |device: &Device, name| (register(device, name).space, register(device, name).address);
    assert_eq!(place(&by_digit, "a"), (RegisterSpace::Holding, 0));
    assert_eq!(place(&by_digit, "b"), (RegisterSpace::Input, 4));
    assert_eq!(place(&by_digit, "c"), (RegisterSpace::DiscreteInput, 2));
    let by_function = device("Name,Address,Type,FC\na,1,u16,03/06/16\nb,1,u16,FC04\nc,1,,1 / 5\n");
    assert_eq!(
        (place(&by_function, "b"), item(&by_function, "a").access),
        ((RegisterSpace::Input, 1), Access::ReadWrite)
    );
    assert_eq!((place(&by_function, "c"), item(&by_function, "c").ty), ((RegisterSpace::Coil, 1), Type::Boolean));
    let by_x = device("Name,Address,Type,Access\na,4x0001,u16,rw\nb,3x0010,u16,ro\n");
    assert_eq!((place(&by_x, "a").1, place(&by_x, "b")), (0, (RegisterSpace::Input, 9)));
    let by_two = device("Name,Register,Address (hex),Type,Access\na,1001,03E7,u16,rw\nb,1002,03E8,u16,ro\n");
    assert_eq!(place(&by_two, "b"), (RegisterSpace::Holding, 1000));
    let plain = device("Name,Address,Type,Access\nSunSpec,40000,u32,ro\nModel,40002,u16,ro\n");
    assert_eq!(place(&plain, "SunSpec").1, 40000);
}

#[test]
fn what_gateways_and_integrations_have() {
    let sunspec = device(
        "Address,Name,Type,Size,Scale Factor,Units,RW Access\n40072,A,uint16,1,A_SF,A,R\n40076,A_SF,sunssf,1,,,R\n\
         40094,WH,acc32,2,A_SF,Wh,R\n40020,Mn,string,16,,,R\n",
    );
    let scale = item(&sunspec, "A").quantity.as_ref().and_then(|quantity| quantity.scale.clone());
    assert_eq!(scale, Some(Scale::Exponent { exponent: "A_SF".into(), base: 10, fraction: 0 }));
    assert_eq!(item(&sunspec, "Mn").ty, Type::VisibleString(Some(32)));
    let parts = device("Name,Address,Type,Access\na,10.0,bool,ro\nb,10.1,bool,ro\nc,10.2-4,u16,ro\nd,11,u16,ro\n");
    assert_eq!((register(&parts, "b").bit_offset, item(&parts, "c").ty), (Some(1), Type::Unsigned(3)));
    let masks = device("Name,Address,Mask,Access\nlow,10,0x00FF,ro\nhigh,10,0xFF00,ro\n");
    assert_eq!((register(&masks, "high").bit_offset, item(&masks, "high").ty), (Some(8), Type::Unsigned(8)));
    let orders = device("Name,Address,Type,Word order,Access\na,1,float32,CDAB,ro\nb,3,float32,ABCD,ro\n");
    assert!(register(&orders, "a").low_word_first && !register(&orders, "b").low_word_first);
    let rest = device("Name,Address,Type,Invalid value,Repeat,Access\nt,1,int16,0x7FFF,,ro\nbuf,10,u32,,3,ro\n");
    assert_eq!(item(&rest, "t").quantity.as_ref().map(|quantity| quantity.sentinels.len()), Some(1));
    assert_eq!(register(&rest, "buf 3").address, 14);
}

#[test]
fn lists_of_objects_and_parameters() {
    let objects = device(
        "Index;Sub;Name;Type;Access;Default\n1000h;0;Device type;UNSIGNED32;ro;0x192\n2000h;1;Speed;INTEGER16;rw;-5\n",
    );
    assert_eq!(objects.groups[0].items[1].object(), Some((0x2000, 1)));
    assert_eq!(item(&objects, "Device type").default, Some(Value::Int(0x192)));
    let parameters = device("Parameter number,Name,Type,Access\n58,Ramp,u16,rw\n");
    assert!(matches!(&item(&parameters, "Ramp").bindings[0], Binding::Parameter(parameter) if parameter.code == 58));
}

#[test]
fn every_cell_that_cannot_be_read_is_told() {
    let import = read(
        "Name,Address,Type,Access,Scale,Min,Default,Values,Owner\n\
         a,1,pippo,ro,,,,,x\n\
         b,x,u16,ro,,,,,\n\
         c,3,u16,perhaps,,,,,\n\
         d,4,u8,rw,none of it,-1,300,,\n\
         e,5,u16,rw,,,,Off/On,\n\
         f,6,u16\n\
         a,7,u16,ro,,,,,\n\
         g,7,u16,ro,,,,,\n\
         h,8,u8,rw,,,,\"0=off, 300=on\",\n\
         i,,u16,ro,,,,,\n",
    );
    let expected = [
        (1, 51, "CSV002"),
        (2, 5, "CSV003"),
        (3, 3, "CSV004"),
        (4, 9, "CSV003"),
        (5, 11, "CSV003"),
        (5, 22, "CSV003"),
        (5, 25, "CSV003"),
        (6, 15, "CSV003"),
        (7, 1, "CSV005"),
        (8, 1, "CSV006"),
        (9, 1, "CSV004"),
        (10, 15, "CSV003"),
        (11, 1, "CSV004"),
    ];
    assert_eq!(findings(&import), expected);
    let table = import.table.expect("a table");
    for line in [
        "# the address cannot be read: b | x",
        "\"a 2\" = {",
        "# the address is used twice: g | 7",
        "# no address: i |",
    ] {
        assert!(table.contains(line), "{line}\n{table}");
    }
    // A row with an unreadable cell is kept. The text of a cell becomes documentation if the cell should contain a list
    // but does not.
    assert!(table.contains("doc = \"Off/On\"") && table.contains("reg = 4, type = \"u8\""), "{table}");
}

#[test]
fn what_is_assumed_is_told_once() {
    let codes = |text: &str| findings(&read(text)).into_iter().map(|(.., code)| code).collect::<Vec<_>>();
    assert_eq!(codes("Name,Address,Type,Access,Scale\na,1,u16,ro,x10\nb,2,u16,ro,x10\n"), ["CSV007"]);
    assert_eq!(codes("Name,Address,Type,Access,Gain\na,1,u16,ro,10\nb,2,u16,ro,100\n"), ["CSV007"]);
    assert_eq!(codes("Name,Address,Access\na,1,ro\nb,2,ro\n"), ["CSV007"]);
    assert_eq!(codes("Name,Address,Type\na,1,u16\nb,2,u16\n"), ["CSV007"]);
    for integer in ["INT", "signed", "unsigned"] {
        let list = format!("Name,Address,Type,Access\na,1,{integer},ro\nb,2,{integer},ro\n");
        assert_eq!(codes(&list), ["CSV007"], "{integer}");
    }
    assert_eq!(codes("Name,Address,Type,Access\n\"a,1,u16,ro\nb,2,u16,ro\n").last(), Some(&"CSV008"));
    let physical = read("Name;Address;Type;Access;Scale;Max\na;1;u16;ro;0,1;400,5\nb;2;u16;ro;0,1;10\n");
    let table = physical.table.as_deref().unwrap_or_default();
    assert!(table.contains("max = 4005") && table.contains("max = 100"), "{table}");
    let gain = read("Name,Address,Type,Access,Gain\na,1,u16,ro,10\n").table.unwrap_or_default();
    assert!(gain.contains("scale = 0.1"), "{gain}");
}

#[test]
fn columns_that_the_caller_names() {
    let options = |map: &[&str]| lexibus_import::Options {
        map: map.iter().map(|one| mapping(one).expect("a field")).collect(),
        ..lexibus_import::Options::default()
    };
    let list = "Pos,What,Kind of value\n40001,Speed,u16\n40002,Power,i16\n";
    assert_eq!(findings(&read(list)), [(1, 1, "CSV001")]);
    let named = read_as("l.csv", list, &options(&["reg=pos", "name=What", "type=#3"]));
    assert!(named.table.is_some_and(|table| table.contains("Power = { reg = 40002, type = \"i16\" }")));
    let headless = "40001,Speed,u16\n40002,Power,i16\n";
    let numbered = read_as("l.csv", headless, &options(&["reg=#1", "name=#2", "type=#3"]));
    assert!(numbered.table.is_some_and(|table| table.contains("Speed = { reg = 40001,")));
    let wrong = read_as("l.csv", list, &options(&["reg=Nowhere"]));
    assert_eq!((findings(&wrong), wrong.table), (vec![(1, 1, "CSV009")], None));
    assert!(mapping("adress=x").is_err_and(|error| error.contains("there is no field")));
    assert!(mapping("nme=x").is_err_and(|error| error.contains("did you mean `name`?")));
    assert!(mapping("name").is_err());
    assert_eq!((lexibus_import::delimiter("tab"), lexibus_import::delimiter(";")), (Ok(b'\t'), Ok(b';')));
    assert!(lexibus_import::delimiter("é").is_err());
}

#[test]
fn strict_imports_nothing_that_was_not_read() {
    let options = lexibus_import::Options { levels: Levels::strict(), ..lexibus_import::Options::default() };
    let import = read_as("l.csv", "Name,Address,Type,Access\na,1,what,ro\n", &options);
    assert!(import.table.is_none() && import.compilation.diagnostics.count(Severity::Error) == 1);
}

/// Generates valid and invalid cells like those of real lists.
fn cell() -> impl Strategy<Value = String> {
    const CELLS: [&str; 70] = [
        "",
        "-",
        "0",
        "1",
        "2",
        "40001",
        "40002-40003",
        "30001",
        "10001",
        "0x10",
        "10h",
        "12.3",
        "4x0001",
        "65535",
        "70000",
        "u16",
        "INT16",
        "uint32",
        "float32",
        "bool",
        "string16",
        "string",
        "u8[3]",
        "REAL",
        "BYTE",
        "uint64",
        "R",
        "R/W",
        "WO",
        "const",
        "rpm",
        "0.1 V",
        "°C",
        "x/y",
        "0.1",
        "0,1",
        "x10",
        "/100",
        "1/10",
        "10^-2",
        "-1",
        "-5",
        "3.5",
        "400,5",
        "1e9",
        "0=Off, 1=On",
        "Bit 0: a; Bit 1: b",
        "0..100",
        "-40-85",
        "0xFFFF",
        "0x8000",
        "CDAB",
        "little endian",
        "03/06",
        "holding",
        "coil",
        "a",
        "b",
        "Speed",
        "{n}",
        "$x",
        "\"q\"",
        "a\nb",
        "é",
        "2000h",
        "18446744073709551615",
        "true",
        "reserved",
        "3-7: x",
        "0: a; 0: b",
    ];
    prop_oneof![4 => prop::sample::select(&CELLS[..]).prop_map(str::to_owned), 1 => "\\PC{0,12}"]
}

const TITLES: [&str; 30] = [
    "Name",
    "Address",
    "Register",
    "Index",
    "Sub",
    "Parameter number",
    "Bit",
    "FC",
    "Type",
    "Length",
    "Bytes",
    "Byte order",
    "Word order",
    "Unit",
    "Scale",
    "Gain",
    "SF",
    "Decimals",
    "Offset",
    "Min",
    "Max",
    "Range",
    "Default",
    "R/W",
    "Invalid",
    "Values",
    "Bits",
    "Chapter",
    "Notes",
    "Repeat",
];

#[test]
fn limits_with_a_decimal_point_are_physical() {
    let list = "Address;Name;Type;Unit;Factor;Min;Max;Default\n40001;Set point;INT16;°C;0.1;-20.0;200.0;25.0\n";
    let table = read(list).table.expect("a table");
    assert!(table.contains("min = -200, max = 2000, default = 250"), "{table}");
    // If addresses also end with `.0`, the ending `.0` of a limit does not indicate a physical value.
    let list = list.replace("40001;", "40001.0;");
    let table = read(&list).table.expect("a table");
    assert!(table.contains("min = -20, max = 200, default = 25"), "{table}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// `check` must report no error in an imported table, regardless of the content of the cells.
    #[test]
    fn tables_of_any_cells_are_accepted(
        titles in prop::sample::subsequence(&TITLES[..], 4..16).prop_shuffle(),
        lines in prop::collection::vec(prop::collection::vec(cell(), 16), 1..12),
    ) {
        let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
        let line = |cells: Vec<String>| cells.join(";") + "\n";
        let mut list = line(titles.iter().map(|title| quoted(title)).collect());
        for cells in &lines {
            list += &line(cells.iter().take(titles.len()).map(|cell| quoted(cell)).collect());
        }
        if let Some(table) = read(&list).table {
            let options = Options::default();
            let compilation = check(Source::new("list.toml", table.clone().into_bytes()), &options);
            let errors = compilation.diagnostics.list().iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
            let errors: Vec<String> = errors.map(|diagnostic| compilation.one_line(diagnostic)).collect();
            prop_assert_eq!(errors, Vec::<String>::new(), "{}\n{}", list, table);
            prop_assert!(compilation.rust(&options.rust).is_some());
        }
    }

    /// The import must not panic on any text.
    #[test]
    fn any_text_is_read(text in "\\PC*|(Name|Address|Type|[0-9.x,;\t\"\n-]){0,60}") {
        read(&text);
    }
}

/// Returns the number of diagnostics with the given code.
fn count(import: &Import, code: &str) -> usize {
    findings(import).iter().filter(|(.., other)| *other == code).count()
}

#[test]
fn lines_of_a_list_that_stand_for_many_items() {
    let list = |lines: usize| {
        let line = |at: usize| format!("{},P{at},u8,1000\n", at * 1000);
        let text = "Param,Name,Type,Repeat\n".to_owned() + &(0..lines).map(line).collect::<String>();
        let imported = read(&text);
        let table = imported.table.as_deref().expect("a table");
        (count(&imported, "CSV004"), table.lines().filter(|line| line.contains("count = 1000")).count())
    };
    let most = limits::MAX_DERIVED_ITEMS / 1000;
    assert_eq!(list(most), (0, most));
    assert_eq!(list(most + 9), (9, most));
}

#[test]
fn names_of_repeated_lines_that_are_taken() {
    // Each of the `used` lines has a name that would otherwise be generated for the second repeated row.
    let tried = limits::MAX_DERIVED_ITEMS / 1000;
    let lines = |used: usize| {
        let used: String = (0..used).map(|at| format!("{},P 1000 {},u8,\n", 5000 + at, at + 2)).collect();
        let text = format!("Param,Name,Type,Repeat\n0,P,u8,1000\n{used}1000,P,u8,1000\n");
        let imported = read(&text);
        let rows =
            imported.table.as_deref().expect("a table").lines().filter(|line| line.contains("count = 1000")).count();
        (count(&imported, "CSV004"), rows)
    };
    assert_eq!(lines(tried - 1), (0, 2));
    assert_eq!(lines(tried + 9), (1, 1));
}

// The following tests import excerpts of the AEC Vector Step manual. The number in a test's name is the number of an item in
// section 4 of the notes on the manual.

/// Imports rows of a list that has the column titles of the manual's register tables.
fn manual(rows: &str) -> Import {
    let titles =
        "Indirizzo Modbus / Profibus\tIndirizzo CAN EtherCAT Profinet\tNome Registro\tDescrizione\tU.M.\tValore \
                  Minimo\tValore Massimo\tTipo\tNote\n";
    read_as("list.tsv", format!("{titles}{rows}"), &lexibus_import::Options::default())
}

/// Returns the row lines of an imported table.
fn rows(import: &Import) -> Vec<&str> {
    let lines = import.table.as_deref().expect("a table").lines();
    lines.skip_while(|line| *line != "[chapters.registers]").skip(1).take_while(|line| !line.is_empty()).collect()
}

#[test]
fn item_53_a_quote_that_would_swallow_seven_rows() {
    let import = manual(
        "10130-31\t0x4792\tRthetainit\tTheta acquisito da resolver durante allineamento (solo BMD con resolver)\t\t\t\tSigned32\tRW SAVE\n\
         10132\t0x4794\tRthetaack\tFlag segnalazione theta da resolver acquisito (solo BMD con resolver)\t\t\t\tUnsigned16\t\"RW SAVE\n\
         10133\t0x4795\tRrslvact\tValore attuale resolver (solo BMD con resolver)\t\t\t\tUnsigned16\tRO\n\
         10134-35\t0x4796\tRrslvoffsetsin\tCompensazione offset SIN resolver (solo con resolver)\t\t\t\tSigned32\tRW SAVE\n\
         10136-37\t0x4798\tRrslvoffsetcos\tCompensazione offset COS resolver (solo con resolver)\t\t\t\tSigned32\tRW SAVE\n\
         10193\t0x47D1\tRrslvcorr\tCorrezione resolver (Solo con Resolver)\t\t\t\tSigned16\tRW SAVE\n\
         10194-95\t0x47D2-D3\tRrslvrawangleout\tAngolo uscita resolver senza correzione (Solo con Resolver)\t\t\t\tSigned32\tRO\n\
         10196-97\t0x47D4-D5\tRrslvsinfirot\tValore Seno in uscita filtro FIR (Solo con Resolver)\t\t\t\tSigned32\tRO\n\
         10198-99\t0x47D6-D7\tRrslvcosfirot\tValore Coseno in uscita filtro FIR (Solo con Resolver)\t\t\t\tSigned32\tRO\n\
         ",
    );
    let expected = [(1, 1, "CSV007"), (3, 108, "CSV008"), (8, 10, "CSV003"), (9, 10, "CSV003"), (10, 10, "CSV003")];
    assert_eq!(findings(&import), expected);
    let message = &import.compilation.diagnostics.list()[1].message;
    assert_eq!(message, "the quotation mark is not closed in its cell");
    let names: Vec<&str> = rows(&import).iter().filter_map(|row| row.split(' ').next()).collect();
    assert_eq!(names.len(), 9, "{names:?}");
    assert!(rows(&import)[1].contains(r#"(solo BMD con resolver). \"RW SAVE" }"#), "{:?}", rows(&import)[1]);
    // Item 21: the range is not an index, so the row has no object address.
    assert!(
        rows(&import)[6].starts_with(r#"Rrslvrawangleout = { reg = "10194-10195", "#)
            && !rows(&import)[6].contains("obj")
    );
}

#[test]
fn item_53_quotes_around_whole_cells_and_at_the_end() {
    let import = manual(
        "10004\t0x4714\tRindregset\tMappatura registri 0= Revisione 1\"\t\t\t\tUnsign16\tWORD RO\n\
         10012\t0x471C\tRenccamfbk\t\"Encoder feedback per funzioni camma/winding 0= Encoder 1 1= Encoder 2 2= Encoder 3 3= Encoder assoluto\"\t\tDefault 1\t\tUnsigned16\t\"WORD RW SAVE\"\n\
         10081\t0x4761\tRprofinetnamechr\tCarattere puntato della stringa \"nome dispositivo PROFINET\"\t\t\t\tUnsigned16\tRW\n\
         ",
    );
    assert_eq!(findings(&import), [(1, 1, "CSV007"), (2, 63, "CSV003"), (3, 131, "CSV003")]);
    let rows = rows(&import);
    assert_eq!(rows.len(), 3);
    assert!(rows[0].contains(r#"0= Revisione 1\". WORD RO"#), "{}", rows[0]);
    assert!(rows[1].contains(r#"3= Encoder assoluto. WORD RW SAVE" }"#), "{}", rows[1]);
}

#[test]
fn item_25_a_row_of_ten_cells_and_a_title_of_none() {
    let titles = "Indirizzo Modbus / Profibus\tIndirizzo CAN EtherCAT Profinet\tNome Registro\tDescrizione\tU.M.\tValore Minimo\tValore Massimo\tTipo\tNote\t\n";
    let rows = "0198\t0x20C6\tRindtype\t<p>Tipo indexer</p> <p>0: SMD30.06LIM 77: SMD12.04LIC</p>\t<p>78: SMD12.04LIP 125: DMD</p>\t\t\t\t<p>Holding Register (16bit) Unsigned16</p> <p>Codifica HI-BYTE 0: SMD 1: DMD 2: BMD</p> <p>Codifica b7 LO-BYTE: 0: I (ex SMD506I) 1: A (ex SMD506S)</p>\tWORD NO MAP RO\n\
                10000\t0x4710\tRindfamily\tFamiglia azionamento. (Da fw 5.50 il registro 198 viene letto a 0xFFFF) Esempio: -1204 -2204 -5206\t\t\t\tUnsign16\tWORD RO\n";
    let import = read_as("list.tsv", format!("{titles}{rows}"), &lexibus_import::Options::default());
    let expected = [(1, 1, "CSV007"), (2, 1, "CSV007"), (2, 1, "CSV005"), (2, 80, "CSV003"), (3, 127, "CSV003")];
    assert_eq!(findings(&import), expected);
    let list = import.compilation.diagnostics.list().iter();
    let messages: Vec<&str> = list.map(|diagnostic| diagnostic.message.as_str()).collect();
    assert!(messages.contains(&"the line has 10 cells, but the list has 9 column titles"), "{messages:?}");
    assert!(!import.table.as_deref().expect("a table").contains("[units]"));
}

#[test]
fn item_26_a_line_of_dashes() {
    let import = manual(
        "10076\t0x475C\tRenc3code\tCodice modello encoder 3 0=CUSTOM 1= T-C 10= TO0512L05C 11= TO0512P24C 12=TO1000L05C\t\t\t\tUnsigned16\tRW SAVE\n\
         -------\t--------\t------------------\t-----------------------------------------------------------------------------------------------------\t--\t--\t--\t------------\t------------\n\
         ",
    );
    let codes: Vec<_> = findings(&import).into_iter().filter(|(line, ..)| *line == 3).map(|(.., code)| code).collect();
    assert_eq!(codes, ["CSV004", "CSV003", "CSV003"]);
    let message = &import.compilation.diagnostics.list()[1].message;
    assert_eq!(message, "`-------` is not a register address");
    assert!(rows(&import)[1].starts_with("# the address cannot be read: ------- | "));
}

#[test]
fn items_18_and_19_indices_beside_numbers() {
    // The printed address is the wire address on Modbus. The object indices in the second column are not wire addresses.
    let import = manual(
        "10144\t0x4800\tRalmbuffres\tReset buffer storico allarmi\t\t\t\tUnsigned16\tRW SAVE\n\
         10145\t0x4801\tRalmbuffptr\tPuntatore al buffer storico allarmi\t\t0\t15\tUnsigned16\tRW SAVE\n\
         10146-47\t0x4802\tRalmbufftime\tTimestamp allarme puntato da Ralmbuffptr\t\t\t\tUnsigned32\tRO\n\
         10148-49\t0x4803\tRalmbuffcode\tCodice allarme puntato da Ralmbuffptr\t\t\t\tUnsigned32\tRO\n\
         0166\t0x20A\tRprofists\tStato della comunicazione Profibus 0 = Disabilitato 1 = Parametrizzazione 2 = Configurazione 3 = Data Exchange FF = Fatal Error\t\t\t\tUnsigned16\tWORD NO MAP RO\n\
         ",
    );
    assert_eq!(findings(&import), [(1, 1, "CSV007"), (5, 1, "CSV003"), (6, 6, "CSV003")]);
    let message = &import.compilation.diagnostics.list()[1].message;
    assert_eq!(message, "the index is 0x4803, but 3 of 4 lines suggest 0x4804");
    let table = import.table.as_deref().expect("a table");
    assert!(table.contains("modbus = { table = \"holding\", first = 0 }"), "{table}");
    let device = check(Source::new("list.toml", table.as_bytes().to_vec()), &Options::default());
    let list = device.diagnostics.list().iter();
    let codes: Vec<_> = list.map(|diagnostic| (diagnostic.code.id, diagnostic.message.as_str())).collect();
    let series = "the row has object 0x4803, but the neighboring rows suggest 0x4804";
    assert_eq!(codes, [("TAB001", series)]);
    let device = device.catalog.expect("a catalog").devices.remove(0);
    let bindings = &item(&device, "Ralmbuffres").bindings;
    assert!(bindings.iter().any(|binding| matches!(binding, Binding::Object { index: 0x4800, .. })), "{bindings:?}");
    let is_register = |binding: &Binding| matches!(binding, Binding::Register(register) if register.address == 10144);
    assert!(bindings.iter().any(is_register), "{bindings:?}");
}

#[test]
fn item_60_a_default_in_the_cell_of_a_limit() {
    let import = manual(
        "10014\t0x471E\tRalarmreact\tFunzionalità del drive al verificarsi di un allarme -4 = Abort in rampa di emergenza e Current off a seconda dell'allarme -3 = Abort in rampa di emergenza e current off -2 = Stop in rampa e current off -1 = Current off 0 = Current off 1 = Stop in rampa e current off 2 = Abort in rampa di emergenza e current off\t\t-4 (Default -4)\t2\tSigned16\tWORD RW SAVE\n\
         0428\t0x21AC\tRoutenable\tMaschera abilitazione uscite digitali Bit0: Out0 Bit1: Out1 Bit8: Out8 Bit=0 Uscita disabilitata Bit=1 Uscita abilitata\t\tDefault 65535\t\tUnsigned16\tWORD SAVE\n\
         0577\t0x2241\tRencalignsteps\tNumero passi eseguiti durante fase allineamento encoder\tStep\t(Default 4)\t\tUnsigned16\tWORD SAVE\n\
         10010\t0x471A\tRencmotfbk\tEncoder feedback motore per chiusura anello 0= Encoder 1 1= Encoder 2 2= Encoder 3 3= Encoder assoluto\t\t(Default 0)\t\tUnsigned16\tWORD RW SAVE\n\
         10026\t0x472A\tRenc2pulse\tImpulsi giro encoder 2\tImp.\tDefault 512\t\tUnsigned16\tRW SAVE\n\
         10028\t0x472C\tRencabsframembit\tLunghezza trama encoder assoluto\tBit\tDefault 25\t\tUnsigned16\tRW SAVE\n\
         10029\t0x472D\tRencabsposbit\tLunghezza trama conteggio implusi su giro\tBit\tDefault 12\t\tUnsigned16\tRW SAVE\n\
         10030\t0x472E\tRencabsturnsbit\tLunghezza trama conteggio giri\tBit\tDefault 13\t\tUnsigned16\tRW SAVE\n\
         0042-43\t0x202A\tRtestintmot\tRegistro per controllo modalita' di comunicazione 32bit Intel o Motorola. Il valore di questo registro e' fisso a 1234567890 (0x499602D2) Eseguendo una lettura a 32bit di questo registro si puo' ricavare se la comunicazione e' impostata in modo Intel o Motorola a seconda del risultato ottenuto.\t\t1234567890 0x499602D2\t1234567890 0x499602D2\tHolding Register (32bit)\tWORD RO\n\
         ",
    );
    let cells: Vec<&str> = import
        .compilation
        .diagnostics
        .list()
        .iter()
        .filter(|diagnostic| diagnostic.code.id == "CSV003" && !diagnostic.message.ends_with("type"))
        .filter_map(|diagnostic| diagnostic.message.split('`').nth(1))
        .collect();
    let printed = ["-4 (Default -4)", "Default 65535", "(Default 4)", "(Default 0)", "Default 512", "Default 25"];
    let more = ["Default 12", "Default 13", "1234567890 0x499602D2", "1234567890 0x499602D2"];
    assert_eq!(cells, [printed.as_slice(), &more].concat());
}

#[test]
fn units_that_nobody_knows_are_told() {
    let import = read("Register,Name,Unit\n1,a,Imp. Enc.\n2,b,Imp. Enc.\n3,c,V\n4,d,a = b\n");
    let list = import.compilation.diagnostics.list().iter();
    let messages: Vec<&str> = list.map(|diagnostic| diagnostic.message.as_str()).collect();
    assert!(
        messages.contains(&"the unit `Imp. Enc.` is unknown: it is added to `[units]` without a scale"),
        "{messages:?}"
    );
    assert!(messages.contains(&"`a = b` is not a unit"), "{messages:?}");
    assert_eq!(messages.iter().filter(|message| message.contains("Imp. Enc.")).count(), 1);
}

#[test]
fn an_index_beside_a_number_without_a_title_that_says_so() {
    let import = read("Register,Address,Name,Type,Access\n198,0x20C6,a,u16,rw\n199,0x20C7,b,u16,rw\n");
    assert_eq!(findings(&import), [(2, 5, "CSV007")]);
    assert_eq!(rows(&import)[0], r#"a = { reg = 198, obj = 0x20C6, type = "u16", access = "rw" }"#);
    // The second address is not an object index if two columns contain addresses of the same register.
    let import = read("Register,Address,Name,Type,Access\n40001,0x0000,a,u16,rw\n40002,0x0001,b,u16,rw\n");
    assert_eq!((findings(&import), import.table.unwrap().contains("first = 40001")), (vec![], true));
}
