// The part of cia402_setup.h that watches a drive which has been set up: whether it answers our SYNC, and how soon.
#include <algorithm>
#include <array>

#include "base/durations.h"
#include "base/input_error.h"
#include "base/printable.h"
#include "drivers/can/cia402/cia402_setup.h"

namespace strainwave::cia402 {

namespace {

/// A late position, and how often it is looked for.
constexpr std::int64_t kLongestDelay_ns = 20'000'000;
constexpr int kDelaySamples = 5;
constexpr int kOldPositions = 100;
/// SYNCs until a drive must have sent both of its TPDOs.
constexpr int kVerifySyncs = 2 * 240;

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
  std::array<ReceivedFrame, 16> frames;
  /// When the first position came, or nothing at `end_ns`.
  const auto position_until = [&](std::int64_t end_ns) -> std::optional<std::int64_t> {
    while (port.now_ns() < end_ns) {
      const ReceiveResult result = port.receive(frames);
      for (std::size_t i = 0; i < result.count; ++i)
        if (frames[i].frame.id == layout.fast.cob_id(config.node_id)) return port.now_ns();
      if (result.count == 0) (void)port.wait(end_ns - port.now_ns());
    }
    return std::nullopt;
  };
  std::optional<std::int64_t> shortest_ns;
  for (int i = 0; i < kDelaySamples; ++i) {
    // What is still on its way belongs to another SYNC; what never ends, to another producer's.
    for (int old = 0; old < kOldPositions && position_until(port.now_ns() + kLongestDelay_ns); ++old)
      continue;
    const std::int64_t sync_ns = port.now_ns();
    (void)port.send(canopen::sync_frame());
    if (const auto came_ns = position_until(sync_ns + kLongestDelay_ns))
      shortest_ns = std::min(shortest_ns.value_or(INT64_MAX), *came_ns - sync_ns);
  }
  const std::string who = config.name + ": node " + std::to_string(config.node_id) + ": ";
  if (!shortest_ns)
    throw InputError(
        who + "no position came within 20 ms of a SYNC, though some come: is there another SYNC producer?");
  if (*shortest_ns > config.delay_periods * period_ns)
    throw InputError(who + "a position comes " + std::to_string(static_cast<double>(*shortest_ns) * 1e-6) +
                     " ms after its SYNC, delay_periods = " + std::to_string(config.delay_periods) +
                     " allows for " + std::to_string(config.delay_periods * period_ns / 1000) +
                     " us: let the drive send TPDO1 at once, or raise delay_periods");
  return *shortest_ns;
}

}  // namespace strainwave::cia402
