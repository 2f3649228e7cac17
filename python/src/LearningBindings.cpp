#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "Bindings.hpp"
#include "Gate.hpp"
#include "ortung/learning/Batch.hpp"

namespace ortung::python {
namespace {

using learning::Autoreset;
using learning::Batch;
using learning::EnvironmentInfo;
using learning::Options;

Options toOptions(const std::string& id, const py::dict& values) {
  Options options;
  for (const auto& [key, value] : values) {
    if (!py::isinstance<py::str>(key))
      throw py::type_error("options of the environment " + id + ": a key is no text");
    Parameters::Node node;
    const std::string name = py::cast<std::string>(key);
    if (py::isinstance<py::bool_>(value))
      node.value = py::cast<bool>(value);
    else if (py::isinstance<py::str>(value))
      node.value = py::cast<std::string>(value);
    else if (PyIndex_Check(value.ptr()) != 0)
      node.value = py::cast<std::int64_t>(value);
    else if (PyNumber_Check(value.ptr()) != 0)
      node.value = py::cast<double>(py::float_(py::reinterpret_borrow<py::object>(value)));
    else
      throw py::type_error("options of the environment " + id + ": " + name +
                           " is neither a number nor a text");
    options.insert_or_assign(name, std::move(node));
  }
  return options;
}

py::list quantities(const std::vector<learning::Quantity>& all) {
  py::list list;
  for (const auto& one : all) list.append(py::make_tuple(one.name, one.unit, one.low, one.high));
  return list;
}

py::dict describe(const EnvironmentInfo& info) {
  py::dict actions;
  for (std::size_t i = 0; i < info.agents.size(); ++i)
    actions[py::str(info.agents[i])] = quantities(info.actions[i]);
  py::list options;
  for (const auto& one : info.options)
    options.append(py::make_tuple(one.key, one.values, one.fallback, one.meaning));
  py::dict all;
  all["id"] = info.id;
  all["what"] = info.what;
  all["agents"] = info.agents;
  all["observation"] = quantities(info.observation);
  all["actions"] = actions;
  all["options"] = options;
  return all;
}

/// One action for each observation. @param observations (N, observation)
py::array heuristicActions(const std::string& id, std::size_t agent, const py::object& given) {
  const auto observations = realNumbers<float>(given, id + ": observations");
  const EnvironmentInfo& info = learning::environment(id);
  if (agent >= info.agents.size())
    throw py::value_error(id + " has no agent " + std::to_string(agent));
  const auto seen = static_cast<py::ssize_t>(info.observation.size());
  const auto width = static_cast<py::ssize_t>(info.actions[agent].size());
  if (observations.ndim() != 2 || observations.shape(1) != seen)
    throw py::value_error(id + ": observations must have the shape (N, " + std::to_string(seen) +
                          ")");
  py::array_t<float> actions({observations.shape(0), width});
  for (py::ssize_t i = 0; i < observations.shape(0); ++i)
    learning::heuristic(info, agent, {observations.data(i, 0), static_cast<std::size_t>(seen)},
                        {actions.mutable_data(i, 0), static_cast<std::size_t>(width)});
  return actions;
}

py::array blockingActions(const py::object& given) {
  const auto observations = realNumbers<float>(given, "observations");
  if (observations.ndim() != 2)
    throw py::value_error("observations must have the shape (N, observation)");
  py::array_t<float> actions({observations.shape(0), py::ssize_t{2}});
  for (py::ssize_t i = 0; i < observations.shape(0); ++i)
    learning::blocking({observations.data(i, 0), static_cast<std::size_t>(observations.shape(1))},
                       {actions.mutable_data(i, 0), static_cast<std::size_t>(actions.shape(1))});
  return actions;
}

/// A batch, and Python's threads at it.
struct SharedBatch {
  std::unique_ptr<Batch> batch;
  Gate gate{"this Batch"};

