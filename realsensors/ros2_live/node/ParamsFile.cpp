#include "ParamsFile.hpp"

#include <yaml-cpp/yaml.h>

#include <fstream>
#include <stdexcept>
#include <string_view>

#include "ortung/base/InputFile.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;
constexpr std::size_t kMostValues = 10'000;
constexpr int kDeepest = 20;  ///< tables in tables

/// The first word of a name "/robot/amcl", and the rest.
std::pair<std::string_view, std::string_view> split(std::string_view name) {
  while (name.starts_with('/')) name.remove_prefix(1);
  const std::size_t slash = name.find('/');
  return {name.substr(0, slash), slash == name.npos ? "" : name.substr(slash + 1)};
}

/// Whether a name fits a pattern, in which * is one word and ** any number of them.
bool isFor(std::string_view pattern, std::string_view name) {
  const auto [wanted, wantedRest] = split(pattern);
  const auto [word, rest] = split(name);
  if (wanted.empty() || (word.empty() && wanted != "**")) return wanted.empty() && word.empty();
  if (wanted == "**")
    return isFor(wantedRest, name) || (!word.empty() && isFor(pattern, rest)) ||
           (wantedRest.empty());
  return (wanted == "*" || wanted == word) && isFor(wantedRest, rest);
}

class Reader {
 public:
  Reader(const std::filesystem::path& file, std::string node)
      : file_(file), node_(std::move(node)) {}

  void read(const YAML::Node& table, const std::string& path, int depth) {
    if (!table.IsMap() || depth > kDeepest) refuse(table, "expected tables of nodes");
    for (const auto& item : table) {
      const YAML::Node& value = item.second;
      if (++count_ > kMostValues) refuse(value, "expected fewer tables");
      const auto name = item.first.as<std::string>();
      if (name != "ros__parameters") {
        // Outside of such a table anything may be, as other programs read the file, too.
        if (value.IsMap()) read(value, path + "/" + name, depth + 1);
        continue;
      }
      others_ += (others_.empty() ? "" : ", ") + path;
      if (!isFor(path, node_)) continue;
      isForAll_ = path == "/**" || path == "//**";
      isFound_ = true;
      if (value.IsNull()) continue;
      if (!value.IsMap()) refuse(value, "expected names of parameters with their values");
      add(value, "", depth + 1);
    }
  }
  ParameterTexts take() {
    if (!isFound_)
      throw std::runtime_error(file_.string() + ": found ros__parameters of " +
                               (others_.empty() ? "none" : others_) + ", expected those of " +
                               node_ + " or /**; the namespace is part of the name");
    return std::move(found_);
  }

 private:
  void add(const YAML::Node& table, const std::string& prefix, int depth) {
    if (depth > kDeepest) refuse(table, "expected fewer tables in one another");
    for (const auto& item : table) {
      const YAML::Node& value = item.second;
      const std::string name = prefix + item.first.as<std::string>();
      if (++count_ > kMostValues) refuse(value, "expected fewer parameters");
      if (value.IsMap()) {
        add(value, name + ".", depth + 1);
        continue;
      }
      YAML::Emitter text;
      text << YAML::Flow << value;
      found_.push_back({name, text.c_str(), isForAll_});
    }
  }
  [[noreturn]] void refuse(const YAML::Node& where, const std::string& expected) const {
    throw std::runtime_error(file_.string() + ":" + std::to_string(where.Mark().line + 1) + ": " +
                             expected);
  }

  const std::filesystem::path& file_;
  const std::string node_;
  ParameterTexts found_;
  std::size_t count_ = 0;  ///< of all that was looked at: aliases may make much of little
  bool isFound_ = false, isForAll_ = false;
  std::string others_;  ///< nodes of which there are parameters
};

std::string readText(const std::filesystem::path& file) {
  std::string why;
  std::ifstream in = openInput(file, why);
  std::string text(kMostBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!why.empty() || in.bad()) throw std::runtime_error(file.string() + ": " + why);
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMostBytes)
    throw std::runtime_error(file.string() + ": is larger than 1 MiB, expected parameters");
  return text;
}

}  // namespace

ParameterTexts readParamsFile(const std::filesystem::path& file, const RosNames& names) {
  const std::string text = readText(file);
  Reader reader(file, names.full());
  try {
    reader.read(YAML::Load(text), "", 0);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(file.string() + ":" + std::to_string(error.mark.line + 1) + ": " +
                             error.msg);
  }
  return reader.take();
}

}  // namespace ortung::ros2
