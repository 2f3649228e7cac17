#pragma once

#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/container/Abi.hpp"

namespace ortung {

/// One option of a source: what `key=value` behind the "?" of its text may be.
struct SourceOption {
  std::string key;
  std::string unit;      ///< "m", "x,y,theta in m and degrees"; "" if there is none
  std::string fallback;  ///< value that holds without the option
  std::string meaning;   ///< what it does, for people
};

/// The help of a kind of source, which is there without opening anything. It is an optional plugin
/// beside the Source, under the same name. Immutable.
class ORTUNG_API SourceHelp {
 public:
  static constexpr const char* kInterface = "ortung.SourceHelp/" ORTUNG_CONTAINER_ABI;
  /// @param path meaning of the text behind "KIND:", e.g. "folder of a run"
  SourceHelp(std::string path, std::vector<SourceOption> options);
  virtual ~SourceHelp();

  const std::string& path() const { return path_; }
  const std::vector<SourceOption>& options() const { return options_; }

 private:
  std::string path_;
  std::vector<SourceOption> options_;
};

}  // namespace ortung
