// SPDX-License-Identifier: BSD-3-Clause
// Helpers of admission: verdicts that refuse, repeat or discard a message, and access to its bytes. Not real-time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include "daemon/admission/admission.h"

namespace strainwave {

/// The bytes of a message that the gateway wrote. Its stated size is not trusted.
inline std::span<const std::uint8_t> payload(const WireMessage& message) {
  return {message.bytes.data(), std::min<std::size_t>(message.size, message.bytes.size())};
}

/// A refusal, answered with its reason.
inline Verdict refuse(const Requester& requester, Reason reason, const std::string& text) {
  Verdict verdict;
  verdict.kind = Verdict::Kind::kRefuse;
  verdict.reason = reason;
  verdict.text = text;
  verdict.requester = requester;
  return verdict;
}

/// A resend, answered as before.
inline Verdict repeat(const Requester& requester) {
  Verdict verdict;
  verdict.kind = Verdict::Kind::kRepeat;
  verdict.reason = Reason::kOldSequence;
  verdict.requester = requester;
  return verdict;
}

/// Counted, and not answered: the sender is unknown.
inline Verdict discard(Reason reason) {
  Verdict verdict;
  verdict.reason = reason;
  return verdict;
}

}  // namespace strainwave
