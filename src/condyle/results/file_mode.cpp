#include "condyle/results/file_mode.h"

#include <sys/stat.h>

namespace condyle {

void take_mode(int descriptor, const std::filesystem::path& of, unsigned at_least) {
  struct stat state {};
  if (::stat(of.c_str(), &state) == 0 && S_ISREG(state.st_mode))
    (void)::fchmod(descriptor, (state.st_mode & 0777) | at_least);
}

}  // namespace condyle
