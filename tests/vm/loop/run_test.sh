#!/bin/bash
# One test program in virtual time: run_test.sh PROGRAM [ARGUMENT...]
set -euo pipefail
export STRAINWAVE_VIRTUAL_TIME=1
exec "./$1" "${@:2}"
