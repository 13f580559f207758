// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/student.h"

#include <boost/math/distributions/students_t.hpp>
#include <cassert>

namespace strainwave {

double student_t(double confidence, int degrees_of_freedom) {
  assert(confidence > 0.0 && confidence < 1.0 && degrees_of_freedom >= 1);
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.5 + 0.5 * confidence);
}

}  // namespace strainwave
