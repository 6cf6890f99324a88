"""Compares the output of `lexibus network build` with that of Lely's `dcfgen`.

Arguments: folders that contain `bus.yml` and the folder `lexibus` with the output of Lexibus. Prints one line of JSON per folder:
`error` is the message of `dcfgen` if it rejects the network, and `differences` is a list of texts. Numbers in texts are decimal.
Both DCF of the master are read with the library of `dcfgen`, so that only values are compared, and not their notation."""

import contextlib
import io
import json
import os
import struct
import sys
import warnings

import dcf
import dcfgen.cli

warnings.simplefilter("ignore")


def generate():
    """Runs `dcfgen` on bus.yml in the working folder."""
    os.makedirs("dcfgen", exist_ok=True)
    sys.argv = ["dcfgen", "-r", "-d", "dcfgen", "bus.yml"]
    with contextlib.redirect_stdout(io.StringIO()):
        dcfgen.cli.main()


def values(path):
    """Returns the values of a DCF: (index, sub-index) -> data type, access, value or file."""
    device = dcf.Device(dcf.parse_file(path))
    found = {}
    for index, entries in device.items():
        for sub_index, entry in entries.items():
            if entry.data_type.index == 0x000F:
                value = getattr(entry, "upload_file", "")
            else:
                value = entry.parse_value()
            found[index, sub_index] = (entry.data_type.index, entry.access_type.name, value)
    return found, device


# First indices of the master's objects for the PDOs of the nodes. These objects contain, in this order: communication parameters and
# mapping of the master's PDO, the mapped data, number and node-ID of the node's PDO, and the mapping of the node's PDO.
PDOS = {"TPDO": (0x1400, 0x1600, 0x2000, 0x5800, 0x5A00), "RPDO": (0x1800, 0x1A00, 0x2200, 0x5C00, 0x5E00)}


def by_pdo(found):
    """Replaces the indices of objects for PDOs with the name of the PDO, and the places of mapped data with their types, so that a PDO
    that only one file has changes nothing else. Returns the names of the PDOs, too."""
    names, pdos = {}, set()
    for kind, (communication, mapping, data, number, remote) in PDOS.items():
        for position in range(512):
            if (number + position, 0) in found:
                value = found[number + position, 0][2]
                pdos.add(f"{kind} {value >> 8} of node {value & 0xFF}")
                for part, first in zip(("communication", "mapping", "data", "number", "remote"), PDOS[kind]):
                    names[first + position] = f"{kind} {value >> 8} of node {value & 0xFF}, {part}"
    renamed = {}
    for (index, sub_index), (ty, access, value) in found.items():
        name = names.get(index, f"{index:#06x}")
        if name.endswith("mapping") and sub_index > 0:
            value = (*found[value >> 16, value >> 8 & 0xFF][:2], value & 0xFF)
        renamed[name, sub_index] = (ty, access, value)
    return renamed, pdos


def entries(path):
    """Returns the entries of a concise DCF, or its bytes if they are not valid."""
    data = open(path, "rb").read()
    (count,) = struct.unpack_from("<L", data)
    found, at = [], 4
    for _ in range(count):
        if at + 7 > len(data):
            return data
        index, sub_index, length = struct.unpack_from("<HBL", data, at)
        at += 7 + length
        found.append((index, sub_index, data[at - length : at]))
    return found if at == len(data) else data


def shown(entry):
    return f"{entry[0]:#06x}:{entry[1]} = {entry[2].hex()}"


def compare_concise(name):
    ours, theirs = (os.path.join(folder, name) for folder in ("lexibus", "dcfgen"))
    if os.path.exists(ours) != os.path.exists(theirs):
        who = "lexibus" if os.path.exists(ours) else "dcfgen"
        yield f"{name}: only {who} writes the file"
    elif os.path.exists(ours) and open(ours, "rb").read() != open(theirs, "rb").read():
        ours, theirs = entries(ours), entries(theirs)
        if isinstance(theirs, bytes):
            yield f"{name}: dcfgen writes an invalid file"
            return
        yield f"{name}: " + "; ".join(
            [f"only lexibus {shown(entry)}" for entry in ours if entry not in theirs]
            + [f"only dcfgen {shown(entry)}" for entry in theirs if entry not in ours]
        )


def compare_master():
    (ours, our_device), (theirs, their_device) = values("lexibus/master.dcf"), values("dcfgen/master.dcf")
    (ours, our_pdos), (theirs, their_pdos) = by_pdo(ours), by_pdo(theirs)
    single = our_pdos ^ their_pdos
    yield from (f"{'lexibus' if pdo in our_pdos else 'dcfgen'} only: {pdo}" for pdo in sorted(single))
    nodes = {pdo.split()[-1] for pdo in single}

    def is_of_single(name):
        """The data of a PDO are where the first PDO of the node maps them, so a single PDO moves the data of others."""
        pdo, _, part = name.partition(", ")
        return pdo in single or part == "data" and pdo.split()[-1] in nodes

    for object in sorted(ours.keys() | theirs.keys()):
        if ours.get(object) != theirs.get(object) and not is_of_single(object[0]):
            yield f"master.dcf {object[0]}:{object[1]}: lexibus {ours.get(object)}, dcfgen {theirs.get(object)}"
    for name in ("node_id", "vendor_id", "product_code", "revision_number"):
        if getattr(our_device, name) != getattr(their_device, name):
            yield f"master.dcf: {name}"
    for section in ("DeviceComissioning", "DeviceInfo", "DummyUsage"):
        one, other = (dict(device.cfg[section]) for device in (our_device, their_device))
        for key in ("Baudrate", "CANopenManager", "NrOfRxPDO", "NrOfTxPDO", *(key for key in other if key.startswith("Dummy"))):
            lower = lambda entries: {name.lower(): value for name, value in entries.items()}
            if key.startswith("NrOf") and single:
                continue
            if key.lower() in lower(other) and lower(one).get(key.lower()) != lower(other)[key.lower()]:
                yield f"master.dcf [{section}] {key}"


start = os.getcwd()
for folder in sys.argv[1:]:
    os.chdir(os.path.join(start, folder))
    verdict = {"error": "", "differences": []}
    try:
        generate()
    except Exception as error:  # The program raises an exception if it rejects the network.
        verdict["error"] = repr(error)
    else:
        names = {name for part in ("lexibus", "dcfgen") for name in os.listdir(part) if name.endswith(".bin")}
        for name in sorted(names):
            verdict["differences"] += compare_concise(name)
        verdict["differences"] += compare_master()
    print(json.dumps(verdict))
