/// Runs beside each other: what is compared, what is said of the rest, and that no name breaks the page.

#include "condyle/report/compared_runs_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "condyle/input_error.h"
#include "condyle/math/round_ticks.h"
#include "condyle/report/compared_runs_json.h"
#include "condyle/report/compared_words.h"
#include "condyle/report/svg_curves.h"
#include "results/made_up_run.h"
#include "support/block_knee.h"

namespace condyle {
namespace {

constexpr const char* kNastyRun = "</script><script>alert(1)</script> & \"x\" <b>";

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string all_words(const RunComparison& comparison) {
  std::string text;
  for (const std::string& line : words_of(comparison)) text += line + "\n";
  return text;
}

RunComparison compared(const std::vector<const condyle::Run*>& runs) {
  std::vector<ComparedRun> named;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string name(1, static_cast<char>('A' + static_cast<int>(i)));
    named.push_back({name, name + ".h5", runs[i]});
  }
  return compare_runs(named);
}

const ComparedCurve& curve_named(const RunComparison& comparison,
                                 const std::string& group,
                                 const std::string& name) {
  for (const ComparedCurve& curve : comparison.curves)
    if (curve.group == group && curve.name == name) return curve;
  throw std::runtime_error("no curve " + group + " " + name);
}

std::string words_of_page(const RunComparison& comparison) {
  ComparedRunsPageOptions options;
  options.pictures = false;
  return compared_runs_page(comparison, options);
}

TEST(ComparedRuns, TheGreatestDifferenceIsToldWithItsPlace) {
  const condyle::Run a = block_run();
  condyle::Run b = block_run();
  b.sweep.poses[1].contacts[0].force = 150;
  const RunComparison comparison = compared({&a, &b});
  const auto& d = curve_named(comparison, "Contact force [N]", "medial").differences[1];
  ASSERT_TRUE(d);
  EXPECT_DOUBLE_EQ(d->largest, -50);
  EXPECT_NEAR(d->at, 28.6479, 1e-4);  // 0.5 rad
  EXPECT_EQ(d->count, 3);
  EXPECT_NEAR(d->rms, 50 / std::sqrt(3.0), 1e-12);
  const std::string page = words_of_page(comparison);
  EXPECT_TRUE(says(page, "Contact force, medial: -50 N at 28.6479°")) << page;
  EXPECT_TRUE(says(page, "<td>-50</td><td>28.6479</td><td>28.9</td><td>3 (0)</td>"));
  EXPECT_EQ(all_words(comparison), "");
}

TEST(ComparedRuns, SayHowOtherPlacesAreMetAndNeverCrossFailedPoses) {
  const condyle::Run a = block_run();
  condyle::Run b = block_run();
  b.sweep.poses[1].value = 0.25;
  b.sweep.poses[2].value = 0.75;
  condyle::Run c = block_run();
  c.sweep.poses[1].status = PoseStatus::kSingular;
  c.sweep.poses[1].reason = "nothing holds it";
  const RunComparison comparison = compared({&a, &b, &c});
  const auto& force = curve_named(comparison, "Contact force [N]", "medial");
  // 0, 0.25, 0.5, 0.75: where both are; at 1 the second has ended.
  EXPECT_EQ(force.differences[1]->count, 4);
  EXPECT_EQ(force.differences[1]->interpolated, 3);
  EXPECT_EQ(force.differences[2]->count, 2);
  EXPECT_TRUE(says(all_words(comparison), "B and C have results at other values than A"));
  const std::string page = words_of_page(comparison);
  EXPECT_TRUE(says(page, "nothing holds it"));
  EXPECT_FALSE(says(page, "Hollow circles"));
  c.sweep.poses[1].status = PoseStatus::kLeftPatch;
  const std::string left = words_of_page(compared({&a, &c}));
  EXPECT_TRUE(says(left, "Hollow circles"));
  EXPECT_TRUE(says(left, "class=\"point run2 hollow\""));
  EXPECT_TRUE(says(page, "<tr class=\"failed\"><td class=\"text\">C</td>"));
}

TEST(ComparedRuns, SideAndNamesThatOnlySomeHaveAreSaid) {
  const condyle::Run right = block_run();
  condyle::Run left = block_run(-1);
  left.scene.ligaments[0].name = "other";
  const RunComparison comparison = compared({&right, &left});
  const std::string words = all_words(comparison);
  EXPECT_TRUE(says(words, "A is right, B left")) << words;
  EXPECT_TRUE(says(words, "Only in A: LCL (ligament force, ligament strain).")) << words;
  EXPECT_TRUE(says(words, "Only in B: other (ligament force, ligament strain).")) << words;
  EXPECT_TRUE(says(words_of_page(comparison), "<svg class=\"curves\""));
}

TEST(ComparedRuns, OfOtherSweptQuantitiesOnlyRangesAreCompared) {
  const condyle::Run flexed = block_run();
  condyle::Run pulled = block_run();
  LoadDescription load;
  load.name = "drawer";
  load.vector = {100, 0, 0};
  pulled.scene.loads = {load};
  pulled.scene.sweep = SweepDescription{true, 0, "drawer.scale", {0, 0.5, 1}};
  const RunComparison comparison = compared({&flexed, &pulled});
  EXPECT_TRUE(says(all_words(comparison), "B goes over drawer [N], A over Flexion [°]"));
  const std::string page = words_of_page(comparison);
  EXPECT_FALSE(says(page, "B minus A"));
  EXPECT_TRUE(says(page, "200 to 200"));
}

#ifdef CONDYLE_PICTURES
TEST(ComparedRuns, AreShownBesideEachOtherAtTheSamePlaces) {
  const condyle::Run a = block_run();
  condyle::Run b = block_run(), c = block_run();
  b.sweep.poses[0].status = PoseStatus::kSingular;
  for (PoseResult& pose : c.sweep.poses) pose.status = PoseStatus::kSingular;
  const std::string page = compared_runs_page(compared({&a, &b, &c}));
  EXPECT_EQ(count_of(page, "<img "), 2U) << "of a run without results there is nothing to show";
  EXPECT_TRUE(says(page, "<figcaption>A, medial view: Flexion 0°, 28.6°, 57.3°</figcaption>"));
  EXPECT_TRUE(says(page, "<figcaption>B, medial view: Flexion 28.6°, 57.3°</figcaption>"));
}
#endif

TEST(ComparedRuns, WithoutAnyResultIsSaid) {
  const condyle::Run a = block_run();
  condyle::Run b = block_run();
  for (PoseResult& pose : b.sweep.poses) pose.status = PoseStatus::kNoEquilibrium;
  const RunComparison comparison = compared({&a, &b});
  EXPECT_EQ(all_words(comparison),
            "No pose of B has a result: there is nothing of it to compare.\n");
  EXPECT_FALSE(says(words_of_page(comparison), "nan"));
}

TEST(ComparedRuns, ThatCannotBeComparedAreRefusedInOneLine) {
  const condyle::Run a = block_run();
  condyle::Run fit = made_up_run();
  fit.sweep = {};
  const auto refusal = [&](const std::vector<const condyle::Run*>& runs) -> std::string {
    try {
      (void)compared(runs);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({&a, &fit}), "B.h5: holds no poses, expected runs with poses to compare");
  EXPECT_EQ(refusal({&a}), "1 runs to compare, expected 2 to 6");
  condyle::Run moved = block_run();
  moved.scene.conditions[0].kind = ConditionKind::kAnteriorDrawer;
  EXPECT_EQ(refusal({&a, &moved}),
            "B.h5: sweeps flexion in mm, but A.h5 in deg: expected the same units");
}

TEST(ComparedRuns, NoNameBreaksThePage) {
  std::vector<condyle::Run> runs(2, block_run());
  for (condyle::Run& run : runs) {
    run.scene.title = kNastyRun;
    run.scene.text = std::string("title = '") + kNastyRun + (&run == runs.data() ? "'\n" : " '\n");
    for (auto& ligament : run.scene.ligaments) ligament.name += kNastyRun;
    for (auto& contact : run.scene.contacts) contact.name += kNastyRun;
    run.scene.conditions[0].name = run.scene.sweep->vary = kNastyRun;
    run.sweep.poses[2].status = PoseStatus::kSingular;
    run.sweep.poses[2].reason = kNastyRun;
    run.inputs = {{kNastyRun, kNastyRun + std::string(&run == runs.data() ? "1" : "2")}};
    run.program = run.created = kNastyRun;
  }
  const RunComparison comparison =
      compare_runs({{kNastyRun, kNastyRun, runs.data()}, {kNastyRun, kNastyRun, &runs[1]}});
  const std::string page = compared_runs_page(comparison);
  EXPECT_EQ(count_of(page, "<script"), 0U);
  EXPECT_EQ(count_of(page, "<b>"), 0U);
  EXPECT_EQ(count_of(page, "</style"), 1U);
  EXPECT_TRUE(says(page, "default-src 'none'"));
}

TEST(ComparedRuns, AreToldToScripts) {
  condyle::Run a = block_run(), b = block_run();
  a.scene.text = "k = 1\n";
  b.scene.text = "k = 2\n";
  b.sweep.poses[2].ligaments[0].force = 40;
  CommandSummary summary;
  summary.command = "report";
  const auto json = nlohmann::json::parse(json_compared_runs(summary, compared({&a, &b})));
  EXPECT_EQ(json["runs"][1]["name"], "B");
  EXPECT_EQ(json["over"], "Flexion [°]");
  EXPECT_EQ(json["scene_differences"][0]["values"][1], "2");
  for (const auto& row : json["differences"]) {
    if (row["what"] != "Ligament force" || row["of"] != "LCL") continue;
    EXPECT_EQ(row["largest"], 10);
    EXPECT_EQ(row["units"], "N");
    return;
  }
  ADD_FAILURE() << "no difference of LCL: " << json;
}

TEST(SvgCurves, TicksAreRoundAndWithin) {
  EXPECT_EQ(round_ticks(0, 120, 6), (std::vector<double>{0, 20, 40, 60, 80, 100, 120}));
  EXPECT_EQ(round_ticks(-0.3, 0.31, 5), (std::vector<double>{-0.2, 0, 0.2}));
  EXPECT_TRUE(round_ticks(1, 1, 5).empty());
  EXPECT_TRUE(round_ticks(1e7, 10000000.000000002, 5).empty());  // one step of doubles
  EXPECT_TRUE(round_ticks(1e17, 1e17 + 32, 5).empty());
}

TEST(SvgCurves, LinesEndWhereThereIsNoValueAndOfNoCurveThereIsNoDrawing) {
  Curve curve{"a", {0, 1, 2, 3, 4}, {1, 2, std::nan(""), 4, 5}};
  const std::string drawing = svg({"what", "x", false, {std::nullopt, curve}});
  EXPECT_EQ(count_of(drawing, "class=\"line run2\""), 1U);
  const std::size_t path = drawing.find("d=\"", drawing.find("class=\"line run2\""));
  const std::string d = drawing.substr(path + 3, drawing.find('"', path + 3) - path - 3);
  EXPECT_EQ(count_of(d, "M"), 2U) << d;
  EXPECT_EQ(svg({"what", "x", false, {std::nullopt, Curve{"a", {0}, {std::nan("")}}}}), "");
}

}  // namespace
}  // namespace condyle
