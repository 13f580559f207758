// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/ownership.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr Ownership::Holder kOtto{0, 11};
constexpr Ownership::Holder kEmma{1, 22};

class OwnershipTest : public ::testing::Test {
 protected:
  bool order(const Ownership::Holder& holder, std::int64_t now_ns, bool accepted = true) {
    if (!ownership_.reserve(0, holder, now_ns)) return false;
    ownership_.settle(0, holder, accepted, now_ns);
    return true;
  }
  Ownership ownership_{2, 2.0};
};

TEST_F(OwnershipTest, GoesToTheFirstWhoseOrderIsAcceptedAndOnThatJointAlone) {
  ASSERT_TRUE(order(kOtto, 0));
  EXPECT_EQ(ownership_.owner_id(0, 1), 11);
  EXPECT_FALSE(ownership_.reserve(0, kEmma, 1));
  EXPECT_TRUE(ownership_.reserve(1, kEmma, 1));
}

TEST_F(OwnershipTest, EndsWithTheSilenceOfItsHolderAndNoEarlier) {
  ASSERT_TRUE(order(kOtto, 0));
  EXPECT_NEAR(ownership_.lease_s(0, kSecond_ns), 1.0, 1e-9);
  ASSERT_TRUE(order(kOtto, kSecond_ns)) << "renewed";
  EXPECT_FALSE(order(kEmma, 3 * kSecond_ns - 1));
  EXPECT_EQ(ownership_.owner_id(0, 3 * kSecond_ns), 0);
  EXPECT_TRUE(order(kEmma, 3 * kSecond_ns));
  EXPECT_FALSE(order(kOtto, 3 * kSecond_ns + 1));
}

TEST_F(OwnershipTest, IsNotGainedByAnOrderThatIsRefused) {
  EXPECT_TRUE(order(kOtto, 0, false));
  EXPECT_EQ(ownership_.owner_id(0, 1), 0);
  EXPECT_TRUE(order(kEmma, 1));
}

TEST_F(OwnershipTest, OfTwoOrdersAtOnceLetsOnlyTheFirstThrough) {
  EXPECT_TRUE(ownership_.reserve(0, kOtto, 0));
  EXPECT_FALSE(ownership_.reserve(0, kEmma, 1));
  EXPECT_TRUE(ownership_.reserve(0, kEmma, Ownership::kReservation_ns)) << "the loop never answered";
}

TEST_F(OwnershipTest, IsNotLostByARefusedOrderOfItsHolder) {
  ASSERT_TRUE(order(kOtto, 0));
  ASSERT_TRUE(order(kOtto, 1, false));
  EXPECT_EQ(ownership_.owner_id(0, 2), 11);
}

TEST_F(OwnershipTest, CanBeTakenOverAndReleasedByItsHolderAlone) {
  ASSERT_TRUE(order(kOtto, 0));
  EXPECT_FALSE(ownership_.release(0, kEmma, 1));
  ownership_.take(0, kEmma, 1);
  EXPECT_FALSE(order(kOtto, 2));
  EXPECT_TRUE(ownership_.release(0, kEmma, 3));
  EXPECT_TRUE(order(kOtto, 4));
}

TEST_F(OwnershipTest, KeepsTwoProgramsOfOneKeyApart) {
  ASSERT_TRUE(order(kOtto, 0));
  EXPECT_FALSE(order({kOtto.key, 12}, 1));
}

}  // namespace
}  // namespace strainwave
