// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/eds_check.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "base/input_error.h"
#include "drivers/can/canopen/canopen.h"
#include "drivers/can/canopen/sdo_client.h"
#include "drivers/can/cia402/cia402_setup.h"
#include "drivers/can/hexadecimal.h"

namespace strainwave::cia402 {

namespace {

using canopen::EdsEntry;
using canopen::Entry;

enum class Abort : std::uint32_t {
  kNone = 0,
  kUnsupported = 0x06010000,
  kWriteOnly = 0x06010001,
  kReadOnly = 0x06010002,
  kNoObject = 0x06020000,
  kNotMappable = 0x06040041,
  kPdoLength = 0x06040042,
  kLength = 0x06070010,
  kNoSubIndex = 0x06090011,
};

constexpr std::uint8_t kUpload = 2;
constexpr std::uint8_t kDownload = 1;
constexpr std::uint32_t kServoDrive = 0x00020192;
constexpr std::uint32_t kAllModes = 0x3FF;
constexpr std::uint32_t kDisabledAndPowered = 0x0250;
constexpr double kAssumedCurrent_A = 1.0;

/// A drive on the bus that answers from the data sheet. Time passes only while the caller waits.
class DataSheetDrive final : public CanPort {
 public:
  DataSheetDrive(const canopen::EdsFile& eds, const DriveConfig& config) : eds_(eds), config_(config) {
    for (const auto& [entry, object] : eds.entries) values_[entry] = object.value.value_or(0);
    assume_values();
  }

  SendResult send(const CanFrame& frame) noexcept override {
    if (frame.id == 0) obey(static_cast<canopen::NmtCommand>(frame.bytes[0]));
    if (frame.id == cob_id(canopen::CobId::kSdoRequest, config_.node_id)) answer(frame);
    return SendResult::kSent;
  }
  ReceiveResult receive(std::span<ReceivedFrame> frames) noexcept override {
    ReceiveResult result;
    for (; result.count < frames.size() && !queue_.empty(); queue_.pop_front()) {
      frames[result.count] = {};
      frames[result.count++].frame = queue_.front();
    }
    return result;
  }
  std::uint32_t overflows() const noexcept override { return 0; }
  bool wait(std::int64_t timeout_ns) override {
    if (queue_.empty()) now_ns_ += std::max<std::int64_t>(timeout_ns, 0);
    return !queue_.empty();
  }
  std::int64_t now_ns() override { return now_ns_; }

  /// Returns what the data sheet leaves open, and its limits that contradict start-up without being decisive.
  const std::vector<std::string>& notes() const noexcept { return notes_; }

 private:
  // A data sheet has no values that depend on the motor, and often no identity of the drive.
  void assume_values() {
    const auto assume = [&](Entry entry, std::int64_t value, const char* what) {
      const auto found = values_.find(entry);
      if (found == values_.end() || found->second != 0 || value == 0) return;
      found->second = value;
      note("not checked: " + to_text(entry) + " has no value in the data sheet; the check assumes " + what);
    };
    const Identity& identity = config_.identity;
    assume({0x1000, 0}, kServoDrive, "a servo drive");
    assume({0x1018, 1}, identity.vendor_id.value_or(0), "the configuration's vendor");
    assume({0x1018, 2}, identity.product_code.value_or(0), "the configuration's product");
    assume({0x1018, 3}, identity.revision_number.value_or(0), "the configuration's revision");
    assume({0x1018, 4}, identity.serial_number.value_or(0), "the configuration's serial number");
    assume({0x6502, 0}, kAllModes, "every mode");
    const UnitConfig& units = config_.units;
    const double current_A = config_.rated_current_A > 0.0 ? config_.rated_current_A : kAssumedCurrent_A;
    assume({0x6075, 0}, std::lround(current_A * 1e3), "the configuration's rated current, or 1 A");
    const double side = units.torque_at_joint ? units.gear_ratio : 1.0;
    const double rated_A =
        eds_.has_index(0x6075) ? static_cast<double>(values_.at({0x6075, 0})) * 1e-3 : current_A;
    assume({0x6076, 0},
           std::llround(rated_A * units.torque_constant_Nm_A * side / units.rated_torque_unit_Nm),
           "that current times the torque constant");
    assume({0x6065, 0},
           !closes_loop(config_.drive_mode)
               ? 0
               : std::llround(config_.following_error_rad / kTurn_rad * units.counts_per_output_revolution),
           "joint.limits.following_error_rad");
    if (values_.contains({0x6041, 0})) values_[{0x6041, 0}] = kDisabledAndPowered;
  }

