#!/usr/bin/env bash
# Installs the libraries that control the browser to target/browser. package-lock.json determines their versions. If the libraries
# are already installed, the script does nothing. The script fails if Chromium or Node is not installed.
set -euo pipefail
cd "$(dirname "$0")/../../.."
tests=cli/tests/browser
folder=target/browser

command -v "${CHROMIUM:-chromium}" >/dev/null
if ! cmp --silent "$tests/package-lock.json" "$folder/package-lock.json" || [[ ! -d $folder/node_modules ]]; then
    mkdir -p "$folder"
    cp "$tests/package.json" "$folder/"
    (cd "$folder" && cp "../../$tests/package-lock.json" . && npm ci --silent --no-audit --no-fund) ||
        { rm -f "$folder/package-lock.json"; exit 1; }
fi
(cd "$folder" && node -e 'require("playwright-core"); require("axe-core")')
