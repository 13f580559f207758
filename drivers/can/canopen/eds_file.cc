#include "drivers/can/canopen/eds_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <limits>

#include "base/input_error.h"
#include "base/text_file.h"

namespace strainwave::canopen {

namespace {

using Section = std::map<std::string, std::string>;

constexpr std::size_t kMaxBytes = 4U << 20U;
constexpr std::uint16_t kFirstIndex = 0x1000;
/// An array that lists no sub-entries of its own has at most so many.
constexpr std::int64_t kMaxCompact = 254;

struct Type {
  std::uint16_t number;
  std::size_t bytes;
  bool is_signed;
};
/// CiA 301, table 44; what is not here is text or data.
constexpr std::array kTypes{Type{0x01, 1, false}, Type{0x02, 1, true},  Type{0x03, 2, true},
                            Type{0x04, 4, true},  Type{0x05, 1, false}, Type{0x06, 2, false},
                            Type{0x07, 4, false}, Type{0x08, 4, false}, Type{0x15, 8, true},
                            Type{0x1B, 8, false}};

std::string_view trimmed(std::string_view text) {
  const auto space = [](char letter) { return std::isspace(static_cast<unsigned char>(letter)) != 0; };
  while (!text.empty() && space(text.front())) text.remove_prefix(1);
  while (!text.empty() && space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return result;
}

/// Decimal, 0x hexadecimal, or 0 octal, as the standard has it; with a sign.
std::optional<std::int64_t> plain_number(std::string_view text) {
  text = trimmed(text);
  const bool negative = !text.empty() && text.front() == '-';
  if (negative) text.remove_prefix(1);
  int base = 10;
  if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
    base = 16;
    text.remove_prefix(2);
  } else if (text.size() > 1 && text[0] == '0') {
    base = 8;
  }
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  const auto value = static_cast<std::int64_t>(number);
  return negative ? -value : value;
}

/// A number, or one with the node id added: "$NODEID+0x180".
std::optional<std::int64_t> number_of(std::string_view text, std::uint8_t node_id) {
  std::int64_t sum = 0;
  for (std::string_view rest = trimmed(text); !rest.empty();) {
    const std::size_t plus = std::min(rest.find('+'), rest.size());
    const std::string_view term = trimmed(rest.substr(0, plus));
    const auto number = lower(term) == "$nodeid" ? std::optional<std::int64_t>(node_id) : plain_number(term);
    if (!number) return std::nullopt;
    sum += *number;
    rest.remove_prefix(std::min(plus + 1, rest.size()));
  }
  return sum;
}

class Reader {
 public:
  Reader(std::string file, std::uint8_t node_id) : node_id_(node_id) { result_.file = std::move(file); }

