/// The report of a study as a text.

#include "condyle/report/study_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "condyle/results/study_shown.h"
#include "condyle/results/study_words.h"
#include "support/made_up_study.h"

namespace condyle {
namespace {

std::string page_of_study(const StudyView& study, bool pictures = false) {
  StudyPageOptions options;
  options.pictures = pictures;
  return study_page(study, "study.h5", options);
}

bool has(const std::string& page, const std::string& words) {
  return page.find(words) != std::string::npos;
}

TEST(StudyPage, HoldsItsSectionsInOrder) {
  const std::string page = page_of_study(test::made_up_study());
  std::size_t at = 0;
  for (const char* id : {"status", "varied", "effects", "plots", "bands", "failures", "source"}) {
    const std::size_t found = page.find("<section id=\"" + std::string(id) + "\">");
    ASSERT_NE(found, std::string::npos) << id;
    EXPECT_GT(found, at) << id;
    at = found;
  }
  EXPECT_TRUE(has(page, "Study: 1024 samples, design saltelli, flexion from 0 to 120 deg"));
  EXPECT_TRUE(has(page, "normal, sd 0.02"));
  EXPECT_TRUE(has(page, "specimens = &quot;knees&quot; # &lt;all&gt;")) << "escaped";
}

TEST(StudyPage, FailuresThatDependOnANumberAreABias) {
  StudyView study = test::made_up_study(false);
  const std::string page = page_of_study(study);
  EXPECT_TRUE(has(page, "poses without a result depend on " + shown_parameters(study)[2] + "."));
  EXPECT_TRUE(has(page, std::string("240 ") + name(PoseStatus::kLeftPatch)));
  for (auto& shares : study.all.failures.by_quartile) shares = {0.03, 0.031, 0.03, 0.029};
  EXPECT_FALSE(has(page_of_study(study), "biased"));
  EXPECT_TRUE(has(page_of_study(study), "about as many in each quarter"));
  study.all.failures.failed = study.all.failures.incomplete = 0;
  EXPECT_FALSE(has(page_of_study(study), "<section id=\"failures\">"));
  EXPECT_TRUE(
      has(page_of_study(study), "<p class=\"verdict good\"><strong>25600 of 25600</strong>"));
}

// Three levels of a grid leave one quarter without samples.
TEST(StudyPage, AQuarterWithoutSamplesHidesNoBias) {
  StudyView study = test::made_up_study(false);
  for (auto& shares : study.all.failures.by_quartile) shares = {0.02, 0.02, 0.06, std::nan("")};
  EXPECT_TRUE(has(page_of_study(study), "biased"));
  for (auto& shares : study.all.failures.by_quartile) shares = {0.033, 0.032, 0.033, std::nan("")};
  EXPECT_FALSE(has(page_of_study(study), "biased"));
}

// Samples of a base point, and of one point in several knees, are as one for a number that they share.
TEST(StudyPage, SamplesThatShareANumberAreNoFurtherOnes) {
  StudyView study = test::made_up_study(false);
  for (auto& shares : study.all.failures.by_quartile) shares = {0.02, 0.02, 0.045, 0.045};
  ASSERT_TRUE(failures_depend_on(study, 0));
  study.points /= 16;  // so many knees
  EXPECT_FALSE(failures_depend_on(study, 0));
  study.points *= 16;
  study.design = "saltelli";
  EXPECT_FALSE(failures_depend_on(study, 0));
}

// Of four samples a correlation of -1 is chance.
TEST(StudyPage, ARankCorrelationThatMayBeChanceIsNotNamed) {
  StudyView study = test::made_up_study(false);
  const auto largest = [&](long samples, long knees) {
    study.points = samples;
    study.samples = samples * knees;
    for (StudyBand& band : study.all.bands) band.samples.assign(study.values.size(), study.samples);
    return largest_effects(study, 3, 0);
  };
  ASSERT_FALSE(largest(1024, 1).empty());
  const std::size_t first = largest(1024, 1)[0].parameter;
  study.all.effects[3].rank[first][0] = -1;
  EXPECT_TRUE(largest(10, 1).empty());
  EXPECT_TRUE(largest(10, 8).empty()) << "knees share the numbers of a point";
  ASSERT_EQ(largest(11, 1).size(), 1U);
  EXPECT_EQ(largest(11, 1)[0].value, -1);
  (void)largest(4, 1);
  EXPECT_EQ(study_lines(study).back(), std::string("  ") + kChanceRanks);
  EXPECT_TRUE(has(page_of_study(study), kChanceRanks));
  EXPECT_EQ(sweep_effects(study, 3).first[first], 0);
}

TEST(StudyPage, TellsWhatExplainsWhatTheGreatestFirst) {
  StudyView study = test::made_up_study();
  for (auto& by_parameter : study.all.effects[3].first)
    for (IndexEstimate& index : by_parameter) index = {0.001, 0, 0.01};
  for (IndexEstimate& index : study.all.effects[3].first[4]) index = {0.75, 0.7, 0.8};
  const std::string page = page_of_study(study);
  EXPECT_TRUE(has(page, "anterior drawer by aMCL strain (75 %)"));
  EXPECT_TRUE(has(page, "<td class=\"text\">aMCL strain 0.75</td>")) << "others are too small";
  const std::string others = page_of_study(test::made_up_study(false));
  EXPECT_TRUE(has(others, "Squares of rank correlations"));
  EXPECT_FALSE(has(others, "At some poses, with intervals"));
}

// Four samples may give a first index of 0.69 beside a total one of 0.21.
TEST(StudyPage, AnIndexThatMayBeAnythingIsNotNamed) {
  StudyView study = test::made_up_study();
  EXPECT_FALSE(has(page_of_study(study), kTooFewSamples));
  for (auto* indices : {&study.all.effects[3].first, &study.all.effects[3].total})
    for (IndexEstimate& index : (*indices)[4]) index = {0.99, 0.2, 1.3};
  const std::string page = page_of_study(study);
  EXPECT_TRUE(has(page, kTooFewSamples));
  EXPECT_FALSE(has(page, "anterior drawer by aMCL strain (99 %)"));
  EXPECT_TRUE(has(page, "anterior drawer by "));
  for (const EffectSize& effect : largest_effects(study, 3, 0)) EXPECT_NE(effect.parameter, 4U);
  const std::vector<std::string> lines = study_lines(study);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), std::string("  ") + kTooFewSamples), 1);
}

