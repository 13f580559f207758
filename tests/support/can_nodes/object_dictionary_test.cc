// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/object_dictionary.h"

#include <gtest/gtest.h>

#include "tests/support/can_nodes/pdo_table.h"
#include "tests/support/can_nodes/sdo_server.h"

namespace strainwave::can_nodes {
namespace {

constexpr std::uint8_t kNode = 5;
using Bytes = std::vector<std::uint8_t>;

class Dictionary : public ::testing::Test {
 protected:
  Dictionary() {
    dictionary_.add({0x1000, 0}, {DataType::kUnsigned32, Access::kConstant, 0x00020192});
    dictionary_.add({0x1008, 0},
                    {DataType::kVisibleString, Access::kConstant, 0, Mappable::kNo, 0, 0, "A drive's name"});
    dictionary_.add({0x6071, 0},
                    {DataType::kInteger16, Access::kReadWrite, 0, Mappable::kBoth, -1000, 1000, {}});
    dictionary_.add({0x6040, 0}, {DataType::kUnsigned16, Access::kReadWrite, 0, Mappable::kReceive});
    dictionary_.add({0x6064, 0}, {DataType::kInteger32, Access::kReadOnly, -2, Mappable::kTransmit});
    dictionary_.add({0x606C, 0}, {DataType::kInteger32, Access::kReadOnly, 7, Mappable::kTransmit});
    dictionary_.add({0x6041, 0}, {DataType::kUnsigned16, Access::kReadOnly, 0x0250, Mappable::kTransmit});
  }

  Bytes answer(std::initializer_list<std::uint8_t> request) {
    const auto frame = server_.answer(Frame(0x600 + kNode, request));
    if (!frame) return {};
    EXPECT_EQ(frame->id, 0x580U + kNode);
    return {frame->data.begin(), frame->data.begin() + frame->length};
  }
  Abort write(Key key, std::int64_t value, std::size_t size) {
    Bytes bytes;
    append_little_endian(bytes, static_cast<std::uint64_t>(value), size);
    return dictionary_.write(key, bytes);
  }

