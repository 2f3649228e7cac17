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
            "record:run.rec: a record knows no option 'speed', but from_s and to_s");
  EXPECT_EQ(complaint("scanlog:x?path=y"), "scanlog:x: 'path' is no option of a source");
  EXPECT_THROW(openSource("telepathy:x", "", factory), PluginError);
}

TEST_F(Opening, AnUnknownKindIsToldWithThoseThatThereAreAndWithWhatIsBroken) {
  const TemporaryFolder plugins;
  writeBytes(plugins / "ortung_a.so", "text");
  writeBytes(plugins / "ortung_telepathy_source.so", "more text");
  PluginFactory factory({plugins.path()});
  const std::string why = ": is no 64-bit shared library";
  EXPECT_EQ(messageOf<PluginError>([&] { openSource("telepathy:x", "", factory); }),
            "telepathy:x: there is no kind of source 'telepathy', expected one of record"
            "; not loaded: " +
                (plugins / "ortung_a.so").string() + why +
                "; not loaded: " + (plugins / "ortung_telepathy_source.so").string() + why);
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
