// SPDX-License-Identifier: BSD-3-Clause
#include "sim/commands/study_output.h"

#include <iostream>

#include "base/text_file.h"
#include "sim/studies/html_page.h"

namespace strainwave {

void write_study(const std::string& name, const TextTable& summary, const TextTable& details,
                 const Figure& figure, const std::filesystem::path& directory) {
  std::cout << summary.markdown();
  write_text_file(directory / (name + ".csv"), details.csv());
  draw_figures({figure}, directory);
  write_text_file(directory / (name + ".html"),
                  html_page("<h1>" + html_escaped(name) + "</h1>\n", {summary}, {figure}, directory));
  std::cout << "written to " << directory.string() << "\n";
}

}  // namespace strainwave
