#pragma once

#include <memory>

#include "ortung/base/Export.hpp"
#include "ortung/core/Weigher.hpp"

namespace ortung {

/// A weigher that a search over the whole field can evaluate at poses that are far apart, since it
/// also knows how probable its reading is *around* a pose. The peak of a sharp reading lies between
/// the poses of a cover, where the sharp reading itself would not show it.
class ORTUNG_API BlurrableWeigher : public Weigher {
 public:
  ~BlurrableWeigher() override;

  /// Returns a weigher of the same reading for poses that are known only to within @p spread
  /// (standard deviations): its noise grows accordingly. It may leave out redundant values, such as
  /// neighbouring beams, to be cheaper; its ln p stays on the scale of the whole reading.
  virtual std::shared_ptr<const BlurrableWeigher> blurred(const PoseResolution& spread) const = 0;

  /// Returns about how long weighing takes per pose [ns], on the machine of docs/performance.md: a
  /// constant of the reading, so that work shared out by it is the same in every run.
  virtual double nominalNanoseconds() const = 0;
};

}  // namespace ortung
