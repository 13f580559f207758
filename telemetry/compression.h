// SPDX-License-Identifier: BSD-3-Clause
// Compression of pages for clients that accept it, such as Prometheus. A page of metrics shrinks to a tenth or less. Not real-time.
#pragma once

#include <string>
#include <string_view>

namespace strainwave {

/// `text` in the gzip format (RFC 1952), compressed for speed, not size.
std::string gzip(std::string_view text);

/// Whether a request with this Accept-Encoding accepts gzip (RFC 9110, 12.5.3).
bool takes_gzip(std::string_view accept_encoding);

}  // namespace strainwave
