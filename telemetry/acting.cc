// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/acting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <system_error>

#include "base/input_error.h"
#include "base/printable.h"
#include "client/protocol/key_file.h"
#include "client/protocol/orders.h"
#include "lcmtypes/channels.h"
#include "telemetry/access.h"

namespace strainwave {

namespace {

using Json = nlohmann::json;

constexpr double kAnswer_s = 2.0;  // time-out of an order's repetitions, as in strainwavectl

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "getrandom");
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

void require_operator(const std::filesystem::path& key_file) {
  try {
    if (read_secret_key(key_file).role != Role::kOperator)
      throw InputError(key_file.string() +
                       ": is an engineer's key, and the page accepts only an operator's (strainwavectl "
                       "keygen --role operator)");
  } catch (const InputError& error) {
    throw InputError(std::string("--key: ") + error.what());
  }
}

}  // namespace

Acting::Acting(const std::filesystem::path& key_file, const Fleet& fleet, PendingOrder::Publish publish,
               Say say)
    : fleet_(fleet),
      publish_(std::move(publish)),
      say_(std::move(say)),
      sender_(key_file, "strainwave-telemetry"),
      orders_(publish_, sender_),
      token_(random_token()) {
  require_operator(key_file);
}

void Acting::take(const Page& page, const PageOrder& order, double now_s) {
  try {
    obey(page, order, now_s);
  } catch (const InputError& error) {  // the key file is gone
    answer(page.number, error.what(), true);
  }
}

void Acting::obey(const Page& page, const PageOrder& order, double now_s) {
  if (!page.is_own)
    return answer(page.number, "only the page of this server, opened at its own address, may send commands",
                  true);
  if (order.action == "open") return open(page, order);
  if (order.action == "stop") return stop(page);
  if (!open_.contains(page.number))
    return answer(page.number, "this page has no token: open the address that strainwave-telemetry printed",
                  true);
  if (order.action == "jog-end") {
    const auto mine = std::find_if(jogs_.begin(), jogs_.end(), [&](const auto& entry) {
      return entry.second.page == page.number && order.jog == entry.second.number;
    });
    if (mine != jogs_.end()) end_jog(mine, "");
    return;
  }
  if (!order.joint || !order.quote)
    return answer(page.number, "a command must name its joint, and the session_id and challenge of its state",
                  true);
  if (order.action == "enable") return command(page.number, *order.joint, Action::kEnable, *order.quote);
  if (order.action == "hold") return command(page.number, *order.joint, Action::kHold, *order.quote);
  if (order.action == "jog") return jog(page.number, order, now_s);
  answer(page.number, "the page may send only open, stop, enable, hold, jog and jog-end", true);
}

void Acting::open(const Page& page, const PageOrder& order) {
  const bool right = equal_in_constant_time(order.token, token_);
  if (right) open_.insert(page.number);
  say_(page.number, Json{{"op", "acting"}, {"open", right}, {"jog_speed_share", kJogSpeedShare}}.dump());
}

void Acting::stop(const Page& page) {
  struct Count {
    std::size_t joints = 0;
    std::size_t answered = 0;
    std::size_t accepted = 0;
    std::string failures;
  };
  std::map<Name, Quote> joints;
  for (const auto& [joint, record] : fleet_.joints()) joints.emplace(joint, quote_of(record.state));
  for (const auto& [joint, jog] : jogs_) joints.emplace(joint, jog.quote);
  jogs_.clear();
  if (joints.empty())
    return answer(page.number, "stop sent to 0 joints: none is heard; use the emergency stop", true);
  const auto count = std::make_shared<Count>(Count{joints.size(), 0, 0, {}});
  answer(page.number, fmt::format("stop sent to {}", counted(joints.size(), "joint")), false);
  for (const auto& [joint, quote] : joints) {
    const auto seal = [this, to = channel(joint.first, joint.second, channel_kind::kCommand), quote = quote] {
      return sender_.seal_stop(to, command_message(Action::kDisable), quote);
    };
    orders_.withdraw(joint);
    orders_.post(joint, seal, PendingOrder::stop_patience(kAnswer_s),
                 [this, count, joint = joint, number = page.number](const Answer* result) {
                   ++count->answered;
                   if (result != nullptr && result->accepted)
                     ++count->accepted;
                   else
                     count->failures += fmt::format("; {}: {}", full_name(joint), why_not(result));
                   if (count->answered == count->joints)
                     answer(number,
                            fmt::format("stop: {} of {} accepted{}", count->accepted,
                                        counted(count->joints, "joint"), count->failures),
                            !count->failures.empty());
                 });
  }
}

void Acting::command(std::uint64_t page, const Name& joint, Action action, const Quote& quote) {
  const bool stops = action == Action::kHold;
  if (stops) jogs_.erase(joint);
  const auto seal = [this, stops, quote, message = command_message(action),
                     to = channel(joint.first, joint.second, channel_kind::kCommand)] {
    return stops ? sender_.seal_stop(to, message, quote) : sender_.seal(to, message, quote);
  };
  const Patience patience =
      stops ? PendingOrder::stop_patience(kAnswer_s) : PendingOrder::patience(sizeof(command_v1), kAnswer_s);
  orders_.post(joint, seal, patience, [this, page, joint, action](const Answer* result) {
    const bool accepted = result != nullptr && result->accepted;
    answer(page,
           fmt::format("{}: {}{}", full_name(joint), to_text(action),
                       accepted ? " accepted" : ": " + why_not(result)),
           !accepted);
  });
}

