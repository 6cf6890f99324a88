//! Known unit symbols, and other spellings of units.

/// Symbols of single units: SI units, also with prefixes, and other units that device manuals use. Products, quotients and powers
/// of these symbols are known units, too.
const SYMBOLS: [&str; 90] = [
    "%", "%RH", "1", "A", "Ah", "Bd", "C", "F", "GHz", "H", "Hz", "J", "K", "MB", "MHz", "Mbit", "MΩ", "N", "Nm", "Pa",
    "V", "VA", "VAh", "W", "Wh", "bar", "bit", "byte", "cm", "count", "counts", "d", "dB", "deg", "g", "h", "in", "kA",
    "kB", "kHz", "kN", "kV", "kVA", "kW", "kWh", "kbit", "kg", "kΩ", "l", "m", "mA", "mH", "mNm", "mV", "mW", "mbar",
    "min", "mm", "ms", "mΩ", "nF", "ns", "pF", "ppm", "pulse", "rad", "rev", "rpm", "s", "step", "steps", "us", "var",
    "Ω", "L", "hPa", "kPa", "kvar", "lm", "lx", "mL", "mS", "mg", "ml", "mol", "pH", "psi", "t", "dBm", "S",
];

/// Unit symbols that contain `°`, or `µ` as a micro sign or as a Greek letter.
const SIGNS: [&str; 13] = ["°", "°C", "°F", "µs", "µA", "µm", "µV", "µH", "µF", "μs", "μm", "µS", "µg"];

/// Returns whether `symbol` is a known unit symbol, or a product, quotient or power of known symbols such as `rev/s²`.
/// All other units must be defined in `[units]` of the table.
///
/// ```
/// use lexibus_codegen::frontend::table::is_unit;
///
/// assert!(is_unit("rev/s²") && !is_unit("furlong"));
/// ```
pub fn is_unit(symbol: &str) -> bool {
    symbol.split(['/', '·']).all(|part| {
        let single = part.trim_end_matches(['²', '³']);
        SYMBOLS.contains(&single) || SIGNS.contains(&single)
    })
}

/// Returns the symbol of a unit for another spelling of the unit, such as `°C` for `degC` and `rpm` for `1/min`. Returns `None`
/// if the spelling is unknown.
///
/// ```
/// use lexibus_codegen::frontend::table::usual_unit;
///
/// assert_eq!(usual_unit("Volts"), Some("V"));
/// assert_eq!(usual_unit("furlong"), None);
/// ```
pub fn usual_unit(text: &str) -> Option<&'static str> {
    const SPELLINGS: &[(&str, &[&str])] = &[
        (
            "°C",
            &[
                "degc",
                "deg c",
                "℃",
                "c°",
                "ºc",
                "celsius",
                "deg. c",
                "° c",
                "grad c",
                "degrees c",
                "grad celsius",
                "gradi",
            ],
        ),
        ("°F", &["degf", "deg f", "℉", "ºf", "fahrenheit"]),
        ("s", &["sec", "secs", "second", "seconds", "sek", "secondi"]),
        ("ms", &["msec", "millisecond", "milliseconds"]),
        ("min", &["mins", "minute", "minutes", "minuti", "minuten"]),
        ("h", &["hour", "hours", "hr", "hrs", "ore", "std", "stunden"]),
        ("V", &["volt", "volts"]),
        ("A", &["amp", "amps", "ampere", "amperes"]),
        ("W", &["watt", "watts"]),
        ("Hz", &["hertz"]),
        ("kW", &["kilowatt"]),
        ("kWh", &["kw h", "kw·h"]),
        ("var", &["vars"]),
        ("Ω", &["ohm", "ohms"]),
        ("rpm", &["1/min", "u/min", "rev/min", "r/min", "giri/min", "min-1", "min⁻¹"]),
        ("%", &["percent", "pct", "prozent"]),
        ("%RH", &["% rh", "%rh", "rh%", "%r.h."]),
        ("µs", &["us", "μs"]),
        ("µA", &["ua", "μa"]),
        ("l/min", &["lpm", "lt/min"]),
        ("m³", &["m3", "m^3"]),
        ("m³/h", &["m3/h", "m^3/h"]),
        ("m²", &["m2", "m^2"]),
        ("deg", &["degree", "degrees"]),
    ];
    let lower = text.to_lowercase();
    let known = SPELLINGS.iter().find(|(_, spellings)| spellings.contains(&lower.as_str()));
    // These symbols are recognized regardless of case, except for a first letter `m`, `M` or `n`, which can be a prefix. `a` is
    // not recognized because it can also mean a year.
    let cased = ["V", "A", "W", "kW", "kWh", "Wh", "kV", "mV", "mA", "kVA", "VA", "Hz", "kHz", "var", "bar", "Nm"];
    let prefix = |text: &str| text.chars().next().filter(|first| matches!(first, 'm' | 'M' | 'n'));
    let is_same = |symbol: &str| symbol.to_lowercase() == lower && prefix(symbol) == prefix(text) && text != "a";
    let cased = || cased.into_iter().find(|symbol| is_same(symbol));
    known.map(|&(symbol, _)| symbol).or_else(cased)
}

#[cfg(test)]
mod tests {
    use super::{is_unit, usual_unit};

    #[test]
    fn single_and_composed_symbols() {
        for symbol in ["rpm", "rev/s²", "kg·m²", "mNm/A", "mm/count", "°C", "µs", "kbit/s"] {
            assert!(is_unit(symbol), "{symbol}");
        }
        for symbol in ["", "velocity", "rev/", "m^2", "/s", "mms"] {
            assert!(!is_unit(symbol), "{symbol}");
        }
    }

    #[test]
    fn spellings_of_units() {
        for (text, symbol) in [("degC", "°C"), ("Volts", "V"), ("KW", "kW"), ("1/min", "rpm"), ("m3/h", "m³/h")] {
            assert_eq!(usual_unit(text), Some(symbol), "{text}");
        }
        for text in ["furlong", "MV", "MA", "nm", "a", "mw"] {
            assert_eq!(usual_unit(text), None, "{text}");
        }
        for (text, symbol) in [("mv", "mV"), ("ma", "mA"), ("NM", "Nm"), ("HZ", "Hz")] {
            assert_eq!(usual_unit(text), Some(symbol), "{text}");
        }
    }
}
