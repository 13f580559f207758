// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/quadrature_decoder.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace strainwave {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// An encoder by its definition: in phases 0 to 3, A is high in 1 and 2, B in 2 and 3.
class Encoder {
 public:
  /// Makes one step and returns its edge.
  Edge step(int direction, std::int64_t duration_ns = kMillisecond_ns) {
    const bool a = level_a();
    count_ += direction;
    time_ns_ += duration_ns;
    const bool a_changed = a != level_a();
    return {time_ns_, ++sequence_, a_changed ? 0U : 1U, a_changed ? level_a() : level_b()};
  }
  bool level_a() const { return phase() == 1 || phase() == 2; }
  bool level_b() const { return phase() == 2 || phase() == 3; }
  std::int64_t count() const { return count_; }
  std::uint32_t sequence() const { return sequence_; }

 private:
  int phase() const { return static_cast<int>(((count_ % 4) + 4) % 4); }
  std::int64_t count_ = 0;
  std::int64_t time_ns_ = 1'000'000'000;
  std::uint32_t sequence_ = 0;
};

class QuadratureDecoderTest : public ::testing::Test {
 protected:
  QuadratureDecoderTest() { decoder_.reset(false, false, 0); }
  Encoder encoder_;
  QuadratureDecoder decoder_{2000.0};
};

TEST_F(QuadratureDecoderTest, FollowsAnyWalkOfAnEncoderCountByCount) {
  std::mt19937 random(7);
  for (int i = 0; i < 100'000; ++i) {
    const int direction = (random() & 1U) != 0U ? 1 : -1;
    ASSERT_EQ(decoder_.apply(encoder_.step(direction)), QuadratureFault::kNone);
    ASSERT_EQ(decoder_.count(), encoder_.count());
  }
}

TEST_F(QuadratureDecoderTest, BeginsAtAnyLevels) {
  for (int i = 0; i < 3; ++i) (void)encoder_.step(1);
  decoder_.reset(encoder_.level_a(), encoder_.level_b(), encoder_.sequence());
  EXPECT_EQ(decoder_.apply(encoder_.step(1)), QuadratureFault::kNone);
  EXPECT_EQ(decoder_.count(), 1);
}

TEST_F(QuadratureDecoderTest, CallsAnEdgeThatChangesNothingIllegal) {
  (void)decoder_.apply(encoder_.step(1));
  Edge again = encoder_.step(-1);
  again.active = !again.active;
  EXPECT_EQ(decoder_.apply(again), QuadratureFault::kIllegalEdge);
}

TEST_F(QuadratureDecoderTest, SeesEveryGapInTheSequence) {
  for (const int missing : {1, 2, 3, 4, 100}) {
    Encoder encoder;
    QuadratureDecoder decoder(2000.0);
    decoder.reset(false, false, 0);
    (void)decoder.apply(encoder.step(1));
    for (int i = 0; i < missing; ++i) (void)encoder.step(1);
    EXPECT_EQ(decoder.apply(encoder.step(1)), QuadratureFault::kLostEvents) << missing;
  }
}

TEST_F(QuadratureDecoderTest, ToleratesTheCapForEverAndABurstAndNothingFaster) {
  for (int i = 0; i < 10'000; ++i)
    ASSERT_EQ(decoder_.apply(encoder_.step(1, 500'000)), QuadratureFault::kNone) << "2000 edges a second";
  Encoder fast;
  decoder_.reset(false, false, 0);
  int tolerated = 0;
  while (decoder_.apply(fast.step(tolerated % 2 == 0 ? 1 : -1, 1000)) == QuadratureFault::kNone) ++tolerated;
  EXPECT_EQ(decoder_.fault(), QuadratureFault::kOverSpeed);
  EXPECT_NEAR(tolerated, QuadratureDecoder::kBurst_edges, 1.0);
}

TEST_F(QuadratureDecoderTest, FaultsSoonAboveTheCap) {
  int steps = 0;
  while (decoder_.apply(encoder_.step(1, 450'000)) == QuadratureFault::kNone && steps < 1000) ++steps;
  EXPECT_EQ(decoder_.fault(), QuadratureFault::kOverSpeed) << "2222 edges a second";
  EXPECT_LT(steps, 200);
}

TEST_F(QuadratureDecoderTest, CountsNothingWhileItHasAFault) {
  decoder_.fail(QuadratureFault::kDeviceGone);
  EXPECT_EQ(decoder_.apply(encoder_.step(1)), QuadratureFault::kDeviceGone);
  EXPECT_EQ(decoder_.count(), 0);
  decoder_.fail(QuadratureFault::kLostEvents);
  EXPECT_EQ(decoder_.fault(), QuadratureFault::kDeviceGone) << "the first fault is the one that is shown";
}

}  // namespace
}  // namespace strainwave
