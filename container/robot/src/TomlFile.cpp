#include "ortung/robot/TomlFile.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <vector>

#include "TomlChanges.hpp"
#include "TomlLibrary.hpp"
#include "ortung/base/InputFile.hpp"

namespace ortung {
namespace {

// The parser recurses for dots and brackets: bound them before it sees the text.
constexpr int kMostDots = 1024;  ///< most dots of keys in one statement
constexpr int kMostOpenBrackets = 64;
constexpr int kDeepest = 64;  ///< deepest nesting of tables and lists

/// The text as the parser will see it: characters outside of comments and quoted texts. Where this
/// class and the parser disagree on quotes, the parser reports an error.
class Outside {
 public:
  explicit Outside(std::string_view text) : rest_(text) {}

  /// Returns the next character, or 0 at the end; comments and quoted texts are skipped.
  char next() {
    while (!rest_.empty()) {
      const char c = rest_.front();
      if (c == '#') {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      } else if (c == '"' || c == '\'') {
        skipQuoted(c);
        return 'q';
      } else {
        rest_.remove_prefix(1);
        line_ += c == '\n' ? 1 : 0;
        return c;
      }
    }
    return 0;
  }
  std::ptrdiff_t line() const { return line_; }

 private:
  void skipQuoted(char quote) {
    const std::string three(3, quote);
    const bool longText = rest_.starts_with(three);
    const std::string_view end =
        longText ? std::string_view(three) : std::string_view(three).substr(2);
    rest_.remove_prefix(end.size());
    while (!rest_.empty() && !rest_.starts_with(end)) {
      if (rest_.front() == '\n' && !longText) return;  // an error that the parser reports
      const bool escaped = quote == '"' && rest_.front() == '\\' && rest_.size() > 1;
      line_ += std::count(rest_.begin(), rest_.begin() + (escaped ? 2 : 1), '\n');
      rest_.remove_prefix(escaped ? 2 : 1);
    }
    rest_.remove_prefix(std::min(end.size(), rest_.size()));
    // A long text may end in one or two quotes of its own.
    for (int i = 0; longText && i < 2 && rest_.starts_with(quote); ++i) rest_.remove_prefix(1);
  }
  std::string_view rest_;
  std::ptrdiff_t line_ = 1;
};

bool isOfNumber(char c) { return (c >= '0' && c <= '9') || c == '_' || c == '+' || c == '-'; }
bool isOfWord(char c) { return isOfNumber(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

void checkSize(std::string_view text, const std::string& name, std::size_t most) {
  if (text.size() <= most) return;
  throw ConfigError(name + ": has " + std::to_string(text.size()) + " bytes, at most " +
                    std::to_string(most) + " are read");
}

void checkNesting(std::string_view text, const std::string& name) {
  Outside outside(text);
  int dots = 0;
  int open = 0;
  bool number = false;  // the word just read may stand before a decimal point
  char last = '\n';
  for (char c = outside.next(); c != 0; last = c, c = outside.next()) {
    if (isOfWord(c)) number = isOfNumber(c) && (isOfWord(last) ? number : last != '.');
    dots += c == '.' && !(isOfWord(last) && number) ? 1 : 0;
    open += (c == '[' || c == '{') ? 1 : 0;
    open -= (c == ']' || c == '}') ? 1 : 0;
    if (c == '\n' && open <= 0) dots = 0;
    if (dots > kMostDots || open > kMostOpenBrackets) {
      throw ConfigError(name + ":" + std::to_string(outside.line()) +
                        ": is nested too deep or has more than " + std::to_string(kMostDots) +
                        " dots in one statement");
    }
  }
}

Parameters convert(const toml::table& table, const std::string& name, int depth);

Parameters::Node convert(const toml::node& node, const std::string& name, int depth) {
  Parameters::Node result;
  result.line = static_cast<int>(node.source().begin.line);
  if (depth > kDeepest) {
    throw ConfigError(name + ":" + std::to_string(result.line) + ": has more than " +
                      std::to_string(kDeepest) + " tables and lists within each other");
  }
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
    for (const toml::node& entry : *list) entries.push_back(convert(entry, name, depth + 1));
    result.value = std::move(entries);
  } else if (const auto* table = node.as_table()) {
    result.value = convert(*table, name, depth + 1);
  } else {
    throw ConfigError(name + ":" + std::to_string(result.line) +
                      ": dates and times are not used here");
  }
  return result;
}

Parameters convert(const toml::table& table, const std::string& name, int depth) {
  Parameters result(name);
  for (const auto& [key, node] : table)
    result.set(std::string(key.str()), convert(node, name, depth));
  return result;
}

toml::table parse(std::string_view text, const std::string& name, std::size_t maxBytes) {
  checkSize(text, name, maxBytes);
  checkNesting(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw ConfigError(name + ":" + std::to_string(error.source().begin.line) + ": " +
                      std::string(error.description()));
  }
}

}  // namespace

std::string readTomlText(const std::filesystem::path& file) {
  return changedToml(readUnchanged(file), file);
}

std::string readUnchanged(const std::filesystem::path& file) {
  std::string why;
  std::ifstream in = openInput(file, why);
  if (!in) throw ConfigError(file.string() + ": " + why);
  std::string text;
  std::array<char, 65536> part{};
  do {
    in.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(in.gcount()));
  } while (in && text.size() <= kMaxConfigBytes);
  if (in.bad()) throw ConfigError(file.string() + ": " + cantBeRead(errno));
  checkSize(text, file.string(), kMaxConfigBytes);
  return text;
}

Parameters parseToml(std::string_view text, const std::string& name, std::size_t maxBytes) {
  return convert(parse(text, name, maxBytes), name, 0);
}

std::string withoutTables(
    std::string_view text, const std::string& name,
    const std::function<bool(const std::string&, const Parameters&)>& isLeftOut) {
  toml::table all = parse(text, name, kMaxConfigBytes);
  convert(all, name, 0);  // refuses what can't be read
  for (auto& [key, node] : all) {
    toml::array* array = node.as_array();
    if (array == nullptr) continue;
    for (std::size_t i = array->size(); i-- > 0;) {
      const toml::table* table = (*array)[i].as_table();
      if (table != nullptr && isLeftOut(std::string(key.str()), convert(*table, name, 0)))
        array->erase(array->begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  std::vector<std::string> empty;
  for (const auto& [key, node] : all)
    if (node.is_array() && node.as_array()->empty()) empty.emplace_back(key.str());
  for (const std::string& key : empty) all.erase(key);
  std::ostringstream out;
  out << toml::toml_formatter(all) << '\n';
  return out.str();
}

Parameters readToml(const std::filesystem::path& file) {
  return parseToml(readTomlText(file), file.string());
}

}  // namespace ortung
