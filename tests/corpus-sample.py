#!/usr/bin/env python3
"""Chooses the files of the corpus that the fast tests read, and writes their names to tests/corpus-sample.txt.

usage: tests/corpus-sample.py LEXIBUS [--check | --explain] [--jobs N]

LEXIBUS is the command-line program. The corpus is ../shared/corpus, next to the repository. --check writes nothing and exits
with status 1 if the list is stale, with status 0 if there is no corpus. --explain writes nothing and prints the features that
each file was chosen for, and the features that only files above SIZE_LIMIT have: these are left to the full tests.

Each file has a set of features:

- `format`: the format and encoding that `lexibus info` reports, the folder and extension of the file, and the root of XML;
- `code`: a diagnostic code that occurs, with every lint switched on;
- `ir`: a part of the intermediate representation (`lexibus dump`) that isn't empty. Its name is the format family and the last
  KEYS keys of its path, without list positions. Each variant of an enumeration is a separate part. For numbers and texts, only
  their presence counts. A type is the same part wherever it is used (TYPES), with its width if WIDTHS contains the width.
  The keys in IGNORED are not read. Finer rules would make the sample larger, because a few large files have many rare features;
- `quirk`: a row of ../shared/QUIRKS.md that a regular expression finds in the text. A letter follows the row if the row has
  several forms.

The sample is a greedy set cover. Each step takes the file with the most new features per cost, until every feature of a file
up to SIZE_LIMIT is covered. The cost is the size plus FILE_COST. Then the script drops files whose features all occur in other
chosen files, the largest first. Finally, it adds files until each folder has its MINIMUM number of files.
"""
import argparse
import json
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CORPUS = ROOT.parent / "shared" / "corpus"
LIST = ROOT / "tests" / "corpus-sample.txt"
NOT_DESCRIPTIONS = {"MANIFEST.tsv", "oracle.json"}
MINIMUM = {"eds": 12, "esi": 8, "gsdml": 8}
# Maximum size in bytes of a file in the sample. Only the full lane reads larger files, because a debug build needs longer for one
# large file than for ten small ones.
SIZE_LIMIT = 250_000
# Number of bytes that are added to the size of each file, so that the script prefers a medium-sized file to many tiny ones.
FILE_COST = 50_000

# Family of each format. The formats of a family share a front end or a part of the intermediate representation.
FAMILIES = {"eds": "canopen", "dcf": "canopen", "xdd": "canopen", "esi": "ethercat", "gsdml": "profinet"}
# Keys of the intermediate representation that the script ignores, because their values are positions or free text.
IGNORED = {"at", "documentation", "doubts", "extensions", "files", "header", "name_at", "names", "origin", "span", "step_spans",
           "translations", "units"}
# Keys whose text is the name of an enumeration variant. The text of other keys is data.
ENUMERATIONS = {"access", "code", "completion", "direction", "kind", "meaning", "pdi_access", "purpose", "space", "storage",
                "trigger", "type", "zone"}
# Keys in items, arrays, aliases and enumerations whose value is a type.
TYPES = {"ty", "element", "alias", "base"}
# Widths in bits that count as separate features. All other widths count as one feature.
WIDTHS = {1, 8, 16, 24, 32, 64}
KEYS = 5

