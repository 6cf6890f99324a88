//! TOML and YAML as trees with spans.

mod toml;
mod tree;
mod yaml;

pub use self::toml::parse as parse_toml;
pub use tree::{At, Content, Entry, Node, Scalar, SyntaxError};
pub use yaml::parse as parse_yaml;
pub(crate) use yaml::{extent, MAX_ELEMENTS};
