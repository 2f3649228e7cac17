#include "ExportHtml.hpp"

#include <fmt/format.h>

#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>

#include "Base64.hpp"
#include "Console.hpp"
#include "Interrupt.hpp"
#include "KeptMaps.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "ViewedRuns.hpp"
#include "Viewing.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/server/DescribeText.hpp"

namespace ortung::app {
namespace {

using nlohmann::json;

constexpr std::size_t kMostBytes = 256u << 20;  // of readings, before they are compressed
constexpr std::size_t kMostWords = 8192;        // of a reading; pictures have more
constexpr std::size_t kMostSamples = 300;       // of a belief
constexpr std::size_t kWordsOfSample = 4;
constexpr std::size_t kMapBytes = 24u << 20;  // of all maps, as they stand in the page

/// Some of a belief's samples, evenly chosen: a page has no room for all.
void thin(Message& message) {
  const std::size_t samples = message.words.size() / kWordsOfSample;
  if (message.id != SensorId{"mcl", "LOCALIZATION", "samples"} || samples <= kMostSamples) return;
  std::vector<std::uint32_t> few;
  for (std::size_t i = 0; i < kMostSamples; ++i) {
    const auto from = message.words.begin() +
                      static_cast<std::ptrdiff_t>(i * samples / kMostSamples * kWordsOfSample);
    few.insert(few.end(), from, from + kWordsOfSample);
  }
  message.words = std::move(few);
}

/// All readings of a record as lines, from time 0 on.
struct Readings {
  std::string lines;
  std::size_t leftOut = 0;  ///< moments that are too large

  explicit Readings(const std::filesystem::path& record) {
    RecordSource source(record);
    Message message;
    for (std::optional<Timestamp> first; source.next(message);) {
      if (!first) first = message.stamp;
      message.stamp -= *first;
      thin(message);
      if (message.words.size() > kMostWords) {
        ++leftOut;
        continue;
      }
      writeLine(message, lines);
      lines += '\n';
      if (lines.size() > kMostBytes)
        throw std::runtime_error(fmt::format(
            "{}: has more than {} MiB of readings, too many for a page; export a part, e.g. "
            "'record:FILE?from_s=0&to_s=60'",
            record.string(), kMostBytes >> 20));
    }
  }
};

std::string compressed(const std::string& text) {
  namespace io = boost::iostreams;
  std::ostringstream out;
  {
    io::filtering_ostream stream;
    stream.push(io::gzip_compressor(io::gzip::best_compression));
    stream.push(out);
    stream << text;
  }
  return std::move(out).str();
}

std::string textOf(const std::string& bytes) { return base64(std::as_bytes(std::span(bytes))); }

std::string fileOfPage(const std::filesystem::path& folder, const char* name) {
  std::ifstream in(folder / name, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in || text.empty())
    throw std::runtime_error((folder / name).string() +
                             ": this part of the viewer's page is missing; see board/web/page");
  return text;
}

/// Maps of all runs at some moments each.
class MapsOfRuns {
 public:
  MapsOfRuns(const ExportHtmlArguments& arguments, const ViewedRuns& viewed,
             ServedPlayback& playback)
      : playback_(playback), progress_("maps", arguments.runs.localization.progress) {
    const bool areTablesGiven = !arguments.runs.localization.tables.empty();
    most_ = arguments.maps.value_or(areTablesGiven && viewed.perception ? kUsualMoments : 0);
    if (most_ == 0) return;
    if (!viewed.perception)
      throw UsageError(
          "--maps needs what the readings are weighed by: --tables, or --robot and --world");
    world_ = std::make_unique<PerceivedPlayback>(playback, *viewed.perception);
    Progress learning("learning", arguments.runs.localization.progress);
    world_->fetchTables([&](double done) {
      learning.update(done);
      checkInterrupt();
      return true;
    });
  }

  /// Those of one run, for the page; nothing where none are wanted.
  json of(RobotId robot) {
    json moments = json::array();
    if (!world_) return moments;
    const auto runs = static_cast<double>(playback_.residents().size());
    const auto pack = [](const std::string& text) { return textOf(compressed(text)); };
    const KeptMaps kept =
        keptMaps(*world_, robot, momentsOf(playback_, robot, most_),
                 kMapBytes / playback_.residents().size(), pack, [&](double done) {
                   progress_.update((robot - 1 + done) / runs);
                   checkInterrupt();
                   return true;
                 });
    for (const KeptMaps::Moment& one : kept.moments)
      moments.push_back({{"us", one.stamp}, {"data", one.json}});
    leftOut_ += kept.leftOut;
    return moments;
  }
  std::size_t leftOut() const { return leftOut_; }

