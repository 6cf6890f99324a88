"""Reads files with Python libraries and prints the time of each.

Each line of standard input contains the name of a reader, the number of repetitions, and a path, separated by tabs. The script answers
each line with a line that contains the time in seconds or an error. The time includes reading the file from the disk cache, which
takes at most a hundredth of it.
"""

import gc
import logging
import sys
import time
import warnings

import canopen
from lxml import etree
from profinet import gsdml

logging.disable(logging.CRITICAL)
warnings.simplefilter("ignore")


def read_canopen(path):
    return canopen.import_od(path)


def read_profinet(path):
    return gsdml.load_gsdml(path)


def texts(element, *paths):
    return [element.findtext(path) for path in paths]


def read_esi(path):
    """Returns the facts that a typical lxml script reads from an ESI: identity, dictionary and PDOs."""
    devices = []
    for device in etree.parse(path).getroot().iterfind("Descriptions/Devices/Device"):
        kind = device.find("Type")
        types = {
            data_type.findtext("Name"): [
                texts(item, "SubIdx", "Name", "Type", "BitSize", "BitOffs", "Flags/Access")
                for item in data_type.iterfind("SubItem")
            ]
            for data_type in device.iterfind("Profile/Dictionary/DataTypes/DataType")
        }
        objects = [
            (
                texts(item, "Index", "Name", "Type", "BitSize", "Info/DefaultData", "Flags/Access", "Flags/PdoMapping"),
                [texts(sub, "Name", "Info/DefaultData") for sub in item.iterfind("Info/SubItem")],
            )
            for item in device.iterfind("Profile/Dictionary/Objects/Object")
        ]
        pdos = [
            (
                pdo.tag,
                texts(pdo, "Index", "Name"),
                [texts(entry, "Index", "SubIndex", "BitLen", "Name", "DataType") for entry in pdo.iterfind("Entry")],
            )
            for pdo in device.xpath("RxPdo|TxPdo")
        ]
        devices.append((kind.get("ProductCode"), kind.get("RevisionNo"), device.findtext("Name"), types, objects, pdos))
    return devices


def read_gsdml(path):
    """Returns the facts that a typical lxml script reads from a GSDML: texts, modules, submodules and records."""
    space = {"g": "http://www.profibus.com/GSDML/2003/11/DeviceProfile"}
    root = etree.parse(path).getroot()
    names = {text.get("TextId"): text.get("Value") for text in root.xpath("//g:PrimaryLanguage/g:Text", namespaces=space)}
    modules = []
    for module in root.xpath("//g:ModuleItem|//g:DeviceAccessPointItem", namespaces=space):
        records = [
            (
                record.get("Index"),
                record.get("Length"),
                [(dict(ref.attrib), names.get(ref.get("TextId"))) for ref in record.iterfind("g:Ref", space)],
            )
            for record in module.iterfind(".//g:ParameterRecordDataItem", space)
        ]
        data = [(item.get("DataType"), names.get(item.get("TextId"))) for item in module.iterfind(".//g:DataItem", space)]
        modules.append((module.get("ID"), module.get("ModuleIdentNumber"), records, data))
    return modules


def seconds(read, path, repetitions):
    total = 0.0
    for _ in range(repetitions):
        start = time.perf_counter()
        made = read(path)
        total += time.perf_counter() - start
        del made
        # Collect garbage now, so that it does not affect the next measurement.
        gc.collect()
    return total


READERS = {
    "canopen": read_canopen,
    "profinet-py": read_profinet,
    "lxml ESI": read_esi,
    "lxml GSDML": read_gsdml,
}

for line in sys.stdin:
    reader, repetitions, path = line.rstrip("\n").split("\t")
    try:
        reply = f"{seconds(READERS[reader], path, int(repetitions)):.9f}"
    except Exception as error:  # The answer for this file is the exception.
        reply = " ".join(f"{type(error).__name__}: {error}".split())
    print(reply, flush=True)
