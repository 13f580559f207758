// SPDX-License-Identifier: BSD-3-Clause
#include "base/nearest_word.h"

#include <algorithm>

namespace strainwave {

namespace {

/// Number of letters to insert, delete or replace.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

bool is_begin_of(std::string_view shorter, std::string_view longer) {
  return longer.size() > shorter.size() && longer.starts_with(shorter) &&
         (longer[shorter.size()] == '_' || longer[shorter.size()] == '-');
}

}  // namespace

const std::string* nearest_word(std::string_view typed, const std::vector<std::string>& known) {
  const std::string* nearest = nullptr;
  std::size_t least = std::max<std::size_t>(2, typed.size() / 3) + 1;
  for (const std::string& word : known) {
    // A forgotten unit or last word is the most likely mistake.
    if (!typed.empty() && (is_begin_of(typed, word) || is_begin_of(word, typed))) return &word;
    const std::size_t distance = edit_distance(typed, word);
    if (distance >= least || distance >= std::max(typed.size(), word.size())) continue;
    least = distance;
    nearest = &word;
  }
  return nearest;
}

std::string unit_conversion(std::string_view key) {
  if (key.ends_with("_F") || key.ends_with("_degF")) return " From degF: degC = (degF - 32) / 1.8.";
  if (key.ends_with("_kg") || key.ends_with("_kgm") || key.ends_with("_kgfm"))
    return " 1 kgf m is 9.81 N m; an inertia is in kg m2.";
  if (key.ends_with("_kgcm") || key.ends_with("_kgfcm")) return " 1 kgf cm is 9.81 N cm.";
  return "";
}

}  // namespace strainwave
