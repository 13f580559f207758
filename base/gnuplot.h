// SPDX-License-Identifier: BSD-3-Clause
// The one place that runs gnuplot. Not real-time.
#pragma once

#include <string>

namespace strainwave {

/// Runs gnuplot on `script` and waits for it. Throws std::runtime_error: gnuplot cannot be run (and which package has it), or refuses
/// the script, with what it said.
void run_gnuplot(const std::string& script);

/// `text` as a string of gnuplot, in single quotes: nothing in it is a command. Control characters are left out.
std::string gnuplot_quoted(const std::string& text);

}  // namespace strainwave
