// SPDX-License-Identifier: BSD-3-Clause
// The hardware at the other end of a GPIO joint's wires, for tests in the virtual machine. It reads the lines
// and the PWM that the daemon drives, turns the motor, and moves counter, switches and encoder lines. It
// shares no code with drivers/gpio and uses only the wires: gpio-sim's sysfs files, and plain files in the
// place of PWM and counter.
//
//   gpio_board plant LINES TREE POSITION_RAD   the joint, until SIGTERM
//   gpio_board encoder LINES RATE_HZ SECONDS BOUNCES   quadrature edges on lines a and b: three quarters forward,
//       one back, each after so many bounces of 50 us; prints the count and the actual rate
//   gpio_board bounce LINES INPUT SECONDS      a bouncing contact: never active for more than 5 ms, nor inactive
//       for less than 2 ms
//   gpio_board react LINES TREE INPUT          activates INPUT and prints the ns until enable is low and the
//       duty 0
//
// LINES: folder with one link per line, with the line's name, to its sim_gpioN folder. TREE: folder with
// pwm/, count0/ and truth, the joint's position in rad.
#include <fcntl.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <random>
#include <string>

#include "sim/joint/joint_plant.h"
#include "sim/joint/reference_plant.h"

namespace {

constexpr long kPeriod_ns = 1'000'000;
constexpr double kFullScale_A = 5.0;
constexpr double kTorqueConstant_Nm_A = 9.6;
constexpr double kCounts_rad = 320000.0 / (2.0 * std::numbers::pi);
/// End switches and home switch of the joint, rad.
constexpr double kEnd_rad = 0.5;
constexpr double kHomeFrom_rad = 0.10;
constexpr double kHomeTo_rad = 0.15;
constexpr long kBounce_ns = 25'000;
constexpr long kLongestOn_ns = 5'000'000;
constexpr long kShortestOff_ns = 2'000'000;
constexpr double kIndexSpacing_rad = 2.0 * std::numbers::pi / 50.0;

volatile sig_atomic_t ended = 0;
void end(int) {
  ended = 1;
}

[[noreturn]] void fail(const std::string& what) {
  std::perror(what.c_str());
  std::exit(2);
}

/// A small file that stays open.
class File {
 public:
  File(const std::string& path, int mode) : path_(path), fd_(::open(path.c_str(), mode | O_CLOEXEC)) {
    if (fd_ < 0) fail(path);
  }
  long number() {
    char text[64] = {};
    if (::pread(fd_, text, sizeof text - 1, 0) < 0) fail(path_);
    return std::strtol(text, nullptr, 10);
  }
  void put(const std::string& text) {
    if (::pwrite(fd_, text.data(), text.size(), 0) < 0) fail(path_);
  }

 private:
  std::string path_;
  int fd_;
};

/// A wire into the daemon's input.
class Input {
 public:
  Input(const std::string& lines, const std::string& name) : pull_(lines + "/" + name + "/pull", O_WRONLY) {}
  void set(bool high) {
    if (high == high_ && set_) return;
    pull_.put(high ? "pull-up" : "pull-down");
    high_ = high;
    set_ = true;
  }
  bool high() const { return high_; }

 private:
  File pull_;
  bool high_ = false;
  bool set_ = false;
};

/// A wire from the daemon's output.
File output(const std::string& lines, const std::string& name) {
  return {lines + "/" + name + "/value", O_RDONLY};
}

void advance(timespec& time, long step_ns) {
  time.tv_nsec += step_ns;
  while (time.tv_nsec >= 1'000'000'000) {
    time.tv_nsec -= 1'000'000'000;
    ++time.tv_sec;
  }
}

long since_ns(const timespec& from) {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return (now.tv_sec - from.tv_sec) * 1'000'000'000 + now.tv_nsec - from.tv_nsec;
}

int run_plant(const std::string& lines, const std::string& tree, double position_rad) {
  strainwave::JointPlantConfig config = strainwave::realistic_plant();
  config.delay.periods = 0.0;
  config.initial_position_rad = position_rad;
  strainwave::JointPlant plant(config);
  plant.set_ambient_temperature(25.0);
  File enable = output(lines, "enable");
  File direction = output(lines, "direction");
  File brake = output(lines, "brake_release");
  File duty(tree + "/pwm/pwm0/duty_cycle", O_RDONLY);
  File period(tree + "/pwm/pwm0/period", O_RDONLY);
  File count(tree + "/count0/count", O_WRONLY);
  File truth(tree + "/truth", O_WRONLY);
  Input negative(lines, "negative_limit");
  Input positive(lines, "positive_limit");
  Input home(lines, "home");
  Input index(lines, "index");
  timespec next{};
  ::clock_gettime(CLOCK_MONOTONIC, &next);
  double turn = std::floor(position_rad / kIndexSpacing_rad);
  while (ended == 0) {
    const double share =
        static_cast<double>(duty.number()) / std::fmax(1.0, static_cast<double>(period.number()));
    const bool driven = enable.number() != 0;
    const double torque_Nm =
        (direction.number() != 0 ? -1.0 : 1.0) * share * kFullScale_A * kTorqueConstant_Nm_A;
    // A closed brake holds the joint whatever the motor's torque.
    if (brake.number() != 0) plant.step(driven ? torque_Nm : 0.0);
    const double now_rad = plant.state().position_rad;
    const long counts = std::lround((now_rad - position_rad) * kCounts_rad);
    char text[24];
    std::snprintf(text, sizeof text, "%010lu\n", static_cast<unsigned long>(counts) & 0xFFFFFFFFUL);
    count.put(text);
    // The end-of-travel contacts open there. The home contact closes at home.
    negative.set(now_rad <= -kEnd_rad);
    positive.set(now_rad >= kEnd_rad);
    home.set(!(now_rad >= kHomeFrom_rad && now_rad <= kHomeTo_rad));
    const double new_turn = std::floor(now_rad / kIndexSpacing_rad);
    if (new_turn != turn) {
      index.set(true);
      index.set(false);
    }
    turn = new_turn;
    std::snprintf(text, sizeof text, "%+.9f\n", now_rad);
    truth.put(text);
    advance(next, kPeriod_ns);
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, nullptr);
  }
  return 0;
}