# Regular expressions that find the notations described in the rows of QUIRKS.md. Matching ignores case; `^` and `$` match the
# start and end of a line. This table does not contain rows with a diagnostic code. It also does not contain rows that the script
# recognizes by the encoding or the intermediate representation (E52, E84, X25, G01). It does not contain rows that no regular
# expression recognizes (E38, E79, X26, X29).
SECTION = r"^\[[0-9a-f]{4}(?:sub[0-9a-f]+)?\].*\n"
NONZERO = r" *= *0*(x0*)?[1-9a-f]"
QUIRKS = {
    "E01": [r"^(Vendor|Product|Revision)Number *= *0\d"],
    "E04": [r"= *(?-i:0X)[0-9a-f]"],
    "E05": [r"^DefaultValue *=\s*$"],
    "E06": [r"^(ObjectType|VendorNumber) *=\s*$"],
    "E07": [r"^LowLimit *= *0x80000000"],
    "E09": [r"= *-0x"],
    "E10": [r"^DataType *= *0x0*1[06]\b"],
    "E12": [r"= *(?-i:\$NODEID)\+"],
    "E13": [r"\$NODEID +\+"],
    "E14": [r"\$(?!(?-i:NODEID))NODEID"],
    "E16": [r"= *\$NODEID\s*$"],
    "E17": [r"\$NODEID *\+[^+\n]+\+"],
    "E20": [r"^(?!ParameterName)\w+ *= *[^\s;]+ +;"],
    "E22": [r"^ParameterName *=.*[;#]"],
    "E23": [r"^ParameterName *=.*%", r"^ParameterName *=.*="],
    "E24": [r"^\[[0-9a-f]{4}(?-i:Sub|SUB)"],
    "E25": [r"(?-i:^\[deviceinfo\]|^parametername)"],
    "E26": [r"^\[(?=[0-9a-f]{4}(sub|\]))(?-i:[0-9A-F]*[a-f])"],
    "E31": [r"\r\n", r"(?<!\r)\n", r"\r(?!\n)", r"\A(?=[\s\S]*\r\n)[\s\S]*[^\r]\n", r"[^\r\n]\Z"],
    "E32": [r"\x1a\s*\Z"],
    "E37": [r"^\d+ *= +0x", r"^\d+ *= *[1-9]\d{3,4}\s*$"],
    "E40": [SECTION + r"(?:(?!\[|SubNumber|Compact).*\n)*?ObjectType *= *0x0*[89]\b.*\n(?:(?!\[|SubNumber|Compact).*\n)*(?=\[|\Z)"],
    "E41": [r"^\[[0-9a-f]{4}sub0[0-9a-f]"],
    "E43": [r"^CompactSubObj" + NONZERO],
    "E44": [r"^\[[0-9a-f]{4}Name\]", r"^\[[0-9a-f]{4}Value\]"],
    "E46": [SECTION + r"(?:(?!\[|ObjectType).*\n)+(?=\[|\Z)"],
    "E47": [r"^AccessType *= *[a-z]*(?-i:[A-Z])"],
    "E51": [r"^DefaultValue *= *-?\d+\.\d", r"^\w+ *= *-?\d+\.\d+E",
            r"^DataType *= *0x0*(?:8|11)\s*$(?:\n(?!\[).*)*?\nDefaultValue *= *0x"],
    "E53": [r"^DefaultValue *= *[0-9a-f]{2}( [0-9a-f]{2})+\s*$", r"^DataType *= *0x0*A\b"],
    "E55": [r"^ObjectType *= *(0x)?0*2\b"],
    "E56": [r"^DataType *= *(0x)?0*C\b", r"^DataType *= *(0x)?0*(0|40)\b"],
    "E57": [r"^\[(00)?[0-9a-f]{2,3}\]", r"^\[(00)?[0-9a-f]{2,3}sub[0-9a-f]+\]"],
    "E58": [r"^\[DummyUsage\].*\n(?:(?!\[|Dummy0007).*\n)+(?=\[|\Z)", r"\A(?![\s\S]*^\[DummyUsage\])[\s\S]*^\[DeviceInfo\]"],
    "E59": [r"^\[Comments\].*\n(?:(?!\[|Lines).*\n)*(?=\[|\Z)", r"^(?-i:line)\d"],
    "E60": [r"^\w+ +="],
    "E61": [r"^\[[^\]\n]+\] *;", r"^\[[^\]\n]+\] *#"],
    "E63": [r"^PDOMapping *= *(?![01]?\s*$)"],
    "E66": [r"(?-i:^NrOfRxPDO)", r"(?-i:^Baudrate_)", r"(?-i:^Vendorname)", r"(?-i:^SimpleBootupSlave)"],
    "E68": [r"^\[DeviceCommissioning\]", r"^\[DeviceComissioning\]"],
    "E69": [r"^\[DeviceCom+issioning\].*\n(?:(?!\[).*\n)*?NodeID *= *\S"],
    "E70": [r"^CompactPDO" + NONZERO],
    "E71": [r"^\[M\d+"],
    "E72": [r"ObjectLinks\]", r"^\[DynamicChannels\]"],
    "E73": [r"^ObjFlags" + NONZERO],
    "E80": [r"^ParameterName *=.*[^\x00-\x7f]", r"^ParameterName *= *\d", r"^ParameterName *=.*/", r"^ParameterName *=.{200}",
            r"^ParameterName *= *(type|move|match|loop|ref|self|enum|struct|static|const|in|use|where)\s*$"],
    "E82": [r"^Granularity *= *(0x)?0*8\b"],
    "X01": [r"\A(?!.{0,3}<\?xml)", r"encoding=.ISO8859", r"encoding=.ISO-8859-1"],
    "X03": [r"<EtherCATInfoList\b", r"<(EtherCATTest|SscToolConfiguration)\b"],
    "X04": [r"<EtherCATInfo\b(?![^>]*\sVersion=)", r"<EtherCATInfo\b(?![^>]*schemaLocation)"],
    "X05": [r"<Vendor\b[^>]*>\s*<Id(/>|>\s*<)", r"<Vendor\b[^>]*>\s*<Id>\s*0x", r"<Vendor\b[^>]*>\s*<Id>\s*\d"],
    "X06": [r"<Vendor\b(?:(?!</Vendor|<Name)[\s\S])*</Vendor", r"</[RT]xPdo>\s*<Sm\b", r"</Name>\s*<Type\b[^>]*ProductCode"],
    "X07": [r"LcId=.[01]\b", r"LcId=.1031\b", r"LcId=.2052\b"],
    "X08": [r"<Index>0\d", r"<Index>[1-9]\d*<", r"<SubIndex>#x", r"<SubIndex>\d"],
    "X09": [r"<Index>(#x)?0+</Index>(?:(?!</Entry)[\s\S])*<Name"],
    "X10": [r"<Entry\b(?:(?!</Entry|<DataType)[\s\S])*</Entry", r"<Entry\b(?:(?!</Entry|<Name)[\s\S])*</Entry"],
    "X15": [r"<DefaultData>[^<]*\n"],
    "X16": [r"<DefaultValue>-?\d+\.\d", r"<DefaultValue>#xFFFFFFFF<", r"<(Min|Max)Value>-"],
    "X17": [r"<PdoMapping>(?-i:[RT]+)<", r"<PdoMapping>(?-i:[rt]+)<", r"<PdoMapping>(RT|TR)<"],
    "X20": [r"<Device\b(?:(?!</Device>|<Sm\b)[\s\S])*</Device>", r"Physics=.[ BK]*B"],
    "X21": [r"<Dictionary>(?:(?!</Dictionary>|<Objects\b)[\s\S])*</Dictionary>",
            r"<Device\b(?:(?!</Device>|<Profile\b)[\s\S])*</Device>"],
    "X23": [r"<Type\b[^>]*ProductCode=\"([^\"]+)\"[\s\S]*<Type\b[^>]*ProductCode=\"\1\"", r"ProductCode=.\d",
            r"<Type\b(?![^>]*RevisionNo)[^>]*ProductCode"],
    "X24": [r"<InfoReference\b", r"<DictionaryFile\b"],
    "X27": [r"ProductCode=.(?-i:#X)", r"ProductCode=\"( |[^\" ]* )"],
    "X28": [r"<ImageData16x14>", r"<ImageData16x14>[^<]*\n"],
    "X30": [r"<AssignActivate>#x", r"<AssignActivate>\d"],
    "X31": [r"#x0x"],
    "X33": [r"<[RT]xPdo\b[^>]*\sRef=", r"<Pdo\b[^>]*\sRefName="],
    "X35": [r"<Flags>(?:(?!</Flags)[\s\S])*<Setting", r"<Flags>(?:(?!</Flags)[\s\S])*<Backup"],
    "X36": [r"_hex<"],
    "X37": [r"\A[\s\S]{0,400}<EtherCATDict\b"],
    "G03": [r"ModuleIdentNumber=.0x[0-9a-f]{1,7}\""],
    "G04": [r"AllowedInSlots=\"[^\"]*\.\.\d+ ", r"FixedInSlots=\"\d+ ", r"UsedInSlots="],
    "G05": [r"AllowedValues=\"[^\"]*\d \d", r"AllowedValues=\"-\d+\.\.", r"AllowedValues=\"[^\"]*e\+?\d"],
    "G06": [rf"<Ref\b(?=[^>]*DataType=.{kind}\b)[^>]*DefaultValue=\"[^\"]" for kind in ("VisibleString", "Float32", "Bit")],
    "G07": [rf"<DataItem\b[^>]*DataType=.{kind}\b" for kind in ("OctetString", "Float32", "Integer32", "Float64")],
    "G08": [r"<DataItem\b(?![^>]*TextId)"],
    "G09": [r"<EnergySavingModeItem\b"],
    "G10": [r"<DeviceAccessPointItem\b[\s\S]*<DeviceAccessPointItem\b"],
    "G11": [r"<Const\b[^>]*/>\s*<Const\b", r"<Const\b[^>]*ByteOffset=.[1-9]"],
    "G13": [r"<(Channel|Quality)\b"],
    "G14": [r"GSDML-DeviceProfile-v(1|2\.[01])\b"],
    "G16": [r"DataType=\"Float\""],
    "G17": [r"StartupMode=\"[^\"]*;", r"MaxSupportedRecordSize=", r"\A(?![\s\S]*<RecordDataList)"],
    "G18": [r"API=.(0x0*3A00|14848)\b", r"API=.(0x0*5B00|23296)\b"],
    "G19": [r"F_MessageTrailer4Byte", r"F_MessageTrailer5Byte"],
    "G20": [r"ProfileChannelDiag", r"<IsochroneMode\b"],
}


