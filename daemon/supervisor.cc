// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/supervisor.h"

#include <poll.h>
#include <sodium.h>
#include <spdlog/spdlog.h>

#include <array>
#include <new>
#include <optional>
#include <stdexcept>

#include "base/input_error.h"
#include "base/printable.h"
#include "daemon/admission/verdict.h"
#include "daemon/assembly.h"
#include "daemon/drive_check.h"
#include "daemon/gateway/preference.h"
#include "daemon/initial_table.h"
#include "daemon/loop_log.h"
#include "daemon/realtime/loop/realtime_setup.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/fingerprints.h"

namespace strainwave {

namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kTurn_ms = 5;
constexpr std::int64_t kTemperatureEvery_ns = 100 * kMillisecond_ns;
constexpr std::int64_t kTimingEvery_ns = 1000 * kMillisecond_ns;
constexpr std::int64_t kStatusEvery_ns = 1000 * kMillisecond_ns;
std::int64_t make_session_id() {
  if (::sodium_init() < 0) throw std::runtime_error("libsodium cannot be initialised");
  std::int64_t id = 0;
  ::randombytes_buf(&id, sizeof id);
  return id & INT64_MAX;
}

std::vector<InstanceLock> take_locks(const DaemonConfig& config) {
  std::vector<InstanceLock> locks;
  locks.emplace_back("prefix " + config.prefix,
                     "stop that one (systemctl stop strainwaved), or give this one its own daemon.prefix");
  for (InstanceLock& lock : lock_drives(config)) locks.push_back(std::move(lock));
  return locks;
}

std::vector<FlightRecordWriter::Source> recorded_joints(const DaemonConfig& config, RealtimeLoop& loop) {
  std::vector<FlightRecordWriter::Source> sources;
  for (std::size_t i = 0; i < config.joints.size() && config.recorder.enabled(); ++i)
    sources.push_back(
        {config.joints[i].name, std::string(config.joints[i].plant.joint_model.view()), loop.recorder(i)});
  return sources;
}

// Runs in the writer's thread. A full or missing disk must not fill the log.
FlightRecordWriter::Report log_flight_records() {
  constexpr int kComplaints = 5;
  constexpr std::int64_t kComplaintWindow_ns = 60'000 * kMillisecond_ns;
  return [complaints = LogLimiter(kComplaints, kComplaintWindow_ns)](bool lost, const std::string& text,
                                                                     std::int64_t now_ns) mutable {
    if (!lost) return spdlog::info("{}", text);
    std::int64_t suppressed = 0;
    if (!complaints.allow(now_ns, suppressed)) return;
    if (suppressed > 0) spdlog::warn("not logged: {} about flight records", counted(suppressed, "more line"));
    spdlog::warn("{}", text);
  };
}

std::vector<std::string> names_of(const DaemonConfig& config) {
  std::vector<std::string> names;
  for (const JointConfig& joint : config.joints) names.push_back(joint.name);
  return names;
}

}  // namespace

