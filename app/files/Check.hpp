#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung check`.
struct CheckArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path world;  ///< world of the tables; "": not checked
  std::filesystem::path robot;  ///< robot of the tables; "": not checked
  std::string schema;           ///< kind of file whose schema is printed; "": none
  bool wire = false;            ///< whether to show what words the readings of a robot have
  bool mend = false;            ///< whether to cut off an incomplete end of a record
};
int runCheck(const CheckArguments& arguments);

}  // namespace ortung::app
