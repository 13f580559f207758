#include "daemon/admission/table_admission.h"

#include <sodium.h>

#include <array>
#include <cmath>
#include <cstring>
#include <sstream>

#include "control/certificate.h"
#include "lcmtypes/gain_table_message.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

constexpr double kPeriodTolerance = 1e-9;

TableVerdict judge_gains(const char* which, const FeedbackGains& gains, const PlantIdentity& plant,
                         const FuzzyFriction& friction) {
  const CertificateReport report = certify(gains, plant, friction);
  std::ostringstream text;
  text << which << " gains " << gains.controller.view() << ": margin " << describe(report.worst);
  if (report.certified) return {Reason::kAccepted, text.str()};
  text << ": stability is not proved for this joint; design the table for it with strainwave-design gains";
  return {Reason::kTableNotCertified, text.str()};
}

}  // namespace

TableVerdict judge_table(const GainTable& table, const PlantIdentity& expected, double torque_limit_Nm) {
  if (const auto defect = find_defect(table)) return {Reason::kTableDefect, *defect};
  if (std::abs(table.plant.period_s - expected.period_s) > kPeriodTolerance * expected.period_s) {
    std::ostringstream text;
    text << "period_s = " << table.plant.period_s << " in the table, " << expected.period_s
         << " in this daemon: design the table with --period_s " << expected.period_s;
    return {Reason::kTablePeriod, text.str()};
  }
  if (const auto mismatch = find_identity_mismatch(table, expected))
    return {Reason::kTableIdentity, *mismatch};
  if (table.torque_limit_Nm > torque_limit_Nm * (1.0 + kPeriodTolerance)) {
    std::ostringstream text;
    text << "torque_limit_Nm = " << table.torque_limit_Nm
         << " in the table, joint.limits.torque_limit_Nm = " << torque_limit_Nm
         << ": the table may not ask for more";
    return {Reason::kTableDefect, text.str()};
  }
  TableVerdict primary = judge_gains("primary", table.primary, expected, table.friction);
  if (primary.reason != Reason::kAccepted) return primary;
  TableVerdict fallback = judge_gains("fallback", table.fallback, expected, table.friction);
  return fallback.reason != Reason::kAccepted ? fallback : primary;
}

std::int64_t table_digest(const GainTable& table) {
  const auto bytes = encode(to_message(table));
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  crypto_generichash(hash.data(), hash.size(), bytes.data(), bytes.size(), nullptr, 0);
  std::int64_t digest = 0;
  std::memcpy(&digest, hash.data(), sizeof digest);
  return digest == 0 ? 1 : digest;
}

}  // namespace strainwave
