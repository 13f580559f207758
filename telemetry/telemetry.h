// SPDX-License-Identifier: BSD-3-Clause
// Connects LCM to viewers and metrics: the program without its command line. Not real-time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "telemetry/acting.h"
#include "telemetry/fleet.h"
#include "telemetry/lcm_listener.h"
#include "telemetry/server/server.h"
#include "telemetry/topics.h"

namespace strainwave {

class Telemetry {
 public:
  /// Throws InputError or std::runtime_error that name the remedy. `key_file`: an operator's key for orders
  /// from the page; empty: nothing is sent on LCM.
  Telemetry(const std::string& lcm_url, const ListenAddress& address, AccessRules rules,
            const std::filesystem::path& key_file);

  std::uint16_t port() const { return server_.port(); }
  /// The token for orders from the page. Empty: the page may not give any.
  std::string token() const { return acting_ ? acting_->token() : ""; }
  /// Runs until SIGINT or SIGTERM.
  void run();

 private:
  void take(const LcmSource& from, std::string_view channel, std::span<const std::uint8_t> bytes);
  /// Null if too many new topics came at once.
  template <typename Message>
  const Topic* topic_of(const std::string& channel, const LcmSource& from);
  /// The page of metrics, shared by concurrent requests. `packed`: compressed with gzip.
  SharedText metrics(bool packed);
  std::string expose();

  LcmListener listener_;
  Topics topics_;
  Fleet fleet_;
  std::uint64_t heard_ = 0;
  std::uint64_t not_ours_ = 0;
  SharedText page_;         ///< the latest page of metrics
  SharedText packed_page_;  ///< the same, compressed; null: not requested yet
  double page_made_s_ = 0.0;
  std::unique_ptr<Acting> acting_;
  TelemetryServer server_;  ///< the last member, because its viewers use `acting_`
};

}  // namespace strainwave
