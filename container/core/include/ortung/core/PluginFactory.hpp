#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// Thrown if a plugin can't be found, loaded or made; the message names it and says why.
class ORTUNG_API PluginError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~PluginError() override;
};

/// Finds plugin libraries and makes plugins by name (paper, section 2). Not thread-safe.
///
/// Libraries are files ortung_*.so in the search path, loaded when they are first needed: those
/// with the plugin's name in the file's name first, the rest only if these do not have it. They
/// stay loaded until the program ends, so plugins may outlive the factory.
class ORTUNG_API PluginFactory {
 public:
  /// The content of a library, for `ortung plugins`.
  struct Found {
    std::filesystem::path file;
    std::string library;  ///< name of the library; "" if it could not be loaded
    std::string buildTag;
    std::string version;
    struct Entry {
      std::string interface;
      std::string name;
    };
    std::vector<Entry> entries;
    std::string error;  ///< reason why it could not be loaded, or ""
  };

  PluginFactory() = default;
  /// @param folders searched in this order
  explicit PluginFactory(std::vector<std::filesystem::path> folders);

  /// Returns $ORTUNG_PLUGIN_PATH (folders, separated by ':'), then ortung/plugins in the folder of
  /// libortung_container.so: the plugins that were built or installed with it.
  static std::vector<std::filesystem::path> standardFolders();

  /// @throws PluginError if the file cannot be loaded, exports no plugins, or was built for
  ///   another ABI; the message says which and what to do
  void load(const std::filesystem::path& library);

  /// Returns the libraries ortung_PART*.so of the search path, folder by folder, in alphabetical
  /// order; nothing is loaded.
  std::vector<std::filesystem::path> libraries(const std::string& part = "") const;
  /// Loads a library and returns what it offers, or its error if it can't be loaded.
  Found look(const std::filesystem::path& library);
  /// The same of all libraries of the search path.
  std::vector<Found> list();

  /// Makes the plugin @p name of kind Interface; reads plugins' own errors, too.
  /// @throws PluginError if there is none
  /// @throws ConfigError if its constructor refused the parameters, or left one unread
  template <class Interface>
  std::unique_ptr<Interface> make(const std::string& name, const Parameters& parameters) {
    std::unique_ptr<Interface> plugin(
        static_cast<Interface*>(create(Interface::kInterface, name, parameters)));
    parameters.refuseUnread();
    return plugin;
  }

  /// Makes a plugin as make() does, or returns null if the libraries loaded so far do not have it.
  /// It is for an optional half of a plugin, once another half was made.
  template <class Interface>
  std::unique_ptr<Interface> makeIfThere(const std::string& name, const Parameters& parameters) {
    if (findEntry(Interface::kInterface, name) == nullptr) return nullptr;
    return make<Interface>(name, parameters);
  }

  /// Makes the data half of a sensor: all features of the device @p name (paper, section 4).
  /// @throws as make()
  std::vector<std::unique_ptr<SensorData>> makeData(const std::string& name,
                                                    const Parameters& parameters);

 private:
  struct Library {
    std::filesystem::path file;
    const PluginInfo* info;
  };
  struct Complaint {
    std::filesystem::path file;
    std::string what;
  };
  void* create(const std::string& interface, const std::string& name, const Parameters& parameters);
  const PluginEntry* findEntry(const std::string& interface, const std::string& name) const;
  std::vector<Complaint> loadWhere(const std::string& part);
  std::string missing(const std::string& interface, const std::string& name) const;
  bool hides(const std::vector<Complaint>& complaints, const std::string& interface,
             const std::string& name) const;

  std::vector<std::filesystem::path> folders_;
  std::vector<Library> libraries_;
};

}  // namespace ortung
