// SPDX-License-Identifier: BSD-3-Clause
// The data that all connections of the server share. Not real-time.
#pragma once

#include <utility>  // Boost 1.74's asio needs it, but does not include it

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <functional>
#include <list>
#include <memory>
#include <set>
#include <string>

#include "telemetry/server/server.h"
#include "telemetry/web_page.h"

namespace strainwave {

class OpeningConnection;
class ViewerConnection;

struct ServerShared {
  AccessRules rules;
  const Topics& topics;
  std::function<SharedText(bool packed)> metrics;
  Acting* acting = nullptr;  ///< null: orders are not taken
  const WebPage page;
  std::string session;  ///< distinguishes one start of the server from the next
  std::list<std::weak_ptr<OpeningConnection>> opening;  ///< oldest first
  std::set<std::shared_ptr<ViewerConnection>> viewers;
  std::uint64_t viewers_so_far = 0;
  std::uint64_t refused = 0;
  std::uint64_t dropped_before = 0;  ///< messages that earlier viewers missed
};

}  // namespace strainwave
