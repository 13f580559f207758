// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/cia402_state.h"

#include <array>

namespace strainwave::cia402 {

namespace {

struct StatusRow {
  std::uint16_t mask;
  std::uint16_t value;
  PowerState state;
  std::string_view text;
  // The controlwords for each goal.
  std::uint16_t disable;
  std::uint16_t enable;
  std::uint16_t quick_stop;
};

using enum PowerState;
namespace word = controlword;
// clang-format off
constexpr std::uint16_t kOff = controlword::kDisableVoltage;
constexpr std::array<StatusRow, 8> kTable{{
    // status and its mask, state,            text,                    to disable,      to enable,              to quick stop
    {0x4F, 0x00, kNotReady,         "not ready to switch on", kOff,            kOff,                   kOff},
    {0x4F, 0x40, kSwitchOnDisabled, "switch on disabled",     kOff,            word::kShutdown,        kOff},
    {0x6F, 0x21, kReadyToSwitchOn,  "ready to switch on",     kOff,            word::kSwitchOn,        kOff},
    {0x6F, 0x23, kSwitchedOn,       "switched on",            word::kShutdown, word::kEnableOperation, kOff},
    {0x6F, 0x27, kOperationEnabled, "operation enabled",      word::kShutdown, word::kEnableOperation, word::kQuickStop},
    {0x6F, 0x07, kQuickStopActive,  "quick stop active",      kOff,            kOff,                   word::kQuickStop},
    {0x4F, 0x0F, kFaultReaction,    "fault reaction active",  kOff,            kOff,                   kOff},
    {0x4F, 0x08, kFault,            "fault",                  kOff,            kOff,                   kOff},
}};
// clang-format on

const StatusRow& row_of(PowerState state) noexcept {
  return kTable[static_cast<std::size_t>(state)];
}

}  // namespace

std::string_view to_text(PowerState state) noexcept {
  return row_of(state).text;
}

PowerState power_state_of(std::uint16_t statusword) noexcept {
  for (const StatusRow& row : kTable)
    if ((statusword & row.mask) == row.value) return row.state;
  // The standard does not define these bit patterns, so the state is unknown.
  return PowerState::kNotReady;
}

std::uint16_t controlword_towards(Goal goal, PowerState state) noexcept {
  const StatusRow& row = row_of(state);
  switch (goal) {
    case Goal::kDisabled:
      return row.disable;
    case Goal::kEnabled:
      return row.enable;
    case Goal::kQuickStop:
      return row.quick_stop;
  }
  return controlword::kDisableVoltage;
}

}  // namespace strainwave::cia402
