// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/compression.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

namespace strainwave {
namespace {

std::string unpacked(const std::string& packed, std::size_t size) {
  z_stream stream{};
  EXPECT_EQ(::inflateInit2(&stream, MAX_WBITS + 16), Z_OK);
  std::string text(size + 1, '\0');
  std::string input = packed;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(::inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  ::inflateEnd(&stream);
  return text;
}

TEST(Gzip, ReadsBackAndMakesAPageOfMetricsSmall) {
  std::string page;
  for (int joint = 0; joint < 512; ++joint)
    page += "strainwave_joint_position_radians{prefix=\"SW\",joint=\"joint" + std::to_string(joint) + "\"} " +
            std::to_string(0.1234567 * joint) + "\n";
  const std::string packed = gzip(page);
  EXPECT_EQ(unpacked(packed, page.size()), page);
  EXPECT_LT(packed.size(), page.size() / 5);
  EXPECT_EQ(unpacked(gzip(""), 0), "");
}

TEST(Gzip, HoldsWhatDoesNotGetSmaller) {
  std::mt19937 random(1);
  std::string noise(100000, '\0');
  for (char& byte : noise) byte = static_cast<char>(random());
  EXPECT_EQ(unpacked(gzip(noise), noise.size()), noise);
}

TEST(Gzip, IsForThoseWhoSayThatTheyTakeIt) {
  for (const char* takes :
       {"gzip", "deflate, gzip", "br;q=1.0, gzip;q=0.8, *;q=0.1", " gzip ;q=1", "gzip,deflate"})
    EXPECT_TRUE(takes_gzip(takes)) << takes;
  for (const char* does_not :
       {"", "identity", "gzip;q=0", "gzip; q=0.000", "xgzip", "deflate, br", ",,", "gzipped"})
    EXPECT_FALSE(takes_gzip(does_not)) << does_not;
}

}  // namespace
}  // namespace strainwave
