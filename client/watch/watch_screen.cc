// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/watch_screen.h"

#include <algorithm>
#include <array>

#include "base/input_error.h"
#include "client/protocol/latest_messages.h"
#include "client/watch/order_desk.h"
#include "client/watch/terminal.h"
#include "client/watch/view.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

constexpr double kKeyDelay_s = 0.05;  // interval between checks of the keyboard

/// Steps of the jog keys, in rad.
constexpr std::array kJogSteps_rad{0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01,
                                   0.02,   0.05,   0.1,    0.2,   0.5,   1.0};

class WatchScreen {
 public:
  WatchScreen(Client& client, const WatchArguments& arguments)
      : client_(client),
        arguments_(arguments),
        timings_(client.connection()),
        temperatures_(client.connection()),
        limits_(client.connection()),
        desk_(client.connection(), client.states(), client.options().key_file, client.options().timeout_s) {
    model_.has_key = !client.options().key_file.empty();
    model_.unicode = terminal_.unicode();
    model_.interval_s = arguments.interval_s;
  }

  void run() {
    const std::optional<Deadline> end =
        arguments_.duration_s ? std::optional<Deadline>(*arguments_.duration_s) : std::nullopt;
    Deadline next(0.0);
    while (!quit_ && !(end && end->passed())) {
      desk_.tick();
      if (next.passed()) {
        sample();
        next = Deadline(arguments_.interval_s);
      }
      model_.message = desk_.message(now());
      model_.message_alarm = desk_.alarm();
      model_.jog_rad = kJogSteps_rad.at(jog_);
      model_.refusals.clear();
      for (const OrderDesk::Refusal& refusal : desk_.refusals())
        model_.refusals.push_back({refusal.text, seconds_between(refusal.when, now())});
      terminal_.show(render(model_, terminal_.rows(), terminal_.columns()));
      client_.wait_until([] { return false; }, Deadline(std::min(kKeyDelay_s, arguments_.interval_s)));
      while (const auto press = terminal_.read()) obey(*press);
    }
  }

 private:
  bool wanted(const std::string& prefix, const std::string& joint) const {
    if (!client_.options().all_prefixes && prefix != client_.options().prefix) return false;
    return arguments_.joints.empty() ||
           std::ranges::find(arguments_.joints, joint) != arguments_.joints.end();
  }

  /// Takes the present data. The selected joint stays selected when other joints appear before it.
  void sample() {
    std::vector<WatchedJoint> joints;
    for (const std::string& prefix : client_.states().prefixes()) {
      for (const std::string& joint : client_.states().joints(prefix))
        if (wanted(prefix, joint)) joints.push_back(watched(prefix, joint));
    }
    const std::optional<WatchedJoint> before =
        selected() != nullptr ? std::optional(*selected()) : std::nullopt;
    const auto again =
        std::ranges::find_if(joints, [&](const WatchedJoint& j) { return before && same(j, *before); });
    model_.selected = again == joints.end() ? 0 : static_cast<int>(again - joints.begin());
    model_.joints = std::move(joints);
    model_.daemons.clear();
    for (const auto& [name, timing] : timings_.all()) {
      if (client_.options().all_prefixes || name.first == client_.options().prefix)
        model_.daemons.push_back({name.first, timing.message, seconds_between(timing.received, now())});
    }
  }

  static bool same(const WatchedJoint& a, const WatchedJoint& b) {
    return a.prefix == b.prefix && a.joint == b.joint;
  }

  WatchedJoint watched(const std::string& prefix, const std::string& joint) const {
    WatchedJoint result;
    result.prefix = prefix;
    result.joint = joint;
    const auto before =
        std::ranges::find_if(model_.joints, [&](const WatchedJoint& j) { return same(j, result); });
    if (before != model_.joints.end()) result = *before;
    result.view = *client_.states().find(prefix, joint);
    result.age_s = seconds_between(result.view.received, now());
    remember(result.view, result.age_s, result.history);
    if (const auto* temperature = temperatures_.find(prefix, joint))
      result.temperature = temperature->message;
    if (const auto* limits = limits_.find(prefix, joint)) result.limits = limits->message;
    return result;
  }

  const WatchedJoint* selected() const {
    const auto index = static_cast<std::size_t>(model_.selected);
    return index < model_.joints.size() ? &model_.joints[index] : nullptr;
  }

  void obey(const Terminal::Press& press) {
    const int last = static_cast<int>(model_.joints.size()) - 1;
    if (press.key == Terminal::Key::kUp) model_.selected = std::max(0, model_.selected - 1);
    if (press.key == Terminal::Key::kDown) model_.selected = std::max(0, std::min(last, model_.selected + 1));
    switch (press.character) {
      case 'q':
        quit_ = true;
        return;
      case '?':
        model_.help = !model_.help;
        return;
      case 's':
        if (const WatchedJoint* joint = selected()) desk_.stop({{joint->prefix, joint->joint}});
        return;
      case 'S':
        return stop_all();
      case 'e':
        return order(Action::kEnable);
      case 'h':
        return order(Action::kHold);
      case 'c':
        return order(Action::kClearFault);
      case ']':
        return jog(1.0);
      case '[':
        return jog(-1.0);
      case '+':
        jog_ = std::min(jog_ + 1, kJogSteps_rad.size() - 1);
        return;
      case '-':
        jog_ = jog_ > 0 ? jog_ - 1 : 0;
        return;
      default:
        return;
    }
  }

  void stop_all() {
    std::vector<OrderDesk::Name> all;
    for (const WatchedJoint& joint : model_.joints) all.emplace_back(joint.prefix, joint.joint);
    desk_.stop(all);
  }

  void order(Action action) {
    if (const WatchedJoint* joint = selected()) desk_.order({joint->prefix, joint->joint}, action);
  }

  /// Moves from the last target of the joint, so that several presses add up.
  void jog(double direction) {
    if (const WatchedJoint* joint = selected())
      desk_.move({joint->prefix, joint->joint},
                 joint->view.state.target_position_rad + direction * kJogSteps_rad.at(jog_));
  }

  Client& client_;
  const WatchArguments& arguments_;
  Terminal terminal_;
  LatestMessages<Latest<timing_v1>> timings_;
  LatestMessages<Latest<temperature_v1>> temperatures_;
  LatestMessages<Latest<limits_v1>> limits_;
  OrderDesk desk_;
  WatchModel model_;
  std::size_t jog_ = 6;  ///< index into kJogSteps_rad
  bool quit_ = false;
};

}  // namespace

void watch_screen(Client& client, const WatchArguments& arguments) {
  try {
    WatchScreen(client, arguments).run();
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
  }
}

}  // namespace strainwave
