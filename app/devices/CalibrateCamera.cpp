#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

#include "Calibrate.hpp"
#include "Console.hpp"
#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "ortung/calibration/BoardCalibration.hpp"
#include "ortung/calibration/ImageFile.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// Parses a size of a board, "9x6".
BoardSize boardOf(const std::string& text) {
  constexpr int kMost = 100;
  BoardSize board;
  const char* end = text.data() + text.size();
  const auto [x, first] = std::from_chars(text.data(), end, board.columns);
  const bool hasX = first == std::errc() && x != end && *x == 'x';
  const auto [rest, second] = std::from_chars(hasX ? x + 1 : end, end, board.rows);
  if (!hasX || second != std::errc() || rest != end || std::min(board.columns, board.rows) < 3 ||
      std::max(board.columns, board.rows) > kMost)
    throw UsageError("--board is '" + text + "', expected two numbers of 3 to 100, as 9x6");
  return board;
}

BoardModel modelOf(const std::string& name) {
  if (name == "fisheye") return BoardModel::kFisheye;
  if (name == "unified") return BoardModel::kUnified;
  return name == "ocam" ? BoardModel::kOcam : BoardModel::kPerspective;
}

struct Found {
  ImageSize size;
  std::vector<fs::path> files;  ///< pictures that show the board
  std::vector<std::vector<Pixel>> boards;
};

Found look(const CalibrateCameraArguments& arguments, const BoardSize& board) {
  Found found;
  Progress progress("looking for boards", arguments.progress);
  std::size_t done = 0;
  for (const fs::path& file : arguments.pictures) {
    checkInterrupt();
    const Picture picture = readPicture(file);
    if (done > 0 && !(picture.size == found.size))
      throw std::runtime_error(
          fmt::format("{}: has another size than {}, so it is of another camera", file.string(),
                      arguments.pictures.front().string()));
    found.size = picture.size;
    if (auto corners = findBoard(picture.view(), board)) {
      found.boards.push_back(std::move(*corners));
      found.files.push_back(file);
    } else {
      warn(fmt::format("{}: does not show a whole board of {} x {} inner corners; left out",
                       file.string(), board.columns, board.rows));
    }
    progress.update(static_cast<double>(++done) / static_cast<double>(arguments.pictures.size()));
  }
  return found;
}

}  // namespace

int runCalibrateCamera(const CalibrateCameraArguments& arguments) {
  const BoardSize board = boardOf(arguments.board);
  Outputs outputs(arguments.force);
  for (const fs::path& picture : arguments.pictures) outputs.reads(picture);
  outputs.writes("--out", arguments.out, OutputKind::kSettings);
  const Found found = look(arguments, board);
  const BoardCalibration calibration =
      calibrateByBoards(modelOf(arguments.model), found.size, board, found.boards);
  for (std::size_t i = 0; i < found.files.size(); ++i)
    fmt::print("{:<44} {:.3f} px\n", printable(found.files[i].filename().string()),
               calibration.errors[i]);
  fmt::print("{} of {} pictures, reprojection error {:.3f} px (RMS)\n\n", found.files.size(),
             arguments.pictures.size(), calibration.error);
  const std::string table = "[sensor.camera]\n" + calibration.model->toml();
  if (arguments.out.empty())
    fmt::print("{}", table);
  else
    outputs.write(arguments.out, table);
  return 0;
}

}  // namespace ortung::app