TEST(StudyPage, EffectsOverTheSweepAreWeightedByVariance) {
  StudyView study = test::made_up_study();
  std::vector<double>& sd = study.all.bands[0].sd;
  std::fill(sd.begin(), sd.end(), 0.0);
  sd[3] = 1;
  sd[7] = 2;
  study.all.effects[0].first[1][3].value = 0.5;
  study.all.effects[0].first[1][7].value = 0.1;
  EXPECT_NEAR(sweep_effects(study, 0).first[1], (0.5 + 4 * 0.1) / 5, 1e-15);
}

TEST(StudyPage, NumbersThatAreNoneBreakNothing) {
  StudyView study = test::made_up_study();
  for (StudyBand& band : study.all.bands) {
    band.mean.assign(band.mean.size(), std::nan(""));
    band.sd = band.mean;
    for (auto& quantile : band.quantiles) quantile = band.mean;
  }
  study.scenes = {"no TOML ["};
  EXPECT_FALSE(has(page_of_study(study), ">nan<"));
}

TEST(StudyPage, OfManyKneesOnlySomeScenesAreShown) {
  const std::string page = page_of_study(test::made_up_study(false, 6));
  EXPECT_TRUE(has(page, "6144 samples of 6 knees, 1024 of each"));
  EXPECT_TRUE(has(page, "And 3 scenes more"));
}

#ifdef CONDYLE_PICTURES
TEST(StudyPage, HasAllPlots) {
  const std::string page = page_of_study(test::made_up_study(), true);
  if (!has(page, "<svg")) GTEST_SKIP() << "gnuplot is not installed";
  std::size_t count = 0;
  for (std::size_t at = 0; (at = page.find("<figure class=\"plot\">", at)) != std::string::npos;
       ++at)
    ++count;
  EXPECT_EQ(count, 16U) << "three of bands, four of indices, failures, two maps at four poses";
}
#endif

}  // namespace
}  // namespace condyle
