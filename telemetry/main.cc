// SPDX-License-Identifier: BSD-3-Clause
// strainwave-telemetry: live plots and metrics of LCM messages, and with a key a page that can move joints. See `strainwave-telemetry --help`.
#include <CLI/CLI.hpp>
#include <iostream>

#include "base/input_error.h"
#include "base/manual/command_line.h"
#include "lcmtypes/multicast_check.h"
#include "telemetry/telemetry.h"

namespace {

struct Options {
  std::string lcm_url = strainwave::kUsualLcmUrl;
  std::string listen = "127.0.0.1:8765";
  std::string token_file;
  std::string key_file;
  std::vector<std::string> origins{"https://app.foxglove.dev", "file://"};
};

void define(CLI::App& program, Options& options) {
  program.add_option("--lcm-url", options.lcm_url, "the LCM network")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str()
      ->type_name("URL");
  program
      .add_option("--listen", options.listen,
                  "where viewers and Prometheus connect; another address than loopback needs --token-file")
      ->capture_default_str()
      ->type_name("ADDRESS:PORT");
  program.add_option("--token-file", options.token_file, "clients must show the token in this file")
      ->envname("STRAINWAVE_TELEMETRY_TOKEN_FILE")
      ->type_name("FILE");
  program
      .add_option(
          "--key", options.key_file,
          "an operator's secret key: the page may enable, jog and hold joints, if it is opened at the "
          "printed address")
      ->type_name("FILE");
  program.add_option("--origin", options.origins, "web pages that may show telemetry without a token")
      ->capture_default_str()
      ->type_name("URL");
}

strainwave::ExitStatus serve(const Options& options) {
  using namespace strainwave;
  const ListenAddress address = parse_listen_address(options.listen);
  AccessRules rules{options.token_file.empty() ? "" : read_token(options.token_file), options.origins};
  if (!is_loopback(address.host) && rules.token.empty())
    throw InputError("--listen: " + address.host +
                     " is open to other machines: give --token-file FILE, or listen on 127.0.0.1");
  if (!is_loopback(address.host) && !options.key_file.empty())
    throw InputError(
        "--key: commands of a page on another machine would not be encrypted: listen on "
        "127.0.0.1, and forward the port (ssh -L 8765:127.0.0.1:8765 HOST)");
  if (const auto defect = find_udpm_defect(options.lcm_url)) throw InputError("--lcm-url: " + *defect);
  wait_for_multicast(
      options.lcm_url,
      [](const std::string& problem) {
        std::cerr << "strainwave-telemetry: waiting for LCM: " << problem << std::endl;
      },
      [] { return true; });
  Telemetry telemetry(options.lcm_url, address, std::move(rules), options.key_file);
  const std::string host =
      address.host.find(':') == std::string::npos ? address.host : "[" + address.host + "]";
  const std::string place = host + ":" + std::to_string(telemetry.port());
  std::cout << "Foxglove: ws://" << place << "\nPrometheus: http://" << place << "/metrics\nPage: http://"
            << place << "/" << std::endl;
  if (!telemetry.token().empty())
    std::cout << "Page that may move joints: http://" << place << "/#token=" << telemetry.token()
              << std::endl;
  telemetry.run();
  return ExitStatus::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program(
      "Shows the messages on LCM as a page, in Foxglove (WebSocket) and in Prometheus (metrics). It sends "
      "nothing on LCM without --key.");
  strainwave::configure_program(
      program,
      {.program = "strainwave-telemetry",
       .section = 8,
       .files = {{"/usr/share/doc/strainwave/docs/telemetry.md",
                  "what to do in Foxglove and Prometheus, with a layout and alerts beside it"}},
       .examples = {{"strainwave-telemetry", "serve this machine: ws://127.0.0.1:8765 and /metrics there"},
                    {"strainwave-telemetry --listen 0.0.0.0:8765 --token-file /etc/strainwave/token",
                     "serve other machines, by token"},
                    {"strainwave-telemetry --key ~/.strainwave-key",
                     "let the page at the printed address move joints"}},
       .see_also = {"strainwaved(8)", "strainwavectl(1)"}});
  Options options;
  define(program, options);
  return strainwave::run_program(program, argc, argv, [&] { return serve(options); });
}
