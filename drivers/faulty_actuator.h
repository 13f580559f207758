// SPDX-License-Identifier: BSD-3-Clause
// A drive with injected faults: it holds another Actuator and falsifies the data that pass through. It wraps
// the simulated drive only, never a real one. read(), write(), stop(), clear_fault() and inject() are
// real-time safe, except that the overrun and the slow read burn time on purpose. The constructor is not
// real-time safe.
//
// It reads no clock: faults begin and end by the now_ns that read() receives. A function of the caller burns
// the time.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "drivers/actuator.h"
#include "drivers/injected_fault.h"

namespace strainwave {

/// Returns after `duration_ns`, without sleeping.
using BusyWait = void (*)(std::int64_t duration_ns) noexcept;

struct FaultyActuatorConfig {
  double period_s = 0.001;          ///< of the loop, > 0
  std::vector<Injection> schedule;  ///< times count from the first read()
  BusyWait busy_wait = nullptr;     ///< null: overrun and slow read have no effect
  std::uint64_t seed = 1;           ///< of the noise generator
};

class FaultyActuator final : public Actuator {
 public:
  FaultyActuator(std::unique_ptr<Actuator> actuator, FaultyActuatorConfig config);

  ActuatorReading read(std::int64_t now_ns) noexcept override;
  void write(const ActuatorCommand& command) noexcept override;
  void stop() noexcept override;
  void clear_fault() noexcept override { actuator_->clear_fault(); }

  /// Begins `injection` with the next read() and replaces an active fault of the same kind; kNone ends all
  /// faults. Must be called from the thread of read().
  void inject(const Injection& injection) noexcept;

  Actuator& inner() noexcept { return *actuator_; }

 private:
  /// State of one kind of fault.
  struct Active {
    bool on = false;
    bool begun = false;  ///< read() has applied it at least once
    std::int64_t since_ns = 0;
    std::int64_t for_ns = 0;  ///< 0: no end
    double amount = 0.0;
  };
  Active& of(InjectedFault kind) noexcept { return active_[static_cast<std::size_t>(kind)]; }
  void begin_and_end_faults() noexcept;
  void falsify_position(ActuatorReading& reading) noexcept;
  void falsify_temperature(ActuatorReading& reading) noexcept;
  void delay_position(ActuatorReading& reading, const Active& delay) noexcept;
  void burn(InjectedFault kind) noexcept;

  struct Motion {
    double position_rad = 0.0;
    double velocity_rad_s = 0.0;
  };
  std::unique_ptr<Actuator> actuator_;
  FaultyActuatorConfig config_;
  std::size_t next_scheduled_ = 0;
  std::array<Active, kInjectedFaultCount> active_{};
  std::array<Motion, kMaxSensorDelayPeriods> past_{};  ///< ring buffer, filled since the delay began
  std::int64_t past_count_ = 0;
  double stuck_position_rad_ = 0.0;
  double stuck_temperature_C_ = 0.0;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  ActuatorCommand last_command_;  ///< last order that the drive accepted
  bool refused_ = false;
  bool started_ = false;
  std::int64_t first_ns_ = 0;
  std::int64_t now_ns_ = 0;
};

}  // namespace strainwave
