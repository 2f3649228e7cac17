#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments that commands that serve clients have in common.
struct ServingArguments {
  std::optional<std::string> listen;  ///< address to serve at, "[ADDRESS:]PORT"
  std::vector<std::string> control;   ///< names of clients that may control, "*": all
  std::filesystem::path tokens;       ///< file with a line "NAME TOKEN" for each; "": none
  double idle = 30.0;                 ///< silence after which a client is disconnected [s]
  unsigned clients = 256;             ///< greatest number of clients at a time
  unsigned clientsOfAddress = 128;    ///< greatest number of clients from one computer
  double mapShare = 0.25;             ///< share of a processor for clients' maps, in (0, 1]
  double speed = 1.0;                 ///< world time / real time
  bool freeRun = false;
  bool lockstep = false;
  bool isViewing = false;            ///< whether to serve the page for browsers
  bool opensBrowser = true;          ///< whether to show that page, if there is a desktop
  std::string pageKeys;              ///< keys of the page's address, "demo=1"; "": none
  std::vector<std::string> hosts;    ///< further names of this computer
  std::filesystem::path recordInto;  ///< folder for records that clients begin; "": none
  /// Whether to serve clients at all.
  bool isServing() const { return isViewing || listen; }
};

}  // namespace ortung::app
