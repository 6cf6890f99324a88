//! The catalogue of diagnostic codes: the one place where a code gets its number, name, class and explanation.
//!
//! A code, once published, keeps its meaning; a retired one is never given out again.

use super::Level;

/// What kind of finding a code stands for, which decides what strict mode makes of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Class {
    /// The input can't be used; always an error.
    Error,
    /// The input broke a rule and was repaired, or a value was kept as text; an error in strict mode.
    Repair,
    /// The input was read as it stands, but is suspicious.
    Lint,
}

impl Class {
    /// One word for people.
    pub fn name(self) -> &'static str {
        match self {
            Class::Error => "error",
            Class::Repair => "repair",
            Class::Lint => "lint",
        }
    }
}

/// One kind of finding.
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct Code {
    /// Stable identifier, such as `EDS020`.
    pub id: &'static str,
    /// Stable name, such as `octal-number`.
    pub name: &'static str,
    /// What strict mode makes of it.
    pub class: Class,
    /// Its level unless a user sets another.
    pub default: Level,
    /// One line.
    pub summary: &'static str,
    /// What `lexibus explain` prints.
    pub explanation: &'static str,
}

/// The code with this identifier or name, without regard to case.
pub fn find(name: &str) -> Option<&'static Code> {
    CODES.iter().copied().find(|code| code.id.eq_ignore_ascii_case(name) || code.name.eq_ignore_ascii_case(name))
}

/// The name or identifier that is most similar to `name`, if any is similar at all.
pub fn similar(name: &str) -> Option<&'static str> {
    let name = name.to_ascii_lowercase();
    let distance = |known: &str| crate::text::edit_distance(&name, &known.to_ascii_lowercase());
    CODES
        .iter()
        .flat_map(|code| [code.id, code.name])
        .map(|known| (distance(known), known))
        .min()
        .filter(|&(distance, known)| distance * 3 <= known.len())
        .map(|(_, known)| known)
}

/// The name of a code from that of its constant: `octal-number` for `OCTAL_NUMBER`.
const fn name<const LENGTH: usize>(constant: &str) -> [u8; LENGTH] {
    let mut name = [b'-'; LENGTH];
    let mut rest = constant.as_bytes();
    while let [before @ .., last] = rest {
        if *last != b'_' {
            name[before.len()] = last.to_ascii_lowercase();
        }
        rest = before;
    }
    name
}

macro_rules! codes {
    ($($id:ident $constant:ident $class:ident $level:ident $summary:literal $explanation:literal)*) => {
        $(
            #[allow(rustdoc::broken_intra_doc_links, reason = "names of sections of an EDS have brackets")]
            #[doc = concat!("`", stringify!($id), "`: ", $summary, ".")]
            pub static $constant: Code = Code {
                id: stringify!($id),
                name: {
                    const NAME: [u8; stringify!($constant).len()] = name(stringify!($constant));
                    match std::str::from_utf8(&NAME) {
                        Ok(name) => name,
                        Err(_) => stringify!($constant),
                    }
                },
                class: Class::$class,
                default: Level::$level,
                summary: $summary,
                explanation: $explanation,
            };
        )*

        /// Every code, in the order of the catalogue.
        pub static CODES: &[&Code] = &[$(&$constant),*];
    };
}

