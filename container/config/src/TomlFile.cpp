#include "ortung/config/TomlFile.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace ortung {
namespace {

// The parser recurses for dots and brackets: bound them before it sees the text.
constexpr std::ptrdiff_t kMostDotsOfALine = 4096;
constexpr std::ptrdiff_t kMostOpenBrackets = 64;

void checkNesting(std::string_view text, const std::string& name) {
  int line = 1;
  std::ptrdiff_t dots = 0;
  std::ptrdiff_t open = 0;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      dots = 0;
    }
    dots += c == '.' ? 1 : 0;
    open += (c == '[' || c == '{') ? 1 : 0;
    open -= (c == ']' || c == '}') ? 1 : 0;
    if (dots > kMostDotsOfALine || open > kMostOpenBrackets) {
      throw ConfigError(name + ":" + std::to_string(line) + ": is nested too deep or has more than " +
                        std::to_string(kMostDotsOfALine) + " dots in a line");
    }
  }
}

Parameters convert(const toml::table& table, const std::string& name);

Parameters::Node convert(const toml::node& node, const std::string& name) {
  Parameters::Node result;
  result.line = static_cast<int>(node.source().begin.line);
  if (const auto* flag = node.as_boolean()) {
    result.value = flag->get();
  } else if (const auto* whole = node.as_integer()) {
    result.value = whole->get();
  } else if (const auto* real = node.as_floating_point()) {
    result.value = real->get();
  } else if (const auto* text = node.as_string()) {
    result.value = text->get();
  } else if (const auto* list = node.as_array()) {
    Parameters::List entries;
    for (const toml::node& entry : *list) entries.push_back(convert(entry, name));
    result.value = std::move(entries);
  } else if (const auto* table = node.as_table()) {
    result.value = convert(*table, name);
  } else {
    throw ConfigError(name + ":" + std::to_string(result.line) + ": dates and times are not used here");
  }
  return result;
}

Parameters convert(const toml::table& table, const std::string& name) {
  Parameters result(name);
  for (const auto& [key, node] : table) result.set(std::string(key.str()), convert(node, name));
  return result;
}

}  // namespace

Parameters parseToml(std::string_view text, const std::string& name, std::size_t maxBytes) {
  if (text.size() > maxBytes) {
    throw ConfigError(name + ": has " + std::to_string(text.size()) + " bytes, at most " +
                      std::to_string(maxBytes) + " are read");
  }
  checkNesting(text, name);
  try {
    return convert(toml::parse(text, name), name);
  } catch (const toml::parse_error& error) {
    throw ConfigError(name + ":" + std::to_string(error.source().begin.line) + ": " +
                      std::string(error.description()));
  }
}

Parameters readToml(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) throw ConfigError(file.string() + ": can't be read");
  std::string text(kMaxConfigBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parseToml(text, file.string(), kMaxConfigBytes);
}

}  // namespace ortung