  ~SharedBatch() {
    if (gate.isBroken()) leave(batch);
  }
};

void step(SharedBatch& self, const py::object& given) {
  Batch& batch = *self.batch;
  const EnvironmentInfo& info = batch.info();
  const auto actions = realNumbers<float>(given, info.id + ": actions");
  const std::vector<py::ssize_t> expected = {static_cast<py::ssize_t>(batch.size()),
                                             static_cast<py::ssize_t>(info.agents.size()),
                                             static_cast<py::ssize_t>(info.actionSize())};
  bool fits = actions.ndim() == 3;
  for (py::ssize_t i = 0; fits && i < 3; ++i)
    fits = actions.shape(i) == expected[static_cast<std::size_t>(i)];
  if (!fits)
    throw py::value_error(info.id + ": actions must have the shape (" +
                          std::to_string(expected[0]) + ", " + std::to_string(expected[1]) + ", " +
                          std::to_string(expected[2]) + ")");
  // A copy, which no other thread changes after it was checked.
  const std::vector<float> numbers(actions.data(), actions.data() + actions.size());
  alone(self.gate, [&] { batch.step(numbers); });
}

using Seeds = std::vector<std::optional<std::uint64_t>>;

void reset(SharedBatch& self, const std::optional<Seeds>& seeds, const py::object& mask) {
  std::vector<std::uint8_t> places(self.batch->size(), 1);
  if (!mask.is_none()) {
    const auto flags = py::array::ensure(mask);
    if (!flags || flags.dtype().kind() != 'b' || flags.ndim() != 1)
      throw py::type_error(self.batch->info().id + ": the mask is no array of flags (N,)");
    const auto bools = py::array_t<bool, py::array::c_style>(flags);
    places.assign(bools.data(), bools.data() + bools.size());
  }
  alone(self.gate, [&] { self.batch->reset(places, seeds.value_or(Seeds{})); });
}

template <class T, class Get>
auto array(const Get& get, bool hasAgents, std::size_t last) {
  return [=](const py::object& self) {
    const Batch& batch = *py::cast<const SharedBatch&>(self).batch;
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(batch.size())};
    if (hasAgents) shape.push_back(static_cast<py::ssize_t>(batch.info().agents.size()));
    const std::size_t inner = last == 0 ? 0 : last == 1 ? batch.info().observation.size() : last;
    if (inner > 0) shape.push_back(static_cast<py::ssize_t>(inner));
    const auto numbers = (batch.*get)();
    return readOnly(py::array(py::dtype::of<T>(), shape, numbers.data(), self));
  };
}

using PyBatch = py::class_<SharedBatch>;

/// Arrays that show what is in the batch, without copies.
void bindArrays(PyBatch& batch) {
  batch
      .def_property_readonly("observations", array<float>(&Batch::observations, true, 1),
                             "What the agents see, (N, agents, observation).")
      .def_property_readonly(
          "final_observations", array<float>(&Batch::finalObservations, true, 1),
          "What they saw at the end of episodes that were reset in the same step.")
      .def_property_readonly("rewards", array<double>(&Batch::rewards, true, 0),
                             "Of the last step, (N, agents).")
      .def_property_readonly("terminated", array<bool>(&Batch::terminated, false, 0),
                             "Whether the episode has ended, (N,).")
      .def_property_readonly("truncated", array<bool>(&Batch::truncated, false, 0),
                             "Whether its time is over, (N,).")
      .def_property_readonly("endings", array<std::uint8_t>(&Batch::endings, false, 0),
                             "How it ended, see ending_name(), (N,).")
      .def_property_readonly("seeds", array<std::uint64_t>(&Batch::seeds, false, 0),
                             "The seeds of the episodes, (N,).")
      .def_property_readonly("numbers", array<std::uint64_t>(&Batch::numbers, false, 0),
                             "Their numbers among those of their seed, (N,).")
      .def_property_readonly("states", array<float>(&Batch::states, false, 12),
                             "The worlds as they are, (N, 12).");
}

/// What the episodes that begin from now on are like.
void bindEpisodes(PyBatch& bound) {
  bound
      .def(
          "set_options",
          [](SharedBatch& self, const py::dict& options, std::optional<std::size_t> episode) {
            Batch& batch = *self.batch;
            if (episode && *episode >= batch.size())
              throw py::index_error("there is no such episode");
            const Options values = toOptions(batch.info().id, options);
            alone(self.gate, [&] {
              for (std::size_t i = 0; i < batch.size(); ++i)
                if (!episode || *episode == i) batch.setOptions(i, values);
            });
          },
          py::arg("options"), py::arg("episode") = py::none(),
          "Changes options of episodes that begin from now on, or of one of them.")
      .def(
          "record",
          [](SharedBatch& self, std::size_t episode, const std::filesystem::path& file) {
            if (episode >= self.batch->size()) throw py::index_error("there is no such episode");
            alone(self.gate, [&] { self.batch->record(episode, file); });
          },
          py::arg("episode"), py::arg("file"),
          "Records what the robot of the first agent reads, with its true pose, in each episode "
          "that begins in a place from now on, for `ortung view`. file: '{seed}' and '{number}' in "
          "it stand for those of the episode; without them it has the latest one; '': nothing is "
          "recorded. An episode whose file can't be written, or holds something else than a "
          "record, does not begin: RuntimeError.");
}

/// N episodes of one environment, stepped together.
void bindBatch(py::module_& module) {
  PyBatch bound(module, "Batch",
                "N episodes of one environment, which one call steps on all threads. Arrays are "
                "views of what the next call changes, to be read only. Threads take turns.");
  bound
      .def(py::init([](const std::string& id, const py::dict& options, std::size_t episodes,
                       unsigned threads, Autoreset autoreset, std::uint64_t seed) {
             const Options values = toOptions(id, options);
             auto made = std::make_unique<SharedBatch>();
             const py::gil_scoped_release others;
             made->batch = std::make_unique<Batch>(
                 id, values, learning::BatchConfig{episodes, threads, autoreset, seed});
             return made;
           }),
           py::arg("id"), py::arg("options") = py::dict(), py::arg("episodes") = 1,
           py::arg("threads") = 1, py::arg("autoreset") = Autoreset::kNextStep, py::arg("seed") = 1,
           "Makes the episodes of an environment; place i has the seed seed + i.")
      .def("step", &step, py::arg("actions"),
           "Acts in all episodes; actions: (N, agents, action), numbers in [-1, 1].")
      .def("reset", &reset, py::arg("seeds") = py::none(), py::arg("mask") = py::none(),
           "Begins all episodes anew, or those whose flag in mask, (N,), is set: those of these "
           "seeds, (N,), or the next of each seed. A seed of None stands for the next, too.")
      .def(
          "reset_one",
          [](SharedBatch& self, std::size_t episode, std::optional<std::uint64_t> seed) {
            if (episode >= self.batch->size()) throw py::index_error("there is no such episode");
            alone(self.gate, [&] { self.batch->reset(episode, seed); });
          },
          py::arg("episode"), py::arg("seed") = py::none(), "Begins one episode anew.")
      .def("__len__", [](const SharedBatch& self) { return self.batch->size(); })
      .def_property_readonly(
          "id", [](const SharedBatch& self) { return self.batch->info().id; },
          "The environment's id.")
      .def_property_readonly(
          "autoreset", [](const SharedBatch& self) { return self.batch->autoreset(); },
          "When episodes that have ended begin anew.")
      .def("__repr__", [](const SharedBatch& self) {
        return "Batch('" + self.batch->info().id +
               "', episodes=" + std::to_string(self.batch->size()) + ")";
      });
  bindEpisodes(bound);
  bindArrays(bound);
}
}  // namespace

void bindLearning(py::module_& module) {
  py::enum_<Autoreset>(module, "Autoreset", "When an episode that has ended begins anew.")
      .value("NEXT_STEP", Autoreset::kNextStep)
      .value("SAME_STEP", Autoreset::kSameStep)
      .value("DISABLED", Autoreset::kDisabled);
  module.def(
      "environments",
      [] {
        py::list all;
        for (const EnvironmentInfo& info : learning::environments()) all.append(describe(info));
        return all;
      },
      "What there is: id, agents, observation and actions (name, unit, low, high), options.");
  module.def("heuristic", &heuristicActions, py::arg("id"), py::arg("agent"),
             py::arg("observations"), "What the shipped heuristic does, (N, action).");
  module.def("blocking", &blockingActions, py::arg("observations"),
             "What a keeper does that stands between ball and middle of its goal, (N, 2).");
  module.def(
      "ending_name",
      [](int ending) {
        if (ending < 0 || ending > 4) throw py::value_error("there is no ending of this number");
        return std::string(learning::nameOf(static_cast<learning::Ending>(ending)));
      },
      py::arg("ending"), "The name of a number in Batch.endings; 0: the episode goes on.");

  bindBatch(module);
}

}  // namespace ortung::python
