// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/canopen/eds_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <set>
#include <utility>

#include "base/input_error.h"
#include "base/text_file.h"

namespace strainwave::canopen {

namespace {

using Section = std::map<std::string, std::string>;

constexpr std::size_t kMaxBytes = 4U << 20U;
constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
/// Ctrl-Z, which old editors append to the file.
constexpr char kEndOfFile = '\x1A';
constexpr std::int64_t kMaxNodeId = 127;
constexpr std::uint16_t kFirstIndex = 0x1000;
/// ObjectType of a variable (CiA 306-1); arrays and records have other numbers.
constexpr std::int64_t kVariable = 7;
constexpr std::int64_t kReal32 = 0x08;
/// Maximum number of entries of an array without its own sub-entries (CompactSubObj).
constexpr std::int64_t kMaxCompact = 254;

struct Type {
  std::uint16_t number;
  std::size_t bytes;
  bool is_signed;
};
/// CiA 301, table 44; other types are text or data.
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

/// Reads a decimal, hexadecimal (0x) or octal (0) number with a sign, as in the standard. Some files pad decimal numbers: 08 is 8.
std::optional<std::int64_t> plain_number(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const bool hexadecimal = text.starts_with("0x");
  if (hexadecimal) text.remove_prefix(2);
  const bool octal = text.starts_with('0') && text.find_first_not_of("01234567") == std::string_view::npos;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number,
                                            hexadecimal ? 16
                                            : octal     ? 8
                                                        : 10);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return static_cast<std::int64_t>(negative ? 0 - number : number);
}

/// Reads a number or a sum of numbers: "$NODEID+0x180".
std::optional<std::int64_t> number_of(std::string_view text, std::uint8_t node_id) {
  const std::string small = lower(text);
  std::uint64_t sum = 0;
  std::string_view rest = small;
  do {
    const std::size_t plus = std::min(rest.find('+'), rest.size());
    const std::string_view term = trimmed(rest.substr(0, plus));
    const auto number = term == "$nodeid" ? std::optional<std::int64_t>(node_id) : plain_number(term);
    if (!number) return std::nullopt;
    sum += static_cast<std::uint64_t>(*number);
    rest.remove_prefix(std::min(plus + 1, rest.size()));
  } while (!rest.empty());
  return static_cast<std::int64_t>(sum);
}

/// Returns the number of this type with the same bits: as signed, 0x8000 is -32768; as unsigned, -1 is
/// 0xFFFF. Returns nothing when the type is too small.
std::optional<std::int64_t> fitted(std::int64_t number, std::size_t bytes, bool is_signed) {
  if (bytes >= sizeof number) return number;
  const std::int64_t span = std::int64_t{1} << (8 * bytes);
  if (number < -span / 2 || number >= span) return std::nullopt;
  if (is_signed) return number >= span / 2 ? number - span : number;
  return number < 0 ? number + span : number;
}

/// The section of an object or of one of its entries: "1018", "1018sub1", "1018value".
struct SectionName {
  std::uint16_t index = 0;
  std::string_view suffix;
};
std::optional<std::uint32_t> parse_hexadecimal(std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}
std::optional<SectionName> object_section(std::string_view name) {
  constexpr std::size_t kDigits = 4;
  const auto index = parse_hexadecimal(name.substr(0, kDigits));
  if (name.size() < kDigits || !index || *index < kFirstIndex) return std::nullopt;
  return SectionName{static_cast<std::uint16_t>(*index), name.substr(kDigits)};
}

class Reader {
 public:
  Reader(std::string file, std::uint8_t node_id) {
    result_.file = std::move(file);
    result_.node_id = node_id;
  }

