#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

/// What sim and serve have in common when they serve clients.
struct ServingArguments {
  std::optional<std::string> listen;  ///< "[ADDRESS:]PORT"
  std::vector<std::string> control;   ///< names of clients that may control, "*": all
  std::filesystem::path tokens;       ///< file with a line "NAME TOKEN" for each; "" for none
  double idle = 30.0;                 ///< [s] without a line from a client
  unsigned clients = 256;             ///< at a time
  unsigned clientsOfAddress = 128;    ///< of them from one computer
  double speed = 1.0;                 ///< times real time
  bool freeRun = false;
  bool lockstep = false;
  bool isViewing = false;            ///< with the page for browsers
  bool opensBrowser = true;          ///< and shows it, where there is a desktop
  std::vector<std::string> hosts;    ///< further names of this computer
  std::filesystem::path recordInto;  ///< folder for records that clients begin; "": none
  bool isServing() const { return isViewing || listen; }
};

}  // namespace ortung::app
