#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ortung/base/NewFile.hpp"

namespace ortung::app {

/// What commands write. A file of the same kind may be replaced, any other only by --force.
enum class OutputKind : std::uint8_t {
  kRecord,
  kTables,
  kFigures,     ///< JSON of eval
  kComparison,  ///< JSON of compare
  kReport,      ///< HTML of eval
  kPicture,     ///< PNG
  kPoses,       ///< of localize
  kPosesJson,   ///< of localize --format json
  kPosesTum,    ///< of localize --format tum
  kBelief,      ///< of localize; the run that replaces it may have read it
  kTrace,       ///< CSV of sim
  kMotion,      ///< TOML of learn-motion
  kNetwork,     ///< JSON of train-motion
  kBenchmark,   ///< JSON of benchmark
  kPage,        ///< HTML of benchmark
  kRawlog,      ///< of MRPT, like its grid maps
  kMcap,        ///< messages of ROS 2
  kSettings,  ///< worlds, their maps, and robots: people work on them, so none is replaced unasked
};

/// The files that one run of a command reads and writes. All go through here, so that none replaces
/// what it should not. Not thread-safe.
class Outputs {
 public:
  /// @param force replace files of any kind; what the run reads is never replaced
  explicit Outputs(bool force) : force_(force) {}

  /// Says what the run reads; "" is passed over, and so is what does not exist.
  void reads(const std::filesystem::path& file);
  /// The same of "KIND:PATH?key=value".
  void readsSource(const std::string& text);

  /// Says that the run will write @p file, and looks whether it can and may, before any work
  /// begins. "" is passed over.
  /// @param option what messages call it
  /// @throws UsageError if the run reads or writes that very file otherwise
  /// @throws std::runtime_error naming the file if it can't be written, or exists and is of another
  ///   kind
  void writes(const std::string& option, const std::filesystem::path& file, OutputKind kind);

  /// @p file, now that it is about to be written. @throws UsageError if the run has read it
  const std::filesystem::path& ready(const std::filesystem::path& file) const;
  /// A whole file at once. "" is passed over. @throws std::runtime_error
  void write(const std::filesystem::path& file, std::string_view text) const;
  void write(const std::filesystem::path& file, std::span<const std::byte> bytes) const;

 private:
  void refuseInput(const std::string& option, const std::filesystem::path& file) const;
  void refuseTwice(const std::string& option, const std::filesystem::path& file) const;

  struct Output {
    std::string option;
    std::filesystem::path file;
  };
  bool force_;
  std::vector<std::filesystem::path> inputs_;
  std::vector<Output> outputs_;
};

}  // namespace ortung::app
