#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace ortung::web {

/// The files of the built page, in memory: what is not in the folder when the program starts can't
/// be asked for, whatever a request's path is.
class Page {
 public:
  struct File {
    std::string type;                          ///< MIME type
    std::shared_ptr<const std::string> bytes;  ///< never null
  };

  /// @param folder read with its folders; without index.html a note stands in its place
  /// @throws std::runtime_error if it can't be read, or has more than @p most bytes
  Page(const std::filesystem::path& folder, std::size_t most);

  bool isThere() const { return isThere_; }
  /// @param target of a request: a path, and maybe a query behind it; null if there is none
  const File* find(std::string_view target) const;

 private:
  std::map<std::string, File, std::less<>> files_;  ///< files by "/name"
  bool isThere_ = false;
};

}  // namespace ortung::web
