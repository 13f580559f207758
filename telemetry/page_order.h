// SPDX-License-Identifier: BSD-3-Clause
// Reads an order from the page. Its content may be arbitrary. Not real-time.
// The order is a text with "op": "act" and an "action":
//
//   open      token                                              required before all others except stop
//   stop                                                         disables every joint that is heard; needs no token
//   enable    joint, session_id, challenge
//   hold      joint, session_id, challenge                       also ends a jog
//   jog       joint, session_id, challenge, jog, velocity_rad_s  repeated while the button is held
//   jog-end   jog                                                the joint holds
//
// A joint is PREFIX.JOINT. 64-bit numbers are texts, as message_json.h writes them.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "client/protocol/open_orders.h"
#include "client/protocol/sender.h"

namespace strainwave {

/// Missing or invalid fields are empty.
struct PageOrder {
  std::string action;
  std::string token;
  std::optional<OpenOrders::Name> joint;
  std::optional<Quote> quote;
  std::optional<std::int64_t> jog;       ///< number of the jog, which increases
  std::optional<double> velocity_rad_s;  ///< joint side
};

PageOrder read_page_order(const nlohmann::json& order);

}  // namespace strainwave