def quirk_features(text, initial):
    """Returns the rows of QUIRKS that start with this letter and occur in the text."""
    for row, forms in QUIRKS.items():
        for position, form in enumerate(forms):
            if row[0] == initial and re.search(form, text, re.MULTILINE | re.IGNORECASE):
                yield "quirk", row + ("abcde"[position] if len(forms) > 1 else "")


def ir_features(value, family, path):
    """Returns the parts of the intermediate representation at a path that aren't empty."""
    if isinstance(value, dict):
        for key, part in value.items():
            if key in IGNORED:
                continue
            inner = ("type",) if key in TYPES else path + (key,)
            # A map with one key is an enumeration variant. The name of a variant counts even if its content is empty.
            if len(value) == 1:
                yield "ir", f"{family}: {'/'.join(inner[-KEYS:])}"
            yield from ir_features(part, family, inner)
    elif isinstance(value, list):
        for part in value:
            yield from ir_features(part, family, path)
    elif value:
        if path[-1] in ("integer", "unsigned"):
            path += (str(value) if value in WIDTHS else "other width",)
        elif isinstance(value, str) and path[-1] in ENUMERATIONS and re.fullmatch("[a-z][a-z0-9_]*", value):
            path += (value,)
        yield "ir", f"{family}: {'/'.join(path[-KEYS:])}"


