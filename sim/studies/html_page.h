// SPDX-License-Identifier: BSD-3-Clause
// A study as one self-contained HTML file: tables, and figures (inline SVG) with captions. Offline.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/studies/figure.h"
#include "sim/studies/text_table.h"

namespace strainwave {

/// Returns the page. The figures must already be drawn in `figure_directory`.
std::string html_page(const std::string& introduction_html, const std::vector<TextTable>& tables,
                      const std::vector<Figure>& figures, const std::filesystem::path& figure_directory);

}  // namespace strainwave
