// One daemon per prefix, and one per drive: a name in the kernel that vanishes with its process. Not real-time.
#pragma once

#include <string>

namespace strainwave {

class InstanceLock {
 public:
  /// Holds `name` within this network namespace. Throws InputError with `remedy` when another process holds it.
  InstanceLock(const std::string& name, const std::string& remedy);
  InstanceLock(InstanceLock&& other) noexcept;
  InstanceLock& operator=(InstanceLock&&) = delete;
  InstanceLock(const InstanceLock&) = delete;
  InstanceLock& operator=(const InstanceLock&) = delete;
  ~InstanceLock();

 private:
  int socket_;
};

}  // namespace strainwave
