#pragma once

#include <memory>
#include <string>

#include "ServingArguments.hpp"
#include "ortung/server/MessageBoard.hpp"
#include "ortung/web/WebDoor.hpp"

namespace ortung::app {

/// Returns the folder of the built page: $ORTUNG_VIEW_PATH, or where the program was installed or
/// built; "" if there is none.
std::filesystem::path pageFolder();

/// What a message board's port speaks besides the board's own protocol: that one over WebSockets
/// and Foxglove's; if somebody wants to view, the viewer's page, too, for users who have its
/// address.
class Viewing {
 public:
  /// Default port of the page, always the same so that browsers find their settings again.
  static constexpr const char* kPort = "7777";

  /// Admits WebSockets. With a page, gives its own client, `view`, the right to control; @p config
  /// must have its address. If the board has no tokens, other clients are still admitted without
  /// one.
  /// @throws std::runtime_error if the page's files can't be read
  /// @param uploads files that the page's own client, and others that may control, may send
  Viewing(const ServingArguments& arguments, BoardConfig& config, const WebUploads& uploads);

  /// Prints the page's address on stdout, and shows it in a browser if there is a desktop.
  void open(const MessageBoard& board);

 private:
  void admitPage(BoardConfig& config);

  ServingArguments arguments_;
  std::string address_;
  std::string token_;
  std::unique_ptr<WebDoor> door_;
};

}  // namespace ortung::app
