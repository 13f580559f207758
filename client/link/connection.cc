#include "client/link/connection.h"

#include <cerrno>

#include "client/link/exit_status.h"
#include "lcmtypes/multicast_check.h"

namespace strainwave {

namespace {

/// The URL, once it is known that LCM can be opened on it: LCM's own messages would not say what to do.
const std::string& checked(const std::string& lcm_url) {
  if (const auto problem = find_multicast_problem(lcm_url)) {
    throw ClientError(ExitStatus::kNoAnswer, "LCM is not available on '" + lcm_url + "': " + *problem);
  }
  return lcm_url;
}

}  // namespace

Connection::Connection(const std::string& lcm_url) : url_(checked(lcm_url)), lcm_(lcm_url) {
  // The descriptor exists only once the receiving half is set up; without it subscribe() would fail unseen.
  if (!lcm_.good() || lcm_.getFileno() < 0) {
    throw ClientError(
        ExitStatus::kNoAnswer,
        "LCM is not available on '" + lcm_url +
            "': check the URL (--lcm-url, or LCM_DEFAULT_URL in the environment); the usual one is "
            "udpm://239.255.76.67:7667?ttl=0");
  }
}

void Connection::publish(const std::string& channel, std::span<const std::uint8_t> bytes) {
  if (lcm_.publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size())) != 0) {
    throw ClientError(ExitStatus::kNoAnswer,
                      "LCM did not take a message for " + channel + ": is the network of " + url_ + " up?");
  }
}

bool Connection::handle(int timeout_ms) {
  errno = 0;
  const int result = lcm_.handleTimeout(timeout_ms);
  if (result < 0 && errno != EINTR) {
    throw ClientError(ExitStatus::kNoAnswer, "LCM stopped working on " + url_);
  }
  return result > 0;
}

}  // namespace strainwave
