// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/edge_events.h"

#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>

#include "base/input_error.h"

namespace strainwave {

namespace {

std::uint64_t flags_of(const LineOptions& line, EdgeKind kind) {
  // With active-low lines the kernel reports the edge to active as rising, too.
  std::uint64_t flags = GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_EDGE_RISING;
  if (kind == EdgeKind::kBoth) flags |= GPIO_V2_LINE_FLAG_EDGE_FALLING;
  if (line.active_low) flags |= GPIO_V2_LINE_FLAG_ACTIVE_LOW;
  switch (line.bias) {
    case LineBias::kAsIs:
      break;
    case LineBias::kOff:
      flags |= GPIO_V2_LINE_FLAG_BIAS_DISABLED;
      break;
    case LineBias::kPullUp:
      flags |= GPIO_V2_LINE_FLAG_BIAS_PULL_UP;
      break;
    case LineBias::kPullDown:
      flags |= GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN;
      break;
  }
  return flags;
}

UniqueFd request(const std::string& chip_path, gpio_v2_line_request& request, const std::string& where) {
  const UniqueFd chip(::open(chip_path.c_str(), O_RDWR | O_CLOEXEC));
  if (!chip || ::ioctl(chip.get(), GPIO_V2_GET_LINE_IOCTL, &request) < 0) {
    const int error = errno;
    throw InputError(where + ": edges of " + chip_path +
                     " cannot be requested: " + std::generic_category().message(error) +
                     (error == EBUSY ? ": see who holds the lines with strainwavectl gpio-check"
                                     : ": the chip must raise interrupts, and the kernel be 5.10 or newer"));
  }
  ::fcntl(request.fd, F_SETFL, ::fcntl(request.fd, F_GETFL) | O_NONBLOCK);
  return UniqueFd(request.fd);
}

}  // namespace

EdgeEvents::EdgeEvents(std::span<const LineOptions> lines, EdgeKind kind, const std::string& consumer,
                       const std::string& where) {
  gpio_v2_line_request wanted{};
  const LineOptions& first = lines.front();
  std::string chip_path;
  for (const LineOptions& line : lines) {
    const LinePlace place = find_line(line, where);
    if (place.info.held) throw InputError(where, "line", line.line, describe_holder(place.info));
    if (!chip_path.empty() &&
        (place.chip_path != chip_path || line.bias != first.bias || line.active_low != first.active_low))
      throw InputError(where, "chip", line.chip,
                       "both lines of an encoder must be on one chip, with the same active and bias");
    chip_path = place.chip_path;
    wanted.offsets[wanted.num_lines++] = place.offset;
    offsets_.push_back(place.offset);
  }
  wanted.config.flags = flags_of(first, kind);
  if (first.debounce_s > 0.0) {
    // The debounce time of the first line applies to all lines.
    gpio_v2_line_config_attribute& attribute = wanted.config.attrs[wanted.config.num_attrs++];
    attribute.attr.id = GPIO_V2_LINE_ATTR_ID_DEBOUNCE;
    attribute.attr.debounce_period_us = static_cast<std::uint32_t>(std::lround(first.debounce_s * 1e6));
    attribute.mask = (1ULL << lines.size()) - 1;
  }
  wanted.event_buffer_size = kKernelBuffer;
  std::strncpy(wanted.consumer, consumer.c_str(), sizeof wanted.consumer - 1);
  fd_ = request(chip_path, wanted, where);
}

int EdgeEvents::read(std::span<Edge> edges) noexcept {
  std::array<gpio_v2_line_event, kReadAtOnce> events;
  const std::size_t most = std::min(edges.size(), events.size());
  const ssize_t size = ::read(fd_.get(), events.data(), most * sizeof(gpio_v2_line_event));
  if (size < 0) return errno == EAGAIN || errno == EINTR ? 0 : -1;
  const std::size_t count = static_cast<std::size_t>(size) / sizeof(gpio_v2_line_event);
  for (std::size_t i = 0; i < count; ++i) {
    const auto line = std::find(offsets_.begin(), offsets_.end(), events[i].offset);
    edges[i] = {static_cast<std::int64_t>(events[i].timestamp_ns), events[i].seqno,
                static_cast<std::uint32_t>(line - offsets_.begin()),
                events[i].id == GPIO_V2_LINE_EVENT_RISING_EDGE};
  }
  return static_cast<int>(count);
}

bool EdgeEvents::levels(std::uint32_t& active) noexcept {
  gpio_v2_line_values values{};
  values.mask = (1ULL << offsets_.size()) - 1;
  if (::ioctl(fd_.get(), GPIO_V2_LINE_GET_VALUES_IOCTL, &values) < 0) return false;
  active = static_cast<std::uint32_t>(values.bits);
  return true;
}

}  // namespace strainwave
