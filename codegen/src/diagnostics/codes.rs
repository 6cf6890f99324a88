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

macro_rules! codes {
    ($($id:ident $constant:ident $name:literal $class:ident $level:ident $summary:literal $explanation:literal)*) => {
        $(
            #[doc = concat!("`", stringify!($id), "`, `", $name, "`.")]
            pub static $constant: Code = Code {
                id: stringify!($id),
                name: $name,
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
    IO001 UNREADABLE_FILE "unreadable-file" Error Deny
        "a file can't be read"
        "The operating system refused to open or read the file, or the file is larger than Lexibus reads. The \
        message quotes its reason. Check the path, the rights and, for a list of files, the working directory."
    IO002 UNKNOWN_FORMAT "unknown-format" Error Deny
        "the file is no device description"
        "Neither the content nor the name of the file looks like any format that Lexibus reads: EDS, DCF (CiA \
        306), XDD, XDC (CiA 311), ESI (ETG.2000) or GSDML. The message says what the file looks like where that is known."
    IO003 INPUT_TOO_LARGE "input-too-large" Error Deny
        "the description exceeds a limit"
        "A description declares more elements, or nests them deeper, than any real device does, so that reading it \
        would take time or memory out of proportion to the file. The limits are in the documentation of \
        `lexibus_codegen::limits`."
    IO004 NOTHING_SELECTED "nothing-selected" Error Deny
        "the description has nothing of the selected name"
        "Devices, modules and objects can be selected by name, order code, product code and revision. Nothing in the \
        file has this one, so that the output wouldn't be what was asked for. `lexibus info` lists what there is."
    EDS001 ETHERNET_IP_EDS "ethernet-ip-eds" Error Deny
        "an EtherNet/IP EDS was given"
        "ODVA's EtherNet/IP, DeviceNet and ControlNet devices also come with files called EDS. They share nothing \
        with CANopen's but the name and the square brackets: their lists end in `;` and their sections are \
        `[File]`, `[Device]`, `[Params]`. Ask the vendor for the CANopen EDS of the device."
    EDS002 NOT_AN_EDS "not-an-eds" Error Deny
        "no CANopen section was found"
        "The file has the ending of an EDS or DCF, but not one section of CiA 306 ([DeviceInfo], an object list, \
        or an object such as [1000]). It may be empty, a link that was checked out as text, or something else."
    EDS003 JUNK_LINE "junk-line" Repair Warn
        "a line is neither a section, an entry nor a comment"
        "CiA 306 knows section headers, `Key=Value` entries and comment lines that start with `;`. Any other line \
        is skipped. Often it is a wrapped value, a merge marker or an include of some other tool."
    EDS004 ENTRY_OUTSIDE_SECTION "entry-outside-section" Repair Warn
        "an entry stands before the first section"
        "An entry belongs to the section above it. One with no section above has no meaning and is skipped."
    EDS005 MALFORMED_HEADER "malformed-header" Repair Warn
        "a section header isn't `[name]`"
        "A section header is the name of the section between `[` and `]`, with nothing but a comment behind it. A \
        header without its closing bracket is read up to the end of the line."
    EDS006 INDENTED_HEADER "indented-header" Repair Warn
        "a section header isn't in the first column"
        "CiA 306 wants `[` in the leftmost column. Some readers take an indented header for a value of the section \
        above, and lose the section."
    EDS007 DUPLICATE_SECTION "duplicate-section" Repair Warn
        "a section occurs twice"
        "Section names are unique, without regard to case. The entries of both are merged; where both have a key, \
        the later one wins, and EDS008 says so."
    EDS008 DUPLICATE_KEY "duplicate-key" Repair Warn
        "a key occurs twice in a section"
        "Keys are unique in a section, without regard to case. The last value is used, as most readers do."
    EDS009 LONG_LINE "long-line" Lint Warn
        "a line has over 255 characters"
        "CiA 306 limits a line to 255 characters. Readers with a fixed buffer cut the line, or read the rest as a \
        line of its own."
    EDS010 ILLEGAL_SECTION_NAME "illegal-section-name" Repair Warn
        "a section name breaks the grammar of CiA 306"
        "An object's section is its index as four hexadecimal digits, a sub-index's is `<index>sub<n>` with the \
        sub-index in hexadecimal. Neither has leading zeros beyond that, a `0x`, or blanks."
    EDS011 UNKNOWN_SECTION "unknown-section" Lint Warn
        "a section has no meaning in CiA 306"
        "Lexibus keeps the entries as extension attributes of the device. Often the name is misspelt."
    EDS012 UNKNOWN_KEY "unknown-key" Lint Allow
        "a key has no meaning in CiA 306"
        "Lexibus keeps the entry as an extension attribute of its object. Tools add keys of their own, so that \
        this lint is off unless asked for."
    EDS013 NOT_UTF8 "not-utf8" Repair Warn
        "the file isn't ASCII or UTF-8"
        "CiA 306 allows ASCII only. This file has bytes that aren't valid UTF-8 either; they were read as \
        Windows-1252, in which German or French tools commonly write."
    EDS014 HASH_COMMENT "hash-comment" Repair Warn
        "a value is followed by a `#` comment"
        "CiA 306 has no comment behind a value. Text from ` #` on was cut off the value of a key that has a fixed \
        form (a number, an access type)."
    EDS015 TRAILING_TEXT "trailing-text" Repair Warn
        "text behind a value was cut off"
        "The value of this key has a fixed form, and more text follows it."
    EDS016 QUOTED_VALUE "quoted-value" Repair Warn
        "a text is in quotation marks"
        "CiA 306 writes texts without quotation marks; a reader that follows it shows them as part of the name. \
        One pair was removed."
    EDS020 OCTAL_NUMBER "octal-number" Repair Warn
        "a number starts with 0 and so is octal"
        "In CiA 306, as in C, `012` is the octal number 10. Few authors mean that. Write the number in decimal or \
        as `0x…`."
    EDS021 LEADING_ZERO "leading-zero" Repair Warn
        "a number starts with 0 but was read as decimal"
        "A leading zero makes a number octal. This one has the digits 8 or 9, so that it can only be meant as \
        decimal, or is the same number either way. It was read as decimal."
    EDS022 ILLEGAL_NUMBER "illegal-number" Repair Warn
        "a value is no number"
        "The key wants a number (decimal, `0x` hexadecimal, or a $NODEID formula). The text is kept as it is, and \
        no number is derived from it."
    EDS023 HEX_SUFFIX "hex-suffix" Repair Warn
        "a hexadecimal number is written with an `h`"
        "CiA 306 writes hexadecimal numbers with `0x` in front. `NNh` was read as hexadecimal."
    EDS024 TWOS_COMPLEMENT "twos-complement" Repair Warn
        "a bit pattern was given for a signed value"
        "The number doesn't fit the signed data type, but its bits do. It was read as two's complement: 0xFFFFFFFF \
        is -1 for an INTEGER32. Write the negative number."
    EDS025 OUT_OF_TYPE "out-of-type" Lint Warn
        "a value doesn't fit its data type"
        "No value of this data type can be as large or small. It is kept in the IR; generated code clamps a limit \
        to the type and leaves such a default out."
    EDS026 REVERSED_NODEID "reversed-nodeid" Repair Warn
        "a formula doesn't start with $NODEID"
        "CiA 306 wants `$NODEID+0x180`; in the other order the text is no formula, and readers that follow the \
        grammar drop the value."
    EDS027 UNKNOWN_FORMULA "unknown-formula" Repair Warn
        "a formula has an unknown form"
        "Only sums of $NODEID and numbers are defined. The text is kept as it is. If it is another name of the \
        node-ID, name it as an alias (`--node-id-alias`)."
    EDS028 REAL_FOR_INTEGER "real-for-integer" Repair Warn
        "a decimal fraction was given for an integer"
        "The data type is an integer and the number has a decimal point. A fraction of zero was dropped; any other \
        value is kept as text."
    EDS029 DECIMAL_COMMA "decimal-comma" Repair Warn
        "a real number has a decimal comma"
        "Real numbers were read with the comma as decimal point."
    EDS030 REAL_AS_HEX "real-as-hex" Repair Warn
        "a hexadecimal number of odd length was given for a real"
        "For a REAL32 or REAL64, exactly 8 or 16 hexadecimal digits are read as the bits of the IEEE 754 number. \
        With another count of digits the number itself was taken."
    EDS031 DOMAIN_DEFAULT "domain-default" Repair Warn
        "a domain has a default value"
        "A DOMAIN is a block of data of any length and has no default. The text is kept as it is."
    EDS032 NOT_BOOLEAN "not-boolean" Repair Warn
        "a flag is neither 0 nor 1"
        "The key is a flag. `True`, `0x1` and the like were read for what they mean."
    EDS033 UNKNOWN_ACCESS "unknown-access" Repair Warn
        "an access type isn't one of ro, wo, rw, rwr, rww, const"
        "`r` was read as ro and `w` as wo; anything else leaves the item read-only, which can do no harm."
    EDS034 MISSING_ACCESS "missing-access" Repair Warn
        "an object has no access type"
        "AccessType is mandatory but for domains. Without it the item is kept read-only."
    EDS035 MISSING_DATA_TYPE "missing-data-type" Repair Warn
        "a variable has no data type"
        "DataType is mandatory for variables. Without it the item is kept read-only, as raw bytes."
    EDS036 UNKNOWN_DATA_TYPE "unknown-data-type" Repair Warn
        "a data type isn't known"
        "The number is neither a basic type of CiA 301 nor an object of this file that defines a type. The item is \
        kept as raw bytes."
    EDS037 BAD_OCTETS "bad-octets" Repair Warn
        "an octet string isn't hexadecimal"
        "Octet strings are pairs of hexadecimal digits. The text is kept as it is."
    EDS038 EMPTY_NAME "empty-name" Lint Warn
        "an object has no name"
        "ParameterName is mandatory. Generated code names the object by its index."
    EDS039 COMPLEX_DATA_TYPE "complex-data-type" Lint Warn
        "an entry has a reserved or a record data type"
        "A single value can't have a record type (0x20 to 0x23) or a reserved code. It is kept as raw bytes."
    EDS040 ORPHAN_SUB "orphan-sub" Repair Warn
        "a sub-index has no object"
        "There is a section for a sub-index, but none for its object. A RECORD was made to hold it."
    EDS041 LISTED_NOT_DESCRIBED "listed-not-described" Lint Warn
        "an object is listed but not described"
        "The list announces an object that has no section, so that nothing is known of it."
    EDS042 NOT_LISTED "not-listed" Lint Warn
        "an object is described but not listed"
        "Every object belongs into one of [MandatoryObjects], [OptionalObjects] and [ManufacturerObjects]; many \
        readers look at nothing else. The object is kept."
    EDS043 LIST_COUNT "list-count" Repair Warn
        "an object list doesn't have as many entries as it says"
        "SupportedObjects is the number of entries, which are numbered from 1. The entries that exist are used."
    EDS044 LISTED_TWICE "listed-twice" Lint Warn
        "an object is listed twice"
        "One mention is enough; the second says nothing new."
    EDS045 WRONG_LIST "wrong-list" Lint Warn
        "an object is in the wrong list"
        "[MandatoryObjects] holds 0x1000, 0x1001 and 0x1018; [ManufacturerObjects] 0x2000 to 0x5FFF; \
        [OptionalObjects] the others from 0x1000 on."
    EDS046 SUB_NUMBER "sub-number" Repair Warn
        "SubNumber isn't the number of sub-indices"
        "SubNumber counts the described sub-indices including 0, without 0xFF. The sections that exist are used."
    EDS047 VAR_WITH_SUBS "var-with-subs" Repair Warn
        "a VAR has sub-indices"
        "An object of type VAR is one value. This one has sub-indices and no data type of its own, so that it is \
        treated as a RECORD."
    EDS048 COMPACT_AND_SUBS "compact-and-subs" Repair Warn
        "CompactSubObj and SubNumber are both given"
        "Either the sub-indices are described one by one or all at once. What is described stays as it is, and the \
        compact description fills the gaps."
    EDS049 SUB0_MISMATCH "sub0-mismatch" Lint Warn
        "sub-index 0 doesn't give the highest sub-index"
        "The default of sub-index 0 should be the highest sub-index that exists (CiA 301 7.4.3). PDO mappings and \
        0x1003 are exempt, because there it is the number of valid entries."
    EDS050 DEFAULT_OUT_OF_LIMITS "default-out-of-limits" Lint Warn
        "a default lies outside of its limits"
        "The device could not be written with its own default. One of the three numbers is wrong."
    EDS051 LIMITS_SWAPPED "limits-swapped" Lint Warn
        "LowLimit is greater than HighLimit"
        "No value satisfies the limits. They are kept, and generated code doesn't check them."
    EDS052 HEADER_FORMAT "header-format" Lint Warn
        "a version, date or time has another form"
        "CiA 306: versions are whole numbers, EDSVersion is `x.y`, dates are `mm-dd-yyyy`, times `hh:mm` with AM \
        or PM. The text is kept."
    EDS053 OLD_EDS_VERSION "old-eds-version" Lint Warn
        "the file says it is older than EDS 4.0"
        "Files before version 4.0 lack CompactSubObj, ObjFlags and $NODEID in limits, and describe modules \
        differently. A missing EDSVersion means 3.0."
    EDS054 UNRESOLVED_MODULE "unresolved-module" Lint Warn
        "a module or extension is announced but not described"
        "A module's sections are named `[M<n>ModuleInfo]`, `[M<n>FixedObjects]`, `[M<n>SubExtends]`, and so on. \
        What is announced without them is kept empty."
    EDS055 DANGLING_LINK "dangling-link" Lint Warn
        "an object link leads nowhere"
        "[<index>ObjectLinks] names an object that the file doesn't describe."
    EDS056 NAME_WITHOUT_SUB "name-without-sub" Lint Warn
        "a name, value or denotation is given for a sub-index that doesn't exist"
        "The sections [<index>Name], [<index>Value] and [<index>Denotation] refine the sub-indices of \
        CompactSubObj. This entry has none to refine."
    EDS057 NO_SUBS "no-subs" Lint Warn
        "an ARRAY or RECORD has neither SubNumber nor CompactSubObj"
        "Nothing says which sub-indices the object has. The sections that exist are used."
    EDS058 NO_SUB0 "no-sub0" Lint Warn
        "sub-index 0 isn't described"
        "Every ARRAY and RECORD has a sub-index 0 (CiA 301 7.4.3)."
    EDS059 ARRAY_TYPES "array-types" Lint Warn
        "the elements of an array have different types"
        "All elements of an ARRAY have one data type; an object with different ones is a RECORD."
    EDS060 SUB0_ACCESS "sub0-access" Lint Allow
        "sub-index 0 can be written and its entries can't, or the other way round"
        "Sub-index 0 holds the highest sub-index. Writing it makes sense only where the number of valid entries can \
        change, as in a PDO mapping or a list of errors; then the entries can be written too, or the list is \
        cleared by writing 0."
    EDS061 IDENTITY_MISMATCH "identity-mismatch" Lint Warn
        "object 0x1018 and [DeviceInfo] disagree"
        "VendorNumber, ProductNumber and RevisionNumber are the defaults of 0x1018 sub-index 1 to 3. A master that \
        checks the identity of a node would reject the device, or accept another."
    EDS062 MISSING_ENTRY "missing-entry" Lint Allow
        "a mandatory entry is missing"
        "CiA 306 makes the entry mandatory. Lexibus uses the default that most tools assume."
    EDS063 MISSING_MANDATORY_OBJECT "missing-mandatory-object" Lint Warn
        "a mandatory object is missing"
        "Every CANopen device has the objects 0x1000, 0x1001 and 0x1018 (CiA 301 7.5.2)."
    EDS064 VALUE_NOT_ALLOWED "value-not-allowed" Lint Warn
        "a value isn't allowed for its key"
        "The key has a small set or range of values. This one isn't among them; it is kept where the IR can hold \
        it."
    EDS065 COMPACT_WITHOUT_TYPE "compact-without-type" Lint Warn
        "a compact object has no data type"
        "The elements of CompactSubObj take their type from the object. Without DataType they are raw bytes."
    EDS066 STRUCTURE_ENTRY "structure-entry" Lint Warn
        "sub-index 0xFF is counted as an element"
        "Sub-index 0xFF describes the structure of the object (CiA 301 7.4.7.2). It is documented, but it is no \
        element, and SubNumber doesn't count it."
    EDS067 UNKNOWN_OBJECT_TYPE "unknown-object-type" Repair Warn
        "an object type isn't known"
        "ObjectType is one of 0 (NULL), 2 (DOMAIN), 5 (DEFTYPE), 6 (DEFSTRUCT), 7 (VAR), 8 (ARRAY) and 9 (RECORD). \
        Any other was read by what the section describes."
    EDS068 TYPE_AREA_OBJECT "type-area-object" Lint Warn
        "an object stands in the data type area"
        "Objects below 0x1000 define data types; they have no value to read, and object type DEFTYPE or DEFSTRUCT."
    EDS069 MISSING_SECTION "missing-section" Lint Warn
        "a mandatory section is missing"
        "An EDS has the sections [FileInfo], [DeviceInfo] and [MandatoryObjects]; a file of a modular device that \
        describes modules has [SupportedModules]."
    EDS070 NOT_ALLOWED_ENTRY "not-allowed-entry" Lint Allow
        "an entry has no meaning in its section"
        "The key is one of CiA 306, but says nothing where it stands: a DataType or a DefaultValue of an object whose \
        values are its sub-indices, or a SubNumber of a single value. It is kept as an extension attribute."
    EDS071 HEX_COUNT "hex-count" Lint Warn
        "a number of entries is in hexadecimal"
        "The number of entries of a list is read as decimal by many tools, which then see an empty list."
    XML001 MALFORMED_XML "malformed-xml" Error Deny
        "the XML isn't well formed"
        "The file can't be read further than to this place: a tag isn't closed, an attribute isn't quoted, or the \
        file was cut off."
    XML002 ENTITY_REFERENCE "entity-reference" Repair Warn
        "an entity isn't one of the five of XML"
        "Lexibus expands no entities other than those that XML itself defines, so that a small file can't grow \
        into a large one. The reference is kept as text."
    XML003 WRONG_ENCODING "wrong-encoding" Repair Warn
        "the file isn't in the encoding that it declares"
        "The XML declaration names an encoding (UTF-8 where there is none), and the bytes are of another one. Bytes \
        that are UTF-8 were read as such whatever is declared, all others as declared, or else as Windows-1252."
    XML004 SECOND_ROOT "second-root" Repair Warn
        "something follows the root element"
        "A document has one root element, and nothing but comments behind it. What follows was left out: often it is \
        the rest of an older, longer version of the file."
    XML005 REFERENCED_FILE "referenced-file" Lint Warn
        "a file that the description refers to wasn't read"
        "References are followed to files beside the description or in folders below it, never elsewhere. What the \
        file would have added is missing."
    XDD002 POWERLINK_XDD "powerlink-xdd" Error Deny
        "a POWERLINK XDD was given"
        "Ethernet POWERLINK uses XDD files of the same outer form (EPSG 311), with other communication profiles. \
        Lexibus reads the CANopen ones."
    XDD003 NOT_A_CANOPEN_XDD "not-a-canopen-xdd" Error Deny
        "the XML is no CANopen device description"
        "The root element of an XDD or XDC is ISO15745ProfileContainer (or ISO15745Profile), with a profile body \
        for the device and one for the CANopen communication network."
    XDD004 DANGLING_REFERENCE "dangling-reference" Repair Warn
        "a uniqueIDRef leads nowhere"
        "An object, template or text refers to an element by its uniqueID, and no element has it."
    XDD005 UNKNOWN_ELEMENT "unknown-element" Lint Allow
        "an element has no meaning in CiA 311"
        "The element is kept as an extension attribute where it has a value."
    XDD006 XDD_VALUE "xdd-value" Repair Warn
        "an attribute's value has an unknown form"
        "CiA 311 fixes the form of the attribute. The text is kept where the IR can hold it."
    XDD007 DUPLICATE_OBJECT "duplicate-object" Repair Warn
        "an object or sub-object occurs twice"
        "Index and sub-index are unique in an object list. The last one is used."
    XDD008 MISSING_INDEX "missing-index" Repair Warn
        "an object has no usable index"
        "Without an index or sub-index in hexadecimal digits the object can't be addressed; it is left out."
    PDO001 MAPPED_OBJECT_MISSING "mapped-object-missing" Lint Warn
        "a PDO maps an object that doesn't exist"
        "The mapping names an index and sub-index that this file doesn't describe. The field is kept as raw bits."
    PDO002 NOT_MAPPABLE "not-mappable" Lint Warn
        "a PDO maps an object that isn't mappable"
        "The object's PDOMapping is 0. A device answers such a mapping with abort code 0x06040041."
    PDO003 WRONG_DIRECTION "wrong-direction" Lint Warn
        "a PDO maps an object against its access"
        "A TPDO carries what can be read (ro, const, rw, rwr), an RPDO what can be written (wo, rw, rww); rwr and \
        rww say the direction themselves."
    PDO004 PDO_TOO_LONG "pdo-too-long" Lint Warn
        "a PDO is longer than 64 bits"
        "A CAN frame carries 8 bytes (CiA 301 7.5.2.36). A device answers with abort code 0x06040042."
    PDO005 MAPPED_LENGTH "mapped-length" Lint Warn
        "a PDO maps an object with another length"
        "The mapping's length in bits isn't the length of the object's data type. The mapping's length decides the \
        layout."
    PDO006 MAPPING_GAP "mapping-gap" Lint Warn
        "a PDO mapping has a gap"
        "An entry is empty although later ones aren't. The entries behind the gap are taken as they stand."
    PDO007 UNMAPPABLE_TYPE "unmappable-type" Lint Warn
        "a PDO maps a type of variable length"
        "Strings and domains have no fixed length and can't be mapped, unless their length is fixed by the device."
    PDO008 DUMMY_IN_TPDO "dummy-in-tpdo" Lint Warn
        "a TPDO maps a dummy entry"
        "Dummy entries (0x0001 to 0x0007) reserve room in an RPDO. A TPDO must not have any (CiA 301 7.4.9)."
    PDO009 DUMMY_NOT_SUPPORTED "dummy-not-supported" Lint Warn
        "a PDO maps a dummy entry that [DummyUsage] excludes"
        "[DummyUsage] says which data types the device accepts as dummy entries. This one is missing there, or 0."
    PDO010 PDO_COUNT "pdo-count" Lint Warn
        "NrOfRXPDO or NrOfTXPDO isn't the number of PDOs"
        "The file describes more PDOs than [DeviceInfo] announces, or fewer and no CompactPDO says what the others \
        look like."
    PDO011 GRANULARITY "granularity" Lint Warn
        "a mapping is finer than the device's granularity"
        "Granularity is the smallest unit of mapping in bits: 8 for bytes, 1 for bits, 0 when mappings are fixed. \
        The entry's length isn't a multiple of it."
    PDO012 MULTIPLEXED_PDO "multiplexed-pdo" Lint Warn
        "a multiplexed PDO doesn't go with the device's description"
        "Sub-index 0 of the mapping says 254 or 255 (multiplexed PDO), but GroupMessaging is 0."
    PDO013 PDO_COUNT_1004 "pdo-count-1004" Lint Warn
        "object 0x1004 and [DeviceInfo] disagree"
        "0x1004 holds the number of PDOs in its upper and lower 16 bits. The numbers differ from NrOfRXPDO and \
        NrOfTXPDO."
    PDO014 HALF_A_PDO "half-a-pdo" Lint Warn
        "a PDO has a communication or a mapping object, but not both"
        "Every PDO is described by two objects: 0x1400+n goes with 0x1600+n, and 0x1800+n with 0x1A00+n. One of the \
        two isn't there."
    PDO015 MAPPING_UNREADABLE "mapping-unreadable" Lint Warn
        "a PDO mapping entry isn't a number"
        "A mapping entry is index, sub-index and length in bits, as one UNSIGNED32. It can't depend on the \
        node-ID."
    PDO016 MAPPING_COUNT "mapping-count" Lint Warn
        "sub-index 0 of a mapping and its entries disagree"
        "Sub-index 0 is the number of mapped objects. It announces more entries than are filled in."
    PDO017 UNCLEAR_DIRECTION "unclear-direction" Lint Allow
        "a PDO maps an object whose access doesn't tell the direction"
        "CiA 306 has rwr for objects that go into a TPDO and rww for those that come in an RPDO. Plain rw allows both, \
        and a tool can't tell which of the two the device means."
    MOD001 MODULE_INDEX_CLASH "module-index-clash" Lint Warn
        "a module's fixed object exists in the device already"
        "The fixed objects of a module get an index of their own; the device describes this one itself, so that one \
        index would stand for two objects."
    MOD002 SUB_EXTEND "sub-extend" Lint Warn
        "a sub-index extension isn't described as CiA 306 wants"
        "[M<n>SubExt<index>] needs a place in [M<n>SubExtends], Count (a number of sub-indices; or 0, `;` and a number \
        of bits), ObjExtend 0 or 1, and the keywords of a VAR. The object that it extends has sub-indices."
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
