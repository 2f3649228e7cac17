#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

#include "ortung/core/Extractor.hpp"
#include "ortung/core/PluginGuard.hpp"

namespace ortung {

/// The extractors of a container, in an order in which each finds its inputs made.
/// run() is thread-safe; the rest belongs to setting up.
class Extraction {
 public:
  void add(std::string name, std::unique_ptr<Extractor> extractor,
           std::vector<SensorData*> outputs);
  /// Finds inputs and order. @throws std::invalid_argument for inputs that are not there or depend
  /// on what is made of them
  void connect(std::span<const std::unique_ptr<SensorData>> features);
  /// @pre the container is locked, or nobody else is there
  void setField(std::shared_ptr<const FieldModel> field) { field_ = std::move(field); }

  /// Whether anything is made of a feature.
  bool reads(const SensorData& data) const;
  std::vector<const SensorData*> inputsOf(const SensorData& made) const;
  bool isEmpty() const { return steps_.empty(); }
  /// Makes whatever has new inputs. If another thread is at it, that one does it.
  /// @param lock of the container
  /// @throws ExtractorError
  void run(std::shared_mutex& lock);

 private:
  struct Step {
    bool makes(const SensorData* data) const;
    bool cameByMessage(std::size_t output, Timestamp stamp) const;
    bool cameByMessage(Timestamp stamp) const;
    std::string name;
    std::unique_ptr<Extractor> extractor;
    std::unique_ptr<PluginGuard> guard;
    std::vector<SensorData*> outputs;
    std::vector<const SensorData*> inputs;
    std::vector<std::uint64_t> seen;  ///< sequence number of the last reading taken, by input
    std::vector<std::optional<Extractor::Words>> words;
    std::vector<std::uint64_t> made;  ///< sequence number of the reading made last, by output
  };
  static bool take(Step& step, Timestamp& stamp);
  static void put(Step& step, Timestamp stamp);
  void runAll(std::shared_mutex& lock);
  void order();

  std::vector<Step> steps_;
  std::shared_ptr<const FieldModel> field_ = std::make_shared<FieldModel>();
  std::mutex running_;
  std::atomic<std::uint64_t> asked_ = 0;
};

}  // namespace ortung
