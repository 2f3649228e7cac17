#include "Workshop.hpp"

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "ortung/base/InputFile.hpp"
#include "ortung/base/NewFile.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

void copyFile(const fs::path& made, const fs::path& place) {
  NewFile out(place);
  std::ifstream in(made, std::ios::binary);
  std::vector<char> bytes(1u << 20);
  while (in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || in.gcount() > 0)
    out.write(std::string_view(bytes.data(), static_cast<std::size_t>(in.gcount())));
  if (in.bad()) throw std::runtime_error(made.string() + ": " + cantBeRead(errno));
  out.commit();
}

}  // namespace

Workshop::Workshop(const char* option, fs::path target)
    : option_(option), target_(std::move(target)) {}

void Workshop::declare(Outputs& outputs) const {
  const fs::path target = behindLinks(target_);
  const bool hasFolder = !fs::exists(target) || fs::is_regular_file(target);
  for (const fs::path& made : files()) {
    if (made == file()) continue;
    if (!hasFolder)
      throw std::runtime_error(target_.string() + ": " + made.filename().string() +
                               " is made beside it, so it must be a file in a folder");
    outputs.writes(option_, placeOf(made), OutputKind::kSettings);
  }
}

void Workshop::deliver(const Outputs& outputs) const {
  for (const fs::path& made : files()) {
    if (made != file()) copyFile(made, outputs.ready(placeOf(made)));
  }
  copyFile(file(), outputs.ready(target_));
}

std::vector<fs::path> Workshop::files() const {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder())) {
    if (!entry.is_directory()) found.push_back(entry.path());
  }
  return found;
}

fs::path Workshop::placeOf(const fs::path& made) const {
  return target_.parent_path() / fs::relative(made, folder());
}

}  // namespace ortung::app
