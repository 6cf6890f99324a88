//! Converts EtherCAT slave information (ESI, ETG.2000) to IR.
//!
//! The reader accepts elements in any order, because real files do not follow the schema. Each file is parsed once,
//! except for its PDO templates. Some facts depend on later elements, such as the data types of objects and the vendor
//! of devices. These facts are resolved at the end of the common parent element. Data types, objects and PDOs belong to
//! one device or module. Referenced files are read last.
//!
//! | file | subject |
//! |---|---|
//! | `read`, `document`, `references`, `description` | the main file, single files, and references to other files |
//! | `reader`, `text`, `number`, `slot_index` | reader state; texts, numbers and indices of ETG.2000 |
//! | `budget` | limits on the items and texts that references copy |
//! | `info` | the vendor, groups, lists of devices and modules |
//! | `device`, `device_info`, `eeprom` | devices |
//! | `sync`, `mailbox`, `clocks` | FMMUs and sync managers; the mailbox; distributed clocks |
//! | `pdo`, `pdos`, `templates` | PDOs and their entries; PDO templates of old files |
//! | `slots`, `modules` | slots, and the modules that fit into them |
//! | `profile`, `diagnosis` | profiles, diagnosis messages |
//! | `dictionary` | dictionaries as written: `data_type`, `object`, `info_value`, `flags` |
//! | `lower` | conversion of dictionaries and PDOs to the IR: `types`, `items`, `entries`, `value`, `array_default` |

mod array_default;
mod budget;
mod clocks;
mod data_type;
mod description;
mod device;
mod device_info;
mod diagnosis;
mod dictionary;
mod document;
mod eeprom;
mod entries;
mod flags;
mod info;
mod info_value;
mod items;
mod lower;
mod mailbox;
mod modules;
mod number;
mod object;
mod pdo;
mod pdos;
mod profile;
mod read;
mod reader;
mod references;
mod slot_index;
mod slots;
mod sync;
mod templates;
mod text;
mod types;
mod value;

pub use read::read;