  EdsFile read(std::string_view text) {
    if (text.size() > kMaxBytes)
      throw InputError(result_.file + ": is larger than 4 MiB, the most for an electronic data sheet");
    if (text.starts_with(kUtf8Mark)) text.remove_prefix(kUtf8Mark.size());
    text = text.substr(0, text.find(kEndOfFile));
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      take(trimmed(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    finish_section();
    for (const auto& [entry, value] : compact_values_)
      if (const auto found = result_.entries.find(entry); found != result_.entries.end())
        found->second.value = value_of(found->second, value);
    if (result_.entries.empty())
      throw InputError(result_.file +
                       ": has no objects: an EDS or DCF file is text with sections such as [6040]; one in "
                       "UTF-16 or XML (XDD, XDC) must be converted");
    return std::move(result_);
  }

 private:
  // Ignores lines that are neither section nor key, such as the second line of a description.
  void take(std::string_view line) {
    line = trimmed(line.substr(0, line.find(';')));
    if (line.starts_with('[')) {
      finish_section();
      section_name_ = lower(trimmed(line.substr(1, line.find(']') - 1)));
      section_line_ = line_;
      return;
    }
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos)
      section_.emplace(lower(trimmed(line.substr(0, equals))), trimmed(line.substr(equals + 1)));
  }

  // [1018] and [1018sub1] are objects; other sections (file and device information, lists) are not needed.
  void finish_section() {
    const Section section = std::exchange(section_, {});
    const std::string name = std::exchange(section_name_, {});
    // The standard misspells this section's name; both spellings occur.
    if (name == "devicecomissioning" || name == "devicecommissioning")
      if (const auto node = number_of(text_of(section, "nodeid"), 0);
          node && *node >= 1 && *node <= kMaxNodeId)
        result_.node_id = static_cast<std::uint8_t>(*node);
    const auto object = object_section(name);
    if (!object) return;
    if (object->suffix.empty()) return add_head(object->index, section);
    if (object->suffix == "value") return add_compact_values(object->index, section);
    if (!object->suffix.starts_with("sub")) return;
    const auto sub_index = parse_hexadecimal(object->suffix.substr(3));
    if (sub_index && *sub_index <= UINT8_MAX)
      keep({object->index, static_cast<std::uint8_t>(*sub_index)}, section);
  }

  static std::string text_of(const Section& section, const char* key) {
    const auto found = section.find(key);
    return found == section.end() ? std::string() : found->second;
  }

  // A head is a variable, or a record or array. The entries of the latter have their own sections, or are all alike (CompactSubObj).
  void add_head(std::uint16_t index, const Section& section) {
    const auto count = number_of(text_of(section, "compactsubobj"), 0).value_or(0);
    const auto object_type = number_of(text_of(section, "objecttype"), 0).value_or(kVariable);
    if (count <= 0 && object_type != kVariable) return;
    const auto keep_unless_there = [&](std::uint8_t sub_index, const Section& its) {
      if (result_.entries.contains({index, sub_index})) return;
      keep({index, sub_index}, its);
      heads_.insert({index, sub_index});
    };
    if (count <= 0) return keep_unless_there(0, section);
    Section first = section;
    first["datatype"] = "5";
    first["defaultvalue"] = std::to_string(count);
    keep_unless_there(0, first);
    for (std::int64_t i = 1; i <= std::min(count, kMaxCompact); ++i)
      keep_unless_there(static_cast<std::uint8_t>(i), section);
  }

  void add_compact_values(std::uint16_t index, const Section& section) {
    for (const auto& [key, value] : section)
      if (const auto sub_index = number_of(key, 0); sub_index && *sub_index > 0 && *sub_index <= kMaxCompact)
        compact_values_[{index, static_cast<std::uint8_t>(*sub_index)}] = value;
  }

  // An entry's own section has priority over the head of its object, in any order.
  void keep(Entry key, const Section& section) {
    EdsEntry entry;
    const auto unclear = [&](const char* what, const std::string& value) {
      if (entry.unclear.empty())
        entry.unclear =
            "line " + std::to_string(section_line_) + ": " + what + " = '" + value + "' is not valid";
    };
    entry.name = text_of(section, "parametername");
    const std::string type_text = text_of(section, "datatype");
    const auto type = number_of(type_text, 0);
    if (!type) unclear("DataType", type_text);
    const auto known = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&](const Type& candidate) { return candidate.number == type; });
    if (known != kTypes.end()) {
      entry.bytes = known->bytes;
      entry.is_signed = known->is_signed;
    }
    const std::string access = lower(text_of(section, "accesstype"));
    entry.readable = access != "wo";
    entry.writable = access != "ro" && access != "const";
    if (entry.readable && entry.writable && !access.starts_with("rw")) unclear("AccessType", access);
    entry.mappable = number_of(text_of(section, "pdomapping"), 0).value_or(0) != 0;
    // The default of a REAL32 is a decimal fraction, which is not needed here.
    if (type != kReal32) {
      const std::string set = text_of(section, "parametervalue");
      const std::string value = set.empty() ? text_of(section, "defaultvalue") : set;
      entry.value = value_of(entry, value);
      if (entry.bytes > 0 && !value.empty() && !entry.value) unclear("the value", value);
      entry.low = value_of(entry, text_of(section, "lowlimit"));
      entry.high = value_of(entry, text_of(section, "highlimit"));
    }
    if (heads_.erase(key) > 0) result_.entries.erase(key);
    result_.entries.emplace(key, std::move(entry));
  }

  std::optional<std::int64_t> value_of(const EdsEntry& entry, const std::string& text) const {
    const auto number = entry.bytes == 0 ? std::nullopt : number_of(text, result_.node_id);
    return number ? fitted(*number, entry.bytes, entry.is_signed) : std::nullopt;
  }

  EdsFile result_;
  std::set<Entry> heads_;  ///< entries described only by the head of their object
  std::map<Entry, std::string> compact_values_;
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
