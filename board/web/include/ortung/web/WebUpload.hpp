#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// What is said to who has sent a file.
struct WebReply {
  unsigned status = 200;  ///< of HTTP
  std::string text;       ///< one line
};

/// A file that a page is sending. Whoever lets it go before it is whole has lost it: what was kept
/// of it is removed by the destructor.
class ORTUNG_API WebUpload {
 public:
  virtual ~WebUpload();
  /// The file's next bytes, on the door's thread. @returns a refusal, after which nothing more is
  ///   told to it; nothing: go on
  virtual std::optional<WebReply> take(std::string_view bytes) = 0;
  /// All bytes were taken. @param answer to be called once, from any thread, now or later; it may
  ///   outlive the door
  virtual void finish(std::function<void(WebReply)> answer) = 0;
};

/// Where pages send files: by POST, with "Authorization: Bearer TOKEN", from the page's own origin.
/// To GET it says how large they may be: "most=BYTES".
struct WebUploads {
  std::string path = "/open";
  std::uint64_t most = std::uint64_t{2} << 30;  ///< size of a file [bytes]
  double patience = 30.0;                       ///< time in which nothing of a file comes [s]
  /// Whether who has this token may send files. Called on the door's thread.
  std::function<bool(std::string_view token)> admits = {};
  /// Begins to take a file; missing: no files are taken. Called on the door's thread.
  /// @param target path and query that were asked for, hostile
  /// @param refusal set where null is returned: why not
  std::function<std::unique_ptr<WebUpload>(std::string_view target, WebReply& refusal)> begin = {};
};

}  // namespace ortung
