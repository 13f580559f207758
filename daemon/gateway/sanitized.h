// SPDX-License-Identifier: BSD-3-Clause
// Whether this build has a sanitizer. Its runtime needs operations that a confined process may not use.
#pragma once

namespace strainwave {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace strainwave
