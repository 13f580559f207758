// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/canopen/eds_file.h"

#include <gtest/gtest.h>

#include "tests/support/refusal.h"

namespace strainwave::canopen {
namespace {

constexpr const char* kSheet =
    "; comment\r\n[FileInfo]\r\nFileName=x.eds\r\n\r\n"
    "[1000]\nParameterName=Device "
    "type\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x00020192\n"
    "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=2\n"
    "[1018sub0]\nParameterName=n\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n"
    "[1018sub1]\nParameterName=Vendor\nDataType=0x0007\nAccessType=ro\n"
    "[1400sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x200\n"
    "[6071]\nParameterName=Target "
    "torque\nDataType=0x0003\nAccessType=rww\nPDOMapping=1\nLowLimit=-3000\nHighLimit=3000\n"
    "[60C2]\nParameterName=Period\nObjectType=0x8\nDataType=0x0005\nAccessType=rw\nCompactSubObj=2\n";

EdsFile parse(const std::string& text) {
  return parse_eds("x.eds", text, 5);
}

TEST(EdsFile, TellsTypeAccessMappingValueAndLimitsOfEveryEntry) {
  const EdsFile eds = parse(kSheet);
  ASSERT_NE(eds.find({0x1000, 0}), nullptr);
  EXPECT_EQ(eds.find({0x1000, 0})->value, 0x00020192);
  EXPECT_FALSE(eds.find({0x1000, 0})->writable);
  EXPECT_FALSE(eds.find({0x1018, 1})->value);
  EXPECT_EQ(eds.find({0x1400, 1})->value, 0x205) << "the node id";
  const EdsEntry& torque = *eds.find({0x6071, 0});
  EXPECT_TRUE(torque.writable && torque.mappable && torque.is_signed);
  EXPECT_EQ(torque.bytes, 2U);
  EXPECT_EQ(torque.low, -3000);
  EXPECT_EQ(torque.high, 3000);
  EXPECT_NE(eds.find({0x60C2, 2}), nullptr) << "compact";
  EXPECT_EQ(eds.find({0x60C2, 3}), nullptr);
  EXPECT_EQ(eds.find({0x6072, 0}), nullptr);
  EXPECT_TRUE(eds.has_index(0x1018));
  EXPECT_FALSE(eds.has_index(0x1017));
}

const std::string kTorque = "[6071]\nParameterName=Torque\nDataType=0x0003\nAccessType=rww\n";

TEST(EdsFile, ReadsEveryFormOfANumberThatVendorsUse) {
  const auto value_of = [](const std::string& text, const char* type) {
    const EdsFile eds =
        parse("[2000]\nDataType=" + std::string(type) + "\nAccessType=rw\nDefaultValue=" + text);
    return eds.find({0x2000, 0})->value;
  };
  constexpr const char* kInt16 = "0x0003";
  constexpr const char* kUint32 = "0x7";
  EXPECT_EQ(value_of("0x8000", kInt16), -32768) << "two's complement";
  EXPECT_EQ(value_of("0xFFFF", kInt16), -1);
  EXPECT_EQ(value_of("-0x10", kInt16), -16);
  EXPECT_EQ(value_of("-1", kUint32), 0xFFFFFFFF);
  EXPECT_EQ(value_of("0X1f", kUint32), 31);
  EXPECT_EQ(value_of("010", kUint32), 8) << "octal";
  EXPECT_EQ(value_of("08", kUint32), 8) << "padded";
  EXPECT_EQ(value_of("0x180 + $NodeId", kUint32), 0x185);
  EXPECT_EQ(value_of("12 ; as shipped", kUint32), 12);
  EXPECT_EQ(value_of("0x10000", kInt16), std::nullopt) << "does not fit";
  EXPECT_EQ(value_of("-0x8000000000000000", "0x15"), INT64_MIN);
  EXPECT_EQ(value_of("five", kUint32), std::nullopt);
  EXPECT_EQ(value_of("", kUint32), std::nullopt);
}

TEST(EdsFile, ReadsWhatEditorsLeaveInAFile) {
  const std::string marked = "\xEF\xBB\xBF[6071] ; torque\r\n" + kTorque.substr(7) + "PDOMapping=0x1\r\n";
  for (const std::string& text :
       {marked + "\x1A", marked + "\x1Agarbage=[", marked + "Description of two\n lines\n[FileInfo\na=1\n"}) {
    const EdsFile eds = parse(text);
    ASSERT_NE(eds.find({0x6071, 0}), nullptr) << text;
    EXPECT_TRUE(eds.find({0x6071, 0})->mappable) << text;
    EXPECT_EQ(eds.find({0x6071, 0})->unclear, "") << text;
  }
}

TEST(EdsFile, OfAConfiguredDriveHasWhatItIsSetTo) {
  const EdsFile dcf = parse(
      std::string("[DeviceComissioning]\nNodeID=0x0C\n") + kTorque +
      "DefaultValue=1\nParameterValue=0xFFFE\n[1400sub1]\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID\n");
  EXPECT_EQ(dcf.find({0x6071, 0})->value, -2);
  EXPECT_EQ(dcf.node_id, 12);
  EXPECT_EQ(dcf.find({0x1400, 1})->value, 12);
  EXPECT_EQ(parse(kTorque).node_id, 5);
}

TEST(EdsFile, TakesTheHeadOfARecordForNoEntryOfIt) {
  for (const char* type : {"0x8", "0x9"}) {
    const std::string head =
        std::string("[1018]\nObjectType=") + type + "\nDataType=0x8\nAccessType=ro\nSubNumber=2\n";
    const EdsFile eds = parse(head + "[1018sub0]\nDataType=5\nAccessType=ro\nDefaultValue=1\n");
    EXPECT_EQ(eds.find({0x1018, 0})->bytes, 1U);
    EXPECT_EQ(eds.find({0x1018, 0})->unclear, "");
    EXPECT_TRUE(parse(head + kTorque).find({0x1018, 0}) == nullptr) << "without entries of its own";
  }
}

TEST(EdsFile, HasTheEntriesOfACompactArrayTheirValuesAndThoseDescribedBesides) {
  const EdsFile eds = parse(
      "[1600sub2]\nDataType=7\nAccessType=ro\n"
      "[1600]\nObjectType=8\nDataType=7\nAccessType=rw\nCompactSubObj=4\n"
      "[1600Value]\nNrOfEntries=2\n1=0x60400010\n3=0x60710010\n");
  EXPECT_EQ(eds.find({0x1600, 0})->value, 4);
  EXPECT_EQ(eds.find({0x1600, 0})->bytes, 1U);
  EXPECT_EQ(eds.find({0x1600, 1})->value, 0x60400010);
  EXPECT_TRUE(eds.find({0x1600, 1})->writable);
  EXPECT_FALSE(eds.find({0x1600, 2})->writable) << "its own section counts";
  EXPECT_EQ(eds.find({0x1600, 3})->value, 0x60710010);
  EXPECT_NE(eds.find({0x1600, 4}), nullptr);
  EXPECT_EQ(eds.find({0x1600, 5}), nullptr);
}

TEST(EdsFile, NotesWhatIsUnclearWithTheEntryAndItsLine) {
  for (const auto& [text, part] :
       {std::pair<std::string, std::string>{"DataType=long\nAccessType=ro\n", "line 6: DataType = 'long'"},
        {"DataType=0x4\nAccessType=maybe\n", "AccessType = 'maybe'"},
        {"DataType=0x4\n", "AccessType = ''"},
        {"DataType=0x4\nAccessType=ro\nDefaultValue=five\n", "the value = 'five'"}}) {
    const EdsFile eds = parse(kTorque + "\n[6064]\n" + text);
    EXPECT_NE(eds.find({0x6064, 0})->unclear.find(part), std::string::npos)
        << part << " in: " << eds.find({0x6064, 0})->unclear;
    EXPECT_EQ(eds.find({0x6071, 0})->unclear, "");
  }
}

TEST(EdsFile, WithoutObjectsIsRefused) {
  for (const char* text : {"[FileInfo]\nFileName=x\n", "", "a=1\n", "[10]\nDataType=7\n"}) {
    const std::string refused = testing::refusal_of([&] { (void)parse(text); });
    EXPECT_NE(refused.find("x.eds: has no objects"), std::string::npos) << refused;
    EXPECT_NE(refused.find("UTF-16"), std::string::npos) << refused;
  }
}

}  // namespace
}  // namespace strainwave::canopen
