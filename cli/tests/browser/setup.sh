#!/usr/bin/env bash
# Puts what the tests in this folder steer a browser with into target/browser, in the versions that package-lock.json pins.
# Does nothing where it is there already. Fails where there is no Chromium or no Node that it could steer one with.
set -euo pipefail
cd "$(dirname "$0")/../../.."
own=cli/tests/browser
place=target/browser

command -v "${CHROMIUM:-chromium}" >/dev/null
if ! cmp --silent "$own/package-lock.json" "$place/package-lock.json" || [[ ! -d $place/node_modules ]]; then
    mkdir -p "$place"
    cp "$own/package.json" "$place/"
    (cd "$place" && cp "../../$own/package-lock.json" . && npm ci --silent --no-audit --no-fund) ||
        { rm -f "$place/package-lock.json"; exit 1; }
fi
(cd "$place" && node -e 'require("playwright-core"); require("axe-core")')
