#include "client/text/state_csv.h"

#include "client/text/message_csv.h"

namespace strainwave {

std::string csv_header() {
  return "joint" + csv_columns<state_v1>();
}

std::string csv_row(const std::string& joint, const state_v1& state) {
  return joint + csv_values(state);
}

}  // namespace strainwave
