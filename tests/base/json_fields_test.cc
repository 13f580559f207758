// SPDX-License-Identifier: BSD-3-Clause
#include "base/json_fields.h"

#include <gtest/gtest.h>

#include "tests/support/refusal.h"

namespace strainwave {

enum class Kind { kFirst, kSecond, kThird };

struct Part {
  double value = 0.0;
};

struct Whole {
  std::string text;
  FixedString<8> word;
  bool flag = false;
  std::int32_t number = 0;
  Kind kind = Kind::kFirst;
  std::optional<Part> part;
  std::vector<Part> parts;
  std::array<double, 4> matrix{};
  std::array<std::int32_t, 2> pair{};
};

template <typename Json>
void fields(Json& json, Part& part) {
  json("value", part.value);
  json.require(part.value >= 0.0, "value", "0 or more");
}

template <typename Json>
void fields(Json& json, Whole& whole) {
  json.refuse("other", "is another file");
  json.format(3, "make it again");
  json("text", whole.text);
  json("word", whole.word);
  json("flag", whole.flag);
  json("number", whole.number);
  json.name("kind", whole.kind, std::array{"first", "second", "third"});
  json("part", whole.part);
  json("parts", whole.parts);
  json.matrix("matrix", whole.matrix, 2);
  json("pair", whole.pair);
}

namespace {

Whole example() {
  return {"a \"b\"", FixedString<8>("word"), true,         -7,    Kind::kThird,
          Part{0.1}, {{1.0}, {2.0}},         {1, 2, 3, 4}, {5, 6}};
}

/// The reader's message for the example's text with `from` replaced by `to`.
std::string refusal_with(const std::string& from, const std::string& to) {
  std::string text = json_text(example());
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  text.replace(place, from.size(), to);
  return testing::refusal_of([&] { (void)from_json_text<Whole>(text, "a.json"); });
}

TEST(JsonFields, ReadsBackWhatItWrote) {
  Whole whole = example();
  const std::string text = json_text(whole);
  EXPECT_EQ(json_text(from_json_text<Whole>(text, "a.json")), text);
  const Whole read = from_json_text<Whole>(text, "a.json");
  EXPECT_EQ(read.text, whole.text);
  EXPECT_EQ(read.word, whole.word);
  EXPECT_EQ(read.number, whole.number);
  EXPECT_EQ(read.kind, whole.kind);
  EXPECT_EQ(read.parts.size(), 2U);
  EXPECT_EQ(read.matrix, whole.matrix);
  EXPECT_EQ(read.pair, whole.pair);
  whole.part.reset();
  EXPECT_FALSE(from_json_text<Whole>(json_text(whole), "a.json").part);
}

TEST(JsonFields, NamesPlaceValueAndWhatIsAllowed) {
  EXPECT_EQ(refusal_with("\"format\": 3", "\"format\": 4"),
            "a.json: format = 4: this program reads format 3; make it again");
  EXPECT_EQ(refusal_with("\"text\"", "\"other\": 1, \"text\""), "a.json: is another file");
  EXPECT_EQ(refusal_with("\"third\"", "\"fourth\""),
            "a.json: kind = \"fourth\": must be first, second or third");
  EXPECT_EQ(refusal_with("\"value\": 2.0", "\"value\": -1"),
            "a.json: parts[1].value = -1: must be 0 or more");
  EXPECT_EQ(refusal_with("\"value\": 2.0", "\"value\": 2, \"more\": 1"),
            "a.json: parts[1].more: unknown key");
  EXPECT_EQ(refusal_with("\"number\": -7", "\"number\": 4294967296"),
            "a.json: number = 4294967296: must be from -2147483648 to 2147483647");
  EXPECT_EQ(refusal_with("\"number\": -7", "\"number\": 18446744073709551615"),
            "a.json: number = 18446744073709551615: must be a whole number up to 9223372036854775807");
  EXPECT_EQ(refusal_with("    5,\n    6", "5, 6.5").substr(0, 14), "a.json: pair =");
  EXPECT_NE(refusal_with("\"word\": \"word\"", "\"word\": \"too long a word\"").find("at most 7 bytes"),
            std::string::npos);
}

}  // namespace
}  // namespace strainwave
