#include "ortung/core/SensorData.hpp"

#include <algorithm>
#include <stdexcept>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr std::size_t kLongestName = 64;
constexpr double kSmallestHeadingStep = 1e-4;  ///< [rad], as for table files

bool isNameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '.' || c == '-';
}

void checkName(const std::string& name, const char* which) {
  if (name.empty() || name.size() > kLongestName ||
      !std::all_of(name.begin(), name.end(), isNameCharacter)) {
    throw std::invalid_argument(std::string("the sensor's ") + which +
                                " must be 1 to 64 characters of [A-Za-z0-9_.-]");
  }
}

void checkId(const SensorId& id) {
  checkName(id.model, "model");
  checkName(id.type, "type");
  checkName(id.feature, "feature");
}

}  // namespace

std::string toText(const SensorId& id) { return id.model + "/" + id.type + "/" + id.feature; }

SensorId parseSensorId(std::string_view text) {
  const std::size_t first = text.find('/');
  const std::size_t second = first == text.npos ? text.npos : text.find('/', first + 1);
  if (second == text.npos) {
    throw std::invalid_argument("a feature's name is model/type/feature, with two '/'");
  }
  SensorId id{std::string(text.substr(0, first)),
              std::string(text.substr(first + 1, second - first - 1)),
              std::string(text.substr(second + 1))};
  checkId(id);
  return id;
}

SensorData::SensorData(SensorId id, const Pose2& mount) : id_(std::move(id)), mount_(mount) {
  checkId(id_);
  if (!isFinite(mount_)) throw std::invalid_argument(toText(id_) + ": the mount is not finite");
}

SensorData::~SensorData() = default;

void SensorData::checkData(std::span<const std::uint32_t> words) const {
  try {
    check(words);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(toText(id_) + ": " + error.what());
  }
}

void SensorData::setData(Timestamp stamp, std::span<const std::uint32_t> words) {
  checkData(words);
  decode(words);
  words_.assign(words.begin(), words.end());
  stamp_ = stamp;
  ++sequence_;
  forgetWeigher();
}

void SensorData::beginLearning(const FieldRegion& region, double headingStep) {
  region.check();
  if (!(headingStep > kSmallestHeadingStep) || headingStep > kTurn) {
    throw std::invalid_argument(toText(id_) + ": the heading step must be in (0.0001, 2 pi]");
  }
  learned_ = false;
  startTables(region, headingStep);
}

double SensorData::headingSpacing() const { return kTurn; }

void SensorData::learnProbability(const Pose2& pose) { learn(pose); }

void SensorData::endLearning() {
  finishTables();
  learned_ = localizes();
  forgetWeigher();
}

std::shared_ptr<const Weigher> SensorData::weigher() const {
  if (!learned_ || sequence_ == 0) return nullptr;
  const std::lock_guard lock(weigherMutex_);
  if (!isWeigherMade_) weigher_ = makeWeigher();
  isWeigherMade_ = true;
  return weigher_;
}

void SensorData::forgetWeigher() {
  const std::lock_guard lock(weigherMutex_);
  weigher_.reset();
  isWeigherMade_ = false;
}

double SensorData::getProbability(const Pose2& pose) const {
  const auto now = weigher();
  return now ? now->getProbability(pose) : kNoExpectation;
}

void SensorData::getProbability(const SampleView& poses, std::span<float> logProbability) const {
  if (const auto now = weigher()) now->getProbability(poses, logProbability);
}

void SensorData::loadTables(std::shared_ptr<const TableFile> file, const std::string& prefix,
                            const FieldGrid& grid) {
  useTables(file, prefix, grid);
  learned_ = true;
  forgetWeigher();
}

std::vector<double> SensorData::expectation(const Pose2&) const { return {}; }
bool SensorData::isAngle(std::size_t index) const { return isAngleOfRow(format(), index); }
std::vector<double> SensorData::measured(const Pose2&) const {
  return lengthsAndAngles(valuesOfRows(format(), words_));
}
std::vector<double> SensorData::covariance(const Pose2&) const { return {}; }
std::vector<WordValue> SensorData::valuesIn(std::span<const std::uint32_t> words) const {
  return valuesOfRows(format(), words);
}
void SensorData::store(const WordValue& value, std::span<std::uint32_t> words) const {
  words[value.word] = wordOf(value);
}
std::string SensorData::learningKey() const { return ""; }
void SensorData::saveTables(TableWriter&, const std::string&) const {}
void SensorData::startTables(const FieldRegion&, double) {}
void SensorData::learn(const Pose2&) {}
void SensorData::finishTables() {}
void SensorData::useTables(const std::shared_ptr<const TableFile>&, const std::string&,
                           const FieldGrid&) {}
std::shared_ptr<const Weigher> SensorData::makeWeigher() const { return nullptr; }

}  // namespace ortung
