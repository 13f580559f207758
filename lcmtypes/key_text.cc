// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/key_text.h"

#include <sodium.h>

#include <algorithm>
#include <array>

#include "base/input_error.h"

namespace strainwave {

namespace {

constexpr std::string_view kPublicWord = "ed25519";
constexpr std::string_view kSecretWord = "ed25519-secret";
constexpr std::string_view kPublicForm = "ed25519 <base64 of 32 bytes> <operator or engineer> <comment>";
constexpr std::string_view kSpaces = " \t";
constexpr std::size_t kMaxComment = 100;
using Bytes32 = std::array<std::uint8_t, 32>;

std::string_view take_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(kSpaces), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(kSpaces));
  rest.remove_prefix(word.size());
  return word;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

Bytes32 decode_base64(std::string_view text) {
  Bytes32 bytes{};
  std::size_t size = 0;
  const char* end = nullptr;
  const int result = ::sodium_base642bin(bytes.data(), bytes.size(), text.data(), text.size(), nullptr, &size,
                                         &end, sodium_base64_VARIANT_ORIGINAL);
  if (result != 0 || size != bytes.size() || end != text.data() + text.size())
    throw InputError("the key is not 32 bytes in base64 (44 characters): copy the whole line");
  return bytes;
}

std::string encode_base64(const Bytes32& bytes) {
  std::string text(sodium_base64_ENCODED_LEN(sizeof bytes, sodium_base64_VARIANT_ORIGINAL), '\0');
  ::sodium_bin2base64(text.data(), text.size(), bytes.data(), bytes.size(), sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();  // the terminating zero that libsodium counts
  return text;
}

std::string line_of(std::string_view word, const Bytes32& bytes, Role role, const std::string& comment) {
  std::string line(word);
  line.append(" ").append(encode_base64(bytes)).append(" ").append(to_text(role));
  if (!comment.empty()) line.append(" ").append(comment);
  return line;
}

struct RoleAndComment {
  Role role;
  std::string comment;
};

RoleAndComment parse_rest(std::string_view rest) {
  const std::string_view role_word = take_word(rest);
  const auto role = parse_role(role_word);
  if (!role) throw InputError("the third word is not a role: operator or engineer is allowed");
  const std::string comment(trimmed(rest));
  if (!is_valid_comment(comment))
    throw InputError("the comment has a control character (a Windows line end?) or more than 100 bytes");
  return {*role, comment};
}

}  // namespace

std::string_view to_text(Role role) noexcept {
  return role == Role::kEngineer ? "engineer" : "operator";
}

std::optional<Role> parse_role(std::string_view text) noexcept {
  if (text == "operator") return Role::kOperator;
  if (text == "engineer") return Role::kEngineer;
  return std::nullopt;
}

bool is_valid_comment(std::string_view comment) noexcept {
  const bool printable = std::none_of(comment.begin(), comment.end(), [](char character) {
    const auto byte = static_cast<unsigned char>(character);
    return byte < 0x20 || byte == 0x7f;
  });
  return printable && comment.size() <= kMaxComment && trimmed(comment).size() == comment.size();
}

std::string to_line(const AuthorizedKey& key) {
  return line_of(kPublicWord, key.key.bytes, key.role, key.comment);
}

std::string to_line(const SecretKeyText& key) {
  return line_of(kSecretWord, key.key.seed(), key.role, key.comment);
}

AuthorizedKey parse_public_line(std::string_view line) {
  const std::string_view word = take_word(line);
  if (word == kSecretWord)
    throw InputError(
        "this is a secret key, which belongs to its owner alone: put the line of its .pub file here, and "
        "make a new key if others could read this file");
  if (word != kPublicWord) throw InputError("a line has the form " + std::string(kPublicForm));
  AuthorizedKey key;
  key.key.bytes = decode_base64(take_word(line));
  if (!key.key.is_valid())
    throw InputError("these 32 bytes are not an Ed25519 public key: copy the whole line again");
  const auto [role, comment] = parse_rest(line);
  key.role = role;
  key.comment = comment;
  return key;
}

SecretKeyText parse_secret_line(std::string_view line) {
  const std::string_view word = take_word(line);
  if (word == kPublicWord) throw InputError("this is a public key: give the file without .pub");
  if (word != kSecretWord) throw InputError("not a key of strainwavectl keygen");
  Bytes32 seed = decode_base64(take_word(line));
  const SecretKey key(seed);
  ::sodium_memzero(seed.data(), seed.size());
  const auto [role, comment] = parse_rest(line);
  return {key, role, comment};
}

}  // namespace strainwave