Supervisor::Supervisor(const DaemonConfig& config)
    : config_(config),
      locks_(take_locks(config)),
      session_id_(make_session_id()),
      outbound_file_(MemoryFile::create("strainwave-outbound", sizeof(OutboundMemory), true)),
      inbound_file_(MemoryFile::create("strainwave-inbound", sizeof(InboundMemory), false)),
      outbound_(*new (outbound_file_.address()) OutboundMemory),
      inbound_(*new (inbound_file_.address()) InboundMemory),
      loop_(config.loop, assemble_loop(config), outbound_.states),
      flight_records_(config.recorder, config.loop.period_s, session_id_, recorded_joints(config, loop_),
                      log_flight_records()),
      friction_(config.state_directory, names_of(config)),
      admission_(config.prefix, session_id_, assemble_admission(config), config.security),
      answers_(config.prefix, session_id_, names_of(config), outbound_.messages),
      orders_(loop_, admission_, answers_),
      gateway_(config, {outbound_file_.descriptor(), inbound_file_.descriptor(), wake_.gateway_end()},
               inbound_),
      latest_(config.joints.size()),
      refusal_log_(20, 10'000 * kMillisecond_ns),
      incoming_(std::make_unique<WireMessage>()) {
  for (const std::string& warning : config.warnings) spdlog::warn("{}", warning);
  fill_shared_memory();
  load_initial_tables();
}

void Supervisor::fill_shared_memory() {
  outbound_.prefix = FixedString<32>(config_.prefix);
  outbound_.lcm_url = FixedString<256>(config_.lcm_url);
  outbound_.session_id = session_id_;
  outbound_.gateway_uid = config_.gateway_user.uid;
  outbound_.gateway_gid = config_.gateway_user.gid;
  outbound_.joint_count = config_.joints.size();
  for (std::size_t i = 0; i < config_.joints.size(); ++i)
    outbound_.joint_names[i] = FixedString<32>(config_.joints[i].name);
}

// The loop has not started yet: these orders wait in its queues, and it executes them first.
void Supervisor::load_initial_tables() {
  for (std::size_t i = 0; i < config_.joints.size(); ++i) {
    const JointConfig& joint = config_.joints[i];
    const auto initial = read_initial_table(joint);
    if (!initial) continue;
    spdlog::info("{}: table {} from {}, {}", joint.name, initial->table.name.view(), joint.table.string(),
                 initial->verdict);
    for (const std::string& doubt : initial->doubts) spdlog::warn("{}", doubt);
    if (!orders_.load_first_table(i, initial->table))
      throw InputError(joint.table.string() + ": cannot be loaded for joint " + joint.name);
    friction_.restore(i, initial->table.friction, loop_.joint(i), monotonic_now_ns());
  }
}

void Supervisor::run() {
  if (config_.gateway_user.uid < 0) hide_memory_from_own_user();
  // First: a child of a real-time process would inherit too much.
  if (!gateway_.start([this] { return !signals_.take(); })) return;
  flight_records_.start();
  friction_.start();
  orders_.start();
  log_buses();
  publish_challenge();  // so that the first state carries one
  loop_.start();
  // Later than the start of the other threads, which must not inherit this priority.
  if (const std::string refusal = prefer_this_thread(); !refusal.empty()) spdlog::warn("{}", refusal);
  if (loop_.real_time_refusal().empty())
    spdlog::info("real time: SCHED_FIFO priority {}, memory locked", config_.loop.priority);
  else
    spdlog::warn("no real time: {}", loop_.real_time_refusal());
  if (!loop_.sleep_state_refusal().empty()) spdlog::warn("{}", loop_.sleep_state_refusal());
  if (const std::string warning = compaction_warning(); !warning.empty()) spdlog::warn("{}", warning);
  spdlog::info("prefix {}, {}, period {} s, session {}", config_.prefix,
               counted(config_.joints.size(), "joint"), config_.loop.period_s, session_id_);
  while (!loop_.finished()) {
    wait(kTurn_ms);
    turn(monotonic_now_ns());
  }
  loop_.close_buses();
  turn(monotonic_now_ns());
  friction_.finish();
  spdlog::info("stopped: every joint is at rest");
}

void Supervisor::turn(std::int64_t now_ns) {
  take_events();  // first: an order from before a fault must not act after it
  publish_challenge();
  take_messages(now_ns);
  publish_challenge();  // before a stop is answered, states carry the challenge that is valid after it
  if (const auto refused = orders_.take_replies(now_ns)) log_refusal(*refused, now_ns);
  log_buses();
  publish_owners(now_ns);
  take_states(now_ns);
  gateway_.watch(!stopping_, now_ns);
  publish_timing(now_ns);
  tell_systemd(now_ns);
}

void Supervisor::wait(std::int64_t wait_ms) {
  const int timeout_ms =
      orders_.waiting() ? 1 : static_cast<int>(wait_ms);  // the loop cannot wake this thread when it replies
  std::array<pollfd, 2> descriptors{{{wake_.core_end(), POLLIN, 0}, {signals_.descriptor(), POLLIN, 0}}};
  if (::poll(descriptors.data(), descriptors.size(), timeout_ms) <= 0) return;
  wake_.take();
  const std::optional<int> signal = signals_.take();
  if (!signal || stopping_) return;
  stopping_ = true;
  spdlog::info("signal {}: bringing every joint to rest", *signal);
  service_.stopping();
  admission_.end_orders();
  loop_.request_stop();
}

void Supervisor::publish_challenge() {
  std::int64_t random = 0;
  ::randombytes_buf(&random, sizeof random);
  const std::int64_t cycle = loop_.statistics().cycle.load(std::memory_order_acquire);
  outbound_.challenge.store(admission_.advance(cycle, random), std::memory_order_relaxed);
}

void Supervisor::publish_owners(std::int64_t now_ns) {
  for (std::size_t i = 0; i < config_.joints.size(); ++i) {
    const Ownership& ownership = admission_.ownership();
    outbound_.leases[i].owner_id.store(ownership.owner_id(i, now_ns), std::memory_order_relaxed);
    outbound_.leases[i].lease_s.store(ownership.lease_s(i, now_ns), std::memory_order_relaxed);
  }
}

void Supervisor::take_messages(std::int64_t now_ns) {
  // The bound keeps a gateway that never stops writing from delaying everything else.
  for (std::size_t i = 0; i < 2 * InboundLane::kMessages; ++i)
    if (!take_message(inbound_.stops, stops_taken_, outbound_.stops_taken, now_ns) &&
        !take_message(inbound_.orders, orders_taken_, outbound_.orders_taken, now_ns))
      return;
}

// Takes the next message of `lane`. `taken` counts the messages; `told` gives the count to the gateway. Returns false without a message.
bool Supervisor::take_message(const InboundLane& lane, std::uint64_t& taken, std::atomic<std::uint64_t>& told,
                              std::int64_t now_ns) {
  const std::uint64_t written = lane.written.load(std::memory_order_acquire);
  // A gateway with a false counter loses its own messages. It harms neither the daemon nor the next gateway.
  if (written - taken > InboundLane::kMessages) told.store(taken = written, std::memory_order_release);
  if (taken == written) return false;
  *incoming_ = lane.messages[taken % InboundLane::kMessages];
  told.store(++taken, std::memory_order_release);
  Verdict verdict = admission_.consider(*incoming_, now_ns);
  orders_.handle(verdict, now_ns);
  if (verdict.kind == Verdict::Kind::kDiscard || verdict.kind == Verdict::Kind::kRefuse)
    log_refusal(verdict, now_ns);
  return true;
}

void Supervisor::take_events() {
  LoopEvent event;
  while (loop_.events().pop(event)) {
    const JointConfig& joint = config_.joints[static_cast<std::size_t>(event.joint)];
    if (tells_of_fault(event)) admission_.fault(static_cast<std::size_t>(event.joint), event.cycle);
    log_loop_event(joint, event);
  }
}

void Supervisor::log_buses() {
  for (const auto& bus : loop_.buses())
    for (const std::string& line : bus->take_messages()) spdlog::info("{}", line);
}

void Supervisor::take_states(std::int64_t now_ns) {
  StateRecord record{};
  std::uint64_t dropped = 0;
  while (outbound_.states.read(state_cursor_, record, dropped)) {
    latest_[static_cast<std::size_t>(record.joint_index)] = record;
    orders_.observe(record);
    friction_.observe(record, now_ns);
  }
  if (state_cursor_ == 0 || now_ns < temperature_due_ns_) return;
  temperature_due_ns_ = now_ns + kTemperatureEvery_ns;
  for (const StateRecord& latest : latest_) answers_.temperature(latest);
}

void Supervisor::publish_timing(std::int64_t now_ns) {
  if (now_ns < timing_due_ns_) return;
  timing_due_ns_ = now_ns + kTimingEvery_ns;
  for (std::size_t i = 0; i < config_.joints.size(); ++i)
    answers_.limits(i, config_.joints[i].plant, config_.joints[i].loop);
  answers_.timing(loop_.statistics(), admission_.rejects(), config_.loop, loop_.real_time_refusal().empty(),
                  static_cast<std::int64_t>(inbound_.state_records_dropped.load(std::memory_order_relaxed)));
}

void Supervisor::tell_systemd(std::int64_t now_ns) {
  const bool was_ready = service_.ready();
  const LoopTotals& statistics = loop_.statistics();
  service_.update(statistics.cycles.load(std::memory_order_acquire),
                  statistics.overruns.load(std::memory_order_acquire), now_ns);
  if (service_.ready() && !was_ready) spdlog::info("ready: the loop meets its timing");
  if (now_ns < status_due_ns_ || state_cursor_ == 0) return;
  status_due_ns_ = now_ns + kStatusEvery_ns;
  std::string status;
  for (std::size_t i = 0; i < latest_.size(); ++i)
    status += (i == 0 ? "" : ", ") + config_.joints[i].name + ' ' +
              std::string(to_text(static_cast<Mode>(latest_[i].state.mode)));
  service_.show(status);
}

void Supervisor::log_refusal(const Verdict& verdict, std::int64_t now_ns) {
  std::int64_t suppressed = 0;
  if (!refusal_log_.allow(now_ns, suppressed)) return;
  if (suppressed > 0) spdlog::warn("not logged: {}", counted(suppressed, "more refused message"));
  if (verdict.kind == Verdict::Kind::kDiscard) {
    const auto name = parse_channel(incoming_->channel.view());
    const bool other = name && is_of_another_version(name->kind, payload(*incoming_));
    spdlog::warn("message {}on {} discarded: {}", other ? "of another version " : "",
                 incoming_->channel.view(), to_text(verdict.reason));
  } else
    spdlog::warn("{}: refused: {}: {}", config_.joints[verdict.requester.joint].name, to_text(verdict.reason),
                 verdict.text);
}

}  // namespace strainwave
