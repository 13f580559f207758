# SPDX-License-Identifier: BSD-3-Clause
"""Programs that run beside a test, in a folder of their own, until it ends."""
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
        """One of ours, or one of the system."""
        ours = self.programs / program
        self.running.append(subprocess.Popen([ours if ours.exists() else program, *words], stdout=subprocess.PIPE, text=True, cwd=self.folder,
                                             env=dict(os.environ, RUNTIME_DIRECTORY=self.temporary.name)))
        return self.running[-1]

    def __exit__(self, *_):
        for process in reversed(self.running):
            process.terminate()
            process.wait(timeout=20)
        self.temporary.cleanup()
