// Commands that take time: orders to the world, work on other threads, waiting.
#include <utility>

#include "Conversation.hpp"

namespace ortung::server {

std::function<bool()> Conversation::isAwaited() const {
  return [isGone = isGone_] { return !*isGone; };
}

void Conversation::order(const std::string& tag, WorldKeeper::Order run, Then then,
                         bool holdsLines) {
  ++pending_;
  waiting_ += holdsLines ? 1 : 0;
  auto done = [weak = weak_from_this(), host = &host_, tag, holdsLines,
               then = std::move(then)](std::string text) {
    host->post([weak, tag, holdsLines, then, text = std::move(text)] {
      const auto self = weak.lock();
      if (!self) return;
      --self->pending_;
      self->waiting_ -= holdsLines ? 1 : 0;
      if (self->isOver_) return;
      if (text.starts_with("ERR "))
        self->error(tag, text);
      else if (then)
        then(*self, tag, text);
      else
        self->reply(tag, text, "");
      self->goOn();
    });
  };
  host_.keeper.give(client_.id, std::move(run), std::move(done));
}

void Conversation::answer(const std::string& tag, std::function<void(Caller&)> say) {
  if (pending_ == 0) {
    say(*this);
    return;
  }
  order(
      tag, [](WorldKeeper&, WorldKeeper::Done&) { return Reply(""); },
      [say = std::move(say)](Caller& its, const std::string&, const std::string&) { say(its); },
      true);  // later lines must not change the reply
}

/// Replies with an error, in the order of the requests.
void Conversation::refuse(const std::string& tag, const std::string& text) {
  answer(tag, [tag, text](Caller& its) { its.error(tag, text); });
}

void Conversation::aside(const std::string& tag, std::function<void()> work,
                         std::function<void(Caller&)> then, bool isLong) {
  ++waiting_;
  auto task = [weak = weak_from_this(), host = &host_, isGone = isGone_, tag,
               work = std::move(work), then = std::move(then)] {
    if (*isGone) return;
    std::string fault;
    try {
      work();
    } catch (...) {
      fault = currentErrorText();
    }
    host->post([weak, tag, fault = std::move(fault), then] {
      const auto self = weak.lock();
      if (!self) return;
      --self->waiting_;
      if (self->isOver_) return;
      if (fault.empty())
        then(*self);
      else
        self->refuse(tag, fault);
      self->goOn();
    });
  };
  if (isLong)
    host_.workLong(std::move(task));
  else
    host_.work(std::move(task));
}

void Conversation::holdUntil(const std::string& tag, Timestamp due,
                             std::function<void(Caller&)> then) {
  held_ = Held{tag, due, std::move(then)};
  ++waiting_;
}

void Conversation::look(Timestamp now) {
  if (!held_ || isOver_ || now < held_->due) return;
  const Held held = *std::exchange(held_, std::nullopt);
  --waiting_;
  try {
    held.then(*this);
  } catch (...) {
    refuse(held.tag, currentErrorText());
  }
  if (!isOver_) goOn();
}

}  // namespace ortung::server
