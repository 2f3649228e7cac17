#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/container/Abi.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// Thrown when an extractor failed; the message names it and says why.
class ORTUNG_API ExtractorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~ExtractorError() override;
};

/// Makes features of other features of the same robot and of what is known of the field. It is the
/// third part that a sensor plugin may have; it runs on the robot, under the same name and with the
/// same parameters as the data half whose features it fills. So these features are there with a
/// real scanner or a log as with the simulated one.
///
/// The container calls it whenever one of its inputs has a new reading. Not thread-safe; calls come
/// from any thread, one at a time.
class ORTUNG_API Extractor {
 public:
  static constexpr const char* kInterface = "ortung.Extractor/" ORTUNG_CONTAINER_ABI;
  using Words = std::vector<std::uint32_t>;

  virtual ~Extractor();

  /// Returns what it reads: "model/type/feature", where each part may be "*"; the first match is
  /// taken that is not of its own device. Features of its own device, which something else fills,
  /// are given by their full names.
  virtual std::vector<std::string> inputs() const = 0;

  /// Copies what it needs of the readings; the container is locked meanwhile.
  /// @param inputs in the order of inputs(); those without a reading yet are null
  virtual void take(std::span<const SensorData* const> inputs) = 0;

  /// Computes from what it took, without a lock.
  /// @param words new words by feature of its device, in their order; a feature whose entry stays
  ///   nullopt gets no new reading
  virtual void extract(const FieldModel& field, std::span<std::optional<Words>> words) = 0;
};

}  // namespace ortung
