// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/cia402_node.h"

#include <algorithm>
#include <cmath>

#include "tests/support/can_nodes/text.h"

namespace strainwave::can_nodes {

namespace {

constexpr std::uint32_t kDeviceTypeServoDrive = 0x00020192;  // profile 402, servo drive

}  // namespace

Cia402Node::Cia402Node(const Cia402NodeConfig& config, NodeOutput& output)
    : config_(config),
      output_(output),
      consumer_(dictionary_),
      pdos_(dictionary_, config.node_id),
      sdo_(dictionary_, config.node_id),
      drive_(config.drive, dictionary_,
             {[this](PowerState from, PowerState to) { note_power(from, to); },
              [this](std::uint16_t code) { send_emergency(code); }, [this] { send_emergency(0); },
              [this] {
                output_.note(format("at-rest position_rad=%.6f", drive_.plant().state().position_rad));
              }}) {
  add_objects();
  for (const std::uint16_t index : config.lacks) dictionary_.remove(index);
  for (const Key key : config.read_only) dictionary_.make_read_only(key);
  dictionary_.listen([this](Key key) { written(key); });
}

void Cia402Node::add_objects() {
  using enum DataType;
  const auto record = [&](std::uint16_t index, std::initializer_list<std::uint32_t> values) {
    dictionary_.add({index, 0}, {kUnsigned8, Access::kConstant, static_cast<std::int64_t>(values.size())});
    std::uint8_t sub = 1;
    for (const std::uint32_t value : values)
      dictionary_.add({index, sub++}, {kUnsigned32, Access::kConstant, value});
  };
  dictionary_.add({0x1000, 0}, {kUnsigned32, Access::kConstant, kDeviceTypeServoDrive});
  dictionary_.add({0x1001, 0}, {kUnsigned8, Access::kReadOnly, 0, Mappable::kTransmit});
  dictionary_.add({0x1003, 0}, {kUnsigned8, Access::kReadWrite, 0, Mappable::kNo, 0, 0, {}});
  for (int n = 1; n <= kErrorHistory; ++n)
    dictionary_.add({0x1003, static_cast<std::uint8_t>(n)}, {kUnsigned32, Access::kReadOnly});
  dictionary_.add({0x1005, 0}, {kUnsigned32, Access::kReadWrite, 0x80});
  dictionary_.add({0x1006, 0}, {kUnsigned32, Access::kReadWrite, 0});
  dictionary_.add({0x1008, 0},
                  {kVisibleString, Access::kConstant, 0, Mappable::kNo, 0, 0, config_.device_name});
  dictionary_.add({0x1014, 0}, {kUnsigned32, Access::kConstant, 0x80 + config_.node_id});
  dictionary_.add({0x1017, 0}, {kUnsigned16});
  record(0x1018, {config_.vendor, config_.product, config_.revision, config_.serial});
  dictionary_.add({0x1029, 0}, {kUnsigned8, Access::kConstant, 1});
  dictionary_.add({0x1029, 1}, {kUnsigned8, Access::kReadWrite, 0, Mappable::kNo, 0, 2, {}});
  // The drive's own period is fixed. Cycles must be whole multiples of it.
  dictionary_.guard(0x1006, 0x1006, [this](Key, std::int64_t value) {
    return value % drive_.period_us() == 0 ? Abort::kNone : Abort::kInvalidValue;
  });
  dictionary_.guard(0x1005, 0x1005, [](Key, std::int64_t value) {
    return (value & 0x60000000) == 0 ? Abort::kNone : Abort::kInvalidValue;  // no producer, 11 bits
  });
}

void Cia402Node::send(const Frame& frame) {
  if (!cable_cut_) output_.send(frame);
}

void Cia402Node::power_on(std::int64_t now_us) {
  now_us_ = now_us;
  next_step_us_ = now_us + drive_.period_us();
  reset(Reset::kNode);
}

void Cia402Node::reset(Reset what) {
  if (what == Reset::kNode) {
    dictionary_.restore(0x2000, 0xFFFF);
    drive_.restart();
  } else {
    leave_operation();
  }
  dictionary_.restore(0x1000, 0x1FFF);
  sdo_.reset();
  consumer_.restart();
  late_.clear();
  answers_.clear();
  start_done_us_.reset();
  last_sync_us_.reset();
  change_nmt(NmtState::kBooting);
  boot_done_us_ = now_us_ + config_.boot_us;
}

// The master ends the operation by NMT. A drive that is powered treats this as a lost connection.
void Cia402Node::leave_operation() {
  if (drive_.power() == PowerState::kOperationEnabled) drive_.lose_connection();
}

void Cia402Node::finish_boot() {
  send({0x700U + config_.node_id, {0x00}});
  change_nmt(NmtState::kPreOperational);
}

void Cia402Node::finish_start() {
  start_done_us_.reset();
  change_nmt(NmtState::kOperational);
}

void Cia402Node::change_nmt(NmtState state) {
  if (state == nmt_) return;
  nmt_ = state;
  pdos_.set_configurable(state != NmtState::kOperational);
  if (state == NmtState::kOperational) pdos_.begin();
  output_.note(std::string("nmt ") + to_text(state));
}

void Cia402Node::obey_nmt(const Frame& frame) {
  if (ignores_nmt_ || frame.length != 2 || (frame.data[1] != 0 && frame.data[1] != config_.node_id)) return;
  switch (frame.data[0]) {
    case 0x01:
      if (nmt_ != NmtState::kOperational) start_done_us_ = now_us_ + config_.start_us;
      if (config_.start_us == 0) finish_start();
      break;
    case 0x02:
      leave_operation();
      change_nmt(NmtState::kStopped);
      break;
    case 0x80:
      change_nmt(NmtState::kPreOperational);
      break;
    case 0x81:
      output_.note("reset node");
      reset(Reset::kNode);
      break;
    case 0x82:
      output_.note("reset communication");
      reset(Reset::kCommunication);
      break;
    default:
      break;
  }
}

void Cia402Node::receive(const Frame& frame, std::int64_t now_us) {
  advance(now_us);
  if (cable_cut_ || nmt_ == NmtState::kBooting) return;
  if (frame.id == 0) {
    obey_nmt(frame);
  } else if (frame.id == (dictionary_.number({0x1005, 0}) & 0x7FF)) {
    on_sync();
  } else if (frame.id == 0x600U + config_.node_id) {
    if (nmt_ != NmtState::kStopped) answer_sdo(frame);
  } else if (frame.id > 0x700 && frame.id <= 0x77F) {
    if (frame.length == 1) consumer_.heard(static_cast<std::uint8_t>(frame.id - 0x700), now_us);
  } else if (nmt_ == NmtState::kOperational) {
    receive_pdo(frame);
  }
}

void Cia402Node::answer_sdo(const Frame& frame) {
  const std::optional<Frame> answer = sdo_.answer(frame);
  if (!answer) return;
  if (answer->data[0] == 0x80)
    output_.note(format("sdo-abort %02X%02X:%02X %08X", answer->data[2], answer->data[1], answer->data[3],
                        static_cast<unsigned>(little_endian(answer->bytes().subspan(4, 4)))));
  if (config_.sdo_answer_us > 0)
    answers_.push_back({now_us_ + config_.sdo_answer_us, *answer});
  else
    send(*answer);
}

void Cia402Node::receive_pdo(const Frame& frame) {
  const Reception reception = pdos_.receive(frame, now_us_);
  if (reception == Reception::kTooShort) send_emergency(kErrorPdoLength);
}

std::int64_t Cia402Node::sync_period_us() const {
  const auto count = static_cast<double>(dictionary_.number({0x60C2, 1}));
  const auto exponent = static_cast<double>(dictionary_.number({0x60C2, 2}));
  const auto interpolation_us =
      static_cast<std::int64_t>(std::llround(count * std::pow(10.0, exponent + 6.0)));
  const std::int64_t communication_us = dictionary_.number({0x1006, 0});
  return std::max(communication_us > 0 ? communication_us : interpolation_us, drive_.period_us());
}

// The TPDOs carry the values at the instant of the SYNC. The values of the RPDOs act from then on.
void Cia402Node::on_sync() {
  ++syncs_;
  if (late_at_rate_us_ > 0) {
    late_us_ = late_at_rate_us_;
    late_syncs_ = last_sync_us_ && now_us_ - *last_sync_us_ < 10'000 ? 1000 : 0;
  }
  if (last_sync_us_) longest_sync_gap_us_ = std::max(longest_sync_gap_us_, now_us_ - *last_sync_us_);
  last_sync_us_ = now_us_;
  if (nmt_ == NmtState::kOperational) {
    send_synchronous();
    pdos_.use_held();
  }
  const std::int64_t period_us = sync_period_us();
  drive_.take_setpoint(period_us);
  for (std::int64_t t = 0; t < period_us; t += drive_.period_us()) step_drive();
  next_step_us_ = now_us_ + period_us + period_us / 2;
}

void Cia402Node::send_synchronous() {
  for (const Frame& frame : pdos_.due_at_sync()) {
    if (skipped_syncs_ > 0) continue;
    if (late_syncs_ > 0)
      late_.push_back({now_us_ + late_us_, frame});
    else
      send(frame);
  }
  if (skipped_syncs_ > 0) --skipped_syncs_;
  if (late_syncs_ > 0) --late_syncs_;
}

void Cia402Node::step_drive() {
  drive_.step();
  if (notes_torque_) note_torque();
}

void Cia402Node::advance(std::int64_t now_us) {
  now_us_ = now_us;
  while (next_step_us_ <= now_us) {
    step_drive();
    next_step_us_ += drive_.period_us();
  }
  if (nmt_ == NmtState::kBooting) {
    if (now_us >= boot_done_us_) finish_boot();
    if (nmt_ == NmtState::kBooting) return;
  }
  if (start_done_us_ && now_us >= *start_done_us_) finish_start();
  while (!answers_.empty() && answers_.front().due_us <= now_us) {
    send(answers_.front().frame);
    answers_.pop_front();
  }
  while (!late_.empty() && late_.front().due_us <= now_us) {
    send(late_.front().frame);
    late_.pop_front();
  }
  const std::int64_t heartbeat_us = dictionary_.number({0x1017, 0}) * 1000;
  if (heartbeat_us > 0 && now_us >= next_heartbeat_us_) {
    if (!heartbeat_off_) send({0x700U + config_.node_id, {static_cast<std::uint8_t>(nmt_)}});
    next_heartbeat_us_ = std::max(next_heartbeat_us_ + heartbeat_us, now_us + heartbeat_us / 2);
  }
  while (const auto lost = consumer_.lost(now_us)) on_heartbeat_lost(*lost);
  if (nmt_ != NmtState::kOperational) return;
  if (const auto deadline_us = pdos_.rpdo_deadline_us(); deadline_us && now_us >= *deadline_us) {
    output_.note("rpdo-missing");
    pdos_.forget_rpdos();
    send_emergency(kErrorRpdoTimeout);
    drive_.lose_connection();
  }
  for (const Frame& frame : pdos_.due_by_event(now_us)) send(frame);
}

std::int64_t Cia402Node::next_deadline_us() const {
  std::int64_t next = next_step_us_;
  if (nmt_ == NmtState::kBooting) return std::min(next, boot_done_us_);
  if (dictionary_.number({0x1017, 0}) > 0) next = std::min(next, next_heartbeat_us_);
  if (start_done_us_) next = std::min(next, *start_done_us_);
  if (!answers_.empty()) next = std::min(next, answers_.front().due_us);
  if (!late_.empty()) next = std::min(next, late_.front().due_us);
  if (const auto consumer = consumer_.next_deadline_us()) next = std::min(next, *consumer);
  if (const auto rpdo = pdos_.rpdo_deadline_us(); rpdo && nmt_ == NmtState::kOperational)
    next = std::min(next, *rpdo);
  return next;
}

}  // namespace strainwave::can_nodes
