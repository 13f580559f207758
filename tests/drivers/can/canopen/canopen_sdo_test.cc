// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/canopen/canopen_sdo.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace strainwave::canopen {
namespace {

using Action = SdoTransfer::Action;
using State = SdoTransfer::State;

CanFrame answer_of(std::initializer_list<std::uint8_t> bytes) {
  CanFrame frame;
  frame.id = 0x583;
  for (const std::uint8_t byte : bytes) frame.bytes[frame.size++] = byte;
  frame.size = kMaxCanBytes;
  return frame;
}

std::array<std::uint8_t, 8> bytes(std::initializer_list<std::uint8_t> list) {
  std::array<std::uint8_t, 8> result{};
  std::copy(list.begin(), list.end(), result.begin());
  return result;
}

TEST(SdoUpload, AsksForTheEntryAndTakesAnExpeditedAnswer) {
  SdoTransfer transfer = SdoTransfer::upload(3, {0x6502, 0});
  EXPECT_EQ(transfer.request().id, 0x603U);
  EXPECT_EQ(transfer.request().bytes, bytes({0x40, 0x02, 0x65, 0x00}));
  EXPECT_EQ(transfer.answer(answer_of({0x43, 0x02, 0x65, 0x00, 0x08, 0x02, 0x00, 0x00})), Action::kFinish);
  EXPECT_EQ(transfer.state(), State::kDone);
  EXPECT_EQ(transfer.value(), (std::vector<std::uint8_t>{0x08, 0x02, 0x00, 0x00}));
}

TEST(SdoUpload, TakesAsManyBytesAsTheDriveSaysThatCount) {
  for (std::uint8_t count = 1; count <= 4; ++count) {
    SdoTransfer transfer = SdoTransfer::upload(3, {0x6041, 0});
    const auto first = static_cast<std::uint8_t>(0x43 | (4 - count) << 2);
    transfer.answer(answer_of({first, 0x41, 0x60, 0x00, 1, 2, 3, 4}));
    EXPECT_EQ(transfer.value().size(), count);
  }
}

TEST(SdoUpload, JoinsSegments) {
  SdoTransfer transfer = SdoTransfer::upload(3, {0x1008, 0});
  EXPECT_EQ(transfer.answer(answer_of({0x41, 0x08, 0x10, 0x00, 9, 0, 0, 0})), Action::kSend);
  EXPECT_EQ(transfer.request().bytes, bytes({0x60}));
  EXPECT_EQ(transfer.answer(answer_of({0x00, 'S', 'e', 'r', 'v', 'o', ' ', '4'})), Action::kSend);
  EXPECT_EQ(transfer.request().bytes, bytes({0x70})) << "the toggle bit alternates";
  EXPECT_EQ(transfer.answer(answer_of({0x1B, '0', '2'})), Action::kFinish);
  EXPECT_EQ(std::string(transfer.value().begin(), transfer.value().end()), "Servo 402");
}

TEST(SdoUpload, TellsTheDriveWhatItDidWrong) {
  const auto begun = [] {
    SdoTransfer transfer = SdoTransfer::upload(3, {0x1008, 0});
    transfer.answer(answer_of({0x41, 0x08, 0x10, 0x00, 9, 0, 0, 0}));
    return transfer;
  };
  SdoTransfer toggled = begun();
  EXPECT_EQ(toggled.answer(answer_of({0x10, 1, 2, 3, 4, 5, 6, 7})), Action::kAbort);
  EXPECT_EQ(toggled.abort_code(), 0x05030000U);
  EXPECT_EQ(toggled.request().bytes, bytes({0x80, 0x08, 0x10, 0x00, 0x00, 0x00, 0x03, 0x05}));
  SdoTransfer too_short = begun();
  EXPECT_EQ(too_short.answer(answer_of({0x01, 1, 2, 3, 4, 5, 6, 7})), Action::kAbort);
  SdoTransfer endless = begun();
  EXPECT_EQ(endless.answer(answer_of({0x0E})), Action::kAbort) << "a segment without bytes";
  SdoTransfer huge = SdoTransfer::upload(3, {0x1008, 0});
  EXPECT_EQ(huge.answer(answer_of({0x41, 0x08, 0x10, 0x00, 0, 0, 0, 0x40})), Action::kAbort);
  EXPECT_EQ(huge.abort_code(), 0x05040005U);
}

TEST(SdoUpload, IgnoresLateAnswersOfOtherTransfers) {
  SdoTransfer transfer = SdoTransfer::upload(3, {0x6502, 0});
  EXPECT_EQ(transfer.answer(answer_of({0x43, 0x41, 0x60, 0x00, 1})), Action::kIgnore);
  EXPECT_EQ(transfer.answer(answer_of({0x60, 0x02, 0x65, 0x00})), Action::kIgnore) << "of a download";
  EXPECT_EQ(transfer.answer(answer_of({0x80, 0x41, 0x60, 0x00, 0, 0, 2, 6})), Action::kIgnore);
  EXPECT_EQ(transfer.state(), State::kBusy);
}

TEST(SdoUpload, GivesTheDrivesReasonWhenItAborts) {
  SdoTransfer transfer = SdoTransfer::upload(3, {0x6502, 0});
  EXPECT_EQ(transfer.answer(answer_of({0x80, 0x02, 0x65, 0x00, 0x00, 0x00, 0x02, 0x06})), Action::kFinish);
  EXPECT_EQ(transfer.state(), State::kAborted);
  EXPECT_EQ(transfer.abort_code(), 0x06020000U);
  EXPECT_EQ(sdo_abort_text(transfer.abort_code()), "no such object");
  EXPECT_EQ(sdo_abort_text(0x12345678), "a code of the vendor's");
}

TEST(SdoDownload, SendsUpToFourBytesAtOnce) {
  const std::array<std::uint8_t, 4> value{0x81, 0x02, 0x03, 0x04};
  const std::uint8_t first[]{0x2F, 0x2B, 0x27, 0x23};
  for (std::size_t count = 1; count <= 4; ++count) {
    SdoTransfer transfer = SdoTransfer::download(3, {0x6060, 0}, std::span(value).first(count));
    EXPECT_EQ(transfer.request().bytes[0], first[count - 1]);
    EXPECT_EQ(transfer.request().bytes[4], 0x81);
    EXPECT_EQ(transfer.answer(answer_of({0x60, 0x60, 0x60, 0x00})), Action::kFinish);
    EXPECT_EQ(transfer.state(), State::kDone);
  }
}

TEST(SdoDownload, SendsLongerValuesInSegmentsThatTheDriveConfirms) {
  std::vector<std::uint8_t> value(16);
  std::iota(value.begin(), value.end(), std::uint8_t{1});
  SdoTransfer transfer = SdoTransfer::download(3, {0x1010, 1}, value);
  EXPECT_EQ(transfer.request().bytes, bytes({0x21, 0x10, 0x10, 0x01, 16}));
  EXPECT_EQ(transfer.answer(answer_of({0x60, 0x10, 0x10, 0x01})), Action::kSend);
  EXPECT_EQ(transfer.request().bytes, bytes({0x00, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(transfer.answer(answer_of({0x20})), Action::kSend);
  EXPECT_EQ(transfer.request().bytes, bytes({0x10, 8, 9, 10, 11, 12, 13, 14}));
  EXPECT_EQ(transfer.answer(answer_of({0x30})), Action::kSend);
  EXPECT_EQ(transfer.request().bytes, bytes({0x0B, 15, 16})) << "five bytes unused, the last";
  EXPECT_EQ(transfer.answer(answer_of({0x20})), Action::kFinish);
  EXPECT_EQ(transfer.state(), State::kDone);
}

TEST(SdoTransfer, EndsWhateverADriveAnswers) {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    const std::vector<std::uint8_t> value(20, 7);
    SdoTransfer transfer =
        round % 2 == 0 ? SdoTransfer::upload(3, {0x1008, 0}) : SdoTransfer::download(3, {0x1008, 0}, value);
    for (int frames = 0; frames < 400 && transfer.state() == State::kBusy; ++frames) {
      CanFrame frame;
      frame.size = static_cast<std::uint8_t>(random() % 4 == 0 ? random() % 9 : 8);
      for (std::uint8_t& byte : frame.bytes) byte = static_cast<std::uint8_t>(random());
      if (random() % 2 == 0) frame.bytes = bytes({static_cast<std::uint8_t>(random()), 0x08, 0x10, 0x00, 30});
      transfer.answer(frame);
      ASSERT_LE(transfer.value().size(), kMaxSdoBytes + 7);
    }
    EXPECT_NE(transfer.state(), State::kBusy);
  }
}

}  // namespace
}  // namespace strainwave::canopen
