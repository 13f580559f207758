// SPDX-License-Identifier: BSD-3-Clause
#include "commission/joint_settings.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/printable.h"
#include "base/toml_section.h"

namespace strainwave {

namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, '\n');
  Lines lines(parts.begin(), parts.end());
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

std::string text_of(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// The name in a line [name] or [[name]]; empty for another line.
std::string_view table_of(std::string_view line) {
  line = trimmed(line);
  const std::string_view open = line.starts_with("[[") ? "[[" : "[";
  const std::size_t end = line.find(']');
  if (!line.starts_with(open) || end == std::string_view::npos) return {};
  return trimmed(line.substr(open.size(), end - open.size()));
}

/// A line "key = value  # comment"; the key is empty for another line.
struct KeyLine {
  std::string_view key;
  std::string_view value;
};
KeyLine key_line_of(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos || trimmed(line).starts_with('#')) return {};
  std::string_view value = trimmed(line.substr(equals + 1));
  const bool quoted = value.starts_with('"');
  const std::size_t close = quoted ? value.find('"', 1) : 0;
  const std::size_t comment = value.find('#', std::min(close, value.size()));
  return {trimmed(line.substr(0, equals)), trimmed(value.substr(0, comment))};
}

/// Lines [begin, end) of a table, its header first.
struct Block {
  std::string_view table;
  std::size_t begin = 0;
  std::size_t end = 0;
};

bool is_blank(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.starts_with('#');
}

std::vector<Block> blocks_of(const Lines& lines) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (const std::string_view table = table_of(lines[i]); !table.empty())
      blocks.push_back({table, i, lines.size()});
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (i + 1 < blocks.size()) blocks[i].end = blocks[i + 1].begin;
    // Blank lines and comments before the next table belong to that one.
    while (blocks[i].end > blocks[i].begin + 1 && is_blank(lines[blocks[i].end - 1])) --blocks[i].end;
  }
  return blocks;
}

/// The tables of `joint`, [[joint]] first; empty if there is no such joint.
std::vector<Block> blocks_of_joint(const Lines& lines, const std::string& joint) {
  const std::vector<Block> all = blocks_of(lines);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].table != "joint") continue;
    const auto names_it = [&](std::size_t line) {
      const KeyLine found = key_line_of(lines[line]);
      return found.key == "name" && found.value == "\"" + joint + "\"";
    };
    bool named = false;
    for (std::size_t line = all[i].begin + 1; line < all[i].end; ++line) named = named || names_it(line);
    if (!named) continue;
    std::vector<Block> blocks{all[i]};
    for (++i; i < all.size() && all[i].table.starts_with("joint."); ++i) blocks.push_back(all[i]);
    return blocks;
  }
  return {};
}

std::string value_text(const JointSetting& setting) {
  if (const double* number = std::get_if<double>(&setting.value)) return number_text(*number);
  return "\"" + std::get<std::string>(setting.value) + "\"";
}

/// Table and key of a setting such as "control.gravity_Nm".
struct Place {
  std::string table;
  std::string key;
};
Place place_of(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  if (dot == std::string::npos) return {"joint", key};
  return {"joint." + key.substr(0, dot), key.substr(dot + 1)};
}

void set(Lines& lines, const std::vector<Block>& blocks, const JointSetting& setting) {
  const Place place = place_of(setting.key);
  const std::string line = place.key + " = " + value_text(setting);
  const auto block = std::ranges::find(blocks, place.table, &Block::table);
  if (block == blocks.end()) {
    const auto at = lines.begin() + static_cast<std::ptrdiff_t>(blocks.back().end);
    lines.insert(at, {"", "[" + place.table + "]", line});
    return;
  }
  for (std::size_t i = block->begin + 1; i < block->end; ++i) {
    const KeyLine found = key_line_of(lines[i]);
    if (found.key != place.key) continue;
    lines[i] = line + "  # before commissioning: " + std::string(found.value);
    return;
  }
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(block->end), line);
}

/// Reads the text as TOML and throws InputError if it does not contain the setting.
void verify(const std::string& text, const std::string& joint, const JointSetting& setting,
            const std::string& source) {
  constexpr Range kAny{-1e300, 1e300};
  const InputError failed(source, setting.key, value_text(setting),
                          "cannot be set in joint " + joint + ": write its tables as [[joint]] and [joint." +
                              "NAME], and each key in a line of its own");
  const Place place = place_of(setting.key);
  TomlSection file = TomlSection::parse(text, source);
  for (TomlSection& section : file.sections("joint")) {
    if (section.text("name") != joint) continue;
    TomlSection table = place.table == "joint"
                            ? section
                            : section.section_or_empty(place.table.substr(std::string("joint.").size()));
    if (!table.has(place.key)) throw failed;
    const bool same = std::holds_alternative<double>(setting.value)
                          ? table.number(place.key, kAny) == std::get<double>(setting.value)
                          : table.text(place.key) == std::get<std::string>(setting.value);
    if (!same) throw failed;
    return;
  }
  throw failed;
}

/// The path in a value of `key`; empty if there is none.
std::string_view path_in(std::string_view key, std::string_view value) {
  if (!value.starts_with('"') || !value.ends_with('"') || value.size() < 3) return {};
  value = value.substr(1, value.size() - 2);
  constexpr std::string_view kCsv = "csv:";
  if (value.starts_with(kCsv)) return value.substr(kCsv.size());
  constexpr std::array kPaths{"authorized_keys", "directory", "file", "state_directory", "table"};
  if (std::ranges::find(kPaths, key) != kPaths.end()) return value;
  return key == "friction" && value.ends_with(".json") ? value : std::string_view{};
}

}  // namespace

std::string with_settings(const std::string& text, const std::string& joint,
                          const std::vector<JointSetting>& settings, const std::string& source) {
  Lines lines = lines_of(text);
  for (const JointSetting& setting : settings) {
    // Blocks refer to a copy of the lines, because an insertion moves the later ones.
    const Lines before = lines;
    const std::vector<Block> blocks = blocks_of_joint(before, joint);
    if (blocks.empty())
      throw InputError(source, "joint.name", joint, "must be the name of a [[joint]] of this file");
    set(lines, blocks, setting);
  }
  std::string changed = text_of(lines);
  for (const JointSetting& setting : settings) verify(changed, joint, setting, source);
  return changed;
}

std::string with_moved_paths(const std::string& text, const std::string& prefix) {
  Lines lines = lines_of(text);
  for (std::string& line : lines) {
    const KeyLine found = key_line_of(line);
    const std::string_view path = path_in(found.key, found.value);
    if (path.empty() || path.starts_with('/')) continue;
    line.insert(static_cast<std::size_t>(path.data() - line.data()), prefix);
  }
  return text_of(lines);
}

}  // namespace strainwave
