// SPDX-License-Identifier: BSD-3-Clause
#include "transport/route_interface.h"

#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>

#include "base/unique_fd.h"

namespace strainwave {

namespace {

struct Question {
  nlmsghdr head;
  rtmsg route;
  rtattr attribute;
  in_addr group;
};
static_assert(sizeof(Question) == NLMSG_LENGTH(sizeof(rtmsg)) + RTA_LENGTH(sizeof(in_addr)));

Question question_of(const in_addr& group) noexcept {
  Question question{};
  question.head.nlmsg_len = sizeof question;
  question.head.nlmsg_type = RTM_GETROUTE;
  question.head.nlmsg_flags = NLM_F_REQUEST;
  question.route.rtm_family = AF_INET;
  question.route.rtm_dst_len = 32;
  question.attribute = {RTA_LENGTH(sizeof group), RTA_DST};
  question.group = group;
  return question;
}

}  // namespace

int route_interface(const in_addr& group) noexcept {
  const UniqueFd netlink(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  const Question question = question_of(group);
  // The kernel's answer is ready when send() returns.
  if (!netlink || ::send(netlink.get(), &question, sizeof question, 0) != sizeof question) return 0;
  std::array<std::uint8_t, 4096> answer{};
  const ssize_t size = ::recv(netlink.get(), answer.data(), answer.size(), MSG_DONTWAIT);
  nlmsghdr head{};
  constexpr std::size_t kHeads = NLMSG_LENGTH(sizeof(rtmsg));
  if (size < static_cast<ssize_t>(kHeads)) return 0;
  std::memcpy(&head, answer.data(), sizeof head);
  if (head.nlmsg_type != RTM_NEWROUTE) return 0;
  for (std::size_t at = kHeads; at + sizeof(rtattr) <= static_cast<std::size_t>(size);) {
    rtattr attribute{};
    std::memcpy(&attribute, answer.data() + at, sizeof attribute);
    int index = 0;
    if (attribute.rta_len < sizeof attribute) return 0;
    if (attribute.rta_type == RTA_OIF && at + RTA_LENGTH(sizeof index) <= static_cast<std::size_t>(size)) {
      std::memcpy(&index, answer.data() + at + sizeof attribute, sizeof index);
      return index;
    }
    at += RTA_ALIGN(attribute.rta_len);
  }
  return 0;
}

}  // namespace strainwave
