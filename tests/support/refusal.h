// SPDX-License-Identifier: BSD-3-Clause
// Checks the messages of refused calls.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "base/input_error.h"

namespace strainwave::testing {

/// Message of the `Error` that `call` throws, or "accepted". Any other exception fails the test.
template <typename Error = InputError, typename Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

/// Expects every one of `parts` in `text`.
inline void expect_mentions(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

}  // namespace strainwave::testing
