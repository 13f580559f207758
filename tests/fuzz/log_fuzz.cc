// SPDX-License-Identifier: BSD-3-Clause
// Each byte of any event log belongs to one event or is skipped. Strainwave's messages become CSV and JSON.
#include <strainwave/state_v1.hpp>

#include "base/input_error.h"
#include "client/text/message_csv.h"
#include "client/text/state_csv.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/message_json.h"
#include "lcmtypes/message_kinds.h"
#include "lcmtypes/wire.h"
#include "tests/fuzz/fuzz_file.h"

namespace {

constexpr std::size_t kHeaderBytes = 28;

void show(const strainwave::LogEvent& event) {
  using namespace strainwave;
  const auto name = parse_channel(event.channel);
  if (!name) return;
  (void)visit_message(name->kind, event.data,
                      [](const auto& message) { STRAINWAVE_FUZZ_CHECK(!message_json(message).empty()); });
  if (const auto state = decode_exactly<state_v1>(event.data))
    STRAINWAVE_FUZZ_CHECK(!state_csv_values(*state, weights_in_use(*state)).empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  const fuzz::FuzzFile file(data, size);
  try {
    EventLogReader reader(file.path());
    std::uint64_t read = 0;
    for (LogEvent event; reader.next(event);) {
      STRAINWAVE_FUZZ_CHECK(!event.channel.empty() && event.channel.size() <= kMaxChannelLength);
      read += kHeaderBytes + event.channel.size() + event.data.size();
      show(event);
    }
    const std::uint64_t told = read + reader.damage().skipped_bytes;
    STRAINWAVE_FUZZ_CHECK(reader.truncated() ? told < size : told == size);
    STRAINWAVE_FUZZ_CHECK((reader.damage().places > 0) == (reader.damage().skipped_bytes > 0));
  } catch (const InputError&) {
    // The log has no event.
  }
  return 0;
}
