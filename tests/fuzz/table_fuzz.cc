// SPDX-License-Identifier: BSD-3-Clause
// Any gain table, as JSON or as a message, is refused, or is the same after it is written and read again.
#include <span>
#include <string>
#include <string_view>

#include "base/input_error.h"
#include "control/table/gain_table_json.h"
#include "lcmtypes/gain_table_message.h"
#include "lcmtypes/wire.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

void check(const strainwave::GainTable& table) {
  using namespace strainwave;
  const std::string json = to_json(table);
  STRAINWAVE_FUZZ_CHECK(to_json(gain_table_from_json(json, "written.json")) == json);
  STRAINWAVE_FUZZ_CHECK(to_json(to_gain_table(to_message(table))) == json);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    if (const auto message = decode_exactly<gain_table_v1>(std::span(data, size))) {
      const GainTable table = to_gain_table(*message);
      if (!find_defect(table)) check(table);
    } else {
      check(gain_table_from_json(text, "table.json"));
    }
  } catch (const InputError&) {
    // Refused, which is right for most inputs.
  }
  return 0;
}
