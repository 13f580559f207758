#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs a test in Python: python.sh NAME.py
exec python3 -B "$1"
