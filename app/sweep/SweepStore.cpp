#include "SweepStore.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <utility>

#include "ContentDigest.hpp"
#include "EvalParts.hpp"
#include "GoalkeeperParts.hpp"
#include "ManyRuns.hpp"
#include "ProgramFiles.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kMark = "ortung-sweep.txt";
constexpr std::size_t kIdLength = 16;

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": " + error.message());
}

std::vector<fs::path> filesIn(const fs::path& folder, const char* extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Returns the figures in a part that holds a whole job.
std::string figuresIn(const fs::path& part) {
  const PartSet whole({part});
  if (whole.head().kind == kGoalkeeperParts) return toJson(mergeMatrices(whole), ORTUNG_VERSION);
  const std::vector<KeptRun> runs = mergeEvaluated(whole);
  return figuresOf(runs);
}

std::string lineOf(const std::string& id, const SweepCost& cost) {
  return fmt::format("{}\t{:.3f}\t{:.1f}\n", id, cost.seconds, cost.megabytes);
}

std::string textIn(const TableFile& file, const std::string& name) {
  const auto bytes = file.get<std::uint8_t>(name, {0});
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

SweepStore::SweepStore(const fs::path& folder, const SweepFile& sweep)
    : folder_(fs::absolute(folder)), sweep_(sweep) {
  for (const char* part : {"tasks", "shards", "costs", "failed"}) makeFolder(folder_ / part);
  const auto keep = [&](const char* name, const std::string& text) {
    std::ifstream old(folder_ / name, std::ios::binary);
    const std::string now{std::istreambuf_iterator<char>(old), std::istreambuf_iterator<char>()};
    if (now != text) writeFile(folder_ / name, text);
  };
  keep("sweep.toml", sweep.text());
  keep("folder.txt", sweep.folder().string() + "\n");
}

SweepFile SweepStore::sweepOf(const fs::path& folder) {
  const fs::path file = folder / "sweep.toml";
  std::ifstream in(folder / "folder.txt");
  std::string where;
  if (!std::getline(in, where) || !fs::exists(file))
    throw std::runtime_error(folder.string() +
                             ": is no folder of a sweep, expected one of `ortung sweep run`");
  return {readTomlText(file), file.string(), where};
}

fs::path SweepStore::partOf(const std::string& id) const {
  return folder_ / "tasks" / (id + ".part");
}
fs::path SweepStore::failureOf(const std::string& id) const {
  return folder_ / "failed" / (id + ".txt");
}

std::size_t SweepStore::originNumber(Origin origin) {
  // Most results have the same origin, or that of a neighbour.
  for (std::size_t i = origins_.size(); i-- > 0;)
    if (origins_[i] == origin) return i;
  origins_.push_back(std::move(origin));
  return origins_.size() - 1;
}

void SweepStore::look() {
  places_.clear();
  packs_.clear();
  torn_.clear();
  costs_.clear();
  for (const fs::path& file : filesIn(folder_ / "shards", ".pack")) lookAtPack(file);
  for (const fs::path& file : filesIn(folder_ / "tasks", ".part")) lookAtTask(file);
  for (const fs::path& file : filesIn(folder_ / "costs", ".tsv")) {
    std::ifstream in(file);
    std::string id;
    SweepCost cost;
    while (in >> id >> cost.seconds >> cost.megabytes) costs_[id] = cost;
  }
}

void SweepStore::lookAtPack(const fs::path& file) {
  try {
    const TableFile pack(file);
    const auto ids = pack.get<std::uint8_t>("ids", {0, kIdLength});
    const auto numbers = pack.get<std::int32_t>("origins", {0});
    const Json origins = Json::parse(textIn(pack, "origin_list"));
    std::vector<std::size_t> known;
    for (const Json& one : origins)
      known.push_back(originNumber({one.at("version"),
                                    one.at("inputs").get<std::map<std::string, std::string>>(),
                                    one.at("programs").get<std::map<std::string, std::string>>()}));
    if (ids.size() != numbers.size() * kIdLength) throw TableError("its lists differ in length");
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::string id(reinterpret_cast<const char*>(ids.data()) + i * kIdLength, kIdLength);
      places_[id] = {file, known.at(static_cast<std::size_t>(numbers[i])), i, true};
    }
  } catch (const std::exception& error) {
    torn_[file.filename().string()] = error.what();
  }
}

void SweepStore::lookAtTask(const fs::path& file) {
  const std::string id = file.stem().string();
  try {
    const TableFile part(file);
    PartHead head = headOf(part);
    places_[id] = {file,
                   originNumber({head.version, std::move(head.inputs), std::move(head.programs)}),
                   0, false};
  } catch (const std::exception& error) {
    std::error_code ignored;
    if (fs::exists(file, ignored)) torn_[id] = error.what();
  }
}

const std::string& SweepStore::digestNow(const std::string& name) {
  const auto [place, isNew] = digests_.try_emplace(name);
  if (isNew) {
    try {
      place->second = digestOfFile(sweep_.folder() / name);
    } catch (const std::runtime_error&) {
      place->second = "missing";
    }
  }
  return place->second;
}

const std::string& SweepStore::digestOfProgram(const std::string& name) {
  const auto [place, isNew] = programs_.try_emplace(name);
  if (isNew) place->second = digestOfProgramFile(name);
  return place->second;
}

const std::string& SweepStore::stalenessOf(std::size_t origin) {
  const auto [place, isNew] = staleness_.try_emplace(origin);
  if (!isNew) return place->second;
  const Origin& from = origins_[origin];
  if (from.version != PartHead::versionHere()) place->second = "made by version " + from.version;
  const auto compare = [&](const std::string& name, const std::string& now,
                           const std::string& then) {
    if (place->second.empty() && now != then)
      place->second = name + (now == "missing" ? " is missing" : " has changed");
  };
  for (const auto& [name, digest] : from.programs) compare(name, digestOfProgram(name), digest);
  for (const auto& [name, digest] : from.inputs) compare(name, digestNow(name), digest);
  return place->second;
}

SweepStore::Result SweepStore::resultOf(const SweepTask& task) {
  if (const auto torn = torn_.find(task.id); torn != torn_.end())
    return {State::kTorn, torn->second};
  const auto found = places_.find(task.id);
  if (found == places_.end()) {
    std::error_code error;
    return {fs::exists(failureOf(task.id), error) ? State::kFailed : State::kMissing, ""};
  }
  const std::string& stale = stalenessOf(found->second.origin);
  return {stale.empty() ? State::kDone : State::kStale, stale};
}

std::string SweepStore::figuresOf(const SweepTask& task) const {
  const Place& place = places_.at(task.id);
  if (!place.isPacked) return figuresIn(place.file);
  // Tasks of one pack are far from each other in the order of the sweep, so each pack stays open.
  const TableFile& pack = packs_.try_emplace(place.file, place.file).first->second;
  const auto ends = pack.get<double>("figure_ends", {0});
  const auto bytes = pack.get<std::uint8_t>("figures", {0});
  if (place.index >= ends.size()) throw TableError(place.file.string() + ": has no figures");
  const auto begin =
      place.index == 0 ? std::size_t{0} : static_cast<std::size_t>(ends[place.index - 1]);
  const auto end = static_cast<std::size_t>(ends[place.index]);
  if (begin > end || end > bytes.size()) throw TableError(place.file.string() + ": has no figures");
  return {reinterpret_cast<const char*>(bytes.data()) + begin, end - begin};
}

std::string SweepStore::saidBy(const SweepTask& task) const {
  std::ifstream in(failureOf(task.id), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::optional<SweepCost> SweepStore::costOf(const std::string& id) const {
  const auto found = costs_.find(id);
  return found == costs_.end() ? std::nullopt : std::optional(found->second);
}

fs::path SweepStore::costsOf(const std::string& name) const {
  return folder_ / "costs" / (name + ".tsv");
}

void SweepStore::keep(const std::map<std::string, SweepCost>& costs) const {
  for (const auto& [id, cost] : costs) writeFile(costsOf(id), lineOf(id, cost));
}

void SweepStore::pack(const Shard& shard, const std::vector<SweepTask>& tasks,
                      const std::map<std::string, SweepCost>& costs) {
  const std::string name = fmt::format("{}-of-{}", shard.number, shard.count);
  std::string ids;
  std::string figures;
  std::vector<double> ends;  // whole numbers, beyond 32 bits
  std::vector<std::int32_t> numbers;
  std::vector<std::size_t> known;
  Json origins = Json::array();
  for (const SweepTask& task : tasks) {
    const std::size_t origin = places_.at(task.id).origin;
    auto at = std::find(known.begin(), known.end(), origin);
    if (at == known.end()) {
      at = known.insert(known.end(), origin);
      origins.push_back({{"version", origins_[origin].version},
                         {"inputs", origins_[origin].inputs},
                         {"programs", origins_[origin].programs}});
    }
    numbers.push_back(static_cast<std::int32_t>(at - known.begin()));
    ids += task.id;
    figures += figuresOf(task);
    ends.push_back(static_cast<double>(figures.size()));
  }
  TableWriter out(folder_ / "shards" / (name + ".pack"));
  out.addText(kMark, name + "\n");
  const auto bytes = [](const std::string& text) {
    return std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  };
  out.add("ids", {tasks.size(), kIdLength}, bytes(ids));
  out.add("origins", {numbers.size()}, std::span<const std::int32_t>(numbers));
  addLongText(out, "origin_list", origins.dump(-1, ' ', true, Json::error_handler_t::replace));
  out.add("figure_ends", {ends.size()}, std::span<const double>(ends));
  addLongText(out, "figures", figures);
  out.commit();
  std::string text;
  for (const SweepTask& task : tasks) {
    const auto cost = costs.find(task.id);
    const std::optional<SweepCost> spent = cost != costs.end() ? cost->second : costOf(task.id);
    if (spent) text += lineOf(task.id, *spent);
  }
  if (!text.empty()) writeFile(costsOf(name), text);
  std::error_code ignored;
  for (const SweepTask& task : tasks) {
    fs::remove(partOf(task.id), ignored);
    fs::remove(failureOf(task.id), ignored);
    fs::remove(costsOf(task.id), ignored);
  }
}

}  // namespace ortung::app
