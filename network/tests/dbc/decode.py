"""Decodes frames with `cantools`, and compares the physical values. Arguments: folders that contain `network.dbc` and `frames.txt`, whose
lines contain the CAN-ID, the data in hexadecimal, and the expected values in the order of the frame, separated by `;`. Prints one line of
JSON per folder: the number of signals that were compared, and the first differences."""

import json
import math
import os
import sys

import cantools

EXTENDED = 1 << 29


def is_equal(expected, value):
    """Compares an expected value, as a text, with a decoded one."""
    if isinstance(value, float):
        expected = float(expected)
        return math.isnan(expected) and math.isnan(value) or math.isclose(expected, value, rel_tol=1e-12)
    return float(expected) == value if "." in expected or "e" in expected else int(expected) == value


for folder in sys.argv[1:]:
    database = cantools.database.load_file(os.path.join(folder, "network.dbc"))
    messages = {message.frame_id | (EXTENDED if message.is_extended_frame else 0): message for message in database.messages}
    compared, differences = 0, []
    for line in open(os.path.join(folder, "frames.txt")):
        can_id, data, *expected = line.strip().split(";")
        message = messages[int(can_id)]
        decoded = message.decode(bytes.fromhex(data), decode_choices=False)
        signals = sorted(message.signals, key=lambda signal: signal.start)
        if len(signals) != len(expected):
            differences.append(f"{message.name} has {len(signals)} signals instead of {len(expected)}")
            continue
        for signal, value in zip(signals, expected):
            compared += 1
            if not is_equal(value, decoded[signal.name]):
                differences.append(f"{message.name}.{signal.name}: {decoded[signal.name]!r} instead of {value}, data {data}")
    print(json.dumps({"compared": compared, "differences": differences[:10]}))
