// SPDX-License-Identifier: BSD-3-Clause
// A client connected to a fake daemon over LCM's memory queue, and the output or error of a command.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "client/commands/commands.h"
#include "strainwave/client_error.h"
#include "tests/client/protocol/fake_daemon.h"

namespace strainwave::testing {

class CommandsTest : public ::testing::Test {
 protected:
  /// Returns the exit status of `command` and stores its error text in `message`.
  template <typename Command>
  ExitStatus status_of(const Command& command) {
    try {
      command();
      return ExitStatus::kDone;
    } catch (const ClientError& error) {
      message = error.what();
      details = error.details();
      return error.status();
    }
  }
  bool message_has(const std::string& part) const { return message.find(part) != std::string::npos; }
  bool output_has(const std::string& part) const { return stream.str().find(part) != std::string::npos; }
  ExitStatus move_and_wait(double position_rad) {
    return status_of([&] { move(client, output, {"elbow", position_rad, true, 0.0}); });
  }

  Connection connection{"memq://"};
  FakeDaemon daemon{connection, "SW", "elbow"};
  Client client{connection, {.prefix = "SW", .timeout_s = 0.3, .names_commands = true}};
  std::ostringstream stream;
  Output output{stream, false};
  std::string message;
  ClientError::Details details;
};

}  // namespace strainwave::testing
