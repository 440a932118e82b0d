#pragma once

/// The subcommands of condyle, each in a file of its own. A setup function adds its subcommand to
/// the program; when that is called it puts its exit code into `status`: 0 all done, 2 some pose
/// did not succeed. Bad input leaves as an exception.

namespace CLI {
class App;
}

namespace condyle {

inline constexpr int kSomePoseFailed = 2;

void setup_check(CLI::App& program, int& status);
void setup_fit(CLI::App& program, int& status);
void setup_sweep(CLI::App& program, int& status);
void setup_compare(CLI::App& program, int& status);
void setup_laxity(CLI::App& program, int& status);
void setup_calibrate(CLI::App& program, int& status);
void setup_study(CLI::App& program, int& status);
void setup_simulate(CLI::App& program, int& status);
void setup_export(CLI::App& program, int& status);
void setup_import(CLI::App& program, int& status);
void setup_new(CLI::App& program, int& status);
void setup_render(CLI::App& program, int& status);  // built with CONDYLE_PICTURES only
void setup_plot(CLI::App& program, int& status);    // built with CONDYLE_PICTURES only
void setup_verify(CLI::App& program, int& status);
void setup_report(CLI::App& program, int& status);
void setup_completion(CLI::App& program, int& status);  // of a shell, for the other commands
void setup_manual(CLI::App& program, int& status);

}  // namespace condyle
