#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Statistics.hpp"

namespace ortung {

using Json = nlohmann::ordered_json;

/// Returns the last digits of a word.
std::string hexadecimal(std::uint64_t word, int digits);
Json toJson(const Interval& interval);

/// Reads a whole number, which JSON's library would also make of fractions, negative and greater
/// numbers. @throws std::runtime_error
std::int64_t whole(const Json& json, const std::string& what, std::int64_t low, std::int64_t high);

template <class T>
std::vector<T> wholeNumbers(const Json& json, const std::string& what, std::int64_t low,
                            std::int64_t high) {
  std::vector<T> numbers;
  for (const Json& one : json) numbers.push_back(static_cast<T>(whole(one, what, low, high)));
  return numbers;
}

/// Reads names of players, which are shown. @throws std::runtime_error
std::vector<std::string> namesOf(const Json& json);

/// Reads a result of a command.
/// @param what "`ortung benchmark ...`" @param read makes the result of the JSON, and throws
/// @throws std::runtime_error naming the file, whatever is wrong with it
template <class Read>
auto readResult(std::string_view text, const std::string& file, const std::string& format,
                const std::string& what, const Read& read) {
  const auto refuse = [&](const std::string& why) {
    return std::runtime_error(file + ": is not a result of " + what + ": " + why);
  };
  try {
    const Json json = Json::parse(text);
    if (!json.is_object() || json.value("format", "") != format)
      throw std::runtime_error("expected the format '" + format + "'");
    return read(json);
  } catch (const Json::exception& error) {
    throw refuse(error.what());
  } catch (const std::invalid_argument& error) {
    throw refuse(error.what());
  } catch (const std::runtime_error& error) {
    throw refuse(error.what());
  }
}

}  // namespace ortung
