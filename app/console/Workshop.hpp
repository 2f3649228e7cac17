#pragma once

#include <filesystem>
#include <vector>

#include "Outputs.hpp"
#include "ScratchFolder.hpp"

namespace ortung::app {

/// A temporary folder in which a file, and the files beside it that it names, are made before all
/// of them are moved into place. Not thread-safe.
class Workshop {
 public:
  /// @param option name of the target's option, for messages
  /// @throws std::runtime_error
  Workshop(const char* option, std::filesystem::path target);

  const std::filesystem::path& folder() const { return folder_.path(); }
  /// Returns the target's path within the folder.
  std::filesystem::path file() const { return folder() / target_.filename(); }

  /// Declares the files that were made beside the target, which is declared already.
  void declare(Outputs& outputs) const;
  /// Moves all files into place, the target last, since it names the others.
  void deliver(const Outputs& outputs) const;

 private:
  std::vector<std::filesystem::path> files() const;
  std::filesystem::path placeOf(const std::filesystem::path& made) const;

  const char* option_;
  std::filesystem::path target_;
  ScratchFolder folder_;
};

}  // namespace ortung::app
