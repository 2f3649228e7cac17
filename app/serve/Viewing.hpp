#pragma once

#include <string>

#include "ServingArguments.hpp"
#include "ortung/server/MessageBoard.hpp"
#include "ortung/web/WebDoor.hpp"

namespace ortung::app {

/// Where the files of the built page are: where the program was installed or built, unless
/// $ORTUNG_VIEW_PATH says where; "" if they are nowhere.
std::filesystem::path pageFolder();

/// The viewer's page at the port of a message board, for those who were given its address.
class Viewing {
 public:
  /// Where the page listens if nothing else is asked for, so that browsers know its settings again.
  static constexpr const char* kPort = "7777";

  /// Lets the page in and gives its own client, `view`, the right to control; @p config must know
  /// its address already. Where the board has no tokens, others come in without one as before.
  /// @throws std::runtime_error if the page's files can't be read
  Viewing(const ServingArguments& arguments, BoardConfig& config);

  /// Says on stdout where the page is, and shows it in a browser if there is a desktop.
  void open(const MessageBoard& board);

 private:
  ServingArguments arguments_;
  std::string address_;
  std::string token_;
  WebDoor door_;
};

}  // namespace ortung::app
