#include "daemon/supervisor.h"

#include <poll.h>
#include <signal.h>
#include <sodium.h>
#include <spdlog/spdlog.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <new>
#include <system_error>
#include <thread>

#include "base/input_error.h"
#include "control/gain_table_json.h"
#include "daemon/admission/table_admission.h"
#include "daemon/assembly.h"
#include "daemon/drive_check.h"
#include "daemon/realtime/realtime_setup.h"

namespace strainwave {

namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kTurn_ms = 5;
constexpr std::int64_t kReplyTimeout_ns = 500 * kMillisecond_ns;
constexpr std::int64_t kTemperatureEvery_ns = 100 * kMillisecond_ns;
constexpr std::int64_t kTimingEvery_ns = 1000 * kMillisecond_ns;
constexpr std::int64_t kStatusEvery_ns = 1000 * kMillisecond_ns;
/// A gateway that does nothing for this long hangs.
constexpr std::int64_t kGatewaySilence_ns = 2000 * kMillisecond_ns;
/// Answers a second to messages that anybody could have sent: enough for people, too few to crowd out the others.
constexpr double kStrangerAnswersPer_s = 200.0;
constexpr double kStrangerAnswersAtOnce = 50.0;
constexpr std::int64_t kGatewayStart_ns = 5000 * kMillisecond_ns;

std::int64_t make_session_id() {
  if (::sodium_init() < 0) throw std::runtime_error("libsodium cannot be initialised");
  std::int64_t id = 0;
  ::randombytes_buf(&id, sizeof id);
  return id & INT64_MAX;
}

// Every signal that somebody or something may send and that would kill the core, in motion: they all end it in order. What is
// left (SIGSEGV and its kin) tells that it is broken; SIGKILL and SIGSTOP nobody can refuse.
constexpr std::array kEndSignals{SIGTERM, SIGINT,    SIGHUP,  SIGQUIT, SIGUSR1, SIGUSR2,   SIGALRM,
                                 SIGPROF, SIGVTALRM, SIGPOLL, SIGPWR,  SIGXCPU, SIGSTKFLT, SIGTRAP};

int make_signal_fd() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGCHLD);
  for (const int signal : kEndSignals) ::sigaddset(&signals, signal);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) ::sigaddset(&signals, signal);
  // A terminal must not be able to make the loop stand still.
  for (const int signal : {SIGTSTP, SIGTTIN, SIGTTOU}) ::signal(signal, SIG_IGN);
  // Blocked before any thread starts, so that all signals arrive here.
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  const int descriptor = ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
  return descriptor;
}

std::vector<InstanceLock> take_locks(const DaemonConfig& config) {
  std::vector<InstanceLock> locks;
  locks.emplace_back("prefix " + config.prefix,
                     "stop that one (systemctl stop strainwaved), or give this one its own daemon.prefix");
  for (InstanceLock& lock : lock_drives(config)) locks.push_back(std::move(lock));
  return locks;
}

// What the loop's refusal means for whoever asked: the mode it met, and the way on.
std::string advice(const Reply& reply) {
  const std::string mode = "the joint is " + std::string(to_text(reply.mode));
  switch (reply.reason) {
    case Reason::kNoTable:
      return mode + ": load a gain table first";
    case Reason::kFaulted:
      return mode + ": see its fault, remove the cause, clear the fault";
    case Reason::kMoving:
      return reply.mode == Mode::kOff
                 ? mode + " and moves at " + std::to_string(reply.joint_velocity_rad_s) +
                       " rad/s: it is enabled only at standstill (joint.supervision.standstill_rad_s)"
                 : mode + ": hold or disable it first, a table is taken over only at standstill";
    case Reason::kEnding:
      return mode + ", and the daemon brings every joint to rest: start it again";
    case Reason::kStreamExpired:
      return mode +
             ", and its stream of setpoints has expired: send a hold or a move before a new stream begins";
    case Reason::kNotHomed:
      return mode + ", and its position is not known: strainwavectl home first";
    case Reason::kAtLimitSwitch:
      return mode + " at a limit switch: only a move away from it is possible";
    case Reason::kNoHoming:
      return mode + ", and joint.homing says of no switch or index that it is home";
    case Reason::kDriveNotReady:
      return mode + ", and its drive gives no position: check supply and connection";
    case Reason::kWrongMode:
      return mode + (reply.mode == Mode::kOff ? ": motion needs it enabled"
                                              : ": this order does nothing in this mode");
    default:
      return mode;
  }
}

