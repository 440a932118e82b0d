/// The page as a text: what stands in it and where, that it is whole, and that no scene can break
/// it.

#include "condyle/report/report_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <regex>

#include "condyle/report/embedded.h"
#include "condyle/results/digest.h"
#include "results/made_up_run.h"
#include "support/block_knee.h"

namespace condyle {
namespace {

constexpr const char* kNasty = "</script><script>alert(1)</script> & \"x\" <b>";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

/// The page without the program of the 3-D view, which holds all sorts of texts.
std::string without_program(std::string page) {
  const std::string_view program = viewer_script();
  const std::size_t at = program.empty() ? std::string::npos : page.find(program);
  return at == std::string::npos ? page : page.erase(at, program.size());
}

int digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::string decoded(const std::string& text) {
  std::string bytes;
  int bits = 0, held = 0;
  for (const char c : text) {
    if (c == '=') break;
    EXPECT_GE(digit(c), 0) << "no base64: " << static_cast<int>(c);
    bits = (bits << 6 | digit(c)) & 0xffffff;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xff);
  }
  return bytes;
}

/// Texts between `before` and the next `after`.
std::vector<std::string> between(const std::string& page, const std::string& before, char after) {
  std::vector<std::string> found;
  for (std::size_t at = 0; (at = page.find(before, at)) != std::string::npos;) {
    at += before.size();
    found.push_back(page.substr(at, page.find(after, at) - at));
  }
  return found;
}

ReportOptions words_only() {
  ReportOptions options;
  options.pictures = options.viewer = false;
  return options;
}

TEST(Base64, IsThatOfTheStandard) {
  // The test vectors of RFC 4648, section 10.
  const std::array<std::pair<const char*, const char*>, 5> vectors = {
      {{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
}

TEST(ReportPage, BeginsWithStatusAndWarnings) {
  condyle::Run run = block_run();
  run.sweep.poses[1] = PoseResult{};
  run.sweep.poses[1].value = 0.5;
  run.sweep.poses[1].status = PoseStatus::kNoEquilibrium;
  run.sweep.poses[1].reason = "nothing carries \"weight\"";
  run.start = {"warning: LCL: 20 % strain", "all else is well"};
  run.sweep.poses[2].remark = "contact \"medial\", held open, overlaps by 16 mm";
  const std::string page = report_page(run, "run.h5", words_only());
  const std::size_t status = page.find("<section id=\"status\">");
  ASSERT_NE(status, std::string::npos);
  EXPECT_EQ(page.find("<section"), status);
  const std::string first = page.substr(status, page.find("</section>", status) - status);
  EXPECT_NE(first.find("<strong>2 of 3</strong>"), std::string::npos) << first;
  EXPECT_NE(first.find("nothing carries &quot;weight&quot;"), std::string::npos);
  EXPECT_NE(first.find("<li>LCL: 20 % strain</li>"), std::string::npos);
  EXPECT_EQ(first.find("all else is well"), std::string::npos);
  EXPECT_NE(first.find("57.2958 deg: contact &quot;medial&quot;, held open, overlaps by 16 mm"),
            std::string::npos)
      << first;
  EXPECT_NE(first.find("docs/questions.md, Why did this pose fail?"), std::string::npos);
}

TEST(ReportPage, HoldsTheNumbersOfTheRun) {
  condyle::Run run = block_run();
  run.inputs = {{"femur.stl", std::string(64, 'a')}};
  run.program = "condyle 9.9.9";
  run.sweep.events = {{0.25, EventKind::kOpening, 1}};
  run.scene.text = "title = \"Blocks\" # a & b";
  const std::string page = report_page(run, "some/run.h5", words_only());
  EXPECT_NE(page.find("<td>28.6479</td>"), std::string::npos);  // 0.5 rad in deg, as swept
  EXPECT_NE(page.find("<td>200.0</td>"), std::string::npos);    // force of the medial contact [N]
  // An opening of the lateral contact at 0.25 rad = 14.3239 deg.
  EXPECT_NE(page.find("14.3239"), std::string::npos);
  EXPECT_NE(page.find("opening"), std::string::npos);
  EXPECT_NE(page.find(std::string(64, 'a')), std::string::npos);
  EXPECT_NE(page.find("condyle 9.9.9"), std::string::npos);
  EXPECT_NE(page.find("some/run.h5"), std::string::npos);
  EXPECT_NE(page.find("title = &quot;Blocks&quot; # a &amp; b"), std::string::npos);
  for (const char* id : {"poses", "events", "contacts", "ligaments", "solver", "source"})
    EXPECT_EQ(count(page, std::string("<section id=\"") + id + "\">"), 1U) << id;
}

TEST(ReportPage, TablesHoldPosesBeyondAnEdgeMarked) {
  condyle::Run run = block_run();
  run.sweep.poses[1].status = PoseStatus::kLeftPatch;
  run.sweep.poses[1].contacts[0].points[0].edge_distance = -2.76;
  const std::string page = report_page(run, "run.h5", words_only());
  const std::string mark = "closed, 2.8 mm beyond the edge";
  EXPECT_EQ(count(page, mark), 1U);
  const std::size_t row = page.rfind("<tr", page.find(mark));
  EXPECT_EQ(page.substr(row, 19), "<tr class=\"failed\">");
  // In the tables of poses, contacts (two), and forces and strains of ligaments.
  EXPECT_EQ(count(page, "<tr class=\"failed\">"), 5U);
  run.sweep.poses[1].status = PoseStatus::kSingular;
  EXPECT_EQ(count(report_page(run, "run.h5", words_only()), "<tr class=\"failed\">"), 1U);
}

TEST(ReportPage, TellsByWhichWayPosesWereFound) {
  const std::string page = report_page(made_up_run(), "run.h5", words_only());
  EXPECT_NE(page.find("in 3 parts, with descents from the pose after it: 2."), std::string::npos);
  // 0.3, 0.3², 0.3⁴ of the first pose, with a bar each.
  EXPECT_NE(
      page.find("<td class=\"text\">3.0e-01, 9.0e-02, 8.1e-03</td><td class=\"text\">█▇▇</td>"),
      std::string::npos);
  EXPECT_EQ(report_page(block_run(), "run.h5", words_only()).find("each pose was found"),
            std::string::npos);
}

TEST(ReportPage, TellsHowThePatchesFit) {
  const std::string page = report_page(made_up_run(), "run.h5", words_only());
  EXPECT_NE(page.find("<section id=\"fit\">"), std::string::npos);
  EXPECT_NE(page.find("<td>5 x 4</td><td>0.050</td><td>0.100</td><td>0.200</td>"),
            std::string::npos);
  EXPECT_NE(page.find("ball: 2 strays dropped"), std::string::npos);
}

TEST(ReportPage, SaysWhatIsLeftOut) {
  const std::string page = report_page(block_run(), "run.h5", words_only());
  EXPECT_NE(page.find("Left out on request."), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
}

TEST(ReportPage, IsNotBrokenByWhatASceneIsCalled) {
  condyle::Run run = block_run();
  run.scene.title = run.scene.text = kNasty;
  for (auto& ligament : run.scene.ligaments) ligament.name += kNasty;
  for (auto& contact : run.scene.contacts) contact.name += kNasty;
  for (auto& body : run.scene.bodies) body.name += kNasty;
  for (std::size_t i = 0; i < 2; ++i) run.bodies[i].name = run.scene.bodies[i].name;
  run.scene.conditions[0].name = run.scene.sweep->vary = kNasty;
  run.sweep.poses[2].remark = kNasty;
  const std::string page = report_page(run, kNasty);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  const std::string rest = without_program(page);
  EXPECT_EQ(count(rest, "<script"), count(rest, "</script>"));
  EXPECT_EQ(count(rest, "<script"), viewer_script().empty() ? 0U : 3U);
}

TEST(ReportPage, CarriesAllItShows) {
  const std::string page = report_page(block_run(), "run.h5");
  const std::string rest = without_program(page);
  for (const char* outside : {"src=\"http", "href=\"http", "src='http", "href='http", "url(http",
                              "@import", "src=\"//", "src=\"file"})
    EXPECT_EQ(rest.find(outside), std::string::npos) << outside;
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  for (const std::string& picture : between(page, "data:image/png;base64,", '"')) {
    const std::string bytes = decoded(picture);
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
    EXPECT_EQ(base64(bytes), picture);
  }
  EXPECT_EQ(viewer_script().find("</script"), std::string::npos);
  if (viewer_script().empty()) GTEST_SKIP() << "built without the 3-D view";
  const std::vector<std::string> models = between(page, "id=\"viewer-model\">", '<');
  ASSERT_EQ(models.size(), 1U);
  const std::string model = decoded(models[0]);
  EXPECT_EQ(model.substr(0, 4), "glTF");
  // The third word of a .glb is its length.
  ASSERT_GE(model.size(), 12U);
  std::uint32_t length = 0;
  std::copy_n(model.data() + 8, 4, reinterpret_cast<char*>(&length));
  EXPECT_EQ(length, model.size());
}

TEST(ReportPage, TheViewerKnowsWhatIsWrongAndWhatIsMissing) {
  if (viewer_script().empty()) GTEST_SKIP() << "built without the 3-D view";
  condyle::Run run = block_run();
  run.sweep.poses.push_back(run.sweep.poses[2]);
  run.sweep.poses[3].value = run.sweep.poses[3].joint.flexion = 1.5;
  run.sweep.poses[3].ligaments[0].strain = 0.5;
  run.sweep.poses[1].status = PoseStatus::kSingular;
  run.sweep.poses[2].status = PoseStatus::kLeftPatch;
  run.sweep.poses[2].reason = "2 mm beyond the notch side";
  const std::string page = report_page(run, "run.h5");
  EXPECT_NE(page.find("\"alarms\":[\"\",\"left patch: 2 mm beyond the notch side\",\"\"]"),
            std::string::npos);
  EXPECT_NE(page.find("\"missing\":[1,0]"), std::string::npos);
  EXPECT_NE(page.find("\"strain_top\":0.1,\"greatest_strain\":0.5"), std::string::npos);
}

#ifdef CONDYLE_PICTURES
TEST(ReportPage, ShowsPicturesAndPlots) {
  const std::string page = report_page(block_run(), "run.h5");
  EXPECT_EQ(count(page, "<img "), 4U);  // two strips, the plateau and the condyles
  condyle::Run left = block_run();
  left.sweep.poses[1].status = PoseStatus::kLeftPatch;
  EXPECT_EQ(count(report_page(left, "run.h5"), "<img "), 6U)
      << "both of the pose that is no result";
  EXPECT_GE(count(page, "<svg"), 3U);  // coordinates, contacts, ligaments
  EXPECT_EQ(count(page, "<svg"), count(page, "</svg>"));
  EXPECT_EQ(page.find("<?xml"), std::string::npos);
  EXPECT_EQ(without_program(page).find("xmlns"), std::string::npos);
  // Names in one plot are not those of another.
  std::vector<std::string> names;
  const std::string rest = without_program(page);
  const std::regex id("<g id=\"([^\"]+)\"");
  for (std::sregex_iterator it(rest.begin(), rest.end(), id), end; it != end; ++it)
    names.push_back((*it)[1]);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}
#endif

TEST(ReportPage, KnowsRunsWithoutPoses) {
  condyle::Run run = made_up_run();
  run.sweep = {};
  const std::string page = report_page(run, "fit.h5");
  EXPECT_NE(page.find("Fit of the surfaces"), std::string::npos);
  EXPECT_EQ(page.find("<section id=\"poses\">"), std::string::npos);
  EXPECT_EQ(page.find("<section id=\"view\">"), std::string::npos);
}

}  // namespace
}  // namespace condyle
