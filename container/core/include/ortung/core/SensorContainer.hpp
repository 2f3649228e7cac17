#pragma once

#include <memory>
#include <optional>
#include <shared_mutex>
#include <span>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Extractor.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/ReadingAs.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// A query for features; an empty name (or "*") matches everything (paper, section 3).
struct SensorQuery {
  std::string_view model = {};
  std::string_view type = {};
  std::string_view feature = {};
};

/// Reads "LMS200/LRF/*"; the query borrows from @p text. @throws std::invalid_argument
ORTUNG_API SensorQuery parseSensorQuery(std::string_view text);

/// Returns whether an id matches the query in all three parts.
ORTUNG_API bool matches(const SensorQuery& query, const SensorId& id);

class Extraction;

/// Owns the sensor data of one robot.
/// Many threads may write and read: writers go through set(), readers of readings hold a ReadLock,
/// so that they see one consistent frame. The list of features itself must not change while others
/// use it.
class ORTUNG_API SensorContainer {
 public:
  using ReadLock = std::shared_lock<std::shared_mutex>;

  SensorContainer();
  ~SensorContainer();
  SensorContainer(const SensorContainer&) = delete;
  SensorContainer& operator=(const SensorContainer&) = delete;

  /// Takes ownership. @throws std::invalid_argument if the id is already present.
  SensorData& add(std::unique_ptr<SensorData> data);

  /// Adds an extractor that makes the readings of @p outputs from other features. Where readings of
  /// all outputs arrive together with those of the inputs, at the same time, these are kept.
  /// @param name what errors call it
  void add(std::string name, std::unique_ptr<Extractor> extractor,
           std::vector<SensorData*> outputs);
  /// Connects extractors to their inputs, once all features and extractors were added.
  /// @throws std::invalid_argument for an extractor whose input is not there, and for circles, with
  ///   the names of all that are in them
  void connect();
  /// Returns the features from which a feature is made directly; none if no extractor makes it.
  std::vector<const SensorData*> inputsOf(const SensorData& made) const;
  /// Sets what is known of the field; extractors use it from then on.
  void setField(std::shared_ptr<const FieldModel> field);
  /// Makes features from others that have new readings; callers that write without set() call it.
  /// @throws ExtractorError
  void extract();

  /// Returns the first match in the order of insertion, or nullptr.
  SensorData* find(const SensorQuery& query) const;
  /// Returns all matches in the order of insertion.
  std::vector<SensorData*> findAll(const SensorQuery& query) const;
  /// Returns the feature with this id, or nullptr.
  SensorData* findExactly(const SensorId& id) const;
  std::span<const std::unique_ptr<SensorData>> all() const { return data_; }

  /// Sets one feature's reading, and makes the features that depend on it. Returns false if the
  /// container has no such feature.
  /// @throws std::invalid_argument for words that the feature refuses; ExtractorError
  bool set(const Message& message);
  /// Sets all readings of one moment under one lock, or none of them if a feature refuses its
  /// words; then makes the features that depend on them, without the lock. Returns how many
  /// readings are of features that the container lacks.
  /// @throws std::invalid_argument for words that a feature refuses; ExtractorError
  std::size_t set(std::span<const Message> frame);

  /// Returns a shared lock over all readings.
  ReadLock read() const;

  /// Returns the newest reading of the first match as T::Reading, copied under the lock, or
  /// nothing. T is the class of a format, e.g. container.get<ScanData>({.type = "LRF"}); features
  /// of that format have it, whatever their own classes are.
  template <class T>
  std::optional<typename T::Reading> get(const SensorQuery& query) const {
    const ReadLock lock = read();
    const SensorData* data = find(query);
    return data == nullptr ? std::nullopt : readingAs<T>(*data);
  }

  /// Adds ln p(s|l_i) over all features that can weigh (paper, section 5.2: independent features).
  /// A feature without an expectation at a pose adds its outlier floor, its least value; so a pose
  /// without expectations never beats one with bad ones.
  void getProbability(const SampleView& poses, std::span<float> logProbability) const;
  /// The same product for one pose, by the same rule, to the precision of float; 1 for a perfect
  /// match. kNoExpectation only if no feature can weigh, wherever the robot is. (Features by
  /// themselves answer kNoExpectation wherever they expect nothing: SensorData::getProbability.)
  double getProbability(const Pose2& pose) const;

 private:
  std::size_t take(std::span<const Message> frame, bool& isRead);

  std::vector<std::unique_ptr<SensorData>> data_;
  /// Features of the frame that is being set; a member to reuse its memory.
  std::vector<SensorData*> targets_;
  std::unique_ptr<Extraction> extraction_;
  mutable std::shared_mutex mutex_;
};

}  // namespace ortung
