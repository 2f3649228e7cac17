#include "ortung/robot/RobotText.hpp"

#include <sstream>

#include "TomlLibrary.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

/// Returns where a place of the parser is in the text. The parser counts characters of UTF-8, from
/// 1.
std::size_t offsetOf(std::string_view text, const toml::source_position& place) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
  const auto isWithin = [&] {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  for (toml::source_index column = 1; column < place.column; ++column) {
    ++at;
    while (isWithin()) ++at;
  }
  return std::min(at, text.size());
}

/// Returns the [[sensor]] of that number. @throws ConfigError
const toml::table& sensorOf(const toml::table& root, const std::string& name, std::size_t sensor) {
  const toml::array* all = root["sensor"].as_array();
  const toml::table* table =
      all != nullptr && sensor < all->size() ? all->get(sensor)->as_table() : nullptr;
  if (table == nullptr)
    throw ConfigError(name + ": has no [[sensor]] of number " + std::to_string(sensor + 1));
  return *table;
}

/// Returns the text with one key changed. It is parsed anew for each key, so that places are right.
std::string withKey(const std::string& text, const std::string& name, std::size_t sensor,
                    const TomlEntry& entry) {
  const toml::table root = toml::parse(text);
  const toml::table& table = sensorOf(root, name, sensor);
  std::string changed = text;
  if (const toml::node* old = table.get(entry.first)) {
    const std::size_t begin = offsetOf(text, old->source().begin);
    const std::size_t end = offsetOf(text, old->source().end);
    return changed.replace(begin, end - begin, entry.second);
  }
  const toml::node* plugin = table.get("plugin");
  if (plugin == nullptr) throw ConfigError(name + ": a [[sensor]] has no plugin");
  const std::size_t lineEnd = text.find('\n', offsetOf(text, plugin->source().end));
  const std::string line = entry.first + " = " + entry.second;
  if (lineEnd == text.npos) return text + "\n" + line + "\n";
  return changed.insert(lineEnd + 1, line + "\n");
}

/// Returns whether a changed text has the wanted value, and nothing else was changed.
bool isAsWanted(const std::string& before, const std::string& after, const std::string& name,
                std::size_t sensor, const TomlEntry& entry) {
  const auto plain = [](const toml::table& table) {
    std::ostringstream out;
    out << table;
    return out.str();
  };
  try {
    toml::table old = toml::parse(before);
    const toml::table now = toml::parse(after);
    auto& table = const_cast<toml::table&>(sensorOf(old, name, sensor));
    const toml::table value = toml::parse("value = " + entry.second);
    table.erase(entry.first);
    value.get("value")->visit([&](const auto& v) { table.insert(entry.first, v); });
    return plain(old) == plain(now);
  } catch (const toml::parse_error&) {
    return false;
  }
}

}  // namespace

std::string withSensorKeys(std::string_view text, const std::string& name, std::size_t sensor,
                           std::span<const TomlEntry> entries) {
  parseToml(text, name);  // throws if it is wrong
  std::string now(text);
  for (const TomlEntry& entry : entries) {
    std::string changed = withKey(now, name, sensor, entry);
    if (!isAsWanted(now, changed, name, sensor, entry)) {
      throw ConfigError(name + ": " + entry.first + " of [[sensor]] number " +
                        std::to_string(sensor + 1) +
                        " can't be changed in place; expected a table with a line for each key");
    }
    now = std::move(changed);
  }
  return now;
}

}  // namespace ortung
