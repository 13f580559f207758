// Ctrl-C and SIGTERM as a flag, so that a wait ends in order: files closed, the user told what goes on. Not real-time.
#pragma once

namespace strainwave {

/// From now on SIGINT and SIGTERM set the flag instead of ending the program. A second one ends it at once.
void catch_interrupts();

/// True once a signal has come.
bool interrupted() noexcept;

/// Forgets the signal, so that what is left to do (stopping a joint) can be waited for. The next one ends the program.
void resume_after_interrupt() noexcept;

}  // namespace strainwave
