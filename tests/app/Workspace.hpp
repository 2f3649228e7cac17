#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "Program.hpp"

namespace ortung::test {

/// A temporary folder with a small world, a robot for it and, on demand, tables and a record.
class Workspace : public testing::Test {
 protected:
  Workspace();
  ~Workspace() override;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  std::vector<std::string> files() const;  ///< names in the folder, sorted
  /// Replaces the first @p from in a file.
  void replace(const std::string& name, const std::string& from, const std::string& to) const;

  /// hall.ortung, learned for hall.toml and robot.toml.
  void learnTables() const;
  /// run.rec, 20 s of a simulated drive, in lines of text.
  void recordRun() const;

  std::filesystem::path folder_;
};

/// Expects a failure with one line on stderr that begins so and holds all the parts.
void expectRefused(const Outcome& outcome, int exitCode, const std::string& begin,
                   const std::vector<std::string>& parts);

}  // namespace ortung::test