// The drive's own reason behind a fault, if there is one.
std::string drive_words(const JointConfig& joint, const LoopEvent& event) {
  if (event.drive_error == 0 || joint.drive_error_text == nullptr) return "";
  return ": " + joint.drive_error_text(event.fault, event.drive_error);
}

std::vector<FlightRecordWriter::Source> recorded_joints(const DaemonConfig& config, RealtimeLoop& loop) {
  std::vector<FlightRecordWriter::Source> sources;
  for (std::size_t i = 0; i < config.joints.size() && config.recorder.enabled(); ++i)
    sources.push_back(
        {config.joints[i].name, std::string(config.joints[i].plant.joint_model.view()), loop.recorder(i)});
  return sources;
}

// In the writer's thread. A disk that is full or gone shall not fill the log.
FlightRecordWriter::Report log_flight_records() {
  constexpr int kComplaints = 5;
  constexpr std::int64_t kComplaintWindow_ns = 60'000 * kMillisecond_ns;
  return [complaints = LogLimiter(kComplaints, kComplaintWindow_ns)](bool lost, const std::string& text,
                                                                     std::int64_t now_ns) mutable {
    if (!lost) return spdlog::info("{}", text);
    std::int64_t suppressed = 0;
    if (!complaints.allow(now_ns, suppressed)) return;
    if (suppressed > 0) spdlog::warn("{} more lines about flight records were not logged", suppressed);
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
      signal_fd_(make_signal_fd()),
      loop_(config.loop, assemble_loop(config), outbound_.states),
      flight_records_(config.recorder, config.loop.period_s, session_id_, recorded_joints(config, loop_),
                      log_flight_records()),
      admission_(config.prefix, session_id_, assemble_admission(config), config.security),
      answers_(config.prefix, session_id_, names_of(config), outbound_.messages),
      gateway_(find_gateway_program(),
               {outbound_file_.descriptor(), inbound_file_.descriptor(), wake_.gateway_end()}),
      books_(config.joints.size()),
      latest_(config.joints.size()),
      refusal_log_(20, 10'000 * kMillisecond_ns),
      dropped_log_(1, 10'000 * kMillisecond_ns),
      stranger_answers_(kStrangerAnswersPer_s, kStrangerAnswersAtOnce),
      stop_answers_(kStrangerAnswersPer_s, kStrangerAnswersAtOnce),
      incoming_(std::make_unique<WireMessage>()) {
  fill_shared_memory();
  load_initial_tables();
}

Supervisor::~Supervisor() {
  ::close(signal_fd_);
}

void Supervisor::fill_shared_memory() {
  outbound_.prefix = FixedString<32>(config_.prefix);
  outbound_.lcm_url = FixedString<256>(config_.lcm_url);
  outbound_.session_id = session_id_;
  outbound_.core_pid = ::getpid();
  outbound_.gateway_uid = config_.gateway_user.uid;
  outbound_.gateway_gid = config_.gateway_user.gid;
  outbound_.joint_count = config_.joints.size();
  for (std::size_t i = 0; i < config_.joints.size(); ++i)
    outbound_.joint_names[i] = FixedString<32>(config_.joints[i].name);
}

// The loop has not started: the orders wait in the queues and are its first.
void Supervisor::load_initial_tables() {
  for (std::size_t i = 0; i < config_.joints.size(); ++i) {
    const JointConfig& joint = config_.joints[i];
    if (joint.table.empty()) continue;
    Verdict verdict;
    verdict.table = std::make_unique<GainTable>(read_gain_table(joint.table));
    const TableVerdict judged =
        judge_table(*verdict.table, joint.plant, joint.loop.controller.torque_limit_Nm);
    if (judged.reason != Reason::kAccepted)
      throw InputError(joint.table.string() + ": refused for joint " + joint.name + ": " + judged.text);
    spdlog::info("{}: table {} from {}, {}", joint.name, verdict.table->name.view(), joint.table.string(),
                 judged.text);
    verdict.requester.joint = i;
    verdict.order.kind = OrderKind::kUseTable;
    if (!prepare_table(verdict) || !loop_.joint(i).orders().push(verdict.order))
      throw InputError(joint.table.string() + ": cannot be loaded for joint " + joint.name);
    books_[i].end(true);
  }
}

void Supervisor::start_gateway() {
  gateway_.start(monotonic_now_ns());
  const std::int64_t deadline_ns = monotonic_now_ns() + kGatewayStart_ns;
  while (inbound_.ready.load(std::memory_order_acquire) == 0) {
    const std::int64_t now_ns = monotonic_now_ns();
    if (const auto end = gateway_.take_end(now_ns))
      throw InputError(
          "the gateway ended with " + *end +
          (gateway_.last_exit_status() == kGatewayExitNoLcm ? ": LCM is not available, see above" : ""));
    if (now_ns > deadline_ns) throw InputError("the gateway did not become ready in 5 s");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

void Supervisor::run() {
  if (config_.gateway_user.uid < 0) hide_memory_from_own_user();
  // The gateway first: a process started by a real-time one would inherit too much.
  start_gateway();
  flight_records_.start();
  log_buses();
  spdlog::info("gateway: {}", config_.gateway_user.name.empty() ? "as the daemon's own user"
                                                                : "as user " + config_.gateway_user.name);
  loop_.start();
  if (loop_.real_time_refusal().empty())
    spdlog::info("real time: SCHED_FIFO priority {}, memory locked", config_.loop.priority);
  else
    spdlog::warn("no real time: {}", loop_.real_time_refusal());
  if (!loop_.sleep_state_refusal().empty()) spdlog::warn("{}", loop_.sleep_state_refusal());
  if (const std::string warning = compaction_warning(); !warning.empty()) spdlog::warn("{}", warning);
  spdlog::info("prefix {}, {} joint(s), period {} s, session {}", config_.prefix, config_.joints.size(),
               config_.loop.period_s, session_id_);
  while (!loop_.finished()) {
    wait(kTurn_ms);
    turn(monotonic_now_ns());
  }
  loop_.close_buses();
  turn(monotonic_now_ns());
  spdlog::info("stopped: every joint is at rest");
}

void Supervisor::turn(std::int64_t now_ns) {
  take_messages(now_ns);
  take_replies(now_ns);
  take_events();
  log_buses();
  take_states(now_ns);
  watch_gateway(now_ns);
  publish_timing(now_ns);
  tell_systemd(now_ns);
}

void Supervisor::wait(std::int64_t wait_ms) {
  // While the loop owes a reply, look often: it has no way to wake anybody.
  const int timeout_ms = pending_.empty() ? static_cast<int>(wait_ms) : 1;
  std::array<pollfd, 2> descriptors{{{wake_.core_end(), POLLIN, 0}, {signal_fd_, POLLIN, 0}}};
  if (::poll(descriptors.data(), descriptors.size(), timeout_ms) <= 0) return;
  wake_.take();
  signalfd_siginfo signal{};
  while (::read(signal_fd_, &signal, sizeof signal) == sizeof signal) {
    if (signal.ssi_signo == SIGCHLD || stopping_) continue;
    stopping_ = true;
    spdlog::info("signal {}: bringing every joint to rest", signal.ssi_signo);
    service_.stopping();
    loop_.request_stop();
  }
}

void Supervisor::take_messages(std::int64_t now_ns) {
  // A bound on a turn, or a gateway that never stops writing would keep everything else waiting.
  for (std::size_t i = 0; i < 2 * InboundLane::kMessages; ++i)
    if (!take_message(inbound_.stops, stops_taken_, outbound_.stops_taken, now_ns) &&
        !take_message(inbound_.orders, orders_taken_, outbound_.orders_taken, now_ns))
      return;
}

// The next message of `lane`, of which `taken` have been taken, as the gateway is `told`. False when there is none.
bool Supervisor::take_message(const InboundLane& lane, std::uint64_t& taken, std::atomic<std::uint64_t>& told,
                              std::int64_t now_ns) {
  const std::uint64_t written = lane.written.load(std::memory_order_acquire);
  // A gateway that lies about its counter loses what it sent and harms nobody, nor the one that comes after it.
  if (written - taken > InboundLane::kMessages) told.store(taken = written, std::memory_order_release);
  if (taken == written) return false;
  *incoming_ = lane.messages[taken % InboundLane::kMessages];
  told.store(++taken, std::memory_order_release);
  dispatch(admission_.consider(*incoming_, now_ns), now_ns);
  return true;
}

void Supervisor::dispatch(Verdict verdict, std::int64_t now_ns) {
  switch (verdict.kind) {
    case Verdict::Kind::kDiscard:
      return log_refusal(verdict, now_ns);
    case Verdict::Kind::kRepeat:
      if (stranger_answers_.try_take(now_ns)) answers_.repeat(verdict.requester);
      return;
    case Verdict::Kind::kRefuse:
      log_refusal(verdict, now_ns);
      return answer(verdict.requester, verdict.reason, verdict.text, now_ns);
    case Verdict::Kind::kOrder:
      break;
  }
  const bool is_table = verdict.order.kind == OrderKind::kUseTable;
  if (is_table && !prepare_table(verdict)) {
    admission_.count_reject(verdict.reason);
    log_refusal(verdict, now_ns);
    return answer(verdict.requester, verdict.reason, verdict.text, now_ns);
  }
  verdict.order.id = next_order_id_++;
  if (!loop_.joint(verdict.requester.joint).orders().push(verdict.order)) {
    if (is_table) books_[verdict.requester.joint].end(false);
    admission_.count_reject(Reason::kBusy);
    return answer(verdict.requester, Reason::kBusy,
                  "too many orders at once: send fewer, or wait for answers", now_ns);
  }
  pending_[verdict.order.id] = {verdict.requester, verdict.text, now_ns + kReplyTimeout_ns, is_table};
}

void Supervisor::answer(const Requester& to, Reason reason, const std::string& text, std::int64_t now_ns) {
  // What a stranger may order is a stop. That it was obeyed has a share of its own, which no flood of refusals uses up.
  TokenBucket& share = reason == Reason::kAccepted ? stop_answers_ : stranger_answers_;
  if (to.authentic || share.try_take(now_ns)) answers_.answer(to, reason, text);
}

// Puts the table into a slot that the loop does not use, or names the slot to return to.
bool Supervisor::prepare_table(Verdict& verdict) {
  TableBook& book = books_[verdict.requester.joint];
  const auto slot = verdict.revert_table ? book.previous_slot() : book.free_slot();
  if (book.busy() || !slot) {
    verdict.reason = book.busy() ? Reason::kBusy : Reason::kNoPreviousTable;
    verdict.text = book.busy() ? "another table is just being taken over" : "there is no table to go back to";
    return false;
  }
  JointLoop& joint = loop_.joint(verdict.requester.joint);
  if (verdict.table) joint.table_slot(*slot) = {*verdict.table, table_digest(*verdict.table)};
  verdict.order.table_slot = static_cast<std::int32_t>(*slot);
  book.begin(*slot);
  return true;
}

void Supervisor::take_replies(std::int64_t now_ns) {
  Reply reply;
  while (loop_.replies().pop(reply)) {
    const auto found = pending_.find(reply.id);
    if (found == pending_.end()) continue;
    const Pending& pending = found->second;
    const bool accepted = reply.reason == Reason::kAccepted;
    if (pending.is_table) books_[pending.requester.joint].end(accepted);
    if (!accepted) admission_.count_reject(reply.reason);
    answer(pending.requester, reply.reason, accepted ? pending.text : advice(reply), now_ns);
    pending_.erase(found);
  }
  for (auto it = pending_.begin(); it != pending_.end();) {
    if (it->second.deadline_ns >= now_ns) {
      ++it;
      continue;
    }
    answer(it->second.requester, Reason::kTimedOut, "the loop did not answer in 0.5 s: look at the state",
           now_ns);
    if (it->second.is_table) {
      // The loop may still take it: its slot stays reserved until it says so, silently.
      it->second.deadline_ns = INT64_MAX;
      it->second.requester.wants_acknowledgement = false;
      ++it;
    } else {
      it = pending_.erase(it);
    }
  }
}

void Supervisor::take_events() {
  LoopEvent event;
  while (loop_.events().pop(event)) {
    const std::string& joint = config_.joints[static_cast<std::size_t>(event.joint)].name;
    if (event.to == Mode::kFaulted) {
      const std::string_view key = configuration_key(event.fault);
      spdlog::error("{}: fault {}: {}{}{}{} (was {}, cycle {})", joint, static_cast<int>(event.fault),
                    to_text(event.fault),
                    drive_words(config_.joints[static_cast<std::size_t>(event.joint)], event),
                    key.empty() ? "" : ", see ", key, to_text(event.from), event.cycle);
    } else
      spdlog::info("{}: {} -> {}", joint, to_text(event.from), to_text(event.to));
  }
}

void Supervisor::log_buses() {
  for (const auto& bus : loop_.buses())
    for (const std::string& line : bus->take_messages()) spdlog::info("{}", line);
}

void Supervisor::take_states(std::int64_t now_ns) {
  StateRecord record{};
  std::uint64_t dropped = 0;
  while (outbound_.states.read(state_cursor_, record, dropped))
    latest_[static_cast<std::size_t>(record.joint_index)] = record;
  if (state_cursor_ == 0 || now_ns < temperature_due_ns_) return;
  temperature_due_ns_ = now_ns + kTemperatureEvery_ns;
  for (const StateRecord& latest : latest_) answers_.temperature(latest);
}

void Supervisor::watch_gateway(std::int64_t now_ns) {
  if (const auto end = gateway_.take_end(now_ns))
    spdlog::error("the gateway ended with {}: starting it again", *end);
  if (!stopping_ && gateway_.start_due(now_ns)) {
    try {
      gateway_.start(now_ns);
    } catch (const std::system_error& error) {
      spdlog::error("{}", error.what());
    }
  }
  end_hung_gateway(now_ns);
  log_dropped_datagrams(now_ns);
  const std::uint64_t foreign = inbound_.foreign_states.load(std::memory_order_relaxed);
  if (foreign != foreign_states_seen_ && foreign_states_seen_ == 0)
    spdlog::error("another daemon on this LCM bus publishes on prefix {}: give each its own daemon.prefix",
                  config_.prefix);
  foreign_states_seen_ = foreign;
}

void Supervisor::end_hung_gateway(std::int64_t now_ns) {
  const std::uint64_t turns = inbound_.turns.load(std::memory_order_relaxed);
  if (turns != gateway_turns_ || !gateway_.running()) {
    gateway_turns_ = turns;
    gateway_moved_ns_ = now_ns;
  }
  const bool starting = now_ns - gateway_.started_ns() < kGatewayStart_ns;
  if (starting || now_ns - gateway_moved_ns_ < kGatewaySilence_ns) return;
  gateway_moved_ns_ = now_ns;
  spdlog::error("the gateway has done nothing for 2 s: ending it");
  gateway_.kill();
}

void Supervisor::log_dropped_datagrams(std::int64_t now_ns) {
  const auto count = [](const std::atomic<std::uint64_t>& value) {
    return value.load(std::memory_order_relaxed);
  };
  const std::uint64_t malformed = count(inbound_.malformed);
  const std::uint64_t too_long = count(inbound_.too_long);
  const std::uint64_t interrupted = count(inbound_.interrupted);
  const std::uint64_t crowded_out = count(inbound_.crowded_out);
  const std::uint64_t dropped = malformed + too_long + interrupted + crowded_out;
  std::int64_t suppressed = 0;
  if (dropped == dropped_seen_ || !dropped_log_.allow(now_ns, suppressed)) return;
  dropped_seen_ = dropped;
  spdlog::warn(
      "dropped by the gateway since its start: {} malformed datagrams, {} too long, {} messages with missing "
      "fragments, {} messages too many at once",
      malformed, too_long, interrupted, crowded_out);
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
  if (suppressed > 0) spdlog::warn("{} more refused messages were not logged", suppressed);
  if (verdict.kind == Verdict::Kind::kDiscard)
    spdlog::warn("message on {} discarded: {}", incoming_->channel.view(), to_text(verdict.reason));
  else
    spdlog::warn("{}: refused: {}: {}", config_.joints[verdict.requester.joint].name, to_text(verdict.reason),
                 verdict.text);
}

}  // namespace strainwave
