// SPDX-License-Identifier: BSD-3-Clause
// The part of cia402_setup.h that checks whether a configured drive answers our SYNC, and how soon.
#include <algorithm>
#include <array>
#include <optional>

#include "base/durations.h"
#include "base/input_error.h"
#include "base/printable.h"
#include "drivers/can/cia402/cia402_setup.h"

namespace strainwave::cia402 {

namespace {

/// The longest delay of a position that is measured.
constexpr std::int64_t kLongestDelay_ns = 20'000'000;
/// SYNCs in a measurement: as many as a delay of 20 ms needs to build up at 1 kHz. The median of kTrains measurements counts.
constexpr int kTrain = 50;
constexpr int kTrains = 3;
constexpr int kOldBatches = 100;
/// Number of SYNCs in which a drive must have sent each of its TPDOs.
constexpr int kVerifySyncs = 2 * 240;

// Uses the timing of the loop: an adapter may report our SYNC late, which is then part of every delay.
std::optional<std::int64_t> delay_after_train_ns(CanPort& port, std::int64_t period_ns,
                                                 std::uint32_t position_id) {
  std::array<ReceivedFrame, 16> frames;
  std::int64_t sync_ns = 0;
  std::int64_t position_ns = 0;
  const auto listen_until = [&](std::int64_t end_ns) {
    do {
      const ReceiveResult result = port.receive(frames);
      for (std::size_t i = 0; i < result.count; ++i) {
        const std::int64_t time_ns = frames[i].kernel_time_ns != 0 ? frames[i].kernel_time_ns : port.now_ns();
        const bool own = frames[i].kind == ReceivedFrame::Kind::kOwn;
        if (own && frames[i].frame.id == canopen::sync_frame().id) sync_ns = time_ns;
        if (!own && frames[i].frame.id == position_id) position_ns = time_ns;
      }
      if (result.count == 0) (void)port.wait(end_ns - port.now_ns());
    } while (port.now_ns() < end_ns);
  };
  // Frames that still arrive belong to earlier SYNCs.
  for (int batch = 0; batch < kOldBatches; ++batch) {
    position_ns = 0;
    listen_until(port.now_ns() + kLongestDelay_ns);
    if (position_ns == 0) break;
  }
  position_ns = 0;
  std::int64_t next_ns = port.now_ns();
  for (int i = 0; i < kTrain; ++i) {
    (void)port.send(canopen::sync_frame());
    listen_until(next_ns += period_ns);
  }
  listen_until(port.now_ns() + kLongestDelay_ns);
  if (position_ns == 0 || sync_ns == 0) return std::nullopt;
  return std::max<std::int64_t>(position_ns - sync_ns, 0);
}

}  // namespace

void verify_drive(CanPort& port, const DriveConfig& config, const PdoLayout& layout) {
  const std::string who = config.name + ": node " + std::to_string(config.node_id) + ": ";
  const std::int64_t period_ns = nanoseconds(config.period_s);
  bool fast_seen = false;
  bool slow_seen = layout.slow.objects.empty();
  bool probe_seen = layout.probe.objects.empty();
  std::vector<ReceivedFrame> frames(16);
  for (int sync = 0; sync < kVerifySyncs && !(fast_seen && slow_seen && probe_seen); ++sync) {
    if (config.daemon_sends_sync) (void)port.send(canopen::sync_frame());
    const std::int64_t deadline_ns = port.now_ns() + period_ns;
    do {
      const ReceiveResult result = port.receive(frames);
      if (result.link != CanLink::kUp) throw InputError(who + "the CAN interface went down");
      for (std::size_t i = 0; i < result.count; ++i) {
        const CanFrame& frame = frames[i].frame;
        for (const auto& [pdo, seen] :
             {std::pair{&layout.fast, &fast_seen}, std::pair{&layout.slow, &slow_seen},
              std::pair{&layout.probe, &probe_seen}}) {
          if (frame.id != pdo->cob_id(config.node_id) || pdo->objects.empty()) continue;
          if (frame.size != pdo->bytes())
            throw InputError(who + "TPDO" + std::to_string(pdo->number) + " has " +
                             counted(frame.size, "byte") + " instead of the " + std::to_string(pdo->bytes()) +
                             " of its mapping");
          *seen = true;
        }
      }
      if (result.count == 0) (void)port.wait(deadline_ns - port.now_ns());
    } while (port.now_ns() < deadline_ns);
  }
  if (fast_seen && slow_seen && probe_seen) return;
  throw InputError(
      who + "no TPDO" +
      (!fast_seen   ? "1"
       : !slow_seen ? "2"
                    : "3") +
      " came in " + std::to_string(kVerifySyncs) + " periods: " +
      (config.daemon_sends_sync ? "the drive does not answer our SYNC" : "is the SYNC producer running?"));
}

std::int64_t measure_position_delay_ns(CanPort& port, const DriveConfig& config, const PdoLayout& layout) {
  const std::int64_t period_ns = nanoseconds(config.period_s);
  std::vector<std::int64_t> delays_ns;
  for (int i = 0; i < kTrains; ++i)
    if (const auto delay_ns = delay_after_train_ns(port, period_ns, layout.fast.cob_id(config.node_id)))
      delays_ns.push_back(*delay_ns);
  const std::string who = config.name + ": node " + std::to_string(config.node_id) + ": ";
  if (delays_ns.empty())
    throw InputError(who +
                     "positions come, but none within 20 ms of a SYNC: is there another SYNC producer?");
  std::sort(delays_ns.begin(), delays_ns.end());
  const std::int64_t delay_ns = delays_ns[delays_ns.size() / 2];
  if (delay_ns > config.delay_periods * period_ns)
    throw InputError(who + "at the loop's rate a position comes " +
                     std::to_string(static_cast<double>(delay_ns) * 1e-6) +
                     " ms after its SYNC, delay_periods = " + std::to_string(config.delay_periods) +
                     " allows for " + std::to_string(config.delay_periods * period_ns / 1000) +
                     " us: let the drive send TPDO1 at once, or raise delay_periods");
  return delay_ns;
}

}  // namespace strainwave::cia402
