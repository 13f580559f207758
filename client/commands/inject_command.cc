// SPDX-License-Identifier: BSD-3-Clause
// inject: injects an artificial fault into a simulated drive, to test the reaction of the daemon. The daemon
// refuses it for any other drive.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <strainwave/inject_v1.hpp>
#include <string>
#include <vector>

#include "base/nearest_word.h"
#include "client/commands/commands.h"
#include "client/protocol/orders.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

[[noreturn]] void refuse_kind(const std::string& kind) {
  std::vector<std::string> kinds;
  kinds.reserve(kInjectedFaultCount);
  for (std::int32_t number = 0; number < kInjectedFaultCount; ++number)
    kinds.emplace_back(to_text(static_cast<InjectedFault>(number)));
  const std::string* nearest = nearest_word(kind, kinds);
  throw ClientError(
      ExitStatus::kUsage,
      fmt::format("inject: '{}' is not a fault that can be injected{}; allowed are: {}", kind,
                  nearest != nullptr ? " (did you mean " + *nearest + "?)" : "", fmt::join(kinds, ", ")));
}

}  // namespace

InjectArguments parse_injection(const std::string& joint, const std::string& kind, double amount,
                                double for_s) {
  const auto fault = injected_fault_of(std::string_view(kind));
  if (!fault) refuse_kind(kind);
  const AmountRange range = amount_range(*fault);
  const bool takes_amount = range.min < range.max;
  if (!takes_amount && amount != 0.0)
    throw ClientError(ExitStatus::kUsage, fmt::format("inject: {} takes no --amount", kind));
  if (!(amount >= range.min && amount <= range.max))
    throw ClientError(ExitStatus::kUsage,
                      fmt::format("inject: {}: --amount {} is out of range, {} to {} {} allowed", kind,
                                  amount, range.min, range.max, amount_unit(*fault)));
  if (takes_amount && amount == 0.0)
    throw ClientError(ExitStatus::kUsage, fmt::format("inject: {} needs --amount, {} to {} {}", kind,
                                                      range.min, range.max, amount_unit(*fault)));
  return {joint, *fault, amount, for_s};
}

void inject(Client& client, const Output& output, const InjectArguments& arguments) {
  inject_v1 message{};
  message.kind = static_cast<std::int32_t>(arguments.kind);
  message.for_s = arguments.for_s;
  message.amount = arguments.amount;
  const std::string name(to_text(arguments.kind));
  const Answer answer = client.request(arguments.joint, channel_kind::kInject, message);
  require_accepted(answer, arguments.joint, "injecting " + name);
  const std::string& joint = arguments.joint;
  const std::string text =
      arguments.kind == InjectedFault::kNone ? fmt::format("{}: every injected fault ended", joint)
      : arguments.for_s > 0.0
          ? fmt::format("{}: {} for {} s", joint, name, arguments.for_s)
          : fmt::format("{0}: {1}; to end it: strainwavectl inject {0} none", joint, name);
  say(output, text,
      {{"joint", joint}, {"injected", name}, {"for_s", arguments.for_s}, {"amount", arguments.amount}});
}

}  // namespace strainwave
