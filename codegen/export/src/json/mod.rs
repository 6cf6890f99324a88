//! JSON output: the complete IR, and the summary that `lexibus info` prints.

mod dump;
mod info;

pub use dump::dump;
pub use info::{
    info, DapInfo, DeviceInfo, DictionaryInfo, Info, ModuleContent, ModuleInfo, PdoInfo, RecordInfo, SubmoduleInfo,
};