def features_of_file(lexibus, warn, file):
    """Returns the size of a file and its features."""
    def run(*command):
        return subprocess.run([lexibus, *command, "-j", "1", *warn, str(file)], capture_output=True).stdout

    folder, size = file.parent.name, file.stat().st_size
    summary = run("info", "--format", "json")
    if not summary:
        sys.exit(f"`lexibus info` prints nothing about {folder}/{file.name}")
    info = json.loads(summary)
    kind = file.suffix.lower() if folder == "eds" else folder
    features = {("format", f"{info.get('format')} in {info.get('encoding')}"), ("format", f"{folder}: {kind}")}
    features |= {("code", code) for code in (*info["errors"], *info["warnings"])}
    if info.get("format") != "xdd":
        text = file.read_bytes().decode("latin-1")
        root = re.search(r"<([A-Za-z]\w*)", text) if folder != "eds" else None
        if root:
            features.add(("format", f"root {root.group(1)}"))
        features.update(quirk_features(text, {"eds": "E", "esi": "X", "gsdml": "G"}[folder]))
    if size <= SIZE_LIMIT:
        # `lexibus dump` prints nothing for a file with errors.
        dump = run("dump")
        if dump:
            features.update(ir_features(json.loads(dump), FAMILIES[info["format"]], ()))
    return size, features


