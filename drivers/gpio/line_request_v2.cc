// SPDX-License-Identifier: BSD-3-Clause
// libgpiod 2.x.
#include <gpiod.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "drivers/gpio/line_request.h"

namespace strainwave {

namespace {

constexpr std::size_t kMaxLines = 32;

template <auto Free>
struct Freer {
  template <typename T>
  void operator()(T* object) const noexcept {
    Free(object);
  }
};
using Chip = std::unique_ptr<gpiod_chip, Freer<&::gpiod_chip_close>>;
using ChipInfo = std::unique_ptr<gpiod_chip_info, Freer<&::gpiod_chip_info_free>>;
using Info = std::unique_ptr<gpiod_line_info, Freer<&::gpiod_line_info_free>>;
using LineSettings = std::unique_ptr<gpiod_line_settings, Freer<&::gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, Freer<&::gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, Freer<&::gpiod_request_config_free>>;
using Request = std::unique_ptr<gpiod_line_request, Freer<&::gpiod_line_request_release>>;

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

template <typename Pointer>
Pointer require(Pointer pointer, const std::string& what) {
  if (!pointer) fail(what);
  return pointer;
}

Chip open_chip(const std::string& path) {
  return require(Chip(::gpiod_chip_open(path.c_str())), path);
}

ChipInfo info_of(const Chip& chip, const std::string& path) {
  return require(ChipInfo(::gpiod_chip_get_info(chip.get())), path);
}

std::string text_or_empty(const char* text) {
  return text == nullptr ? std::string() : std::string(text);
}

gpiod_line_direction direction_of(LineDirection direction) {
  switch (direction) {
    case LineDirection::kAsIs:
      return GPIOD_LINE_DIRECTION_AS_IS;
    case LineDirection::kInput:
      return GPIOD_LINE_DIRECTION_INPUT;
    case LineDirection::kOutput:
      return GPIOD_LINE_DIRECTION_OUTPUT;
  }
  return GPIOD_LINE_DIRECTION_INPUT;
}

gpiod_line_bias bias_of(LineBias bias) {
  switch (bias) {
    case LineBias::kAsIs:
      return GPIOD_LINE_BIAS_AS_IS;
    case LineBias::kOff:
      return GPIOD_LINE_BIAS_DISABLED;
    case LineBias::kPullUp:
      return GPIOD_LINE_BIAS_PULL_UP;
    case LineBias::kPullDown:
      return GPIOD_LINE_BIAS_PULL_DOWN;
  }
  return GPIOD_LINE_BIAS_AS_IS;
}

}  // namespace

std::string chip_label(const std::string& path) {
  return text_or_empty(::gpiod_chip_info_get_label(info_of(open_chip(path), path).get()));
}

std::vector<LineInfo> list_lines(const std::string& path) {
  const Chip chip = open_chip(path);
  const std::size_t count = ::gpiod_chip_info_get_num_lines(info_of(chip, path).get());
  std::vector<LineInfo> lines;
  for (unsigned offset = 0; offset < count; ++offset) {
    const Info info = require(Info(::gpiod_chip_get_line_info(chip.get(), offset)),
                              path + " line " + std::to_string(offset));
    lines.push_back({offset, text_or_empty(::gpiod_line_info_get_name(info.get())),
                     text_or_empty(::gpiod_line_info_get_consumer(info.get())),
                     ::gpiod_line_info_is_used(info.get()),
                     ::gpiod_line_info_get_direction(info.get()) == GPIOD_LINE_DIRECTION_OUTPUT,
                     ::gpiod_line_info_is_active_low(info.get())});
  }
  return lines;
}

struct LineRequest::Handle {
  Request request;
  std::size_t count = 0;
  std::array<gpiod_line_value, kMaxLines> values{};
};

LineRequest::LineRequest(const Settings& settings) : handle_(std::make_unique<Handle>()) {
  const std::string& path = settings.chip_path;
  const Chip chip = open_chip(path);
  const LineSettings line = require(LineSettings(::gpiod_line_settings_new()), path);
  const LineConfig lines = require(LineConfig(::gpiod_line_config_new()), path);
  const RequestConfig request = require(RequestConfig(::gpiod_request_config_new()), path);
  ::gpiod_line_settings_set_active_low(line.get(), settings.active_low);
  if (::gpiod_line_settings_set_direction(line.get(), direction_of(settings.direction)) != 0 ||
      ::gpiod_line_settings_set_bias(line.get(), bias_of(settings.bias)) != 0 ||
      ::gpiod_line_settings_set_output_value(line.get(), GPIOD_LINE_VALUE_INACTIVE) != 0 ||
      ::gpiod_line_config_add_line_settings(lines.get(), settings.offsets.data(), settings.offsets.size(),
                                            line.get()) != 0)
    fail(path);
  ::gpiod_request_config_set_consumer(request.get(), settings.consumer.c_str());
  handle_->request =
      require(Request(::gpiod_chip_request_lines(chip.get(), request.get(), lines.get())), path);
  handle_->count = settings.offsets.size();
}

LineRequest::LineRequest(LineRequest&&) noexcept = default;
LineRequest::~LineRequest() = default;

bool LineRequest::read(std::uint32_t& active) noexcept {
  if (::gpiod_line_request_get_values(handle_->request.get(), handle_->values.data()) != 0) return false;
  active = 0;
  for (std::size_t i = 0; i < handle_->count; ++i)
    if (handle_->values[i] == GPIOD_LINE_VALUE_ACTIVE) active |= 1U << i;
  return true;
}

bool LineRequest::write(std::uint32_t active) noexcept {
  for (std::size_t i = 0; i < handle_->count; ++i)
    handle_->values[i] = (active & (1U << i)) != 0 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
  return ::gpiod_line_request_set_values(handle_->request.get(), handle_->values.data()) == 0;
}

}  // namespace strainwave
