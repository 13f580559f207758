// SPDX-License-Identifier: BSD-3-Clause
// The abort codes of CiA 301 v4.2.0, table 22.
#include <array>

#include "drivers/can/canopen/canopen_sdo.h"

namespace strainwave::canopen {

namespace {

struct AbortText {
  std::uint32_t code;
  std::string_view text;
};

constexpr std::array kAbortTexts{
    AbortText{0x05030000, "toggle bit not alternated"},
    AbortText{0x05040000, "no answer in time"},
    AbortText{0x05040001, "command unknown or not valid"},
    AbortText{0x05040002, "block size not valid"},
    AbortText{0x05040003, "sequence number not valid"},
    AbortText{0x05040004, "checksum wrong"},
    AbortText{0x05040005, "out of memory"},
    AbortText{0x06010000, "access not supported"},
    AbortText{0x06010001, "write-only"},
    AbortText{0x06010002, "read-only"},
    AbortText{0x06020000, "no such object"},
    AbortText{0x06040041, "cannot be mapped into a PDO"},
    AbortText{0x06040042, "longer than a PDO"},
    AbortText{0x06040043, "parameters do not fit each other"},
    AbortText{0x06040047, "drive incompatible inside"},
    AbortText{0x06060000, "hardware error"},
    AbortText{0x06070010, "wrong length"},
    AbortText{0x06070012, "too long"},
    AbortText{0x06070013, "too short"},
    AbortText{0x06090011, "no such sub-index"},
    AbortText{0x06090030, "value not allowed"},
    AbortText{0x06090031, "value too high"},
    AbortText{0x06090032, "value too low"},
    AbortText{0x06090036, "maximum below minimum"},
    AbortText{0x060A0023, "resource not available"},
    AbortText{0x08000000, "general error"},
    AbortText{0x08000020, "cannot be stored"},
    AbortText{0x08000021, "cannot be stored because of local control"},
    AbortText{0x08000022, "not possible in the drive's present state"},
    AbortText{0x08000023, "object dictionary missing"},
    AbortText{0x08000024, "no data"},
};

}  // namespace

std::string_view sdo_abort_text(std::uint32_t code) noexcept {
  for (const AbortText& entry : kAbortTexts)
    if (entry.code == code) return entry.text;
  return "a code of the vendor's";
}

}  // namespace strainwave::canopen
