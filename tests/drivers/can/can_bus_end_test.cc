// SPDX-License-Identifier: BSD-3-Clause
// Our heartbeat while the background thread waits for a drive. It continues when the bus is closed, but never hides a hanging loop.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "drivers/can/can_bus.h"

namespace strainwave {
namespace {

using std::chrono::nanoseconds;

constexpr std::int64_t kHeartbeatPeriod_ns = 20'000'000;
constexpr std::int64_t kAnswer_ns = 400'000'000;

/// A real-time port on which no frame arrives.
class SilentPort final : public CanPort {
 public:
  explicit SilentPort(std::atomic<int>& heartbeats) : heartbeats_(heartbeats) {}
  SendResult send(const CanFrame& frame) noexcept override {
    if (frame.id == canopen::cob_id(canopen::CobId::kHeartbeat, 127)) ++heartbeats_;
    return SendResult::kSent;
  }
  ReceiveResult receive(std::span<ReceivedFrame> /*frames*/) noexcept override { return {}; }
  std::uint32_t overflows() const noexcept override { return 0; }
  bool wait(std::int64_t timeout_ns) override {
    std::this_thread::sleep_for(nanoseconds(timeout_ns));
    return false;
  }
  std::int64_t now_ns() override {
    return nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

 private:
  std::atomic<int>& heartbeats_;
};

/// A drive that delays the background thread by kAnswer_ns.
class SlowNode final : public CanNode {
 public:
  explicit SlowNode(std::atomic<bool>& waiting) : waiting_(waiting) {}
  const std::string& name() const noexcept override { return name_; }
  std::vector<std::uint32_t> receive_ids() const override { return {}; }
  std::vector<std::uint32_t> transmit_ids() const override { return {}; }
  std::vector<std::uint32_t> setup_ids() const override { return {}; }
  std::vector<FrameTraffic> traffic() const override { return {}; }
  std::vector<std::string> set_up(CanPort& /*port*/) override { return {}; }
  std::vector<std::string> verify(CanPort& /*port*/) override { return {}; }
  std::vector<std::string> serve(CanPort& port) override {
    waiting_ = true;
    (void)port.wait(kAnswer_ns);
    waiting_ = false;
    return {};
  }
  void shut_down(CanPort& /*port*/) noexcept override {}
  void begin_cycle(std::int64_t /*now_ns*/) noexcept override {}
  void receive(const CanFrame& /*frame*/, std::int64_t /*kernel_time_ns*/) noexcept override {}
  void note_bus(const NodeFault& /*trouble*/) noexcept override {}
  void transmit(CanTransmitter& /*bus*/) noexcept override {}
  ActuatorReading read(std::int64_t /*now_ns*/) noexcept override { return {}; }
  void write(const ActuatorCommand& /*command*/) noexcept override {}
  void stop() noexcept override {}
  void clear_fault() noexcept override {}

 private:
  std::atomic<bool>& waiting_;
  std::string name_ = "slow";
};

TEST(CanBusEnd, OurHeartbeatGoesOnWhileTheBackgroundThreadWaitsForADrive) {
  std::atomic<int> heartbeats = 0;
  std::atomic<bool> waiting = false;
  CanBusConfig config;
  config.interface_name = "can0";
  config.heartbeat_period_s = static_cast<double>(kHeartbeatPeriod_ns) * 1e-9;
  std::vector<std::unique_ptr<CanNode>> nodes;
  nodes.push_back(std::make_unique<SlowNode>(waiting));
  CanBus bus(config, std::move(nodes),
             [&](const CanPortOptions& /*options*/) { return std::make_unique<SilentPort>(heartbeats); });
  while (!waiting) std::this_thread::yield();
  std::this_thread::sleep_for(nanoseconds(kAnswer_ns / 8));
  EXPECT_EQ(heartbeats, 0) << "the loop alone sends it before the end";
  bus.close();
  EXPECT_GE(heartbeats, 5) << "of about 17";
}

}  // namespace
}  // namespace strainwave
