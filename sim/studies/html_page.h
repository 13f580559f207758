// SPDX-License-Identifier: BSD-3-Clause
// A study as one HTML file that needs nothing else: tables, figures (inline SVG), what each shows. Offline.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/studies/figure.h"
#include "sim/studies/text_table.h"

namespace strainwave {

/// The page; the figures must have been drawn into `figure_directory`.
std::string html_page(const std::string& introduction_html, const std::vector<TextTable>& tables,
                      const std::vector<Figure>& figures, const std::filesystem::path& figure_directory);

}  // namespace strainwave
