# SPDX-License-Identifier: BSD-3-Clause
"""Helpers of the page tests: the browser, the addresses of the page, and the daemon."""
import json
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from beside import expect


class Page:
    """The browser process, which answers a line of words with one line of JSON."""

    def __init__(self, packages, script, *words):
        self.process = subprocess.Popen(['node', script, *words], cwd=packages, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __call__(self, *words):
        self.process.stdin.write(' '.join(words) + '\n')
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        expect(line, f'no answer to {words}')
        return json.loads(line)

    def terminate(self):
        self.process.stdin.close()

    def wait(self, timeout):
        self.process.wait(timeout)


def need_chromium():
    if not shutil.which('chromium'):
        print('chromium is missing: scripts/deps package-tests', file=sys.stderr)
        sys.exit(77)


def addresses(telemetry, count=1):
    """Returns the addresses that strainwave-telemetry prints: the page, and with `count` 2 the page with the token."""
    lines = [telemetry.stdout.readline() for _ in range(2 + count)]
    return [line.split()[-1] for line in lines[2:]]


def wait_for_daemon(ctl):
    for _ in range(50):
        if subprocess.run([ctl, 'status', '--timeout_s', '0.5'], capture_output=True).returncode == 0:
            return
    expect(False, 'no state of the daemon')
