//! Recognizes the columns of a list by their titles.

use std::fmt;

use lexibus_codegen::text::edit_distance;

use super::records::{Record, Records};

macro_rules! fields {
    ($($(#[$doc:meta])* $variant:ident $name:literal [$($title:literal)*])*) => {
        /// An attribute of a register that a column can contain.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Field {
            $($(#[$doc])* $variant,)*
        }

        /// All fields with their names and possible column titles.
        const FIELDS: &[(Field, &str, &[&str])] = &[$((Field::$variant, $name, &[$($title),*])),*];
    };
}

fields! {
    /// Name of the register.
    Name "name" [
        "name" "register name" "signal" "signal name" "parameter" "parameter name" "tag" "tag name" "variable"
        "variable name" "variablenname" "item" "label" "data name" "point" "point name" "object name" "title" "symbol"
        "field name" "mnemonic" "bezeichnung" "parametername" "registername" "signalname" "nome" "nome parametro"
        "nome registro" "nome variabile" "parametro" "variabile" "denominazione" "etichetta" "nom" "nombre"
    ]
    /// Description of the register.
    Doc "doc" [
        "description" "doc" "documentation" "note" "notes" "remark" "remarks" "comment" "comments" "explanation"
        "meaning" "details" "detail" "desc" "info" "information" "function" "beschreibung" "bemerkung" "bemerkungen"
        "kommentar" "anmerkung" "hinweis" "bedeutung" "funktion" "descrizione" "nota" "commento" "commenti"
        "osservazioni" "significato" "funzione" "descripción" "beschrijving"
    ]
    /// Address of the register.
    Reg "reg" [
        "register" "address" "addr" "reg" "register address" "modbus address" "modbus register" "modbus"
        "register number" "register no" "reg no" "reg addr" "reg address" "start address" "starting address"
        "start register" "start" "register start" "data address" "address dec" "address hex" "hex address" "dec address"
        "decimal address" "hexadecimal address" "pdu address" "protocol address" "offset address" "holding register"
        "input register" "no of register" "adresse" "registeradresse" "modbus adresse" "modbusadresse" "startadresse"
        "registernummer" "register nr" "indirizzo" "indirizzo modbus" "indirizzo registro" "registro" "registro modbus"
        "numero registro" "n registro" "ind" "dirección" "direccion" "adres"
    ]
    /// Index of the object.
    Index "index" ["index" "object index" "object" "idx" "indice" "objekt" "oggetto" "od index" "canopen index" "obj"]
    /// Sub-index of the object.
    Sub "sub" ["sub" "subindex" "sub index" "sub idx" "subidx" "si" "sottoindice" "sub indice" "unterindex"]
    /// Number of the parameter in a command protocol.
    Param "param" [
        "parameter number" "parameter no" "param" "param no" "par no" "parameternummer" "parameter nr" "pnu"
        "numero parametro"
    ]
    /// Bits within the register, if the row describes only a part of the register.
    Part "part" [
        "bit" "bit no" "bit number" "bit position" "bit offset" "mask" "bit mask" "bitmask" "bitposition" "bit nr"
        "posizione bit" "maschera"
    ]
    /// Modbus table of the register.
    Table "table" [
        "table" "function code" "functioncode" "fc" "fcode" "modbus function" "register type" "registertype"
        "function codes" "modbus table" "object type" "register table" "modbus function code" "funktionscode"
        "registertyp" "codice funzione" "tipo registro" "tipo di registro" "area" "kind"
    ]
    /// Data type of the register.
    Type "type" [
        "type" "data type" "datatype" "format" "data format" "value type" "variable type" "numeric type" "dtype"
        "datentyp" "typ" "tipo" "tipo dato" "tipo di dato" "tipo dati" "formato" "tipo variabile"
    ]
    /// Length of the value in registers.
    Words "words" [
        "words" "length" "len" "size" "registers" "number of registers" "no of registers" "num registers" "reg count"
        "register count" "quantity" "qty" "count" "number of words" "no of words" "word count" "size words"
        "length words" "register length" "width" "anzahl" "länge" "anzahl register" "registeranzahl" "größe" "lunghezza"
        "numero registri" "n registri" "dimensione" "quantità"
    ]
    /// Length of the value in bytes.
    Bytes "bytes" ["bytes" "size bytes" "length bytes" "number of bytes" "no of bytes" "byte count" "byte"]
    /// Length of the value in bits.
    Width "width" ["bit length" "bit size" "size bits" "length bits" "bit width" "number of bits" "bitlänge"]
    /// Order of words and bytes.
    Order "order" [
        "order" "byte order" "byteorder" "word order" "wordorder" "endianness" "endian" "swap" "word swap" "byte swap"
        "byte word order" "ordine byte" "ordine word" "byte reihenfolge" "wortreihenfolge"
    ]
    /// Unit of the value.
    Unit "unit" [
        "unit" "units" "unit of measure" "unit of measurement" "uom" "engineering unit" "eng unit" "eu" "measure unit"
        "einheit" "einheiten" "um" "u m" "unità" "unita" "unità di misura" "unita di misura" "unidad" "eenheid" "unité"
    ]
    /// Scale factor from raw to physical value.
    Scale "scale" [
        "scale" "scaling" "factor" "scale factor" "scaling factor" "multiplier" "multiplication factor" "resolution"
        "precision" "conversion" "conversion factor" "coefficient" "multiply" "faktor" "skalierung" "skalierungsfaktor"
        "auflösung" "multiplikator" "scala" "fattore" "fattore di scala" "risoluzione" "moltiplicatore" "coefficiente"
        "fattore di conversione"
    ]
    /// Divisor of the raw value.
    Divisor "divisor" ["divisor" "divider" "divide" "divide by" "gain" "teiler" "divisore" "guadagno"]
    /// Decimal exponent of the scale factor, or a reference to the register that contains the exponent.
    Exponent "exponent" ["sf" "exponent" "scale exponent" "power of ten" "sunssf" "esponente"]
    /// Number of decimal places of the value.
    Decimals "decimals" [
        "decimals" "decimal places" "decimal" "dec" "digits" "dp" "decimal point" "nachkommastellen" "dezimalstellen"
        "decimali" "cifre decimali"
    ]
    /// Physical value that corresponds to raw value 0.
    Offset "offset" ["offset" "value offset" "bias" "scale offset" "scaling offset" "nullpunkt"]
    /// Minimum of the value.
    Min "min" [
        "min" "minimum" "min value" "minimum value" "low limit" "lower limit" "lower" "low" "minimalwert" "untergrenze"
        "minwert" "minimo" "valore minimo" "val min" "limite inferiore" "mín" "mini"
    ]
    /// Maximum of the value.
    Max "max" [
        "max" "maximum" "max value" "maximum value" "high limit" "upper limit" "upper" "high" "maximalwert" "obergrenze"
        "maxwert" "massimo" "valore massimo" "val max" "limite superiore" "máx" "maxi"
    ]
    /// Minimum and maximum of the value.
    Range "range" [
        "range" "value range" "min max" "limits" "min max range" "valid range" "setting range" "data range"
        "wertebereich" "bereich" "campo" "intervallo" "range valori" "campo di variazione" "min max value"
    ]
    /// Default value of the register.
    Default "default" [
        "default" "default value" "initial" "initial value" "factory" "factory default" "factory setting"
        "factory value" "preset" "def" "init" "reset value" "standardwert" "werkseinstellung" "standard"
        "voreinstellung" "vorgabe" "valore di default" "predefinito" "valore predefinito" "valore iniziale"
    ]
    /// Access rights of the register.
    Access "access" [
        "access" "r w" "rw" "read write" "ro rw" "access type" "access mode" "access rights" "permission" "permissions"
        "attribute" "attributes" "attr" "mode" "property" "read write property" "r o" "ro" "r" "r w access" "zugriff"
        "zugriffsart" "lesen schreiben" "l s" "accesso" "lettura scrittura" "tipo accesso" "attributo" "r w ro"
    ]
    /// Raw value that means "not available".
    Na "na" [
        "invalid" "invalid value" "na value" "n a value" "not available" "error value" "null value" "nan value"
        "not implemented" "ungültig"
    ]
    /// Names of the register's values.
    Enum "enum" [
        "enum" "enumeration" "values" "enumerations" "options" "option" "possible values" "value description"
        "value meaning" "selection" "states" "codes" "coding" "value list" "values description" "value" "werte"
        "auswahl" "wertebedeutung" "valori" "enumerazione" "opzioni" "valori ammessi" "valore" "codifica"
    ]
    /// Names of the register's bits.
    Bits "bits" [
        "bits" "bit field" "bitfield" "bit description" "bit meaning" "bit definition" "flags" "bit description meaning"
        "significato bit"
    ]
    /// Chapter that contains the row.
    Chapter "chapter" [
        "chapter" "group" "category" "section" "block" "module" "menu" "function group" "class" "subsystem" "gruppe"
        "kategorie" "kapitel" "bereich gruppe" "gruppo" "categoria" "sezione" "capitolo"
    ]
    /// Page or section of the manual that describes the row.
    Cite "cite" ["cite" "page" "page no" "manual page" "seite" "pagina" "pag"]
    /// Name of the register in the language of the manual.
    Orig "orig" ["orig" "original" "original name" "originalname" "nome originale" "local name"]
    /// Number of times that the row is repeated at consecutive addresses.
    Count "count" ["repeat" "repeats" "instances" "number of instances" "array size" "array length" "elements"]
}

impl Field {
    /// Returns the field with this name, ignoring case.
    pub fn find(name: &str) -> Option<Field> {
        FIELDS.iter().find(|(_, known, _)| known.eq_ignore_ascii_case(name)).map(|&(field, ..)| field)
    }

    /// Returns the name of the field.
    pub fn name(self) -> &'static str {
        FIELDS.iter().find(|(field, ..)| *field == self).map_or("", |&(_, name, _)| name)
    }

    /// Returns the names of all fields.
    pub fn names() -> impl Iterator<Item = &'static str> {
        FIELDS.iter().map(|&(_, name, _)| name)
    }

    /// Returns the field name that is most similar to `name`, or `None` if no field name is similar enough.
    pub fn similar(name: &str) -> Option<&'static str> {
        let best = Field::names().map(|known| (edit_distance(name, known), known)).min()?;
        (best.0 * 2 <= name.chars().count()).then_some(best.1)
    }

    /// Returns whether the field contains an address of the row.
    pub fn is_address(self) -> bool {
        matches!(self, Field::Reg | Field::Index | Field::Param)
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A column of the list whose field was recognized.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Column {
    pub field: Field,
    /// Position of the column in a line.
    pub at: usize,
    /// True if the title states that the numbers are hexadecimal.
    pub is_hex: bool,
    /// Detail that the title of the column states: an order of words only, or a gain instead of a divisor.
    pub hint: Hint,
}

/// A detail that the title of a column states.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Hint {
    #[default]
    None,
    Words,
    Gain,
}

/// The columns of a list.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    pub list: Vec<Column>,
    /// Position of the line with the titles. `None` if no such line was found. The columns are then those that the
    /// caller identifies by number.
    pub header: Option<usize>,
    /// Number of cells per line.
    pub width: usize,
}

