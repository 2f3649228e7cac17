#include "DroppedFiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <utility>

#include "Console.hpp"
#include "ortung/base/FileKind.hpp"

namespace ortung::app {
namespace {

constexpr std::size_t kLongestName = 100;
constexpr std::uint64_t kMega = 1'000'000;

/// What a page says of a file that it sends.
struct Label {
  std::string name;
  bool isBeside = false;
};

/// A name that is one in every folder: no path, nothing hidden.
bool isSafeName(std::string_view name) {
  const auto isPlain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= kLongestName && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), isPlain);
}

std::optional<Label> labelOf(std::string_view target) {
  const std::size_t mark = target.find('?');
  if (mark == target.npos) return std::nullopt;
  std::string_view query = target.substr(mark + 1);
  Label label;
  while (!query.empty()) {
    const std::string_view key = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), key.size() + 1));
    if (key.starts_with("name="))
      label.name = key.substr(5);
    else if (key == "beside=1")
      label.isBeside = true;
    else
      return std::nullopt;
  }
  if (!isSafeName(label.name)) return std::nullopt;
  return label;
}

/// Why a file is not one to be shown; "" if it is.
std::string whyNot(const std::filesystem::path& file) {
  const FileKind kind = kindOfFile(file);
  constexpr std::array kShown = {FileKind::kRecord, FileKind::kMcap, FileKind::kSqlite,
                                 FileKind::kRosBag, FileKind::kCarmenLog};
  if (std::find(kShown.begin(), kShown.end(), kind) != kShown.end()) return "";
  const std::string wanted = "expected a record, an MCAP file, a bag (.db3, .bag) or a CARMEN log";
  const std::string name = file.filename().string();
  if (kind == FileKind::kHtml)
    return fmt::format("{} is a page, as `ortung export html` writes them: a browser opens it; {}",
                       name, wanted);
  if (kind == FileKind::kUnknown)
    return fmt::format("{} is of no kind that is known here; {}", name, wanted);
  return fmt::format("{} is {}; {}", name, nameOf(kind), wanted);
}

/// The words of an error without the names of our temporary folders.
std::string withoutFolder(std::string text, const std::filesystem::path& folder) {
  const std::string begin = folder.string() + "/";
  for (auto at = text.find(begin); at != text.npos; at = text.find(begin))
    text.erase(at, begin.size());
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

/// A file on its way into a folder of its own.
class DroppedFiles::Upload final : public WebUpload {
 public:
  Upload(DroppedFiles& files, Label label)
      : files_(files),
        label_(std::move(label)),
        folder_(std::make_shared<ScratchFolder>()),
        out_(folder_->path() / label_.name, std::ios::binary) {}
  ~Upload() override {
    if (!isHandedOver_) files_.isBusy_ = false;
  }
  Upload(const Upload&) = delete;
  Upload& operator=(const Upload&) = delete;

  std::optional<WebReply> take(std::string_view bytes) override {
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (out_) return std::nullopt;
    return noRoom();
  }

  void finish(std::function<void(WebReply)> answer) override {
    out_.close();
    if (!out_) {
      answer(noRoom());
      return;
    }
    if (const std::string why = whyNot(folder_->path() / label_.name); !why.empty()) {
      answer({415, why});
      return;
    }
    isHandedOver_ = true;
    files_.prepare(folder_, label_.name, label_.isBeside, answer);
  }

 private:
  WebReply noRoom() const {
    return {507, fmt::format("{} can't be kept: the folder for temporary files ({}) is full or "
                             "can't be written",
                             label_.name, folder_->path().parent_path().string())};
  }

  DroppedFiles& files_;
  const Label label_;
  std::shared_ptr<ScratchFolder> folder_;
  std::ofstream out_;
  bool isHandedOver_ = false;  ///< then whoever prepares it says when the next one may come
};

DroppedFiles::DroppedFiles(const ViewArguments& shown)
    : most_(shown.dropLimit * kMega), shown_(shown) {}

DroppedFiles::~DroppedFiles() {
  if (worker_.joinable()) worker_.join();
}

WebUploads DroppedFiles::uploads() {
  WebUploads uploads;
  if (most_ == 0) return uploads;
  uploads.most = most_;
  uploads.begin = [this](std::string_view target, WebReply& refusal) {
    return begin(target, refusal);
  };
  return uploads;
}

std::unique_ptr<WebUpload> DroppedFiles::begin(std::string_view target, WebReply& refusal) {
  std::optional<Label> label = labelOf(target);
  if (!label) {
    refusal = {400, fmt::format("expected /open?name=NAME, with at most {} letters, digits and ._-",
                                kLongestName)};
    return nullptr;
  }
  if (isBusy_.exchange(true)) {
    refusal = {409, "Another file is being opened: try again when it is shown."};
    return nullptr;
  }
  try {
    return std::make_unique<Upload>(*this, *std::move(label));
  } catch (const std::exception& error) {
    isBusy_ = false;
    refusal = {507, error.what()};
    return nullptr;
  }
}

void DroppedFiles::prepare(const std::shared_ptr<ScratchFolder>& folder, const std::string& name,
                           bool isBeside, const std::function<void(WebReply)>& answer) {
  if (worker_.joinable()) worker_.join();  // it has ended: it is what was busy
  const std::lock_guard lock(mutex_);
  nextShown_ = shown_;
  nextFolders_ = isBeside ? folders_ : Folders();
  if (!isBeside) nextShown_.sources.clear();
  nextShown_.sources.push_back((folder->path() / name).string());
  nextFolders_.push_back(folder);
  worker_ = std::thread([this, folder, name, answer, arguments = nextShown_] {
    try {
      auto world = std::make_unique<ViewedWorld>(arguments);
      const std::lock_guard ready(mutex_);
      next_ = std::move(world);
      isReady_ = true;
      answer({200, "opened " + name});
    } catch (const std::exception& error) {
      const std::string text = withoutFolder(error.what(), folder->path());
      warn("a dropped file can't be shown: " + text);
      {
        const std::lock_guard over(mutex_);
        nextFolders_.clear();
      }
      isBusy_ = false;
      answer({422, text});
    }
  });
}

std::unique_ptr<ViewedWorld> DroppedFiles::take() {
  const std::lock_guard lock(mutex_);
  if (!isReady_) return nullptr;
  shown_ = nextShown_;
  folders_ = std::move(nextFolders_);
  isReady_ = false;
  isBusy_ = false;
  return std::move(next_);
}

}  // namespace ortung::app
