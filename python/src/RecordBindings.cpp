// Records that Python writes.
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Bindings.hpp"
#include "FeatureNames.hpp"
#include "OwnFiles.hpp"
#include "Robots.hpp"
#include "Values.hpp"
#include "ortung/base/Nearest.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung::python {
namespace {

/// A record, and what its readings are made by.
struct SharedWriter {
  std::string file;
  std::optional<Container> container;  ///< makes words of values; none: there are words only
  std::unique_ptr<RecordWriter> writer;
  std::size_t messages = 0;
  bool any = false;
  Timestamp newest = 0;
  Gate gate{"this RecordWriter"};
  OpenedHere opened;

  ~SharedWriter() {
    if (gate.isBroken() || !opened.isHere()) leave(writer);
  }
};

void needOpen(const SharedWriter& self) {
  self.opened.check("this RecordWriter");
  if (!self.writer) throw std::runtime_error(self.file + ": this record is closed");
}

void write(SharedWriter& self, Timestamp stamp, const std::string& feature,
           std::vector<std::uint32_t> words) {
  const Message message{stamp, featureIdOf(feature), std::move(words)};
  if (self.any && stamp < self.newest)
    throw py::value_error(self.file + ": a reading of " + std::to_string(stamp) +
                          " us comes after one of " + std::to_string(self.newest) +
                          " us, expected the order of time");
  alone(self.gate, [&] { self.writer->write(message); });
  self.any = true;
  self.newest = stamp;
  ++self.messages;
}

/// A feature that the container of a record does not have is most likely misspelt.
void needFeature(const SharedWriter& self, const std::string& feature) {
  if (!self.container) return;
  const Gate::Together visit(*self.container->gate);
  const SensorContainer& container = *self.container->container;
  if (container.findExactly(featureIdOf(feature, &container)) != nullptr) return;
  const std::vector<std::string> names = namesOf(container);
  throw py::key_error("there is no feature " + feature + " in the record's container" +
                      didYouMean(feature, names) + thereAre(names));
}

void writeWords(SharedWriter& self, Timestamp stamp, const std::string& feature,
                const py::object& words) {
  needOpen(self);
  needFeature(self, feature);
  write(self, stamp, feature, wordsOf(words, feature));
}

void writeValues(SharedWriter& self, Timestamp stamp, const std::string& feature,
                 const py::object& values) {
  needOpen(self);
  if (!self.container)
    throw py::value_error(self.file + ": made without a container, so it can't know what values " +
                          "of " + feature +
                          " are as words; expected RecordWriter(file, container)");
  needFeature(self, feature);
  const SensorData* data = nullptr;
  {
    const Gate::Together visit(*self.container->gate);
    const SensorContainer& container = *self.container->container;
    data = container.findExactly(featureIdOf(feature, &container));
  }
  write(self, stamp, feature, encode(*data, values));
}

void close(SharedWriter& self) {
  needOpen(self);
  alone(self.gate, [&] { self.writer->commit(); });
  self.writer.reset();
}

std::unique_ptr<SharedWriter> open(const std::filesystem::path& file,
                                   std::optional<Container> container, const std::string& world,
                                   bool force) {
  refuseOther(file, FileKind::kRecord, force);
  auto self = std::make_unique<SharedWriter>();
  self->file = file.string();
  RecordNotes notes{world};
  if (container) {
    const Gate::Together visit(*container->gate);
    notes.formats = formatsOf(*container->container);
  }
  self->container = std::move(container);
  const py::gil_scoped_release others;
  self->writer = std::make_unique<RecordWriter>(file, notes);
  return self;
}

}  // namespace

void bindRecords(py::module_& module) {
  py::class_<SharedWriter>(
      module, "RecordWriter",
      "Writes a record, which appears whole when it is closed: `with RecordWriter(...) as record`. "
      "It is lines of text if its name ends in '.txt', else compressed.")
      .def(py::init(&open), py::arg("file"), py::arg("container") = py::none(),
           py::arg("world") = "", py::arg("force") = false,
           "container: of the robot whose readings these are, for their formats and for "
           "write_values(); features that it does not have are refused. world: fingerprint of the "
           "world "
           "where they are made, or ''. A file that is no record is replaced with force only.")
      .def(
          "write", &writeWords, py::arg("stamp"), py::arg("feature"), py::arg("words"),
          "Writes a reading by its words, as readings() gives them. Stamps [us] must not decrease.")
      .def("write_values", &writeValues, py::arg("stamp"), py::arg("feature"), py::arg("values"),
           "Writes a reading in metres and radians, as SensorContainer.get() gives it.")
      .def("close", &close, "Completes the file, which is then in its place.")
      .def_property_readonly(
          "messages", [](const SharedWriter& self) { return self.messages; },
          "How many readings were written.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__",
           [](SharedWriter& self, const py::object& kind, const py::object&, const py::object&) {
             if (!self.writer) return;
             if (kind.is_none())
               close(self);
             else
               self.writer.reset();  // what was not completed does not appear
           })
      .def("__repr__", [](const SharedWriter& self) {
        return "RecordWriter('" + self.file + "', messages=" + std::to_string(self.messages) +
               (self.writer ? ")" : ", closed)");
      });
}

}  // namespace ortung::python
