#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "Program.hpp"

namespace ortung::test {

/// A temporary folder, and the program's main commands in it.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "ortung-e2e-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(folder_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void run(const std::vector<std::string>& arguments) const {
    const Outcome outcome = ortung(arguments);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  }

  /// The figures of one evaluation.
  nlohmann::json eval(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "eval");
    arguments.insert(arguments.end(), {"--json", path("eval.json")});
    run(arguments);
    std::ifstream in(path("eval.json"));
    return nlohmann::json::parse(in, nullptr, false);
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace ortung::test