  ObjectDictionary dictionary_;
  SdoServer server_{dictionary_, kNode};
};

TEST_F(Dictionary, GivesAnExpeditedAnswerToAnUpload) {
  EXPECT_EQ(answer({0x40, 0x00, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x43, 0x00, 0x10, 0, 0x92, 0x01, 0x02, 0x00}));
  EXPECT_EQ(answer({0x40, 0x71, 0x60, 0, 0, 0, 0, 0}), (Bytes{0x4B, 0x71, 0x60, 0, 0, 0, 0, 0}));
}

TEST_F(Dictionary, UploadsAStringInSegmentsWithToggle) {
  EXPECT_EQ(answer({0x40, 0x08, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x41, 0x08, 0x10, 0, 14, 0, 0, 0}));
  EXPECT_EQ(answer({0x60, 0, 0, 0, 0, 0, 0, 0}), (Bytes{0x00, 'A', ' ', 'd', 'r', 'i', 'v', 'e'}));
  EXPECT_EQ(answer({0x70, 0, 0, 0, 0, 0, 0, 0}), (Bytes{0x11, '\'', 's', ' ', 'n', 'a', 'm', 'e'}));
}

TEST_F(Dictionary, AbortsWhenTheToggleBitIsWrong) {
  answer({0x40, 0x08, 0x10, 0, 0, 0, 0, 0});
  EXPECT_EQ(answer({0x70, 0, 0, 0, 0, 0, 0, 0}), (Bytes{0x80, 0x08, 0x10, 0, 0, 0, 0x03, 0x05}));
}

TEST_F(Dictionary, TakesExpeditedAndSegmentedDownloads) {
  EXPECT_EQ(answer({0x2B, 0x71, 0x60, 0, 0x9C, 0xFF, 0, 0}), (Bytes{0x60, 0x71, 0x60, 0, 0, 0, 0, 0}));
  EXPECT_EQ(dictionary_.number({0x6071, 0}), -100);
  EXPECT_EQ(answer({0x21, 0x71, 0x60, 0, 2, 0, 0, 0}), (Bytes{0x60, 0x71, 0x60, 0, 0, 0, 0, 0}));
  EXPECT_EQ(answer({0x0B, 0x64, 0x00, 0, 0, 0, 0, 0}), (Bytes{0x20, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(dictionary_.number({0x6071, 0}), 100);
}

TEST_F(Dictionary, RefusesWithTheStandardsCodes) {
  EXPECT_EQ(write({0x2000, 0}, 0, 1), Abort::kNoObject);
  EXPECT_EQ(write({0x6071, 1}, 0, 2), Abort::kNoSubIndex);
  EXPECT_EQ(write({0x6064, 0}, 0, 4), Abort::kReadOnly);
  EXPECT_EQ(write({0x6071, 0}, 0, 4), Abort::kLengthTooHigh);
  EXPECT_EQ(write({0x6071, 0}, 0, 1), Abort::kLengthTooLow);
  EXPECT_EQ(write({0x6071, 0}, 1001, 2), Abort::kValueTooHigh);
  EXPECT_EQ(write({0x6071, 0}, -1001, 2), Abort::kValueTooLow);
  EXPECT_EQ(write({0x6071, 0}, -1000, 2), Abort::kNone);
}

TEST_F(Dictionary, RefusesWhatItIsToldToRefuseUntilToldOtherwise) {
  server_.refuse({0x6071, 0}, Abort::kGeneral);
  EXPECT_EQ(answer({0x2B, 0x71, 0x60, 0, 1, 0, 0, 0}), (Bytes{0x80, 0x71, 0x60, 0, 0, 0, 0, 0x08}));
  server_.refuse({0x6071, 0}, Abort::kNone);
  EXPECT_EQ(answer({0x2B, 0x71, 0x60, 0, 1, 0, 0, 0})[0], 0x60);
}

TEST_F(Dictionary, IgnoresAFrameThatIsNoSdo) {
  EXPECT_TRUE(answer({0x40, 0x00, 0x10, 0}).empty());
  EXPECT_EQ(answer({0xA0, 0x00, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x80, 0x00, 0x10, 0, 1, 0, 0x04, 0x05}));
}

class Pdos : public Dictionary {
 protected:
  static constexpr std::int64_t kOff = 0x80000000;
  PdoTable pdos_{dictionary_, kNode};

  void map_feedback(std::int64_t type) {
    ASSERT_EQ(write({0x1800, 1}, kOff | 0x185, 4), Abort::kNone);
    ASSERT_EQ(write({0x1A00, 0}, 0, 1), Abort::kNone);
    ASSERT_EQ(write({0x1A00, 1}, 0x60640020, 4), Abort::kNone);
    ASSERT_EQ(write({0x1A00, 2}, 0x606C0020, 4), Abort::kNone);
    ASSERT_EQ(write({0x1A00, 0}, 2, 1), Abort::kNone);
    ASSERT_EQ(write({0x1800, 2}, type, 1), Abort::kNone);
    ASSERT_EQ(write({0x1800, 1}, 0x185, 4), Abort::kNone);
  }
};

TEST_F(Pdos, AreMappedInTheStandardsOrderAndSentWithEverySync) {
  map_feedback(1);
  const std::vector<Frame> frames = pdos_.due_at_sync();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0], Frame(0x185, {0xFE, 0xFF, 0xFF, 0xFF, 7, 0, 0, 0}));
}

TEST_F(Pdos, AreSentWithEveryNthSync) {
  map_feedback(3);
  std::size_t sent = 0;
  for (int sync = 0; sync < 9; ++sync) sent += pdos_.due_at_sync().size();
  EXPECT_EQ(sent, 3U);
}

TEST_F(Pdos, RefuseEveryWrongOrderOfConfiguration) {
  EXPECT_EQ(write({0x1A00, 0}, 0, 1), Abort::kUnsupportedAccess);  // enabled: it must be disabled first
  EXPECT_EQ(write({0x1800, 1}, 0x186, 4), Abort::kInvalidValue);   // enabled: the identifier is fixed
  ASSERT_EQ(write({0x1800, 1}, kOff | 0x185, 4), Abort::kNone);
  EXPECT_EQ(write({0x1A00, 1}, 0x60640020, 4), Abort::kUnsupportedAccess);  // the count is not 0
  ASSERT_EQ(write({0x1A00, 0}, 0, 1), Abort::kNone);
  EXPECT_EQ(write({0x1A00, 1}, 0x60640010, 4), Abort::kNotMappable);  // length
  EXPECT_EQ(write({0x1A00, 1}, 0x60400010, 4), Abort::kNotMappable);  // direction
  EXPECT_EQ(write({0x1A00, 1}, 0x20000010, 4), Abort::kNotMappable);  // no such object
  ASSERT_EQ(write({0x1A00, 1}, 0x60640020, 4), Abort::kNone);
  ASSERT_EQ(write({0x1A00, 2}, 0x606C0020, 4), Abort::kNone);
  ASSERT_EQ(write({0x1A00, 3}, 0x60410010, 4), Abort::kNone);
  EXPECT_EQ(write({0x1A00, 0}, 3, 1), Abort::kPdoLength);  // ten bytes
  EXPECT_EQ(write({0x1A00, 0}, 9, 1), Abort::kPdoLength);
  EXPECT_EQ(write({0x1800, 2}, 241, 1), Abort::kInvalidValue);
  EXPECT_EQ(write({0x1800, 1}, 0x605, 4), Abort::kInvalidValue);  // an SDO's identifier
  pdos_.set_configurable(false);
  EXPECT_EQ(write({0x1A00, 0}, 2, 1), Abort::kDeviceState);
  EXPECT_EQ(write({0x1800, 1}, 0x185, 4), Abort::kDeviceState);
}

TEST_F(Pdos, HoldASynchronousSetpointUntilTheSyncAndCountWhatIsLost) {
  ASSERT_EQ(write({0x1400, 2}, 1, 1), Abort::kNone);
  EXPECT_EQ(pdos_.receive(Frame(0x205, {0x06, 0x00})), Reception::kTaken);
  EXPECT_EQ(dictionary_.number({0x6040, 0}), 0);
  EXPECT_EQ(pdos_.receive(Frame(0x205, {0x07, 0x00})), Reception::kTaken);
  pdos_.use_held();
  EXPECT_EQ(dictionary_.number({0x6040, 0}), 7);
  pdos_.use_held();
  EXPECT_EQ(pdos_.counts().superseded, 1);
  EXPECT_EQ(pdos_.counts().syncs_without_rpdo, 1);
}

TEST_F(Pdos, OfTheWrongLengthAreNotTaken) {
  EXPECT_EQ(pdos_.receive(Frame(0x205, {0x06})), Reception::kTooShort);
  EXPECT_EQ(pdos_.receive(Frame(0x205, {0x06, 0, 0})), Reception::kTooLong);
  EXPECT_EQ(pdos_.receive(Frame(0x305, {0x06, 0})), Reception::kNotMine);
  EXPECT_EQ(dictionary_.number({0x6040, 0}), 6);
}

TEST_F(Pdos, DrivenByEventsComeOnChangeWithInhibitAndTimer) {
  ASSERT_EQ(write({0x1800, 1}, kOff | 0x185, 4), Abort::kNone);
  ASSERT_EQ(write({0x1800, 3}, 20, 2), Abort::kNone);  // inhibit time 2 ms
  ASSERT_EQ(write({0x1800, 5}, 50, 2), Abort::kNone);  // event timer 50 ms
  ASSERT_EQ(write({0x1800, 1}, 0x185, 4), Abort::kNone);
  pdos_.begin();
  EXPECT_EQ(pdos_.due_by_event(1000).size(), 1U);  // at once
  EXPECT_EQ(pdos_.due_by_event(4000).size(), 0U);
  dictionary_.set({0x6041, 0}, 0x0231);
  EXPECT_EQ(pdos_.due_by_event(4000).size(), 1U);
  dictionary_.set({0x6041, 0}, 0x0233);
  EXPECT_EQ(pdos_.due_by_event(5000).size(), 0U);  // inhibited
  EXPECT_EQ(pdos_.due_by_event(6000).size(), 1U);
  EXPECT_EQ(pdos_.due_by_event(55000).size(), 0U);
  EXPECT_EQ(pdos_.due_by_event(56000).size(), 1U);  // timer
}

}  // namespace
}  // namespace strainwave::can_nodes
