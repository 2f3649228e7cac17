#include "RoomRun.hpp"
#include "ortung/run/OpenSource.hpp"

namespace ortung::test {
namespace {

using Opening = RoomRun;

TEST_F(Opening, TheTextsOwnMistakesAreATypeOfTheirOwn) {
  PluginFactory factory(PluginFactory::standardFolders());
  const auto complaint = [&](const std::string& text) {
    return messageOf<SourceTextError>([&] { openSource(text, "", factory); });
  };
  EXPECT_TRUE(complaint("run.rec").starts_with("source 'run.rec': expected KIND:PATH"));
  EXPECT_EQ(complaint("record:run.rec?speed=2"),
            "record:run.rec: a record knows no option 'speed'");
  EXPECT_EQ(complaint("scanlog:x?path=y"), "scanlog:x: 'path' is no option of a source");
  EXPECT_THROW(openSource("telepathy:x", "", factory), PluginError);
}

TEST_F(Opening, OpensARecord) {
  PluginFactory factory;
  const auto source = openSource("record:" + recordFile.string(), "", factory);
  EXPECT_EQ(source->worldFingerprint(), "room-1");
  Message message;
  ASSERT_TRUE(source->next(message));
  EXPECT_EQ(message, moments[0][0]);
}

}  // namespace
}  // namespace ortung::test
