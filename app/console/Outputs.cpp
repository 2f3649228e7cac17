#include "Outputs.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "Console.hpp"
#include "ortung/base/InputFile.hpp"
#include "ortung/records/RecordSource.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

[[noreturn]] void refuseFor(const fs::path& file, int error) {
  refuse(file, std::string("can't be written: ") + std::strerror(error));
}

/// The name of a kind, and how its files are recognized.
struct Signature {
  const char* name;
  std::string_view begin;
  std::string_view within;  ///< the first bytes
};

Signature signatureOf(OutputKind kind) {
  using namespace std::string_view_literals;
  switch (kind) {
    case OutputKind::kRecord:
      return {"a record", "", ""};  // see isOfKind()
    case OutputKind::kTables:
      return {"tables", "PK\x03\x04", "open.npy"};
    case OutputKind::kPart:
      return {"a part for `ortung merge`", "PK\x03\x04", "ortung-part.txt"};
    case OutputKind::kFigures:
      return {"figures of `ortung eval`", "{", "\"compared_steps\""};
    case OutputKind::kComparison:
      return {"a comparison of `ortung compare`", "{\n  \"pairs\": ", ""};
    case OutputKind::kReport:
      return {"a report of `ortung eval`", "<!DOCTYPE html>", ""};
    case OutputKind::kPicture:
      return {"a picture (PNG)", "\x89PNG\r\n", ""};
    case OutputKind::kPoses:
      return {"poses of `ortung localize`", "# stamp_us x_m", ""};
    case OutputKind::kPosesJson:
      return {"poses of `ortung localize --format json`", "{\"stamp_us\":", ""};
    case OutputKind::kPosesTum:
      return {"poses in TUM's format", "# timestamp tx ty tz qx qy qz qw", ""};
    case OutputKind::kBelief:
      return {"a belief of `ortung localize`", "PK\x03\x04", "stamp_us.npy"};
    case OutputKind::kTrace:
      return {"a trace of `ortung sim`", "time_s,kind,name", ""};
    case OutputKind::kMotion:
      return {"[motion] of `ortung learn-motion`", "# Learned by `ortung learn-motion`", ""};
    case OutputKind::kNetwork:
      return {"a motion network", "{", "\"ortung motion network"};
    case OutputKind::kBenchmark:
      return {"a result of `ortung benchmark`", "{", "\"ortung goalkeeper benchmark"};
    case OutputKind::kFootball:
      return {"a result of `ortung benchmark football`", "{", "\"ortung football benchmark"};
    case OutputKind::kPage:
      return {"a page of `ortung benchmark`", "<!doctype html>", "<title>Goalkeeper benchmark"};
    case OutputKind::kRawlog:
      return {"a file of MRPT", "\x1F\x8B", ""};
    case OutputKind::kMcap:
      return {"an MCAP file", "\x89MCAP0\r\n", ""};
    case OutputKind::kSweepCsv:
      return {"a table of `ortung sweep`", "", ",tasks,done,"};
    case OutputKind::kSweepJson:
      return {"figures of `ortung sweep`", "{", "\"ortung sweep figures"};
    case OutputKind::kSweepPage:
      return {"a page of `ortung sweep`", "<!doctype html>", "<title>Sweep "};
    case OutputKind::kSettings:
      break;
  }
  return {"a file", "", "\0 nothing is like it"sv};
}

bool isOfKind(const fs::path& file, OutputKind kind) {
  const Signature signature = signatureOf(kind);
  std::array<char, 8192> bytes;
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), bytes.size());
  const std::string_view begin(bytes.data(), static_cast<std::size_t>(in.gcount()));
  if (kind == OutputKind::kRecord) return isRecord(begin);
  return begin.starts_with(signature.begin) && begin.find(signature.within) != begin.npos;
}

