#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>

#include "Files.hpp"

namespace ortung::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized =
    true;  // sanitizers reserve terabytes, and have limits themselves
#else
inline constexpr bool kSanitized = false;
#endif

/// While it lives, this process gets no more than so many bytes of memory more: a request for
/// gigabytes ends in std::bad_alloc, which no reader may throw.
class MemoryLimit {
 public:
  explicit MemoryLimit(rlim_t more) {
    ::getrlimit(RLIMIT_AS, &before_);
    if (kSanitized) return;
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlimit now{pages * 4096 + more, before_.rlim_max};
    ::setrlimit(RLIMIT_AS, &now);
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

inline constexpr rlim_t kPlenty = rlim_t{256} << 20;

/// How copies of a file fared.
struct Fate {
  int taken = 0;
  int refused = 0;
  int all() const { return taken + refused; }
};

/// The stride of a test that would take long: 1 with ORTUNG_LONG_TESTS=1 in the environment.
inline std::size_t everyOrAll(std::size_t every) {
  return std::getenv("ORTUNG_LONG_TESTS") == nullptr ? every : 1;
}

/// Shows @p look every copy of @p whole that differs in one bit (or, of long files, every so manyth
/// of them). Refusals are exceptions of type Error with a text; any other fails the test.
template <class Error, class Look>
Fate flipBits(const std::string& whole, const Look& look, std::size_t every = 1,
              rlim_t memory = kPlenty) {
  Fate fate;
  EXPECT_NO_THROW(look(whole)) << "the file as it is";
  const MemoryLimit limit(memory);
  std::string bytes = whole;
  for (std::size_t bit = 0; bit < 8 * whole.size(); bit += every) {
    char& byte = bytes[bit / 8];
    byte = static_cast<char>(byte ^ (1 << bit % 8));
    try {
      look(bytes);
      ++fate.taken;
    } catch (const Error& error) {
      ++fate.refused;
      EXPECT_STRNE(error.what(), "") << "bit " << bit;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "bit " << bit << ": an exception of another type: " << error.what();
    }
    byte = whole[bit / 8];
    if (::testing::Test::HasFailure()) break;
  }
  std::printf("%d copies: %d taken, %d refused\n", fate.all(), fate.taken, fate.refused);
  return fate;
}

}  // namespace ortung::test
