#include "ortung/formats/ObjectsData.hpp"

#include "FormatTools.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWordsAnObject = 5;

}  // namespace

ObjectsData::ObjectsData(SensorId id, const Pose2& mount) : SensorData(std::move(id), mount) {}
ObjectsData::~ObjectsData() = default;

std::vector<std::uint32_t> ObjectsData::encode(std::span<const Object> objects) {
  std::vector<std::uint32_t> out;
  encode(objects, out);
  return out;
}

void ObjectsData::encode(std::span<const Object> objects, std::vector<std::uint32_t>& out) {
  out.clear();
  out.reserve(objects.size() * kWordsAnObject);
  for (const Object& object : objects) {
    out.push_back(object.identity);
    out.push_back(object.colour);
    out.push_back(words::fromMetres(object.range));
    out.push_back(words::fromAngle(object.bearing));
    out.push_back(words::fromMetres(object.radius));
  }
}

void ObjectsData::check(std::span<const std::uint32_t> words) const {
  checkEntries(words, kWordsAnObject, kMostObjects, "five an object and at most 1024 objects");
  for (std::size_t i = 0; i < words.size(); i += kWordsAnObject) {
    if (words[i + 1] > kNoColour)
      throw std::invalid_argument("found the colour " + std::to_string(words[i + 1]) +
                                  ", expected at most 16777216");
    checkAngleWord(words[i + 3]);
  }
}

void ObjectsData::decode(std::span<const std::uint32_t> words) {
  reading_.clear();
  for (std::size_t i = 0; i < words.size(); i += kWordsAnObject)
    reading_.push_back({words[i], words[i + 1], words::toMetres(words[i + 2]),
                        words::toAngle(words[i + 3]), words::toMetres(words[i + 4])});
}

Format ObjectsData::format() const { return Format(kFormat); }

std::string ObjectsData::wordsHelp() const {
  return "[identity or 0, colour 0xRRGGBB or 2^24, distance mm, bearing 1/100 degree + 18000, "
         "radius mm] an object";
}

}  // namespace ortung
