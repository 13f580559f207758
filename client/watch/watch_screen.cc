#include "client/watch/watch_screen.h"

#include <algorithm>
#include <map>

#include "base/input_error.h"
#include "client/link/exit_status.h"
#include "client/link/limits_listener.h"
#include "client/watch/order_desk.h"
#include "client/watch/terminal.h"
#include "client/watch/view.h"

namespace strainwave {

namespace {

constexpr std::size_t kHistory = 64;
constexpr double kKeyDelay_s = 0.05;  // keys are looked for this often

/// The messages besides states and limits that the view shows.
class Listener {
 public:
  explicit Listener(Connection& connection)
      : timing_(connection.subscribe("[^.]+\\." + std::string(channel_kind::kTiming), &Listener::on_timing,
                                     this)),
        temperature_(connection.subscribe(channel_pattern("[^.]+", channel_kind::kTemperature),
                                          &Listener::on_temperature, this)) {}
  struct Timing {
    timing_v1 message{};
    Instant received;
  };
  std::map<std::string, Timing> timings;
  std::map<std::pair<std::string, std::string>, temperature_v1> temperatures;

 private:
  void on_timing(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    const auto parts = parse_channel(channel);
    const auto message = decode_exactly<timing_v1>(payload(*buffer));
    if (!parts || !message || (timings.size() >= StateView::kMaxJoints && !timings.contains(parts->prefix)))
      return;
    timings[parts->prefix] = {*message, now()};
  }
  void on_temperature(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    const auto parts = parse_channel(channel);
    const auto message = decode_exactly<temperature_v1>(payload(*buffer));
    if (!parts || !message) return;
    const std::pair name(parts->prefix, parts->joint);
    if (temperatures.size() < StateView::kMaxJoints || temperatures.contains(name))
      temperatures[name] = *message;
  }

  Subscription timing_;
  Subscription temperature_;
};

class WatchScreen {
 public:
  WatchScreen(Client& client, const WatchArguments& arguments)
      : client_(client),
        arguments_(arguments),
        listener_(client.connection()),
        limits_(client.connection()),
        desk_(client.connection(), client.options().key_file, client.options().timeout_s) {
    model_.has_key = !client.options().key_file.empty();
    model_.unicode = terminal_.unicode();
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
      model_.message = desk_.message();
      model_.message_alarm = desk_.alarm();
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

  /// What is known now. The selected joint stays selected when others come before it.
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
    for (const auto& [prefix, timing] : listener_.timings) {
      if (client_.options().all_prefixes || prefix == client_.options().prefix)
        model_.daemons.push_back({prefix, timing.message, seconds_between(timing.received, now())});
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
    const state_v1& state = result.view.state;
    remember(result.errors_rad, std::abs(state.joint_position_rad - state.setpoint_position_rad));
    remember(result.torques_Nm, std::abs(state.torque_applied_Nm));
    const auto temperature = listener_.temperatures.find({prefix, joint});
    if (temperature != listener_.temperatures.end()) result.temperature = temperature->second;
    if (const limits_v1* limits = limits_.find(prefix, joint)) result.limits = *limits;
    return result;
  }

  static void remember(std::deque<double>& history, double value) {
    history.push_back(value);
    if (history.size() > kHistory) history.pop_front();
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
      case 's':
        if (const WatchedJoint* joint = selected()) desk_.stop(joint->prefix, joint->joint);
        return;
      case 'S':
        for (const WatchedJoint& joint : model_.joints) desk_.stop(joint.prefix, joint.joint);
        return;
      case 'e':
        return order(Action::kEnable);
      case 'h':
        return order(Action::kHold);
      case 'c':
        return order(Action::kClearFault);
      default:
        return;
    }
  }

  void order(Action action) {
    const WatchedJoint* joint = selected();
    if (joint == nullptr || !model_.has_key) return;
    desk_.order(joint->prefix, joint->joint, joint->view.state.session_id, action);
  }

  Client& client_;
  const WatchArguments& arguments_;
  Terminal terminal_;
  Listener listener_;
  LimitsListener limits_;
  OrderDesk desk_;
  WatchModel model_;
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
