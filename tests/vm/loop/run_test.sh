#!/bin/bash
# One test program in virtual time: run_test.sh [NAME=VALUE...] ./PROGRAM [ARGUMENT...]
set -euo pipefail
exec env STRAINWAVE_VIRTUAL_TIME=1 "$@"
