// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/web_page.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/input_error.h"
#include "base/text_file.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

namespace {

constexpr const char* kHtml = "text/html; charset=utf-8";
constexpr const char* kCss = "text/css; charset=utf-8";
constexpr const char* kScript = "text/javascript; charset=utf-8";
constexpr std::array<std::pair<const char*, const char*>, 11> kFiles{{
    {"index.html", kHtml},
    {"bench.css", kCss},
    {"uPlot.min.css", kCss},
    {"main.js", kScript},
    {"connection.js", kScript},
    {"history.js", kScript},
    {"plots.js", kScript},
    {"recording.js", kScript},
    {"table.js", kScript},
    {"uPlot.esm.js", kScript},
    {"fzstd.mjs", kScript},
}};

template <typename Number>
nlohmann::ordered_json words_of(Number number) {
  return {{"text", to_text(number)}, {"key", configuration_key(number)}};
}

}  // namespace

WebPage::WebPage() {
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (unknown) return;
  const std::filesystem::path folder = program.parent_path().parent_path() / "share/strainwave/web";
  for (const auto& [name, type] : kFiles) {
    try {
      files_["/" + std::string(name)] = {type,
                                         std::make_shared<const std::string>(read_text_file(folder / name))};
    } catch (const InputError&) {
      // Not installed: the request for it is answered with 404.
    }
  }
  if (const auto index = files_.find("/index.html"); index != files_.end()) files_["/"] = index->second;
  files_["/vocabulary.json"] = {"application/json", std::make_shared<const std::string>(vocabulary_json())};
}

const WebPage::File* WebPage::find(std::string_view path) const {
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second;
}

std::string vocabulary_json() {
  nlohmann::ordered_json faults;
  for (std::int32_t number = 1; to_text(static_cast<Fault>(number)) != to_text(static_cast<Fault>(-1));
       ++number)
    faults[std::to_string(number)] = words_of(static_cast<Fault>(number));
  nlohmann::ordered_json notices;
  for (std::uint32_t bit = 1; bit < 1U << 31U; bit <<= 1U)
    if (const auto notice = static_cast<Notice>(bit); to_text(notice) != to_text(static_cast<Notice>(0)))
      notices[std::to_string(bit)] = words_of(notice);
  return nlohmann::ordered_json{{"faults", faults}, {"notices", notices}}.dump();
}

}  // namespace strainwave
