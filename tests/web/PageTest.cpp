#include <gtest/gtest.h>

#include <fstream>

#include "Files.hpp"
#include "Page.hpp"

namespace ortung::web {
namespace {

using test::TemporaryFolder;

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(Page, HasTheFilesOfItsFolderAndNothingElse) {
  const TemporaryFolder folder;
  write(folder.path() / "secret", "outside");
  write(folder.path() / "page/index.html", "<p>here");
  write(folder.path() / "page/assets/view.js", "1;");
  const Page page(folder.path() / "page", 1000);
  ASSERT_TRUE(page.isThere());
  EXPECT_EQ(*page.find("/")->bytes, "<p>here");
  EXPECT_EQ(*page.find("/?robot=2")->bytes, "<p>here");
  EXPECT_EQ(page.find("/assets/view.js")->type, "text/javascript; charset=utf-8");
  for (const char* target : {"", "/../secret", "/assets/../../secret", "/assets", "//index.html",
                             "/%2e%2e/secret", "index.html", "/assets/view.js/"})
    EXPECT_EQ(page.find(target), nullptr) << target;
}

TEST(Page, SaysHowItIsMadeWhereItWasNotBuilt) {
  const Page page("/nowhere/at/all", 1000);
  EXPECT_FALSE(page.isThere());
  EXPECT_NE(page.find("/")->bytes->find("npm run build"), std::string::npos);
}

TEST(Page, ThatIsTooLargeIsRefused) {
  const TemporaryFolder folder;
  write(folder.path() / "index.html", std::string(1001, 'x'));
  EXPECT_THROW(Page(folder.path(), 1000), std::runtime_error);
}

}  // namespace
}  // namespace ortung::web