codes! {
    IO001 UNREADABLE_FILE Error Deny "a file can't be read"
        "The operating system refused to open or read the file, or the file is larger than Lexibus reads. The message \
        quotes its reason. Check the path, the rights and, for a list of files, the working directory."
    IO002 UNKNOWN_FORMAT Error Deny "the file is no device description"
        "Neither the content nor the name of the file looks like any format that Lexibus reads: EDS, DCF (CiA 306), \
        XDD, XDC (CiA 311), ESI (ETG.2000) or GSDML. The message says what the file looks like where that is known."
    IO003 INPUT_TOO_LARGE Error Deny "the description exceeds a limit"
        "A description declares more elements, or nests them deeper, than any real device does, so that reading it \
        would take time or memory out of proportion to the file. The limits are in the documentation of \
        `lexibus_codegen::limits`."
    IO004 NOTHING_SELECTED Error Deny "the description has nothing of the selected name"
        "Devices, modules and objects can be selected by name, order code, product code and revision. Nothing in the \
        file has this one, so that the output wouldn't be what was asked for. `lexibus info` lists what there is."
    EDS001 ETHERNET_IP_EDS Error Deny "an EtherNet/IP EDS was given"
        "ODVA's EtherNet/IP, DeviceNet and ControlNet devices also come with files called EDS. They share nothing with \
        CANopen's but the name and the square brackets: their lists end in `;` and their sections are `[File]`, \
        `[Device]`, `[Params]`. Ask the vendor for the CANopen EDS of the device."
    EDS002 NOT_AN_EDS Error Deny "no CANopen section was found"
        "The file has the ending of an EDS or DCF, but not one section of CiA 306 ([DeviceInfo], an object list, or an \
        object such as [1000]). It may be empty, a link that was checked out as text, or something else."
    EDS003 JUNK_LINE Repair Warn "a line is neither a section, an entry nor a comment"
        "CiA 306 knows section headers, `Key=Value` entries and comment lines that start with `;`. Any other line is \
        skipped. Often it is a wrapped value, a merge marker or an include of some other tool."
    EDS004 ENTRY_OUTSIDE_SECTION Repair Warn "an entry stands before the first section"
        "An entry belongs to the section above it. One with no section above has no meaning and is skipped."
    EDS005 MALFORMED_HEADER Repair Warn "a section header isn't `[name]`"
        "A section header is the name of the section between `[` and `]`, with nothing but a comment behind it. A \
        header without its closing bracket is read up to the end of the line."
    EDS006 INDENTED_HEADER Repair Warn "a section header isn't in the first column"
        "CiA 306 wants `[` in the leftmost column. Some readers take an indented header for a value of the section \
        above, and lose the section."
    EDS007 DUPLICATE_SECTION Repair Warn "a section occurs twice"
        "Section names are unique, without regard to case. The entries of both are merged; where both have a key, the \
        later one wins, and EDS008 says so."
    EDS008 DUPLICATE_KEY Repair Warn "a key occurs twice in a section"
        "Keys are unique in a section, without regard to case. The last value is used, as most readers do."
    EDS009 LONG_LINE Lint Warn "a line has over 255 characters"
        "CiA 306 limits a line to 255 characters. Readers with a fixed buffer cut the line, or read the rest as a line \
        of its own."
    EDS010 ILLEGAL_SECTION_NAME Repair Warn "a section name breaks the grammar of CiA 306"
        "An object's section is its index as four hexadecimal digits, a sub-index's is `<index>sub<n>` with the \
        sub-index in hexadecimal. Neither has leading zeros beyond that, a `0x`, or blanks."
    EDS011 UNKNOWN_SECTION Lint Warn "a section has no meaning in CiA 306"
        "Lexibus keeps the entries as extension attributes of the device. Often the name is misspelt."
    EDS012 UNKNOWN_KEY Lint Allow "a key has no meaning in CiA 306"
        "Lexibus keeps the entry as an extension attribute of its object. Tools add keys of their own, so that this \
        lint is off unless asked for."
    EDS013 NOT_UTF8 Repair Warn "the file isn't ASCII or UTF-8"
        "CiA 306 allows ASCII only. This file has bytes that aren't valid UTF-8 either; they were read as \
        Windows-1252, in which German or French tools commonly write."
    EDS014 HASH_COMMENT Repair Warn "a value is followed by a `#` comment"
        "CiA 306 has no comment behind a value. Text from ` #` on was cut off the value of a key that has a fixed form \
        (a number, an access type)."
    EDS015 TRAILING_TEXT Repair Warn "text behind a value was cut off"
        "The value of this key has a fixed form, and more text follows it."
    EDS016 QUOTED_VALUE Repair Warn "a text is in quotation marks"
        "CiA 306 writes texts without quotation marks; a reader that follows it shows them as part of the name. One \
        pair was removed."
    EDS020 OCTAL_NUMBER Repair Warn "a number starts with 0 and so is octal"
        "In CiA 306, as in C, `012` is the octal number 10. Few authors mean that. Write the number in decimal or as \
        `0x…`."
    EDS021 LEADING_ZERO Repair Warn "a number starts with 0 but was read as decimal"
        "A leading zero makes a number octal. This one has the digits 8 or 9, so that it can only be meant as decimal, \
        or is the same number either way. It was read as decimal."
    EDS022 ILLEGAL_NUMBER Repair Warn "a value is no number"
        "The key wants a number (decimal, `0x` hexadecimal, or a $NODEID formula). The text is kept as it is, and no \
        number is derived from it."
    EDS023 HEX_SUFFIX Repair Warn "a hexadecimal number is written with an `h`"
        "CiA 306 writes hexadecimal numbers with `0x` in front. `NNh` was read as hexadecimal."
    EDS024 TWOS_COMPLEMENT Repair Warn "a bit pattern was given for a signed value"
        "The number doesn't fit the signed data type, but its bits do. It was read as two's complement: 0xFFFFFFFF is \
        -1 for an INTEGER32. Write the negative number."
    EDS025 OUT_OF_TYPE Lint Warn "a value doesn't fit its data type"
        "No value of this data type can be as large or small. It is kept in the IR; generated code clamps a limit to \
        the type and leaves such a default out."
    EDS026 REVERSED_NODEID Repair Warn "a formula doesn't start with $NODEID"
        "CiA 306 wants `$NODEID+0x180`; in the other order the text is no formula, and readers that follow the grammar \
        drop the value."
    EDS027 UNKNOWN_FORMULA Repair Warn "a formula has an unknown form"
        "Only sums of $NODEID and numbers are defined. The text is kept as it is. If it is another name of the \
        node-ID, name it as an alias (`--node-id-alias`)."
    EDS028 REAL_FOR_INTEGER Repair Warn "a decimal fraction was given for an integer"
        "The data type is an integer and the number has a decimal point. A fraction of zero was dropped; any other \
        value is kept as text."
    EDS029 DECIMAL_COMMA Repair Warn "a real number has a decimal comma"
        "Real numbers were read with the comma as decimal point."
    EDS030 REAL_AS_HEX Repair Warn "a hexadecimal number of odd length was given for a real"
        "For a REAL32 or REAL64, exactly 8 or 16 hexadecimal digits are read as the bits of the IEEE 754 number. With \
        another count of digits the number itself was taken."
    EDS031 DOMAIN_DEFAULT Repair Warn "a domain has a default value"
        "A DOMAIN is a block of data of any length and has no default. The text is kept as it is."
    EDS032 NOT_BOOLEAN Repair Warn "a flag is neither 0 nor 1"
        "The key is a flag. `True`, `0x1` and the like were read for what they mean."
    EDS033 UNKNOWN_ACCESS Repair Warn "an access type isn't one of ro, wo, rw, rwr, rww, const"
        "`r` was read as ro and `w` as wo; anything else leaves the item read-only, which can do no harm."
    EDS034 MISSING_ACCESS Repair Warn "an object has no access type"
        "AccessType is mandatory but for domains. Without it the item is kept read-only."
    EDS035 MISSING_DATA_TYPE Repair Warn "a variable has no data type"
        "DataType is mandatory for variables. Without it the item is kept read-only, as raw bytes."
    EDS036 UNKNOWN_DATA_TYPE Repair Warn "a data type isn't known"
        "The number is neither a basic type of CiA 301 nor an object of this file that defines a type. The item is \
        kept as raw bytes."
    EDS037 BAD_OCTETS Repair Warn "an octet string isn't hexadecimal"
        "Octet strings are pairs of hexadecimal digits. The text is kept as it is."
    EDS038 EMPTY_NAME Lint Warn "an object has no name"
        "ParameterName is mandatory. Generated code names the object by its index. In a register table, a value or a \
        bit whose label is empty is found too."
    EDS039 COMPLEX_DATA_TYPE Lint Warn "an entry has a reserved or a record data type"
        "A single value can't have a record type (0x20 to 0x23) or a reserved code. It is kept as raw bytes."
    EDS040 ORPHAN_SUB Repair Warn "a sub-index has no object"
        "There is a section for a sub-index, but none for its object. A RECORD was made to hold it."
    EDS041 LISTED_NOT_DESCRIBED Lint Warn "an object is listed but not described"
        "The list announces an object that has no section, so that nothing is known of it."
    EDS042 NOT_LISTED Lint Warn "an object is described but not listed"
        "Every object belongs into one of [MandatoryObjects], [OptionalObjects] and [ManufacturerObjects]; many \
        readers look at nothing else. The object is kept."
    EDS043 LIST_COUNT Repair Warn "an object list doesn't have as many entries as it says"
        "SupportedObjects is the number of entries, which are numbered from 1. The entries that exist are used."
    EDS044 LISTED_TWICE Lint Warn "an object is listed twice"
        "One mention is enough; the second says nothing new."
    EDS045 WRONG_LIST Lint Warn "an object is in the wrong list"
        "[MandatoryObjects] holds 0x1000, 0x1001 and 0x1018; [ManufacturerObjects] 0x2000 to 0x5FFF; [OptionalObjects] \
        the others from 0x1000 on."
    EDS046 SUB_NUMBER Repair Warn "SubNumber isn't the number of sub-indices"
        "SubNumber counts the described sub-indices including 0, without 0xFF. The sections that exist are used."
    EDS047 VAR_WITH_SUBS Repair Warn "a VAR has sub-indices"
        "An object of type VAR is one value. This one has sub-indices and no data type of its own, so that it is \
        treated as a RECORD."
    EDS048 COMPACT_AND_SUBS Repair Warn "CompactSubObj and SubNumber are both given"
        "Either the sub-indices are described one by one or all at once. What is described stays as it is, and the \
        compact description fills the gaps."
    EDS049 SUB0_MISMATCH Lint Warn "sub-index 0 doesn't give the highest sub-index"
        "The default of sub-index 0 should be the highest sub-index that exists (CiA 301 7.4.3). PDO mappings, the \
        PDOs of a sync manager and 0x1003 are exempt, because there it is the number of valid entries."
    EDS050 DEFAULT_OUT_OF_LIMITS Lint Warn "a default lies outside of its limits"
        "The device could not be written with its own default. One of the numbers is wrong. In a register table the \
        same is said of the only value (`fixed`), of the values that are allowed, and of those that may be written."
    EDS051 LIMITS_SWAPPED Lint Warn "LowLimit is greater than HighLimit"
        "No value satisfies the limits. They are kept, and generated code doesn't check them."
    EDS052 HEADER_FORMAT Lint Warn "a version, date or time has another form"
        "CiA 306: versions are whole numbers, EDSVersion is `x.y`, dates are `mm-dd-yyyy`, times `hh:mm` with AM or \
        PM. The text is kept."
    EDS053 OLD_EDS_VERSION Lint Warn "the file says it is older than EDS 4.0"
        "Files before version 4.0 lack CompactSubObj, ObjFlags and $NODEID in limits, and describe modules \
        differently. A missing EDSVersion means 3.0."
    EDS054 UNRESOLVED_MODULE Lint Warn "a module or extension is announced but not described"
        "A module's sections are named `[M<n>ModuleInfo]`, `[M<n>FixedObjects]`, `[M<n>SubExtends]`, and so on. What \
        is announced without them is kept empty."
    EDS055 DANGLING_LINK Lint Warn "an object link leads nowhere"
        "[<index>ObjectLinks] names an object that the file doesn't describe."
    EDS056 NAME_WITHOUT_SUB Lint Warn "a name, value or denotation is given for a sub-index that doesn't exist"
        "The sections [<index>Name], [<index>Value] and [<index>Denotation] refine the sub-indices of CompactSubObj. \
        This entry has none to refine."
    EDS057 NO_SUBS Lint Warn "an ARRAY or RECORD has no sub-indices"
        "Nothing says which sub-indices the object has: in an EDS, there is neither SubNumber nor CompactSubObj, and \
        the sections that exist are used."
    EDS058 NO_SUB0 Lint Warn "sub-index 0 isn't described"
        "Every ARRAY and RECORD has a sub-index 0, which holds the highest sub-index (CiA 301 7.4.3). Who counts the \
        entries reads it first."
    EDS059 ARRAY_TYPES Lint Warn "the elements of an array have different types"
        "All elements of an ARRAY have one data type; an object with different ones is a RECORD."
    EDS060 SUB0_ACCESS Lint Allow "sub-index 0 can be written and its entries can't, or the other way round"
        "Sub-index 0 holds the highest sub-index. Writing it makes sense only where the number of valid entries can \
        change, as in a PDO mapping or a list of errors; then the entries can be written too, or the list is cleared \
        by writing 0."
    EDS061 IDENTITY_MISMATCH Lint Warn "object 0x1018 and [DeviceInfo] disagree"
        "VendorNumber, ProductNumber and RevisionNumber are the defaults of 0x1018 sub-index 1 to 3. A master that \
        checks the identity of a node would reject the device, or accept another."
    EDS062 MISSING_ENTRY Lint Allow "a mandatory entry is missing"
        "CiA 306 makes the entry mandatory. Lexibus uses the default that most tools assume."
    EDS063 MISSING_MANDATORY_OBJECT Lint Warn "a mandatory object is missing"
        "Every CANopen device has the objects 0x1000, 0x1001 and 0x1018 (CiA 301 7.5.2)."
    EDS064 VALUE_NOT_ALLOWED Lint Warn "a value isn't allowed for its key"
        "The key has a small set or range of values. This one isn't among them; it is kept where the IR can hold it."
    EDS065 COMPACT_WITHOUT_TYPE Lint Warn "a compact object has no data type"
        "The elements of CompactSubObj take their type from the object. Without DataType they are raw bytes."
    EDS066 STRUCTURE_ENTRY Lint Warn "sub-index 0xFF is counted as an element"
        "Sub-index 0xFF describes the structure of the object (CiA 301 7.4.7.2). It is documented, but it is no \
        element, and SubNumber doesn't count it."
    EDS067 UNKNOWN_OBJECT_TYPE Repair Warn "an object type isn't known"
        "ObjectType is one of 0 (NULL), 2 (DOMAIN), 5 (DEFTYPE), 6 (DEFSTRUCT), 7 (VAR), 8 (ARRAY) and 9 (RECORD). Any \
        other was read by what the section describes."
    EDS068 TYPE_AREA_OBJECT Lint Warn "an object stands in the data type area"
        "Objects below 0x1000 define data types; they have no value to read, and object type DEFTYPE or DEFSTRUCT."
    EDS069 MISSING_SECTION Lint Warn "a mandatory section is missing"
        "An EDS has the sections [FileInfo], [DeviceInfo] and [MandatoryObjects]; a file of a modular device that \
        describes modules has [SupportedModules]."
    EDS070 NOT_ALLOWED_ENTRY Lint Allow "an entry has no meaning in its section"
        "The key is one of CiA 306, but says nothing where it stands: a DataType or a DefaultValue of an object whose \
        values are its sub-indices, or a SubNumber of a single value. It is kept as an extension attribute."
    EDS071 HEX_COUNT Lint Warn "a number of entries is in hexadecimal"
        "The number of entries of a list is read as decimal by many tools, which then see an empty list."
    XML001 MALFORMED_XML Error Deny "the XML isn't well formed"
        "The file can't be read further than to this place: a tag isn't closed, an attribute isn't quoted, or the file \
        was cut off."
    XML002 ENTITY_REFERENCE Repair Warn "an entity isn't one of the five of XML"
        "Lexibus expands no entities other than those that XML itself defines, so that a small file can't grow into a \
        large one. The reference is kept as text."
    XML003 WRONG_ENCODING Repair Warn "the file isn't in the encoding that it declares"
        "The XML declaration names an encoding (UTF-8 where there is none), and the bytes are of another one. Bytes \
        that are UTF-8 were read as such whatever is declared, all others as declared, or else as Windows-1252. Bytes \
        that are no letter of that encoding are lost."
    XML004 SECOND_ROOT Repair Warn "something follows the root element"
        "A document has one root element, and nothing but comments behind it. What follows was left out: often it is \
        the rest of an older, longer version of the file."
    XML005 REFERENCED_FILE Lint Warn "a file that the description refers to wasn't read"
        "References are followed to files beside the description or in folders below it, never elsewhere. What the \
        file would have added is missing."
    ESI001 ESI_VALUE Repair Warn "a text or attribute has an unknown form"
        "ETG.2000 fixes the form: a decimal number or `#x` and hexadecimal digits, `true` or `false`, pairs of \
        hexadecimal digits, one of a few words. What can't be read is left out, or kept as text where the IR can hold \
        it."
    ESI002 ESI_UNKNOWN_ELEMENT Lint Allow "an element or attribute has no meaning in ETG.2000"
        "What it says is kept as an extension attribute. Tools add elements of their own outside of VendorSpecific."
    ESI003 BARE_HEX Repair Warn "a hexadecimal number has no `#x`"
        "A number is decimal unless it starts with `#x`. This one has letters, so that it can only be hexadecimal; its \
        neighbours without letters are read as decimal, and may be meant as hexadecimal, too."
    ESI010 UNRESOLVED_TYPE Repair Warn "a data type isn't known"
        "The name is neither that of a DataType of this dictionary nor one of a basic type (ETG.1000.6), or the \
        DataType says nothing but its name. The value is kept as raw bytes."
    ESI011 TYPE_ALIAS Lint Allow "a basic type goes by another name"
        "ETG.1000.6 calls it USINT, UINT, UDINT and so on; the name is that of the same type in CiA 301 or in C."
    ESI012 GUESSED_TYPE Repair Warn "a data type was guessed from the beginning of its name"
        "The name begins with that of a basic type (`UINT_hex`), the sizes agree, and nothing else says what it is."
    ESI013 DUPLICATE_TYPE Repair Warn "two data types have the same name"
        "References can mean either. The first one is used, as most tools do."
    ESI014 SUB_ITEM_NAME Lint Warn "a sub-item has no name of its own"
        "The name is missing, or another sub-item of the data type has it, too. Generated code tells them apart by \
        their sub-indices."
    ESI015 ENDLESS_TYPE Repair Warn "a data type is made of itself"
        "The BaseType or a SubItem leads back to the data type, or there are too many layers. That part is kept as raw \
        bytes."
    ESI016 MISSING_BASE_TYPE Repair Warn "an enumeration or array has no usable BaseType"
        "BaseType says which integer the values are, or what the elements are. An enumeration is read as an unsigned \
        integer of its BitSize."
    ESI017 ARRAY_BOUNDS Repair Warn "the number of elements of an array is missing or can't be right"
        "ArrayInfo has LBound and Elements, and BitSize is the size of all elements together. A number that is missing \
        follows from the sizes."
    ESI018 SUB_ITEM_MISMATCH Repair Warn "the sub-items of an object aren't those of its data type"
        "Sub-items of an object belong to those of its data type by name. One whose name the data type doesn't have \
        was taken by its place."
    ESI019 BIT_SIZE Lint Warn "BitSize isn't the size of the data type"
        "The size of an object or data type contradicts the type that it is made of."
    ESI020 ODD_HEX Repair Warn "an odd number of hexadecimal digits"
        "Two digits are one byte. A zero was put in front of the first digit."
    ESI021 HEX_LENGTH Lint Warn "DefaultData, MinData or MaxData has another length than the type"
        "The bytes are those of memory, the least significant one first, as many as the type has. Bytes that are \
        missing are zeros; with bytes that are too many the value is kept as bytes."
    ESI022 ESI_OUT_OF_TYPE Lint Warn "a value doesn't fit its data type"
        "No value of this data type can be as large or small. It is kept in the IR; generated code clamps a limit to \
        the type and leaves such a default out."
    ESI023 VALUE_FORM Repair Warn "a value has the form of another type"
        "A fraction is given for an integer, a text for a number, or the other way round. It is read for what it can \
        only mean, or kept as text."
    ESI024 MINUS_ONE Repair Warn "-1 is given for an unsigned integer"
        "That is how C writes a number of which all bits are set. It is read as such."
    ESI025 SUB_ITEM_PLACE Lint Warn "a sub-item shares bits with another, or lies beyond its data type"
        "BitOffs and BitSize of the sub-items say where each is in the value as a whole, and BitSize of the data type \
        how long that is. A complete access (CoE) exchanges the value as a whole, and mixes them up."
    ESI030 ESI_MISSING_ACCESS Lint Warn "nothing says how an object may be accessed"
        "Flags of the object or of the sub-item have an Access: ro, rw or wo. Without it the item is kept read-only, \
        which can do no harm."
    ESI031 UNKNOWN_FLAG Repair Warn "a flag has an unknown value"
        "Access is ro, rw or wo; Category is m, o or c; PdoMapping is R, T or RT; SafetyMapping is si, so, sio or sp."
    ESI032 ESI_DUPLICATE_OBJECT Repair Warn "an object or sub-index occurs twice"
        "An index is unique in a device and a sub-index in its object. The first one is used."
    ESI033 ESI_MISSING_INDEX Repair Warn "an object, PDO entry or module has no usable number"
        "Without an index an object can't be addressed and is left out. An entry is kept without an object if it has a \
        name and a type, and is padding otherwise. A module without an ident number fits into no slot."
    ESI034 SUB_INDEX_RANGE Repair Warn "an object has more than 255 sub-indices"
        "Sub-indices are numbers of one byte. An array that has no room is kept as one value, and a sub-item behind \
        sub-index 255 is left out; often the number of elements of an array is wrong."
    ESI040 SYNC_MANAGER_PURPOSE Repair Warn "nothing says what a sync manager is for"
        "The text of Sm is MBoxOut, MBoxIn, Outputs or Inputs. Without such a text, the purpose follows from the PDOs \
        that name the sync manager, or from its control byte or its position."
    ESI041 PDO_WITHOUT_INDEX Repair Warn "a PDO has no index"
        "The entries are kept, but nothing can be assigned. A PDO of an old file may name a template (Ref), which is a \
        Pdo with this RefName in Descriptions/Pdos of the same file."
    ESI042 DUPLICATE_PDO Lint Warn "two PDOs have the same index"
        "Both are kept: some devices offer one PDO on either of two sync managers, and only one can be assigned."
    ESI043 UNNAMED_PDO Lint Warn "a PDO has no name"
        "Name is mandatory. Generated code names the PDO by its index."
    ESI044 ENTRY_LENGTH Lint Warn "the length of a PDO entry isn't that of its data type"
        "BitLen decides the layout. The type of the entry is the one that it names."
    ESI050 DUPLICATE_MODULE Lint Warn "two modules have the same ident number"
        "A device tells modules apart by their ident numbers. Both are kept."
    ESI051 NO_MODULE_FITS Lint Warn "no module fits into a slot"
        "The slot names ident numbers or classes that no module of this description or of the files that it refers to \
        has."
    ESI060 MISSING_IDENTITY Lint Warn "the number of the vendor or product is missing"
        "A master finds the description of a slave by vendor number, product code and revision."
    XDD002 POWERLINK_XDD Error Deny "a POWERLINK XDD was given"
        "Ethernet POWERLINK uses XDD files of the same outer form (EPSG 311), with other communication profiles. \
        Lexibus reads the CANopen ones."
    XDD003 NOT_A_CANOPEN_XDD Error Deny "the XML is no CANopen device description"
        "The root element of an XDD or XDC is ISO15745ProfileContainer (or ISO15745Profile), with a profile body for \
        the device and one for the CANopen communication network."
    XDD004 DANGLING_REFERENCE Repair Warn "a uniqueIDRef leads nowhere"
        "An object, template or text refers to an element by its uniqueID, and no element has it."
    XDD005 UNKNOWN_ELEMENT Lint Allow "an element has no meaning in CiA 311"
        "The element is kept as an extension attribute where it has a value."
    XDD006 XDD_VALUE Repair Warn "an attribute's value has an unknown form"
        "CiA 311 fixes the form of the attribute. The text is kept where the IR can hold it."
    XDD007 DUPLICATE_OBJECT Repair Warn "an object or sub-object occurs twice"
        "Index and sub-index are unique in an object list. The last one is used."
    XDD008 MISSING_INDEX Repair Warn "an object has no usable index"
        "Without an index or sub-index in hexadecimal digits the object can't be addressed; it is left out."
    GSD001 NOT_A_GSDML Error Deny "the XML is no GSDML"
        "A GSDML file has the root element ISO15745Profile, and in it a ProfileBody with an ApplicationProcess. This \
        one has another root."
    GSD002 NO_DEVICE_ACCESS_POINT Lint Warn "a GSDML describes no device"
        "Every device access point is a device. Without one the file has nothing to generate bindings for."
    GSD003 GSDML_FILE_NAME Lint Allow "the name of a GSDML file isn't formed as it should be"
        "Engineering tools find files by names of the form `GSDML-V2.35-Vendor-Device-20200131.xml`, and some refuse \
        any other. The version is that of the schema. Lexibus goes by the content, so that this lint is off unless \
        asked for."
    GSD004 UNKNOWN_GSDML_ELEMENT Lint Allow "an element or attribute has no meaning in GSDML V2.35"
        "Lexibus keeps it as an extension attribute. Files of later versions have such elements, so that this lint is \
        off unless asked for."
    GSD005 GSDML_VALUE Repair Warn "an attribute's value has an unknown form"
        "The schema fixes the form of the attribute: a decimal number, `0x` and hexadecimal digits for ident numbers, \
        `true` or `false`, or a list such as `1..3 7`. What can only mean one thing was read so; anything else was \
        left out."
    GSD006 GSDML_MISSING Repair Warn "a mandatory attribute or element is missing"
        "The schema makes it mandatory. The message says what was done without it."
    GSD007 ATTRIBUTE_CASE Repair Warn "an attribute's name is spelt in another case"
        "XML tells cases apart, so that an engineering tool doesn't see the attribute. It was read for what it can \
        only mean."
    GSD008 MISSING_TEXT Repair Warn "a text isn't in the text list"
        "Names are references to ExternalTextList. Where a reference leads nowhere, the identifier itself is used as \
        the name."
    GSD009 MISSING_TRANSLATION Lint Warn "a language lacks texts that the primary language has"
        "For these texts, readers of that language get those of the primary language, which is English."
    GSD010 DUPLICATE_ID Repair Warn "something that has to be unique occurs twice"
        "Identifiers are unique among the elements of one kind, and texts and languages in the text list. References \
        lead to the first."
    GSD011 UNRESOLVED_TARGET Repair Warn "a reference leads to no element"
        "An attribute such as ModuleItemTarget names an element by its ID, and no element of that kind has it. What \
        the reference would have added is missing."
    GSD012 UNKNOWN_GSDML_TYPE Repair Warn "a data type isn't known"
        "The name is none of the data types of GSDML. One in another case was read as the data type that it is. Any \
        other value is kept as raw bytes of the length that is given beside it; without a length it takes no room, and \
        what follows may stand elsewhere."
    GSD013 GSDML_DEFAULT Repair Warn "a default isn't written as its data type wants"
        "Numbers are decimal, octets are written `0x00,0x1F`, a bit is 0 or 1. A hexadecimal number was read; anything \
        else is kept as text."
    GSD014 ALLOWED_VALUES Repair Warn "a part of AllowedValues is no number and no range"
        "The list has numbers and ranges between blanks: `0..4 7 9`. A range whose last value is less than its first \
        was read the other way round; any other part was left out."
    GSD015 RECORD_BOUNDS Lint Warn "a parameter or constant reaches beyond its record"
        "The record is shorter than what stands in it. A device refuses a record of another length than it expects."
    GSD016 PARAMETERS_OVERLAP Lint Warn "two parameters of a record share bits"
        "Writing one of them changes the other."
    GSD017 BIT_DATA_ITEM Repair Warn "a named bit doesn't go with its data item"
        "A BitDataItem names a bit of a data item that is used as bits: within its length, and once."
    GSD018 IO_LENGTH Lint Warn "a module has more data than its device exchanges"
        "MaxInputLength, MaxOutputLength and MaxDataLength count the data of all submodules with their status bytes. A \
        module that is longer by itself can't be used in the device."
    GSD019 RECORD_SIZE Lint Warn "a record is longer than the device takes"
        "MaxSupportedRecordSize is the greatest length of a record; where it isn't given, 4068 bytes."
    GSD020 SLOT_RANGE Lint Warn "a module is for slots that the device doesn't have"
        "PhysicalSlots lists the slots of a device. Every other slot that a module names is of no use."
    GSD021 SUBSLOT_TAKEN Lint Warn "two submodules are fixed in one subslot"
        "Built-in submodules have subslots of their own. A VirtualSubmoduleItem that names none is in subslot 1."
    GSD022 UNUSED_TEXT Lint Allow "nothing refers to a text"
        "The text is kept as an extension attribute of the catalogue. Tools leave such texts behind, so that this lint \
        is off unless asked for."
    PDO001 MAPPED_OBJECT_MISSING Lint Warn "a PDO maps an object that doesn't exist"
        "The mapping names an index and sub-index that this file doesn't describe. The field is kept as raw bits."
    PDO002 NOT_MAPPABLE Lint Warn "a PDO maps an object that isn't mappable"
        "The object's PDOMapping is 0. A device answers such a mapping with abort code 0x06040041."
    PDO003 WRONG_DIRECTION Lint Warn "a PDO maps an object against its access"
        "A TPDO carries what can be read (ro, const, rw, rwr), an RPDO what can be written (wo, rw, rww); rwr and rww \
        say the direction themselves."
    PDO004 PDO_TOO_LONG Lint Warn "a PDO is longer than 64 bits"
        "A CAN frame carries 8 bytes (CiA 301 7.5.2.36). A device answers with abort code 0x06040042."
    PDO005 MAPPED_LENGTH Lint Warn "a PDO maps an object with another length"
        "The mapping's length in bits isn't the length of the object's data type. The mapping's length decides the \
        layout."
    PDO006 MAPPING_GAP Lint Warn "a PDO mapping has a gap"
        "An entry is empty although later ones aren't. The entries behind the gap are taken as they stand."
    PDO007 UNMAPPABLE_TYPE Lint Warn "a PDO maps a type of variable length"
        "Strings and domains have no fixed length and can't be mapped, unless their length is fixed by the device."
    PDO008 DUMMY_IN_TPDO Lint Warn "a TPDO maps a dummy entry"
        "Dummy entries (0x0001 to 0x0007) reserve room in an RPDO. A TPDO must not have any (CiA 301 7.4.9)."
    PDO009 DUMMY_NOT_SUPPORTED Lint Warn "a PDO maps a dummy entry that [DummyUsage] excludes"
        "[DummyUsage] says which data types the device accepts as dummy entries. This one is missing there, or 0."
    PDO010 PDO_COUNT Lint Warn "NrOfRXPDO or NrOfTXPDO isn't the number of PDOs"
        "The file describes more PDOs than [DeviceInfo] announces, or fewer and no CompactPDO says what the others \
        look like."
    PDO011 GRANULARITY Lint Warn "a mapping is finer than the device's granularity"
        "Granularity is the smallest unit of mapping in bits: 8 for bytes, 1 for bits, 0 when mappings are fixed. The \
        entry's length isn't a multiple of it."
    PDO012 MULTIPLEXED_PDO Lint Warn "a multiplexed PDO doesn't go with the device's description"
        "Sub-index 0 of the mapping says 254 or 255 (multiplexed PDO), but GroupMessaging is 0."
    PDO013 PDO_COUNT_1004 Lint Warn "object 0x1004 and [DeviceInfo] disagree"
        "0x1004 holds the number of PDOs in its upper and lower 16 bits. The numbers differ from NrOfRXPDO and \
        NrOfTXPDO."
    PDO014 HALF_A_PDO Lint Warn "a PDO has a communication or a mapping object, but not both"
        "Every PDO is described by two objects: 0x1400+n goes with 0x1600+n, and 0x1800+n with 0x1A00+n. One of the \
        two isn't there."
    PDO015 MAPPING_UNREADABLE Lint Warn "a PDO mapping entry isn't a number"
        "A mapping entry is index, sub-index and length in bits, as one UNSIGNED32. It can't depend on the node-ID."
    PDO016 MAPPING_COUNT Lint Warn "sub-index 0 of a mapping and its entries disagree"
        "Sub-index 0 is the number of mapped objects. It announces more entries than are filled in."
    PDO017 UNCLEAR_DIRECTION Lint Allow "a PDO maps an object whose access doesn't tell the direction"
        "CiA 306 has rwr for objects that go into a TPDO and rww for those that come in an RPDO. Plain rw allows both, \
        and a tool can't tell which of the two the device means."
    PDO018 DEFAULT_PDOS_CONFLICT Lint Warn "two PDOs that exclude each other are both assigned by default"
        "A PDO with an Sm is assigned by default, and one that it excludes can't be. A master that assigns both gets \
        an error from the slave. The first one is in the process image by default; the other can be chosen."
    PDO019 NO_SUCH_SYNC_MANAGER Lint Warn "a PDO is assigned to a sync manager that isn't described"
        "The number is the position of an Sm element, counted from 0. The PDO is no part of the process image by \
        default."
    PDO020 EXCLUDED_PDO_MISSING Lint Warn "a PDO excludes one that isn't described"
        "Exclude names the index of another PDO of the same device or module. There is none with this index, so that \
        nothing is excluded."
    PDO021 IMAGE_TOO_LONG Lint Warn "the PDOs by default are longer than their sync manager"
        "MaxSize of a sync manager bounds the process data that it carries. A slave refuses what is longer."
    PDO022 ENTRY_TOO_LONG Lint Warn "an entry of a PDO is longer than 65535 bits"
        "No frame of EtherCAT carries so much, so that BitLen can't be right. The PDO is described as the file has it, \
        but generated code has no struct, view or field of an image for it."
    PDO023 MAPPED_READ_ONLY Lint Allow "a PDO of EtherCAT maps an object against its access by SDO"
        "The dictionary of the slave says that the object is read-only, and an RxPDO carries it. Many slaves give the \
        access by SDO only, so that this lint is off unless asked for."
    PDO024 TOO_MANY_PDOS Lint Warn "a sync manager has more PDOs by default than its assignment has room for"
        "The list of the PDOs of a sync manager is an object with 254 sub-indices, so that no master can write it. \
        Generated code has no `STARTUP`."
    TAB001 REGISTER_FORMULA Lint Warn "an object isn't the one that its register's rule gives"
        "A row has the number of a register and an object, and the rule of its space gives another object for the \
        number; or it has none, where the rows around it have one. What the row says is used. One of the two is \
        misprinted: look at the neighbours, write the doubt down, and allow this code on the row."
    TAB002 TABLE_SYNTAX Error Deny "a register table isn't TOML"
        "The file ends in .toml, or begins like a table, and breaks the grammar of TOML 1.1. Nothing of it can be used."
    TAB003 UNKNOWN_TABLE_KEY Error Deny "the table format has no such key"
        "The key was left out, and what else stands beside it was read. dictionaries/README.md has all keys, and \
        `lexibus schema` prints a JSON Schema by which editors complete them."
    TAB004 TABLE_VALUE Error Deny "a value of a table isn't what its key wants"
        "The message says what is expected. The row, or the part of it, that has the value was left out."
    TAB005 UNRESOLVED_NAME Error Deny "a name leads nowhere"
        "Rows name units, bit fields, enumerations, spaces, models, options and other items. Nothing of this kind has \
        the name; the nearest one that exists is suggested."
    TAB006 TABLE_PLACE Error Deny "an address, a range or a number of bits can't be read"
        "Registers are `63` or `\"63-64\"`, objects `0x6040` or `\"0x1018:1\"`, ranges of objects \
        `\"0x1400..0x1403:1\"`, bits `7` or `\"3-2\"`."
    TAB007 TABLE_DUPLICATE Error Deny "a name or an address occurs twice, or two rows share a register"
        "Names of registers become names of Rust, and an address has one value: two rows share neither a register nor \
        bits of their parts of one. Where the manual has one name for two registers, one of them gets a suffix and a \
        doubt."
    TAB008 ROW_WITHOUT_ADDRESS Error Deny "a row has no address"
        "An item is reached by a register (`reg`), an object (`obj`), a parameter (`param`), a name (`ascii`) or an \
        address in a slave controller (`esc`), on a bus that the device has."
    TAB009 REGISTER_SPAN Lint Warn "a register has more or fewer numbers than its type needs"
        "A value of 32 bits takes two registers of 16. The type is used; either it or the printed numbers are wrong."
    TAB010 ACCESS_NOT_GIVEN Lint Warn "nothing says how an item may be accessed"
        "Neither the row nor the defaults of its chapter or file have an `access`. The item is read-only until one \
        does."
    TAB011 UNKNOWN_UNIT Lint Warn "a unit is neither defined nor known"
        "Units are symbols of the SI and those usual with drives, or names of `[units]`, which give a symbol and a \
        scale. A symbol that nobody knows is often a name that is misspelt, and then the scale is missing."
    TAB012 HEX_DIGITS Lint Warn "a hexadecimal number doesn't have the digits of its type"
        "A number with more digits than its type has bits for (`0x007FFFFFFF` of 32 bits), one that is filled up with \
        zeros to another length (`0x0000` of 32 bits), or an index without four digits (`0x20A`) or without `0x`. A \
        digit was doubled or lost, or the type is another. Or it begins with `0X`, which is read, and often is a mark \
        of another hand in the manual. In an EDS, numbers as long as those of a longer type are found only where a \
        level of this code is set."
    TAB013 BIT_OUTSIDE_TYPE Lint Warn "a bit lies outside of its integer"
        "The integer has fewer bits than the bit field names. Generated code leaves the field out."
    TAB014 BITS_OVERLAP Lint Warn "two fields share bits"
        "A bit has one meaning at a time. Meanings that depend on another item, on the firmware or on the model say so \
        in each of them; of any others, one has the wrong place."
    TAB015 NAME_OUTSIDE_TYPE Lint Warn "an enumeration names a value that its integer can't have"
        "A negative value of an unsigned integer, or one with more bits than the integer or the field has. Either the \
        type or the value is wrong."
    TAB016 NAME_OUTSIDE_LIMITS Lint Warn "a named value or bit lies outside of the item's limits"
        "What has a name can be meant to be used, and the limits exclude it: generated code refuses to write it. \
        Either a limit is wrong, or the item has an enumeration of its own with fewer values."
    TAB017 VALUE_NAMED_TWICE Lint Warn "a value or code has two names"
        "Two entries of an enumeration or of a table of codes are the same number, or have some in common. Of codes a \
        range may contain narrower ones, which count there. Generated code decodes the first. Names that depend on the \
        firmware or the model say so in each of them."
    TAB018 UNNAMED_VALUE Lint Warn "a default, limit or condition is a value that is reserved or has no name"
        "The value is reserved, or has no name in an enumeration that is closed, or a limit is one off the last value \
        with a name, or a value that may be written has none. For the fields of a bit field the default and the fixed \
        value are looked at, for conditions each value."
    TAB019 RESERVED_BITS Lint Warn "a default, limit or fixed value sets bits without a meaning"
        "The number sets a bit that is reserved or that nobody named, or lacks one that is always set. A limit is \
        looked at where it is a pattern of bits, and not all bits up to the end of the type or the last one that has a \
        name."
    TAB020 LENGTH_MISMATCH Lint Warn "a length isn't that of the type"
        "The bytes of an address, of a default text, or those that the manual prints (`length`) aren't as many as the \
        type takes."
    TAB021 SUMMARY_DIFFERS Lint Warn "another place of the manual says otherwise"
        "The row's `summary` holds what a table of contents, an overview or the prose says of the same item. The row \
        itself is used: write the doubt down, and allow this code on the row."
    TAB022 SAME_VALUE_DIFFERS Lint Warn "two names of the same value are described differently"
        "`same_as` says that two rows are one value, and their types, limits, units and scales, or the values and bits \
        that have a meaning and their names differ; or the row of a replacement (`replaced_by`) states another access \
        than the row that it replaces."
    TAB023 READING_LIMITS Lint Warn "a signed value that is only read has a lower limit above zero"
        "What a device measures is signed because it can be negative, and then it can be zero. Such limits are those \
        of a set-point that was copied, or the type is unsigned."
    TAB024 ACCESS_CONFLICT Lint Warn "access, storage and process data contradict each other"
        "A value that can't be written is saved, comes in an RPDO or has values that may be written; one that can't be \
        read goes into a TPDO; or one that the device clears by itself is saved. Descriptions other than register \
        tables are looked at only where a level of this code is set."
    TAB025 MENTIONED_OBJECT Lint Warn "a text mentions an object or item that the table doesn't have"
        "Documentation, names and effects mention objects by index: 0x6000 to 0x67FF, `object 0x2010`, or with a \
        sub-index, `0x1003:1`; and registers by number: `register 10015`. Either a row is missing, or the index is \
        misprinted. They also mention items by name, where names are told from other words (`Rposwrtime`): one or two \
        letters beside a name, and no name itself, is a name that is misspelt."
    TAB026 FIRMWARE_WINDOW Lint Warn "firmware windows contradict each other"
        "`since` is the first firmware that has something, `until` the first that doesn't. A window is empty, or the \
        replacement of an item exists earlier or later than the item ends."
    TAB027 VERSION_FORM Lint Warn "a firmware version can't be compared"
        "Versions are numbers with points between them, of which each counts by itself: 6.27 is later than 6.3."
    TAB028 STATES_OVERLAP Lint Deny "two states of a machine are told by the same status"
        "Some values of the status item belong to both states, so that it can't be told in which one the device is."
    TAB029 COMMANDS_OVERLAP Lint Allow "two commands of a machine can be the same value"
        "Some values of the control item are both commands. Where the state decides which one is meant, as in CiA 402, \
        this is as it should be, so that this lint is off unless asked for."
    TAB030 OVERLAY_NO_MATCH Lint Warn "an entry of an overlay matches nothing"
        "The devices that the overlay is for have no such object or item, or no row of the overlay names the \
        definition. A newer version of the description may call it otherwise, or have dropped it."
    TAB031 OVERLAY_NO_CHANGE Lint Warn "an entry of an overlay changes nothing"
        "The description says already what the overlay says: a newer version of it may have been corrected. Take the \
        row out."
    TAB032 OVERLAY_NOT_FOR Lint Warn "an overlay is for no device of the description"
        "`for` in `[overlay]` names a vendor, a product code, a revision, a device or a module, and the description \
        has none that fits, or none that was selected. Nothing of the overlay was applied."
    TAB033 STEP_IMPOSSIBLE Lint Warn "a step of a procedure can't be carried out"
        "The step writes what can't be written, or a value that the item can't have; waits for what can't be read or \
        never comes; or gives a PDO the COB-ID of another."
    TAB034 ASSIGNED_PDO_MISSING Lint Warn "a PDO is assigned that isn't described"
        "0x1C12 and 0x1C13 hold the indices of PDOs. A default, or a step of a procedure, puts one there that the \
        table doesn't have."
    TAB035 MAPPED_NOT_ASSIGNED Lint Warn "a procedure maps a PDO and assigns others"
        "The mapping that the procedure writes has no effect, because the sync manager carries other PDOs."
    TAB036 UNNAMED_BITS Lint Allow "a bit field says nothing of some bits"
        "Bits that are neither named nor reserved, or values of a narrow field between those that have names. Manuals \
        leave them out as often as not, so that this lint is off unless asked for."
    TAB037 MODE_WITHOUT_BITS Lint Warn "bits that depend on a mode have no meaning in one of the modes"
        "The table of the bits lacks a column for the mode, or the mode doesn't use them: say so, and allow this code \
        on the bit field. The value 0, which mostly is no mode at all, doesn't count."
    TAB038 ONE_LIMIT Lint Allow "a row has one limit only"
        "A cell of the manual is empty beside one that isn't. Often the limit is that of the type, so that this lint \
        is off unless asked for."
    TAB039 PATTERN_OUTSIDE_MASK Lint Warn "a state or command wants bits that its mask leaves out"
        "The value has bits that the mask doesn't have, so that nothing ever matches it."
    TAB040 NAME_TWICE Lint Warn
        "two objects, sub-entries of an object, bits or values have one name, or names of registers differ by case only"
        "Often the name was copied from the box or line above. Generated code tells the two apart by a number. \
        Descriptions other than register tables are looked at only where a level of this code is set."
    TAB041 BROKEN_NAME Lint Warn
        "a name has the hyphen of a line break, or a description, in it, or is the title of a column"
        "The column of the manual was too narrow for the name; its prose often has the whole one. Or the name's cell \
        has the description beside it as well: values (`0 = Stop`), tags, or a sentence where other registers are \
        called by a word. Or a bit or value is called `Definition`, as columns are: then a line of the printed table \
        slid."
    TAB042 EMPTY_LIMIT Lint Warn "a row has one limit, which is that of its type"
        "A lower limit of 0 says nothing of an unsigned value. The manual's cell for the other limit is empty, or was \
        lost."
    TAB043 SHARED_REGISTERS Lint Warn "two items share registers, or bits of one"
        "One of the two has the wrong number, or a type that is too long. Where the device shows a part of a value in \
        registers of its own, say so: `part`, or `same_as` and this code in `allow`."
    TAB044 EXAMPLE_DIFFERS Lint Warn "an example isn't as its message says"
        "The bytes of a request or reply that the manual prints were held against the fields of the message: their \
        number, constant bytes and values, lengths, echoes, reserved bits, and values that have a name. One of the two \
        is misprinted: keep what the other frames support, with a `doubt`."
    TAB045 CELLS_TWICE Lint Warn "two codes have the same cells"
        "The table says that no two codes have the same cells (`distinct`), and two do. A row was copied: write the \
        doubt down, and allow this code on the table."
    TAB048 NARROW_WINDOW Lint Warn "the values of a space don't fit through its windows"
        "An item has more bits than the item through which it is read or written, and no other window of its space is \
        wider: the upper bits are lost."
    TAB049 WINDOW_ORDER Lint Warn "a window's procedure writes the number before the value"
        "Where writing the number starts the transfer, what is written then is the value of the last one. Values and \
        numbers of a process image go together; there the order means nothing."
    TAB050 QUANTITIES_DIFFER Lint Warn "two items that are one quantity in two scales have different defaults"
        "`same_quantity` names an item that is the same quantity in another scale. Their defaults are compared as \
        physical numbers, model by model, to a thousandth; where the units differ, as numbers of the machine \
        (`[given]`)."
    TAB051 NUMBER_GAP Lint Allow "a number is missing between parameters that count up by one"
        "A row of the manual's table may have been lost. Devices leave numbers out as often, so that this lint is off \
        unless asked for."
    TAB052 CONVERSION_DIFFERS Lint Warn "a number that the manual converts isn't what the scale gives"
        "`conversions` has a raw number and what the manual says it stands for. They are further apart than a count: a \
        digit was misprinted, or the scale, a number of the machine, or the base is another."
    TAB053 OVERLAY_SHARED Lint Warn "an overlay changes a part of a device that it isn't for"
        "`for` in `[overlay]` names some devices of the description, and another one has the same module or submodule, \
        which is described once: what the overlay says of it holds there, too. Name the module in `for`, or the other \
        device too, if that is right."
    MSG001 FRAMING_BYTES Lint Warn "start, end, escape and escaped bytes of frames contradict each other"
        "Start, end and escape of a frame are three bytes; each of them is escaped where it is data, and what is sent \
        in its place is none of them. Else frames don't end where they should."
    MSG002 MESSAGE_LENGTH Lint Warn "a message has no whole bytes, or is longer than a frame"
        "Fields of less than a byte follow each other and fill bytes. All data of a message, with as many repetitions \
        as it declares, fit into what the framing says is the greatest number of data bytes."
    MSG003 MESSAGES_ALIKE Lint Warn "two requests can have the same bytes"
        "The device couldn't tell which of the two was meant: a constant was misprinted. Where the same request means \
        different things after different messages, say `after`."
    MSG004 REPLY_OF_ANOTHER Lint Warn "a reply has the constant of another message"
        "The constant that replies begin with is in the requests that they answer. This one is in the request of \
        another message: the manual's table was copied from there."
    MSG005 ERROR_ALIKE Lint Warn "a reply can have the same bytes as what comes in its place"
        "A master can't tell from the bytes whether the device answered or refused. Where it never refuses, the \
        message has no `error`."
    MSG006 BYTE_NUMBERS Lint Warn "the printed numbers of bytes don't count on"
        "Between two fields of a message, the manual's numbers of bytes (`at`) leave some out or count some twice: a \
        row of its table is missing or has slid, or one of the numbers is misprinted."
    MSG007 ODD_REQUEST Lint Warn "one request begins with another constant than all others of its form"
        "Nine or more requests begin with several constants, and all but one with the same. That one is an exception \
        or a misprint."
    MSG008 STATES_DIFFER Lint Warn
        "a message is accepted in a state in which the table of commands and states refuses it, or the other way round"
        "The section of a command and the table of commands and states are two places of the manual that say the same. \
        Keep the one that tells the states one by one."
    MSG009 MESSAGE_UNSHAPED Lint Warn "no code is generated for a message, or for a part of the protocol"
        "Its fields can't be written and read one after the other: a part of a byte is left over, two parts are as \
        long as the data are, or something comes back from a place of the request that depends on what is in front of \
        it. The same holds for what comes where the device refuses, for frames that the runtime can't delimit, and for \
        parameters whose message has fields of its own. The documentation of the format says what messages are made of."
    MSG010 PARAMETERS_ALIKE Lint Warn "two spaces that messages carry have a parameter of one number"
        "A client has only the number of a parameter, and sends the message of the first space that has it: the other \
        parameter can be reached by its own message alone."
    MOD001 MODULE_INDEX_CLASH Lint Warn "a module's fixed object exists in the device already"
        "The fixed objects of a module get an index of their own; the device describes this one itself, so that one \
        index would stand for two objects."
    MOD002 SUB_EXTEND Lint Warn "a sub-index extension isn't described as CiA 306 wants"
        "[M<n>SubExt<index>] needs a place in [M<n>SubExtends], Count (a number of sub-indices; or 0, `;` and a number \
        of bits), ObjExtend 0 or 1, and the keywords of a VAR. The object that it extends has sub-indices."
    CSV001 CSV_NO_COLUMNS Error Deny "a list of registers has no titles of columns"
        "Columns are recognised by their titles, in English, German or Italian, in any order: an address and at least \
        one more. Where the titles are others, or there are none, `--map FIELD=TITLE` and `--map FIELD=#NUMBER` say \
        what is what."
    CSV002 CSV_UNKNOWN_COLUMN Lint Warn "a column isn't imported"
        "Nothing is known of a column with this title. `--map FIELD=TITLE` says what it is; `--map doc=TITLE` keeps \
        its text as documentation."
    CSV003 CSV_UNREADABLE_CELL Repair Warn "a cell of a list of registers can't be read"
        "The cell isn't what its column is about, or contradicts another one. It is left out, and the rest of the row \
        is kept; the label says where something else is done."
    CSV004 CSV_NO_ROW Repair Warn "a line of a list can't become a row"
        "It has no address, one that can't be read, or one that another line has; or, with it, the repeated lines \
        stand for more items than a table may have, or their names are taken again and again. The line is written into \
        the table as a comment, so that a person can decide. Bits of one register share its address: they need a \
        column with the bit."
    CSV005 CSV_RAGGED_ROW Repair Warn "a line has more or fewer cells than there are titles"
        "Often a delimiter stands within a cell that isn't in quotes, and then all cells behind it are in the wrong \
        column."
    CSV006 CSV_SAME_NAME Lint Warn "two lines have the same name"
        "Names of registers become names of Rust. The second one gets a number."
    CSV007 CSV_ASSUMPTION Lint Warn "the list leaves something open"
        "Lists of registers use one word for different things, and leave out what everybody is thought to know. The \
        message says what was assumed; it is told once, and holds for the whole list."
    CSV008 CSV_UNCLOSED_QUOTE Repair Warn "a quote is never closed"
        "All that follows, to the end of the file, is one cell. Where tabs divide cells, the quote is taken as a \
        letter, and the lines behind it are read."
    CSV009 CSV_NO_SUCH_COLUMN Error Deny "a column that `--map` names doesn't exist"
        "Titles are compared without regard to case and punctuation. A column can also be named by its number: `--map \
        reg=#2`."
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_and_names_are_unique_and_explained() {
        let mut seen = std::collections::BTreeSet::new();
        for code in CODES {
            assert!(seen.insert(code.id) && seen.insert(code.name), "{} twice", code.id);
            assert!(code.explanation.len() > code.summary.len(), "{} isn't explained", code.id);
            assert_eq!(find(code.name), Some(*code));
        }
    }
}
