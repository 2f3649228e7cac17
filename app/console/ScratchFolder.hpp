#pragma once

#include <filesystem>

namespace ortung::app {

/// A temporary folder, removed with everything in it.
class ScratchFolder {
 public:
  ScratchFolder();  ///< @throws std::runtime_error
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ortung::app
