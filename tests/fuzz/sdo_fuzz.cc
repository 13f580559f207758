// SPDX-License-Identifier: BSD-3-Clause
// With any answers of a drive, an SDO transfer ends within bounds and sends only well-formed requests.
#include <vector>

#include "drivers/can/canopen/canopen_sdo.h"
#include "tests/fuzz/fuzz_input.h"

namespace strainwave::fuzz {
namespace {

using canopen::SdoTransfer;

constexpr std::uint8_t kNode = 3;
constexpr std::uint32_t kAnswerId = 0x583;
constexpr std::uint32_t kRequestId = 0x603;

SdoTransfer begin(FuzzInput& input) {
  const std::uint8_t kind = input.byte();
  const canopen::Entry entry{static_cast<std::uint16_t>(input.number(2)), input.byte()};
  if ((kind & 1U) == 0) return SdoTransfer::upload(kNode, entry);
  std::vector<std::uint8_t> value(1 + (kind >> 1U) % 32);
  for (std::uint8_t& byte : value) byte = input.byte();
  return SdoTransfer::download(kNode, entry, value);
}

void check_request(const CanFrame& request) {
  STRAINWAVE_FUZZ_CHECK(request.id == kRequestId);
  STRAINWAVE_FUZZ_CHECK(request.size == kMaxCanBytes);
}

}  // namespace
}  // namespace strainwave::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave::fuzz;
  FuzzInput input(data, size);
  SdoTransfer transfer = begin(input);
  check_request(transfer.request());
  while (!input.empty() && transfer.state() == SdoTransfer::State::kBusy) {
    const SdoTransfer::Action action = transfer.answer(input.frame(kAnswerId));
    if (action == SdoTransfer::Action::kSend || action == SdoTransfer::Action::kAbort)
      check_request(transfer.request());
    const bool ended = action == SdoTransfer::Action::kFinish || action == SdoTransfer::Action::kAbort;
    STRAINWAVE_FUZZ_CHECK(ended == (transfer.state() != SdoTransfer::State::kBusy));
    STRAINWAVE_FUZZ_CHECK(transfer.value().size() <= strainwave::canopen::kMaxSdoBytes);
  }
  return 0;
}
