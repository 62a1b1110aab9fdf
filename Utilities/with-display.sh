#!/usr/bin/env bash
# with-display.sh COMMAND...: runs a command under a virtual X server of its own. The server picks
# its display number itself, so that any number may start at once (xvfb-run -a races), and it does
# not start over when its last window closes, while the next one may be opening (-noreset).
set -euo pipefail
coproc server { exec Xvfb -displayfd 1 -screen 0 1600x900x24 -nolisten tcp -noreset 2>/dev/null; }
trap 'kill "$server_PID" 2>/dev/null || true' EXIT
if ! read -r -t 60 number <&"${server[0]}"; then
  echo "with-display.sh: error: Xvfb does not start" >&2
  exit 1
fi
DISPLAY=:$number "$@"
