/// condyle: the equilibrium of a knee, from meshes to a sweep. Exit codes: 0 all done, 1 bad input,
/// 2 some pose did not succeed.

#include <cstdio>
#include <exception>
#include <new>
#include <vector>

#include "condyle/app/commands.h"
#include "condyle/app/interrupt.h"
#include "condyle/app/program.h"
#include "condyle/app/tell.h"

namespace condyle {
namespace {

std::vector<SetupCommand> commands() {
  return {setup_check,  setup_fit,       setup_sweep,      setup_compare,
          setup_laxity, setup_calibrate, setup_study,      setup_simulate,
          setup_export, setup_import,    setup_new,
#ifdef CONDYLE_PICTURES
          setup_render, setup_plot,
#endif
          setup_verify, setup_report,    setup_completion, setup_manual};
}

}  // namespace
}  // namespace condyle

int main(int argc, char** argv) {
  condyle::tell_of_signals("condyle");
  try {
    return condyle::run_program("condyle",
                                "condyle: positions of equilibrium of a knee, from its meshes",
                                condyle::commands(), argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("condyle: not enough memory\n", stderr);
  } catch (const std::exception& error) {  // InputError above all
    condyle::tell(stderr, "condyle: {}\n", condyle::printable_line(error.what()));
  }
  return condyle::kBadInput;
}
