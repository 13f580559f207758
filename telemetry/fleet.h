// SPDX-License-Identifier: BSD-3-Clause
// The data of all daemons and joints for the metrics: latest messages, and peaks of the last minute. Bytes from the network are
// hostile: the number of names is bounded and shared fairly between senders, and silent names are forgotten. Not real-time.
//
// Operators build alerts and plots on the metrics. Tables in joint_metrics.cc and daemon_metrics.cc hold
// their names. A test compares them with docs/telemetry.md.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <strainwave/limits_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string>
#include <utility>

#include "lcmtypes/channels.h"
#include "telemetry/exposition.h"
#include "telemetry/sliding_window.h"
#include "transport/fair_places.h"

namespace strainwave {

/// One joint. Messages other than its state are rarer and may be absent at first.
struct JointRecord {
  state_v1 state{};
  double state_heard_s = 0.0;
  std::optional<limits_v1> limits;
  std::optional<temperature_v1> temperature;

  RecentPeak tracking_error_rad;
  RecentPeak torque_Nm;

  void take(const state_v1& latest, double now_s);
};

struct DaemonRecord {
  timing_v1 timing{};
  double timing_heard_s = 0.0;
};

class Fleet {
 public:
  /// A joint or daemon that is silent for this long is removed, and its metrics end, as Prometheus requires.
  static constexpr double kSilent_s = 10.0;
  static constexpr std::size_t kMaxJoints = 512;
  static constexpr std::size_t kMaxDaemons = 128;

  using JointName = std::pair<std::string, std::string>;  ///< prefix, joint
  using Joints = std::map<JointName, JointRecord>;
  using Daemons = std::map<std::string, DaemonRecord>;

  /// Takes one message from the channel `name`, sent by `from`. A joint exists through its states; without
  /// one, its other messages are ignored. So are messages with negative counts.
  void take(const ChannelName& name, const state_v1& message, double now_s, const LcmSource& from = {});
  void take(const ChannelName& name, const limits_v1& message, double now_s, const LcmSource& from = {});
  void take(const ChannelName& name, const temperature_v1& message, double now_s, const LcmSource& from = {});
  void take(const ChannelName& name, const timing_v1& message, double now_s, const LcmSource& from = {});
  template <typename Other>
  void take(const ChannelName&, const Other&, double, const LcmSource& = {}) {}

  /// Forgets silent joints and daemons.
  void forget_silent(double now_s);
  const Joints& joints() const noexcept { return joints_; }
  const Daemons& daemons() const noexcept { return daemons_; }

 private:
  Joints joints_;
  Daemons daemons_;
  FairPlaces<JointName> joint_places_{kMaxJoints};
  FairPlaces<std::string> daemon_places_{kMaxDaemons};
};

/// Write the metrics of joints and daemons.
void expose_joints(Exposition& page, const Fleet::Joints& joints, double now_s);
void expose_daemons(Exposition& page, const Fleet::Daemons& daemons);

}  // namespace strainwave
