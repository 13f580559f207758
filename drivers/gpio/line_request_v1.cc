// SPDX-License-Identifier: BSD-3-Clause
// libgpiod 1.6.
#include <gpiod.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "drivers/gpio/line_request.h"

namespace strainwave {

namespace {

struct ChipCloser {
  void operator()(gpiod_chip* chip) const noexcept { ::gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, ChipCloser>;

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

Chip open_chip(const std::string& path) {
  Chip chip(::gpiod_chip_open(path.c_str()));
  if (!chip) fail(path);
  return chip;
}

std::string text_or_empty(const char* text) {
  return text == nullptr ? std::string() : std::string(text);
}

int request_type(LineDirection direction) {
  switch (direction) {
    case LineDirection::kAsIs:
      return GPIOD_LINE_REQUEST_DIRECTION_AS_IS;
    case LineDirection::kInput:
      return GPIOD_LINE_REQUEST_DIRECTION_INPUT;
    case LineDirection::kOutput:
      return GPIOD_LINE_REQUEST_DIRECTION_OUTPUT;
  }
  return GPIOD_LINE_REQUEST_DIRECTION_INPUT;
}

int bias_flag(LineBias bias) {
  switch (bias) {
    case LineBias::kAsIs:
      return 0;
    case LineBias::kOff:
      return GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE;
    case LineBias::kPullUp:
      return GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
    case LineBias::kPullDown:
      return GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
  }
  return 0;
}

}  // namespace

std::string chip_label(const std::string& path) {
  return text_or_empty(::gpiod_chip_label(open_chip(path).get()));
}

std::vector<LineInfo> list_lines(const std::string& path) {
  const Chip chip = open_chip(path);
  std::vector<LineInfo> lines;
  for (unsigned offset = 0; offset < ::gpiod_chip_num_lines(chip.get()); ++offset) {
    gpiod_line* line = ::gpiod_chip_get_line(chip.get(), offset);
    if (line == nullptr) fail(path + " line " + std::to_string(offset));
    lines.push_back({offset, text_or_empty(::gpiod_line_name(line)),
                     text_or_empty(::gpiod_line_consumer(line)), ::gpiod_line_is_used(line),
                     ::gpiod_line_direction(line) == GPIOD_LINE_DIRECTION_OUTPUT,
                     ::gpiod_line_active_state(line) == GPIOD_LINE_ACTIVE_STATE_LOW});
  }
  return lines;
}

struct LineRequest::Handle {
  Chip chip;
  gpiod_line_bulk lines;
  std::array<int, GPIOD_LINE_BULK_MAX_LINES> values{};
};

LineRequest::LineRequest(const Settings& settings) : handle_(std::make_unique<Handle>()) {
  handle_->chip = open_chip(settings.chip_path);
  ::gpiod_line_bulk_init(&handle_->lines);
  for (const unsigned offset : settings.offsets) {
    gpiod_line* line = ::gpiod_chip_get_line(handle_->chip.get(), offset);
    if (line == nullptr) fail(settings.chip_path + " line " + std::to_string(offset));
    ::gpiod_line_bulk_add(&handle_->lines, line);
  }
  const gpiod_line_request_config config{
      settings.consumer.c_str(), request_type(settings.direction),
      bias_flag(settings.bias) | (settings.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0)};
  if (::gpiod_line_request_bulk(&handle_->lines, &config, handle_->values.data()) != 0)
    fail(settings.chip_path);
}

LineRequest::LineRequest(LineRequest&&) noexcept = default;
// The destructor closes the chip, which releases the lines.
LineRequest::~LineRequest() = default;

bool LineRequest::read(std::uint32_t& active) noexcept {
  if (::gpiod_line_get_value_bulk(&handle_->lines, handle_->values.data()) != 0) return false;
  active = 0;
  for (unsigned i = 0; i < handle_->lines.num_lines; ++i)
    if (handle_->values[i] != 0) active |= 1U << i;
  return true;
}

bool LineRequest::write(std::uint32_t active) noexcept {
  for (unsigned i = 0; i < handle_->lines.num_lines; ++i)
    handle_->values[i] = (active & (1U << i)) != 0 ? 1 : 0;
  return ::gpiod_line_set_value_bulk(&handle_->lines, handle_->values.data()) == 0;
}

}  // namespace strainwave
