// Every plugin, cut at many lengths: refused with its name and sizes. What would map a torn library
// would be killed (SIGBUS), and this test with it.
#include <elf.h>
#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/PluginFactory.hpp"

namespace ortung {
namespace {

using test::readBytes;
using test::TemporaryFolder;
using test::writeBytes;

Elf64_Ehdr headerOf(const std::string& library) {
  Elf64_Ehdr header{};
  std::memcpy(&header, library.data(), sizeof header);
  return header;
}

std::vector<Elf64_Phdr> segmentsOf(const std::string& library) {
  const Elf64_Ehdr header = headerOf(library);
  std::vector<Elf64_Phdr> segments(header.e_phnum);
  std::memcpy(segments.data(), library.data() + header.e_phoff,
              segments.size() * sizeof(Elf64_Phdr));
  return segments;
}

/// Places where a part ends, and some others, the greatest first.
std::set<std::size_t, std::greater<>> cutsOf(const std::string& library, Random& random) {
  std::set<std::size_t, std::greater<>> cuts{0, 1, 63, 64, library.size() - 1};
  for (const Elf64_Phdr& segment : segmentsOf(library))
    for (const std::size_t at : {segment.p_offset, segment.p_offset + segment.p_filesz})
      cuts.insert({at, at > 0 ? at - 1 : 0});
  for (int i = 0; i < 30; ++i) cuts.insert(random.below(library.size()));
  cuts.erase(library.size());
  return cuts;
}

/// What the factory lists for the only library of a folder: its complaint, or "" if it took it.
std::string complaintOf(const TemporaryFolder& folder) {
  const auto found = PluginFactory({folder.path()}).list();
  return found.size() == 1 ? found[0].error : "there are " + std::to_string(found.size());
}

TEST(TornPlugins, AreRefusedWhereverTheyAreTorn) {
  Random random(3);
  int plugins = 0;
  int cuts = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ORTUNG_PLUGINS_DIR)) {
    const TemporaryFolder folder;
    const auto file = folder / entry.path().filename().string();
    const std::string whole = readBytes(entry.path());
    writeBytes(file, whole);
    ++plugins;
    for (const std::size_t length : cutsOf(whole, random)) {
      std::filesystem::resize_file(file, length);
      const std::string told = complaintOf(folder);
      ASSERT_TRUE(told.starts_with(file.string() + ": is torn: it has " + std::to_string(length) +
                                   " bytes, expected at least ") ||
                  (length < 64 && told == file.string() + ": is no 64-bit shared library"))
          << length << " of " << whole.size() << ": " << told;
      ++cuts;
    }
  }
  std::printf("%d plugins, %d cuts\n", plugins, cuts);
  EXPECT_GE(plugins, 10);
  EXPECT_GE(cuts, 30 * plugins);
}

// The loader does not need the list of sections at the end, so a library may come without.
TEST(TornPlugins, AreRefusedWithoutSectionsToo) {
  const TemporaryFolder folder;
  const auto file = folder / "ortung_compass_data.so";
  std::string library =
      readBytes(std::filesystem::path(ORTUNG_PLUGINS_DIR) / "ortung_compass_data.so");
  Elf64_Ehdr header = headerOf(library);
  header.e_shoff = header.e_shnum = header.e_shstrndx = 0;
  std::memcpy(library.data(), &header, sizeof header);
  std::size_t end = 0;
  for (const Elf64_Phdr& segment : segmentsOf(library))
    end = std::max(end, segment.p_offset + segment.p_filesz);
  library.resize(end);
  Random random(4);
  for (const std::size_t length : cutsOf(library, random)) {
    if (length == 0) continue;
    writeBytes(file, library.substr(0, length));
    ASSERT_NE(complaintOf(folder), "") << length << " of " << end;
  }
  writeBytes(file, library);
  EXPECT_EQ(complaintOf(folder), "") << "or the above proves nothing";
}

TEST(TornPlugins, ImpossibleSizesInTheHeaderAreRefused) {
  const TemporaryFolder folder;
  const auto file = folder / "ortung_compass_data.so";
  const std::string whole =
      readBytes(std::filesystem::path(ORTUNG_PLUGINS_DIR) / "ortung_compass_data.so");
  const auto refused = [&](const auto& change) {
    Elf64_Ehdr header = headerOf(whole);
    change(header);
    std::string library = whole;
    std::memcpy(library.data(), &header, sizeof header);
    writeBytes(file, library);
    return complaintOf(folder);
  };
  for (const std::string& told :
       {refused([](Elf64_Ehdr& h) { h.e_shoff = ~std::uint64_t{0}; }),
        refused([](Elf64_Ehdr& h) { h.e_phoff = ~std::uint64_t{0} - 100; }),
        refused([](Elf64_Ehdr& h) { h.e_phentsize = 1; }),
        refused([](Elf64_Ehdr& h) { h.e_phnum = 0xFFFF; })})
    EXPECT_TRUE(told.starts_with(file.string() + ": is ")) << told;
}

}  // namespace
}  // namespace ortung
