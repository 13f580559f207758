// SPDX-License-Identifier: BSD-3-Clause
// Injected faults pass the same admission as other orders. Only simulated drives accept them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <strainwave/inject_v1.hpp>

#include "daemon/admission/admission.h"
#include "lcmtypes/signing.h"
#include "lcmtypes/wire.h"

namespace strainwave {
namespace {

constexpr std::int64_t kSession = 4711;
constexpr std::int64_t kChallenge = 815;

JointAdmission joint(const char* name, bool simulated) {
  JointAdmission admission;
  admission.name = name;
  admission.takes_injected_faults = simulated;
  return admission;
}

class InjectionAdmission : public ::testing::Test {
 protected:
  InjectionAdmission() { admission_.advance(0, kChallenge); }
  static inject_v1 message(InjectedFault kind, double for_s, double amount, std::int64_t sequence) {
    inject_v1 inject{};
    inject.session_id = kSession;
    inject.challenge = kChallenge;
    inject.sender_id = 1;
    inject.sequence = sequence;
    inject.kind = static_cast<std::int32_t>(kind);
    inject.for_s = for_s;
    inject.amount = amount;
    return inject;
  }
  static WireMessage wire(const std::string& channel, const inject_v1& inject,
                          const SecretKey* key = nullptr) {
    auto bytes = encode(inject);
    if (key != nullptr) sign(channel, *key, bytes);
    WireMessage result;
    result.channel = FixedString<64>(channel);
    result.size = bytes.size();
    std::copy(bytes.begin(), bytes.end(), result.bytes.begin());
    return result;
  }
  Verdict consider(const inject_v1& inject) {
    return admission_.consider(wire("SW.elbow.INJECT", inject), 0);
  }

  Admission admission_{"SW", kSession, {joint("elbow", true), joint("real", false)}, {{}, true}};
};

TEST_F(InjectionAdmission, PassesASoundOneToASimulatedJoint) {
  const Verdict verdict = consider(message(InjectedFault::kSensorDelayed, 2.0, 0.01, 1));
  ASSERT_EQ(verdict.kind, Verdict::Kind::kOrder);
  EXPECT_EQ(verdict.order.kind, OrderKind::kInject);
  EXPECT_EQ(verdict.order.injection.kind, InjectedFault::kSensorDelayed);
  EXPECT_EQ(verdict.order.injection.for_s, 2.0);
  EXPECT_EQ(verdict.order.injection.amount, 0.01);
}

TEST_F(InjectionAdmission, RefusesAndCountsItForAnyOtherDrive) {
  const Verdict verdict =
      admission_.consider(wire("SW.real.INJECT", message(InjectedFault::kPowerLost, 1.0, 0.0, 1)), 0);
  EXPECT_EQ(verdict.kind, Verdict::Kind::kRefuse);
  EXPECT_EQ(verdict.reason, Reason::kNotSimulated);
  EXPECT_EQ(admission_.rejects()[static_cast<std::size_t>(Reason::kNotSimulated)], 1);
}

TEST_F(InjectionAdmission, RefusesWhatMakesNoSense) {
  const double nan = std::nan("");
  std::int64_t sequence = 0;
  EXPECT_EQ(consider(message(static_cast<InjectedFault>(13), 1.0, 0.0, ++sequence)).reason,
            Reason::kUnknownAction);
  EXPECT_EQ(consider(message(static_cast<InjectedFault>(-1), 1.0, 0.0, ++sequence)).reason,
            Reason::kUnknownAction);
  EXPECT_EQ(consider(message(InjectedFault::kSensorJump, nan, 0.0, ++sequence)).reason, Reason::kNotFinite);
  EXPECT_EQ(consider(message(InjectedFault::kSensorJump, 1.0, nan, ++sequence)).reason, Reason::kNotFinite);
  EXPECT_EQ(consider(message(InjectedFault::kSensorJump, -1.0, 0.0, ++sequence)).reason, Reason::kOutOfRange);
  EXPECT_EQ(consider(message(InjectedFault::kSensorJump, 1.0, 1000.0, ++sequence)).reason,
            Reason::kOutOfRange);
  EXPECT_EQ(consider(message(InjectedFault::kSensorDelayed, 1.0, 60.0, ++sequence)).reason,
            Reason::kOutOfRange);
  EXPECT_EQ(consider(message(InjectedFault::kOverrun, 1.0, 10.0, ++sequence)).reason, Reason::kOutOfRange)
      << "nobody may stop the loop for ten seconds";
}

TEST_F(InjectionAdmission, RefusesAnotherSession) {
  inject_v1 inject = message(InjectedFault::kPowerLost, 1.0, 0.0, 1);
  inject.session_id = kSession + 1;
  EXPECT_EQ(consider(inject).reason, Reason::kWrongSession);
}

TEST_F(InjectionAdmission, NeedsAnEngineersSignatureWhereOrdersAreSigned) {
  const SecretKey operators = SecretKey::generate();
  const SecretKey engineers = SecretKey::generate();
  AuthorizedKeys keys(
      {{operators.public_key(), Role::kOperator, "Otto"}, {engineers.public_key(), Role::kEngineer, "Emma"}});
  Admission strict("SW", kSession, {joint("elbow", true)}, {keys, false});
  strict.advance(0, kChallenge);
  const auto verdict = [&](const SecretKey* key, std::int64_t sequence) {
    return strict.consider(
        wire("SW.elbow.INJECT", message(InjectedFault::kPowerLost, 1.0, 0.0, sequence), key), 0);
  };
  EXPECT_EQ(verdict(nullptr, 1).reason, Reason::kUnsigned);
  EXPECT_EQ(verdict(&operators, 2).reason, Reason::kRoleNotAllowed);
  EXPECT_EQ(verdict(&engineers, 3).kind, Verdict::Kind::kOrder);
}

}  // namespace
}  // namespace strainwave
