// A foreign log: the first line is the source's text ("carmen:a.log?laser=FLASER"), the files of
// its folder follow, each behind a line "=== NAME".
#include <algorithm>

#include "Fuzz.hpp"
#include "Paths.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"

namespace {

using namespace ortung;

bool isPlain(std::string_view name) {
  return !name.empty() && name.size() < 64 && name != "." && name != ".." &&
         std::all_of(
             name.begin(), name.end(),
             [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-' || c == '(' ||
                      c == ')' || c == ',';
             });
}

void writeFiles(std::string_view rest) {
  const std::string_view mark = "\n=== ";
  for (std::size_t at = rest.find(mark); at != rest.npos;) {
    rest.remove_prefix(at + mark.size());
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    at = rest.find(mark);
    const std::size_t begin = std::min(end + 1, rest.size());
    const std::size_t stop = std::min(at, rest.size());
    if (isPlain(rest.substr(0, end)))
      fuzz::write(std::string(rest.substr(0, end)),
                  rest.substr(begin, stop > begin ? stop - begin : 0));
  }
}

void removeFiles() {
  for (const auto& entry : std::filesystem::directory_iterator(fuzz::folder().path()))
    std::filesystem::remove_all(entry.path());
}

void read(const std::string& text) {
  static PluginFactory factory({ORTUNG_PLUGINS_DIR});
  const SourceText parsed = parseSourceText(text);
  // Others read no logs: rawlog starts a program, sim and tcp wait for one.
  const std::string_view kinds[] = {"carmen", "scanlog", "mrclam", "plaza", "uwbpose", "roh"};
  if (std::find(std::begin(kinds), std::end(kinds), parsed.kind) == std::end(kinds)) return;
  // What lies elsewhere is none of our business.
  if (parsed.path.starts_with('/') || parsed.path.find("..") != parsed.path.npos) return;
  Parameters parameters(text);
  parameters.set("path", (fuzz::folder() / parsed.path).string());
  parameters.set("robot_file", "");
  for (const auto& [key, value] : parsed.options)
    if (key != "path" && key != "robot_file" && !value.starts_with('/')) parameters.set(key, value);
  const auto source = factory.make<Source>(parsed.kind, parameters);
  Timestamp last = INT64_MIN;
  for (Message message; source->next(message);) {
    fuzz::require(message.stamp >= last && !message.id.model.empty());
    last = message.stamp;
  }
  source->robotToml();
  source->writeWorld(fuzz::folder() / "out.toml");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view all(reinterpret_cast<const char*>(bytes), size);
  const std::size_t end = std::min(all.find('\n'), all.size());
  removeFiles();
  writeFiles(all.substr(end));
  fuzz::refusedOrDone<std::runtime_error, std::invalid_argument>(
      [&] { read(std::string(all.substr(0, end))); });
  return 0;
}
