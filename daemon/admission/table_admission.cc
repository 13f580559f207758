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

constexpr double kTolerance = 1e-9;

TableVerdict judge_gains(const char* which, const FeedbackGains& gains, const PlantIdentity& plant,
                         const FuzzyFriction& friction) {
  const CertificateReport report = certify(gains, plant, friction);
  std::ostringstream text;
  text << which << " gains " << gains.controller.view() << ": margin " << describe(report.worst);
  if (report.certified) return {Reason::kAccepted, text.str()};
  text << ": stability is not proved for this joint; design the table for it with strainwave-design gains";
  return {Reason::kTableNotCertified, text.str()};
}

// The smaller of the two holds. Certified is what happens below it, so that a smaller one takes no proof away; it may take the torque
// that the cold joint's friction needs.
std::string which_torque_limit_holds(const GainTable& table, double torque_limit_Nm) {
  if (std::abs(table.torque_limit_Nm - torque_limit_Nm) <= kTolerance * torque_limit_Nm) return "";
  const bool lowered = torque_limit_Nm < table.torque_limit_Nm;
  const double holds_Nm = lowered ? torque_limit_Nm : table.torque_limit_Nm;
  std::ostringstream text;
  text << "; torque limit " << holds_Nm << " N.m, "
       << (lowered ? "joint.limits.torque_limit_Nm, below the table's "
                   : "the table's, below joint.limits.torque_limit_Nm = ")
       << (lowered ? table.torque_limit_Nm : torque_limit_Nm);
  const TemperatureRule& coldest = table.friction.rules.front();
  if (coldest.friction.static_Nm >= holds_Nm)
    text << "; the joint at " << coldest.center_C << " degC withstands " << coldest.friction.static_Nm
         << " N.m and will not move there";
  return text.str();
}

}  // namespace

TableVerdict judge_table(const GainTable& table, const PlantIdentity& expected, double torque_limit_Nm) {
  if (const auto defect = find_defect(table)) return {Reason::kTableDefect, *defect};
  if (std::abs(table.plant.period_s - expected.period_s) > kTolerance * expected.period_s) {
    std::ostringstream text;
    text << "period_s = " << table.plant.period_s << " in the table, " << expected.period_s
         << " in this daemon: design the table with --period_s " << expected.period_s;
    return {Reason::kTablePeriod, text.str()};
  }
  if (const auto mismatch = find_identity_mismatch(table, expected))
    return {Reason::kTableIdentity, *mismatch};
  TableVerdict primary = judge_gains("primary", table.primary, expected, table.friction);
  if (primary.reason != Reason::kAccepted) return primary;
  TableVerdict fallback = judge_gains("fallback", table.fallback, expected, table.friction);
  if (fallback.reason != Reason::kAccepted) return fallback;
  primary.text += which_torque_limit_holds(table, torque_limit_Nm);
  return primary;
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
