// A table file with mended checksums, used by a robot with a feature of each format. If the first
// byte is 'x', checksums stay as they are.
#include "Fuzz.hpp"
#include "MendedFiles.hpp"
#include "TableUser.hpp"
#include "ortung/robot/TableInfo.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ortung;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  if (!bytes.starts_with('x')) test::mendZip(bytes);
  const auto file = fuzz::write("t.ortung", bytes);
  fuzz::refusedOrDone<TableError>([&] {
    const auto tables = std::make_shared<TableFile>(file);
    for (const TableArray& array : tables->arrays()) {
      std::size_t sum = 0;  // every byte must be readable
      for (const std::byte b : array.bytes) sum += static_cast<std::size_t>(b);
      fuzz::require(sum <= 255 * array.bytes.size());
    }
    SensorContainer container;
    test::fillForTables(container);
    loadTables(tables, container);
    fuzz::require(test::complaintOfWeighing(container).empty());
  });
  return 0;
}
