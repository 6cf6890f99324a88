//! Reads register tables (`*.toml`). `dictionaries/README.md` describes the format.
//!
//! | file | subject |
//! |---|---|
//! | `file`, `chapters` | the parts of a file in the order in which they are read; the rows of a chapter |
//! | `format`, `at`, `alternatives`, `read` | the tables of the format, their common types, and the readers of both |
//! | `tree` | parses the file into these tables, and reports errors with their spans; options |
//! | `notation`, `types`, `value`, `units`, `words` | numbers, ranges and addresses as text; type names; literals; unit symbols; words for access rights and other facts |
//! | `definitions`, `given` | units, enumerations, bit fields; machine constants |
//! | `scale` | conversion of raw values to physical values |
//! | `conditions`, `variants` | conditions for elements; differences between models or buses |
//! | `references`, `numbered` | names that refer to other elements, and register numbers in place of names |
//! | `repeats`, `machine_budget` | limits on the items that rows produce, and on the size of state machines |
//! | `in_use` | names and addresses that are in use |
//! | `buses`, `spaces`, `windows` | sets of buses; the addresses of a register on each bus |
//! | `rows`, `bindings`, `limits`, `registers`, `objects` | items and objects of rows; their addresses; default values, limits and allowed values |
//! | `defaults`, `misplaced` | keys that rows inherit; keys that have no effect in their row |
//! | `device` | the head: device, models, axes |
//! | `process`, `images` | process data: PDOs, fixed process images |
//! | `code_tables`, `machines`, `states`, `outcomes`, `messages`, `framing` | codes; state machines and procedures; states; state-command matrices; messages and their frames |
//! | `composites` | numbers that are split over several items |
//! | `overlay` | tables that change the objects of another description |
//! | `lints`, `summary` | checks of the notation; comparison of a row with other sections of the manual |
//! | `schema` | derives the JSON Schema of the format in tests; the file `schema/table.json` contains the result |

mod alternatives;
mod at;
mod bindings;
mod buses;
mod by_name;
mod chapters;
mod code_tables;
mod composites;
mod conditions;
mod defaults;
mod definitions;
mod device;
mod document;
mod ethercat;
mod file;
pub mod format;
mod frames;
#[cfg(feature = "messages")]
mod framing;
mod given;
mod images;
mod in_use;
mod limits;
mod lints;
mod machine_budget;
mod machines;
#[cfg(feature = "messages")]
mod messages;
mod misplaced;
mod notation;
mod numbered;
mod objects;
mod outcomes;
pub mod overlay;
mod process;
mod read;
mod references;
mod registers;
mod repeats;
mod rows;
mod scale;
#[cfg(test)]
mod schema;
mod spaces;
mod states;
mod summary;
mod tree;
mod types;
mod units;
mod value;
mod variants;
mod windows;
mod words;

use file::Table;
pub use file::{read, SCHEMA};
pub use units::{is_unit, usual_unit};
