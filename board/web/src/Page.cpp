#include "Page.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace ortung::web {
namespace {

constexpr const char* kNoPage =
    "<!doctype html>\n<html lang=\"en\">\n<head><meta "
    "charset=\"utf-8\"><title>Ortung</title></head>\n"
    "<body>\n<h1>Ortung</h1>\n<p>This server shows no page: start it with <code>--view</code>. (A "
    "program "
    "that was built without the page has none. Its source is in <code>board/web/page</code>: "
    "<code>npm ci &amp;&amp; npm run build</code> makes it.) Clients of the protocol work all the "
    "same.</p>\n</body>\n</html>\n";

/// Types that browsers believe, as they are told not to guess.
std::string typeOf(const std::filesystem::path& file) {
  static const std::map<std::string, std::string, std::less<>> kTypes = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".json", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".woff2", "font/woff2"},
      {".txt", "text/plain; charset=utf-8"}};
  const auto found = kTypes.find(file.extension().string());
  return found == kTypes.end() ? "application/octet-stream" : found->second;
}

}  // namespace

Page::Page(const std::filesystem::path& folder, std::size_t most) {
  std::error_code error;
  if (!folder.empty() && std::filesystem::is_directory(folder, error)) {
    std::size_t all = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      if (!in) throw std::runtime_error(entry.path().string() + ": can't be read");
      all += bytes.size();
      if (all > most)
        throw std::runtime_error(folder.string() + ": the page has more than " +
                                 std::to_string(most) + " bytes");
      files_["/" + entry.path().lexically_relative(folder).generic_string()] = {
          typeOf(entry.path()), std::make_shared<const std::string>(std::move(bytes))};
    }
  }
  isThere_ = files_.contains("/index.html");
  if (!isThere_)
    files_["/index.html"] = {typeOf("index.html"), std::make_shared<const std::string>(kNoPage)};
  files_["/"] = files_["/index.html"];
}

const Page::File* Page::find(std::string_view target) const {
  const auto found = files_.find(target.substr(0, std::min(target.find('?'), target.find('#'))));
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace ortung::web
