// The loop begins a bus's cycle before its joints read, and ends it after they wrote; also at its own end.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "daemon/realtime/realtime_loop.h"
#include "drivers/fieldbus.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

/// What happened, in its order, without allocating: b begin, r read, w write, s stop, e end.
struct Journal {
  static constexpr std::size_t kRoom = 4096;
  std::array<char, kRoom> entries{};
  std::size_t count = 0;
  void add(char entry) noexcept {
    if (count < kRoom) entries[count++] = entry;
  }
  std::string text() const { return {entries.data(), count}; }
};

class JournalActuator final : public Actuator {
 public:
  explicit JournalActuator(Journal& journal) : journal_(journal) {}
  ActuatorReading read(std::int64_t /*now_ns*/) noexcept override {
    journal_.add('r');
    return {};
  }
  void write(const ActuatorCommand& /*command*/) noexcept override { journal_.add('w'); }
  void stop() noexcept override { journal_.add('s'); }
  void clear_fault() noexcept override {}

 private:
  Journal& journal_;
};

class JournalBus final : public Fieldbus {
 public:
  explicit JournalBus(Journal& journal) : journal_(journal) {}
  std::unique_ptr<Actuator> make_actuator(std::size_t /*slot*/) override {
    return std::make_unique<JournalActuator>(journal_);
  }
  void begin_cycle(std::int64_t now_ns) noexcept override {
    EXPECT_GT(now_ns, previous_ns_);
    previous_ns_ = now_ns;
    journal_.add('b');
  }
  void end_cycle() noexcept override { journal_.add('e'); }

 private:
  Journal& journal_;
  std::int64_t previous_ns_ = 0;
};

TEST(RealtimeLoop, PutsEveryJointOfABusBetweenItsBeginAndItsEnd) {
  Journal journal;
  LoopConfig config;
  config.real_time = RealTimePolicy::kIgnore;
  LoopParts parts;
  parts.buses.push_back(std::make_unique<JournalBus>(journal));
  for (std::size_t slot = 0; slot < 2; ++slot)
    parts.joints.push_back({demo_joint().loop, parts.buses[0]->make_actuator(slot), nullptr});
  const auto memory = std::make_unique<OutboundMemory>();
  {
    RealtimeLoop loop(config, std::move(parts), memory->states);
    loop.start();
    while (loop.statistics().cycles.load() < 20) std::this_thread::yield();
    loop.request_stop();
    while (!loop.finished()) std::this_thread::yield();
  }
  std::string expected;
  const std::string text = journal.text();
  const std::string last = "sse";
  ASSERT_GT(text.size(), last.size());
  while (expected.size() + last.size() < text.size()) expected += "brwrwe";
  EXPECT_EQ(text, expected + last);
}

}  // namespace
}  // namespace strainwave::testing
