#pragma once

#include <memory>

#include "ortung/base/Export.hpp"
#include "ortung/core/Weigher.hpp"

namespace ortung {

/// A weigher that a search over the whole field can ask at poses that are far apart: one that also
/// tells how probable its reading is *around* a pose. The hill of a sharp reading lies between the
/// poses of a cover, so at those it would say nothing of where the hill is.
class ORTUNG_API BlurrableWeigher : public Weigher {
 public:
  ~BlurrableWeigher() override;

  /// The same reading for poses that are known to within @p spread alone (standard deviations):
  /// its noise grows by what they would change. It may leave out what says the same once more, as
  /// neighbouring beams do, and is cheaper then; its ln p is on the scale of the whole reading.
  virtual std::shared_ptr<const BlurrableWeigher> blurred(const PoseResolution& spread) const = 0;

  /// About how long it takes for a pose [ns], on the machine of docs/performance.md: a constant of
  /// the reading, so that work shared out by it is the same in every run.
  virtual double nominalNanoseconds() const = 0;
};

}  // namespace ortung
