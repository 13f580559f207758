// SPDX-License-Identifier: BSD-3-Clause
// The one place that runs gnuplot. Not real-time.
#pragma once

#include <string>

namespace strainwave {

/// Runs gnuplot on `script` and waits for its end. Throws std::runtime_error if gnuplot cannot start, with the package to install.
/// Also throws if gnuplot refuses the script, with its output.
void run_gnuplot(const std::string& script);

/// `text` as a gnuplot string in single quotes, in which gnuplot interprets nothing. Control characters are left out.
std::string gnuplot_quoted(const std::string& text);

}  // namespace strainwave
