// SPDX-License-Identifier: BSD-3-Clause
// A daemon that publishes arbitrary states, limits, timing and answers. Their numbers are NaN, infinite, huge, negative or unknown, their text has
// control characters, and some have a wrong length. Our programs and libraries must report their own error or continue. They must not crash, hang or
// print control sequences to a terminal.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <chrono>
#include <csignal>
#include <cstring>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <random>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/limits_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <thread>

#include "base/text_file.h"
#include "lcmtypes/wire.h"
#include "strainwave/client_error.h"
#include "strainwave/joint.h"
#include "tests/support/daemon_fixture.h"

namespace strainwave::testing {
namespace {

using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

class HostileDaemon {
 public:
  HostileDaemon() : lcm_(kTestUrl), thread_([this](const std::stop_token& end) { run(end); }) {}

 private:
  void run(const std::stop_token& end) {
    lcm_.subscribe("SW\\.elbow\\.(COMMAND|SETPOINT)", &HostileDaemon::on_order, this);
    while (!end.stop_requested()) {
      ++cycle_;
      say("STATE", state());
      if (cycle_ % 5 == 0) say("LIMITS", limits());
      if (cycle_ % 5 == 1) say("TIMING", timing_v1{});
      if (cycle_ % 5 == 2) say("TEMPERATURE", temperature_v1{});
      lcm_.handleTimeout(2);
    }
  }
  std::uint64_t hostile() { return kHostile[chance_() % kHostile.size()]; }
  state_v1 state() {
    state_v1 state{};
    state.session_id = 7;
    state.challenge = cycle_;
    state.cycle = chance_() % 20 == 0 ? static_cast<std::int64_t>(hostile()) : 2 * cycle_;
    state.mode =
        static_cast<std::int32_t>(cycle_ / 100 % 8);  // each mode for a while, so that programs make progress
    return state;
  }
  /// The period is often hostile, because programs divide by it.
  limits_v1 limits() {
    limits_v1 limits{};
    limits.period_s = chance_() % 4 == 0 ? std::bit_cast<double>(hostile()) : 1e-3;
    limits.position_min_rad = -1.0;
    limits.position_max_rad = 1.0;
    limits.torque_limit_Nm = 34.0;
    return limits;
  }
  void on_order(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    const std::span<const std::uint8_t> bytes(static_cast<const std::uint8_t*>(buffer->data),
                                              buffer->data_size);
    if (const auto command = decode_exactly<command_v1>(bytes)) answer(command->sender_id, command->sequence);
    if (const auto move = decode_exactly<setpoint_v1>(bytes)) answer(move->sender_id, move->sequence);
    (void)channel;
  }
  void answer(std::int64_t sender_id, std::int64_t sequence) {
    ack_v1 ack{};
    ack.accepted = chance_() % 2 == 0 ? 1 : 0;
    ack.sender_id = sender_id;
    ack.sequence = sequence;
    ack.reason = static_cast<std::int32_t>(chance_() % 64);
    std::memset(ack.text, 0x1b, sizeof ack.text);
    const std::vector<std::uint8_t> bytes = encode(ack);
    lcm_.publish("SW.elbow.ACK", bytes.data(), static_cast<unsigned int>(bytes.size()));
    say("ACK", ack);
  }
  /// One of ten messages has one hostile number, one of twenty only hostile numbers, and one of fifty a wrong length.
  template <typename Message>
  void say(const std::string& kind, const Message& message) {
    constexpr std::size_t kFingerprint = 8;
    std::vector<std::uint8_t> bytes = encode(message);
    const auto put = [&](std::size_t at) {
      const std::uint64_t word = hostile();
      for (std::size_t i = 0; i < 8 && at + i < bytes.size(); ++i)
        bytes[at + i] = static_cast<std::uint8_t>(word >> (56 - 8 * i));
    };
    const std::uint64_t share = chance_() % 20;
    if (share < 2) put(kFingerprint + 8 * (chance_() % ((bytes.size() - kFingerprint) / 8)));
    for (std::size_t at = kFingerprint; share == 2 && at < bytes.size(); at += 4) put(at);
    if (chance_() % 50 == 0) bytes.resize(chance_() % 2 == 0 ? bytes.size() / 2 : bytes.size() + 9);
    lcm_.publish("SW.elbow." + kind, bytes.data(), static_cast<unsigned int>(bytes.size()));
  }

  static constexpr std::array<std::uint64_t, 10> kHostile{0x7ff8000000000000,   // NaN
                                                          0x7ff0000000000000,   // infinite
                                                          0xfff0000000000000,   // minus infinity
                                                          0x7fe1ccf385ebc8a0,   // 1e308
                                                          0xffe1ccf385ebc8a0,   // -1e308
                                                          0x7fffffffffffffff,   // largest integer
                                                          0x8000000000000000,   // smallest integer
                                                          0xffffffffffffffff,   // -1
                                                          0x1b5b324a1b5b324a,   // clears a terminal
                                                          0x0000000000000001};  // smallest positive

