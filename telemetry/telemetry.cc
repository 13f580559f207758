// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/telemetry.h"

#include <type_traits>

#include "base/utime.h"
#include "client/protocol/lcm_sender.h"
#include "lcmtypes/message_json.h"
#include "lcmtypes/message_kinds.h"
#include "telemetry/compression.h"
#include "telemetry/steady_time.h"

namespace strainwave {

namespace {

// A page of 512 joints takes some milliseconds to make. Requests within this time get the same page.
constexpr double kPageIsNew_s = 0.1;

}  // namespace

Telemetry::Telemetry(const std::string& lcm_url, const ListenAddress& address, AccessRules rules,
                     const std::filesystem::path& key_file)
    : listener_(lcm_url),
      acting_(key_file.empty() ? nullptr
                               : std::make_unique<Acting>(key_file, fleet_, lcm_sender(lcm_url),
                                                          [this](std::uint64_t viewer, std::string text) {
                                                            server_.say(viewer, std::move(text));
                                                          })),
      server_(
          address, std::move(rules), topics_, [this](bool packed) { return metrics(packed); },
          acting_.get()) {}

void Telemetry::run() {
  const auto receive = [this] {
    listener_.receive([this](const LcmSource& from, std::string_view channel,
                             std::span<const std::uint8_t> bytes) { take(from, channel, bytes); });
  };
  server_.run(listener_.descriptor(), receive, [this] { fleet_.forget_silent(steady_now_s()); });
}

void Telemetry::take(const LcmSource& from, std::string_view channel, std::span<const std::uint8_t> bytes) {
  const auto name = parse_channel(channel);
  const bool ours = name && visit_message(name->kind, bytes, [&]<typename Message>(const Message& message) {
                      if constexpr (std::is_same_v<Message, ack_v1>)
                        if (acting_) acting_->take(*name, message);
                      fleet_.take(*name, message, steady_now_s(), from);
                      const Topic* topic = topic_of<Message>(std::string(channel), from);
                      if (topic != nullptr && server_.is_wanted(topic->id))
                        server_.publish(topic->id, utime_now(), message_json(message));
                    });
  ++(ours ? heard_ : not_ours_);
}

template <typename Message>
const Topic* Telemetry::topic_of(const std::string& channel, const LcmSource& from) {
  if (const Topic* known = topics_.find(channel, steady_now_s())) return known;
  const Topic* topic =
      topics_.add(channel, schema_name<Message>(), message_schema<Message>(), steady_now_s(), from);
  if (topic == nullptr) return nullptr;
  if (topics_.given_up()) server_.remove_topic(*topics_.given_up());
  server_.add_topic(topic->id);
  return topic;
}

SharedText Telemetry::metrics(bool packed) {
  if (!page_ || steady_now_s() - page_made_s_ > kPageIsNew_s) {
    page_ = shared_text(expose());
    packed_page_.reset();
    page_made_s_ = steady_now_s();
  }
  if (packed && !packed_page_) packed_page_ = shared_text(gzip(*page_));
  return packed ? packed_page_ : page_;
}

std::string Telemetry::expose() {
  Exposition page;
  expose_joints(page, fleet_.joints(), steady_now_s());
  expose_daemons(page, fleet_.daemons());
  const ServerCounts counts = server_.counts();
  const auto count = [](std::uint64_t number) { return static_cast<double>(number); };
  page.family("strainwave_telemetry_messages_total", MetricType::kCounter,
              "Messages received on LCM, by whether they belong to Strainwave.");
  page.sample({{"kind", "strainwave"}}, count(heard_));
  page.sample({{"kind", "other"}}, count(not_ours_));
  page.family("strainwave_telemetry_datagrams_malformed_total", MetricType::kCounter,
              "Datagrams that are not LCM's, or too long.");
  page.sample({}, count(listener_.counts().malformed + listener_.counts().too_long));
  page.family("strainwave_telemetry_viewers", MetricType::kGauge, "Viewers connected.");
  page.sample({}, count(counts.viewers));
  page.family("strainwave_telemetry_dropped_messages_total", MetricType::kCounter,
              "Messages not sent, since their viewers were too slow.");
  page.sample({}, count(counts.dropped_messages));
  page.family("strainwave_telemetry_requests_refused_total", MetricType::kCounter,
              "Requests without a token, from foreign pages, malformed, or too many.");
  page.sample({}, count(counts.refused));
  return std::move(page).text();
}

}  // namespace strainwave
