//! Values of the format that are one thing or another: a factor or a rule, values or bits.

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};

use super::at::{Literal, OneOrMany};
use super::format::{ConditionTable, ScaleRule, Scaling};

impl<'de> Deserialize<'de> for Scaling {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = Scaling;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a factor, or a table with `factor`, `by`, `times`, `reciprocal`, `fraction` or `exponent`")
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Scaling, E> {
                Ok(Scaling::Factor(value as f64))
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<Scaling, E> {
                Ok(Scaling::Factor(value as f64))
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Scaling, E> {
                Ok(Scaling::Factor(value))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Scaling, A::Error> {
                ScaleRule::deserialize(MapAccessDeserializer::new(map)).map(|rule| Scaling::Rule(Box::new(rule)))
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// The values that a condition names, and the bits that it compares.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum ConditionValues {
    /// Values of the whole item.
    Values(OneOrMany<Literal>),
    /// Values of some of its bits.
    Bits(ConditionTable),
}

impl Default for ConditionValues {
    fn default() -> Self {
        ConditionValues::Values(OneOrMany::default())
    }
}

impl<'de> Deserialize<'de> for ConditionValues {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        /// A table is never a value, so that the two can be told apart.
        struct Single(ConditionValues);
        impl<'de> Deserialize<'de> for Single {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                match LiteralOrTable::deserialize(deserializer)? {
                    LiteralOrTable::Literal(literal) => Ok(Single(ConditionValues::Values(OneOrMany(vec![literal])))),
                    LiteralOrTable::Table(table) => Ok(Single(ConditionValues::Bits(table))),
                }
            }
        }
        let OneOrMany(list) = OneOrMany::<Single>::deserialize(deserializer)?;
        let mut values = Vec::new();
        for Single(own) in list {
            match own {
                ConditionValues::Values(OneOrMany(own)) => values.extend(own),
                bits if values.is_empty() => return Ok(bits),
                _ => return Err(D::Error::custom("a condition is values, or one table of `mask` and `value`")),
            }
        }
        Ok(ConditionValues::Values(OneOrMany(values)))
    }
}

/// A literal or the table of a condition.
enum LiteralOrTable {
    Literal(Literal),
    Table(ConditionTable),
}

impl<'de> Deserialize<'de> for LiteralOrTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = LiteralOrTable;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a value, or a table of `mask` and `value`")
            }

            fn visit_bool<E: Error>(self, value: bool) -> Result<LiteralOrTable, E> {
                Ok(LiteralOrTable::Literal(Literal::Bool(value)))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<LiteralOrTable, E> {
                Ok(LiteralOrTable::Literal(Literal::Int(value.into())))
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<LiteralOrTable, E> {
                Ok(LiteralOrTable::Literal(Literal::Int(value.into())))
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<LiteralOrTable, E> {
                Ok(LiteralOrTable::Literal(Literal::Real(value)))
            }

            fn visit_str<E: Error>(self, value: &str) -> Result<LiteralOrTable, E> {
                Ok(LiteralOrTable::Literal(Literal::Text(value.to_owned())))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<LiteralOrTable, A::Error> {
                ConditionTable::deserialize(MapAccessDeserializer::new(map)).map(LiteralOrTable::Table)
            }
        }
        deserializer.deserialize_any(Either)
    }
}
