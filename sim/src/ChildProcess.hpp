#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ortung {

struct ChildResult {
  std::string output;   ///< what it wrote to its standard output
  std::string errors;   ///< and to its standard error, the first 4 KiB
  std::string failure;  ///< empty, or why it did not end well: "ended with status 1"
};

/// Runs a program without a shell and with nothing on its standard input, and waits for it.
/// It is killed when it writes more than @p maxOutput or takes longer than @p limit.
ChildResult runChild(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, std::size_t maxOutput,
                     std::chrono::milliseconds limit);

}  // namespace ortung
