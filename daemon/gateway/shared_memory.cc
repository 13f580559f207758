// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/shared_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace strainwave {

namespace {

[[noreturn]] void fail(const char* what, int error = errno) {
  throw std::system_error(error, std::generic_category(), what);
}

void* map(int descriptor, std::size_t size, bool writable) {
  void* address =
      ::mmap(nullptr, size, writable ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, descriptor, 0);
  if (address == MAP_FAILED) fail("mapping shared memory");
  return address;
}

}  // namespace

MemoryFile MemoryFile::create(const char* name, std::size_t size, bool seal_writes) {
  UniqueFd descriptor(::memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!descriptor) fail("creating shared memory");
  if (::ftruncate(descriptor.get(), static_cast<off_t>(size)) != 0) fail("sizing shared memory");
  void* const address = map(descriptor.get(), size, true);
  MemoryFile memory(std::move(descriptor), address, size);
  const int seals = F_SEAL_SHRINK | F_SEAL_GROW | (seal_writes ? F_SEAL_FUTURE_WRITE : 0) | F_SEAL_SEAL;
  if (::fcntl(memory.descriptor(), F_ADD_SEALS, seals) != 0) fail("sealing shared memory");
  return memory;
}

MemoryFile MemoryFile::open(int descriptor, std::size_t size, bool writable) {
  UniqueFd file(descriptor);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail("inspecting shared memory");
  if (static_cast<std::size_t>(status.st_size) < size)
    fail("shared memory is smaller than this program expects: core and gateway are of different versions",
         EINVAL);
  void* const address = map(descriptor, size, writable);
  return {std::move(file), address, size};
}

MemoryFile::MemoryFile(MemoryFile&& other) noexcept
    : descriptor_(std::move(other.descriptor_)),
      address_(std::exchange(other.address_, nullptr)),
      size_(other.size_) {}

MemoryFile::~MemoryFile() {
  if (address_ != nullptr) ::munmap(address_, size_);
}

}  // namespace strainwave
