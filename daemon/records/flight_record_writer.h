// SPDX-License-Identifier: BSD-3-Clause
// Writes flight records to files in a thread of its own, so that a slow, full or absent disk delays nothing
// else. Limits their number, size and rate, and removes the oldest records to make room. Not real-time.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "daemon/realtime/loop/flight_recorder.h"

namespace strainwave {

struct RecorderConfig {
  double seconds = 5.0;             ///< length of a record
  double post_trigger_s = 0.5;      ///< part of it that follows the fault
  std::filesystem::path directory;  ///< empty: nothing is recorded
  int max_files = 50;
  double max_total_MB = 200.0;   ///< of all records together
  double min_interval_s = 10.0;  ///< between two records of one joint

  bool enabled() const { return !directory.empty(); }
};

class FlightRecordWriter {
 public:
  struct Source {
    std::string joint;
    std::string joint_model;
    FlightRecorder* recorder;
  };
  /// Reports a record that was written, or (`lost`) one that was not. The writer's own thread calls it.
  using Report = std::function<void(bool lost, const std::string& text, std::int64_t now_ns)>;
  FlightRecordWriter(const RecorderConfig& config, double period_s, std::int64_t session_id,
                     std::vector<Source> sources, Report report);
  /// Writes the frozen records, then ends the thread.
  ~FlightRecordWriter();
  FlightRecordWriter(const FlightRecordWriter&) = delete;
  FlightRecordWriter& operator=(const FlightRecordWriter&) = delete;

  void start();
  /// Writes every frozen record and releases its memory, even if the write fails. The thread calls this again and again.
  void turn(std::int64_t now_ns);

 private:
  struct State {
    Source source;
    std::int64_t not_before_ns;
  };
  void run();
  void handle(State& state, std::int64_t now_ns);
  bool write(const std::string& name, const std::string& text, std::string& problem);
  bool make_room(std::uintmax_t size, std::string& problem);

  RecorderConfig config_;
  double period_s_;
  std::int64_t session_id_;
  std::vector<State> states_;
  Report report_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace strainwave