  lcm::LCM lcm_;
  std::mt19937_64 chance_{38};
  std::int64_t cycle_ = 0;
  std::jthread thread_;
};

struct Ended {
  int status;  ///< -1: it did not end
  std::string words;
};

class Hostile : public DaemonTest {
 protected:
  /// Runs the program. Kills it when it has not ended after `patience`.
  Ended run(std::vector<std::string> words, seconds patience) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string output = folder_ / "output";
    const pid_t pid = ::fork();
    if (pid == 0) {
      if (std::freopen(output.c_str(), "w", stdout) == nullptr) ::_exit(127);
      ::dup2(STDOUT_FILENO, STDERR_FILENO);
      ::execvp(arguments[0], arguments.data());
      ::_exit(127);
    }
    int status = 0;
    const auto end = Clock::now() + patience;
    while (::waitpid(pid, &status, WNOHANG) == 0) {
      if (Clock::now() > end) {
        ::kill(pid, SIGKILL);
        ::waitpid(pid, &status, 0);
        return {-1, read_text_file(output)};
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text_file(output)};
  }

  HostileDaemon daemon_;
};

TEST_F(Hostile, DaemonEndsNoCommandOtherwiseThanInOrder) {
  const std::string log = folder_ / "log";
  const std::vector<std::vector<std::string>> commands{
      {"status"},
      {"status", "elbow"},
      {"--json", "status"},
      {"timing"},
      {"--json", "timing"},
      {"friction", "elbow"},
      {"enable", "elbow"},
      {"move", "elbow", "0.1"},
      {"home", "elbow"},
      {"clear-fault", "elbow"},
      {"hold", "elbow"},
      {"disable"},
      {"record", "--out", log, "--overwrite", "--duration_s", "0.3"},
      {"export", log}};
  for (int turn = 0; turn < 3; ++turn)
    for (std::vector<std::string> words : commands) {
      const std::string what = words.back();
      words.insert(words.begin(),
                   {programs_folder() / "strainwavectl", "--lcm-url", kTestUrl, "--timeout_s", "0.5"});
      const Ended ended = run(words, seconds(30));
      EXPECT_TRUE(ended.status >= 0 && ended.status <= 3) << what << ": " << ended.status << ended.words;
      EXPECT_EQ(ended.words.find('\x1b'), std::string::npos) << what << ": " << ended.words;
    }
}

TEST_F(Hostile, DaemonMakesTheLibraryThrowNothingButItsErrors) {
  Joint joint{"elbow", {.key = "", .lcm_url = kTestUrl, .timeout_s = 0.3}};
  const std::vector<std::function<void()>> calls{[&] { (void)joint.state().tracking_error_rad(); },
                                                 [&] { (void)joint.state().weights().size(); },
                                                 [&] { (void)joint.limits(); },
                                                 [&] { joint.states(0.2, [](const State&) {}); },
                                                 [&] { joint.enable(); },
                                                 [&] { (void)joint.move(0.1); },
                                                 [&] { joint.home(); },
                                                 [&] { joint.clear_fault(); },
                                                 [&] { joint.hold(); },
                                                 [&] { joint.disable(); },
                                                 [&] {
                                                   Stream stream = joint.stream();
                                                   for (int i = 0; i < 30; ++i)
                                                     stream.put(0.01 * i, 0.001 * i);
                                                   stream.close();
                                                 }};
  for (const auto end = Clock::now() + seconds(10); Clock::now() < end;)
    for (const auto& call : calls) try {
        call();
      } catch (const ClientError&) {
        // an expected error
      }
}

TEST_F(Hostile, DaemonMakesThePythonPackageRaiseNothingButItsErrors) {
  const char* const program = R"(
import os, sys, threading, time, traceback
from strainwave import Joint, StrainwaveError

def fail(args):
    traceback.print_exception(args.exc_value)
    os._exit(70)

threading.excepthook = fail  # the thread that listens must not end
joint = Joint('elbow', key='', lcm_url=sys.argv[1], timeout_s=0.3)

def stream():
    with joint.stream() as samples:
        for i in range(3):
            samples.put(0.01 * i, 0.001 * i)

calls = (lambda: repr(joint.state), lambda: joint.state.fault_words(), lambda: joint.state.tracking_error_rad(), lambda: repr(joint.limits),
         lambda: list(joint.states(0.2)), joint.enable, lambda: joint.move(0.1), joint.home, joint.clear_fault, joint.hold, joint.disable, *[stream] * 30)
end_s = time.monotonic() + 15
while time.monotonic() < end_s:
    for call in calls:
        try:
            call()
        except StrainwaveError as error:
            print(error, flush=True)
)";
  ::setenv("PYTHONPATH", (programs_folder().parent_path() / "python").c_str(),
           1);  // NOLINT(concurrency-mt-unsafe): its thread reads none
  const Ended ended = run({"python3", "-c", program, kTestUrl}, seconds(90));
  EXPECT_EQ(ended.status, 0) << ended.words;
  EXPECT_EQ(ended.words.find('\x1b'), std::string::npos) << ended.words;
}

}  // namespace
}  // namespace strainwave::testing
