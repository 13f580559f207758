// SPDX-License-Identifier: BSD-3-Clause
// A flag for Ctrl-C, SIGTERM and the SIGHUP of a lost terminal. With it a wait ends in order: files are closed, and the user is informed.
// Not real-time.
#pragma once

namespace strainwave {

/// From now on SIGINT, SIGTERM and SIGHUP set the flag instead of ending the program; one that is ignored, as below nohup, stays so. The
/// same one again ends it at once.
void catch_interrupts();

/// True once a signal has come.
bool interrupted() noexcept;

/// Forgets the signal, so that what is left to do (stopping a joint) can be waited for. The next one ends the program.
void resume_after_interrupt() noexcept;

}  // namespace strainwave
