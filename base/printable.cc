#include "base/printable.h"

#include <array>
#include <charconv>

namespace strainwave {

std::string printable(std::string_view text) {
  text = text.substr(0, text.find('\0'));
  std::string safe;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto before = static_cast<unsigned char>(i > 0 ? text[i - 1] : '\0');
    const bool control =
        byte < 0x20 || byte == 0x7F || (before == 0xC2 && byte < 0xA0);  // U+0080..U+009F in UTF-8
    safe += control ? '?' : text[i];
  }
  return safe;
}

std::string number_text(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace strainwave
