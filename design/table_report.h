// SPDX-License-Identifier: BSD-3-Clause
// Gain tables for people: the margins of the certificate, and a description. Offline.
#pragma once

#include <string>

#include "control/table/certificate.h"
#include "control/table/gain_table.h"

namespace strainwave {

/// The margins as a table, rows: rule of the plant, columns: rule of the controller, each the worst over the next rule.
std::string margins_text(const FeedbackGains& gains, const CertificateReport& report);

/// What the table is for, its rules, gains, and where it came from.
std::string description(const GainTable& table);

}  // namespace strainwave
