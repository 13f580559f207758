// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 of a text, in hex: the fingerprint of the data behind a result. Offline.
#pragma once

#include <string>
#include <string_view>

namespace strainwave {

std::string sha256_hex(std::string_view text);

}  // namespace strainwave
