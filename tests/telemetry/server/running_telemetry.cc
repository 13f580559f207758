// SPDX-License-Identifier: BSD-3-Clause
#include "tests/telemetry/server/running_telemetry.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <fstream>
#include <stdexcept>

#include "tests/support/daemon_fixture.h"

namespace strainwave::testing {

namespace {

using Clock = std::chrono::steady_clock;

/// Returns some bytes, or "" if the other side has closed or nothing comes for `seconds`.
std::string read_some(int descriptor, double seconds, std::size_t most = 65536) {
  pollfd ready{descriptor, POLLIN, 0};
  if (::poll(&ready, 1, static_cast<int>(seconds * 1e3)) != 1) return "";
  std::array<char, 65536> bytes{};
  const ssize_t size = ::read(descriptor, bytes.data(), std::min(most, bytes.size()));
  return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
}

}  // namespace

RunningTelemetry::RunningTelemetry(const std::vector<std::string>& options, const std::string& address) {
  const std::string program = programs_folder() / "strainwave-telemetry";
  std::vector<std::string> words{program, "--listen", address + ":0"};
  words.insert(words.end(), options.begin(), options.end());
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  output_.reset(pipe[0]);
  pid_ = ::fork();
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(pipe[1], STDOUT_FILENO);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(program.c_str(), arguments.data());
    ::_exit(127);
  }
  ::close(pipe[1]);
  std::string said;
  while (said.find("/metrics\n") == std::string::npos) {
    const std::string more = read_some(output_.get(), 10.0);
    if (more.empty()) return;  // the program did not start; port() stays 0
    said += more;
  }
  const std::size_t end = said.find('\n');
  port_ = static_cast<std::uint16_t>(std::stoi(said.substr(said.rfind(':', end) + 1)));
}

RunningTelemetry::~RunningTelemetry() {
  ::kill(pid_, SIGTERM);
  ::waitpid(pid_, nullptr, 0);
}

bool RunningTelemetry::running() const {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == 0;
}

long RunningTelemetry::memory_kB() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  return -1;
}

std::string RunningTelemetry::metrics() const {
  const RawClient client(port_);
  client.send("GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const std::string answer = client.read_all();
  return answer.starts_with("HTTP/1.1 200 OK\r\n") ? answer.substr(answer.find("\r\n\r\n") + 4) : "";
}

double RunningTelemetry::metric(const std::string& sample) const {
  const std::string page = metrics();
  const std::size_t found = page.find("\n" + sample + " ");
  return found == std::string::npos ? -1.0 : std::stod(page.substr(found + sample.size() + 2));
}

RawClient::RawClient(std::uint16_t port, int receive_buffer_bytes)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  if (receive_buffer_bytes > 0)
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes, sizeof receive_buffer_bytes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_.get(), static_cast<const sockaddr*>(static_cast<const void*>(&address)),
                sizeof address) != 0)
    throw std::runtime_error("cannot connect to strainwave-telemetry");
}

bool RawClient::send(const std::string& bytes) const {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t size = ::send(socket_.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (size <= 0) return false;
    sent += static_cast<std::size_t>(size);
  }
  return true;
}

std::string RawClient::read_all() const {
  std::string all;
  for (std::string more; !(more = read_some(socket_.get(), 5.0)).empty();) all += more;
  return all;
}

std::string RawClient::read_until(const std::string& end) const {
  std::string all;
  while (all.find(end) == std::string::npos) {
    const std::string more = read_some(socket_.get(), 5.0);
    if (more.empty()) break;
    all += more;
  }
  return all;
}

bool RawClient::is_closed_within(double seconds) const {
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  std::array<char, 65536> bytes{};
  while (Clock::now() < deadline) {
    pollfd ready{socket_.get(), POLLIN, 0};
    if (::poll(&ready, 1, 100) == 1 && ::read(socket_.get(), bytes.data(), bytes.size()) <= 0) return true;
  }
  return false;
}

bool RawClient::become_viewer(const std::string& headers) const {
  send(
      "GET / HTTP/1.1\r\n" + headers +
      "Connection: Upgrade\r\nUpgrade: "
      "websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\nSec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n");
  // Reads byte by byte, because the server's first messages follow the header.
  std::string header;
  while (!header.ends_with("\r\n\r\n")) {
    const std::string byte = read_some(socket_.get(), 5.0, 1);
    if (byte.empty()) break;
    header += byte;
  }
  return header.starts_with("HTTP/1.1 101 ");
}

bool RawClient::send_text(const std::string& text) const {
  return send(frame_header(text.size()) + text);
}

std::string frame_header(std::uint64_t bytes, unsigned int opcode) {
  constexpr unsigned int kLast = 0x80;
  constexpr unsigned int kMasked = 0x80;
  std::string header{static_cast<char>(kLast | opcode)};
  const auto put = [&](unsigned int count) {
    for (unsigned int i = count; i-- > 0;) header += static_cast<char>(bytes >> (8U * i));
  };
  if (bytes < 126) {
    header += static_cast<char>(kMasked | bytes);
  } else if (bytes < 65536) {
    header += static_cast<char>(kMasked | 126U);
    put(2);
  } else {
    header += static_cast<char>(kMasked | 127U);
    put(8);
  }
  return header + std::string(4, '\0');
}

}  // namespace strainwave::testing
