// SPDX-License-Identifier: BSD-3-Clause
// Keeps the learned friction of all joints in files over restarts of the daemon, and logs when it differs from a table. Part of the
// supervisor. A thread of its own writes the files, because a slow disk must not delay a stop. Not real-time.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "daemon/friction_file.h"
#include "daemon/log.h"
#include "daemon/realtime/joint/joint_loop.h"

namespace strainwave {

class FrictionKeeper {
 public:
  /// Shortest interval between two writes of a joint's friction while the daemon runs.
  static constexpr std::int64_t kEvery_ns = 60'000'000'000;

  /// With an empty `directory` nothing is kept, and the log says so.
  FrictionKeeper(std::filesystem::path directory, std::vector<std::string> joints);
  ~FrictionKeeper() { finish(); }
  FrictionKeeper(const FrictionKeeper&) = delete;
  FrictionKeeper& operator=(const FrictionKeeper&) = delete;

  /// Gives `loop` the friction that `joint` learned with these rules; call it before the loop runs. A file for another joint or other
  /// rules is not used, and a damaged file is renamed to *.damaged. Both are logged.
  void restore(std::size_t joint, const FuzzyFriction& rules, JointLoop& loop, std::int64_t now_ns);
  /// Starts the writing thread.
  void start();
  /// Call it with every state. Once a minute, changes go to the writer. Begin and end of notice kFrictionDiffers go to the log.
  void observe(const StateRecord& record, std::int64_t now_ns);
  /// Writes all changes and ends the thread. May be called again.
  void finish();

 private:
  struct Joint {
    std::string name;
    StateRecord latest{};
    std::array<double, kMaxTemperatureRules> kept{};  ///< scales in the file
    std::int64_t due_ns = 0;
    bool differs = false;
  };
  void hand_over(Joint& joint);
  void log_difference(Joint& joint, std::int64_t now_ns);
  void run();
  void write(const std::string& joint, const std::optional<KeptFriction>& kept);

  std::filesystem::path directory_;
  std::vector<Joint> joints_;
  LogLimiter difference_log_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::map<std::string, std::optional<KeptFriction>> waiting_;  ///< by joint; nothing: remove its file
  bool stop_ = false;
  bool failed_ = false;  ///< the last write failed, and the log says so
  std::thread thread_;
};

}  // namespace strainwave
