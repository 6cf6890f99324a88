//! Reads keys whose value can have one of two forms: a scale factor or a rule, a number or a text, a Boolean or a text,
//! values or bits.

use super::at::{Literal, OneOrMany};
use super::document::Value;
use super::format::{ConditionTable, ConditionValues, FlagOrText, NumberOrText, ScaleRule, Scaling};
use super::read::{literal, number, Mistake, Node, Read};

impl Read for Scaling {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        const EXPECTED: &str =
            "a factor, or a table with `factor`, `by`, `times`, `reciprocal`, `fraction` or `exponent`";
        match &node.value {
            Value::Table(_) => ScaleRule::read(node).map(|rule| Scaling::Rule(Box::new(rule))),
            _ => number(node).map(Scaling::Factor).ok_or_else(|| Mistake::expected(node, EXPECTED)),
        }
    }
}

impl Read for NumberOrText {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match &node.value {
            Value::Text(text) => Ok(NumberOrText::Text(text.to_string())),
            Value::Integer(..) => i64::read(node).map(NumberOrText::Number),
            _ => Err(Mistake::expected(node, "an integer or a text")),
        }
    }
}

impl Read for FlagOrText {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match &node.value {
            Value::Text(text) => Ok(FlagOrText::Text(text.to_string())),
            Value::Boolean(flag) => Ok(FlagOrText::Flag(*flag)),
            _ => Err(Mistake::expected(node, "true, false or a text")),
        }
    }
}

impl Read for ConditionValues {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        let OneOrMany(list) = OneOrMany::<LiteralOrTable>::read(node)?;
        let mut values = Vec::new();
        for value in list {
            match value {
                LiteralOrTable::Literal(value) => values.push(value),
                LiteralOrTable::Table(bits) if values.is_empty() => return Ok(ConditionValues::Bits(bits)),
                LiteralOrTable::Table(_) => {
                    let message = "a condition has values, or one table with `mask` and `value`".to_owned();
                    return Err(Mistake::value(node, message));
                }
            }
        }
        Ok(ConditionValues::Values(OneOrMany(values)))
    }
}

/// Literal, or the table of a condition.
enum LiteralOrTable {
    Literal(Literal),
    Table(ConditionTable),
}

impl Read for LiteralOrTable {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match &node.value {
            Value::Table(_) => ConditionTable::read(node).map(LiteralOrTable::Table),
            _ => {
                let literal = literal(node).map(LiteralOrTable::Literal);
                literal.ok_or_else(|| Mistake::expected(node, "a value, or a table with `mask` and `value`"))
            }
        }
    }
}
