// SPDX-License-Identifier: BSD-3-Clause
// The part of a CiA 402 drive's set-up that concerns its mode of operation and its own loop.
#include <array>
#include <sstream>

#include "drivers/can/cia402/cia402_description.h"
#include "drivers/can/cia402/cia402_objects.h"
#include "drivers/can/cia402/setup_steps.h"
#include "drivers/can/hexadecimal.h"

namespace strainwave::cia402 {

namespace {

using canopen::Entry;
using canopen::SdoClient;

constexpr Entry kMode{0x6060, 0};
constexpr Entry kFollowingErrorWindow{0x6065, 0};
/// Value of 605Ah: slow down on the quick stop ramp, then no torque.
constexpr std::uint32_t kStopOnRamp = 2;
/// Value of 6065h: no supervision of the following error.
constexpr std::uint32_t kNoWindow = UINT32_MAX;
constexpr std::int64_t kModePoll_ns = 5'000'000;
constexpr std::int64_t kModeWait_ns = 1'000'000'000;

struct Choice {
  DriveMode drive_mode;
  OperationMode mode;
  unsigned bit;  ///< bit in 6502h
  const char* name;
};
/// For each drive_mode in order of preference.
constexpr std::array<Choice, 5> kChoices{
    {{DriveMode::kTorque, OperationMode::kCyclicTorque, 9, "CST"},
     {DriveMode::kTorque, OperationMode::kTorque, 3, "TQ"},
     {DriveMode::kVelocity, OperationMode::kCyclicVelocity, 8, "CSV"},
     {DriveMode::kPosition, OperationMode::kCyclicPosition, 7, "CSP"},
     {DriveMode::kPosition, OperationMode::kInterpolatedPosition, 6, "IP"}}};

bool named(const Choice& choice, std::uint32_t supported) {
  return (supported >> choice.bit & 1U) != 0;
}

std::string names_of(DriveMode wanted) {
  std::string names;
  for (const Choice& choice : kChoices)
    if (choice.drive_mode == wanted)
      names += (names.empty() ? "" : " nor ") + std::string(choice.name) + " (mode " +
               std::to_string(static_cast<int>(choice.mode)) + ")";
  return names;
}

[[noreturn]] void refuse_modes(SdoClient& client, DriveMode wanted, std::uint32_t supported) {
  std::string text = "does not support " + names_of(wanted) + ", which drive_mode = \"" + to_text(wanted) +
                     "\" needs: 6502h = " + hexadecimal(supported, 8) + " (" + modes_text(supported) + ")";
  for (const Choice& choice : kChoices)
    if (named(choice, supported)) {
      text += std::string("; drive_mode = \"") + to_text(choice.drive_mode) + "\" is possible";
      break;
    }
  refuse(client, text);
}

}  // namespace

const char* to_text(OperationMode mode) {
  for (const Choice& choice : kChoices)
    if (choice.mode == mode) return choice.name;
  return "?";
}

void set_mode(SdoClient& client, OperationMode mode) {
  const auto wanted = static_cast<std::uint8_t>(mode);
  client.download(kMode, wanted, 1);
  const std::int64_t deadline_ns = client.port().now_ns() + kModeWait_ns;
  std::uint32_t shown = number(client, kModeDisplay, 1);
  while (shown != wanted && client.port().now_ns() < deadline_ns) {
    (void)client.port().wait(kModePoll_ns);
    shown = number(client, kModeDisplay, 1);
  }
  if (shown != wanted)
    refuse(client, "mode of operation " + std::to_string(wanted) + " was ordered, 6061h still shows " +
                       std::to_string(static_cast<std::int8_t>(shown)));
}

OperationMode choose_mode(SdoClient& client, DriveMode wanted, std::optional<std::uint32_t> supported) {
  std::string reason;
  for (const Choice& choice : kChoices) {
    if (choice.drive_mode != wanted || (supported && !named(choice, *supported))) continue;
    if (supported) return choice.mode;
    try {
      set_mode(client, choice.mode);
      return choice.mode;
    } catch (const InputError& error) {
      reason = error.what();
    }
  }
  if (supported) refuse_modes(client, wanted, *supported);
  refuse(client, "has no 6502h, and does not take " + names_of(wanted) + ": " + reason);
}

void configure_own_loop(SdoClient& client, const DriveConfig& config, std::vector<std::string>& report) {
  clear_offset(client, kPositionOffset, 4, "position offset");
  clear_offset(client, kVelocityOffset, 4, "velocity offset");
  if (!config.quick_stop_option &&
      !client.write_if_writable({kQuickStopOption, kStopOnRamp, 2, ~0U, "reaction to a quick stop"}))
    report.push_back(client.who() + ": the drive does not take 605Ah: it decides by itself how it stops");
  if (config.drive_mode != DriveMode::kPosition || config.following_error_rad <= 0.0) return;
  const auto window = client.upload_if_there(kFollowingErrorWindow, 4);
  std::ostringstream text;
  text << client.who() << ": the drive ";
  const double window_rad =
      kTurn_rad * static_cast<double>(window.value_or(0)) / config.units.counts_per_output_revolution;
  if (!window || *window == kNoWindow)
    text << "does not watch its following error (6065h)";
  else
    text << "faults at a following error of " << window_rad << " rad at the joint (6065h)";
  text << ", the daemon at joint.limits.following_error_rad = " << config.following_error_rad;
  report.push_back(text.str());
}

}  // namespace strainwave::cia402
