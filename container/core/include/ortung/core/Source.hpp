#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/container/Abi.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorContainer.hpp"

namespace ortung {

/// Whatever fills a container: simulator, record, foreign log, network, devices.
/// It gives readings in the order of their time stamps. Not thread-safe.
///
/// A source is a plugin; its Parameters are "path" (text; what stands behind "KIND:" up to "?"),
/// "robot_file" (text; may be empty) and the options of the source's text.
class ORTUNG_API Source {
 public:
  static constexpr const char* kInterface = "ortung.Source/" ORTUNG_CONTAINER_ABI;
  virtual ~Source();

  /// The next reading, or false at the end.
  /// @throws std::runtime_error naming file, place, what was found and expected
  virtual bool next(Message& message) = 0;

  /// Share of the whole that has been read, in [0, 1], or -1 if there is no end.
  virtual double progress() const { return -1.0; }

  /// Whether its readings are of now, so that they can't be had again: whoever keeps them keeps
  /// them as they come, and a signal ends them like any end.
  virtual bool isLive() const { return false; }

  /// What whoever reads to the end should be told, in a sentence; "": nothing.
  virtual std::string remark() const { return ""; }

  /// Fingerprint of the world the readings come from, or "" if it is not known.
  virtual std::string worldFingerprint() const { return ""; }

  /// Robot file (TOML text) that fits the readings, or "" if the source can't know it.
  virtual std::string robotToml() const { return ""; }

  /// Writes the world file that goes with the readings, and the files it names beside it.
  /// @throws std::runtime_error if the source knows no world
  virtual void writeWorld(const std::filesystem::path& file) const;
};

/// "KIND:PATH?key=value&key=value", e.g. "mrclam:data/ds6?robot=3".
struct SourceText {
  std::string kind;
  std::string path;
  std::map<std::string, std::string> options;
};

/// @throws std::invalid_argument saying what is wrong with the text
ORTUNG_API SourceText parseSourceText(const std::string& text);

/// Groups the messages of a source by time stamp. Not thread-safe.
class ORTUNG_API FrameReader {
 public:
  explicit FrameReader(Source& source) : source_(source) {}

  /// All messages of the next moment, in the source's order; false at the end.
  /// @throws std::runtime_error if time runs backwards, or is farther than 2^60 us from 0: whoever
  ///   plays readings may add and subtract times
  bool next(std::vector<Message>& frame);

 private:
  Source& source_;
  std::optional<Message> ahead_;
};

}  // namespace ortung
