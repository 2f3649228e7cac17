#include "Serve.hpp"

#include "Console.hpp"
#include "Serving.hpp"
#include "SourceArguments.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/server/RecordedWorld.hpp"
#include "ortung/server/ServedRecord.hpp"

namespace ortung::app {

int runServe(const ServeArguments& arguments) {
  if (!arguments.serving.isServing())
    throw UsageError("--listen [ADDRESS:]PORT or --view is missing");
  checkPace(arguments.serving);
  warnOf(RecordSource(arguments.record));
  ServedRecord record(arguments.record, arguments.repeats);
  ClientRecords records(arguments.serving);
  RecordedWorld world(record, records.recordings(), {});
  serve(world, arguments.serving, {recordCommand(world)});
  return 0;
}

}  // namespace ortung::app
