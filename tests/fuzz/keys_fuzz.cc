// SPDX-License-Identifier: BSD-3-Clause
// Any key that is read from a file is the same after it is written and read again.
#include "base/input_error.h"
#include "client/protocol/key_file.h"
#include "daemon/admission/authorized_keys.h"
#include "tests/fuzz/fuzz_file.h"

namespace {

void read_secret(const strainwave::fuzz::FuzzFile& file) {
  using namespace strainwave;
  try {
    const SecretKeyText secret = read_secret_key(file.path());
    STRAINWAVE_FUZZ_CHECK(is_valid_comment(secret.comment));
    STRAINWAVE_FUZZ_CHECK(to_line(parse_secret_line(to_line(secret))) == to_line(secret));
  } catch (const InputError&) {
    // Refused, which is right for most inputs.
  }
}

void read_public(const strainwave::fuzz::FuzzFile& file) {
  using namespace strainwave;
  try {
    const AuthorizedKeys keys = read_authorized_keys(file.path());
    STRAINWAVE_FUZZ_CHECK(keys.size() >= 1 && keys.size() <= AuthorizedKeys::kMaxKeys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      STRAINWAVE_FUZZ_CHECK(keys.find(keys[i].key.id()) == i);
      STRAINWAVE_FUZZ_CHECK(to_line(parse_public_line(to_line(keys[i]))) == to_line(keys[i]));
    }
  } catch (const InputError&) {
    // Refused.
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const strainwave::fuzz::FuzzFile file(data, size);
  read_secret(file);
  read_public(file);
  return 0;
}
