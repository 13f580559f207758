// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/html_page.h"

#include "base/text_file.h"

namespace strainwave {

namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Strainwave</title>
<style>
body { font: 15px/1.5 sans-serif; max-width: 1440px; margin: 2em auto; padding: 0 1em; color: #222; background: #fff; }
table { border-collapse: collapse; margin: 1.5em 0; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: bold; padding: .3em 0; }
td, th { border: 1px solid #ccc; padding: .2em .6em; text-align: right; }
td:first-child, th:first-child { text-align: left; }
figure { margin: 2em 0; } figure svg { max-width: 100%; height: auto; } figcaption { color: #555; }
</style></head><body>
)";

/// The <svg> element of a file, without the XML declaration and document type that HTML does not allow inside.
std::string inline_svg(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  const auto begin = text.find("<svg");
  return begin == std::string::npos ? std::string() : text.substr(begin);
}

}  // namespace

std::string html_page(const std::string& introduction_html, const std::vector<TextTable>& tables,
                      const std::vector<Figure>& figures, const std::filesystem::path& figure_directory) {
  std::string page = kHead + introduction_html + "<h2>Tables</h2>\n";
  for (const TextTable& table : tables) page += table.html();
  page += "<h2>Figures</h2>\n";
  for (const Figure& figure : figures)
    page += "<figure id=\"" + figure.id + "\">\n" + inline_svg(figure_directory / (figure.id + ".svg")) +
            "<figcaption>" + html_escaped(figure.caption) + "</figcaption>\n</figure>\n";
  return page + "</body></html>\n";
}

}  // namespace strainwave
