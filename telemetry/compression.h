// SPDX-License-Identifier: BSD-3-Clause
// A page for clients that take it compressed, as Prometheus does: a page of metrics shrinks to a tenth or less. Not real-time.
#pragma once

#include <string>
#include <string_view>

namespace strainwave {

/// `text` as a file of gzip (RFC 1952), fast rather than small.
std::string gzip(std::string_view text);

/// Whether a request with this Accept-Encoding takes gzip (RFC 9110, 12.5.3).
bool takes_gzip(std::string_view accept_encoding);

}  // namespace strainwave
