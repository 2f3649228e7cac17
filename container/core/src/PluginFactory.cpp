#include "ortung/core/PluginFactory.hpp"

#include <dlfcn.h>
#include <elf.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>
#include <span>

#include "ortung/base/InputFile.hpp"
#include "ortung/base/LibraryFolder.hpp"
#include "ortung/base/Nearest.hpp"
#include "ortung/core/PluginGuard.hpp"

namespace ortung {
namespace {

constexpr const char* kSymbol = "ortungPlugins";
constexpr const char* kSourceKind = "ortung.Source";

/// Returns how long a library must be according to its header and its segments. The loader trusts
/// them: memory that it maps beyond the end of a file kills the process (SIGBUS) when it is read.
std::uint64_t lengthOf(std::ifstream& in, const Elf64_Ehdr& header,
                       const std::filesystem::path& file) {
  const auto end = [&](std::uint64_t offset, std::uint64_t size) {
    std::uint64_t sum = 0;
    if (__builtin_add_overflow(offset, size, &sum))
      throw PluginError(file.string() + ": is damaged: a part of it ends beyond 2^64 bytes");
    return sum;
  };
  if (header.e_phentsize != sizeof(Elf64_Phdr))
    throw PluginError(file.string() + ": is damaged: it has segments of an unknown kind");
  std::uint64_t length =
      std::max(end(header.e_shoff, std::uint64_t{header.e_shnum} * header.e_shentsize),
               end(header.e_phoff, std::uint64_t{header.e_phnum} * sizeof(Elf64_Phdr)));
  in.seekg(static_cast<std::streamoff>(header.e_phoff));
  for (int i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment{};
    in.read(reinterpret_cast<char*>(&segment), sizeof segment);
    if (!in) break;  // the list of segments is within the length, too, but the file ends before it
    length = std::max(length, end(segment.p_offset, segment.p_filesz));
  }
  return length;
}

/// dlopen of a truncated library kills the process (SIGBUS), so look at its skeleton first.
void checkIsWhole(const std::filesystem::path& file) {
  std::string why;
  std::ifstream in = openInput(file, why);
  if (!in) throw PluginError(file.string() + ": " + why);
  Elf64_Ehdr header{};
  in.read(reinterpret_cast<char*>(&header), sizeof header);
  if (in.gcount() != sizeof header || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 ||
      header.e_ident[EI_CLASS] != ELFCLASS64) {
    throw PluginError(file.string() + ": is no 64-bit shared library");
  }
  const std::uint64_t size = std::filesystem::file_size(file);
  const std::uint64_t expected = lengthOf(in, header, file);
  if (size < expected) {
    throw PluginError(file.string() + ": is torn: it has " + std::to_string(size) +
                      " bytes, expected at least " + std::to_string(expected));
  }
}

std::string interfaceKind(const std::string& interface) {
  return interface.substr(0, interface.find('/'));
}

void checkInfo(const std::filesystem::path& file, const PluginInfo& info) {
  if (info.abi != kPluginAbi || info.size != sizeof(PluginInfo)) {
    throw PluginError(file.string() + ": has plugin ABI " + std::to_string(info.abi) +
                      ", this program has " + std::to_string(kPluginAbi) + "; rebuild the plugin");
  }
  if (std::strcmp(info.buildTag, kBuildTag) != 0) {
    throw PluginError(file.string() + ": was built with " + info.buildTag + ", this program with " +
                      kBuildTag + "; rebuild the plugin");
  }
}

/// Returns what is wrong with a plugin's name, with the line of the file that has its settings.
/// What is not from a file stays as it is.
std::string placed(const std::string& message, const Parameters& settings) {
  try {
    settings.fail("plugin", "is not there: " + message);
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    const std::size_t place = settings.where().size();
    const bool hasLine = text.size() > place + 1 && text[place] == ':' && text[place + 1] != ' ';
    return hasLine ? text : message;
  }
}

/// Makes a plugin; an exception of its constructor gets the plugin's name.
void* createNamed(const PluginEntry& entry, const Parameters& parameters) {
  const std::string who = std::string("plugin '") + entry.name + "'";
  const PluginGuard guard("the " + who);
  const PluginGuard::Inside inside(guard, "its constructor");
  try {
    return entry.create(parameters);
  } catch (const ConfigError&) {
    throw;  // it names file, line and key already
  } catch (const PluginError&) {
    throw;
  } catch (const std::invalid_argument&) {
    throw;  // the robot file's reader adds the line
  } catch (const std::exception& error) {
    if (interfaceKind(entry.interface) == kSourceKind) throw;  // it names its file
    throw PluginError(who + ": " + error.what());
  } catch (...) {
    throw PluginError(who + ": threw something that is no std::exception");
  }
}

}  // namespace

PluginError::~PluginError() = default;

PluginFactory::PluginFactory(std::vector<std::filesystem::path> folders)
    : folders_(std::move(folders)) {}

std::vector<std::filesystem::path> PluginFactory::standardFolders() {
  std::vector<std::filesystem::path> folders;
  if (const char* variable = std::getenv("ORTUNG_PLUGIN_PATH")) {
    std::string rest = variable;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(':'), rest.size());
      if (end > 0) folders.emplace_back(rest.substr(0, end));
      rest.erase(0, end + 1);
    }
  }
  const std::filesystem::path library = libraryFolder();
  if (!library.empty()) folders.push_back(library / "ortung/plugins");
  return folders;
}

