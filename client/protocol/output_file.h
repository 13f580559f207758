// SPDX-License-Identifier: BSD-3-Clause
// Files that commands write. Not real-time.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/unique_fd.h"
#include "strainwave/client_error.h"

namespace strainwave {

/// Whether the name ends with `extension`, regardless of case. `extension` is lower case, with its dot.
inline bool is_named(const std::filesystem::path& file, std::string_view extension) {
  const std::string end = file.extension().string();
  return std::equal(end.begin(), end.end(), extension.begin(), extension.end(), [](char a, char b) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(a))) == b;
  });
}

/// Throws ClientError (usage) when `file` exists and `overwrite` is false.
inline void refuse_to_replace(const std::filesystem::path& file, bool overwrite) {
  if (!overwrite && std::filesystem::exists(file))
    throw ClientError(ExitStatus::kUsage,
                      file.string() + " exists: choose another name, or give --overwrite");
}

/// Opens or creates `file` for one writer: no other process can claim it while the descriptor is open. Throws
/// ClientError (usage) as above, for a folder, for an unwritable file, and while another process writes it.
/// The file is then unchanged.
UniqueFd claim_output(const std::filesystem::path& file, bool overwrite);

/// Throws ClientError (usage) when the name of a file contradicts its format, which is MCAP if `mcap`.
inline void refuse_name_of_mcap(const std::filesystem::path& file, bool mcap) {
  if (!mcap && is_named(file, ".mcap"))
    throw ClientError(ExitStatus::kUsage,
                      file.string() + " would not be an MCAP file: give --mcap, or choose another name");
  if (mcap && (is_named(file, ".lcm") || is_named(file, ".csv")))
    throw ClientError(ExitStatus::kUsage,
                      file.string() + " would be an MCAP file: leave --mcap out, or choose another name");
}

/// The error for a `file` that cannot be created or opened for writing.
inline ClientError not_writable(const std::filesystem::path& file) {
  return {ExitStatus::kUsage,
          file.string() + " cannot be written: check that its folder exists and that you may write to it"};
}

}  // namespace strainwave
