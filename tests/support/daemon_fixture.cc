#include "tests/support/daemon_fixture.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>
#include <utility>

#include "base/utime.h"
#include "control/gain_table_json.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/gain_table_message.h"
#include "tests/support/private_network.h"

namespace strainwave::testing {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPollStep = std::chrono::milliseconds(10);
constexpr std::chrono::microseconds kRecent{200'000};
constexpr std::chrono::microseconds kNextChallenge{30'000};
constexpr std::chrono::microseconds kFirstState{10'000'000};

// One network for all tests of a program, entered before any thread exists.
class PrivateNetwork : public ::testing::Environment {
 public:
  void SetUp() override {
    if (!enter_private_network())
      std::puts("note: no network namespace allowed, using the machine's own network");
  }
};
[[maybe_unused]] ::testing::Environment* const kNetwork =
    ::testing::AddGlobalTestEnvironment(new PrivateNetwork);

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

bool in_virtual_time() {
  return std::getenv("STRAINWAVE_VIRTUAL_TIME") != nullptr;  // NOLINT(concurrency-mt-unsafe): nobody sets it
}

std::filesystem::path programs_folder() {
  // In the virtual machine everything that a test needs lies beside it.
  return in_virtual_time() ? std::filesystem::current_path()
                           : std::filesystem::path(STRAINWAVE_BINARY_DIR) / "bin";
}

DaemonProcess::DaemonProcess(const std::filesystem::path& folder, const std::string& configuration,
                             const DaemonStart& start)
    : log_path_(folder / "daemon.log") {
  const std::filesystem::path config_path = folder / "strainwaved.toml";
  std::ofstream(config_path) << configuration;
  const std::string program = programs_folder() / "strainwaved";
  // Locks of this program's own: tests of different programs share a machine, but no daemon.
  static const TemporaryFolder kLocks;
  const int log = ::open(log_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  pid_ = ::fork();
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that crashes leaves no daemon behind
    if (!start.preload.empty())
      ::setenv("LD_PRELOAD", start.preload.c_str(), 1);       // NOLINT(concurrency-mt-unsafe)
    ::setenv("RUNTIME_DIRECTORY", kLocks.path().c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    ::dup2(log, STDOUT_FILENO);
    ::dup2(start.log_file >= 0 ? start.log_file : log, STDERR_FILENO);
    ::execl(program.c_str(), program.c_str(), "--config", config_path.c_str(), nullptr);
    ::_exit(127);
  }
  ::close(log);
}

DaemonProcess::~DaemonProcess() {
  if (!running()) return;
  signal(SIGCONT);
  signal(SIGKILL);
  wait_for_end(std::chrono::seconds(5));
}

void DaemonProcess::signal(int signal_number) const {
  ::kill(pid_, signal_number);
}

bool DaemonProcess::running() {
  return wait_for_end(std::chrono::milliseconds(0)) == -1;
}

int DaemonProcess::wait_for_end(std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (status_ == -1) {
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) == pid_) {
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    } else if (Clock::now() >= deadline) {
      return -1;
    } else {
      std::this_thread::sleep_for(kPollStep);
    }
  }
  return status_;
}

pid_t DaemonProcess::gateway_pid() const {
  const std::string task = std::to_string(pid_);
  std::istringstream children(read_file("/proc/" + task + "/task/" + task + "/children"));
  pid_t child = -1;
  return children >> child ? child : -1;
}

std::string DaemonProcess::log() const {
  return read_file(log_path_);
}

bool DaemonProcess::wait_for_log(const std::string& text, std::chrono::milliseconds timeout) const {
  const auto deadline = Clock::now() + timeout;
  while (log().find(text) == std::string::npos) {
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(kPollStep);
  }
  return true;
}

TestClient::TestClient(std::string prefix, const std::string& lcm_url)
    : prefix_(std::move(prefix)),
      lcm_(lcm_url),
      sender_id_(static_cast<std::int64_t>(std::random_device{}()) + 1) {
  lcm_.subscribe(prefix_ + "\\.[^.]+\\.STATE", &TestClient::on_state, this)->setQueueCapacity(1000);
  lcm_.subscribe(prefix_ + "\\.[^.]+\\.ACK", &TestClient::on_ack, this);
  lcm_.subscribe(prefix_ + "\\.TIMING", &TestClient::on_timing, this);
}

void TestClient::pump(std::chrono::milliseconds duration) {
  const auto deadline = Clock::now() + duration;
  do {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd descriptor{lcm_.getFileno(), POLLIN, 0};
    if (::poll(&descriptor, 1, std::max(0, static_cast<int>(left.count()))) > 0) lcm_.handle();
  } while (Clock::now() < deadline);
}

bool TestClient::wait_for_state(const std::string& joint,
                                const std::function<bool(const state_v1&)>& condition,
                                std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (!(states_[joint] && condition(*states_[joint]))) {
    if (Clock::now() >= deadline) return false;
    pump(std::chrono::milliseconds(5));
  }
  return true;
}

bool TestClient::wait_for_mode(const std::string& joint, Mode mode, std::chrono::milliseconds timeout) {
  return wait_for_state(
      joint, [mode](const state_v1& state) { return state.mode == static_cast<std::int32_t>(mode); },
      timeout);
}

bool TestClient::wait_for_timing(std::chrono::milliseconds timeout) {
  timing_.reset();
  const auto deadline = Clock::now() + timeout;
  while (!timing_ && Clock::now() < deadline) pump(std::chrono::milliseconds(5));
  return timing_.has_value();
}

template <typename Message>
void TestClient::fill_envelope(const std::string& joint, Message& message) {
  // What is quoted must be recent: what waits is taken first, and a state that came before a pause of the test is none.
  for (pollfd waiting{lcm_.getFileno(), POLLIN, 0}; ::poll(&waiting, 1, 0) > 0;) lcm_.handle();
  // Nor is one from before a stop of ours, which the daemon may have drawn before and published after it.
  const auto recent = [&] {
    return states_[joint] && utime_now() - heard_us_[joint] < kRecent.count() &&
           states_[joint]->challenge != stopped_challenge_[joint] &&
           utime_now() - stopped_us_[joint] >= kNextChallenge.count();
  };
  const auto deadline = Clock::now() + (states_[joint] ? kRecent : kFirstState);
  while (!recent() && Clock::now() < deadline) pump(std::chrono::milliseconds(5));
  message.session_id = states_[joint] ? states_[joint]->session_id : 0;
  message.challenge = states_[joint] ? states_[joint]->challenge : 0;
  message.sender_id = sender_id_;
  message.sequence = ++sequence_;
}

command_v1 TestClient::make_command(const std::string& joint, Action action) {
  command_v1 message{};
  fill_envelope(joint, message);
  message.action = static_cast<std::int32_t>(action);
  if (action == Action::kDisable || action == Action::kHold) note_stop(joint);
  return message;
}

setpoint_v2 TestClient::make_setpoint(const std::string& joint, double position_rad, double valid_for_s) {
  setpoint_v2 message{};
  fill_envelope(joint, message);
  message.position_rad = position_rad;
  message.valid_for_s = valid_for_s;
  message.acknowledge = 1;
  if (valid_for_s > 0.0) {
    message.stream_id = stream_id_;
    message.begins_stream = std::exchange(stream_begins_, false) ? 1 : 0;
  }
  return message;
}

gain_table_v1 TestClient::make_table(const std::string& joint, const GainTable& table) {
  gain_table_v1 message = to_message(table);
  fill_envelope(joint, message);
  return message;
}

inject_v1 TestClient::make_injection(const std::string& joint, std::int32_t kind, double for_s,
                                     double amount) {
  inject_v1 message{};
  fill_envelope(joint, message);
  message.kind = kind;
  message.for_s = for_s;
  message.amount = amount;
  return message;
}

Answer TestClient::command(const std::string& joint, Action action) {
  const Answer answer = send_and_wait(joint, "COMMAND", make_command(joint, action));
  if (action == Action::kDisable || action == Action::kHold) note_stop(joint);
  return answer;
}

void TestClient::note_stop(const std::string& joint) {
  stopped_challenge_[joint] = states_[joint] ? states_[joint]->challenge : 0;
  stopped_us_[joint] = utime_now();
}

Answer TestClient::move(const std::string& joint, double position_rad, double valid_for_s) {
  return send_and_wait(joint, "SETPOINT", make_setpoint(joint, position_rad, valid_for_s));
}

Answer TestClient::load(const std::string& joint, const GainTable& table) {
  return send_and_wait(joint, "TABLE", make_table(joint, table));
}

Answer TestClient::wait_for_answer(std::int64_t sequence, std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (!acks_.contains(sequence)) {
    if (Clock::now() >= deadline) return {};
    pump(std::chrono::milliseconds(5));
  }
  const ack_v1& ack = acks_[sequence];
  return {ack.accepted == 1, static_cast<Reason>(ack.reason), reinterpret_cast<const char*>(ack.text)};
}

void TestClient::on_state(const lcm::ReceiveBuffer* buffer, const std::string& channel,
                          const state_v1* message) {
  const auto name = parse_channel(channel);
  if (!name) return;
  states_[name->joint] = *message;
  heard_us_[name->joint] = buffer->recv_utime;
  history_[name->joint].push_back(*message);
}

void TestClient::on_ack(const lcm::ReceiveBuffer*, const std::string&, const ack_v1* message) {
  if (message->sender_id == sender_id_) acks_[message->sequence] = *message;
}

void TestClient::on_timing(const lcm::ReceiveBuffer*, const std::string&, const timing_v1* message) {
  timing_ = *message;
}

namespace {

// A host that is not real-time leaves the loop standing now and then: the simulated drives have a watchdog, as real ones do.
std::string attended(std::string joints) {
  const std::string section = "[joint.simulated]\n";
  const std::string watchdog = "watchdog_s = 0.005\n";
  if (joints.find(section) == std::string::npos) return joints + "\n" + section + watchdog;
  return joints.insert(joints.find(section) + section.size(), watchdog);
}

}  // namespace

std::string DaemonTest::configuration(const std::string& joint_extra, const std::string& daemon_extra) {
  const std::string real_time =
      in_virtual_time()
          ? "real_time = \"enforce\"\n"
          : "real_time = \"ignore\"\noverrun_limit = 100000\nstall_limit_s = 100\nmissed_share_limit = 1\n";
  return "[daemon]\n" + real_time + daemon_extra +
         R"(
[security]
unsigned_orders = "allow"

[[joint]]
name = "elbow"
joint_model = "rhs17-6006"
inertia_kgm2 = 0.089
gear_ratio = 50
driver = "simulated"
limits = { position_min_rad = -3.2, position_max_rad = 3.2, speed_limit_rad_s = 6, acceleration_rad_s2 = 150, following_error_rad = 0.1, torque_limit_Nm = 34)" +
         // A joint that lives by the time runs on while the loop of a host that is not real-time stands.
         (in_virtual_time() ? "" : ", overspeed_rad_s = 100") + R"( }
control = { rigid = true }
)" + attended(joint_extra);
}

GainTable DaemonTest::shipped_table() {
  const std::filesystem::path folder = in_virtual_time()
                                           ? programs_folder()
                                           : std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables";
  return read_gain_table(folder / "rhs17-6006.json");
}

}  // namespace strainwave::testing