void pause_ns(long duration_ns) {
  const timespec pause{0, duration_ns};
  ::nanosleep(&pause, nullptr);
}

int run_encoder(const std::string& lines, double rate_Hz, double duration_s, int bounces) {
  Input a(lines, "quadrature_a");
  Input b(lines, "quadrature_b");
  a.set(false);
  b.set(false);
  const long edges = std::lround(rate_Hz * duration_s);
  const long step_ns = std::lround(1e9 / rate_Hz);
  long count = 0;
  timespec next{};
  ::clock_gettime(CLOCK_MONOTONIC, &next);
  const timespec begin = next;
  for (long i = 0; i < edges && ended == 0; ++i) {
    count += i < edges / 4 * 3 ? 1 : -1;
    const long phase = ((count % 4) + 4) % 4;
    const bool a_high = phase == 1 || phase == 2;
    const bool b_high = phase == 2 || phase == 3;
    for (int bounce = 0; bounce < bounces; ++bounce) {
      // Only one of the two lines changes.
      const bool a_before = a.high();
      const bool b_before = b.high();
      a.set(a_high);
      b.set(b_high);
      pause_ns(kBounce_ns);
      a.set(a_before);
      b.set(b_before);
      pause_ns(kBounce_ns);
    }
    a.set(a_high);
    b.set(b_high);
    advance(next, step_ns);
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, nullptr);
  }
  std::printf("%ld %.0f\n", count, 1e9 * static_cast<double>(edges) / static_cast<double>(since_ns(begin)));
  return 0;
}

int run_bounces(const std::string& lines, const std::string& name, double duration_s) {
  Input input(lines, name);
  std::mt19937 random(11);
  std::uniform_int_distribution<long> on_ns(kBounce_ns, kLongestOn_ns);
  timespec begin{};
  ::clock_gettime(CLOCK_MONOTONIC, &begin);
  while (static_cast<double>(since_ns(begin)) < 1e9 * duration_s) {
    input.set(true);
    pause_ns(on_ns(random));
    input.set(false);
    pause_ns(kShortestOff_ns);
  }
  return 0;
}

int run_reaction(const std::string& lines, const std::string& tree, const std::string& name) {
  Input input(lines, name);
  File enable = output(lines, "enable");
  File duty(tree + "/pwm/pwm0/duty_cycle", O_RDONLY);
  timespec begin{};
  ::clock_gettime(CLOCK_MONOTONIC, &begin);
  input.set(true);
  while (enable.number() != 0 || duty.number() != 0) {
    const timespec pause{0, 20'000};
    ::nanosleep(&pause, nullptr);
    if (since_ns(begin) > 1'000'000'000) {
      std::puts("no reaction within a second");
      return 1;
    }
  }
  std::printf("%ld\n", since_ns(begin));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ::signal(SIGTERM, end);
  const std::string task = argc > 1 ? argv[1] : "";
  if (task == "plant" && argc == 5) return run_plant(argv[2], argv[3], std::atof(argv[4]));
  if (task == "encoder" && argc == 6)
    return run_encoder(argv[2], std::atof(argv[3]), std::atof(argv[4]), std::atoi(argv[5]));
  if (task == "bounce" && argc == 5) return run_bounces(argv[2], argv[3], std::atof(argv[4]));
  if (task == "react" && argc == 5) return run_reaction(argv[2], argv[3], argv[4]);
  std::fputs(
      "gpio_board plant LINES TREE POSITION_RAD | encoder LINES RATE_HZ SECONDS BOUNCES | bounce LINES INPUT "
      "SECONDS"
      " | react LINES TREE INPUT\n",
      stderr);
  return 2;
}