bool isSameFile(const fs::path& a, const fs::path& b) {
  struct stat one{};
  struct stat two{};
  return ::stat(a.c_str(), &one) == 0 && ::stat(b.c_str(), &two) == 0 && one.st_dev == two.st_dev &&
         one.st_ino == two.st_ino && S_ISREG(one.st_mode);
}

/// Whether a standard output goes to that file, which is then written to, not replaced.
bool isOwnOutput(const struct stat& status) {
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat own{};
    if (::fstat(descriptor, &own) == 0 && own.st_dev == status.st_dev &&
        own.st_ino == status.st_ino)
      return true;
  }
  return false;
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Checks a file that does not exist.
void checkNew(const fs::path& file, const fs::path& place) {
  const fs::path folder = folderOf(place);
  std::error_code error;
  if (!place.has_filename()) refuse(file, "names a folder, expected a file");
  if (!fs::is_directory(folder, error))
    refuse(file, "can't be written: there is no folder " + folder.string());
  if (::access(folder.c_str(), W_OK) != 0) refuseFor(file, errno);
}

/// Checks a file that exists.
void checkOld(const std::string& option, const fs::path& file, const struct stat& status,
              OutputKind kind, bool force) {
  if (S_ISDIR(status.st_mode)) refuse(file, "is a folder, expected a file");
  if (S_ISBLK(status.st_mode) && !force)
    refuse(file, "is a disk, whose data " + option + " would overwrite; use --force");
  if (!S_ISREG(status.st_mode) || isOwnOutput(status)) return;
  if (::access(file.c_str(), W_OK) != 0) refuseFor(file, errno);
  if (force || status.st_size == 0) return;
  if (isOfKind(file, kind)) return;
  refuse(file, kind == OutputKind::kSettings
                   ? "exists and would be overwritten; use --force"
                   : "exists and is not what " + option + " writes (" + signatureOf(kind).name +
                         "); it would be overwritten; use --force");
}

}  // namespace

void Outputs::reads(const fs::path& file) {
  if (!file.empty()) inputs_.push_back(file);
}

void Outputs::readsSource(const std::string& text) {
  const std::string path = text.substr(text.find(':') + 1);  // all of the text if it has no colon
  reads(path.substr(0, path.find('?')));
}

void Outputs::refuseInput(const std::string& option, const fs::path& file) const {
  bool isRead = isInput(file);
  for (const fs::path& input : inputs_) isRead = isRead || isSameFile(file, input);
  if (!isRead) return;
  throw UsageError(file.string() + ": is read by this run, so " + option +
                   " can't overwrite it; name another file");
}

void Outputs::refuseTwice(const std::string& option, const fs::path& file) const {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(behindLinks(file), error);
  for (const Output& other : outputs_) {
    const bool isSame =
        isSameFile(file, other.file) ||
        (!fs::exists(file, error) && place == fs::weakly_canonical(behindLinks(other.file), error));
    if (isSame)
      throw UsageError(file.string() + ": " + other.option + " and " + option +
                       " name the same file, expected two");
  }
}

void Outputs::writes(const std::string& option, const fs::path& file, OutputKind kind) {
  if (file.empty()) return;
  refuseInput(option, file);
  refuseTwice(option, file);
  const fs::path place = behindLinks(file);
  struct stat status{};
  if (::stat(place.c_str(), &status) == 0) {
    checkOld(option, file, status, kind, force_);
  } else if (errno == ENOENT) {
    checkNew(file, place);
  } else {
    refuseFor(file, errno);
  }
  outputs_.push_back({option, file});
}

const fs::path& Outputs::ready(const fs::path& file) const {
  for (const Output& output : outputs_)
    if (output.file == file) refuseInput(output.option, file);
  return file;
}

void Outputs::write(const fs::path& file, std::string_view text) const {
  if (!file.empty()) writeFile(ready(file), text);
}

void Outputs::write(const fs::path& file, std::span<const std::byte> bytes) const {
  if (!file.empty()) writeFile(ready(file), bytes);
}

}  // namespace ortung::app
