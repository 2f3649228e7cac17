#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/container/Abi.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// Version of the binary layout; it is raised whenever PluginInfo or PluginEntry changes.
inline constexpr std::uint32_t kPluginAbi = 1;

#define ORTUNG_STR_(x) #x
#define ORTUNG_STR(x) ORTUNG_STR_(x)
#ifdef _GLIBCXX_DEBUG
#define ORTUNG_DEBUG_STL "+debugstl"
#else
#define ORTUNG_DEBUG_STL ""
#endif
/// Toolchain and fingerprint of the container's headers. Plugins and host exchange
/// C++ objects, so both must agree; what does not agree is refused at load.
inline constexpr const char* kBuildTag =
    "container " ORTUNG_CONTAINER_ABI
    ", gcc" ORTUNG_STR(__GNUC__) "-cxx11abi" ORTUNG_STR(_GLIBCXX_USE_CXX11_ABI) ORTUNG_DEBUG_STL;

/// One plugin of a library.
struct PluginEntry {
  const char* interface;  ///< kInterface of the class that it implements: name and version
  const char* name;       ///< name by which it is made
  void* (*create)(const Parameters&);  ///< returns a new Interface*; throws ConfigError
};

/// The only symbol of a plugin library. The first two members never move.
struct PluginInfo {
  std::uint32_t abi;           ///< kPluginAbi of the library
  std::uint32_t size;          ///< bytes of this struct
  const char* buildTag;        ///< kBuildTag of the library
  const char* library;         ///< name of the library, for messages
  const char* version;         ///< version of the container's interface
  const PluginEntry* entries;  ///< array of `count` plugins
  std::size_t count;
};

/// All features of one device, made by its data half.
using DeviceData = std::vector<std::unique_ptr<SensorData>>;

/// The entry of a plugin class that implements @p Interface and is constructed from Parameters.
template <class Interface, class Plugin>
constexpr PluginEntry provide(const char* name) {
  return {Interface::kInterface, name,
          [](const Parameters& p) -> void* { return static_cast<Interface*>(new Plugin(p)); }};
}

/// The data half of a sensor; @p kMake is DeviceData (*)(const Parameters&). A device often has
/// several features (post1Distance, post1Bearing, ...), so it makes a list.
template <DeviceData (*kMake)(const Parameters&)>
constexpr PluginEntry provideData(const char* name) {
  return {SensorData::kInterface, name,
          [](const Parameters& p) -> void* { return new DeviceData(kMake(p)); }};
}

}  // namespace ortung

/// Put once into a plugin library: ORTUNG_PLUGINS("lrf", ortung::provideData<makeLrf>("lrf"));
/// Constant data, not a registering object: the host checks it before it runs our code.
#define ORTUNG_PLUGINS(library, ...)                                           \
  static constexpr ::ortung::PluginEntry ortungEntries[] = {__VA_ARGS__};      \
  extern "C" ORTUNG_API constinit const ::ortung::PluginInfo ortungPlugins = { \
      ::ortung::kPluginAbi,    sizeof(::ortung::PluginInfo),                   \
      ::ortung::kBuildTag,     library,                                        \
      ORTUNG_CONTAINER_ABI,    ortungEntries,                                  \
      std::size(ortungEntries)}