  void note(const std::string& text) {
    if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) notes_.push_back(text);
  }

  /// Returns an entry that start-up reads, writes or maps, and notes it when it is unclear.
  const EdsEntry* touch(Entry entry) {
    const EdsEntry* object = eds_.find(entry);
    if (object != nullptr && !object->unclear.empty())
      note("not checked: " + to_text(entry) + " is unclear in the data sheet, " + object->unclear);
    return object;
  }

  void obey(canopen::NmtCommand command) {
    using canopen::NmtState;
    if (command == canopen::NmtCommand::kResetCommunication)
      queue_.push_back(canopen::heartbeat_frame(config_.node_id, NmtState::kBootUp));
    if (command == canopen::NmtCommand::kStart)
      queue_.push_back(canopen::heartbeat_frame(config_.node_id, NmtState::kOperational));
  }

  void answer(const CanFrame& request) {
    const Entry entry{static_cast<std::uint16_t>(little_endian(&request.bytes[1], 2)), request.bytes[3]};
    const int specifier = request.bytes[0] >> 5U;
    CanFrame frame = request;
    frame.id = cob_id(canopen::CobId::kSdoAnswer, config_.node_id);
    if (specifier == kUpload) {
      const EdsEntry* object = touch(entry);
      const Abort refused = object == nullptr  ? missing(entry)
                            : object->readable ? Abort::kNone
                                               : Abort::kWriteOnly;
      if (refused != Abort::kNone) return abort(frame, refused);
      // Text is not compared, so one zero byte replaces it. Four bytes hold any number of unclear type.
      const bool is_number = object->bytes > 0 && object->bytes <= 4;
      const std::size_t bytes = !object->unclear.empty() ? 4 : is_number ? object->bytes : 1;
      const std::int64_t value = is_number || !object->unclear.empty() ? values_.at(entry) : 0;
      frame.bytes = {};
      frame.bytes[0] = static_cast<std::uint8_t>(0x43U | (4U - bytes) << 2U);
      put_little_endian(&frame.bytes[1], 2, entry.index);
      frame.bytes[3] = entry.sub_index;
      put_little_endian(&frame.bytes[4], bytes, static_cast<std::uint64_t>(value));
      queue_.push_back(frame);
    } else if (specifier == kDownload) {
      const std::size_t bytes = 4U - ((request.bytes[0] >> 2U) & 3U);
      if (const Abort refused = write(entry, &request.bytes[4], bytes); refused != Abort::kNone)
        return abort(frame, refused);
      frame.bytes[0] = 0x60;
      put_little_endian(&frame.bytes[4], 4, 0);
      queue_.push_back(frame);
    }
  }

  void abort(CanFrame frame, Abort code) {
    frame.bytes[0] = 0x80;
    put_little_endian(&frame.bytes[4], 4, static_cast<std::uint32_t>(code));
    queue_.push_back(frame);
  }

  Abort missing(Entry entry) const noexcept {
    return eds_.has_index(entry.index) ? Abort::kNoSubIndex : Abort::kNoObject;
  }

