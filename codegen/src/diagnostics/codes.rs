//! Catalog of diagnostic codes: identifier, name, class, default level and explanation of each code.
//!
//! A published code keeps its meaning. The identifier of a retired code is never reused.

use super::Level;

/// Class of a code. The class determines whether a code is always an error, or an error in strict mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// The input cannot be used. These codes are always errors.
    Error,
    /// The input breaks a rule, and was repaired or kept as text. These codes are errors in strict mode, unless the
    /// user sets their level.
    Repair,
    /// The input is suspicious, but was read unchanged.
    Lint,
}

impl Class {
    /// Returns the name of the class, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Class::Error => "error",
            Class::Repair => "repair",
            Class::Lint => "lint",
        }
    }
}

/// The code for one kind of diagnostics, with a stable identifier.
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct Code {
    /// Stable identifier of the code, such as `EDS020`.
    pub id: &'static str,
    /// Stable name of the code, such as `octal-number`.
    pub name: &'static str,
    /// Class of the code.
    pub class: Class,
    /// Level of the code, unless the user sets another level.
    pub default: Level,
    /// Summary of the problem, in lower case and without a full stop.
    pub summary: &'static str,
    /// Explanation that `lexibus explain` prints: meaning, consequence and remedy. A line feed in the text ends a
    /// paragraph.
    pub explanation: &'static str,
}

/// Returns the code with this identifier or name, ignoring case. Returns `None` if there is no such code.
pub fn find(name: &str) -> Option<&'static Code> {
    CODES.iter().copied().find(|code| code.id.eq_ignore_ascii_case(name) || code.name.eq_ignore_ascii_case(name))
}

/// Returns the most similar identifier or name, if one is similar enough to `name` for a suggestion.
pub fn similar(name: &str) -> Option<&'static str> {
    crate::text::similar(name, CODES.iter().flat_map(|code| [code.id, code.name]))
}

/// Returns the name of a code, derived from its constant: `octal-number` for `OCTAL_NUMBER`.
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
            #[allow(rustdoc::broken_intra_doc_links, reason = "the section names of an EDS have brackets")]
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

        /// All codes, in the order of the catalog.
        pub static CODES: &[&Code] = &[$(&$constant),*];
    };
}

