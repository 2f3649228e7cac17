#pragma once

/// Names of the formats that come with Ortung (core/Format.hpp). The class of each describes its
/// words. A plugin's own format has any other name, and describes its words by the parameter `row`
/// (core/ReadingValue.hpp).
namespace ortung::formats {

inline constexpr const char* kRange = "range";          ///< ScalarData [max_m=]
inline constexpr const char* kBearing = "bearing";      ///< BearingData
inline constexpr const char* kCone = "cone";            ///< ConeData opening_deg= max_m=
inline constexpr const char* kScan = "scan";            ///< ScanData beams= first_deg= step_deg=
                                                        ///< max_m= [min_m=]
inline constexpr const char* kLandmarks = "landmarks";  ///< LandmarksData
inline constexpr const char* kPoints = "points";        ///< PointsData
inline constexpr const char* kFix = "fix";              ///< PoseFixData
inline constexpr const char* kPose = "pose";            ///< PoseData
inline constexpr const char* kOdometry = "odometry";    ///< OdometryData
inline constexpr const char* kObjects = "objects";      ///< ObjectsData
inline constexpr const char* kObstacles = "obstacles";  ///< ObstaclesData
inline constexpr const char* kTalk = "talk";            ///< TalkData
inline constexpr const char* kPlaces = "places";        ///< PlacesData
inline constexpr const char* kImage = "image";          ///< ImageData [width= height=]
inline constexpr const char* kTrack = "track";  ///< TrackData status= reason= cause=, their names
inline constexpr const char* kClusters = "clusters";      ///< ClustersData
inline constexpr const char* kProtection = "protection";  ///< ProtectionData
inline constexpr const char* kChanges = "changes";        ///< ChangesData
inline constexpr const char* kWork = "work";              ///< WorkData
inline constexpr const char* kSamples = "samples";        ///< SamplesData
inline constexpr const char* kDevice = "device";          ///< DeviceStatusData status=, their names

/// The robots of a world: rows of number, x, y [mm + 2^31, field frame], heading [1/100
/// degree, 0 to 35999], states of manipulators.
inline constexpr const char* kWorldRobots = "world_robots";
/// The movable objects of a world: rows of x, y, z [mm + 2^31, field frame], heading [1/100 degree,
/// 0 to 35999].
inline constexpr const char* kWorldObjects = "world_objects";

}  // namespace ortung::formats