impl Columns {
    /// Returns the first column that was recognized as `field`.
    pub fn get(&self, field: Field) -> Option<Column> {
        self.all(field).next()
    }

    /// Returns all columns that were recognized as `field`.
    pub fn all(&self, field: Field) -> impl Iterator<Item = Column> + '_ {
        self.list.iter().copied().filter(move |column| column.field == field)
    }

    /// Returns whether at least one column contains addresses.
    pub fn has_address(&self) -> bool {
        self.list.iter().any(|column| column.field.is_address())
    }

    /// Returns a score: the number of recognized columns, plus four if one of them contains addresses.
    pub fn score(&self) -> usize {
        self.list.len() + if self.has_address() { 4 } else { 0 }
    }
}

/// Number of lines at the start of the list in which the import searches for the titles.
const PREAMBLE: usize = 40;

/// Finds the line of titles and determines the field of each column.
///
/// # Errors
///
/// Returns the name of a column in `map` that the list does not contain.
pub(super) fn find<'m>(records: &Records, map: &'m [(Field, String)]) -> Result<Columns, &'m str> {
    let by_number = map.iter().all(|(_, column)| number(column).is_some());
    let (mut best, mut missing) = (Columns::default(), None);
    for (line, record) in records.list.iter().take(PREAMBLE).enumerate() {
        // Columns that the caller identifies by number exist in any line. A line of titles must therefore contain at
        // least one known title.
        if by_number && plain(record).is_empty() {
            continue;
        }
        match titles(record, map) {
            Ok(columns) if columns.score() > best.score() => best = Columns { header: Some(line), ..columns },
            Ok(_) => {}
            Err(name) => missing = Some(name),
        }
    }
    match missing {
        _ if best.list.len() > 1 && best.has_address() => Ok(best),
        Some(name) => Err(name),
        None => {
            let width = records.list.iter().map(|record| record.cells.len()).max().unwrap_or(0);
            let list = map.iter().filter_map(|(field, column)| Some(column_of(*field, number(column)?, "")));
            Ok(Columns { list: list.collect(), header: None, width })
        }
    }
}

