#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// All halves of one sensor plugin, made from the same settings.
struct SensorRig {
  SensorRig(const std::string& plugin, const std::string& toml)
      : factory(PluginFactory::standardFolders()) {
    const Parameters settings = parseToml(toml, "test.toml");
    for (auto& one : factory.makeData(plugin, settings))
      data.push_back(&container.add(std::move(one)));
    sensor = factory.make<Sensor>(plugin, settings);
    if (auto extractor = factory.makeIfThere<Extractor>(plugin, settings))
      container.add(plugin, std::move(extractor), data);
    container.connect();
  }

  /// Generates data with the robot at @p pose.
  void sense(const World& world, const Pose2& pose, Random* noise = nullptr) {
    RobotState state;
    state.pose = pose;
    container.setField(std::make_shared<FieldModel>(fieldModelOf(world)));
    sensor->generateData(world, state, noise, ++now, data);
    container.extract();
  }

  template <class T>
  T& get(std::size_t i = 0) {
    return dynamic_cast<T&>(*data.at(i));
  }

  PluginFactory factory;
  SensorContainer container;
  std::unique_ptr<Sensor> sensor;
  std::vector<SensorData*> data;
  Timestamp now = 0;
};

/// What the data half says to these settings: its error, or "".
inline std::string refusal(const std::string& plugin, const std::string& toml) {
  PluginFactory factory(PluginFactory::standardFolders());
  try {
    factory.makeData(plugin, parseToml(toml, "test.toml"));
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

/// Expects that both halves refuse @p toml with all of @p parts in the message.
inline void expectRefusal(const std::string& plugin, const std::string& toml,
                          const std::vector<std::string>& parts) {
  const std::string message = refusal(plugin, toml);
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos)
        << toml << "\nwas answered by: " << (message.empty() ? "nothing" : message)
        << "\nexpected in it: " << part;
  PluginFactory factory(PluginFactory::standardFolders());
  EXPECT_THROW(factory.make<Sensor>(plugin, parseToml(toml, "test.toml")), ConfigError) << toml;
}

/// Mean and standard deviation of what was added.
class Statistics {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  int count() const { return count_; }
  double mean() const { return sum_ / count_; }
  double sigma() const { return std::sqrt(squares_ / count_ - mean() * mean()); }

 private:
  int count_ = 0;
  double sum_ = 0.0;
  double squares_ = 0.0;
};

}  // namespace ortung
