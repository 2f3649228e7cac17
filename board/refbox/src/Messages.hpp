#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace ortung::refbox {

/// Cuts a stream of bytes into messages that end in NUL. One that is too long is passed over up to
/// its end, and told once.
class Messages {
 public:
  explicit Messages(std::size_t longest) : longest_(longest) {}

  /// @param message gets each whole message; empty ones are passed over
  /// @param tooLong is told of one that is too long
  void receive(std::string_view bytes, const std::function<void(std::string_view)>& message,
               const std::function<void()>& tooLong);
  void reset();
  std::size_t waiting() const { return begun_.size(); }

 private:
  std::size_t longest_;
  std::string begun_;
  bool isPassed_ = false;  ///< the rest of a long one
};

}  // namespace ortung::refbox
