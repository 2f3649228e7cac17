#include "Extraction.hpp"

#include <algorithm>

#include "ortung/core/SensorContainer.hpp"

namespace ortung {
namespace {

template <class Data>
bool has(const std::vector<Data*>& list, const SensorData* data) {
  return std::find(list.begin(), list.end(), data) != list.end();
}

}  // namespace

void Extraction::add(std::string name, std::unique_ptr<Extractor> extractor,
                     std::vector<SensorData*> outputs) {
  Step step;
  step.name = std::move(name);
  step.extractor = std::move(extractor);
  step.outputs = std::move(outputs);
  std::string who = "the extractor of '" + step.name + "'";
  if (!step.outputs.empty()) who += ", which makes " + toText(step.outputs.front()->id());
  if (step.outputs.size() > 1) who += " and " + std::to_string(step.outputs.size() - 1) + " more";
  step.guard = std::make_unique<PluginGuard>(who + ",");
  step.words.resize(step.outputs.size());
  step.made.resize(step.outputs.size());
  steps_.push_back(std::move(step));
}

void Extraction::connect(std::span<const std::unique_ptr<SensorData>> features) {
  for (Step& step : steps_) {
    step.inputs.clear();
    const auto inputs = (*step.guard)("inputs", [&] { return step.extractor->inputs(); });
    for (const std::string& text : inputs) {
      const SensorQuery query = parseSensorQuery(text);
      const auto found = std::find_if(features.begin(), features.end(), [&](const auto& data) {
        const bool isOwn = has(step.outputs, data.get());
        return matches(query, data->id()) && (!isOwn || toText(data->id()) == text);
      });
      if (found == features.end())
        throw std::invalid_argument("'" + step.name + "' reads " + text +
                                    ", which no sensor of this robot gives");
      step.inputs.push_back(found->get());
    }
    step.seen.assign(step.inputs.size(), 0);
  }
  order();
}

/// Returns whether the step makes a feature. Features that it reads as well are filled by others.
bool Extraction::Step::makes(const SensorData* data) const {
  return has(outputs, data) && !has(inputs, data);
}

std::vector<const SensorData*> Extraction::inputsOf(const SensorData& made) const {
  for (const Step& step : steps_)
    if (step.makes(&made)) return step.inputs;
  return {};
}

/// Sorts the steps by their inputs: those whose inputs no other step makes come first.
void Extraction::order() {
  std::vector<Step> sorted;
  const auto waits = [&](const Step& step) {
    return std::any_of(step.inputs.begin(), step.inputs.end(), [&](const SensorData* input) {
      return std::any_of(steps_.begin(), steps_.end(),
                         [&](const Step& other) { return other.makes(input); });
    });
  };
  while (!steps_.empty()) {
    const auto next =
        std::find_if(steps_.begin(), steps_.end(), [&](const Step& step) { return !waits(step); });
    if (next == steps_.end()) {
      std::string names;
      for (const Step& step : steps_) names += (names.empty() ? "'" : ", '") + step.name + "'";
      throw std::invalid_argument("features are made of each other in a circle: " + names);
    }
    sorted.push_back(std::move(*next));
    steps_.erase(next);
  }
  steps_ = std::move(sorted);
}

bool Extraction::reads(const SensorData& data) const {
  return std::any_of(steps_.begin(), steps_.end(),
                     [&](const Step& step) { return has(step.inputs, &data); });
}

/// Runs the steps. A caller that comes while another thread runs them raises a number, by which
/// that thread sees that it is not done yet.
void Extraction::run(std::shared_mutex& lock) {
  ++asked_;
  while (true) {
    std::uint64_t done = 0;
    {
      const std::unique_lock running(running_, std::try_to_lock);
      if (!running) return;
      done = asked_;
      runAll(lock);
    }
    // This is read after unlocking: a thread that failed to lock has raised the number before that.
    if (asked_ == done) return;
  }
}

void Extraction::runAll(std::shared_mutex& lock) {
  for (Step& step : steps_) {
    Timestamp stamp = 0;
    try {
      std::shared_ptr<const FieldModel> field;
      {
        const std::shared_lock reading(lock);
        if (!take(step, stamp)) continue;
        field = field_;
      }
      std::fill(step.words.begin(), step.words.end(), std::nullopt);
      (*step.guard)("extract", [&] { step.extractor->extract(*field, step.words); });
      const std::unique_lock writing(lock);
      put(step, stamp);
    } catch (const PluginFailure& failure) {
      throw ExtractorError(failure.what());
    }
  }
}

/// Returns whether an input is new, and takes it. @param stamp of the newest input
bool Extraction::take(Step& step, Timestamp& stamp) {
  bool isNew = false;
  std::vector<const SensorData*> readings;
  for (std::size_t i = 0; i < step.inputs.size(); ++i) {
    const SensorData& input = *step.inputs[i];
    isNew = isNew || input.sequence() != step.seen[i];
    step.seen[i] = input.sequence();
    readings.push_back(input.sequence() > 0 ? &input : nullptr);
    if (input.sequence() > 0)
      stamp = readings.size() == 1 ? input.stamp() : std::max(stamp, input.stamp());
  }
  if (!isNew || step.cameByMessage(stamp)) return false;
  (*step.guard)("take", [&] { step.extractor->take(readings); });
  return true;
}

/// Returns whether the output came by a message, made of the same inputs by another program: a
/// robot's server may know more about the field and about earlier readings.
bool Extraction::Step::cameByMessage(std::size_t output, Timestamp stamp) const {
  const SensorData& data = *outputs[output];
  return makes(&data) && data.sequence() != made[output] && data.stamp() == stamp;
}

/// Returns whether all outputs came by messages.
bool Extraction::Step::cameByMessage(Timestamp stamp) const {
  bool any = false;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (!makes(outputs[i])) continue;
    if (!cameByMessage(i, stamp)) return false;
    any = true;
  }
  return any;
}

void Extraction::put(Step& step, Timestamp stamp) {
  for (std::size_t i = 0; i < step.outputs.size(); ++i) {
    if (!step.words[i] || step.cameByMessage(i, stamp)) continue;
    (*step.guard)("extract", [&] { step.outputs[i]->setData(stamp, *step.words[i]); });
    step.made[i] = step.outputs[i]->sequence();
  }
}

}  // namespace ortung
