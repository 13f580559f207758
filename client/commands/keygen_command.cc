// SPDX-License-Identifier: BSD-3-Clause
// keygen: makes a new key pair. Needs neither daemon nor LCM.
#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <array>

#include "client/commands/commands.h"
#include "client/protocol/key_file.h"

namespace strainwave {

namespace {

/// "user@host", as ssh-keygen writes it.
std::string default_comment() {
  std::array<char, 256> host{};
  const bool named = ::gethostname(host.data(), host.size() - 1) == 0;
  const passwd* user = ::getpwuid(::getuid());  // NOLINT(concurrency-mt-unsafe): one thread
  std::string comment = user != nullptr ? user->pw_name : std::to_string(::getuid());
  if (named) comment += std::string("@") + host.data();
  return is_valid_comment(comment) ? comment : "";
}

}  // namespace

void keygen(const Output& output, const KeygenArguments& arguments) {
  const AuthorizedKey key = write_new_key(arguments.out, arguments.role,
                                          arguments.comment ? *arguments.comment : default_comment());
  const std::string file = arguments.out.string();
  say(output,
      fmt::format(
          "{0}: the secret key; keep it secret, use it with --key {0} or STRAINWAVE_KEY={0}\n"
          "{0}.pub: its public line, for the file that the daemon's security.authorized_keys names:\n{1}",
          file, to_line(key)),
      {{"secret_key", file}, {"public_key", file + ".pub"}, {"line", to_line(key)}});
}

}  // namespace strainwave