codes! {
    IO001 UNREADABLE_FILE Error Deny "a file cannot be read"
        "The operating system refused to open or read the file, or the file exceeds the size limit. The message quotes \
        the reason. Check the path and the permissions. If the command takes a list of files, check the working \
        directory too."
    IO002 UNKNOWN_FORMAT Error Deny "the file is not a device description"
        "Neither the content nor the name of the file matches a format that Lexibus reads. The formats are EDS and DCF \
        (CiA 306), XDD and XDC (CiA 311), ESI (ETG.2000), GSDML, and register tables in TOML. The message names the \
        actual format if Lexibus recognizes it. Check that this is the right file."
    IO003 INPUT_TOO_LARGE Error Deny "the description exceeds a limit"
        "The file declares more elements, or nests them deeper, than any real device does. Lexibus rejects it, because \
        reading it would take too much time or memory. The module `lexibus_codegen::limits` documents all limits. \
        Correct the element that the message names, such as a count or a range."
    IO004 NOTHING_SELECTED Error Deny "nothing in the description matches the selection"
        "You can select devices, modules and objects by name, order code, product code and revision. Nothing in the \
        file matches, so Lexibus produces no output. Run `lexibus info` to list what the file contains."
    EDS001 ETHERNET_IP_EDS Error Deny "the file is an EtherNet/IP EDS, not a CANopen EDS"
        "ODVA uses the name EDS for descriptions of EtherNet/IP, DeviceNet and ControlNet devices. Their sections are \
        `[File]`, `[Device]` and `[Params]`, and their lists end in `;`. The two formats share only the name and the \
        square brackets. Lexibus rejects the file. Ask the vendor for the CANopen EDS of the device."
    EDS002 NOT_AN_EDS Error Deny "the file has no section that CiA 306 defines"
        "The file name ends in `.eds` or `.dcf`, but the file has no `[DeviceInfo]`, no object list and no object such \
        as `[1000]`. The file may be a symbolic link that was checked out as text. Lexibus rejects the file. Check \
        that this is the right file."
    EDS003 JUNK_LINE Repair Warn "a line is neither a section header, an entry nor a comment"
        "CiA 306 defines section headers, `Key=Value` entries and comment lines that start with `;`. Any other line is \
        often a wrapped value, a merge marker or an include directive of another tool. Lexibus skips the line. Delete \
        the line, or join it with the value that it continues."
    EDS004 ENTRY_OUTSIDE_SECTION Repair Warn "an entry is above the first section"
        "An entry belongs to the section above it, so an entry without a section has no meaning. Lexibus skips the \
        entry. Move the entry below a section header."
    EDS005 MALFORMED_HEADER Repair Warn "a section header is not `[name]`"
        "A section header is the section name between `[` and `]`. Only a comment may follow it. Lexibus reads a \
        header without `]` up to the end of the line, and skips text after `]`. Close the bracket, or delete the text."
    EDS006 INDENTED_HEADER Repair Warn "a section header is not in the first column"
        "CiA 306 requires `[` in the first column. Some tools read an indented header as a value of the section above, \
        and lose the section. Lexibus reads the section all the same. Delete the spaces before `[`."
    EDS007 DUPLICATE_SECTION Repair Warn "a section occurs twice"
        "Section names must be unique. Case does not matter. Lexibus merges the entries of both sections. If both have \
        a key, the later value takes precedence and EDS008 reports it. Merge the sections in the file, because other \
        tools may read only one of them."
    EDS008 DUPLICATE_KEY Repair Warn "a key occurs twice in a section"
        "Keys must be unique in a section. Case does not matter. Lexibus uses the last value, as most tools do. If CiA \
        306 does not define the key, Lexibus keeps both entries. Delete the wrong entry."
    EDS009 LONG_LINE Lint Warn "a line has more than 255 characters"
        "CiA 306 limits a line to 255 characters. Tools with a fixed buffer cut the line, or read the rest as a \
        separate line. Lexibus reads the whole line. Shorten the line if other tools use the file."
    EDS010 ILLEGAL_SECTION_NAME Repair Warn "a section name breaks the grammar of CiA 306"
        "The section of an object is its index in four hexadecimal digits, such as `[2000]`. The section of a \
        sub-index is `[2000sub1]`, with the sub-index in hexadecimal. More leading zeros, a `0x` prefix and spaces are \
        not allowed. Lexibus reads `[0x2000]`, for example, as `[2000]`. Correct the name, because other tools may \
        lose the object."
    EDS011 UNKNOWN_SECTION Lint Warn "a section is not defined in CiA 306"
        "The section name is often misspelled. Lexibus keeps the entries as extension attributes of the device. \
        Correct the name, or allow this code if the section is meant for another tool."
    EDS012 UNKNOWN_KEY Lint Allow "a key is not defined in CiA 306"
        "Lexibus keeps the entry as an extension attribute of its object. Many tools add keys, so this lint is off by \
        default. Turn the lint on to find misspelled keys."
    EDS013 NOT_UTF8 Repair Warn "the file is neither ASCII nor UTF-8"
        "CiA 306 allows only ASCII. This file has bytes that are not valid UTF-8 either. Lexibus reads a file with a \
        byte order mark of UTF-16 as UTF-16, and any other file as Windows-1252, the usual encoding of German and \
        French tools. Save the file as ASCII or UTF-8."
    EDS014 HASH_COMMENT Repair Warn "a comment starts with `#`"
        "CiA 306 defines only comment lines that start with `;`. Lexibus skips lines that start with `#`. In a value \
        of a fixed form, such as a number, it ignores the text from ` #` on. Other tools may read that text as part of \
        the value. Write the comment on a separate line that starts with `;`."
    EDS015 TRAILING_TEXT Repair Warn "text follows a value"
        "The value of this key has a fixed form, such as a number, but more text follows it. Lexibus ignores the text, \
        and also the suffix of a C literal, as in `50u`. Delete the text."
    EDS016 QUOTED_VALUE Repair Warn "a text is in quotation marks"
        "In CiA 306, texts have no quotation marks. Tools that follow the standard show the quotation marks as part of \
        the name. Lexibus removes one pair of quotation marks. Delete the quotation marks."
    EDS020 OCTAL_NUMBER Repair Warn "a number with a leading zero is octal"
        "In CiA 306, as in C, `012` is the octal number 10. Few authors intend an octal number. Lexibus follows the \
        standard and reads the number as octal. Write the number in decimal or as `0x…`."
    EDS021 LEADING_ZERO Repair Warn "a number with a leading zero is read as decimal"
        "A leading zero makes a number octal. This number has the digits 8 or 9, or has the same value in octal and \
        decimal. Lexibus reads it as decimal. Delete the leading zero."
    EDS022 ILLEGAL_NUMBER Repair Warn "a value is not a number"
        "The key requires a number in its range: decimal, hexadecimal with `0x`, or a `$NODEID` formula. Lexibus keeps \
        the text or leaves the value out, as the diagnostic says, and derives no number from it. Correct the value."
    EDS023 HEX_SUFFIX Repair Warn "a hexadecimal number has the suffix `h`"
        "In CiA 306, hexadecimal numbers have the prefix `0x`. Lexibus reads `1Fh` as 0x1F. Write the prefix, because \
        other tools may not read the suffix."
    EDS024 TWOS_COMPLEMENT Repair Warn "a signed value is given as a bit pattern"
        "The number is too large for the signed data type, but fits the unsigned data type of the same length. Lexibus \
        reads the bits as two's complement: `0xFFFFFFFF` is -1 for an INTEGER32. Write the negative number."
    EDS025 OUT_OF_TYPE Lint Warn "a value does not fit its data type"
        "The data type cannot hold a value that large or small. Lexibus keeps the value in the intermediate \
        representation. Generated code clamps a limit to the type and leaves out a default value. Correct the value or \
        the data type."
    EDS026 REVERSED_NODEID Repair Warn "a formula does not start with `$NODEID`"
        "CiA 306 requires the form `$NODEID+0x180`. Tools that follow the grammar ignore a formula in the reverse \
        order. Lexibus reads the formula as the standard form. Write `$NODEID` first."
    EDS027 UNKNOWN_FORMULA Repair Warn "a node-ID formula is not defined in CiA 306"
        "CiA 306 defines only sums of `$NODEID` and numbers. Lexibus keeps any other formula as text. Correct the \
        formula. If it contains another name for the node-ID, declare the name with `--node-id-alias`."
    EDS028 REAL_FOR_INTEGER Repair Warn "a decimal fraction is given for an integer"
        "The data type is an integer, but the number has a decimal point. If all decimals are zero, Lexibus drops them \
        and reads `20.0` as 20. It keeps any other number with a decimal point as text. Write an integer, or correct \
        the data type."
    EDS029 DECIMAL_COMMA Repair Warn "a real number has a decimal comma"
        "Lexibus reads the comma as the decimal point: `1,5` is 1.5. Other tools may reject the number or drop the \
        digits after the comma. Write a decimal point."
    EDS030 REAL_AS_HEX Repair Warn "a real number has the wrong number of hexadecimal digits"
        "Lexibus reads a hexadecimal number as an IEEE 754 bit pattern if it has 8 digits for a REAL32, or 16 for a \
        REAL64. With fewer or more digits, it reads the digits as an integer: `0x02` is 2. Write the number in \
        decimal, or write all digits of the bit pattern."
    EDS031 DOMAIN_DEFAULT Repair Warn "a domain has a default value or a limit"
        "A DOMAIN is a block of data of any length. It has no default value and no limits. Lexibus keeps the value or \
        limit as text. Delete the value or limit, or correct the data type."
    EDS032 NOT_BOOLEAN Repair Warn "a flag is neither 0 nor 1"
        "The key is a flag, such as PDOMapping. Lexibus reads `True`, `0x1` and `2` as 1, and `no` as 0. Write 0 or 1, \
        because other tools may read the value differently."
    EDS033 UNKNOWN_ACCESS Repair Warn "an access type is not one of ro, wo, rw, rwr, rww, const"
        "Lexibus reads `r` as ro and `w` as wo. Lexibus makes items with any other access type read-only, so that \
        generated code never writes them by mistake. Write one of the six access types."
    EDS034 MISSING_ACCESS Repair Warn "an object has no access type"
        "AccessType is mandatory except for domains. Lexibus makes the item read-only, so generated code cannot write \
        the item. Add AccessType."
    EDS035 MISSING_DATA_TYPE Repair Warn "a variable has no data type"
        "DataType is mandatory for variables. Lexibus keeps the item as read-only raw bytes. Add DataType, such as \
        `0x0007` for UNSIGNED32."
    EDS036 UNKNOWN_DATA_TYPE Repair Warn "a data type is unknown"
        "The number is neither a basic type of CiA 301 nor an object of this file that defines a type. Lexibus keeps \
        the item as raw bytes. Correct DataType."
    EDS037 BAD_OCTETS Repair Warn "an octet string is not hexadecimal"
        "An octet string consists of pairs of hexadecimal digits. Lexibus keeps any other value as text. Write two \
        digits for each byte."
    EDS038 EMPTY_NAME Lint Warn "an object has no name"
        "ParameterName is mandatory. Generated code names the object by its index. In a register table, this code also \
        reports values and bits with an empty label. Add the missing name."
    EDS039 COMPLEX_DATA_TYPE Lint Warn "an entry has a reserved data type or a record type"
        "A single value cannot have a record type (0x20 to 0x23) or a reserved code. Lexibus keeps the value as raw \
        bytes. Correct DataType."
    EDS040 ORPHAN_SUB Repair Warn "a sub-index belongs to an object that is not described"
        "The file has a section for a sub-index, but none for its object. Lexibus creates an unnamed RECORD for the \
        sub-index. Describe the object with ObjectType and SubNumber."
    EDS041 LISTED_NOT_DESCRIBED Lint Warn "an object is listed but not described"
        "A list names an object that has no section. Lexibus leaves the object out, because nothing is known about it. \
        Add the section, or delete the object from the list."
    EDS042 NOT_LISTED Lint Warn "an object is described but not listed"
        "Every object from 0x1000 on belongs in `[MandatoryObjects]`, `[OptionalObjects]` or `[ManufacturerObjects]`, \
        and every object of a module in `[M<n>FixedObjects]`. Many tools read only the objects in these lists. Lexibus \
        keeps the object. Add the object to its list."
    EDS043 LIST_COUNT Repair Warn "a list states the wrong number of entries, or its numbering has a gap"
        "SupportedObjects, or a similar key, states the number of entries in the list. The entries are numbered from 1 \
        without a gap. Lexibus uses the entries that exist. Correct the number of entries or the numbering, because \
        other tools may ignore some of the entries."
    EDS044 LISTED_TWICE Lint Warn "an object is listed twice"
        "An object needs only one entry in the object lists. Lexibus ignores the second entry. Delete the second entry."
    EDS045 WRONG_LIST Lint Warn "an object is in the wrong list"
        "`[MandatoryObjects]` lists 0x1000, 0x1001 and 0x1018. `[ManufacturerObjects]` lists 0x2000 to 0x5FFF. \
        `[OptionalObjects]` lists all others from 0x1000 on. Lexibus keeps the object. Move the object to the right \
        list."
    EDS046 SUB_NUMBER Repair Warn "SubNumber is not the number of sub-indices"
        "SubNumber counts the described sub-indices, including 0 but not 0xFF. Lexibus uses the sections that exist. \
        Correct the number, or add the missing sections."
    EDS047 VAR_WITH_SUBS Repair Warn "a VAR has sub-indices"
        "An object of type VAR is a single value. This object has sub-indices and no data type, so Lexibus treats the \
        object as a RECORD. Write ObjectType `0x9` for a RECORD or `0x8` for an ARRAY."
    EDS048 COMPACT_AND_SUBS Repair Warn "CompactSubObj and SubNumber are both given"
        "An object describes its sub-indices one by one, or all at once with CompactSubObj. Lexibus keeps the \
        sub-indices that have a section, and fills the gaps from CompactSubObj. Delete one of the keys."
    EDS049 SUB0_MISMATCH Lint Warn "sub-index 0 does not state the highest sub-index"
        "The default value of sub-index 0 is the highest sub-index (CiA 301, 7.4.3). Tools that read all entries need \
        this number. PDO mappings, PDO assignments and 0x1003 are exempt, because their sub-index 0 is the number of \
        valid entries. Lexibus keeps the value. Correct the value, or describe the missing sub-indices."
    EDS050 DEFAULT_OUT_OF_LIMITS Lint Warn "a default value is outside of its limits"
        "The device would reject its own default value, so one of the numbers is wrong. Lexibus keeps all numbers. In a \
        DCF or XDC, this code also reports configured values, and in a register table, fixed values (`fixed`), allowed \
        values and writable values. Compare the numbers with the manual and correct the wrong number."
    EDS051 LIMITS_SWAPPED Lint Warn "the minimum is greater than the maximum"
        "No value satisfies the limits. Lexibus keeps the limits, but generated code does not check them. Correct \
        LowLimit or HighLimit. If one of the limits has the wrong sign, check the data type too."
    EDS052 HEADER_FORMAT Lint Warn "a version, date or time has the wrong form"
        "In CiA 306, versions are whole numbers, and EDSVersion is `x.y`. Dates are `mm-dd-yyyy`, and times are \
        `hh:mm` with AM or PM. Lexibus keeps the text. Correct the form of the text."
    EDS053 OLD_EDS_VERSION Lint Warn "the file is older than EDS 4.0"
        "Files before version 4.0 have no CompactSubObj, no ObjFlags and no `$NODEID` in limits. These files also \
        describe modules differently. A missing EDSVersion means 3.0. Ask the vendor for a newer file, or add \
        EDSVersion if only the key is missing."
    EDS054 UNRESOLVED_MODULE Lint Warn "the number of modules is wrong, or a section of a module is missing"
        "`[SupportedModules]` states the number of modules. The lists `[M<n>FixedObjects]` and `[M<n>SubExtends]` \
        declare the sections of the objects and extensions of a module. Lexibus reads the sections that exist. Correct \
        the number or the list, or add the missing sections."
    EDS055 DANGLING_LINK Lint Warn "an object link has no target"
        "`[<index>ObjectLinks]` names an object that the file does not describe. Lexibus keeps the link. Correct the \
        index, or describe the object."
    EDS056 NAME_WITHOUT_SUB Lint Warn "a name, value or denotation is given for a sub-index that does not exist"
        "The sections `[<index>Name]`, `[<index>Value]` and `[<index>Denotation]` refine the sub-indices of \
        CompactSubObj. Their keys are sub-indices in decimal. This code also reports these sections, and \
        `[<index>ObjectLinks]`, if the file does not describe the object. Lexibus keeps the entries as extension \
        attributes. Correct the key, or describe the object."
    EDS057 NO_SUBS Lint Warn "an ARRAY or RECORD has no sub-indices"
        "The values of an ARRAY or RECORD are in its sub-indices, so this object has no value to read or write. In an \
        EDS, neither sections nor CompactSubObj describe the sub-indices. Describe them."
    EDS058 NO_SUB0 Lint Warn "sub-index 0 is not described"
        "Every ARRAY and RECORD has a sub-index 0, which holds the highest sub-index (CiA 301, 7.4.3). Tools that \
        count the entries read it first. Lexibus keeps the object without it. Describe sub-index 0 as an UNSIGNED8."
    EDS059 ARRAY_TYPES Lint Warn "the elements of an array have different types"
        "All elements of an ARRAY have one data type. An object with different types is a RECORD. Lexibus keeps the \
        types. Correct the types, or change the object to a RECORD."
    EDS060 SUB0_ACCESS Lint Allow "only sub-index 0 of an object is writable, or sub-index 0 of a writable PDO mapping is not"
        "Sub-index 0 is writable only if the number of valid entries can change, as in a PDO mapping or an error list. \
        In such an object, the entries are writable too, or writing 0 clears the list. Lexibus keeps the access \
        rights. Many devices have such access rights on purpose, so this lint is off by default. Compare the access \
        rights with the manual."
    EDS061 IDENTITY_MISMATCH Lint Warn "object 0x1018 contradicts the identity of the device"
        "The vendor ID, product code and revision number of a device are the default values of 0x1018, sub-indices 1 to \
        3. In an EDS, `[DeviceInfo]` states these numbers. A master that checks the identity of a node would reject \
        the device, or accept another one. Lexibus uses the identity of the device, and ignores zeros in 0x1018. Read \
        0x1018 from the device and correct the file."
    EDS062 MISSING_ENTRY Lint Allow "a mandatory entry is missing"
        "CiA 306 requires the entry. Lexibus leaves the fact empty. Most tools do not need the entry, so this lint is \
        off by default. Add the entry if another tool requires it."
    EDS063 MISSING_MANDATORY_OBJECT Lint Warn "a mandatory object is missing"
        "Every CANopen device has the objects 0x1000, 0x1001 and 0x1018 (CiA 301, 7.5.2). Lexibus generates code \
        without the missing object. Check that the file is complete, and add the object."
    EDS064 VALUE_NOT_ALLOWED Lint Warn "a value is not allowed for its key"
        "The key has a small set or range of values, such as 1 to 127 for a node-ID. Lexibus keeps the value if the \
        intermediate representation can hold it. Lexibus reads a CompactSubObj above 254 as 254, and leaves out any \
        other value. Correct the value."
    EDS065 COMPACT_WITHOUT_TYPE Lint Warn "a compact object has no data type"
        "The elements of CompactSubObj have the data type of the object. Lexibus keeps the elements as read-only raw \
        bytes if DataType is missing. Add DataType."
    EDS066 STRUCTURE_ENTRY Lint Warn "sub-index 0xFF is counted as an element"
        "Sub-index 0xFF describes the structure of the object (CiA 301, 7.4.7.2). It is not an element, so SubNumber \
        does not count it. Lexibus keeps the description of sub-index 0xFF. Correct SubNumber."
    EDS067 UNKNOWN_OBJECT_TYPE Repair Warn "an object type is unknown"
        "ObjectType is 0 (NULL), 2 (DOMAIN), 5 (DEFTYPE), 6 (DEFSTRUCT), 7 (VAR), 8 (ARRAY) or 9 (RECORD). A sub-index \
        is a VAR or a DOMAIN. Lexibus reads an object with sub-indices as a RECORD and any other as a VAR. Correct \
        ObjectType."
    EDS068 TYPE_AREA_OBJECT Lint Warn "an object is in the data type area"
        "Objects below 0x1000 define data types. Such objects have the object type DEFTYPE or DEFSTRUCT, and no value \
        to read. Lexibus keeps the object as described. Correct the index or ObjectType."
    EDS069 MISSING_SECTION Lint Warn "a mandatory section is missing"
        "An EDS has the sections `[FileInfo]`, `[DeviceInfo]` and `[MandatoryObjects]`. A file that describes modules \
        has `[SupportedModules]`. Lexibus reads the sections that exist. Add the missing section, because other tools \
        may reject the file."
    EDS070 NOT_ALLOWED_ENTRY Lint Allow "an entry has no meaning in its section"
        "CiA 306 defines the key, but not for this kind of object. Examples are DataType for an object with \
        sub-indices, and SubNumber for a single value. Lexibus keeps the entry as an extension attribute. Tools \
        often repeat the type at the object, so this lint is off by default. Delete the entry, or correct ObjectType."
    EDS071 HEX_COUNT Lint Warn "the number of list entries is hexadecimal"
        "Many tools read the number of entries of a list only as decimal, and then see an empty list. Lexibus reads \
        hexadecimal too. Write the number in decimal."
    EDS072 MISSPELLED_KEY Lint Warn "an unknown key is similar to a missing key"
        "The key of an entry is not defined in CiA 306 and differs in at most two letters from a key that the object \
        lacks. Lexibus keeps the entry as an extension attribute and does not use its value. Correct the key if it is \
        misspelled."
    XML001 MALFORMED_XML Error Deny "the XML is not well-formed"
        "A tag is not closed, an attribute is not quoted, or the file is cut off. Lexibus cannot read beyond this \
        position and rejects the file. Correct the XML, or get a complete copy of the file."
    XML002 ENTITY_REFERENCE Repair Warn "a reference is neither a predefined entity nor a valid character reference"
        "XML predefines the entities `&amp;`, `&lt;`, `&gt;`, `&quot;` and `&apos;`. Lexibus expands no other entities, \
        so that a small file cannot grow into a large one. Lexibus keeps other references as text. Write the character \
        itself, and `&amp;` for `&`."
    XML003 WRONG_ENCODING Repair Warn "the declared encoding of the file is wrong or not supported"
        "The XML declaration names an encoding. The default is UTF-8. Lexibus reads a file that is valid UTF-8 as \
        UTF-8, even if the declaration names another encoding. It reads other files in the declared encoding, or as \
        Windows-1252 if that fails. Bytes that are invalid in the encoding are lost. Save the file as UTF-8, and \
        declare UTF-8 in the XML declaration."
    XML004 SECOND_ROOT Repair Warn "content follows the root element"
        "A document has one root element, and only comments and processing instructions may follow it. The content is \
        often the rest of an older, longer version of the file. Lexibus ignores the content in an ESI, and rejects any \
        other file with the error XML001. Delete the content."
    XML005 REFERENCED_FILE Lint Warn "a referenced file was not read, or lacks the expected content"
        "Lexibus follows references only to files in the folder of the description and in folders below it. The content \
        of the referenced file is missing. Put the file into one of these folders, under the name in the reference."
    XML006 MISSPELLED_NAME Lint Warn "an unknown element or attribute is similar to a known one"
        "The standard does not define the element or attribute at this position. Its name differs in one letter from a \
        name that Lexibus reads, or in two letters if it has more than eight. Lexibus keeps the value as an extension \
        attribute and does not use it. Correct the name if it is misspelled."
    ESI001 ESI_VALUE Repair Warn "an attribute or element is missing or has an invalid value"
        "ETG.2000 requires the value, or fixes its form, such as a decimal number, `#x` with hexadecimal digits, or one \
        of a few words. Lexibus leaves the value out, or keeps it as text if the intermediate representation can hold \
        it. Add or correct the value."
    ESI002 ESI_UNKNOWN_ELEMENT Lint Allow "an element or attribute is not defined in ETG.2000"
        "Lexibus keeps the element or attribute as an extension attribute. Tools add elements outside of \
        VendorSpecific, so this lint is off by default. XML006 reports likely misspellings."
    ESI003 BARE_HEX Repair Warn "a hexadecimal number has no `#x`"
        "A number is decimal unless it starts with `#x`. This number has hexadecimal letters, so Lexibus reads it as \
        hexadecimal. Lexibus reads numbers without letters as decimal, although the author may have meant them as \
        hexadecimal too. Write `#x` before all hexadecimal numbers."
    ESI010 UNRESOLVED_TYPE Repair Warn "a data type is unknown or missing"
        "The name is neither a DataType of this dictionary nor a base data type of ESI, or the DataType defines only \
        its name. Or an object or sub-item has no type. Lexibus keeps the value as raw bytes. Define the type in \
        DataTypes, or use a base data type such as UINT."
    ESI011 TYPE_ALIAS Lint Allow "a base data type has a name from another standard"
        "ESI calls the base data types USINT, UINT, UDINT and so on. This file uses the name of the same type in CiA \
        301 or C, such as UNSIGNED16. Lexibus reads the name as the base data type of the same size, so this lint is off \
        by default. Use the ESI name if another tool requires it."
    ESI012 GUESSED_TYPE Repair Warn "a data type was guessed from the beginning of its name"
        "The name begins with the name of a base data type, as in `UINT_hex`. The sizes agree, and no DataType \
        has this name. Lexibus uses the base data type. Define the type, or use the name of the base data type."
    ESI013 DUPLICATE_TYPE Repair Warn "two data types have the same name"
        "A reference to this name can mean either type. Lexibus uses the first type, as most tools do. Rename one of \
        the types."
    ESI014 SUB_ITEM_NAME Lint Warn "a sub-item has no unique name"
        "The name is missing, or another sub-item of the data type has the same name. Generated code distinguishes the \
        sub-items by sub-index. Give each sub-item a unique name."
    ESI015 ENDLESS_TYPE Repair Warn "a data type contains itself"
        "A BaseType or SubItem leads back to the data type, or its types are nested too deeply. Lexibus keeps the \
        nested data as raw bytes. Correct the reference."
    ESI016 MISSING_BASE_TYPE Repair Warn "an enumeration or array has no usable BaseType"
        "BaseType is the integer type of an enumeration, or the element type of an array. Lexibus reads an enumeration \
        without BaseType as an unsigned integer of its BitSize, and keeps an array as raw bytes. Add BaseType."
    ESI017 ARRAY_BOUNDS Repair Warn "the ArrayInfo of an array is missing or wrong"
        "ArrayInfo has LBound and Elements, and BitSize is the size of all elements together. Lexibus derives a missing \
        number of elements from the sizes, and otherwise uses the declared number. An array has at most three \
        dimensions, and Lexibus leaves out further dimensions. Correct ArrayInfo or BitSize."
    ESI018 SUB_ITEM_MISMATCH Repair Warn "the sub-items of an object do not match its data type"
        "Each sub-item of an object gets its sub-index and type from the SubItem with the same name in the data type. \
        If the data type has no SubItem with this name, or uses a name twice, Lexibus assigns the sub-item by its \
        position. A value may then belong to the wrong sub-index. Give the sub-items the names that they have in the \
        data type."
    ESI019 BIT_SIZE Lint Warn "BitSize is not the size of the data type"
        "The size of an object or data type contradicts the type that it consists of. The diagnostic says which size \
        Lexibus uses. Correct BitSize or the type."
    ESI020 ODD_HEX Repair Warn "the number of hexadecimal digits is odd"
        "Two digits are one byte. Lexibus adds a zero before the first digit. Write all digits, and check that no \
        digit was lost."
    ESI021 HEX_LENGTH Lint Warn "DefaultData, MinData or MaxData does not have the length of the type"
        "The bytes are in the order of memory: the least significant byte comes first. Lexibus reads missing bytes as \
        zeros and ignores surplus bytes that are zero. If another surplus byte exists, Lexibus keeps the whole value \
        as raw bytes. Write as many bytes as the type has."
    ESI022 ESI_OUT_OF_TYPE Lint Warn "a value does not fit its data type"
        "The data type cannot hold a value that large or small. Lexibus keeps the value in the intermediate \
        representation. Generated code clamps a limit to the type and leaves out a default value. Correct the value or \
        the data type."
    ESI023 VALUE_FORM Repair Warn "a value has the form of another type"
        "Examples are a fraction for an integer, and a text for a number. Lexibus converts the value if the conversion \
        is unambiguous. Otherwise, it keeps the value as text. Write the value in the form of its type."
    ESI024 MINUS_ONE Repair Warn "-1 is given for an unsigned integer"
        "In C, -1 becomes an unsigned integer with all bits set. Lexibus reads -1 as that integer. Write the unsigned \
        number."
    ESI025 SUB_ITEM_PLACE Lint Warn "a sub-item shares bits with another sub-item, or exceeds its data type"
        "CoE complete access transfers all sub-items of an object in one block. BitOffs and BitSize of a sub-item \
        state its offset and length in this block. BitSize of the data type is the length of the block. If one of them \
        is wrong, a master reads the bits of another sub-item. Lexibus keeps the sub-items. Correct BitOffs or \
        BitSize."
    ESI030 ESI_MISSING_ACCESS Lint Warn "the access rights of an object are not declared"
        "The flags of an object or sub-item contain Access: ro, rw or wo. Lexibus makes an item without Access \
        read-only, so that generated code never writes the item by mistake. Add Access."
    ESI031 UNKNOWN_FLAG Repair Warn "a flag has an unknown value"
        "Access is ro, rw or wo. Category is m, o or c. PdoMapping is R, T or RT. SafetyMapping is si, so, sio or sp. \
        The diagnostic says how Lexibus reads the value. Write one of these values."
    ESI032 ESI_DUPLICATE_OBJECT Repair Warn "an object or sub-index occurs twice"
        "An index must be unique in a device, and a sub-index in its object. Lexibus uses the first definition and \
        leaves out the second one. Delete the wrong definition."
    ESI033 ESI_MISSING_INDEX Repair Warn "an object, PDO entry or module has no usable index or ident number"
        "An object without an index cannot be addressed. A module without an ident number fits no slot. Lexibus leaves \
        out such objects and modules. Lexibus keeps a PDO entry without an index if the entry has a name and a type, \
        and otherwise reads the entry as padding. Add the index or the ident number."
    ESI034 SUB_INDEX_RANGE Repair Warn "a sub-index is above 255"
        "A sub-index is a number from 0 to 255. Lexibus keeps an array that extends beyond sub-index 255 as one value, \
        and leaves out other sub-items beyond it. Check the number of elements of the array, which is often wrong."
    ESI040 SYNC_MANAGER_PURPOSE Repair Warn "the purpose of a sync manager is unknown"
        "The text of Sm is MBoxOut, MBoxIn, Outputs or Inputs. If Sm has another text, Lexibus derives the purpose \
        from the PDOs that name the sync manager, or from its control byte or position. Write one of the four words."
    ESI041 PDO_WITHOUT_INDEX Repair Warn "a PDO has no index"
        "Lexibus keeps the entries, but the PDO cannot be assigned to a sync manager. In an old file, the attribute \
        Ref of a PDO names a template: the Pdo with this RefName in Descriptions/Pdos of the same file. Add the index \
        or the template."
    ESI042 DUPLICATE_PDO Lint Warn "two PDOs have the same index"
        "Some files describe a PDO twice, once for each of two sync managers. A master assigns the PDO to only one of \
        the sync managers. Lexibus keeps both PDOs. Correct the index, or allow this code if the device works this way."
    ESI043 UNNAMED_PDO Lint Warn "a PDO has no name"
        "The element Name is mandatory. Generated code names the PDO by its index. Add the name of the PDO."
    ESI044 ENTRY_LENGTH Lint Warn "the length of a PDO entry differs from the length of its data type"
        "Lexibus uses BitLen for the layout and DataType for the type. A wrong BitLen shifts all entries after it. \
        Compare BitLen and DataType with the manual, and correct the wrong one."
    ESI050 DUPLICATE_MODULE Lint Warn "two modules have the same ident number"
        "A device identifies a module by its ident number. Lexibus keeps both modules. Correct one of the ident \
        numbers."
    ESI051 NO_MODULE_FITS Lint Warn "a slot accepts only modules that are not described"
        "The slot names ident numbers or classes that no module has, neither in this description nor in the files that \
        it references. Lexibus leaves the slot empty. Put the file with the modules next to the description, or \
        correct the slot."
    ESI060 MISSING_IDENTITY Lint Warn "the vendor ID or product code is missing"
        "A master finds the description of a slave by vendor ID, product code and revision. Lexibus reads the file \
        without the missing number. Add the Id of the vendor, or the ProductCode of the device."
    XDD002 POWERLINK_XDD Error Deny "the file is an Ethernet POWERLINK XDD, not a CANopen XDD"
        "Ethernet POWERLINK uses XDD files with the same outer elements (EPSG 311), but other communication profiles. \
        Lexibus rejects the file. Ask the vendor for the CANopen XDD of the device."
    XDD003 NOT_A_CANOPEN_XDD Error Deny "the XML is not a CANopen device description"
        "The root element of an XDD or XDC is ISO15745ProfileContainer or ISO15745Profile. The root element contains a \
        profile body for the device and one for the CANopen communication network. Lexibus rejects any other file. \
        Check that this is the right file."
    XDD004 DANGLING_REFERENCE Repair Warn "a uniqueIDRef has no target"
        "An object, template or text refers to an element by its uniqueID, and no element has it. Lexibus ignores the \
        reference, so the content of the target is missing. Correct the uniqueID, or add the element."
    XDD005 UNKNOWN_ELEMENT Lint Allow "an element or attribute is not defined in CiA 311"
        "Lexibus keeps the element or attribute as an extension attribute if it has a value. Many tools add \
        attributes to objects, so this lint is off by default. XML006 reports likely misspellings."
    XDD006 XDD_VALUE Repair Warn "an attribute or element has an invalid value"
        "CiA 311 fixes the form of the attribute. Indices and data types, for example, are hexadecimal digits without a \
        prefix. Lexibus skips the prefix `0x`. Lexibus leaves out any other invalid value, or keeps it as text if the \
        intermediate representation can hold it. This code also reports data types that contain themselves, and \
        objects that refer to an inaccessible parameter. Correct the value."
    XDD007 DUPLICATE_OBJECT Repair Warn "an object or sub-object occurs twice"
        "An index must be unique in an object list, and a sub-index in its object. Lexibus uses the last definition. \
        Delete the wrong definition."
    XDD008 MISSING_INDEX Repair Warn "an object or sub-object has no usable index"
        "An object needs an index, and a sub-object needs a sub-index. Both consist of hexadecimal digits. A \
        CANopenSubObject must be inside a CANopenObject. Lexibus leaves out objects and sub-objects that break these \
        rules, because they cannot be addressed. Add the index or sub-index, or move the sub-object."
    GSD001 NOT_A_GSDML Error Deny "the XML is not a GSDML file"
        "A GSDML file has the root element ISO15745Profile, which contains a ProfileBody with an ApplicationProcess. \
        This file has another root element, and Lexibus rejects it. Check that this is the right file."
    GSD002 NO_DEVICE_ACCESS_POINT Lint Warn "a GSDML file describes no device"
        "Every DeviceAccessPointItem describes one device. Without a device, Lexibus has nothing to generate code for. \
        Check that the file is complete."
    GSD003 GSDML_FILE_NAME Lint Allow "the name of a GSDML file has the wrong form"
        "Engineering tools look for names such as `GSDML-V2.35-Vendor-Device-20200131.xml`, with the version of the \
        schema after `V`. Some tools reject other names. Lexibus recognizes the file by its content, so this lint is \
        off by default. Rename the file if you use it in such a tool."
    GSD004 UNKNOWN_GSDML_ELEMENT Lint Allow "an element or attribute is not defined in GSDML V2.35"
        "Lexibus keeps the element or attribute as an extension attribute. Files of later versions can have new elements, \
        so this lint is off by default. XML006 reports likely misspellings."
    GSD005 GSDML_VALUE Repair Warn "an attribute or element has an invalid value"
        "The schema fixes the form of the attribute, such as a decimal number, `true`, or a list like `1..3 7`. \
        Lexibus reads the value if it is unambiguous. Otherwise, it leaves the value out. Correct the value."
    GSD006 GSDML_MISSING Repair Warn "a mandatory attribute or element is missing"
        "The schema requires the attribute or element. The diagnostic says what Lexibus assumes instead. Add the \
        attribute or element, because engineering tools may reject the file."
    GSD007 ATTRIBUTE_CASE Repair Warn "the name of an attribute has the wrong case"
        "XML is case-sensitive, so engineering tools do not see the attribute. Lexibus reads the attribute all the \
        same. Write the name as in the schema."
    GSD008 MISSING_TEXT Repair Warn "a text is missing"
        "A TextId refers to a text in ExternalTextList. If the list does not contain the text, Lexibus uses the \
        identifier as the name. If only the primary language lacks the text, Lexibus uses the first translation. \
        Without TextId, the name is empty. Add the text or the TextId."
    GSD009 MISSING_TRANSLATION Lint Warn "a language lacks texts that the primary language has"
        "A text without a translation is displayed in the primary language, which is English. Add the translations."
    GSD010 DUPLICATE_ID Repair Warn "an identifier, text, language or element occurs twice"
        "An ID must be unique among the elements of one kind. Texts and languages must be unique in the text list, and \
        some elements in their parent. The diagnostic says which of them Lexibus uses. References refer to the first \
        element with the ID. Rename or delete the duplicate."
    GSD011 UNRESOLVED_TARGET Repair Warn "a reference has no target"
        "An attribute such as ModuleItemTarget names an element by its ID, and no element of that kind has it. IDs are \
        case-sensitive. Lexibus ignores the reference, so the content of the target is missing. Correct the ID, or add \
        the element."
    GSD012 UNKNOWN_GSDML_TYPE Repair Warn "a data type is unknown"
        "The name is not a data type of GSDML. Lexibus accepts a name in the wrong case. It keeps values of any other \
        unknown type as raw bytes of the declared length. Without a declared length, the value takes no space, and the \
        offsets of later data items may be wrong. Correct the data type."
    GSD013 GSDML_DEFAULT Repair Warn "a default value does not have the form of its data type"
        "Numbers are decimal, octets are written as `0x00,0x1F`, and a bit is 0 or 1. Lexibus reads a hexadecimal \
        number, and keeps any other value as text. Correct the value."
    GSD014 ALLOWED_VALUES Repair Warn "a part of AllowedValues is neither a number nor an ascending range"
        "The list contains numbers and ranges, separated by spaces: `0..4 7 9`. Lexibus swaps the limits of a \
        descending range, and leaves out any other part. Correct the list."
    GSD015 RECORD_BOUNDS Lint Warn "a parameter or constant exceeds its record"
        "The content of the record is longer than its Length. A device rejects a record of the wrong length. Lexibus \
        keeps the content. Correct Length, ByteOffset or the data type."
    GSD016 PARAMETERS_OVERLAP Lint Warn "two parameters of a record share bits"
        "Writing one parameter changes the other. Lexibus keeps both parameters. Correct the offset or data type of \
        one parameter."
    GSD017 BIT_DATA_ITEM Repair Warn "a named bit does not match its data item"
        "A BitDataItem names a bit of a data item with UseAsBits. The bit must be within the length of the data item \
        and have only one name. Otherwise, Lexibus leaves the bit out. Lexibus reads the data item as bits even if \
        UseAsBits is missing. Correct the data item."
    GSD018 IO_LENGTH Lint Warn "a module has more data than its device can exchange"
        "MaxInputLength, MaxOutputLength and MaxDataLength limit the data of all submodules, including their status \
        bytes. The lint adds the data of the built-in submodules of a module. The device cannot use a module that \
        exceeds these limits. Lexibus keeps the module. Correct the lengths."
    GSD019 RECORD_SIZE Lint Warn "a record is longer than the device accepts"
        "MaxSupportedRecordSize of a device is the maximum length of its records. The default is 4068 bytes. The \
        device rejects longer records. Lexibus keeps the record. Correct the Length of the record or \
        MaxSupportedRecordSize."
    GSD020 SLOT_RANGE Lint Warn "a module is for slots that the device does not have"
        "PhysicalSlots lists the slots of the device. The module also names slots that are not in this list, so it \
        cannot be used there. Lexibus keeps the module. Correct PhysicalSlots or the slots of the module."
    GSD021 SUBSLOT_TAKEN Lint Warn "two submodules are fixed in one subslot"
        "A subslot holds one submodule. A VirtualSubmoduleItem without FixedInSubslots is in subslot 1. Lexibus keeps \
        both submodules. Give each built-in submodule a different subslot."
    GSD022 UNUSED_TEXT Lint Allow "a text is not used"
        "Nothing in the file refers to the text. Lexibus keeps it. Tools often leave such \
        texts in the file, so this lint is off by default. Delete the text, or refer to it."
    PDO001 MAPPED_OBJECT_MISSING Lint Warn "a PDO maps an object that is not described"
        "The mapping names an index and sub-index that the file does not describe. Lexibus keeps the field as raw \
        bits, or with the type that the PDO entry names. Describe the object, or correct the mapping."
    PDO002 NOT_MAPPABLE Lint Warn "a PDO maps an object that is not mappable"
        "The description declares that the object cannot be mapped, such as with PDOMapping 0 in an EDS. A CANopen \
        device rejects the mapping with abort code 0x06040041. Lexibus keeps the entry. Correct the mapping or the \
        object."
    PDO003 WRONG_DIRECTION Lint Warn "a PDO maps an object that cannot be mapped in the direction of the PDO"
        "A TPDO carries readable objects (ro, const, rw, rwr), and an RPDO writable ones (wo, rw, rww). In EtherCAT, \
        PdoMapping states the direction. Lexibus keeps the entry. Correct the mapping or the object."
    PDO004 PDO_TOO_LONG Lint Warn "a PDO is longer than its maximum length"
        "A CAN frame carries at most 8 data bytes (CiA 301, 7.5.2.36). The device rejects a longer mapping with abort \
        code 0x06040042. In a register table, `max` declares the maximum length of a PDO in bytes. Lexibus keeps the \
        PDO. Map fewer or shorter objects."
    PDO005 MAPPED_LENGTH Lint Warn "a PDO maps an object with the wrong length"
        "The length in the mapping is not the length of the object's data type. Lexibus uses the length in the mapping \
        for the layout. Correct the mapping or the data type."
    PDO006 MAPPING_GAP Lint Warn "a PDO mapping has a gap"
        "An entry is empty, but later entries are not. Lexibus ignores the empty entry and keeps the order of the \
        later entries. Fill the empty entry, or move the later entries up."
    PDO007 UNMAPPABLE_TYPE Lint Warn "a PDO maps a type of variable length"
        "Strings and domains have no fixed length, so they cannot be mapped unless the device fixes their length. \
        Lexibus keeps the entry. Compare the mapping with the manual."
    PDO008 DUMMY_IN_TPDO Lint Warn "a TPDO maps a dummy entry"
        "Dummy entries (0x0001 to 0x0007) reserve space in an RPDO. A TPDO must not contain any (CiA 301, 7.4.9). \
        Lexibus keeps the entry. Map an object of the device instead."
    PDO009 DUMMY_NOT_SUPPORTED Lint Warn "a PDO maps a dummy entry that `[DummyUsage]` excludes"
        "`[DummyUsage]` lists the data types that the device accepts as dummy entries. The data type of this entry is \
        missing in `[DummyUsage]`, or is 0. Lexibus keeps the entry. Correct the mapping or `[DummyUsage]`."
    PDO010 PDO_COUNT Lint Warn "NrOfRXPDO or NrOfTXPDO is not the number of PDOs"
        "The file describes more PDOs than `[DeviceInfo]` declares. Or it describes fewer PDOs, and no CompactPDO \
        describes the others. Lexibus uses the described PDOs. Correct the number, or describe the missing PDOs."
    PDO011 GRANULARITY Lint Warn "the length of a mapping entry is not a multiple of the granularity"
        "Granularity is the smallest unit of mapping in bits: 8 for bytes, 1 for bits. Granularity is 0 if mappings \
        are fixed. The length of this entry is not a multiple of Granularity. Lexibus keeps the entry. Correct the \
        mapping or Granularity."
    PDO012 MULTIPLEXED_PDO Lint Warn "a multiplexed PDO is described, but the device supports none"
        "Sub-index 0 of the mapping is 254 or 255, which marks a multiplexed PDO. GroupMessaging is 0, which means \
        that the device has none. Correct sub-index 0 or GroupMessaging."
    PDO013 PDO_COUNT_1004 Lint Warn "object 0x1004 contradicts `[DeviceInfo]`"
        "The upper 16 bits of 0x1004 are the number of RPDOs, the lower 16 bits the number of TPDOs. These numbers \
        differ from NrOfRXPDO and NrOfTXPDO. Lexibus uses the described PDOs. Correct the wrong number."
    PDO014 HALF_A_PDO Lint Warn "a PDO has a communication or a mapping object, but not both"
        "Two objects describe a PDO: 0x1400+n and 0x1600+n describe an RPDO, 0x1800+n and 0x1A00+n a TPDO. One of the \
        two objects is missing. Describe the missing object."
    PDO015 MAPPING_UNREADABLE Lint Warn "a PDO mapping entry is not a number"
        "A mapping entry consists of index, sub-index and length in bits, in one UNSIGNED32. An entry cannot depend on \
        the node-ID. Lexibus ignores the entry. Write the entry as a number."
    PDO016 MAPPING_COUNT Lint Warn "sub-index 0 of a PDO mapping exceeds the number of its entries"
        "Sub-index 0 is the number of mapped objects. This number is greater than the number of entries with a value. \
        Lexibus uses the entries with a value. Correct sub-index 0, or fill the entries."
    PDO017 UNCLEAR_DIRECTION Lint Allow "the access type of a mapped object does not state the PDO direction"
        "CiA 306 defines rwr for objects in a TPDO and rww for objects in an RPDO. The access type rw allows both \
        directions, and a tool cannot know which one the device means. Many files use rw for all mapped objects, so this \
        lint is off by default. Write rwr or rww if the object can be mapped in only one direction."
    PDO018 DEFAULT_PDOS_CONFLICT Lint Warn "two PDOs that exclude each other are both assigned by default"
        "A PDO with the attribute Sm is assigned by default. Both PDOs have Sm, but one excludes the other, so the \
        slave rejects this assignment. Lexibus puts the first PDO into the default process image. The other PDO stays \
        selectable. Delete Sm of one PDO."
    PDO019 NO_SUCH_SYNC_MANAGER Lint Warn "a PDO is assigned to a sync manager that is not described"
        "Sm of a PDO is the position of an Sm element, counted from 0. Lexibus leaves the PDO out of the default \
        process image. Correct the number, or describe the sync manager."
    PDO020 EXCLUDED_PDO_MISSING Lint Warn "a PDO excludes a PDO that is not described"
        "Exclude names the index of another PDO of the same device or module. No PDO has this index, so nothing is \
        excluded. Correct the index."
    PDO021 IMAGE_TOO_LONG Lint Warn "the default PDOs are longer than their sync manager"
        "MaxSize is the maximum length of the process data of a sync manager. The slave rejects longer data. Lexibus \
        keeps the PDOs. Correct MaxSize, or assign fewer PDOs by default."
    PDO022 ENTRY_TOO_LONG Lint Warn "a PDO entry is longer than 65535 bits"
        "No EtherCAT frame carries that much, so BitLen is wrong. Lexibus documents the PDO as the file describes it, \
        but generates no struct, view or process image field for it. Correct BitLen."
    PDO023 MAPPED_READ_ONLY Lint Allow "an EtherCAT PDO writes a read-only object, or reads a write-only object"
        "An RxPDO carries an object that is read-only by SDO, or a TxPDO one that is write-only. Many slaves state the \
        access rights for SDO only, so this lint is off by default. Compare the access rights with the manual."
    PDO024 TOO_MANY_PDOS Lint Warn "a sync manager has more default PDOs than its assignment can hold"
        "The assignment object of a sync manager holds at most 254 PDOs, so no master can write a longer list. The \
        generated code has no constant `STARTUP`. Assign fewer PDOs by default."
    TAB001 REGISTER_FORMULA Lint Warn "the object of a register does not match the rule of its space"
        "The rule of a space derives the object from the register number. This row names another object, or names no \
        object although the neighboring rows do. Lexibus uses the object of the row. One of the two numbers is \
        probably misprinted. Compare the neighboring rows, record the ambiguity in `doubt`, and `allow` this code on \
        the row."
    TAB002 TABLE_SYNTAX Error Deny "a register table is not valid TOML"
        "The file name ends in `.toml`, or the file begins like a register table, but it breaks the grammar of TOML \
        1.1. Lexibus rejects the whole file. Correct the marked line."
    TAB003 UNKNOWN_TABLE_KEY Error Deny "a key is not defined in the table format"
        "Lexibus ignores the key, reads the rest and produces no output. `dictionaries/README.md` lists all keys. \
        `lexibus schema` prints a JSON Schema that lets editors complete the keys. Correct the key."
    TAB004 TABLE_VALUE Error Deny "a value is not valid for its key"
        "The message says what is expected. Lexibus leaves out the affected row or part of the row, and produces no \
        output. Correct the value."
    TAB005 UNRESOLVED_NAME Error Deny "a name has no definition"
        "Rows refer to units, bit fields, enumerations, spaces, models, options and other items by name. Nothing of \
        the required kind has this name. Lexibus suggests the most similar name and produces no output. Correct the \
        name, or add the definition."
    TAB006 TABLE_PLACE Error Deny "an address, a range or a bit number cannot be read"
        "Write registers as `63` or `\"63-64\"`, and objects as `0x6040` or `\"0x1018:1\"`. Write ranges of objects as \
        `\"0x1400..0x1403:1\"`, and bits as `7` or `\"3-2\"`. Lexibus produces no output until all addresses, ranges \
        and bit numbers are correct."
    TAB007 TABLE_DUPLICATE Error Deny "a name or an address occurs twice"
        "Names become Rust names, and each address belongs to one row. Lexibus produces no output if a name, an \
        address or an index is not unique. Correct the wrong name, address or index. If the manual has one name for \
        two registers, add a suffix to one of them and a `doubt`."
    TAB008 ROW_WITHOUT_ADDRESS Error Deny "a row has no address"
        "An item needs an address on a bus of the device. Write `reg` for a register, `obj` for an object, `param` for \
        a parameter, `ascii` for a name, or `esc` for an EtherCAT slave controller. Lexibus produces no output if a \
        row has no address."
    TAB009 REGISTER_SPAN Lint Warn "the printed register numbers do not match the type"
        "A value of 32 bits takes two registers of 16 bits. This code also reports an integer whose length is not a \
        whole number of bytes. Lexibus uses the type. Compare the type and the printed numbers with the manual, and \
        correct the wrong one."
    TAB010 ACCESS_NOT_GIVEN Lint Warn "the access rights of an item are not declared"
        "Neither the row nor the defaults of its chapter or file have `access`. Lexibus makes the item read-only, so \
        generated code cannot write the item. Add `access` to the row or to `defaults`."
    TAB011 UNKNOWN_UNIT Lint Warn "a unit is unknown"
        "A unit is an SI symbol, a symbol that is usual for drives, or a name in `[units]`, which defines its symbol \
        and scale. An unknown symbol is often a misspelled name, and then the scale is missing. Lexibus keeps the text \
        as the symbol. Correct the name, or define the unit in `[units]`."
    TAB012 HEX_DIGITS Lint Warn "the number of hexadecimal digits does not match the type"
        "A number has more digits than its type needs, such as `0x007FFFFFFF` for 32 bits, or fewer digits with \
        leading zeros, such as `0x0000`. Or an index does not have four digits (`0x20A`), or has no prefix `0x`. \
        Usually a digit was doubled or lost, or the type is wrong. This code also reports the prefix `0X`. Lexibus uses \
        the number. Compare the number with the manual.\n\
        In an EDS, numbers with exactly as many digits as a longer type are reported only if you set a level for this \
        code."
    TAB013 BIT_OUTSIDE_TYPE Lint Warn "a bit is outside of its integer type"
        "The bit field names a bit that the integer does not have. Generated code leaves the field out. The type is \
        too short, or the manual counts bits from 1. Correct the type or the bit number."
    TAB014 BITS_OVERLAP Lint Warn "two fields share bits"
        "A bit has one meaning at a time. If the meaning depends on another item, the firmware or the model, state the \
        condition in each field: `when`, `since`, `until` or `models`. Otherwise correct the bits of the wrong field."
    TAB015 NAME_OUTSIDE_TYPE Lint Warn "an enumeration names a value that its integer type cannot hold"
        "The value is negative and the integer unsigned, or the value has more bits than the integer or field. Correct \
        the type or the value."
    TAB016 NAME_OUTSIDE_LIMITS Lint Warn "a named value or bit is outside of the limits of its item"
        "The limits exclude a value that has a name, so generated code refuses to write it. Correct the limit. If the \
        item supports only some of the values, define a separate enumeration for it."
    TAB017 VALUE_NAMED_TWICE Lint Warn "a value or code has two names"
        "Two entries of an enumeration or code table have the same number, or their ranges overlap. In a code table, a \
        range may contain narrower ranges, which take precedence. Generated code uses the first name. Correct the \
        number. If the name depends on the firmware or the model, state this in each entry."
    TAB018 UNNAMED_VALUE Lint Warn "a default value, limit or condition is a reserved or unnamed value"
        "The enumeration reserves the value, or is closed and does not name it. The code also reports unnamed writable \
        values, and a limit just outside of the named values. In a bit field, the lint checks the default and fixed \
        values of each field. Name the value if the manual does, or correct the number."
    TAB019 RESERVED_BITS Lint Warn "a default value, limit or fixed value sets reserved or unnamed bits"
        "The number sets a bit that is reserved or has no name, or clears a reserved bit that must be 1. Limits are \
        only checked for reserved bits that they set. A limit is exempt if it has a single bit, or all bits up to the \
        end of the type or the last named bit. Correct the number, or name the bits if the manual does."
    TAB020 LENGTH_MISMATCH Lint Warn "the length of an item differs from its type, or the length of a PDO from its entries"
        "A default text is longer than its type. Or a printed `length` differs from the length of the item's type or of \
        the PDO's entries. Or an item has more or fewer bytes of ESC memory than its type needs. Compare the lengths \
        with the manual, and correct the wrong length."
    TAB021 SUMMARY_DIFFERS Lint Warn "another section of the manual contradicts the row"
        "`summary` of the row holds what a table of contents, an overview or the prose says about the item. Lexibus \
        uses the row. Write the correct fact in the row and the other fact in `doubt`, and `allow` this code on the \
        row."
    TAB022 SAME_VALUE_DIFFERS Lint Warn "two rows for the same value differ"
        "`same_as` declares that two rows are one value, but their types, limits, units, scales or names differ. Or a \
        row and its replacement (`replaced_by`) have different access rights. Lexibus keeps both rows. Compare the \
        rows with the manual, and correct the wrong one."
    TAB023 READING_LIMITS Lint Warn "a read-only signed value has a minimum above zero"
        "A measured value is signed because it can be negative, so the value can be zero too. Often the limits were \
        copied from a setpoint, or the type is unsigned. Lexibus keeps the limit. Correct the limit or the type."
    TAB024 ACCESS_CONFLICT Lint Warn "access rights contradict storage or process data"
        "For example, a read-only value is saved or in an RPDO, a write-only value is in a TPDO, or a Modbus input is \
        writable. Lexibus keeps all facts. Keep the fact that the manual's text supports, and record the other fact in \
        `doubt`.\n\
        In formats other than register tables, this lint runs only if you set a level for this code."
    TAB025 MENTIONED_OBJECT Lint Warn "a text mentions an object or item that the table does not have"
        "Lexibus searches documentation, names and effects for objects (`object 0x2010`, `0x1003:1`), registers \
        (`register 10015`) and names of items. A row is missing, or the mention is misprinted. A word is reported as a \
        misspelled name if it differs from a name by one to three letters, depending on its length. Add the row, or \
        correct the text."
    TAB026 FIRMWARE_WINDOW Lint Warn "firmware ranges contradict each other"
        "`since` is the first firmware version that has an item, bit, value or message. `until` is the first later \
        version that does not have it. A range is empty, or the replacement of an item does not start with the version \
        in which the item ends, or no longer exists in this version. Compare the versions with the manual, and correct \
        the wrong one."
    TAB027 VERSION_FORM Lint Warn "a firmware version cannot be compared"
        "A firmware version consists of numbers separated by dots. Each number is compared separately: 6.27 is later \
        than 6.3. Lexibus does not compare this version with others. Write the version as numbers separated by dots."
    TAB028 STATES_OVERLAP Lint Deny "two states of a state machine match the same status value"
        "Some values of the status item match both states, so the state of the device is ambiguous. This lint is an \
        error by default. Correct the mask or value of one state."
    TAB029 COMMANDS_OVERLAP Lint Allow "two commands of a state machine match the same control value"
        "Some values of the control item match both commands. This is correct if the state determines which command is \
        meant, as in CiA 402, so this lint is off by default. Otherwise correct the mask or value of one command."
    TAB030 OVERLAY_NO_MATCH Lint Warn "an overlay entry matches nothing"
        "The devices of the overlay have no such object or item, or no row of the overlay uses the definition. A newer \
        version of the description may have renamed or removed the object or item. Lexibus ignores the entry. Correct \
        or delete the entry, or add the object with `add = true`."
    TAB031 OVERLAY_NO_CHANGE Lint Warn "an overlay entry changes nothing"
        "The description already contains everything that the entry states. The vendor may have corrected a newer \
        version of the description. Delete the entry."
    TAB032 OVERLAY_NOT_FOR Lint Warn "an overlay matches no device or module of the description"
        "`for` in `[overlay]` names a vendor, product code, revision, device or module that the description, or the \
        selected part of it, does not have. Lexibus applies nothing of the overlay. Correct `for`, or remove the \
        overlay."
    TAB033 STEP_IMPOSSIBLE Lint Warn "a step of a procedure is impossible"
        "The step writes a read-only item or a value that the item cannot have, or waits for a value that never occurs. \
        Or the step gives a PDO the COB-ID of another PDO, writes an entry of a PDO mapping twice, or writes too large \
        a number of entries. Lexibus keeps the step. Compare the step with the manual, and correct the step."
    TAB034 ASSIGNED_PDO_MISSING Lint Warn "an assigned PDO is not described"
        "0x1C12 and 0x1C13 hold the indices of the assigned PDOs. A default value or a step of a procedure writes the \
        index of a PDO that the table does not have. Describe the PDO, or correct the index."
    TAB035 MAPPED_NOT_ASSIGNED Lint Warn "a procedure maps a PDO, but assigns other PDOs"
        "The mapping has no effect, because the procedure assigns other PDOs to the sync manager. Correct the \
        index of the mapped or of the assigned PDO."
    TAB036 UNNAMED_BITS Lint Allow "a bit field does not describe all bits"
        "Some bits are neither named nor reserved, or an enumeration of a field of up to 4 bits does not name or \
        reserve all values of the field. Manuals often omit such bits and values, so this lint is off by default. Name \
        or reserve the bits and values if the manual does."
    TAB037 MODE_WITHOUT_BITS Lint Warn "bits that depend on a mode are not described for one of the modes"
        "The manual's table of bits has no column for the mode, or the mode does not use the bits. The value 0 is not \
        checked, because it usually means no mode. Describe the bits, or `allow` this code on the bit field if the \
        mode does not use them."
    TAB038 ONE_LIMIT Lint Allow "a row has only one limit"
        "The row has a minimum or a maximum, but not both. Often the missing limit is that of the type, so this lint \
        is off by default. Add the other limit if the manual has it."
    TAB039 PATTERN_OUTSIDE_MASK Lint Warn "a state or command has bits outside of its mask"
        "The value sets bits that the mask does not contain, so no value matches the state or command. Correct the \
        mask or the value."
    TAB040 NAME_TWICE Lint Warn "two objects, bits or values have the same name"
        "The code also reports sub-entries of one object, and registers whose names differ only in case. Often the \
        name was copied from the line above. Generated code adds a number to one of the names. Correct the name.\n\
        In formats other than register tables, this lint runs only if you set a level for this code."
    TAB041 BROKEN_NAME Lint Warn "a name contains a hyphen from a line break, contains a description, or is a column title"
        "In a narrow column, the manual breaks a name with a hyphen. The text of the manual often has the whole name. \
        Or the cell with the name also contains values (`0 = Stop`) or a sentence. Or a bit has the title of a column, \
        such as `Definition`, because a line of the table is shifted. Write only the name, and the rest as `doc`."
    TAB042 EMPTY_LIMIT Lint Warn "a row has only one limit, which is also the limit of its type"
        "A minimum of 0, for example, does not restrict an unsigned value. The manual does not state the other limit, \
        or the limit was lost. Write both limits, or neither."
    TAB043 SHARED_REGISTERS Lint Warn "two items share registers or bits of one register"
        "One of the items has the wrong register number, or a type that is too long. Lexibus keeps both items. Correct \
        the wrong item. If the device repeats a part of a value in separate registers, declare this with `part`, or \
        with `same_as` and `allow`."
    TAB044 EXAMPLE_DIFFERS Lint Warn "an example frame contradicts its message or the registers of the table"
        "Lexibus compares the requests and replies that the manual prints with the fields of the message. The lint \
        checks the length, constants, echoes, reserved bits and named values. In Modbus frames (`[[frames]]`), the \
        lint checks register addresses, byte counts, lengths, node addresses, function codes and the CRC. The frame or \
        the field is misprinted. Keep the bytes that the other frames support, and record the ambiguity in `doubt`."
    TAB045 CELLS_TWICE Lint Warn "two codes of a code table have the same cells"
        "The table declares with `distinct` that no two codes have identical cells. The manual probably repeats a row. \
        Record the ambiguity in `doubt`, and `allow` this code on the table."
    TAB048 NARROW_WINDOW Lint Warn "an item has more bits than the window through which it is read or written"
        "On one of the buses, all windows of the space transfer fewer bits than the item has, so the upper bits are \
        lost. Correct the type of one item, or add a wider window."
    TAB049 WINDOW_ORDER Lint Warn "a window or its procedure writes the register number before the value"
        "Writing the register number starts the transfer, so the device transfers the previous value. In a process \
        image, the register number and the value are sent together, so their order is not checked. Write the value \
        before the register number."
    TAB050 QUANTITIES_DIFFER Lint Warn "two items for the same quantity have different default values"
        "`same_quantity` names an item for the same quantity in another scale. For each model, Lexibus compares the \
        default values as physical values, with a tolerance of 0.1 %. If the units differ, it compares machine values \
        (`[given]`), and reports the units if the items have no common machine unit. Correct a default value or a \
        scale."
    TAB051 NUMBER_GAP Lint Allow "a number is missing in a series of parameter numbers"
        "A row of the manual's table may be missing. Devices often skip numbers, so this lint is off by default. Look \
        for the parameter in the manual."
    TAB052 CONVERSION_DIFFERS Lint Warn "a conversion in the manual contradicts the scale of the item"
        "`conversions` holds raw values and the physical values that the manual gives for them. The scale gives a \
        physical value that differs by more than one raw step. A digit is misprinted, or the scale, a machine value or \
        the base is wrong. Keep the numbers that agree, and add a `doubt`. This code also reports a conversion that \
        cannot be checked, for example because a key is missing."
    TAB053 OVERLAY_SHARED Lint Warn "an overlay also changes a device that its `for` does not select"
        "`for` in `[overlay]` selects some devices. Another device has the same module or submodule, which is described \
        once, so the overlay also changes that device. If this is correct, name the module or the other device in \
        `for`."
    MSG001 FRAMING_BYTES Lint Warn "start, end and escape bytes of frames contradict each other"
        "The escape byte must differ from the start byte and the end byte. All three must be escaped in data, and no \
        escaped byte may be sent as one of them. Otherwise, receivers find the end of a frame at the wrong byte. \
        Compare `[framing]` with the manual, and correct the wrong byte."
    MSG002 MESSAGE_LENGTH Lint Warn "the fields of a message do not fill whole bytes, or the message is too long for a frame"
        "Adjacent fields shorter than a byte must fill whole bytes. The data of a message with all its repetitions \
        must not exceed the maximum number of data bytes in the framing. Correct a length, or the `max` of repeated \
        fields."
    MSG003 MESSAGES_ALIKE Lint Warn "two requests can have the same bytes"
        "The device could not distinguish the two requests, so a constant is probably misprinted. Correct the \
        constant. If the meaning depends on an earlier message, declare that message with `after`."
    MSG004 REPLY_OF_ANOTHER Lint Warn "a reply has the constant of another message"
        "A reply usually begins with a constant of its own request. This reply begins with a constant that is only in \
        the request of another message, so the manual's table was probably copied. Compare both tables with the prose, \
        and correct the constant."
    MSG005 ERROR_ALIKE Lint Warn "a reply and its error reply can have the same bytes"
        "A client cannot determine from the bytes whether the device accepted or refused the request. Correct a \
        constant. If the device never refuses the request, delete `error`."
    MSG006 BYTE_NUMBERS Lint Warn "the printed byte numbers of a message are not consecutive"
        "The byte numbers of the manual (`at`) skip or repeat bytes between two fields. A row of the manual's table is \
        missing or shifted, or a number is misprinted. Compare the fields with the manual."
    MSG007 ODD_REQUEST Lint Warn "the first constant of one request differs from that of all other requests"
        "At least nine requests have a constant that is directly followed by another constant. The first constant is \
        the same in all of these requests except one. This request is an exception, or its constant is a misprint. \
        Record the assumption in a `doubt`, and `allow` this code."
    MSG008 STATES_DIFFER Lint Warn "a message contradicts the state-command matrix"
        "One section of the manual lists the states that accept the command. The state-command matrix \
        contradicts this list for a state. Keep the statement that lists the states one by one, and record the other \
        statement in `doubt`."
    MSG009 MESSAGE_UNSHAPED Lint Warn "no code is generated for a message or a part of the protocol"
        "The fields of a message must be writable and readable one after the other. The diagnostic says what prevents \
        this, such as an incomplete byte or two fields of variable length. The code also reports error replies, \
        framings that the runtime does not support, and parameters whose message has other fields. The documentation \
        of the table format lists what is possible. Correct the description, or send the message yourself."
    MSG010 PARAMETERS_ALIKE Lint Warn "two parameter spaces with messages have a parameter with the same number"
        "A client selects a parameter by its number, and sends the message of the first space that has it. To transfer \
        the other parameter, use its message directly."
    MOD001 MODULE_INDEX_CLASH Lint Warn "a fixed object of a module is also an object of the device"
        "The index would identify both an object of the module and an object of the device. Correct one of the indices."
    MOD002 SUB_EXTEND Lint Warn "a sub-index extension breaks the rules of CiA 306"
        "`[M<n>SubExtends]` must list the extension `[M<n>SubExt<index>]`. Count is a number of sub-indices, or 0, `;` \
        and a number of bits. ObjExtend is 0 or 1, and the other keys are those of a VAR. The extended object must \
        have sub-indices. Correct the section."
    CSV001 CSV_NO_COLUMNS Error Deny "a register list has no address column or no other column"
        "Lexibus recognizes English, German and Italian titles, in any order. It needs an address and at least one \
        other column, and writes no table without them. Use `--map FIELD=TITLE` for other titles, and `--map \
        FIELD=#NUMBER` for a list without titles."
    CSV002 CSV_UNKNOWN_COLUMN Lint Warn "a column is not imported"
        "Lexibus does not know the title of this column. Use `--map FIELD=TITLE` to assign the column to a field, or \
        `--map doc=TITLE` to keep the text of the column as documentation."
    CSV003 CSV_UNREADABLE_CELL Repair Warn "a cell of a register list cannot be read"
        "The cell does not fit its column, or contradicts another cell. Lexibus keeps the rest of the row and leaves \
        the cell out, unless the diagnostic says otherwise. Correct the cell in the list, or the row in the table."
    CSV004 CSV_NO_ROW Repair Warn "a line of a register list cannot be converted to a row"
        "The line has no address, an unreadable address, or the address of another line. Or the line declares too many \
        repetitions, or its repetitions have the names of other rows. Lexibus writes the line into the table as a \
        comment. Complete the row by hand. If several lines describe bits of one register, add a column with the bit \
        number."
    CSV005 CSV_RAGGED_ROW Repair Warn "a line has more or fewer cells than there are column titles"
        "Often a cell that is not in quotation marks contains the delimiter, and all cells after it are in the wrong \
        column. Lexibus reads the cells from the left. Put the cell in quotation marks."
    CSV006 CSV_SAME_NAME Lint Warn "two lines have the same name"
        "Names of registers become Rust names. Lexibus adds a number to the second name. Rename the register in the \
        table."
    CSV007 CSV_ASSUMPTION Lint Warn "the list does not state a fact that the table needs"
        "Register lists often leave out types or access rights, or use one word with several meanings. Lexibus makes \
        one assumption for the whole list, or for each unknown unit, and the message states it. Compare the assumption \
        with the manual, and correct the table."
    CSV008 CSV_UNCLOSED_QUOTE Repair Warn "a quotation mark is never closed"
        "Lexibus reads everything up to the end of the file as one cell. If tabs separate the cells, it reads the \
        quotation mark as a character and continues with the next line. Close the quotation mark."
    CSV009 CSV_NO_SUCH_COLUMN Error Deny "a column that `--map` names does not exist"
        "Titles are compared without regard to case and punctuation. Lexibus writes no table. Correct the title, or \
        name the column by its number: `--map reg=#2`."
    NET001 NETWORK_SYNTAX Error Deny "a network file cannot be parsed"
        "The file is not valid TOML or YAML, or its extension is not one of `.toml`, `.yml`, `.yaml` and `.cpj`. In \
        YAML, Lexibus also rejects a key that occurs twice, because other tools silently use the last value. A YAML \
        file can have at most 1,000,000 elements and 64 levels of nesting. Correct the marked text."
    NET002 UNKNOWN_NETWORK_KEY Lint Deny "a network file has an unknown key"
        "No section of the format has the key, so its value would have no effect. Correct the name of the key. If the \
        key is for another program, allow this code."
    NET003 MISPLACED_KEY Lint Deny "a key of a network file is in the wrong section"
        "Another section of the format has the key. In this section, its value would have no effect. Move the key to \
        the section that the message names."
    NET004 NETWORK_VALUE Error Deny "a value of a network file is invalid"
        "The value has the wrong type or is out of range, or a required key is missing. Or the output files of two \
        nodes would have the same name. In a `.cpj` file, the number of nodes can be wrong, or a second network can \
        follow. Correct the value as the message states."
    NET005 NO_MASTER Lint Deny "a network has no master"
        "A CANopen network has one NMT master, which configures and starts the nodes. Without the section `master`, \
        Lexibus writes no files for the master. Add the section. If another program is the master, allow this code."
    NET006 NO_NODE_ID Error Deny "a node has no node-ID"
        "Each node needs a node-ID from 1 to 127, from which the COB-IDs of its services follow. Add the node-ID."
    NET007 NODE_ID_TWICE Error Deny "two nodes have the same node-ID"
        "Two devices with one node-ID both answer SDO requests and send the same CAN-IDs, which leads to bus errors. \
        Give each node its own node-ID."
    NET008 DESCRIPTION_NOT_FOUND Error Deny "the device description of a node is not found"
        "The file of a description or of an overlay does not exist, or the node declares no description. Paths in a \
        network file are relative to the folder of the network file. In `bus.yml`, Lexibus searches the folder \
        `dcf_path` first, and `@BUS_CONFIG_PATH@` is the folder of the network file. Correct the path."
    NET009 DESCRIPTION_UNUSABLE Error Deny "the device description of a node cannot be used"
        "The description cannot be read, has errors, describes no CANopen device, or describes several devices. Check \
        the description with `lexibus check`, or choose a device with `model`."
    NET010 NO_SUCH_OBJECT Error Deny "a device does not have an object"
        "The description of the device has no object with this index, sub-index or name. The value or the key needs \
        this object: `heartbeat`, for example, needs the object 0x1017. Correct the address or the name, or add the \
        object with an overlay."
    NET011 SEVERAL_OBJECTS Error Deny "several objects have the same name"
        "The name is not unique in the description of the device. Write the path of the object and the sub-index \
        (`Object/Sub-index`), or the address."
    NET012 PARAMETER_TYPE Error Deny "a value does not fit its object"
        "The value does not fit the data type or the resolution of the object, has another unit than the object, or is \
        a text that names no value of the object. A number is a raw value. A text with a unit is a physical value \
        (`\"15.5 rev/s\"`). Correct the value."
    NET013 PARAMETER_RANGE Lint Deny "a value is outside of the object's limits"
        "The description states limits for the object, and the device probably aborts the write of a value outside of \
        them. Correct the value. If the limits in the description are wrong, correct them with an overlay."
    NET014 READ_ONLY_PARAMETER Lint Deny "a value is written to a read-only object"
        "The device aborts the write, so the node is not started. Remove the value. If the access rights in the \
        description are wrong, correct them with an overlay."
    NET015 NO_SUCH_PDO Error Deny "a PDO does not exist or is disabled"
        "The description has no communication object for the PDO. Or an RPDO receives a TPDO that does not exist, that \
        is disabled, or whose node does not exist. Use a PDO that the device has, and enable the TPDO that an RPDO \
        receives."
    NET016 UNMAPPABLE_OBJECT Lint Deny "an object cannot be mapped into a PDO"
        "In the description, no PDO of this direction can map the object, or the object does not exist. Or the object \
        has no fixed length, or another length than the mapping entry. The device aborts the write of the mapping. Map \
        another object. If the description is wrong, correct it with an overlay. A dummy entry, such as 0x0005, is the \
        index of a data type, and reserves space. Only an RPDO can contain dummy entries, and `[DummyUsage]` lists the \
        data types that the device supports."
    NET017 PDO_LENGTH Lint Deny "a PDO has an invalid length"
        "A PDO on CAN has at most 64 bits. An RPDO must not be longer than the TPDO that it receives, because a node \
        rejects a PDO with too few bytes (CiA 301, 7.2.2.5). Move objects to another PDO."
    NET018 PDO_WITHOUT_PARTNER Lint Warn "a TPDO has no receiver, or an RPDO has no sender"
        "The master exchanges no PDOs (`pdos = false`), and no other node receives the TPDO or sends the RPDO. A TPDO \
        without a receiver only adds bus load. Disable the PDO, or declare its receiver with `cob_id`."
    NET019 COB_ID_CONFLICT Lint Deny "two senders use the same CAN-ID"
        "Two nodes that send the same CAN-ID at the same time cause bus errors, and a receiver cannot distinguish \
        their messages. SYNC, TIME and EMCY use CAN-IDs, too. Lexibus also reports this code if no CAN-ID is free for \
        `auto`. Choose another `cob_id`, or use `auto`."
    NET020 HEARTBEAT_TIME Lint Deny "a heartbeat or node guarding is misconfigured"
        "The consumer time of a heartbeat must be longer than the producer time, and at most 65535 ms. A consumer \
        cannot monitor a node that sends no heartbeat, and needs a free entry of 0x1016. A node cannot use both \
        heartbeat and node guarding (CiA 301, 7.2.8.3). Correct the times."
    NET021 BUS_LOAD Lint Deny "the bus load exceeds the bit rate"
        "Lexibus adds the lengths of all cyclic frames with the largest number of stuff bits. An event-driven PDO with \
        an inhibit time counts once per inhibit time, and one with only an event timer counts once per event timer. \
        Lexibus leaves out PDOs with neither, because their rate has no limit. Increase the bit rate or the periods."
    NET022 SYNC_PERIOD Lint Deny "the synchronous PDOs do not fit in the SYNC period"
        "SYNC and all synchronous PDOs together take longer than the SYNC period or the synchronous window. Or there \
        are synchronous PDOs, but no node sends SYNC. Declare a longer `sync_period`, or map fewer objects."
    NET023 RESTRICTED_CAN_ID Lint Deny "a COB-ID has a CAN-ID that is not allowed"
        "CiA 301 (7.3.5) reserves the CAN-IDs 0x000 to 0x07F, 0x101 to 0x180, 0x581 to 0x5FF, 0x601 to 0x67F, 0x6E0 to \
        0x6FF and 0x701 to 0x7FF for NMT, SDO, heartbeat, node guarding, LSS and other uses. A CAN-ID above 0x7FF has \
        29 bits, so bit 29 of the COB-ID must be 1. Choose another `cob_id`, or use `auto`."
    NET024 MULTIPLEXED_NETWORK_PDO Lint Warn "a node has a multiplexed PDO"
        "The number of mapped objects is 254 (SAM-MPDO) or 255 (DAM-MPDO). Each frame of such a PDO carries the \
        address of its value, and the PDO has no mapping (CiA 301, 7.5.2.36). The master does not exchange such a PDO, \
        and the bus load and the DBC leave it out. Declare a mapping with `map`, or disable the PDO."
    NET025 SLOT_MODULE Error Deny "a slot of a SubDevice has an invalid module"
        "The device has no such slot or no such module, the slot does not accept the module, or a slot that requires a \
        module is empty. The device does not change to Safe-Operational with such a list of modules. Correct `modules`."
    NET026 PDO_ASSIGNMENT Error Deny "the PDO assignment of a SubDevice is invalid"
        "The description has no such PDO, or excludes the combination of two PDOs, or states that a PDO must be assigned, \
        or has no sync manager for the PDO. The device does not change to Safe-Operational with such an assignment. \
        Correct `pdos`."
    NET027 SYNC_MANAGER_LENGTH Lint Deny "the process data exceed the maximum length of a sync manager"
        "The assigned PDOs are longer than the memory of the sync manager (`MaxSize` of an ESI). The device does not change \
        to Safe-Operational. Assign fewer or shorter PDOs with `pdos`."
    NET028 NO_SUCH_CLOCK_MODE Error Deny "a SubDevice does not have a mode of the distributed clocks"
        "The key `dc` must be the name of a mode in the description (`OpMode` of an ESI). Without the key, the first mode \
        applies."
    NET029 ALIAS_TWICE Error Deny "two SubDevices have the same station alias"
        "A MainDevice cannot distinguish SubDevices by an alias that several of them have. Give each SubDevice its own alias, \
        or none."
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
