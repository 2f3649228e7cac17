// Replies to a client, and the end of its conversation.
#include <utility>

#include "Conversation.hpp"

namespace ortung::server {
namespace {

constexpr std::size_t kTalkOfTurn = 8u << 10;  // [bytes]

}  // namespace

/// Returns whether a reply may be sent; if the client does not read, none may.
bool Conversation::mayReply() {
  if (isOver_) return false;
  const BoardLimits& limits = host_.config.limits;
  const std::size_t readings = outlet_->outstandingReadings();
  const bool isReadings = readings > limits.readings;
  if (!isReadings && outlet_->outstanding() - readings <= limits.output) return true;
  dismiss("ERR slow more than " + std::to_string(isReadings ? limits.readings : limits.output) +
          " bytes wait to be read");
  return false;
}

void Conversation::reply(const std::string& tag, std::string_view text, std::string_view body) {
  if (isOver_) return;
  std::string out;
  out.reserve(tag.size() + text.size() + body.size() + 2);
  if (!tag.empty()) out.append(tag).append(" ");
  out.append(text).append("\n").append(body);
  if (!mayReply()) return;
  put(out);
  if (!text.starts_with("ERR")) errors_ = 0;
}

/// Sends a line and @p body, which is not copied.
void Conversation::reply(const std::string& tag, std::string_view text, Output&& body) {
  if (!mayReply()) return;
  Output out;
  if (!tag.empty()) out.text().append(tag).append(" ");
  out.text().append(text).append("\n");
  out.add(std::move(body));
  outlet_->add(std::move(out));
  flushSoon();
  errors_ = 0;
}

/// With the answer to the question that has taken their place: who asked anew at once would be
/// answered at once, again and again.
void Conversation::tellSuperseded() {
  if (superseded_.empty()) return;
  answer("", [tags = std::exchange(superseded_, {})](Caller& its) {
    for (const std::string& tag : tags)
      its.reply(tag, "ERR superseded a newer one of the same command came before it was begun");
  });
}

void Conversation::put(std::string_view text) {
  if (!isReceiving_ && pending_ == 0) {
    outlet_->send(text);
    return;
  }
  outlet_->append(text);
  flushSoon();
}

/// Sends the output when the received lines are done, so that replies are not sent piece by piece.
void Conversation::flushSoon() {
  if (isReceiving_) return;
  if (pending_ == 0) {
    outlet_->flush();
    return;
  }
  if (std::exchange(isFlushPosted_, true)) return;
  host_.post([weak = weak_from_this()] {
    const auto self = weak.lock();
    if (!self) return;
    self->isFlushPosted_ = false;
    self->outlet_->flush();
  });
}

void Conversation::error(const std::string& tag, std::string_view text) {
  reply(tag, text, "");
  if (++errors_ >= host_.config.limits.errors) dismiss("ERR errors too many in a row");
}

void Conversation::tell(std::string_view text) {
  if (!client_.hasJoined || isOver_) return;
  put("* " + std::string(text) + "\n");
}

void Conversation::hear(std::string_view text) {
  if (!client_.hasJoined || isOver_) return;
  if (heard_.size() + text.size() > host_.config.limits.talk)
    ++unheard_;
  else
    heard_.append("* ").append(text).append("\n");
}

bool Conversation::hearOn() {
  if (isOver_ || (heard_.empty() && unheard_ == 0) || outlet_->outstanding() > 0) return false;
  if (heard_.size() > kTalkOfTurn) {
    const std::size_t end = heard_.find('\n', kTalkOfTurn) + 1;
    outlet_->send(std::string_view(heard_).substr(0, end));
    heard_.erase(0, end);
    return true;
  }
  if (unheard_ > 0) heard_ += "* LOST says=" + std::to_string(std::exchange(unheard_, 0)) + "\n";
  outlet_->send(std::exchange(heard_, {}));
  return false;
}

void Conversation::dismiss(std::string_view text) {
  if (isOver_) return;
  outlet_->send("* " + std::string(text) + "\n");
  leave();
}

void Conversation::leave() {
  hangUp();
  outlet_->finish();
}

void Conversation::hangUp() {
  if (isOver_) return;
  isOver_ = true;
  *isGone_ = true;
  client_.subscriptions.endAll(*this);
  if (!client_.hasJoined) return;
  host_.keeper.give(client_.id,
                    [id = client_.id](WorldKeeper& keeper, WorldKeeper::Done&) {
                      keeper.leave(id);
                      return std::optional<std::string>("");
                    },
                    {});
}

}  // namespace ortung::server
