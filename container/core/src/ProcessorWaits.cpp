#include "ProcessorWaits.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace ortung {
namespace {

/// The time that a thread has waited so far [ns]; nothing if it is gone or the system does not say.
std::optional<std::uint64_t> waited(const std::filesystem::path& thread) {
  std::FILE* const file = std::fopen((thread / "schedstat").c_str(), "re");
  if (file == nullptr) return std::nullopt;
  std::uint64_t ran = 0;
  std::uint64_t wait = 0;
  const int read = std::fscanf(file, "%" SCNu64 " %" SCNu64, &ran, &wait);
  std::fclose(file);
  return read == 2 ? std::optional(wait) : std::nullopt;
}

}  // namespace

double ProcessorWaits::sinceLast() {
  std::map<int, std::uint64_t> now;
  std::uint64_t longest = 0;
  const int own = ::getpriority(PRIO_PROCESS, 0);  // of the thread that asks
  std::error_code error;
  std::filesystem::directory_iterator threads("/proc/self/task", error);
  for (; !error && threads != std::filesystem::directory_iterator(); threads.increment(error)) {
    const std::string name = threads->path().filename().string();
    int thread = 0;
    std::from_chars(name.data(), name.data() + name.size(), thread);
    if (::getpriority(PRIO_PROCESS, static_cast<id_t>(thread)) > own) continue;
    const std::optional<std::uint64_t> wait = waited(threads->path());
    if (!wait) continue;
    now[thread] = *wait;
    const auto before = last_.find(thread);
    if (before != last_.end() && *wait > before->second)
      longest = std::max(longest, *wait - before->second);
  }
  last_ = std::move(now);
  return 1e-9 * static_cast<double>(longest);
}

}  // namespace ortung
