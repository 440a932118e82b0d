/// Titles and names are words of strangers: in nothing that the program writes are they markup, a path or a command.

#include <algorithm>

#include "app/run_program.h"

namespace condyle {
namespace {

using test::CommandLine;
using test::contents;
using test::Outcome;

namespace fs = std::filesystem;

const std::vector<std::string> kNasty = {
    R"(</script><script>alert(1)</script>)",
    R"("><img src=x onerror=alert(2)>)",
    R"(javascript:alert(3))",
    R"(' onload='alert(4))",
    R"(`touch pwned`)",
    R"($(touch pwned))",
    R"('; system('touch pwned'); set label ')",
    R"("; system("touch pwned"); ")",
    R"(@system %n%s%d {/Symbol a}_b^c ~a\n)",
    R"(\input{pwned}\immediate\write18{touch pwned})",
    R"(..\..\pwned)",
    R"(-rf)",
    R"(=cmd|'touch pwned'!A0)",
    R"(a xmlns='b id="c href='#d url(#e)",
};

/// As TOML's literal text in a basic string.
std::string toml(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// A name of a scene has no "/".
std::string as_name(std::string text) {
  for (char& c : text)
    if (c == '/') c = '|';
  return text;
}

/// A knee of four ligaments, every word of it nasty; with what moves what, as there is a page of it.
std::string scene_of(const std::string& nasty) {
  std::string text = with(contents(CONDYLE_SOURCE_DIR "/tests/results/format_0_1/journal.toml"),
                          "step = 0.001", "step = 10");
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  };
  replace("\"kept: journal\"", toml(nasty));
  for (const char* name :
       {"tibia", "femur", "ball", "plate", "medial", "aACL", "LCL", "bend", "weight"})
    replace('"' + std::string(name) + '"', toml(as_name(nasty) + " " + name));
  return text + "sensitivities = [\"*.stiffness\"]\n";
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

/// Tags with an attribute that runs something.
std::size_t running_tags(const std::string& text) {
  std::size_t n = 0;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const std::string tag = text.substr(at, text.find('>', at) - at);
    if (count(tag, "onload=") + count(tag, "onerror=") + count(tag, "=\"javascript:") > 0) ++n;
  }
  return n;
}

/// With the word and nothing after it but attributes.
std::size_t tags(const std::string& text, const std::string& word) {
  return count(text, word + ">") + count(text, word + " ");
}

std::string before_scripts(const std::string& page) {
  const std::size_t at = page.find("<script");
  return page.substr(0, at) + page.substr(std::min(page.size(), page.rfind("</script>")));
}

class NastyNames : public CommandLine, public testing::WithParamInterface<std::string> {};

TEST_P(NastyNames, AreNoMarkupNoPathAndNoCommand) {
  write("nasty.toml", scene_of(GetParam()));
  ASSERT_EQ(run("sweep nasty.toml -o run.h5").code, 0) << contents(folder_ / "stderr.txt");
  EXPECT_EQ(run("check nasty.toml").code, 0);
  EXPECT_EQ(run("verify run.h5").code, 0);
  const Outcome exported = run("export run.h5 -o out --format glb,csv,opensim,vtk,stl");
  EXPECT_EQ(exported.code, 0) << exported.err;
#ifdef CONDYLE_PICTURES
  EXPECT_EQ(run("plot run.h5 -o plots --format svg").code, 0) << contents(folder_ / "stderr.txt");
  const Outcome report = run("report run.h5 -o page.html");
  EXPECT_EQ(report.code, 0) << report.err;
  const std::string page = contents(folder_ / "page.html");
  ASSERT_FALSE(page.empty());
  const std::string rest = before_scripts(page);
  EXPECT_EQ(running_tags(rest), 0U);
  EXPECT_EQ(count(page, "<script>alert"), 0U);
  EXPECT_EQ(count(page, "<script"), count(page, "</script>"));
  for (const char* tag : {"g", "text", "svg"})
    EXPECT_EQ(tags(rest, std::string("<") + tag), tags(rest, std::string("</") + tag)) << tag;
  for (const auto& plot : fs::directory_iterator(folder_ / "plots")) {
    const std::string svg = contents(plot.path());
    EXPECT_NE(svg.find("</svg>"), std::string::npos) << plot.path();
    EXPECT_EQ(running_tags(svg) + count(svg, "<script"), 0U) << plot.path();
  }
#endif
  EXPECT_FALSE(fs::exists(folder_ / "pwned"));
  EXPECT_FALSE(fs::exists(folder_.parent_path() / "pwned"));
}

INSTANTIATE_TEST_SUITE_P(All, NastyNames, testing::ValuesIn(kNasty));

// XML takes no bytes that are no UTF-8.
TEST_F(CommandLine, ARunWhoseNameIsNoUtf8IsExportedUnderOneThatIs) {
  ASSERT_EQ(run("sweep knee.toml -o run.h5").code, 0);
  fs::rename(folder_ / "run.h5", folder_ / "caf\xe9 \xc3\xa9.h5");
  EXPECT_EQ(run("export 'caf\xe9 \xc3\xa9.h5' -o out --format vtk").code, 0);
  const fs::path surfaces = folder_ / "out" / "caf__\xc3\xa9_surfaces.pvd";
  ASSERT_TRUE(fs::exists(surfaces)) << contents(folder_ / "stdout.txt");
  EXPECT_EQ(contents(surfaces).find('\xe9'), std::string::npos);
}

#ifdef CONDYLE_PICTURES
// As a service or a shell may leave it: then nobody is told how another program ended.
TEST_F(CommandLine, PlotsWhereItsParentIgnoresTheEndOfChildren) {
  if (std::system("command -v gnuplot >/dev/null") != 0) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(run("sweep knee.toml -o run.h5").code, 0);
  const std::string plot = "cd '" + folder_.string() +
                           "' && perl -e '$SIG{CHLD} = \"IGNORE\"; exec @ARGV' '" CONDYLE_PROGRAM
                           "' plot run.h5 -o plots >plot.txt 2>&1";
  EXPECT_EQ(std::system(plot.c_str()), 0) << contents(folder_ / "plot.txt");
}
#endif

/// "\e]0;" would name the window, "\e[2J" wipe it; U+009B is the same as "\e[".
TEST_F(CommandLine, ShowsControlCharactersInsteadOfSendingThemToTheTerminal) {
  write("esc.toml", with(test::kScene, "ball and socket", "a\\u001b[2J\\u009b2Jb\\u007f\\u202ed"));
  const Outcome swept = run("sweep esc.toml -o run.h5");
  EXPECT_EQ(swept.code, 0) << swept.err;
  EXPECT_NE(swept.out.find("a\\u001b[2J\\u009b2Jb\\u007f\\u202ed\n"), std::string::npos)
      << swept.out;
  EXPECT_EQ(swept.out.find_first_of("\x1b\x7f"), std::string::npos);

  write("key.toml", "\"a\\u001b[2J\\n\" = 1\n" + test::kScene);
  const Outcome bad = run("sweep key.toml -o run.h5");
  EXPECT_EQ(bad.code, 1);
  EXPECT_EQ(bad.err.find('\x1b'), std::string::npos) << bad.err;
  EXPECT_EQ(count(bad.err, "\n"), 1U) << bad.err;
}

#ifdef CONDYLE_PICTURES
/// A program in place of ffmpeg: it is not told the name, which might be an option or a protocol of its own.
TEST_F(CommandLine, TellsFfmpegNoName) {
  write("ffmpeg",
        "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\ncat > /dev/null\n"
        "echo \"$@\" > asked\necho movie\n");
  fs::permissions(folder_ / "ffmpeg", fs::perms::owner_all);
  ASSERT_EQ(run("sweep knee.toml -o run.h5").code, 0);
  const Outcome outcome =
      run("render run.h5 -o knee:1.mp4 --movie --at 0,5 --view anterior --size 240x200",
          "PATH=.:$PATH ");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(contents(folder_ / "asked").find("knee"), std::string::npos)
      << contents(folder_ / "asked");
  EXPECT_EQ(contents(folder_ / "knee:1.mp4"), "movie\n");
}
#endif

/// Of two surfaces that would be in one file, one would be lost.
TEST_F(CommandLine, ExportsNoTwoSurfacesIntoOneFile) {
  std::string text = test::kScene;
  for (std::size_t at = 0; (at = text.find("\"ball\"", at)) != std::string::npos;)
    text.replace(at, 6, "\"a b\"");
  text = with(text, "[[contact]]",
              "[[surface]]\nname = \"a_b\"\nbody = \"femur\"\nkind = \"sphere\"\n"
              "center = [0, 60, 0]\nradius = 20\n\n[[contact]]");
  write("two.toml", text);
  ASSERT_EQ(run("sweep two.toml -o run.h5").code, 0);
  test::expect_bad_input(run("export run.h5 -o out --format stl"),
                         "out/run_stl/a_b.stl: two surfaces would be in this file, expected names "
                         "that differ in letters and digits");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace condyle
