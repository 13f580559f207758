#include "client/commands/sibling_program.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "client/link/client.h"
#include "client/link/exit_status.h"

namespace strainwave {

int run_sibling(const std::string& name, const std::vector<std::string>& arguments) {
  std::error_code error;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / name;
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = -1;
  if (const int failure = ::posix_spawn(&child, program.c_str(), nullptr, nullptr, argv.data(), environ);
      failure != 0)
    throw ClientError(ExitStatus::kUsage, program +
                                              " cannot be run: " + std::generic_category().message(failure) +
                                              ": install it beside strainwavectl");
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waiting for " + name);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace strainwave
