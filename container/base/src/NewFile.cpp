#include "ortung/base/NewFile.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace ortung {

NewFile::NewFile(std::filesystem::path file) : file_(std::move(file)), temporary_(file_) {
  temporary_ += ".part" + std::to_string(::getpid());
  out_ = std::fopen(temporary_.c_str(), "wbe");
  if (out_ == nullptr) fail();
}

NewFile::~NewFile() {
  if (out_ == nullptr) return;
  std::fclose(out_);
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void NewFile::fail() const {
  throw std::runtime_error(file_.string() +
                           ": can't be written: " + std::generic_category().message(errno));
}

void NewFile::write(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;  // data() may be null then, which fwrite may not be given
  if (std::fwrite(bytes.data(), 1, bytes.size(), out_) != bytes.size()) fail();
}

void NewFile::commit() {
  if (std::fflush(out_) != 0 || ::fsync(::fileno(out_)) != 0) fail();
  if (std::rename(temporary_.c_str(), file_.c_str()) != 0) fail();
  std::fclose(out_);
  out_ = nullptr;
  syncFolder();
}

/// Writes the folder out, so that the name survives a power failure, too. Fails silently: the file
/// is in place anyhow.
void NewFile::syncFolder() const {
  const std::filesystem::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  NewFile out(file);
  out.write(bytes);
  out.commit();
}

void writeFile(const std::filesystem::path& file, std::string_view text) {
  writeFile(file, std::as_bytes(std::span(text)));
}

}  // namespace ortung
