// SPDX-License-Identifier: BSD-3-Clause
#include "client/joint/joint_link.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdlib>

#include "base/input_error.h"
#include "client/protocol/key_file.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/multicast_check.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

constexpr auto kListenEvery = std::chrono::milliseconds(10);

std::string environment(const char* name) {
  const char* const value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing here changes it
  return value != nullptr ? value : "";
}

std::string url_of(const JointOptions& options) {
  if (!options.lcm_url.empty()) return options.lcm_url;
  const std::string url = environment("LCM_DEFAULT_URL");
  return url.empty() ? std::string(kUsualLcmUrl) : url;
}

/// The file of the key, after a check that it is readable. Empty: no key.
std::filesystem::path key_of(const JointOptions& options) {
  std::string file = options.key ? options.key->string() : environment("STRAINWAVE_KEY");
  if (file.starts_with("~/")) file = environment("HOME") + file.substr(1);
  try {
    if (!file.empty()) (void)read_secret_key(file);
  } catch (const InputError& error) {
    throw InvalidInput(error.what());
  }
  return file;
}

std::string checked_name(const std::string& what, const std::string& name) {
  if (!is_valid_name(name))
    throw InvalidInput(
        fmt::format("{} = '{}': 1 to 24 characters of A-Z a-z 0-9 _ - are allowed, not - first", what, name));
  return name;
}

ClientOptions client_options(const std::string& name, const JointOptions& options) {
  const double timeout_s = checked_number(name, "timeout_s", options.timeout_s, "0.1 to 3600",
                                          options.timeout_s >= 0.1 && options.timeout_s <= 3600.0);
  return {checked_name("prefix", options.prefix), timeout_s, key_of(options)};
}

}  // namespace

double checked_number(const std::string& joint, const std::string& name, double value,
                      const std::string& allowed, bool is_allowed, const std::string& key) {
  if (!std::isfinite(value) || !is_allowed)
    throw InvalidInput(fmt::format("{0}: {1} = {2}: {3} is allowed{4}", joint, name, value, allowed,
                                   key.empty() ? "" : fmt::format(" ({} of {})", key, joint)),
                       joint);
  return value;
}

void require_same_daemon(JointLink& joint, JointLink& other, const std::string& who) {
  const std::string &prefix = joint.client().options().prefix, &url = joint.connection().url();
  const std::string &others_prefix = other.client().options().prefix, &others_url = other.connection().url();
  if (prefix != others_prefix)
    throw InvalidInput(fmt::format("{} has prefix {}, {} has {}: {} must belong to one daemon", joint.name(),
                                   prefix, other.name(), others_prefix, who));
  if (url != others_url)
    throw InvalidInput(fmt::format("{} is on {}, {} on {}: {} must belong to one daemon", joint.name(), url,
                                   other.name(), others_url, who));
}

JointLink::JointLink(const std::string& name, const JointOptions& options)
    : name_(checked_name("name", name)),
      connection_(url_of(options)),
      client_(connection_, client_options(name, options)),
      limits_(client_, {name}),
      states_(connection_.subscribe(options.prefix + "\\." + name + "\\." + std::string(channel_kind::kState),
                                    &JointLink::on_state, this)),
      listener_([this](const std::stop_token& end) { listen(end); }) {}

const JointView& JointLink::view() {
  client_.catch_up();
  const JointView& view = client_.wait_for_joint(name_);
  const double silent_s = seconds_between(view.received, now());
  if (silent_s > client_.options().timeout_s)
    throw NoAnswer(fmt::format("{}: no state for {:.1f} s; is strainwaved running?", name_, silent_s));
  return view;
}

std::string JointLink::silence(const std::string& what) const {
  const JointView* const view = client_.find(name_);
  const std::string since = view != nullptr ? silence_of(*view, client_.options().timeout_s) : "";
  return name_ + ": " + what + (since.empty() ? "" : ": " + since);
}

const limits_v1& JointLink::limits() {
  (void)view();
  return limits_.wait_for(name_);
}

void JointLink::on_state(const ReceivedMessage& message) {
  const auto state = decode_exactly<state_v1>(message.bytes);
  if (!state || !is_believable(*state)) return;
  if (state->session_id != session_id_) {
    clock_.restart();
    session_id_ = state->session_id;
  }
  clock_.take(state->cycle, now());
  for (Inbox* inbox : inboxes_) {
    if (inbox->size() == kInbox) inbox->pop_front();
    inbox->emplace_back(*state, now());
  }
}

void JointLink::listen(const std::stop_token& end) {
  std::mutex sleeping;
  std::condition_variable_any never;
  std::unique_lock asleep(sleeping);
  while (!never.wait_for(asleep, end, kListenEvery, [&] { return end.stop_requested(); })) {
    const auto held = lock();
    try {
      client_.catch_up();
    } catch (const ClientError&) {
      // The next call of the user reports the error.
    }
  }
}

}  // namespace strainwave
