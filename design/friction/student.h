// SPDX-License-Identifier: BSD-3-Clause
// Student's t distribution. Offline.
#pragma once

namespace strainwave {

/// The t with P(|T| <= t) = `confidence` for `degrees_of_freedom` >= 1, 0 < confidence < 1; to about 1e-9.
double student_t(double confidence, int degrees_of_freedom);

}  // namespace strainwave