void Acting::jog(std::uint64_t page, const PageOrder& order, double now_s) {
  const Name& joint = *order.joint;
  const auto refuse = [&](const std::string& why) {
    answer(page, full_name(joint) + ": jog: refused, " + why, true);
  };
  if (!order.jog || !order.velocity_rad_s) return refuse("the jog has no number or no velocity");
  if (const auto mine = jogs_.find(joint);
      mine != jogs_.end() && mine->second.page == page && mine->second.number == *order.jog) {
    mine->second.quote = *order.quote;
    mine->second.wanted_rad_s = *order.velocity_rad_s;
    mine->second.renewed_s = now_s;
    return;
  }
  // A message that arrives after the end of its jog, however late, must not begin a new one.
  if (*order.jog <= last_jogs_[page]) return;
  last_jogs_[page] = *order.jog;
  if (jogs_.contains(joint)) return refuse("another page jogs this joint");
  const auto record = fleet_.joints().find(joint);
  if (record == fleet_.joints().end() || !record->second.limits)
    return refuse("the joint's state and limits have not come yet");
  const std::int64_t session_id = record->second.limits->session_id;
  if (session_id != record->second.state.session_id || session_id != order.quote->session_id)
    return refuse("the joint's limits are of another session of the daemon");
  const limits_v1& limits = *record->second.limits;
  const JogLimits allowed{limits.position_min_rad, limits.position_max_rad,
                          kJogSpeedShare * limits.speed_limit_rad_s,
                          std::fmin(limits.acceleration_rad_s2, limits.deceleration_rad_s2)};
  if (!(allowed.position_min_rad <= allowed.position_max_rad && allowed.speed_rad_s > 0.0 &&
        allowed.acceleration_rad_s2 > 0.0))
    return refuse("the joint's limits are invalid");
  const state_v1& state = record->second.state;
  const double position_rad =
      std::isfinite(state.link_position_rad) ? state.link_position_rad : state.joint_position_rad;
  begin_jog(joint, {page, *order.jog, *order.quote, *order.velocity_rad_s, now_s, now_s,
                    JogMotion(position_rad, allowed)});
}

void Acting::begin_jog(const Name& joint, Jog jog) {
  jog.stream_id = sender_.new_stream();
  jog.first_sequence = jog.stream_id;
  setpoint_v1 message = sample(jog);
  message.begins_stream = 1;
  message.acknowledge = 1;
  const std::int64_t stream_id = jog.stream_id;
  jogs_.emplace(joint, jog);
  const auto seal = [this, message, quote = jog.quote,
                     to = channel(joint.first, joint.second, channel_kind::kSetpoint)] {
    return sender_.seal(to, message, quote);
  };
  orders_.post(joint, seal, PendingOrder::patience(sizeof message, kAnswer_s),
               [this, joint, stream_id, page = jog.page](const Answer* result) {
                 const auto mine = jogs_.find(joint);
                 const bool current = mine != jogs_.end() && mine->second.stream_id == stream_id;
                 if (result != nullptr && result->accepted) {
                   if (current) mine->second.begun = true;
                   return;
                 }
                 if (current) jogs_.erase(mine);
                 answer(page, full_name(joint) + ": jog: " + why_not(result), true);
               });
}

setpoint_v1 Acting::sample(const Jog& jog) {
  setpoint_v1 message{};
  message.stream_id = jog.stream_id;
  message.position_rad = jog.motion.position_rad();
  message.velocity_rad_s = jog.motion.velocity_rad_s();
  message.derivatives = 1;
  message.valid_for_s = kJogLasts_s;
  return message;
}

void Acting::end_jog(Jogs::iterator jog, const std::string& why) {
  const Name joint = jog->first;
  const Jog ended = jog->second;
  command(ended.page, joint, Action::kHold, ended.quote);
  if (!why.empty()) answer(ended.page, full_name(joint) + ": jog ended: " + why, true);
}

void Acting::forget(std::uint64_t page) {
  for (auto next = jogs_.begin(); next != jogs_.end();) {
    const auto jog = next++;
    if (jog->second.page == page) end_jog(jog, "");
  }
  open_.erase(page);
  last_jogs_.erase(page);
}

void Acting::take(const ChannelName& name, const ack_v1& ack) {
  orders_.take(channel(name.prefix, name.joint, name.kind), ack);
  const auto jog = jogs_.find({name.prefix, name.joint});
  const bool of_sample = jog != jogs_.end() && jog->second.begun && ack.accepted != 1 &&
                         ack.sender_id == sender_.sender_id() && ack.sequence > jog->second.first_sequence;
  // A sample that a later one has overtaken is no loss.
  if (!of_sample || static_cast<Reason>(ack.reason) == Reason::kOldSequence) return;
  // Sends no hold: the stream is over, and the joint may now follow another client.
  const Answer refusal = to_answer(ack);
  answer(jog->second.page, full_name(jog->first) + ": jog ended: " + why_not(&refusal), true);
  jogs_.erase(jog);
}

void Acting::tick(double now_s) {
  orders_.tick();
  for (auto next = jogs_.begin(); next != jogs_.end();) {
    const auto current = next++;
    Jog& jog = current->second;
    if (now_s - std::min(jog.renewed_s, jog.stepped_s) > kJogLasts_s) {
      end_jog(current, "the page, or this program, was silent");
      continue;
    }
    // After a pause the jog does not catch up.
    const double step_s = std::min(now_s - std::exchange(jog.stepped_s, now_s), 2.0 * kTick_s);
    if (!jog.begun) continue;
    jog.motion.step(jog.wanted_rad_s, step_s);
    const SealedMessage sealed =
        sender_.seal(channel(current->first.first, current->first.second, channel_kind::kSetpoint),
                     sample(jog), jog.quote);
    publish_(sealed.channel, sealed.bytes);
  }
}

void Acting::answer(std::uint64_t page, const std::string& text, bool refused) {
  say_(page, Json{{"op", "acted"}, {"text", text}, {"refused", refused}}.dump());
}

}  // namespace strainwave
