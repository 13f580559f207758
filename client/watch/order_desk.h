// Orders from the watch screen, to joints of any daemon: sent, repeated and answered while the screen goes
// on. Not real-time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/link/client.h"

namespace strainwave {

class OrderDesk {
 public:
  /// `timeout_s`: how long an order is repeated before its silence is reported.
  OrderDesk(Connection& connection, const std::filesystem::path& key_file, double timeout_s);

  /// A disable: unsigned and for any session, so that nothing can be wrong with it.
  void stop(const std::string& prefix, const std::string& joint);
  /// Signed. Throws InputError when the key cannot be used.
  void order(const std::string& prefix, const std::string& joint, std::int64_t session_id, Action action);

  /// Repeats what was not answered. Call often.
  void tick();

  /// What there is to say, the latest: "SW.elbow: enable accepted".
  const std::string& message() const noexcept { return message_; }
  bool alarm() const noexcept { return alarm_; }

 private:
  struct Waiting {
    SealedMessage order;
    std::string ack_channel;
    std::string what;
    Instant sent;
    int transmissions = 0;
  };
  void post(const std::string& prefix, const std::string& joint, SealedMessage order, Action action);
  void transmit(Waiting& waiting);
  void say(const std::string& message, bool alarm);
  void on_ack(const lcm::ReceiveBuffer* buffer, const std::string& channel);

  Connection& connection_;
  Sender sender_;
  double repeat_s_;
  std::vector<Waiting> waiting_;
  std::string message_;
  bool alarm_ = false;
  Subscription acknowledgements_;
};

}  // namespace strainwave
