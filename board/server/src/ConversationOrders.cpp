// Commands that take time: orders to the world, work on other threads, waiting.
#include <utility>

#include "Conversation.hpp"

namespace ortung::server {

std::function<bool()> Conversation::isAwaited() const {
  return [isGone = isGone_, host = &host_] {
    host->paceLong();
    return !*isGone;
  };
}

/// Remembers what waits for its turn, so that the client may ask anew.
void Conversation::note(std::shared_ptr<Question> question, const std::string& tag, bool isOrder) {
  asked_ = Asked{std::move(question), handled_, tag, isOrder};
  isNextKnown_ = false;
}

void Conversation::order(const std::string& tag, WorldKeeper::Order run, Then then, bool holdsLines,
                         std::shared_ptr<Question> question) {
  ++pending_;
  holdsLines = holdsLines || question;
  waiting_ += holdsLines ? 1 : 0;
  const bool isAsked = question != nullptr;
  if (isAsked) note(std::move(question), tag, true);
  auto done = [weak = weak_from_this(), host = &host_, tag, holdsLines, isAsked,
               then = std::move(then)](std::string text) {
    host->post([weak, tag, holdsLines, isAsked, then, text = std::move(text)] {
      const auto self = weak.lock();
      if (!self) return;
      if (isAsked) self->asked_.reset();
      --self->pending_;
      self->waiting_ -= holdsLines ? 1 : 0;
      if (self->isOver_) return;
      if (isAsked) self->tellSuperseded();
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
      true, nullptr);  // later lines must not change the reply
}

/// Replies with an error, in the order of the requests.
void Conversation::refuse(const std::string& tag, const std::string& text) {
  answer(tag, [tag, text](Caller& its) { its.error(tag, text); });
}

void Conversation::aside(const std::string& tag, std::function<void()> work,
                         std::function<void(Caller&)> then, bool isLong,
                         std::shared_ptr<Question> question) {
  ++waiting_;
  if (question) note(question, tag, false);
  const auto fault = std::make_shared<std::string>();
  SlowTask task;
  task.begin = [isGone = isGone_, question] {
    return !*isGone && (!question || question->begin());
  };
  task.work = [work = std::move(work), fault] {
    try {
      work();
    } catch (...) {
      *fault = currentErrorText();
    }
  };
  task.done = [weak = weak_from_this(), host = &host_, tag, fault, then = std::move(then),
               isAsked = question != nullptr] {
    host->post([weak, tag, fault, then, isAsked] {
      const auto self = weak.lock();
      if (!self) return;
      if (isAsked) self->asked_.reset();
      --self->waiting_;
      if (self->isOver_) return;
      if (isAsked) self->tellSuperseded();
      if (fault->empty())
        then(*self);
      else
        self->refuse(tag, *fault);
      self->goOn();
    });
  };
  if (isLong)
    host_.workLong(client_.id, std::move(task));
  else
    host_.work([task = std::move(task)] { task.run(); });
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
