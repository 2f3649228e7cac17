#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ScratchFolder.hpp"
#include "ViewArguments.hpp"
#include "ViewedWorld.hpp"
#include "ortung/web/WebUpload.hpp"

namespace ortung::app {

/// Files that users drop on the page of `ortung view`. One at a time is taken into a temporary
/// folder, read and prepared while the page goes on showing what it shows; then it is ready to be
/// shown. What is wrong with it is said to the page.
///
/// Files come by POST /open?name=NAME, NAME of letters, digits and "._-"; with &beside=1 they are
/// shown beside what is shown already. Thread-safe, but for take().
class DroppedFiles {
 public:
  /// @param shown what is shown first; its robot, tables and world are those of dropped files, too
  explicit DroppedFiles(const ViewArguments& shown);
  ~DroppedFiles();
  DroppedFiles(const DroppedFiles&) = delete;
  DroppedFiles& operator=(const DroppedFiles&) = delete;

  /// For the web's door, which must not outlive this.
  WebUploads uploads();
  /// Whether there is something else to be shown.
  bool isReady() const { return isReady_; }
  /// What is to be shown now, once; null if nothing is ready.
  std::unique_ptr<ViewedWorld> take();

 private:
  class Upload;
  using Folders = std::vector<std::shared_ptr<ScratchFolder>>;

  std::unique_ptr<WebUpload> begin(std::string_view target, WebReply& refusal);
  void prepare(const std::shared_ptr<ScratchFolder>& folder, const std::string& name, bool isBeside,
               const std::function<void(WebReply)>& answer);

  const std::uint64_t most_;  ///< size of a file [bytes]
  std::atomic<bool> isBusy_{false};
  std::atomic<bool> isReady_{false};
  std::mutex mutex_;  ///< protects what follows
  ViewArguments shown_;
  Folders folders_;  ///< of the dropped files that are shown
  ViewArguments nextShown_;
  Folders nextFolders_;
  std::unique_ptr<ViewedWorld> next_;
  std::thread worker_;
};

}  // namespace ortung::app
