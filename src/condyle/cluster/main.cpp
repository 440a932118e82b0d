/// condyle-mpi: a study by the ranks of a network. Exit codes as those of condyle.

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "condyle/app/interrupt.h"
#include "condyle/app/program.h"
#include "condyle/app/run_study.h"
#include "condyle/cluster/ranks.h"

namespace condyle {
namespace {

int run(Ranks& ranks, int argc, char** argv) {
  const auto setup = [&](CLI::App& program, int& status) {
    setup_team_study(program, status, ranks.team());
  };
  return run_program("condyle-mpi",
                     "condyle-mpi: a study of condyle by the ranks of mpirun or srun", {setup},
                     argc, argv);
}

}  // namespace
}  // namespace condyle

int main(int argc, char** argv) {
  condyle::Ranks ranks(argc, argv);
  // What rank 0 says is enough.
  if (ranks.rank() != 0 && std::freopen("/dev/null", "w", stdout) == nullptr)
    ranks.end_all("/dev/null cannot be opened");
  if (ranks.rank() == 0) condyle::tell_of_signals("condyle-mpi");
  std::string failure;
  try {
    return condyle::run(ranks, argc, argv);
  } catch (const std::bad_alloc&) {
    failure = "not enough memory";
  } catch (const std::exception& error) {
    failure = error.what();
  }
  if (ranks.rank() == 0) std::signal(SIGTERM, SIG_IGN);  // of mpirun, which ends all ranks
  ranks.end_all(failure);
}
