// SPDX-License-Identifier: BSD-3-Clause
// friction: shows the learned friction of a joint, and gives orders about learning.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "client/commands/commands.h"
#include "client/protocol/orders.h"
#include "client/protocol/plain_zero.h"
#include "client/text/text.h"

namespace strainwave {

namespace {

std::string learned_when(const state_v1& state) {
  if (state.friction_age_s < 0.0) return "nothing learned yet";
  return fmt::format("last learned at {} degC, {:.0f} s ago", temperature_text(state.friction_learned_C),
                     state.friction_age_s);
}

}  // namespace

void show_friction(Client& client, const Output& output, const std::string& joint) {
  client.wait_for_joint(joint);
  const state_v1& state = client.find(joint)->state;
  const int rules = std::clamp(state.rule_count, 0, 16);
  nlohmann::ordered_json json{{"joint", joint},
                              {"friction_factor", state.friction_factor},
                              {"friction_age_s", state.friction_age_s},
                              {"friction_learned_C", state.friction_learned_C},
                              {"friction_frozen", state.friction_frozen != 0},
                              {"learned_load_Nm", state.learned_load_Nm},
                              {"rules", nlohmann::ordered_json::array()}};
  std::string text = fmt::format("{}: friction {:.2f} times the table's at {} degC, {}{}\n", joint,
                                 state.friction_factor, temperature_text(state.temperature_used_C),
                                 learned_when(state), state.friction_frozen != 0 ? ", frozen" : "");
  text += fmt::format("learned load {:.3g} N.m\n{:>12} {:>6}", plain_zero(state.learned_load_Nm), "rule_C",
                      "factor");
  for (int i = 0; i < rules; ++i) {
    text += fmt::format("\n{:>12.1f} {:>6.2f}", state.friction_rule_C[i], 1.0 + state.friction_scales[i]);
    json["rules"].push_back(
        {{"friction_rule_C", state.friction_rule_C[i]}, {"friction_scale", state.friction_scales[i]}});
  }
  if (output.json)
    output.stream << json << '\n';
  else
    output.stream << text << '\n';
}

void order_learning(Client& client, const Output& output, const std::string& joint, Action action) {
  order_accepted(client, joint, action);
  const char* outcome = action == Action::kResetLearning
                            ? "the table's friction is in use; learned friction and load are forgotten"
                        : action == Action::kFreezeLearning
                            ? "learned friction is frozen, until resume or a restart of the daemon"
                            : "the joint learns its friction again";
  say(output, joint + ": " + outcome, {{"joint", joint}, {"accepted", true}});
}

}  // namespace strainwave
