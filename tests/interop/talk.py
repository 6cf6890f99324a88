"""How the scripts of this folder talk to the test: a line of JSON is a command, a line of JSON is its answer.

The script ends when the test closes its standard input, which happens however the test ends.
"""

import json
import sys


def say(answer):
    print(json.dumps(answer), flush=True)


def serve(commands, ready=True):
    """Runs commands until there are no more: `{"do": NAME, ARGUMENT: …}` calls the function `commands[NAME]`. What the test
    has to know beforehand is `ready`."""
    say({"ready": ready})
    for line in sys.stdin:
        command = json.loads(line)
        try:
            say({"ok": commands[command.pop("do")](**command)})
        except Exception as error:  # The test shows it.
            say({"error": f"{type(error).__name__}: {error}"})
