//! Creates EDS files of any size.

use std::fmt::Write;

/// Returns an EDS with `records` records in the style and proportions of real files.
pub fn eds(records: usize) -> String {
    let mut text = String::from("[FileInfo]\nFileName=bench.eds\nEDSVersion=4.0\n\n[DeviceInfo]\nVendorName=Bench\n");
    text += "ProductName=Bench\nVendorNumber=1\nProductNumber=2\nRevisionNumber=3\nNrOfRXPDO=0\nNrOfTXPDO=0\n\n";
    text += "[ManufacturerObjects]\n";
    let _ = writeln!(text, "SupportedObjects={records}");
    for number in 0..records {
        let _ = writeln!(text, "{}=0x{:04X}", number + 1, 0x2000 + number);
    }
    for number in 0..records {
        record(&mut text, 0x2000 + number);
    }
    text
}

/// Returns an EDS with `10 * size` records.
pub fn growing(size: usize) -> Vec<u8> {
    eds(10 * size).into_bytes()
}

fn record(text: &mut String, index: usize) {
    let _ = writeln!(text, "\n[{index:04X}]\nParameterName=Axis parameter set {index}\nObjectType=0x9\nSubNumber=9");
    let _ = writeln!(text, "\n[{index:04X}sub0]\nParameterName=Highest sub-index supported\nObjectType=0x7");
    let _ = writeln!(text, "DataType=0x0005\nAccessType=const\nDefaultValue=0x08\nPDOMapping=0");
    for sub in 1..=8 {
        let _ = writeln!(text, "\n[{index:04X}sub{sub:X}]\nParameterName=Velocity limit {sub}\nObjectType=0x7");
        let _ = writeln!(text, "DataType=0x0004\nAccessType=rw\nDefaultValue=0x00000{sub:03X}\nPDOMapping=1");
        let _ = writeln!(text, "LowLimit=-2147483648\nHighLimit=0x7FFFFFFF");
    }
}
