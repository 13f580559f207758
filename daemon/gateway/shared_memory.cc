// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/shared_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace strainwave {

namespace {

[[noreturn]] void fail(const char* what, int descriptor) {
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  throw std::system_error(error, std::generic_category(), what);
}

void* map(int descriptor, std::size_t size, bool writable) {
  void* address =
      ::mmap(nullptr, size, writable ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, descriptor, 0);
  if (address == MAP_FAILED) fail("mapping shared memory", descriptor);
  return address;
}

}  // namespace

MemoryFile MemoryFile::create(const char* name, std::size_t size, bool seal_writes) {
  const int descriptor = ::memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor < 0) fail("creating shared memory", -1);
  if (::ftruncate(descriptor, static_cast<off_t>(size)) != 0) fail("sizing shared memory", descriptor);
  void* address = map(descriptor, size, true);
  const int seals = F_SEAL_SHRINK | F_SEAL_GROW | (seal_writes ? F_SEAL_FUTURE_WRITE : 0) | F_SEAL_SEAL;
  if (::fcntl(descriptor, F_ADD_SEALS, seals) != 0) {
    ::munmap(address, size);
    fail("sealing shared memory", descriptor);
  }
  return {descriptor, address, size};
}

MemoryFile MemoryFile::open(int descriptor, std::size_t size, bool writable) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail("inspecting shared memory", descriptor);
  if (static_cast<std::size_t>(status.st_size) < size) {
    errno = EINVAL;
    fail("shared memory is smaller than this program expects: core and gateway are of different versions",
         descriptor);
  }
  return {descriptor, map(descriptor, size, writable), size};
}

MemoryFile::MemoryFile(MemoryFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      address_(std::exchange(other.address_, nullptr)),
      size_(other.size_) {}

MemoryFile::~MemoryFile() {
  if (address_ != nullptr) ::munmap(address_, size_);
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace strainwave
