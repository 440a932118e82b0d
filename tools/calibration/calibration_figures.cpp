/// condyle_calibration_figures: what fits of knees to made measurements give back of a truth that is
/// known. Prints the tables of docs/calibration.md.
///
///   condyle_calibration_figures SOURCE [--parts exact,spring,phantom,lenhart,wrong] [--draws N]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "calibration/draws.h"
#include "condyle/calibration/agreement.h"

namespace condyle::calibration_study {
namespace {

namespace fs = std::filesystem;

const std::vector<double> kFlexions = {0, 15, 30, 60, 90};

TestPlan full_plan() {
  TestPlan plan;
  plan.flexions = kFlexions;
  return plan;
}
/// Only the displacement that is loaded, at full load.
TestPlan main_plan() {
  TestPlan plan;
  plan.flexions = kFlexions;
  plan.fractions = {-1, -0.5, 0.5, 1};
  plan.all_coordinates = false;
  return plan;
}
TestPlan unseen_plan(TestPlan plan) {
  plan.flexions = {45, 75};
  plan.fractions = {-0.75, 0.75};
  plan.all_coordinates = true;
  return plan;
}

double median(std::vector<double> numbers) {
  if (numbers.empty()) return std::nan("");
  std::nth_element(numbers.begin(), numbers.begin() + static_cast<long>(numbers.size() / 2),
                   numbers.end());
  return numbers[numbers.size() / 2];
}

template <class Get>
std::vector<double> all_of(const Draws& draws, Get get) {
  std::vector<double> numbers;
  for (const DrawOutcome& outcome : draws.outcomes) numbers.push_back(get(outcome));
  return numbers;
}
template <class Get>
double mean_of(const Draws& draws, Get get) {
  double sum = 0;
  int count = 0;
  for (const double number : all_of(draws, get)) {
    if (!std::isfinite(number)) continue;
    sum += number;
    ++count;
  }
  return sum / count;
}
template <class Get>
double greatest_of(const Draws& draws, Get get) {
  const std::vector<double> numbers = all_of(draws, get);
  return numbers.empty() ? std::nan("") : *std::max_element(numbers.begin(), numbers.end());
}

double milliseconds(const DrawOutcome& outcome) { return 1e3 * outcome.fit.seconds; }

void print_head() {
  fmt::print(
      "| fit | free | numbers | determined | steps | ms a fit, median (most) | intervals that hold "
      "the truth, % "
      "(one number, least to most) | unseen tests, sd: before, after | their intervals, % | "
      "chi²/(n - "
      "eff), beyond its 97.5 % limit | draws (drawn again, not converged) |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void print_row(const std::string& name, const Draws& draws) {
  if (draws.outcomes.empty()) {
    fmt::print("| {} | {} | {} | | | | | | | | 0 ({}, {}) |\n", name, draws.parameters.size(),
               draws.rows, draws.skipped, draws.failed);
    return;
  }
  const Coverage coverage = coverage_of(draws);
  int beyond = 0;
  for (const DrawOutcome& outcome : draws.outcomes)
    beyond +=
        outcome.reduced_chi_square >
                reduced_chi_square_limit(static_cast<double>(draws.rows) - outcome.known.effective)
            ? 1
            : 0;
  fmt::print(
      "| {} | {} | {} | {:.1f} | {:.1f} | {:.3g} ({:.3g}) | {:.1f} ({:.0f} to {:.0f}) | {:.2f}, "
      "{:.2f} | "
      "{:.1f} | {:.2f}, {} % | {} ({}, {}) |\n",
      name, draws.parameters.size(), draws.rows,
      mean_of(draws, [](const DrawOutcome& o) { return double(o.known.determined); }),
      mean_of(draws, [](const DrawOutcome& o) { return double(o.fit.iterations); }),
      median(all_of(draws, milliseconds)), greatest_of(draws, milliseconds), 100 * coverage.pooled,
      100 * coverage.least, 100 * coverage.most,
      mean_of(draws, [](const DrawOutcome& o) { return o.unseen_before; }),
      mean_of(draws, [](const DrawOutcome& o) { return o.unseen_after; }),
      100 * mean_of(draws, [](const DrawOutcome& o) { return o.covered_unseen; }),
      mean_of(draws, [](const DrawOutcome& o) { return o.reduced_chi_square; }),
      100 * beyond / static_cast<int>(draws.outcomes.size()), draws.outcomes.size(), draws.skipped,
      draws.failed);
  std::fflush(stdout);
}

DrawPlan plan_of(const TestPlan& tests, int draws) {
  DrawPlan plan;
  plan.fitted = tests;
  plan.unseen = unseen_plan(tests);
  plan.draws = draws;
  return plan;
}

/// Largest errors in prior sds of fits that explain what was measured: of what the data determine
/// (singular values above 1e-3), and of all numbers.
struct ExactErrors {
  double in_known = 0, all = 0, determined = 0;
  int explained = 0, at_once = 0;  ///< fits that explain the rows; those from the scene's numbers
};

ExactErrors exact_errors(const Draws& draws, double prior) {
  ExactErrors errors;
  for (const DrawOutcome& outcome : draws.outcomes) {
    int known = 0;
    for (const double singular : outcome.known.singular_values) known += singular >= 1e-3 * prior;
    errors.determined += known / static_cast<double>(draws.outcomes.size());
    if (outcome.fit.y.size() == 0 || !(outcome.fit.cost <= kNoCost)) continue;
    ++errors.explained;
    errors.at_once += outcome.starts == 1;
    Eigen::VectorXd error = outcome.fit.theta - outcome.truth;
    for (Eigen::Index j = 0; j < error.size(); ++j) error[j] /= draws.parameters[j].prior_sd;
    const Eigen::VectorXd turned = outcome.known.directions.transpose() * error;
    for (Eigen::Index j = 0; j < turned.size(); ++j)
      if (outcome.known.singular_values[j] >= 1e-3 * prior)
        errors.in_known = std::max(errors.in_known, std::abs(turned[j]));
    errors.all = std::max(errors.all, error.cwiseAbs().maxCoeff());
  }
  return errors;
}

/// Truths without noise, fitted without prior.
void print_exact(const std::string& name,
                 const StudyKnee& knee,
                 const TestPlan& tests,
                 double truth,
                 int count) {
  DrawPlan plan = plan_of(tests, count);
  plan.noise = 0;
  plan.truth = truth;
  plan.prior = 1e6;
  plan.starts = 8;
  const Draws draws = draw_and_fit(knee, knee, plan);
  const ExactErrors errors = exact_errors(draws, plan.prior);
  fmt::print("| {} | {} | {} | {:.1f} | {} of {} ({}) | {:.1e} | {:.1e} | {:.1f} | {} |\n", name,
             draws.parameters.size(), draws.rows, errors.determined, errors.explained,
             draws.outcomes.size(), errors.at_once, errors.in_known, errors.all,
             mean_of(draws, [](const DrawOutcome& o) { return double(o.fit.iterations); }),
             draws.failed);
  std::fflush(stdout);
}

StudyKnee spring_knee(const fs::path& source, bool stiffness = false, bool insertions = false) {
  StudyKnee knee = study_knee(source / "data/wismans-type/knee.toml");
  free_numbers(knee, ParameterKind::kReferenceStrain, 0.03);
  if (stiffness) free_numbers(knee, ParameterKind::kStiffness, 0.3);
  if (insertions)
    for (const int body : {0, 1}) free_numbers(knee, ParameterKind::kInsertion, 2, body);
  return knee;
}

void exact_part(const fs::path& source, int draws) {
  fmt::print(
      "| fit without noise and prior | free | numbers | singular values above 1e-3 | fits that "
      "explain the rows (from the scene's numbers) | their greatest error in that subspace, prior "
      "sd | of all numbers | steps | not converged |\n|---|---|---|---|---|---|---|---|---|\n");
  print_exact("Wismans-type, strains", spring_knee(source), full_plan(), 1, draws);
  print_exact("the same, strains and stiffnesses", spring_knee(source, true), full_plan(), 1,
              draws);
  print_exact("the same, insertions too", spring_knee(source, true, true), full_plan(), 0.3, draws);
  TestPlan few = main_plan();
  few.flexions = {0, 90};
  print_exact("the same by 16 loaded displacements at 0 and 90 degrees and what comes unloaded",
              spring_knee(source, true), few, 0.5, draws);
  fmt::print("\n");
}

void spring_part(const fs::path& source, int draws) {
  print_head();
  const StudyKnee strains = spring_knee(source);
  DrawPlan plan = plan_of(full_plan(), draws);
  const Draws ours = draw_and_fit(strains, strains, plan);
  print_row("Wismans-type, strains", ours);
  print_row("the same, loaded displacements only",
            draw_and_fit(strains, strains, plan_of(main_plan(), draws)));
  const StudyKnee stiff = spring_knee(source, true);
  print_row("strains and stiffnesses", draw_and_fit(stiff, stiff, plan));
  print_row("the same, loaded displacements only",
            draw_and_fit(stiff, stiff, plan_of(main_plan(), draws)));
  const StudyKnee moved = spring_knee(source, true, true);
  print_row("insertions too",
            draw_and_fit(moved, moved, plan_of(full_plan(), std::max(1, draws / 10))));
  fmt::print("\n");
  plan.draws = 3;
  plan.by_differences = true;
  const Draws outside = draw_and_fit(strains, strains, plan);
  fmt::print(
      "The first fit by central differences of knees that are built anew, as from outside the "
      "program: {:.3g} s, {:.0f} "
      "times as long.\n\n",
      1e-3 * median(all_of(outside, milliseconds)),
      median(all_of(outside, milliseconds)) / median(all_of(ours, milliseconds)));
}

TestPlan phantom_plan() {
  TestPlan plan = full_plan();
  plan.flexions = {0, 15, 30, 45, 60, 90};
  plan.drawer = 60;
  plan.varus = 5;
  plan.internal = 2;
  return plan;
}

StudyKnee patch_knee(const fs::path& file) {
  StudyKnee knee = study_knee(file);
  free_bundle_strains(knee, 0.02);
  return knee;
}

void phantom_part(const fs::path& source, int draws) {
  print_head();
  const StudyKnee knee = patch_knee(source / "data/phantom/knee.toml");
  DrawPlan plan = plan_of(phantom_plan(), draws);
  print_row("phantom on patches, strains", draw_and_fit(knee, knee, plan));
  const Starts starts = fit_from_starts(knee, plan, 20);
  fmt::print(
      "\nOf {} fits of one set of these measurements from starts drawn from the prior {} end at "
      "the same least (½ χ² within "
      "1e-6, numbers within {:.1e} prior sd); the worst of the others stops {:.2g} above it.\n\n",
      starts.starts, starts.same, starts.distance, starts.same == starts.starts ? 0 : starts.next);
}

/// Elastic layers of 3 mm, 10 N/mm², in place of rigid contacts.
Scene layered(Scene scene) {
  for (SurfaceDescription& surface : scene.surfaces) surface.elastic = ElasticSurface{10, 0.45, 3};
  for (ContactDescription& contact : scene.contacts) contact.layer = LayerOptions{};
  return scene;
}

void lenhart_part(const fs::path& source, int draws) {
  const fs::path file = source / "../shared/specimens/lenhart2015/knee.toml";
  if (!fs::exists(file)) {
    fmt::print("Lenhart's knee is not here.\n\n");
    return;
  }
  print_head();
  StudyKnee knee = patch_knee(file);
  const DrawPlan plan = plan_of(phantom_plan(), draws);
  print_row("Lenhart, rigid, strains of bundles", draw_and_fit(knee, knee, plan));
  StudyKnee soft = knee;
  soft.scene = layered(knee.scene);
  DrawPlan few = plan;
  few.draws = std::max(1, draws / 10);
  print_row("Lenhart, layered", draw_and_fit(soft, soft, few));
  print_row("wrong: layered truth, fitted rigid", draw_and_fit(knee, soft, few));
  fmt::print("\n");
}

void wrong_part(const fs::path& source, int draws) {
  print_head();
  const StudyKnee knee = spring_knee(source);
  const DrawPlan plan = plan_of(full_plan(), draws);
  print_row("right model", draw_and_fit(knee, knee, plan));
  const auto moved = [](Scene& scene, unsigned draw) {
    std::mt19937_64 engine(1000 + draw);
    std::normal_distribution<double> normal;
    for (LigamentDescription& ligament : scene.ligaments)
      for (Attachment& end : ligament.ends) {
        Eigen::Vector3d way(normal(engine), normal(engine), normal(engine));
        end.at += 2 * way.normalized();
      }
  };
  print_row("wrong: insertions 2 mm off", draw_and_fit(knee, knee, plan, moved));
  fmt::print("\n");
}

int run(int argc, char** argv) {
  CLI::App program("What fits to made measurements give back of a known truth");
  std::string source;
  std::vector<std::string> parts = {"exact", "spring", "phantom", "lenhart", "wrong"};
  int draws = 200;
  program.add_option("SOURCE", source, "folder of the project")->required();
  program.add_option("--parts", parts, "which tables")->delimiter(',');
  program.add_option(
      "--draws", draws,
      "of truth and noise; patches half, those without noise a fifth, layers and insertions a "
      "tenth");
  CLI11_PARSE(program, argc, argv);
  const auto wanted = [&](const char* part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  if (wanted("exact")) exact_part(source, std::max(1, draws / 5));
  if (wanted("spring")) spring_part(source, draws);
  if (wanted("wrong")) wrong_part(source, draws);
  if (wanted("phantom")) phantom_part(source, std::max(1, draws / 2));
  if (wanted("lenhart")) lenhart_part(source, std::max(1, draws / 2));
  return 0;
}

}  // namespace
}  // namespace condyle::calibration_study

int main(int argc, char** argv) { return condyle::calibration_study::run(argc, argv); }
