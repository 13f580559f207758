// The client's LCM handle: subscriptions, publishing, waiting. Knows bytes and channels, not messages. One
// thread. Not real-time.
#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <span>
#include <string>

namespace strainwave {

/// Ends a subscription with its owner. Must not outlive the connection.
class Subscription {
 public:
  Subscription(lcm::LCM& lcm, lcm::Subscription* handle) : lcm_(&lcm), handle_(handle) {}
  ~Subscription() { lcm_->unsubscribe(handle_); }
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;

 private:
  lcm::LCM* lcm_;
  lcm::Subscription* handle_;
};

class Connection {
 public:
  /// Messages that may wait for one subscription until handle() is called.
  static constexpr int kQueueCapacity = 4096;

  /// Opens LCM. Throws ClientError (LCM unavailable) that says what to do.
  explicit Connection(const std::string& lcm_url);

  const std::string& url() const noexcept { return url_; }

  /// Calls `method` of `handler` from handle() for each message whose channel matches `pattern` as a whole (a
  /// regular expression), as long as the returned object lives. The handler must not throw: the call comes
  /// through C.
  template <typename Handler>
  [[nodiscard]] Subscription subscribe(const std::string& pattern,
                                       void (Handler::*method)(const lcm::ReceiveBuffer* buffer,
                                                               const std::string& channel),
                                       Handler* handler) {
    lcm::Subscription* const subscription = lcm_.subscribe(pattern, method, handler);
    subscription->setQueueCapacity(kQueueCapacity);
    return {lcm_, subscription};
  }

  /// Throws ClientError when LCM does not take the message.
  void publish(const std::string& channel, std::span<const std::uint8_t> bytes);

  /// Waits up to `timeout_ms` for one message and dispatches it. False: none came, or a signal did.
  bool handle(int timeout_ms);

 private:
  std::string url_;
  lcm::LCM lcm_;
};

/// The bytes of a received message.
inline std::span<const std::uint8_t> payload(const lcm::ReceiveBuffer& buffer) {
  return {static_cast<const std::uint8_t*>(buffer.data), buffer.data_size};
}

}  // namespace strainwave
