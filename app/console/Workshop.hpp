#pragma once

#include <filesystem>
#include <vector>

#include "Outputs.hpp"
#include "ScratchFolder.hpp"

namespace ortung::app {

/// A temporary folder in which a file, and what it names beside it, is made before all of it is put
/// in place. Not thread-safe.
class Workshop {
 public:
  /// @param option what messages call the target. @throws std::runtime_error
  Workshop(const char* option, std::filesystem::path target);

  const std::filesystem::path& folder() const { return folder_.path(); }
  /// The target's place within the folder.
  std::filesystem::path file() const { return folder() / target_.filename(); }

  /// Declares what was made beside the target, which is declared already.
  void declare(Outputs& outputs) const;
  /// Puts all files into place, the target last: it names the others.
  void deliver(const Outputs& outputs) const;

 private:
  std::vector<std::filesystem::path> files() const;
  std::filesystem::path placeOf(const std::filesystem::path& made) const;

  const char* option_;
  std::filesystem::path target_;
  ScratchFolder folder_;
};

}  // namespace ortung::app