 private:
  static constexpr std::size_t kUsualMoments = 16;
  ServedPlayback& playback_;
  Progress progress_;
  std::unique_ptr<PerceivedPlayback> world_;
  std::size_t most_ = 0;
  std::size_t leftOut_ = 0;
};

/// What the page would have been told by a server, for it to tell itself.
json tale(const ServedPlayback& playback, const ServedPlayback::Config& config, MapsOfRuns& maps,
          std::size_t& leftOut) {
  json robots = json::array();
  for (const Resident& resident : playback.residents()) {
    const Readings readings(config.runs[resident.robot - 1].record);
    leftOut += readings.leftOut;
    robots.push_back(
        {{"name", resident.name},
         {"describe", robotText(resident.features, playback.abilities(resident.robot))},
         {"readings", textOf(compressed(readings.lines))},
         {"maps", maps.of(resident.robot)}});
  }
  json events = json::array();
  for (const ServedPlayback::Mark& mark : playback.marks())
    events.push_back(std::to_string(events.size()) + " " + std::to_string(mark.stamp) + " " +
                     mark.text);
  return {{"world", worldText(playback.describe())},
          {"field", playback.field()},
          {"truth", robotText(playback.truthFeatures(), {})},
          {"events", events},
          {"robots", robots},
          {"end_us", playback.length()}};
}

/// One file: style, script and data within, and nothing from elsewhere.
std::string pageOf(const json& told, const std::string& title) {
  const std::filesystem::path folder = pageFolder();
  std::string script = fileOfPage(folder, "page.js");
  const std::string icon = "./icon.svg";  // the one file that the page shows by its name
  for (std::size_t at = 0; (at = script.find(icon, at)) != script.npos;)
    script.replace(at, icon.size(),
                   "data:image/svg+xml;base64," + textOf(fileOfPage(folder, "icon.svg")));
  // A text within a script must not end it.
  if (script.find("</script") != script.npos)
    throw std::runtime_error((folder / "page.js").string() + ": can't stand within a page");
  std::string data = told.dump(-1, ' ', true, json::error_handler_t::replace);
  for (std::size_t at = 0; (at = data.find('<', at)) != data.npos; at += 6)
    data.replace(at, 1, "\\u003c");
  std::string name;
  for (const char c : title) name += c == '<' || c == '>' || c == '&' ? '_' : c;
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src "
         "'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:\">\n<title>" +
         name + "</title>\n<style>" + fileOfPage(folder, "page.css") +
         "</style>\n</head>\n<body>\n<div id=\"page\"></div>\n"
         "<script id=\"run\" type=\"application/json\">" +
         data + "</script>\n<script type=\"module\">" + script + "</script>\n</body>\n</html>\n";
}

}  // namespace

int runExportHtml(const ExportHtmlArguments& arguments) {
  Outputs outputs(arguments.force);
  for (const std::string& source : arguments.runs.sources) outputs.reads(source);
  outputs.writes("--out", arguments.out, OutputKind::kReport);
  const ScratchFolder scratch;
  const ViewedRuns viewed = prepareRuns(arguments.runs, scratch);
  const ServedPlayback::Config& config = viewed.playback;
  Progress progress("reading", arguments.runs.localization.progress);
  ServedPlayback playback(config, [&](double done) {
    progress.update(done);
    return interruptSignal() == 0;
  });
  std::size_t leftOut = 0;
  MapsOfRuns maps(arguments, viewed, playback);
  const std::string page = pageOf(tale(playback, config, maps, leftOut), config.name);
  outputs.write(arguments.out, page);
  if (maps.leftOut() > 0)
    warn(fmt::format("maps of {} moments have no room on the page ({} MiB)", maps.leftOut(),
                     kMapBytes >> 20));
  if (leftOut > 0) warn(fmt::format("{} pictures and other large readings are left out", leftOut));
  fmt::print("{}: {:.1f} s of {} in {:.1f} MB\n", printable(arguments.out.string()),
             toSeconds(playback.length()), printable(config.name),
             static_cast<double>(page.size()) / 1e6);
  return 0;
}

}  // namespace ortung::app
