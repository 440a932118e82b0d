/// Pictures of a fit, as a user asks for them.

#include "app/run_program.h"
#include "condyle/pictures/png_file.h"

namespace condyle {
namespace {

using test::CommandLine;
using test::expect_bad_input;
using test::Outcome;

const std::string kPhantom = CONDYLE_SOURCE_DIR "/data/phantom/knee.toml";

TEST_F(CommandLine, NamesAFolderForPicturesThatCannotBeMadeBeforeItFits) {
  expect_bad_input(run("fit '" + kPhantom + "' -o fit.h5 --pictures no/such/folder"),
                   "no/such/folder: the folder no/such does not exist");
  expect_bad_input(run("fit '" + kPhantom + "' -o fit.h5 --pictures fit.png"),
                   "fit.png: is the name of one file, expected a folder for several");
  EXPECT_TRUE(results().empty());
}

TEST_F(CommandLine, DrawsTheFit) {
  const Outcome fit = run("fit '" + kPhantom + "' -o fit.h5 --pictures maps");
  EXPECT_EQ(fit.code, 0) << fit.err;
  for (const char* half : {"medial", "lateral"})
    for (const char* part : {"_condyle", "_plateau"})
      for (const char* what : {"_deviation.png", "_curvature.png"}) {
        const std::string file = std::string("maps/") + half + part + what;
        EXPECT_NE(fit.out.find("wrote " + file), std::string::npos) << file;
        const Image image = read_png(at(file));
        EXPECT_GE(image.width, 650) << file;
        EXPECT_GE(image.height, 660) << file;
      }
}

}  // namespace
}  // namespace condyle
