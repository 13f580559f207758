// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/records/flight_record_writer.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>
#include <system_error>
#include <utility>

#include "base/durations.h"
#include "base/unique_fd.h"
#include "base/utime.h"
#include "daemon/realtime/loop/periodic_clock.h"
#include "daemon/records/flight_record_file.h"

namespace strainwave {

namespace {

namespace fs = std::filesystem;

constexpr auto kTurn = std::chrono::milliseconds(50);
constexpr double kBytesPerMB = 1e6;
constexpr const char* kUnfinished = ".part";

std::string error_text(const std::string& what) {
  return what + ": " + std::generic_category().message(errno);
}

bool write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

struct RecordFile {
  fs::path path;
  fs::file_time_type time;
  std::uintmax_t size;
};

// Lists our records, oldest first, including those that a crash has left unfinished.
std::vector<RecordFile> list_records(const fs::path& directory, std::error_code& error) {
  std::vector<RecordFile> records;
  for (auto it = fs::directory_iterator(directory, error); !error && it != fs::directory_iterator();
       it.increment(error)) {
    const std::string name = it->path().filename().string();
    const bool ours =
        name.ends_with(kFlightRecordSuffix) || name.ends_with(std::string(kFlightRecordSuffix) + kUnfinished);
    std::error_code ignored;
    if (!ours || !it->is_regular_file(ignored) || it->is_symlink(ignored)) continue;
    records.push_back({it->path(), it->last_write_time(ignored), it->file_size(ignored)});
  }
  std::sort(records.begin(), records.end(),
            [](const RecordFile& a, const RecordFile& b) { return a.time < b.time; });
  return records;
}

}  // namespace

FlightRecordWriter::FlightRecordWriter(const RecorderConfig& config, double period_s, std::int64_t session_id,
                                       std::vector<Source> sources, Report report)
    : config_(config), period_s_(period_s), session_id_(session_id), report_(std::move(report)) {
  for (Source& source : sources)
    states_.push_back({std::move(source), std::numeric_limits<std::int64_t>::min()});
}

FlightRecordWriter::~FlightRecordWriter() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void FlightRecordWriter::start() {
  thread_ = std::thread([this] { run(); });
}

void FlightRecordWriter::run() {
  // At a file size limit, write() must return an error, and the process must not end.
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGXFSZ);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::unique_lock lock(mutex_);
  while (!stop_) {
    wake_.wait_for(lock, kTurn, [this] { return stop_; });
    lock.unlock();
    turn(monotonic_now_ns());
    lock.lock();
  }
}

void FlightRecordWriter::turn(std::int64_t now_ns) {
  for (State& state : states_) {
    if (!state.source.recorder->frozen()) continue;
    handle(state, now_ns);
    state.source.recorder->release();
  }
}

void FlightRecordWriter::handle(State& state, std::int64_t now_ns) {
  const std::string& joint = state.source.joint;
  if (now_ns < state.not_before_ns)
    return report_(
        true, joint + ": flight record dropped: recorder.min_interval_s has not passed since the last one",
        now_ns);
  const FlightRecorder& recorder = *state.source.recorder;
  const std::int64_t since_fault_us = (now_ns - recorder.sample(recorder.fault_index()).time_ns) / 1000;
  const FlightRecordHeader header{joint, state.source.joint_model, session_id_, utime_now() - since_fault_us,
                                  period_s_};
  const std::string name = flight_record_name(header, recorder);
  std::string problem;
  if (!write(name, flight_record_text(header, recorder), problem))
    return report_(true, joint + ": flight record lost: " + problem, now_ns);
  state.not_before_ns = now_ns + nanoseconds(config_.min_interval_s);
  report_(false, joint + ": flight record " + (config_.directory / name).string(), now_ns);
}

bool FlightRecordWriter::write(const std::string& name, const std::string& text, std::string& problem) {
  std::error_code error;
  fs::create_directories(config_.directory, error);
  if (!make_room(text.size(), problem)) return false;
  const fs::path path = config_.directory / name;
  const fs::path unfinished = path.string() + kUnfinished;
  UniqueFd file(::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0640));
  if (!file) {
    problem = error_text(unfinished.string() + " cannot be made (recorder.directory)");
    return false;
  }
  const bool written = write_all(file.get(), text) && ::fsync(file.get()) == 0;
  if (!written) problem = error_text(unfinished.string() + " cannot be written");
  const bool closed = file.close();
  if (written && closed && ::rename(unfinished.c_str(), path.c_str()) == 0) return true;
  if (problem.empty()) problem = error_text(path.string() + " cannot be finished");
  ::unlink(unfinished.c_str());
  return false;
}

// Removes unfinished records, and the oldest until another one of `size` bytes keeps both bounds.
bool FlightRecordWriter::make_room(std::uintmax_t size, std::string& problem) {
  const auto bound = static_cast<std::uintmax_t>(config_.max_total_MB * kBytesPerMB);
  if (size > bound) {
    problem = "it has " + std::to_string(size) + " bytes, and recorder.max_total_MB allows " +
              std::to_string(bound) + " bytes";
    return false;
  }
  std::error_code error;
  std::vector<RecordFile> records = list_records(config_.directory, error);
  if (error) {
    problem = config_.directory.string() + " cannot be read (recorder.directory): " + error.message();
    return false;
  }
  std::uintmax_t total = size;
  for (const RecordFile& record : records) total += record.size;
  std::size_t kept = records.size() + 1;
  for (const RecordFile& record : records) {
    const bool unfinished = record.path.extension() == kUnfinished;
    if (!unfinished && kept <= static_cast<std::size_t>(config_.max_files) && total <= bound) continue;
    if (!fs::remove(record.path, error)) {
      problem = record.path.string() + " cannot be removed to make room: " + error.message();
      return false;
    }
    total -= record.size;
    --kept;
  }
  return true;
}

}  // namespace strainwave
