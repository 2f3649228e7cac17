#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/container/Abi.hpp"
#include "ortung/core/Format.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorContainer.hpp"

namespace ortung {

/// Formats of features, in the order in which they were told.
using FeatureFormats = std::vector<std::pair<SensorId, Format>>;

/// Anything that fills a container: simulator, record, foreign log, network, devices.
/// It gives readings in the order of their time stamps. Not thread-safe.
///
/// A source is a plugin; its Parameters are "path" (text; what stands behind "KIND:" up to "?"),
/// "robot_file" (text; may be empty) and the options of the source's text.
class ORTUNG_API Source {
 public:
  static constexpr const char* kInterface = "ortung.Source/" ORTUNG_CONTAINER_ABI;
  virtual ~Source();

  /// Reads the next reading; returns false at the end.
  /// @throws std::runtime_error naming file, place, what was found and expected
  virtual bool next(Message& message) = 0;

  /// Returns the share of the whole that was read, in [0, 1], or -1 if there is no end.
  virtual double progress() const { return -1.0; }

  /// Returns whether its readings are of now and can't be read again: a record of them is written
  /// as they arrive, and a signal ends them like any other end.
  virtual bool isLive() const { return false; }

  /// Returns a sentence that the user should see at the end; "": nothing to say.
  virtual std::string remark() const { return ""; }

  /// Returns the fingerprint of the world the readings come from, or "" if it is not known.
  virtual std::string worldFingerprint() const { return ""; }

  /// Returns the formats that features had when the readings were made, as far as the source knows.
  virtual FeatureFormats formats() const { return {}; }

  /// Returns the robot file (TOML text) that fits the readings, or "" if the source can't know it.
  virtual std::string robotToml() const { return ""; }

  /// Writes the world file that goes with the readings, and the files it names beside it.
  /// @throws std::runtime_error if the source knows no world
  virtual void writeWorld(const std::filesystem::path& file) const;
};

/// The parts of "KIND:PATH?key=value&key=value", e.g. "mrclam:data/ds6?robot=3".
struct SourceText {
  std::string kind;
  std::string path;
  std::map<std::string, std::string> options;
};

/// Splits such a text. @throws std::invalid_argument saying what is wrong with it
ORTUNG_API SourceText parseSourceText(const std::string& text);

/// Groups the messages of a source by time stamp. Not thread-safe.
class ORTUNG_API FrameReader {
 public:
  explicit FrameReader(Source& source) : source_(source) {}

  /// Reads all messages of the next moment, in the source's order; returns false at the end.
  /// @throws std::runtime_error if time runs backwards, or is farther than 2^60 us from 0, so that
  ///   players may add and subtract times
  bool next(std::vector<Message>& frame);

 private:
  Source& source_;
  std::optional<Message> ahead_;
};

}  // namespace ortung
