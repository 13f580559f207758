// Runs a program of ours that is installed beside this one. Not real-time.
#pragma once

#include <string>
#include <vector>

namespace strainwave {

/// Runs `name` with `arguments`, its output going where ours goes, and returns its exit status, 128 + n after
/// signal n. Throws ClientError (file) when it is not there.
int run_sibling(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace strainwave
