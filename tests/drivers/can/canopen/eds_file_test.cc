#include "drivers/can/canopen/eds_file.h"

#include <gtest/gtest.h>

#include "base/input_error.h"

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

TEST(EdsFile, RefusesWhatItDoesNotUnderstandAndSaysWhere) {
  const auto error_of = [](const std::string& text) {
    try {
      (void)parse(text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string head = kSheet;
  for (const auto& [text, part] :
       {std::pair<std::string, std::string>{head + "nonsense\n", "line 42"},
        {"a=1\n" + head, "before the first section"},
        {head + "[6064\n", "ends with ]"},
        {head + "[6064]\nDataType=long\nAccessType=ro\n", "DataType = 'long'"},
        {head + "[6064]\nDataType=0x4\nAccessType=maybe\n", "AccessType = 'maybe'"},
        {head + "[6064]\nDataType=0x4\nAccessType=ro\nDefaultValue=five\n", "'five'"},
        {head + "[6064]\nDataType=0x4\nDataType=0x4\n", "stands twice"},
        {head + "[1000]\nDataType=0x7\nAccessType=ro\n", "1000h:00 stands twice"},
        {"[FileInfo]\nFileName=x\n", "no objects"},
        {"", "no objects"}})
    EXPECT_NE(error_of(text).find(part), std::string::npos) << part << " in: " << error_of(text);
}

}  // namespace
}  // namespace strainwave::canopen
