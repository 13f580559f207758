// SPDX-License-Identifier: BSD-3-Clause
// What was heard of every daemon and joint, for their metrics: the latest messages, and what happened since the last minute. Bytes from the
// network are hostile: the number of names is bounded and shared by those who are heard, and who falls silent is forgotten. Not real-time.
//
// The metrics are what operators' alerts and plots are made from: their names are a table in joint_metrics.cc and daemon_metrics.cc, and in
// docs/telemetry.md, which a test compares.
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

/// One joint. Messages of other kinds than its state are rarer: they may not be there yet.
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
  /// Who has been silent as long is gone: its metrics end, as Prometheus wants it.
  static constexpr double kSilent_s = 10.0;
  static constexpr std::size_t kMaxJoints = 512;
  static constexpr std::size_t kMaxDaemons = 128;

  using JointName = std::pair<std::string, std::string>;  ///< prefix, joint
  using Joints = std::map<JointName, JointRecord>;
  using Daemons = std::map<std::string, DaemonRecord>;

  /// One message from the channel `name`, sent by `from`. A joint is known by its states; without any, its other messages say nothing.
  /// Negative counts are ignored.
  void take(const ChannelName& name, const state_v1& message, double now_s, const LcmSource& from = {});
  void take(const ChannelName& name, const limits_v1& message, double now_s, const LcmSource& from = {});
  void take(const ChannelName& name, const temperature_v1& message, double now_s, const LcmSource& from = {});
  void take(const ChannelName& name, const timing_v1& message, double now_s, const LcmSource& from = {});
  template <typename Other>
  void take(const ChannelName&, const Other&, double, const LcmSource& = {}) {}

  /// Forgets who is silent.
  void forget_silent(double now_s);
  const Joints& joints() const noexcept { return joints_; }
  const Daemons& daemons() const noexcept { return daemons_; }

 private:
  Joints joints_;
  Daemons daemons_;
  FairPlaces<JointName> joint_places_{kMaxJoints};
  FairPlaces<std::string> daemon_places_{kMaxDaemons};
};

/// Write their metrics.
void expose_joints(Exposition& page, const Fleet::Joints& joints, double now_s);
void expose_daemons(Exposition& page, const Fleet::Daemons& daemons);

}  // namespace strainwave
