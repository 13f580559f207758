// The real daemon, started by a test with a configuration of its own in a network of its own, and a client that speaks to
// it over LCM as any program would (it shares no code with strainwavectl).
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <optional>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/setpoint_v2.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string>
#include <vector>

#include "control/gain_table.h"
#include "lcmtypes/vocabulary.h"
#include "tests/support/temporary_folder.h"

namespace strainwave::testing {

/// Whether this is the virtual machine of tests/vm, whose time is virtual: what the loop does there can be asserted to the
/// cycle. Elsewhere the machine has other things to do.
bool in_virtual_time();

/// Folder of the programs under test.
std::filesystem::path programs_folder();

/// How strainwaved is started, where it is not as usual.
struct DaemonStart {
  std::filesystem::path preload;  ///< a library that is loaded into it first
  int log_file = -1;              ///< descriptor that it logs to, instead of a file of its own
};

/// strainwaved as a child process.
class DaemonProcess {
 public:
  /// `configuration` is the text of the TOML file; it is written into `folder`.
  DaemonProcess(const std::filesystem::path& folder, const std::string& configuration,
                const DaemonStart& start = {});
  /// Ends it by SIGKILL if it still runs.
  ~DaemonProcess();
  DaemonProcess(const DaemonProcess&) = delete;
  DaemonProcess& operator=(const DaemonProcess&) = delete;

  void signal(int signal_number) const;
  /// Waits for its end; the exit status, 128 + n after signal n, or -1 when it still runs after `timeout`.
  int wait_for_end(std::chrono::milliseconds timeout);
  bool running();
  pid_t pid() const { return pid_; }
  /// Process id of its gateway, or -1.
  pid_t gateway_pid() const;
  /// What it has logged so far.
  std::string log() const;
  bool wait_for_log(const std::string& text, std::chrono::milliseconds timeout) const;

 private:
  std::filesystem::path log_path_;
  pid_t pid_ = -1;
  int status_ = -1;
};

/// The answer to an order.
struct Answer {
  bool accepted = false;
  Reason reason = Reason::kTimedOut;
  std::string text;
};

inline constexpr const char* kTestUrl = "udpm://239.255.76.67:7667?ttl=0";

class TestClient {
 public:
  explicit TestClient(std::string prefix = "SW", const std::string& lcm_url = kTestUrl);

  /// Handles what has come within `duration`.
  void pump(std::chrono::milliseconds duration);
  /// Pumps until `condition` holds for the latest state of `joint`; false after `timeout`.
  bool wait_for_state(const std::string& joint, const std::function<bool(const state_v1&)>& condition,
                      std::chrono::milliseconds timeout = std::chrono::seconds(10));
  bool wait_for_mode(const std::string& joint, Mode mode,
                     std::chrono::milliseconds timeout = std::chrono::seconds(10));
  const std::optional<state_v1>& state(const std::string& joint) { return states_[joint]; }
  /// All states of `joint` since the last call of forget_states().
  const std::vector<state_v1>& history(const std::string& joint) { return history_[joint]; }
  void forget_states() { history_.clear(); }
  const std::optional<timing_v1>& timing() const { return timing_; }
  /// Pumps until a TIMING message newer than the last one arrives.
  bool wait_for_timing(std::chrono::milliseconds timeout = std::chrono::seconds(5));

  Answer command(const std::string& joint, Action action);
  Answer move(const std::string& joint, double position_rad, double valid_for_s = 0.0);
  /// The next setpoint of a stream begins a new one.
  void begin_stream() {
    ++stream_id_;
    stream_begins_ = true;
  }
  Answer load(const std::string& joint, const GainTable& table);

  /// The messages themselves, for tests that bend them before they are sent.
  command_v1 make_command(const std::string& joint, Action action);
  setpoint_v2 make_setpoint(const std::string& joint, double position_rad, double valid_for_s = 0.0);
  gain_table_v1 make_table(const std::string& joint, const GainTable& table);
  inject_v1 make_injection(const std::string& joint, std::int32_t kind, double for_s, double amount);
  template <typename Message>
  Answer send_and_wait(const std::string& joint, const char* kind, const Message& message) {
    lcm_.publish(prefix_ + "." + joint + "." + kind, &message);
    return wait_for_answer(message.sequence);
  }
  Answer wait_for_answer(std::int64_t sequence, std::chrono::milliseconds timeout = std::chrono::seconds(5));
  lcm::LCM& lcm() { return lcm_; }
  std::int64_t sender_id() const { return sender_id_; }

 private:
  void on_state(const lcm::ReceiveBuffer*, const std::string& channel, const state_v1* message);
  void on_ack(const lcm::ReceiveBuffer*, const std::string& channel, const ack_v1* message);
  void on_timing(const lcm::ReceiveBuffer*, const std::string& channel, const timing_v1* message);
  void note_stop(const std::string& joint);
  template <typename Message>
  void fill_envelope(const std::string& joint, Message& message);

  std::string prefix_;
  lcm::LCM lcm_;
  std::int64_t sender_id_;
  std::int64_t sequence_ = 0;
  std::int64_t stream_id_ = 1;
  bool stream_begins_ = true;
  std::map<std::string, std::optional<state_v1>> states_;
  std::map<std::string, std::int64_t> heard_us_;           ///< when the latest state arrived
  std::map<std::string, std::int64_t> stopped_challenge_;  ///< of the last stop
  std::map<std::string, std::int64_t> stopped_us_;         ///< likewise
  std::map<std::string, std::vector<state_v1>> history_;
  std::map<std::int64_t, ack_v1> acks_;
  std::optional<timing_v1> timing_;
};

/// A folder and, in a network of the test's own, room for daemons and clients.
class DaemonTest : public ::testing::Test {
 protected:
  /// A configuration with one simulated joint "elbow" on prefix SW; `joint_extra` goes into its [[joint]] (sub-tables
  /// included), `daemon_extra` into [daemon].
  static std::string configuration(const std::string& joint_extra = "", const std::string& daemon_extra = "");
  /// The table shipped for that joint.
  static GainTable shipped_table();

  TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
};

}  // namespace strainwave::testing
