//! Parses type names in lists of registers.

use super::cells::{self, Order};

/// The base type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Base {
    Unsigned,
    Signed,
    Float,
    Bool,
    Text,
    Bytes,
    /// A decimal exponent from which the scale factor of other registers is calculated (SunSpec).
    Exponent,
}

/// The attributes of a type that its name states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Written {
    pub base: Base,
    /// Size of a value in bits, if the name states the size or usually implies it.
    pub bits: Option<u32>,
    /// True if the name contains the size.
    pub is_explicit: bool,
    /// Length of a text or a sequence of bytes, in bytes.
    pub length: Option<u32>,
    /// Number of elements of an array.
    pub elements: Option<u32>,
    pub order: Order,
}

/// Parts of type names that mean that the registers of a value are swapped. The suffix `_R` comes from ESPHome.
const SWAPPED: [&str; 10] = ["swapped", "swap", "swp", "cdab", "lsw", "lswfirst", "r", "rev", "reversed", "inverse"];
const ORDERS: [&str; 16] = [
    "abcd", "badc", "dcba", "le", "be", "little", "big", "endian", "msw", "mswfirst", "first", "msb", "lsb", "low",
    "high", "order",
];

/// Parses a type name.
pub(super) fn read(text: &str) -> Option<Written> {
    let lower = text.to_lowercase();
    let (name, elements) = array(&lower);
    let words: Vec<&str> = name.split(|letter: char| !letter.is_alphanumeric() && letter != '/').collect();
    let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
    let is_swapped = words.iter().skip(1).any(|word| SWAPPED.contains(word));
    let about_order = |position: usize, word: &str| {
        position > 0 && (SWAPPED.contains(&word) || ORDERS.contains(&word) || (word == "word" && is_swapped))
    };
    let kept = words.iter().enumerate().filter(|(position, word)| !about_order(*position, word)).map(|(_, word)| *word);
    let glued: String = kept.collect();
    let order_words: Vec<&str> =
        words.iter().enumerate().filter(|(position, word)| about_order(*position, word)).map(|(_, w)| *w).collect();
    let order = match cells::order(&order_words.join(" "), false) {
        Some(order) => order,
        None if is_swapped => Order { low_first: Some(true), swap: None },
        None => Order::default(),
    };
    let without = |suffix| glued.strip_suffix(suffix).filter(|rest| rest.ends_with(|c: char| c.is_ascii_digit()));
    let (glued, order) = match (without("le"), without("be")) {
        (Some(rest), _) => (rest, Order { low_first: Some(true), swap: None }),
        (None, Some(rest)) => (rest, order),
        (None, None) => (glued.as_str(), order),
    };
    // A single `char` is a byte, and an array of `char` is a text.
    let glued = if glued == "char" && elements.is_some() { "chars" } else { glued };
    let written = single(glued)?;
    Some(match (written.base, elements) {
        (Base::Text | Base::Bytes, Some(length)) => Written { length: Some(length), order, ..written },
        (_, elements) => Written { elements, order, ..written },
    })
}

/// Separates a type name from the number of elements after it: `u16[10]`, `string(16)`, `uint16 x 4`.
fn array(text: &str) -> (&str, Option<u32>) {
    let bracket = text.trim_end().strip_suffix([']', ')']).and_then(|rest| rest.rsplit_once(['[', '(']));
    let times = || text.rsplit_once(" x ").or_else(|| text.rsplit_once('*'));
    match bracket.or_else(times) {
        Some((name, count)) => match count.trim().parse() {
            Ok(count) if count > 0 => (name, Some(count)),
            // A text in parentheses is not always a number of elements: "float32 (CDAB)", "int (16 bit)".
            _ => (text, None),
        },
        None => (text, None),
    }
}

