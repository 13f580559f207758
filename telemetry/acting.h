// SPDX-License-Identifier: BSD-3-Clause
// Orders from the page to joints, where an operator's key is configured: signed here, and judged by the daemon as those of every client.
// Each order quotes the challenge of the state that the page shows, so the daemon refuses one that comes late. Not real-time.
// The page is answered by texts with "op": "acting" (to open: open, jog_speed_share) or "acted" (text, refused).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <strainwave/setpoint_v1.hpp>
#include <string>

#include "client/protocol/open_orders.h"
#include "client/protocol/sender.h"
#include "telemetry/fleet.h"
#include "telemetry/jog_motion.h"
#include "telemetry/page_order.h"

namespace strainwave {

class Acting {
 public:
  /// A connection to the page, and whether its browser names this server as the origin of the page.
  struct Page {
    std::uint64_t number = 0;
    bool is_own = false;
  };
  using Say = std::function<void(std::uint64_t page, std::string text)>;

  /// A jog goes at this share of the joint's speed limit at most: the tenth that drives' manuals call a jog.
  static constexpr double kJogSpeedShare = 0.1;
  /// A jog lasts so long after the page's last word, of which three (acting.js) may be lost, and after the last tick().
  static constexpr double kJogLasts_s = 0.3;
  /// Between two samples of a jog; call tick() as often.
  static constexpr double kTick_s = 0.02;

  /// `fleet` outlives this. `say` sends a text to a page, if it is still there. Throws InputError: the key cannot be used, or is not an operator's.
  Acting(const std::filesystem::path& key_file, const Fleet& fleet, PendingOrder::Publish publish, Say say);

  /// What a page must show before it may move anything: made anew at each start.
  const std::string& token() const noexcept { return token_; }

  /// One order of a page. `now_s`: any steady clock.
  void take(const Page& page, const PageOrder& order, double now_s);
  /// The page is gone: what it jogs holds.
  void forget(std::uint64_t page);
  /// The answer of a daemon to any client.
  void take(const ChannelName& name, const ack_v1& ack);
  void tick(double now_s);

 private:
  using Name = OpenOrders::Name;
  struct Jog {
    std::uint64_t page = 0;
    std::int64_t number = 0;
    Quote quote;
    double wanted_rad_s = 0.0;
    double renewed_s = 0.0;
    double stepped_s = 0.0;
    JogMotion motion;
    std::int64_t stream_id = 0;
    std::int64_t first_sequence = 0;
    bool begun = false;  ///< the daemon has accepted its first sample
  };
  using Jogs = std::map<Name, Jog>;

  void obey(const Page& page, const PageOrder& order, double now_s);
  void open(const Page& page, const PageOrder& order);
  /// Of every joint that is heard or jogged, and the end of every jog. One stop of a joint waits for its answer: stops need no token, and
  /// may come by the thousand.
  void stop(const Page& page);
  void command(std::uint64_t page, const Name& joint, Action action, const Quote& quote);
  void jog(std::uint64_t page, const PageOrder& order, double now_s);
  void begin_jog(const Name& joint, Jog jog);
  static setpoint_v1 sample(const Jog& jog);
  /// The joint holds, and the page is sent `why`, if anything.
  void end_jog(Jogs::iterator jog, const std::string& why);
  void answer(std::uint64_t page, const std::string& text, bool refused);

  const Fleet& fleet_;
  PendingOrder::Publish publish_;
  Say say_;
  Sender sender_;
  OpenOrders orders_;
  std::string token_;
  std::set<std::uint64_t> open_;                     ///< pages that showed the token
  std::map<std::uint64_t, std::int64_t> last_jogs_;  ///< by page, the number of the last jog that it began
  Jogs jogs_;
};

}  // namespace strainwave
