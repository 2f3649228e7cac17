#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/Source.hpp"

namespace ortung {

/// All readings of a source in memory, from which runs are made. It is immutable, so any number of
/// threads may use it.
class ORTUNG_API Recording {
 public:
  struct Truth {
    Timestamp stamp = 0;      ///< time of the pose [us]
    Pose2 pose;               ///< true pose, field frame
    double travelled = 0.0;   ///< distance travelled since the first truth [m]
    std::size_t message = 0;  ///< index of the first message with this stamp
  };
  static constexpr std::size_t kMostBytes = std::size_t{4}
                                            << 30;  ///< greatest size of all readings [bytes]

  /// Reads @p source to its end. @param name name of the recording in error messages
  /// @throws std::invalid_argument for a live source, and for one without an end
  /// @throws std::runtime_error if it is larger than kMostBytes, or if the source throws it
  Recording(std::string name, Source& source);
  ~Recording();

  const std::string& name() const { return name_; }
  const std::string& worldFingerprint() const { return worldFingerprint_; }
  const std::vector<Message>& messages() const { return messages_; }
  /// Returns the ground truth of the first feature that has it, one per stamp.
  const std::vector<Truth>& truth() const { return truth_; }

 private:
  std::string name_;
  std::string worldFingerprint_;
  std::vector<Message> messages_;
  std::vector<Truth> truth_;
};

}  // namespace ortung
