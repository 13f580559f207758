// SPDX-License-Identifier: BSD-3-Clause
// The real daemon, which a test starts with its own configuration in its own network.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "control/table/gain_table.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_client.h"

namespace strainwave::testing {

/// Whether this is the virtual machine of tests/vm with its virtual time. There, tests can assert the loop's
/// behaviour to the cycle. On other machines, other programs run as well.
bool in_virtual_time();

/// Folder of the programs under test.
std::filesystem::path programs_folder();

/// Options of the start of strainwaved.
struct DaemonStart {
  std::filesystem::path preload;  ///< library that is loaded into it first
  int log_file = -1;              ///< descriptor of its log, instead of a file
};

/// strainwaved as a child process.
class DaemonProcess {
 public:
  /// `configuration` is the text of the TOML file; it is written into `folder`.
  DaemonProcess(const std::filesystem::path& folder, const std::string& configuration,
                const DaemonStart& start = {});
  /// Kills the process with SIGKILL if it still runs.
  ~DaemonProcess();
  DaemonProcess(const DaemonProcess&) = delete;
  DaemonProcess& operator=(const DaemonProcess&) = delete;

  void signal(int signal_number) const;
  /// Waits for its end. Returns the exit status, 128 + n after signal n, or -1 if it still runs after `timeout`.
  int wait_for_end(std::chrono::milliseconds timeout);
  bool running();
  pid_t pid() const { return pid_; }
  /// Process id of its gateway, or -1.
  pid_t gateway_pid() const;
  /// The log so far.
  std::string log() const;
  bool wait_for_log(const std::string& text, std::chrono::milliseconds timeout) const;

 private:
  std::filesystem::path log_path_;
  pid_t pid_ = -1;
  int status_ = -1;
};

/// A test with a temporary folder and its own network for daemons and clients.
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
