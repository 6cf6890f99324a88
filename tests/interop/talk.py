"""Communication between these scripts and a test. Each command and each answer is one line of JSON.

A script ends when its standard input is closed. The input is closed at the end of the test, even after a failure.
"""

import json
import sys


def say(answer):
    print(json.dumps(answer), flush=True)


def serve(commands, ready=True):
    """Executes commands until the end of the input. `{"do": NAME, ARGUMENT: …}` calls the function `commands[NAME]`. `ready` is sent
    to the test first."""
    say({"ready": ready})
    for line in sys.stdin:
        command = json.loads(line)
        try:
            say({"ok": commands[command.pop("do")](**command)})
        except Exception as error:  # The test reports the error.
            say({"error": f"{type(error).__name__}: {error}"})