/// Returns the position of a column that is identified by number. `#1` is the first column.
fn number(column: &str) -> Option<usize> {
    column.strip_prefix('#')?.trim().parse::<usize>().ok()?.checked_sub(1)
}

fn column_of(field: Field, at: usize, title: &str) -> Column {
    let words: Vec<&str> = title.split(' ').collect();
    let is_hex = words.iter().any(|word| matches!(*word, "hex" | "hexadecimal" | "hexadezimal" | "esadecimale" | "0x"));
    let hint = match field {
        Field::Order if words.iter().any(|word| word.starts_with("word") || word.starts_with("wort")) => Hint::Words,
        Field::Divisor if words.iter().any(|word| matches!(*word, "gain" | "guadagno")) => Hint::Gain,
        _ => Hint::None,
    };
    Column { field, at, is_hex, hint }
}

/// Returns the columns whose titles are known.
fn plain(record: &Record) -> Vec<Column> {
    let mut list: Vec<Column> = Vec::new();
    for (at, cell) in record.filled() {
        let title = normal(&cell.text);
        let Some(field) = field_of(&title) else { continue };
        // A second address column contains wire addresses or object indices. Several columns may contain documentation.
        let before = list.iter().filter(|column| column.field == field).count();
        let many = match field {
            Field::Doc => usize::MAX,
            Field::Reg => 2,
            _ => 1,
        };
        if before < many {
            list.push(column_of(field, at, &title));
        }
    }
    list
}

