#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace ortung::web {

/// Has the door's thread do something, for those who may outlive the door: then nothing is done.
/// Thread-safe.
class Later {
 public:
  explicit Later(boost::asio::io_context& io) : io_(&io) {}
  Later(const Later&) = delete;
  Later& operator=(const Later&) = delete;

  void run(std::function<void()> what) {
    const std::lock_guard lock(mutex_);
    if (io_ != nullptr) boost::asio::post(*io_, std::move(what));
  }
  /// From now on nothing is done.
  void end() {
    const std::lock_guard lock(mutex_);
    io_ = nullptr;
  }

 private:
  std::mutex mutex_;
  boost::asio::io_context* io_;
};

}  // namespace ortung::web
