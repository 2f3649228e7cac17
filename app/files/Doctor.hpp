#pragma once

namespace ortung::app {

/// Arguments of `ortung doctor`.
struct DoctorArguments {
  unsigned port = 7777;   ///< port at which servers are to listen
  double timeout = 10.0;  ///< greatest time to load a plugin [s]
};
/// @return 1 if something does not work, else 0
int runDoctor(const DoctorArguments& arguments);

}  // namespace ortung::app
