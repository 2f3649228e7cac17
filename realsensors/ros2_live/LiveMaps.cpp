#include "LiveMaps.hpp"

#include <algorithm>
#include <exception>
#include <iostream>
#include <system_error>
#include <utility>

#include "ortung/base/NewFile.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/MapFiles.hpp"

namespace ortung::ros2 {
namespace {

constexpr const char* kService = "map_server/load_map";
constexpr std::size_t kLongestUrl = 4096;

/// Returns the path that a URL of a file means; nothing if it can't be one.
std::optional<std::string> pathOf(std::string_view url) {
  constexpr std::string_view kFile = "file://";
  if (url.starts_with(kFile)) url.remove_prefix(kFile.size());
  const bool isPrintable = std::all_of(url.begin(), url.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 32 && byte != 127;
  });
  if (url.empty() || url.size() > kLongestUrl || !isPrintable) return std::nullopt;
  return std::string(url);
}

bool isYaml(const std::filesystem::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

void say(const std::string& what) { std::cerr << "ortung-ros2: load_map: " << what << '\n'; }

}  // namespace

LiveMaps::LiveMaps(OwnWorld world, Options options, LiveRequests& requests)
    : first_(world), options_(std::move(options)), requests_(requests), world_(std::move(world)) {}

void LiveMaps::serve(Participant& node) {
  send_ = node.publish(options_.topic, OccupancyGrid::kType, Qos::kLatched);
  node.serve(kService, "nav2_msgs/srv/LoadMap",
             [this](std::string_view request) { return load(request); });
}

void LiveMaps::tell(const std::string& floor) {
  std::filesystem::path file;
  {
    const std::lock_guard lock(mutex_);
    const OwnWorld::Map* const map = world_.mapOf(floor);
    const std::string& wanted = map != nullptr ? map->floor : floor;
    if (told_ == wanted) return;
    told_ = wanted;
    if (map != nullptr) file = map->file;
  }
  if (file.empty()) {
    std::cerr << "ortung-ros2: no map is told, since the world file names none"
              << (floor.empty() ? "" : " for the floor ") << floor << '\n';
    return;
  }
  try {
    send_(toCdr(readOccupancyGrid(file, options_.frame, timeOfDay())));
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2: the map is not told: " << error.what() << '\n';
  }
}

LoadedMap LiveMaps::read(const std::filesystem::path& file) const {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    say("there is no file " + inQuotes(file.string()));
    return {{}, LoadedMap::kNoSuchMap};
  }
  try {
    return {readOccupancyGrid(file, options_.frame, timeOfDay()), LoadedMap::kSuccess};
  } catch (const std::runtime_error& wrong) {
    say(wrong.what());
    const bool isOfYaml = isYaml(file) && std::string(wrong.what()).starts_with(file.string());
    return {{}, isOfYaml ? LoadedMap::kInvalidMetadata : LoadedMap::kInvalidData};
  } catch (const std::exception& wrong) {
    say(wrong.what());
    return {{}, LoadedMap::kUndefinedFailure};
  }
}

/// Makes a world of a map alone, and wants it.
void LiveMaps::want(const std::filesystem::path& map) {
  const std::filesystem::path file = std::filesystem::absolute(map).lexically_normal();
  const OwnWorld world{options_.folder / "loaded.toml", {{"", file}}};
  std::filesystem::create_directories(options_.folder);
  writeFile(world.file, "[world]\nname = \"loaded\"\n\n" + gridToml(file.string()));
  const std::lock_guard lock(mutex_);
  wanted_ = {world, ""};
}

LoadedMap LiveMaps::answer(const std::string& url) {
  const auto path = pathOf(url);
  if (!path) {
    say("found a URL of " + std::to_string(url.size()) +
        " bytes that is none of a file, expected the path of a map, or the name of a floor");
    return {{}, LoadedMap::kNoSuchMap};
  }
  const OwnWorld present = world();
  const OwnWorld::Map* here = present.find(*path);
  const OwnWorld::Map* const there = here != nullptr ? here : first_.find(*path);
  const std::string floor = there != nullptr ? there->floor : "";
  LoadedMap loaded{{}, LoadedMap::kSuccess};  // of a floor that is no map
  if (there == nullptr || !there->file.empty())
    loaded = read(there != nullptr ? there->file : std::filesystem::path(*path));
  if (loaded.result != LoadedMap::kSuccess) return loaded;
  if (there == nullptr) {
    want(*path);
    return loaded;
  }
  const std::lock_guard lock(mutex_);
  wanted_.reset();  // what was asked last counts
  if (here == nullptr)
    wanted_ = {first_, floor};
  else if (floor.empty())
    wanted_ = {present, ""};  // its file may be another one by now
  else
    requests_.goTo(floor);
  return loaded;
}

std::string LiveMaps::load(std::string_view request) {
  std::string url;
  readCdr(request, url);
  LoadedMap loaded;
  try {
    loaded = answer(url);
  } catch (const std::exception& error) {  // e.g. a folder that can't be written
    say(error.what());
    loaded = {{}, LoadedMap::kUndefinedFailure};
  }
  return cdrOf(loaded);
}

bool LiveMaps::isAnotherWanted() const {
  const std::lock_guard lock(mutex_);
  return wanted_.has_value();
}

LiveMaps::Wanted LiveMaps::takeWanted() {
  const std::lock_guard lock(mutex_);
  return *std::exchange(wanted_, {});
}

void LiveMaps::use(const OwnWorld& world) {
  const std::lock_guard lock(mutex_);
  world_ = world;
  told_.reset();
}

OwnWorld LiveMaps::world() const {
  const std::lock_guard lock(mutex_);
  return world_;
}

}  // namespace ortung::ros2
