// SPDX-License-Identifier: BSD-3-Clause
// The SDO server of a simulated CANopen node: expedited and segmented transfers. Block transfers are refused,
// as CiA 301 allows. Source: CiA 301 (4.2.0), 7.2.4.3.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "tests/support/can_nodes/frame.h"
#include "tests/support/can_nodes/object_dictionary.h"

namespace strainwave::can_nodes {

class SdoServer {
 public:
  SdoServer(ObjectDictionary& dictionary, std::uint8_t node_id)
      : dictionary_(dictionary), node_id_(node_id) {}

  /// The answer to a frame with the server's identifier (600h + node), or none if none is needed.
  std::optional<Frame> answer(const Frame& request);

  /// From now on, refuses to read or write the object with this code. kNone ends that.
  void refuse(Key key, Abort abort);
  void reset() { transfer_ = Transfer{}; }

 private:
  enum class Direction { kNone, kDownload, kUpload };
  struct Transfer {
    Direction direction = Direction::kNone;
    Key key;
    std::vector<std::uint8_t> bytes;
    std::size_t announced_size = 0;  ///< of a download; 0: not announced
    std::size_t sent = 0;            ///< of an upload
    bool toggle = false;             ///< required in the next segment
  };

  Frame begin_download(const Frame& request);
  Frame download_segment(const Frame& request);
  Frame begin_upload(const Frame& request);
  Frame upload_segment(const Frame& request);
  Frame store(Key key, std::span<const std::uint8_t> bytes, std::uint8_t specifier);
  Frame abort(Key key, Abort code);
  Frame reply(std::uint8_t specifier, Key key, std::uint32_t data) const;
  Abort refused(Key key) const;

  ObjectDictionary& dictionary_;
  std::uint8_t node_id_;
  std::map<Key, Abort> refused_;
  Transfer transfer_;
};

}  // namespace strainwave::can_nodes
