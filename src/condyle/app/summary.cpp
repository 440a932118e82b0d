#include "condyle/app/summary.h"

#include <cstdio>

#include "condyle/app/print_fit.h"
#include "condyle/app/progress.h"
#include "condyle/app/tell.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/fit_wraps.h"
#include "condyle/version.h"

namespace condyle {

std::vector<FittedSurface> fit_aloud(const Talk& talk, Scene& scene) {
  say(talk, "{}\n\n", scene.title);
  Progress progress(talk, "patches");
  std::vector<FittedSurface> surfaces =
      fit_surfaces(scene, [&](int done, int total) { progress.at(done, total); });
  progress.clear();
  if (talk.plain()) print_fit(surfaces);
  fit_wraps(scene, surfaces);
  for (const std::string& line : describe_wrap_fits(scene)) say(talk, "{}\n\n", line);
  return surfaces;
}

void tell_warnings(const Talk& talk, const Run& run) {
  if (talk.quiet) return;
  for (const std::string& line : start_and_fit_warnings(run))
    tell(stderr, "condyle: warning: {}\n", line);
}

CommandSummary CommandClock::summary(const Talk& talk,
                                     const std::string& output,
                                     int exit_code) const {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
  CommandSummary summary;
  summary.command = talk.command;
  summary.version = CONDYLE_VERSION;
  summary.exit_code = exit_code;
  summary.seconds = passed.count();
  summary.output = output;
  return summary;
}

int finish(const Talk& talk, const CommandSummary& summary, const Run& run) {
  if (talk.json) tell("{}\n", json_summary(summary, run));
  return summary.exit_code;
}

}  // namespace condyle
