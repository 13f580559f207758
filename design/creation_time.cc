// SPDX-License-Identifier: BSD-3-Clause
#include "design/creation_time.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <string_view>
#include <system_error>

#include "base/input_error.h"

namespace strainwave {

namespace {

std::time_t creation_time() {
  constexpr const char* kVariable = "SOURCE_DATE_EPOCH";
  const char* const epoch = std::getenv(kVariable);  // NOLINT(concurrency-mt-unsafe): one thread
  if (epoch == nullptr) return std::time(nullptr);
  const std::string_view text(epoch);
  std::time_t time = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError("environment", kVariable, epoch, "must be whole seconds since 1970");
  return time;
}

}  // namespace

std::string utc_now() {
  const std::time_t now = creation_time();
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace strainwave
