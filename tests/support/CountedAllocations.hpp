#pragma once

#include <atomic>
#include <cstddef>

// Counts what a test program asks of the memory, in all its libraries: for one source of a program.
namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);  // NOLINT: as the library calls it
void* malloc(std::size_t size) {        // NOLINT(misc-definitions-in-headers): in one source alone
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
}