fn single(glued: &str) -> Option<Written> {
    let of = |base, bits: Option<u32>, is_explicit| {
        Some(Written { base, bits, is_explicit, length: None, elements: None, order: Order::default() })
    };
    let named = |base, bits| of(base, Some(bits), false);
    match glued {
        "word" | "uword" | "uint" | "ushort" | "unsignedshort" | "wordunsigned" | "unsignedword" => {
            return named(Base::Unsigned, 16)
        }
        "byte" | "usint" | "uchar" | "unsignedchar" | "char" => return named(Base::Unsigned, 8),
        "dword" | "udint" | "ulong" | "unsignedlong" | "udword" | "doubleword" | "unixtime" | "timestamp" | "epoch" => {
            return named(Base::Unsigned, 32)
        }
        "lword" | "ulint" | "qword" | "uqword" | "unsignedlonglong" => return named(Base::Unsigned, 64),
        "short" | "sword" => return named(Base::Signed, 16),
        "sint" => return named(Base::Signed, 8),
        "dint" | "long" | "slong" | "sdword" | "signedlong" => return named(Base::Signed, 32),
        "lint" | "sqword" | "longlong" => return named(Base::Signed, 64),
        "lreal" | "double" => return named(Base::Float, 64),
        "sunssf" | "sf" => return named(Base::Exponent, 16),
        "int" => return of(Base::Signed, None, false),
        _ => {}
    }
    let first = glued.find(|letter: char| letter.is_ascii_digit());
    let (letters, rest) = first.map_or((glued, ""), |at| glued.split_at(at));
    let end = rest.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(rest.len());
    let (digits, tail) = rest.split_at(end);
    // Examples: "uint16_t", "16 bit unsigned", "signed 16 bit integer".
    let tails = [Some(tail), tail.strip_prefix("bit"), tail.strip_prefix("bits")].into_iter().flatten();
    const ENDS: [&str; 7] = ["", "t", "int", "integer", "number", "value", "float"];
    let word = match letters {
        "" => tails.into_iter().find(|tail| base(tail).is_some())?,
        letters => tails.into_iter().any(|tail| ENDS.contains(&tail)).then_some(letters)?,
    };
    let base = base(word)?;
    let number: Option<u32> = digits.parse().ok();
    // "16" and "32 bit" mean unsigned integers. Other numbers without a type name are not types.
    if word.is_empty() && !matches!(number, Some(8 | 16 | 32 | 64)) {
        return None;
    }
    match base {
        Base::Text | Base::Bytes => {
            Some(Written { length: number.filter(|&length| length > 0), ..of(base, None, number.is_some())? })
        }
        Base::Bool => of(base, Some(1), true),
        Base::Float => match number {
            None | Some(32 | 754) => of(base, Some(32), number == Some(32)),
            Some(64) => of(base, Some(64), true),
            _ => None,
        },
        _ => match number {
            Some(bits @ 1..=64) => of(base, Some(bits), true),
            Some(_) => None,
            None => of(base, None, false),
        },
    }
}

