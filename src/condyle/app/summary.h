#pragma once

/// How commands that compute begin (fit the patches) and end (a summary for scripts).

#include <chrono>
#include <string>
#include <vector>

#include "condyle/app/talk.h"
#include "condyle/report/summary_json.h"
#include "condyle/scene/fitted_surface.h"

namespace condyle {

/// The title, a progress line while patches are fitted, and how they came out; wraps of the scene that
/// ask for it are fitted to their bones.
[[nodiscard]] std::vector<FittedSurface> fit_aloud(const Talk& talk, Scene& scene);

/// The warnings of the fit and of the start pose, a line each on the standard error.
void tell_warnings(const Talk& talk, const Run& run);

/// Counts from when it is made.
class CommandClock {
 public:
  [[nodiscard]] CommandSummary summary(const Talk& talk,
                                       const std::string& output,
                                       int exit_code) const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Prints the JSON where it is asked for; returns the exit code.
int finish(const Talk& talk, const CommandSummary& summary, const Run& run);

}  // namespace condyle
