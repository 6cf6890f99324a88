//! Serialization of real numbers. JSON numbers can be neither infinite nor NaN.

use std::fmt;

use serde::de::{Error, Unexpected, Visitor};
use serde::{Deserializer, Serializer};

/// Writes a finite number as a number, and other numbers as `"inf"`, `"-inf"` or `"NaN"`.
pub(super) fn serialize<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    if number.is_finite() {
        serializer.serialize_f64(*number)
    } else {
        serializer.collect_str(number)
    }
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    deserializer.deserialize_any(Number)
}

struct Number;

impl Visitor<'_> for Number {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, \"inf\", \"-inf\" or \"NaN\"")
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<f64, E> {
        Ok(number)
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<f64, E> {
        Ok(number as f64)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<f64, E> {
        Ok(number as f64)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<f64, E> {
        match text {
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            "NaN" => Ok(f64::NAN),
            _ => Err(E::invalid_value(Unexpected::Str(text), &self)),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::ir::Value;

    fn round_trip(number: f64) -> (String, f64) {
        let text = serde_json::to_string(&Value::Real(number)).expect("JSON");
        let read = serde_json::from_str(&text).expect("the same JSON");
        let Value::Real(read) = read else { panic!("{text}") };
        (text, read)
    }

    #[test]
    fn every_real_number_is_read_as_it_was_written() {
        for (number, text) in [
            (1.5, "1.5"),
            (2.0, "2.0"),
            (-0.0, "-0.0"),
            (f64::INFINITY, "\"inf\""),
            (f64::NEG_INFINITY, "\"-inf\""),
            (f64::NAN, "\"NaN\""),
        ] {
            let (written, read) = round_trip(number);
            assert_eq!(written, format!("{{\"real\":{text}}}"));
            assert_eq!(read.to_bits(), number.to_bits());
        }
        assert_eq!(serde_json::from_str::<Value>("{\"real\":2}").expect("JSON"), Value::Real(2.0));
        let wrong = serde_json::from_str::<Value>("{\"real\":\"infinite\"}").expect_err("no number").to_string();
        assert!(wrong.contains("expected a number, \"inf\", \"-inf\" or \"NaN\""), "{wrong}");
    }
}
