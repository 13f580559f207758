// SPDX-License-Identifier: BSD-3-Clause
// Orders from the page to joints, with an operator's key. They are signed here, and the daemon judges them like those of
// any client. Each order quotes the challenge of the state on the page, so the daemon refuses late ones. Not real-time.
// The page receives answers with "op": "acting" (reply to open: open, jog_speed_share) or "acted" (text, refused).
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
  /// A connection to the page. is_own: its browser names this server as the origin of the page.
  struct Page {
    std::uint64_t number = 0;
    bool is_own = false;
  };
  using Say = std::function<void(std::uint64_t page, std::string text)>;

  /// Largest speed of a jog, as a share of the joint's speed limit. A tenth is usual in manuals of drives.
  static constexpr double kJogSpeedShare = 0.1;
  /// A jog ends this long after the page's last message or the last tick(). Three messages in a row may get lost (acting.js).
  static constexpr double kJogLasts_s = 0.3;
  /// Time between two samples of a jog; call tick() at this interval.
  static constexpr double kTick_s = 0.02;

  /// `fleet` must outlive this object. `say` sends a text to an open page. Throws InputError if the key is unusable or not an operator's.
  Acting(const std::filesystem::path& key_file, const Fleet& fleet, PendingOrder::Publish publish, Say say);

  /// The token that a page must show before it may move a joint. Each start makes a new one.
  const std::string& token() const noexcept { return token_; }

  /// Takes one order of a page. `now_s`: any steady clock.
  void take(const Page& page, const PageOrder& order, double now_s);
  /// The page has closed. The joints that it jogs hold.
  void forget(std::uint64_t page);
  /// Takes an answer of a daemon to any client.
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
  /// Stops every joint that is heard or jogged, and ends every jog. Only one stop per joint waits for its
  /// answer, because stops need no token and may arrive by the thousand.
  void stop(const Page& page);
  void command(std::uint64_t page, const Name& joint, Action action, const Quote& quote);
  void jog(std::uint64_t page, const PageOrder& order, double now_s);
  void begin_jog(const Name& joint, Jog jog);
  static setpoint_v1 sample(const Jog& jog);
  /// Holds the joint, and sends `why` to the page if it is not empty.
  void end_jog(Jogs::iterator jog, const std::string& why);
  void answer(std::uint64_t page, const std::string& text, bool refused);

  const Fleet& fleet_;
  PendingOrder::Publish publish_;
  Say say_;
  Sender sender_;
  OpenOrders orders_;
  std::string token_;
  std::set<std::uint64_t> open_;                     ///< pages that have shown the token
  std::map<std::uint64_t, std::int64_t> last_jogs_;  ///< by page: the number of the last jog that it began
  Jogs jogs_;
};

}  // namespace strainwave