def choose_sample(files):
    """Returns the chosen files, each with the features that it was chosen for, and the features that only large files have."""
    # Sort the files to make the result reproducible, because `max` returns the first of equal files.
    eligible = {file: entry for file, entry in sorted(files.items()) if entry[0] <= SIZE_LIMIT}
    features_of = {file: features for file, (_, features) in eligible.items()}
    everything = set().union(*features_of.values())
    chosen = []

    def take_best(candidates, wanted):
        left = [file for file in candidates if file not in chosen]
        chosen.append(max(left, key=lambda file: len(features_of[file] & wanted) / (FILE_COST + eligible[file][0])))

    wanted = set(everything)
    while wanted:
        take_best(eligible, wanted)
        wanted -= features_of[chosen[-1]]
    for file in sorted(chosen, key=lambda file: eligible[file][0], reverse=True):
        if features_of[file] <= set().union(*(features_of[other] for other in chosen if other != file)):
            chosen.remove(file)
    for folder, minimum in MINIMUM.items():
        in_folder = [file for file in eligible if file.startswith(folder + "/")]
        while len(set(in_folder) & set(chosen)) < min(minimum, len(in_folder)):
            take_best(in_folder, everything)

    reasons, wanted = {}, set(everything)
    for file in chosen:
        reasons[file] = features_of[file] & wanted
        wanted -= features_of[file]
    return reasons, set().union(*(features for _, features in files.values())) - everything


def main():
    arguments = argparse.ArgumentParser(description="Chooses the files of the corpus that the fast tests read.")
    arguments.add_argument("lexibus", metavar="LEXIBUS", help="the command-line program")
    mode = arguments.add_mutually_exclusive_group()
    mode.add_argument("--check", action="store_true", help="only check that the list is up to date")
    mode.add_argument("--explain", action="store_true", help="only print the features that each file was chosen for")
    arguments.add_argument("--jobs", type=int, default=2, help="number of files to read at once (default: 2)")
    options = arguments.parse_args()
    if not CORPUS.is_dir():
        print("no corpus in ../shared/corpus: the sample is unchanged", file=sys.stderr)
        return 0 if options.check else 1
    lexibus = shutil.which(options.lexibus)
    if lexibus is None:
        sys.exit(f"{options.lexibus} is not a program")

    codes = re.findall(r"^[A-Z]+\d+", subprocess.run([lexibus, "explain"], capture_output=True, text=True, check=True).stdout, re.M)
    warn = [argument for code in codes for argument in ("-W", code)]
    paths = sorted(path for folder in MINIMUM for path in (CORPUS / folder).iterdir() if path.name not in NOT_DESCRIPTIONS)
    with ThreadPoolExecutor(options.jobs) as pool:
        entries = pool.map(lambda path: features_of_file(lexibus, warn, path), paths)
        files = {f"{path.parent.name}/{path.name}": entry for path, entry in zip(paths, entries)}
    chosen, beyond_limit = choose_sample(files)

    if options.explain:
        for file, features in chosen.items():
            print(f"{file} ({files[file][0]} bytes)", *(f"    {kind} {name}" for kind, name in sorted(features)), sep="\n")
        print(f"only in files above {SIZE_LIMIT} bytes", *(f"    {kind} {name}" for kind, name in sorted(beyond_limit)), sep="\n")
        return 0
    text = "# Files of the corpus that the fast tests read. Written by tests/corpus-sample.py: do not edit.\n"
    text += "".join(file + "\n" for file in sorted(chosen))
    if options.check:
        if not LIST.is_file() or LIST.read_text(encoding="utf-8") != text:
            print("tests/corpus-sample.txt is stale: run tests/corpus-sample.py LEXIBUS", file=sys.stderr)
            return 1
        return 0
    LIST.write_bytes(text.encode())
    size = sum(files[file][0] for file in chosen)
    print(f"{len(chosen)} of {len(files)} files, {size / 1e6:.1f} MB of {sum(entry[0] for entry in files.values()) / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
