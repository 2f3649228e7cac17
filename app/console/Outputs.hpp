#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ortung/base/NewFile.hpp"

namespace ortung::app {

/// Kinds of files that commands write. A file is replaced by another kind only with --force.
enum class OutputKind : std::uint8_t {
  kRecord,
  kTables,
  kPart,        ///< part of a job, for `ortung merge`
  kFigures,     ///< JSON of eval
  kComparison,  ///< JSON of compare
  kReport,      ///< HTML of eval
  kPicture,     ///< PNG
  kPoses,       ///< text of localize
  kPosesJson,   ///< JSON of localize --format json
  kPosesTum,    ///< text of localize --format tum
  kBelief,      ///< belief of localize; the run that replaces it may have read it
  kTrace,       ///< CSV of sim
  kMotion,      ///< TOML of learn-motion
  kNetwork,     ///< JSON of train-motion
  kBenchmark,   ///< JSON of benchmark
  kFootball,    ///< JSON of benchmark football
  kPage,        ///< HTML of benchmark
  kRawlog,      ///< rawlogs and grid maps of MRPT
  kMcap,        ///< messages of ROS 2
  kSweepCsv,    ///< CSV of sweep
  kSweepJson,   ///< JSON of sweep
  kSweepPage,   ///< HTML of sweep
  kSettings,    ///< worlds, their maps, and robots: users edit them, so they need --force, too
};

/// The files that one run of a command reads and writes. It checks that no output replaces an input
/// or a file of another kind. Not thread-safe.
class Outputs {
 public:
  /// @param force whether to replace files of any kind; files that the run reads are never replaced
  explicit Outputs(bool force) : force_(force) {}

  /// Declares a file that the run reads; "" and files that do not exist are ignored.
  void reads(const std::filesystem::path& file);
  /// Declares the files of a source, "KIND:PATH?key=value".
  void readsSource(const std::string& text);

  /// Declares a file that the run will write, and checks that it can and may, before any work
  /// begins. "" is ignored.
  /// @param option name of the option for messages
  /// @throws UsageError if another option reads or writes the same file
  /// @throws std::runtime_error naming the file if it can't be written, or exists and is of another
  ///   kind
  void writes(const std::string& option, const std::filesystem::path& file, OutputKind kind);

  /// Returns @p file, which is about to be written. @throws UsageError if the run has read it
  const std::filesystem::path& ready(const std::filesystem::path& file) const;
  /// Writes a whole file at once. "" is ignored. @throws std::runtime_error
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
