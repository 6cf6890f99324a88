//! x
pub mod check;
pub mod compile;
pub mod declared;
pub mod description;
pub mod frontend;
pub mod model;
pub mod output;
pub mod resolve;
pub mod syntax;
