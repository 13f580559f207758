// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/reading_doubt.h"

#include <fmt/format.h>

#include "lcmtypes/oscillation_evidence.h"

namespace strainwave {

namespace {

std::string doubt_words(std::int64_t number) {
  const std::int64_t size_urad = number & kMostDoubted_urad;
  const std::string size = fmt::format("{:.6g} rad{}", 1e-6 * static_cast<double>(size_urad),
                                       size_urad == kMostDoubted_urad ? " or more" : "");
  switch (static_cast<ReadingDoubt>(number >> 24)) {
    case ReadingDoubt::kNone:
      break;
    case ReadingDoubt::kPositionNotFinite:
      return "the position is not a number";
    case ReadingDoubt::kVelocityNotFinite:
      return "the velocity is not a number";
    case ReadingDoubt::kTorqueNotFinite:
      return "the torque is not a number";
    case ReadingDoubt::kJump:
      return fmt::format("the position jumped by {} from one reading to the next", size);
    case ReadingDoubt::kStuck:
      return fmt::format("the position stands still though the torque must have moved the joint by {}", size);
    case ReadingDoubt::kCountsMissing:
      return "counts of the encoder are missing or wrong";
  }
  return "";
}

}  // namespace

std::string fault_words(Fault fault, std::int64_t drive_error) {
  std::string words(to_text(fault));
  if (!has_own_finding(fault) || drive_error <= 0 || drive_error > 0xFFFFFFFF) return words;
  if (fault == Fault::kChatter) return words + ": " + evidence_words(static_cast<std::uint32_t>(drive_error));
  const std::string doubt = doubt_words(drive_error);
  return doubt.empty() ? words : words + ": " + doubt;
}

}  // namespace strainwave