fn base(word: &str) -> Option<Base> {
    Some(match word {
        "u" | "ui" | "uint" | "unsigned" | "unsignedint" | "unsignedinteger" | "uinteger" | "bitfield" | "bitmap"
        | "bitmask" | "bits" | "flags" | "enum" | "enumeration" | "acc" | "hex" | "" | "interosenzasegno"
        | "vorzeichenlos" | "senzasegno" | "count" | "pad" | "unsig" | "uns" | "udec" | "word" | "uword" | "udword"
        | "uqword" | "intunsigned" | "integerunsigned" | "raw" | "register" => Base::Unsigned,
        "i" | "s" | "si" | "sint" | "int" | "integer" | "signed" | "signedint" | "signedinteger" | "intero"
        | "ganzzahl" | "mitvorzeichen" | "consegno" | "interoconsegno" | "sig" | "sdec" | "sword" | "sdword"
        | "sqword" | "dec" | "intsigned" | "integersigned" => Base::Signed,
        "f" | "float" | "fp" | "real" | "ieee" | "flt" | "floatingpoint" | "floatieee" | "ieeefloat" | "single"
        | "virgolamobile" | "fließkomma" | "gleitkomma" => Base::Float,
        "bool" | "boolean" | "bit" | "coil" | "digital" | "booleano" | "binary" | "flag" | "onoff" | "discrete" => {
            Base::Bool
        }
        "string" | "str" | "ascii" | "char" | "chars" | "text" | "visiblestring" | "utf8string" | "stringa"
        | "zeichenkette" | "asciistring" => Base::Text,
        "bytes" | "octetstring" | "blob" | "octets" | "bytearray" => Base::Bytes,
        "sunssf" => Base::Exponent,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings_of_integers_and_floats() {
        let cases: [(&str, Base, Option<u32>); 34] = [
            ("UINT16", Base::Unsigned, Some(16)),
            ("int16", Base::Signed, Some(16)),
            ("uint32_t", Base::Unsigned, Some(32)),
            ("U16", Base::Unsigned, Some(16)),
            ("S16", Base::Signed, Some(16)),
            ("Signed16", Base::Signed, Some(16)),
            ("Signed 32 bit", Base::Signed, Some(32)),
            ("Unsigned Integer 16", Base::Unsigned, Some(16)),
            ("16 bit unsigned", Base::Unsigned, Some(16)),
            ("16-bit signed integer", Base::Signed, Some(16)),
            ("32-bit float", Base::Float, Some(32)),
            ("float32", Base::Float, Some(32)),
            ("FLOAT", Base::Float, Some(32)),
            ("REAL", Base::Float, Some(32)),
            ("IEEE 754", Base::Float, Some(32)),
            ("Double", Base::Float, Some(64)),
            ("BOOL", Base::Bool, Some(1)),
            ("Bit", Base::Bool, Some(1)),
            ("WORD", Base::Unsigned, Some(16)),
            ("UDINT", Base::Unsigned, Some(32)),
            ("INT", Base::Signed, None),
            ("U_WORD", Base::Unsigned, Some(16)),
            ("S_DWORD_R", Base::Signed, Some(32)),
            ("FP32", Base::Float, Some(32)),
            ("enum16", Base::Unsigned, Some(16)),
            ("bitfield32", Base::Unsigned, Some(32)),
            ("sunssf", Base::Exponent, Some(16)),
            ("acc64", Base::Unsigned, Some(64)),
            ("INT32 swapped", Base::Signed, Some(32)),
            ("uint32 LE", Base::Unsigned, Some(32)),
            ("float32 (CDAB)", Base::Float, Some(32)),
            ("int (16 bit)", Base::Signed, Some(16)),
            ("uint16 x 4", Base::Unsigned, Some(16)),
            ("Intero senza segno", Base::Unsigned, None),
        ];
        for (text, base, bits) in cases {
            assert_eq!(read(text).map(|ty| (ty.base, ty.bits)), Some((base, bits)), "{text}");
        }
        for text in ["", "uint65", "uint128", "pump", "float16", "é", "12", "BCD16"] {
            assert_eq!(read(text), None, "{text}");
        }
    }

    #[test]
    fn texts_arrays_and_orders() {
        for text in ["string16", "String(16)", "char[16]", "STR 16", "ASCII16"] {
            assert_eq!(read(text).and_then(|ty| ty.length), Some(16), "{text}");
        }
        assert_eq!(read("u16[10]").and_then(|ty| ty.elements), Some(10));
        assert_eq!(read("uint16 x 4").and_then(|ty| ty.elements), Some(4));
        for text in ["INT32 swapped", "S_DWORD_R", "float32 (CDAB)", "uint32 LSW first", "FP32_R", "int32 word swap"] {
            assert_eq!(read(text).and_then(|ty| ty.order.low_first), Some(true), "{text}");
        }
        assert_eq!(read("uint32 BE").and_then(|ty| ty.order.low_first), Some(false));
    }
}
