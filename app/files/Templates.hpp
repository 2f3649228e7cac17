#pragma once

/// Files that `ortung init` writes, of app/files/templates; @NAME@ stands for the name of what is
/// made, @MAP@ for a map.
namespace ortung::app::templates {

extern const char* const kRobot;
extern const char* const kOdometry;
extern const char* const kScanner;
extern const char* const kWorld;
extern const char* const kMapWorld;
extern const char* const kSensor;
extern const char* const kSensorBuild;
extern const char* const kSensorRobot;

}  // namespace ortung::app::templates
