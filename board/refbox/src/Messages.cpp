#include "Messages.hpp"

#include <algorithm>

namespace ortung::refbox {

void Messages::receive(std::string_view bytes, const std::function<void(std::string_view)>& message,
                       const std::function<void()>& tooLong) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\0');
    const std::string_view piece = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end == bytes.npos ? bytes.size() : end + 1, bytes.size()));
    if (!isPassed_ && begun_.size() + piece.size() > longest_) {
      isPassed_ = true;
      begun_.clear();
      tooLong();
    }
    if (!isPassed_) begun_.append(piece);
    if (end == std::string_view::npos) return;
    if (!isPassed_ && !begun_.empty()) message(begun_);
    reset();
  }
}

void Messages::reset() {
  begun_.clear();
  isPassed_ = false;
}

}  // namespace ortung::refbox
