#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Describes the words of a feature to programs: a name and parameters, e.g.
/// "scan beams=180 first_deg=-90 step_deg=1 max_m=8". Two features of the same format have words of
/// the same meaning, whatever their classes are. A format is always valid: what could not be read
/// back is refused.
class ORTUNG_API Format {
 public:
  static constexpr std::size_t kLongestName = 64;   ///< most characters of the name, and of a key
  static constexpr std::size_t kLongestText = 900;  ///< most characters of the whole text
  static constexpr std::size_t kMostParameters = 32;
  using Parameter = std::pair<std::string, std::string>;

  /// @param name 1 to 64 of [a-z0-9_]
  /// @throws std::invalid_argument
  explicit Format(std::string name);

  const std::string& name() const { return name_; }
  std::span<const Parameter> parameters() const { return parameters_; }

  // --- making one: each call adds a parameter behind the others ---
  /// @param key 1 to 64 of [a-z0-9_], a new one
  /// @param value printable ASCII without blanks, not empty
  /// @throws std::invalid_argument
  Format& with(const std::string& key, const std::string& value);
  /// Adds a number as the shortest text that reads back as the same number. @throws
  /// std::invalid_argument also if it
  ///   is not finite
  Format& with(const std::string& key, double value);
  /// Adds an angle [rad] in degrees, as the shortest text that reads back as the same radians.
  Format& withAngle(const std::string& key, double radians);
  /// Adds several texts with commas between them; blanks and commas in them become '_'.
  Format& with(const std::string& key, std::span<const char* const> values);

  // --- reading one ---
  bool has(std::string_view key) const;
  /// @throws std::invalid_argument if there is no such parameter
  const std::string& text(std::string_view key) const;
  /// @throws std::invalid_argument if there is none, or it is no finite number
  double number(std::string_view key) const;
  /// Returns a parameter that is given in degrees [rad]. @throws as number()
  double angle(std::string_view key) const;
  /// Returns the texts between the commas. @throws std::invalid_argument if there is no such
  /// parameter
  std::vector<std::string> list(std::string_view key) const;

  /// Returns "NAME key=value key=value ...", with one blank between them.
  std::string toText() const;

  bool operator==(const Format&) const = default;

 private:
  const std::string* find(std::string_view key) const;
  std::string name_;
  std::vector<Parameter> parameters_;
};

/// Reads the text that toText() writes. @throws std::invalid_argument saying what is wrong with it
ORTUNG_API Format parseFormat(std::string_view text);

}  // namespace ortung
