# SPDX-License-Identifier: BSD-3-Clause
"""Starts programs in a temporary folder and ends them with the test."""
import os
import pathlib
import subprocess
import sys
import tempfile


def expect(holds, what):
    if not holds:
        sys.exit(f'wrong: {what}')


class Beside:
    def __init__(self, programs):
        self.programs, self.running = pathlib.Path(programs).resolve(), []

    def __enter__(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        return self

    def start(self, program, *words):
        """Starts a program of ours or of the system."""
        ours = self.programs / program
        self.running.append(subprocess.Popen([ours if ours.exists() else program, *words], stdout=subprocess.PIPE, text=True, cwd=self.folder,
                                             env=dict(os.environ, RUNTIME_DIRECTORY=self.temporary.name)))
        return self.running[-1]

    def __exit__(self, *_):
        for process in reversed(self.running):
            process.terminate()
            process.wait(timeout=20)
        self.temporary.cleanup()
