#include "ortung/foxglove/FoxgloveSession.hpp"

#include "SessionParts.hpp"

namespace ortung {

FoxgloveSession::FoxgloveSession(const std::string& token)
    : parts_(std::make_unique<Parts>(*this)) {
  parts_->greet(token);
}

FoxgloveSession::~FoxgloveSession() = default;

void FoxgloveSession::fromClient(std::string_view message, bool isBinary) {
  if (isOver) return;
  isBinary ? parts_->takeBinary(message) : parts_->takeText(message);
  parts_->tellRest();
}

void FoxgloveSession::fromBoard(std::string_view bytes) {
  if (isOver) return;
  const bool isUnderstood = parts_->board.take(bytes);
  parts_->tellRest();
  if (isUnderstood) return;
  parts_->tell(Level::kError, "the board has violated its protocol");
  isOver = true;
}

}  // namespace ortung