  Abort write(Entry entry, const std::uint8_t* data, std::size_t bytes) {
    const EdsEntry* object = touch(entry);
    if (object == nullptr) return missing(entry);
    if (!object->writable) return Abort::kReadOnly;
    if (!has_size(*object, bytes)) return Abort::kLength;
    const std::uint64_t raw = little_endian(data, bytes);
    const unsigned unused = 64U - 8U * static_cast<unsigned>(bytes);
    const std::int64_t value = object->is_signed ? static_cast<std::int64_t>(raw << unused) >> unused
                                                 : static_cast<std::int64_t>(raw);
    if ((object->high && value > *object->high) || (object->low && value < *object->low))
      note(to_text(entry) + ": start-up writes " + std::to_string(value) +
           ", which the data sheet's limits do not allow; they are often wrong, and the drive decides");
    const bool mapping = (entry.index >= 0x1600 && entry.index < 0x1800) || entry.index >= 0x1A00;
    if (mapping && entry.index < 0x1C00)
      if (const Abort refused = map(entry, raw); refused != Abort::kNone) return refused;
    values_[entry] = value;
    // The simulated drive adopts the mode at once.
    if (entry == Entry{0x6060, 0} && values_.contains({0x6061, 0})) values_[{0x6061, 0}] = value;
    return Abort::kNone;
  }

  static bool has_size(const EdsEntry& object, std::uint64_t bytes) noexcept {
    return object.bytes == bytes || (object.bytes == 0 && !object.unclear.empty());
  }

  Abort map(Entry entry, std::uint64_t word) {
    if (entry.sub_index == 0) return word == 0 ? Abort::kNone : count_bits(entry.index, word);
    const EdsEntry* object =
        touch({static_cast<std::uint16_t>(word >> 16U), static_cast<std::uint8_t>(word >> 8U)});
    if (object == nullptr) return Abort::kNoObject;
    return object->mappable && has_size(*object, (word & 0xFFU) / 8) ? Abort::kNone : Abort::kNotMappable;
  }
  Abort count_bits(std::uint16_t index, std::uint64_t count) const {
    std::uint64_t bits = 0;
    for (std::uint64_t i = 1; i <= count; ++i) {
      const auto found = values_.find({index, static_cast<std::uint8_t>(i)});
      if (found == values_.end()) return Abort::kNoSubIndex;
      bits += static_cast<std::uint64_t>(found->second) & 0xFFU;
    }
    return bits <= 8 * kMaxCanBytes ? Abort::kNone : Abort::kPdoLength;
  }

  const canopen::EdsFile& eds_;
  const DriveConfig& config_;
  std::map<Entry, std::int64_t> values_;
  std::deque<CanFrame> queue_;
  std::vector<std::string> notes_;
  std::int64_t now_ns_ = 0;
};

}  // namespace

std::vector<std::string> check_data_sheet(const canopen::EdsFile& eds, const DriveConfig& wanted) {
  DriveConfig config = wanted;
  config.node_id = eds.node_id;
  std::vector<std::string> report;
  if (config.node_id != wanted.node_id)
    report.push_back(config.name + ": node_id = " + std::to_string(wanted.node_id) +
                     ", but the data sheet is for node " + std::to_string(eds.node_id) +
                     "; the check uses that");
  DataSheetDrive drive(eds, config);
  try {
    canopen::SdoClient client(drive, config.node_id, config.name);
    const Description description = identify_drive(client, config);
    PdoLayout layout = pdo_layout(config);
    const Found found = set_up_drive(client, config, layout, description);
    if (config.temperature && config.temperature->way == TemperatureObject::Way::kSdo) try {
        (void)client.upload_number(config.temperature->entry, bytes_of(config.temperature->type));
      } catch (const InputError& error) {
        throw InputError(error.what() +
                         std::string(", for joint.can.temperature: give index, sub_index and type of an "
                                     "object of this drive, or leave that table out"));
      }
    for (const std::string& note : drive.notes()) report.push_back(config.name + ": " + note);
    report.insert(report.end(), found.report.begin(), found.report.end());
  } catch (const InputError& error) {
    throw InputError(eds.file + ": " + error.what());
  }
  return report;
}

}  // namespace strainwave::cia402
