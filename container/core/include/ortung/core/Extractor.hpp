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

/// An extractor that failed; the message names it and says why.
class ORTUNG_API ExtractorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~ExtractorError() override;
};

/// Makes features of other features of the same robot and of what is known of the field: the third
/// half that a sensor plugin may have, on the robot, under the same name and from the same
/// parameters as the data half whose features it fills. So a real scanner or a log fills them as
/// the simulated one does.
///
/// The container calls it whenever one of its inputs has a new reading. Not thread-safe; calls come
/// from any thread, one at a time.
class ORTUNG_API Extractor {
 public:
  static constexpr const char* kInterface = "ortung.Extractor/" ORTUNG_CONTAINER_ABI;
  using Words = std::vector<std::uint32_t>;

  virtual ~Extractor();

  /// What it reads: "model/type/feature", each may be "*"; the first match is taken that its own
  /// device does not have. Features of its own, which something else fills, have their full names.
  virtual std::vector<std::string> inputs() const = 0;

  /// Copies what it needs of the readings; the container is locked meanwhile.
  /// @param inputs in the order of inputs(); those without a reading yet are null
  virtual void take(std::span<const SensorData* const> inputs) = 0;

  /// Computes from what it took, without a lock.
  /// @param words by feature of its device, in their order; what stays empty-handed (nullopt) gets
  ///   no new reading
  virtual void extract(const FieldModel& field, std::span<std::optional<Words>> words) = 0;
};

}  // namespace ortung
