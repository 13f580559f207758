// SPDX-License-Identifier: BSD-3-Clause
// A daemon that obeys only signed orders, and the keys that sign them.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "lcmtypes/key_text.h"
#include "lcmtypes/signing.h"
#include "lcmtypes/wire.h"
#include "tests/support/daemon_fixture.h"

namespace strainwave::testing {

class SignedDaemonTest : public DaemonTest {
 protected:
  void start(const std::string& daemon_extra) {
    std::ofstream(folder_ / "keys") << to_line(AuthorizedKey{key_.public_key(), Role::kEngineer, "test"})
                                    << '\n'
                                    << to_line(AuthorizedKey{operator_key_.public_key(), Role::kOperator,
                                                             "another"})
                                    << '\n';
    std::string text = configuration("", daemon_extra);
    const std::string open = "unsigned_orders = \"allow\"";
    text.replace(text.find(open), open.size(), "authorized_keys = \"keys\"");
    daemon_.emplace(folder_, text);
  }
  /// Publishes `message`, signed, and does not wait for the answer.
  template <typename Message>
  void publish(TestClient& client, const char* kind, const Message& message) {
    publish(client, kind, message, key_);
  }
  template <typename Message>
  void publish(TestClient& client, const char* kind, const Message& message, const SecretKey& key) {
    const std::string channel = std::string("SW.elbow.") + kind;
    std::vector<std::uint8_t> bytes = encode(message);
    sign(channel, key, bytes);
    client.lcm().publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size()));
  }
  template <typename Message>
  Answer send(TestClient& client, const char* kind, const Message& message) {
    publish(client, kind, message);
    return client.wait_for_answer(message.sequence);
  }
  template <typename Message>
  Answer send(TestClient& client, const char* kind, const Message& message, const SecretKey& key) {
    publish(client, kind, message, key);
    return client.wait_for_answer(message.sequence);
  }
  /// Loads the shipped table and brings the joint to hold.
  void bring_to_hold(TestClient& client) {
    ASSERT_TRUE(client.wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    ASSERT_TRUE(send(client, "TABLE", client.make_table("elbow", shipped_table())).accepted)
        << daemon_->log();
    enable(client);
  }
  void enable(TestClient& client) {
    const Answer answer = send(client, "COMMAND", client.make_command("elbow", Action::kEnable));
    ASSERT_TRUE(answer.accepted) << answer.text;
    ASSERT_TRUE(client.wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
  }
  void disable(TestClient& client) {
    ASSERT_TRUE(send(client, "COMMAND", client.make_command("elbow", Action::kDisable)).accepted);
    ASSERT_TRUE(client.wait_for_mode("elbow", Mode::kOff)) << daemon_->log();
  }

  SecretKey key_ = SecretKey::generate();           ///< key of an engineer
  SecretKey operator_key_ = SecretKey::generate();  ///< key of another client, an operator
  std::optional<DaemonProcess> daemon_;
};

}  // namespace strainwave::testing
