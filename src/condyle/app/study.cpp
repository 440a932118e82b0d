#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>
#include <string>

#include "condyle/app/commands.h"
#include "condyle/app/run_study.h"
#include "condyle/app/talk.h"

namespace condyle {
namespace {

/// "2/8"
bool read_part(const std::string& text, StudyPart& part) {
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, part.i);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/') return false;
  const auto second = std::from_chars(first.ptr + 1, end, part.n);
  return second.ec == std::errc() && second.ptr == end && part.i >= 1 && part.i <= part.n;
}

/// Empty ones are refused with a word of their own.
bool is_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, seed);
  return text.empty() || (error == std::errc() && at == end);
}

void add_part(CLI::App& command, StudyCommand& options) {
  command
      .add_option_function<std::string>(
          "--part",
          [&options](const std::string& text) {
            if (!read_part(text, options.part))
              throw CLI::ValidationError(
                  "--part", fmt::format("\"{}\", expected i/n with 1 <= i <= n, as 2/8", text));
          },
          "compute part i of n (\"2/8\") and leave it for --merge")
      ->type_name("TEXT");
}

}  // namespace

void add_study_options(CLI::App& command, StudyCommand& options) {
  constexpr long kMost = 1L << 53;
  command.add_option("STUDY", options.study, "study file (TOML)")->required();
  command.add_option("-o,--output", options.output, "result file to write (HDF5)")->required();
  command.add_option("--threads", options.threads, "how many; all cores where this is not given")
      ->check(CLI::Range(1, 4096));
  command.add_option("--samples", options.samples, "in place of the study's")
      ->check(CLI::Range(1L, kMost));
  command.add_option("--seed", options.seed, "of all random numbers, in place of the study's")
      ->check([](const std::string& text) {
        return is_seed(text) ? std::string()
                             : text + ", expected a whole number from 0 to 2^64 - 1";
      });
  add_part(command, options);
  command.add_flag("--merge", options.merge, "make the result of what parts have left");
  command.add_flag("--resume", options.resume, "go on from the chunks of a stopped run");
  command.add_option("--bands", options.bands, "table of the bands (CSV)");
  command.add_option("--indices", options.indices, "table of the indices (CSV)");
  command.add_option("--table", options.table, "table of all samples (CSV)");
}

void setup_team_study(CLI::App& program, int& status, const StudyTeam& team) {
  const auto options = std::make_shared<StudyCommand>();
  options->threads = 1;
  CLI::App* command = program.add_subcommand("study", "Sweep many samples of knees by all ranks");
  add_study_options(*command, *options);
  command->get_option("--threads")->description("of each rank (1)");
  add_talk_options(*command, options->talk);
  command->footer("Example: mpirun -n 4 condyle-mpi study study.toml -o out/study.h5");
  command->callback([options, &status, team] {
    if (!team.first()) {
      options->talk.quiet = true;
      options->talk.json = false;
    }
    status = run_telling_errors(options->talk, [&] { return run_study(*options, team); });
  });
}

void setup_study(CLI::App& program, int& status) {
  const auto options = std::make_shared<StudyCommand>();
  CLI::App* command =
      program.add_subcommand("study", "Sweep many samples of knees, and say what varies with what");
  add_study_options(*command, *options);
  add_talk_options(*command, options->talk);
  command->footer("Example: condyle study study.toml -o out/study.h5");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_study(*options); });
  });
}

}  // namespace condyle
