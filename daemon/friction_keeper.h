// SPDX-License-Identifier: BSD-3-Clause
// Keeps what joints learn of their friction in files, over restarts of the daemon, and logs where it differs from a table. The supervisor's;
// files are written in a thread of their own, because a slow disk must not keep a stop waiting. Not real-time.
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
  /// What a joint learns is written this often at most.
  static constexpr std::int64_t kEvery_ns = 60'000'000'000;

  /// With an empty `directory` nothing is kept, and the log says so.
  FrictionKeeper(std::filesystem::path directory, std::vector<std::string> joints);
  ~FrictionKeeper() { finish(); }
  FrictionKeeper(const FrictionKeeper&) = delete;
  FrictionKeeper& operator=(const FrictionKeeper&) = delete;

  /// Before the loop runs: gives `loop` what `joint` learned with these rules. A file for others is not used; one that is damaged is renamed
  /// to *.damaged. The log says so.
  void restore(std::size_t joint, const FuzzyFriction& rules, JointLoop& loop, std::int64_t now_ns);
  /// Begins to write.
  void start();
  /// Of every state: what has changed goes to the writer once a minute, and the begin and end of notice kFrictionDiffers to the log.
  void observe(const StateRecord& record, std::int64_t now_ns);
  /// Writes what has changed and ends the thread. May be repeated.
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
  bool failed_ = false;  ///< the last write, which the log knows
  std::thread thread_;
};

}  // namespace strainwave
