#include "drivers/can/cia402_state.h"

#include <array>

namespace strainwave::cia402 {

namespace {

struct StatusRow {
  std::uint16_t mask;
  std::uint16_t value;
  PowerState state;
  std::string_view text;
  // Controlwords towards the goals.
  std::uint16_t disable;
  std::uint16_t enable;
  std::uint16_t quick_stop;
};

// clang-format off
constexpr std::array<StatusRow, 8> kTable{{
    {0x4F, 0x00, PowerState::kNotReady,         "not ready to switch on", kDisableVoltage, kDisableVoltage,  kDisableVoltage},
    {0x4F, 0x40, PowerState::kSwitchOnDisabled, "switch on disabled",     kDisableVoltage, kShutdown,        kDisableVoltage},
    {0x6F, 0x21, PowerState::kReadyToSwitchOn,  "ready to switch on",     kDisableVoltage, kSwitchOn,        kDisableVoltage},
    {0x6F, 0x23, PowerState::kSwitchedOn,       "switched on",            kShutdown,       kEnableOperation, kDisableVoltage},
    {0x6F, 0x27, PowerState::kOperationEnabled, "operation enabled",      kShutdown,       kEnableOperation, kQuickStop},
    {0x6F, 0x07, PowerState::kQuickStopActive,  "quick stop active",      kDisableVoltage, kDisableVoltage,  kQuickStop},
    {0x4F, 0x0F, PowerState::kFaultReaction,    "fault reaction active",  kDisableVoltage, kDisableVoltage,  kDisableVoltage},
    {0x4F, 0x08, PowerState::kFault,            "fault",                  kDisableVoltage, kDisableVoltage,  kDisableVoltage},
}};
// clang-format on

const StatusRow& row_of(PowerState state) noexcept { return kTable[static_cast<std::size_t>(state)]; }

}  // namespace

std::string_view to_text(PowerState state) noexcept { return row_of(state).text; }

PowerState power_state_of(std::uint16_t statusword) noexcept {
  for (const StatusRow& row : kTable)
    if ((statusword & row.mask) == row.value) return row.state;
  // Bit patterns that the standard does not give: nothing may be built on them.
  return PowerState::kNotReady;
}

std::uint16_t controlword_towards(Goal goal, PowerState state) noexcept {
  const StatusRow& row = row_of(state);
  switch (goal) {
    case Goal::kDisabled: return row.disable;
    case Goal::kEnabled: return row.enable;
    case Goal::kQuickStop: return row.quick_stop;
  }
  return kDisableVoltage;
}

}  // namespace strainwave::cia402
