// SPDX-License-Identifier: BSD-3-Clause
// A flag for Ctrl-C, SIGTERM and the SIGHUP of a lost terminal. It lets a wait end in order: the program
// closes its files and informs the user. Not real-time.
#pragma once

namespace strainwave {

/// From now on SIGINT, SIGTERM and SIGHUP set the flag instead of ending the program. An ignored SIGHUP, as
/// under nohup, stays ignored. A second signal of the same kind ends the program at once.
void catch_interrupts();

/// True once a signal has arrived.
bool interrupted() noexcept;

/// Clears the flag, so that the program can wait for final steps, such as stopping a joint. A second signal of the same kind ends the program.
void resume_after_interrupt() noexcept;

}  // namespace strainwave
