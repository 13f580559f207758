// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/friction_keeper.h"

#include <signal.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/input_error.h"
#include "base/text_file.h"
#include "base/utime.h"
#include "daemon/admission/table_admission.h"

namespace strainwave {

namespace {

constexpr int kDifferenceLines = 10;

void set_aside(const std::filesystem::path& path) {
  std::filesystem::path aside = path;
  aside += ".damaged";
  std::error_code error;
  std::filesystem::rename(path, aside, error);
  if (error)
    spdlog::warn("{}: cannot be renamed: {}", path.string(), error.message());
  else
    spdlog::warn("{}: renamed to {}", path.string(), aside.string());
}

/// Returns the contents of a joint's file, or nothing if it is missing, damaged, or for another joint or other rules.
std::optional<KeptFriction> read_kept(const std::filesystem::path& path, const std::string& joint,
                                      std::int64_t friction_rules_id) {
  std::error_code error;
  if (!std::filesystem::exists(std::filesystem::symlink_status(path, error))) return std::nullopt;
  try {
    KeptFriction kept = parse_kept_friction(read_text_file(path), path.string());
    if (kept.joint == joint && kept.friction_rules_id == friction_rules_id) return kept;
    spdlog::info("{}: learned friction in {} is not used: it is for {}", joint, path.string(),
                 kept.joint == joint ? "other friction rules than the table's" : "another joint");
  } catch (const InputError& damage) {
    spdlog::warn("{}: learned friction is not used: {}", joint, damage.what());
    set_aside(path);
  }
  return std::nullopt;
}

KeptFriction kept_of(const std::string& joint, const StateRecord& record) {
  KeptFriction kept;
  kept.joint = joint;
  kept.friction_rules_id = record.friction_rules_id;
  std::copy(std::begin(record.state.friction_scales), std::end(record.state.friction_scales),
            kept.scale.begin());
  kept.learned_C = record.state.friction_learned_C;
  kept.learned_utime = utime_now() - std::llround(1e6 * record.state.friction_age_s);
  return kept;
}

}  // namespace

FrictionKeeper::FrictionKeeper(std::filesystem::path directory, std::vector<std::string> joints)
    : directory_(std::move(directory)), difference_log_(kDifferenceLines, kEvery_ns) {
  for (std::string& name : joints) joints_.push_back({.name = std::move(name)});
  if (directory_.empty())
    spdlog::info("learned friction is not kept over a restart: daemon.state_directory names no folder");
}

void FrictionKeeper::restore(std::size_t joint, const FuzzyFriction& rules, JointLoop& loop,
                             std::int64_t now_ns) {
  if (directory_.empty()) return;
  Joint& mine = joints_[joint];
  const auto kept = read_kept(friction_file(directory_, mine.name), mine.name, friction_rules_digest(rules));
  if (!kept) return;
  const std::int64_t age_us = std::max<std::int64_t>(0, utime_now() - kept->learned_utime);
  loop.joint().law.restore({kept->scale, 0.0},
                           {.learned_C = kept->learned_C, .learned_ns = now_ns - 1000 * age_us});
  mine.kept = kept->scale;
  spdlog::info("{}: using the friction learned at {:.1f} degC, {} h ago", mine.name, kept->learned_C,
               age_us / 3'600'000'000);
}

void FrictionKeeper::start() {
  if (!directory_.empty() && !thread_.joinable()) thread_ = std::thread([this] { run(); });
}

void FrictionKeeper::observe(const StateRecord& record, std::int64_t now_ns) {
  Joint& joint = joints_[static_cast<std::size_t>(record.joint_index)];
  joint.latest = record;
  log_difference(joint, now_ns);
  if (joint.due_ns == 0) joint.due_ns = now_ns + kEvery_ns;
  if (now_ns < joint.due_ns) return;
  joint.due_ns = now_ns + kEvery_ns;
  hand_over(joint);
}

void FrictionKeeper::hand_over(Joint& joint) {
  const StateRecord& record = joint.latest;
  if (!thread_.joinable() || record.friction_rules_id == 0 ||
      std::equal(joint.kept.begin(), joint.kept.end(), std::begin(record.state.friction_scales)))
    return;
  std::copy(std::begin(record.state.friction_scales), std::end(record.state.friction_scales),
            joint.kept.begin());
  const std::lock_guard held(mutex_);
  waiting_[joint.name] =
      record.state.friction_age_s < 0.0 ? std::nullopt : std::optional(kept_of(joint.name, record));
  wake_.notify_one();
}

void FrictionKeeper::log_difference(Joint& joint, std::int64_t now_ns) {
  const state_v1& state = joint.latest.state;
  const bool differs = (state.notices & static_cast<std::int32_t>(Notice::kFrictionDiffers)) != 0;
  if (std::exchange(joint.differs, differs) == differs) return;
  std::int64_t suppressed = 0;
  if (!difference_log_.allow(now_ns, suppressed)) return;
  if (differs)
    spdlog::warn("{}: {}: {:.2f} times the table's at {:.1f} degC, see {}", joint.name,
                 to_text(Notice::kFrictionDiffers), state.friction_factor, state.temperature_used_C,
                 configuration_key(Notice::kFrictionDiffers));
  else
    spdlog::info("{}: friction is near the table's again: {:.2f} times it at {:.1f} degC", joint.name,
                 state.friction_factor, state.temperature_used_C);
}

void FrictionKeeper::finish() {
  if (!thread_.joinable()) return;
  for (Joint& joint : joints_) hand_over(joint);
  {
    const std::lock_guard held(mutex_);
    stop_ = true;
    wake_.notify_one();
  }
  thread_.join();
}

void FrictionKeeper::run() {
  sigset_t signals{};
  ::sigfillset(&signals);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::unique_lock held(mutex_);
  while (true) {
    wake_.wait(held, [this] { return stop_ || !waiting_.empty(); });
    const auto work = std::exchange(waiting_, {});
    if (work.empty()) return;
    held.unlock();
    for (const auto& [joint, kept] : work) write(joint, kept);
    held.lock();
  }
}

void FrictionKeeper::write(const std::string& joint, const std::optional<KeptFriction>& kept) {
  const std::filesystem::path path = friction_file(directory_, joint);
  try {
    make_folder(directory_);
    if (kept)
      write_text_file(path, to_json(*kept));
    else
      std::filesystem::remove(path);
    failed_ = false;
  } catch (const std::exception& error) {
    if (!std::exchange(failed_, true))
      spdlog::warn("{}: learned friction cannot be saved: {}", joint, error.what());
  }
}

}  // namespace strainwave