  EdsFile read(std::string_view text) {
    if (text.size() > kMaxBytes)
      throw InputError(result_.file + ": more than 4 MiB is no electronic data sheet");
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      take(trimmed(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    finish_section();
    if (result_.entries.empty())
      throw InputError(result_.file + ": has no objects: it is no electronic data sheet");
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(result_.file + ": line " + std::to_string(line_) + ": " + what);
  }

  void take(std::string_view line) {
    if (line.empty() || line.front() == ';' || line.front() == '#') return;
    if (line.front() == '[') {
      finish_section();
      if (line.back() != ']') fail("a section's name ends with ]");
      section_name_ = lower(trimmed(line.substr(1, line.size() - 2)));
      section_line_ = line_;
      return;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) fail("a section, key=value or ;comment is allowed");
    if (section_name_.empty()) fail("a key before the first section");
    const std::string key = lower(trimmed(line.substr(0, equals)));
    if (!section_.emplace(key, trimmed(line.substr(equals + 1))).second) fail("key " + key + " stands twice");
  }

  // [1018] and [1018sub1] are objects; what else there is (file and device information, lists) is not needed.
  void finish_section() {
    const Section section = std::move(section_);
    section_.clear();
    const std::string name = std::move(section_name_);
    section_name_.clear();
    const std::size_t sub = name.find("sub");
    const auto index = hexadecimal(std::string_view(name).substr(0, std::min(sub, name.size())));
    if (!index || *index < kFirstIndex || *index > 0xFFFF) return;
    std::optional<std::uint32_t> sub_index = 0;
    if (sub != std::string::npos) sub_index = hexadecimal(std::string_view(name).substr(sub + 3));
    if (!sub_index || *sub_index > 0xFF) return;
    add({static_cast<std::uint16_t>(*index), static_cast<std::uint8_t>(*sub_index)}, section,
        sub != std::string::npos);
  }

  static std::optional<std::uint32_t> hexadecimal(std::string_view text) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
  }

  void add(Entry entry, const Section& section, bool is_sub_entry) {
    const auto text = [&](const char* key) {
      const auto found = section.find(key);
      return found == section.end() ? std::string() : found->second;
    };
    if (const std::string compact = text("compactsubobj"); !compact.empty()) {
      const auto count = plain_number(compact);
      if (!count || *count < 0 || *count > kMaxCompact) fail_in_section("CompactSubObj", compact);
      for (std::int64_t i = 0; i <= *count; ++i)
        keep({entry.index, static_cast<std::uint8_t>(i)}, section, text("datatype"));
      return;
    }
    // The head of a record or array; its sub-entries have sections of their own.
    if (!is_sub_entry && text("datatype").empty()) return;
    keep(entry, section, text("datatype"));
  }

  void keep(Entry key, const Section& section, const std::string& type_text) {
    const auto text = [&](const char* name) {
      const auto found = section.find(name);
      return found == section.end() ? std::string() : found->second;
    };
    EdsEntry entry;
    entry.name = text("parametername");
    const auto type = plain_number(type_text);
    if (!type) fail_in_section("DataType", type_text);
    const auto known = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&](const Type& candidate) { return candidate.number == *type; });
    if (known != kTypes.end()) {
      entry.bytes = known->bytes;
      entry.is_signed = known->is_signed;
    }
    set_access(entry, lower(text("accesstype")));
    entry.mappable = text("pdomapping") == "1";
    const auto number = [&](const char* name) -> std::optional<std::int64_t> {
      const std::string value = text(name);
      if (value.empty() || entry.bytes == 0) return std::nullopt;
      const auto found = number_of(value, node_id_);
      if (!found) fail_in_section(name, value);
      return found;
    };
    // A REAL32's default is a decimal fraction, which nothing here needs.
    const bool is_real = *type == 0x08;
    if (!is_real) {
      entry.value = number("defaultvalue");
      entry.low = number("lowlimit");
      entry.high = number("highlimit");
    }
    if (!result_.entries.emplace(key, entry).second)
      fail_in_section("object", to_text(key) + " stands twice");
  }

  void set_access(EdsEntry& entry, const std::string& access) {
    if (access == "rw" || access == "rwr" || access == "rww") {
      entry.writable = true;
    } else if (access == "wo") {
      entry.writable = true;
      entry.readable = false;
    } else if (access != "ro" && access != "const") {
      fail_in_section("AccessType", access);
    }
  }

  [[noreturn]] void fail_in_section(const std::string& key, const std::string& value) const {
    throw InputError(result_.file + ": the section that begins in line " + std::to_string(section_line_) +
                     ": " + key + " = '" + value + "' is none");
  }

  std::uint8_t node_id_;
  EdsFile result_;
  Section section_;
  std::string section_name_;
  int line_ = 0;
  int section_line_ = 0;
};

}  // namespace

const EdsEntry* EdsFile::find(Entry entry) const noexcept {
  const auto found = entries.find(entry);
  return found == entries.end() ? nullptr : &found->second;
}

bool EdsFile::has_index(std::uint16_t index) const noexcept {
  const auto found = entries.lower_bound({index, 0});
  return found != entries.end() && found->first.index == index;
}

EdsFile parse_eds(const std::string& file, std::string_view text, std::uint8_t node_id) {
  return Reader(file, node_id).read(text);
}

EdsFile read_eds(const std::filesystem::path& path, std::uint8_t node_id) {
  return parse_eds(path.string(), read_text_file(path), node_id);
}

}  // namespace strainwave::canopen
