// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/daemon_fixture.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "control/table/gain_table_json.h"
#include "tests/support/private_network.h"

namespace strainwave::testing {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPollStep = std::chrono::milliseconds(10);

// All tests of a program share one network, which is entered before any thread exists.
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
  // In the virtual machine, all files that a test needs are in the current folder.
  return in_virtual_time() ? std::filesystem::current_path()
                           : std::filesystem::path(STRAINWAVE_BINARY_DIR) / "bin";
}

DaemonProcess::DaemonProcess(const std::filesystem::path& folder, const std::string& configuration,
                             const DaemonStart& start)
    : log_path_(folder / "daemon.log") {
  const std::filesystem::path config_path = folder / "strainwaved.toml";
  std::ofstream(config_path) << configuration;
  const std::string program = programs_folder() / "strainwaved";
  // This program's own folder of locks: tests of different programs share a machine, but no daemon.
  static const TemporaryFolder kLocks;
  const int log = ::open(log_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  pid_ = ::fork();
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // if a test crashes, its daemon ends
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

namespace {

// Without real-time priority, the loop stalls now and then. The simulated drives have a watchdog, as real drives do.
std::string attended(std::string joints) {
  const std::string section = "[joint.simulated]\n";
  const std::string watchdog = "watchdog_s = 0.005\n";
  if (joints.find(section) == std::string::npos) return joints + "\n" + section + watchdog;
  return joints.insert(joints.find(section) + section.size(), watchdog);
}

}  // namespace

std::string DaemonTest::configuration(const std::string& joint_extra, const std::string& daemon_extra) {
  const std::string real_time = in_virtual_time()
                                    ? "real_time = \"enforce\"\n"
                                    : "real_time = \"ignore\"\nstall_limit_s = 100\nmissed_share_limit = 1\n";
  return "[daemon]\n" + real_time + daemon_extra +
         R"(
[security]
unsigned_orders = "allow"

[[joint]]
name = "elbow"
joint_model = "rhs17-6006"
model = "rigid"
inertia_kgm2 = 0.089
gear_ratio = 50
driver = "simulated"
limits = { position_min_rad = -3.2, position_max_rad = 3.2, speed_limit_rad_s = 6, acceleration_rad_s2 = 150, move_speed_share = 1, following_error_rad = 0.1, torque_limit_Nm = 34)" +
         // The simulated joint runs by the clock. It moves on while the loop of a host without real time stalls.
         (in_virtual_time() ? "" : ", overspeed_rad_s = 100") + R"( }
)" + attended(joint_extra);
}

GainTable DaemonTest::shipped_table() {
  const std::filesystem::path folder = in_virtual_time()
                                           ? programs_folder()
                                           : std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables";
  return read_gain_table(folder / "rhs17-6006.json");
}

}  // namespace strainwave::testing