void PluginFactory::load(const std::filesystem::path& file) {
  const bool known = std::any_of(libraries_.begin(), libraries_.end(),
                                 [&](const Library& l) { return l.file == file; });
  if (known) return;
  checkIsWhole(file);
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw PluginError(file.string() + ": " + ::dlerror());
  const auto* info = static_cast<const PluginInfo*>(::dlsym(handle, kSymbol));
  if (info == nullptr) {
    throw PluginError(file.string() + ": exports no ORTUNG_PLUGINS, so it is no plugin library");
  }
  checkInfo(file, *info);
  libraries_.push_back({file, info});
}

std::vector<std::filesystem::path> PluginFactory::libraries(const std::string& part) const {
  std::vector<std::filesystem::path> files;
  for (const auto& folder : folders_) {
    const auto begin = static_cast<std::ptrdiff_t>(files.size());
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      const std::string name = entry.path().filename();
      if (name.starts_with("ortung_" + part) && entry.path().extension() == ".so")
        files.push_back(entry.path());
    }
    std::sort(files.begin() + begin, files.end());
  }
  return files;
}

/// Loads libraries(part). Returns why some could not be loaded: a broken library must not hide the
/// plugins of other libraries.
std::vector<PluginFactory::Complaint> PluginFactory::loadWhere(const std::string& part) {
  std::vector<Complaint> complaints;
  for (const auto& file : libraries(part)) {
    try {
      load(file);
    } catch (const PluginError& error) {
      complaints.push_back({file, error.what()});
    }
  }
  return complaints;
}

PluginFactory::Found PluginFactory::look(const std::filesystem::path& file) {
  Found found;
  found.file = file;
  try {
    load(file);
  } catch (const PluginError& error) {
    found.error = error.what();
    return found;
  }
  const auto it = std::find_if(libraries_.begin(), libraries_.end(),
                               [&](const Library& l) { return l.file == file; });
  found.library = it->info->library;
  found.buildTag = it->info->buildTag;
  found.version = it->info->version;
  for (const PluginEntry& entry : std::span(it->info->entries, it->info->count))
    found.entries.push_back({entry.interface, entry.name});
  return found;
}

std::vector<PluginFactory::Found> PluginFactory::list() {
  std::vector<Found> all;
  for (const auto& file : libraries()) all.push_back(look(file));
  return all;
}

const PluginEntry* PluginFactory::findEntry(const std::string& interface,
                                            const std::string& name) const {
  for (const Library& library : libraries_) {
    for (std::size_t i = 0; i < library.info->count; ++i) {
      const PluginEntry& entry = library.info->entries[i];
      if (entry.name != name) continue;
      if (entry.interface == interface) return &entry;
      if (interfaceKind(entry.interface) == interfaceKind(interface)) {
        throw PluginError(library.file.string() + ": plugin " + name + " is of interface " +
                          entry.interface + ", this program has " + interface +
                          "; rebuild the plugin");
      }
    }
  }
  return nullptr;
}

/// Returns whether a broken library hides one of the same file name in a later folder that has the
/// plugin. That is an error, while other broken libraries may be ignored.
bool PluginFactory::hides(const std::vector<Complaint>& complaints, const std::string& interface,
                          const std::string& name) const {
  return std::any_of(libraries_.begin(), libraries_.end(), [&](const Library& library) {
    const std::span entries(library.info->entries, library.info->count);
    const bool hasIt = std::any_of(entries.begin(), entries.end(), [&](const PluginEntry& entry) {
      return entry.interface == interface && entry.name == name;
    });
    return hasIt && std::any_of(complaints.begin(), complaints.end(), [&](const Complaint& c) {
             return c.file.filename() == library.file.filename();
           });
  });
}

/// Returns an error that names the plugin, the nearest one of that kind, and all of that kind.
std::string PluginFactory::missing(const std::string& interface, const std::string& name) const {
  std::set<std::string> there;  // in the order of the alphabet, whatever was loaded first
  for (const Library& library : libraries_)
    for (const PluginEntry& entry : std::span(library.info->entries, library.info->count))
      if (entry.interface == interface) there.insert(entry.name);
  const std::vector<std::string> names(there.begin(), there.end());
  std::string message = "there is no plugin '" + name + "' of kind " + interfaceKind(interface) +
                        didYouMean(name, names) +
                        (names.empty() ? "; there is none" : "; there are ");
  for (const std::string& one : names) message += (&one == &names.front() ? "" : ", ") + one;
  std::string folders;
  for (const auto& folder : folders_) folders += (folders.empty() ? "" : ", ") + folder.string();
  return message + " (in " + (folders.empty() ? "the empty search path" : folders) + ")";
}

void* PluginFactory::create(const std::string& interface, const std::string& name,
                            const Parameters& parameters) {
  const PluginEntry* entry = findEntry(interface, name);
  const bool plainName =
      !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
      });
  std::vector<Complaint> complaints;
  if (entry == nullptr && plainName) {
    complaints = loadWhere(name + "_");
    if (!hides(complaints, interface, name)) entry = findEntry(interface, name);
  }
  if (entry == nullptr && complaints.empty()) {
    complaints = loadWhere("");
    entry = findEntry(interface, name);
  }
  if (entry == nullptr) {
    std::string message = missing(interface, name);
    for (const Complaint& complaint : complaints) message += "; not loaded: " + complaint.what;
    throw PluginError(placed(message, parameters));
  }
  return createNamed(*entry, parameters);
}

std::vector<std::unique_ptr<SensorData>> PluginFactory::makeData(const std::string& name,
                                                                 const Parameters& parameters) {
  const std::unique_ptr<DeviceData> made(
      static_cast<DeviceData*>(create(SensorData::kInterface, name, parameters)));
  parameters.refuseUnread();
  return std::move(*made);
}

}  // namespace ortung