fn titles<'m>(record: &Record, map: &'m [(Field, String)]) -> Result<Columns, &'m str> {
    let mut list = plain(record);
    for (field, name) in map {
        let by_title = || record.filled().find(|(_, cell)| normal(&cell.text) == normal(name)).map(|(at, _)| at);
        let Some(at) = number(name).filter(|&at| at < record.cells.len()).or_else(by_title) else {
            return Err(name.as_str());
        };
        let is_mapped = |column: &Column| {
            let names = map.iter().filter(|(mapped, _)| *mapped == column.field);
            names
                .clone()
                .any(|(_, name)| normal(name) == normal(record.text(column.at)) || number(name) == Some(column.at))
        };
        list.retain(|column| column.at != at && (column.field != *field || *field == Field::Doc || is_mapped(column)));
        list.push(column_of(*field, at, &normal(record.text(at))));
    }
    // The last title determines the number of columns.
    let width = record.filled().last().map_or(0, |(at, _)| at + 1);
    Ok(Columns { list, header: None, width })
}

/// Converts a title to lowercase words without punctuation, separated by single spaces.
pub(super) fn normal(title: &str) -> String {
    let letters = title.chars().map(|letter| if letter.is_alphanumeric() { letter } else { ' ' });
    let lower = letters.collect::<String>().to_lowercase();
    lower.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Words in titles that do not identify a column.
const FILLERS: [&str; 24] = [
    "hex",
    "dec",
    "decimal",
    "hexadecimal",
    "hexadezimal",
    "dezimal",
    "esadecimale",
    "decimale",
    "the",
    "of",
    "in",
    "number",
    "nr",
    "no",
    "modbus",
    "raw",
    "value",
    "bit",
    "text",
    "en",
    "de",
    "it",
    "1",
    "0",
];

/// Returns whether a title means an object address on CANopen or EtherCAT. Returns false for Modbus addresses.
fn is_fieldbus(title: &str) -> bool {
    let has = |list: &[&str]| title.split(' ').any(|word| list.contains(&word));
    has(&["address", "adresse", "indirizzo", "addr"])
        && has(&["can", "canopen", "ethercat", "coe", "sdo"])
        && !has(&["modbus", "profibus", "rtu", "tcp"])
}

fn field_of(title: &str) -> Option<Field> {
    let exact = |title: &str| FIELDS.iter().find(|(_, _, titles)| titles.contains(&title)).map(|&(field, ..)| field);
    if title.is_empty() {
        return None;
    }
    let glued = || exact(&title.replace(' ', ""));
    let shorter = || {
        let words: Vec<&str> = title.split(' ').filter(|word| !FILLERS.contains(word)).collect();
        exact(&words.join(" ")).filter(|_| !words.is_empty())
    };
    let singular = || exact(title.strip_suffix('s')?);
    let by_word = || {
        let words = || title.split(' ');
        let has = |list: &[&str]| words().any(|word| list.contains(&word));
        match () {
            () if words().count() > 4 => None,
            // For example, the title "Indirizzo CAN EtherCAT Profinet" means a column of object indices.
            () if is_fieldbus(title) => Some(Field::Index),
            () if has(&["subindex", "sub"]) => Some(Field::Sub),
            () if has(&["address", "adresse", "indirizzo", "addr"]) => Some(Field::Reg),
            () if has(&["unit", "einheit", "unità"]) && !has(&["id"]) => Some(Field::Unit),
            () if has(&["type", "typ", "datentyp", "datatype", "tipo"]) => Some(Field::Type),
            () if has(&["access", "zugriff", "accesso"]) => Some(Field::Access),
            () if has(&["description", "beschreibung", "descrizione", "comment", "remarks"]) => Some(Field::Doc),
            () if has(&["name", "nome", "bezeichnung"]) => Some(Field::Name),
            () => None,
        }
    };
    exact(title).or_else(glued).or_else(shorter).or_else(singular).or_else(by_word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_in_three_languages() {
        let cases = [
            ("Register Address (Hex)", Field::Reg),
            ("Modbus-Adresse", Field::Reg),
            ("Indirizzo", Field::Reg),
            ("DATA_TYPE", Field::Type),
            ("Datentyp", Field::Type),
            ("U.M.", Field::Unit),
            ("Unit (SI)", Field::Unit),
            ("Valore Minimo", Field::Min),
            ("Valore massimo", Field::Max),
            ("R/W", Field::Access),
            ("Read/Write", Field::Access),
            ("Sub-Index", Field::Sub),
            ("Descrizione", Field::Doc),
            ("Notes", Field::Doc),
            ("Byte order", Field::Order),
            ("Scale Factor", Field::Scale),
            ("Gain", Field::Divisor),
            ("No. of registers", Field::Words),
            ("Function code", Field::Table),
            ("SF", Field::Exponent),
            ("Werkseinstellung", Field::Default),
        ];
        for (title, field) in cases {
            assert_eq!(field_of(&normal(title)), Some(field), "{title}");
        }
        for title in ["", "40001", "Pump speed", "Last change", "Customer"] {
            assert_eq!(field_of(&normal(title)), None, "{title}");
        }
    }

    #[test]
    fn every_title_is_of_one_field() {
        let mut seen = std::collections::BTreeMap::new();
        for (field, name, titles) in FIELDS {
            assert_eq!(Field::find(name), Some(*field));
            for title in *titles {
                assert_eq!(*title, normal(title));
                assert_eq!(seen.insert(*title, field), None, "{title}");
            }
        }
    }
}
