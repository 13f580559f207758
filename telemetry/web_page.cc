// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/web_page.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/input_error.h"
#include "base/text_file.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

/// The MIME type of a file. Empty: the file is not served.
std::string_view type_of(const std::filesystem::path& file) {
  const std::filesystem::path extension = file.extension();
  if (extension == ".html") return "text/html; charset=utf-8";
  if (extension == ".css") return "text/css; charset=utf-8";
  if (extension == ".js" || extension == ".mjs") return "text/javascript; charset=utf-8";
  return "";
}

template <typename Number>
nlohmann::ordered_json words_of(Number number) {
  return {{"text", to_text(number)}, {"key", configuration_key(number)}};
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

}  // namespace

WebPage::WebPage(bool acting) {
  std::error_code absent;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", absent);
  const std::filesystem::path folder = program.parent_path().parent_path() / "share/strainwave/web";
  for (const auto& entry : std::filesystem::directory_iterator(folder, absent)) {
    const std::string_view type = type_of(entry.path());
    if (type.empty() || (!acting && entry.path().filename() == "acting.js")) continue;
    try {
      files_["/" + entry.path().filename().string()] = {std::string(type),
                                                        shared_text(read_text_file(entry.path()))};
    } catch (const InputError&) {
      // The file is unreadable. A request for it is answered with 404.
    }
  }
  if (const auto index = files_.find("/index.html"); index != files_.end()) files_["/"] = index->second;
  files_["/vocabulary.json"] = {"application/json", shared_text(vocabulary_json())};
}

const WebPage::File* WebPage::find(std::string_view path) const {
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace strainwave
