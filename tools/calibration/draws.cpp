#include "calibration/draws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "condyle/calibration/knee_fit.h"
#include "condyle/calibration/multi_start.h"
#include "condyle/calibration/predictions.h"
#include "condyle/input_error.h"

namespace condyle::calibration_study {
namespace {

using Eigen::VectorXd;

VectorXd normal_numbers(std::mt19937_64& engine, Eigen::Index count) {
  std::normal_distribution<double> normal;
  VectorXd numbers(count);
  for (double& number : numbers) number = normal(engine);
  return numbers;
}

VectorXd prior_sds(const std::vector<FreeParameter>& parameters) {
  VectorXd sds(static_cast<Eigen::Index>(parameters.size()));
  for (Eigen::Index j = 0; j < sds.size(); ++j) sds[j] = parameters[j].prior_sd;
  return sds;
}

VectorXd deviations(const MeasurementTable& table) {
  VectorXd sd(static_cast<Eigen::Index>(table.rows.size()));
  for (Eigen::Index i = 0; i < sd.size(); ++i) sd[i] = table.rows[i].sd;
  return sd;
}

double rms(const VectorXd& numbers) {
  return std::sqrt(numbers.squaredNorm() / static_cast<double>(numbers.size()));
}

/// Fitted and unseen tests of one knee.
struct Tests {
  MeasurementTable table;
  Predictions predictions;
  Tests(const StudyKnee& knee, const TestPlan& plan, const std::vector<FreeParameter>& parameters)
      : Tests(knee, knee.scene, plan, parameters) {}
  Tests(const StudyKnee& knee,
        const Scene& scene,
        const TestPlan& plan,
        const std::vector<FreeParameter>& parameters)
      : table(planned_table(knee, plan)), predictions(scene, knee.surfaces, table, parameters) {}
  bool at(const VectorXd& theta, VectorXd& y) {
    predictions.reset();
    return predictions.evaluate(theta, y, nullptr);
  }
};

/// ∂y/∂θ by central differences of knees that are built anew, their poses reached from the start: what a
/// fit from outside the program does.
class FromOutside {
 public:
  FromOutside(const StudyKnee& knee,
              const TestPlan& plan,
              const std::vector<FreeParameter>& parameters)
      : knee_(knee), plan_(plan), parameters_(parameters) {}

  bool operator()(const VectorXd& theta, VectorXd& y, Eigen::MatrixXd* J) const {
    if (!solve(theta, y)) return false;
    if (J == nullptr) return true;
    J->resize(y.size(), theta.size());
    for (Eigen::Index j = 0; j < theta.size(); ++j) {
      const double h = 1e-4 * parameters_[j].prior_sd;
      VectorXd above = theta, below = theta, y_above, y_below;
      above[j] += h;
      below[j] -= h;
      if (!solve(above, y_above) || !solve(below, y_below)) return false;
      J->col(j) = (y_above - y_below) / (2 * h);
    }
    return true;
  }

 private:
  bool solve(const VectorXd& theta, VectorXd& y) const {
    const Scene scene =
        scene_with(knee_.scene, parameters_, {theta.data(), theta.data() + theta.size()});
    try {
      Predictions predictions(scene, knee_.surfaces, planned_table(knee_, plan_), parameters_);
      return predictions.evaluate(VectorXd::Zero(theta.size()), y, nullptr);
    } catch (const InputError&) {
      return false;
    }
  }
  const StudyKnee& knee_;
  const TestPlan& plan_;
  const std::vector<FreeParameter>& parameters_;
};

/// A truth that has poses in all tests, and what is measured of it.
struct Truth {
  VectorXd theta, fitted, unseen;
};

std::optional<Truth> find_truth(Tests& fitted, Tests& unseen, const VectorXd& theta) {
  Truth truth{theta, {}, {}};
  if (!fitted.at(theta, truth.fitted) || !unseen.at(theta, truth.unseen)) return {};
  if (!truth.fitted.allFinite() || !truth.unseen.allFinite()) return {};
  return truth;
}

void judge_unseen(Tests& unseen, const Truth& truth, DrawOutcome& outcome) {
  const VectorXd sd = deviations(unseen.table);
  VectorXd before, after;
  Eigen::MatrixXd J;
  unseen.predictions.reset();
  const bool known =
      unseen.predictions.evaluate(VectorXd::Zero(truth.theta.size()), before, nullptr);
  if (!known || !unseen.predictions.evaluate(outcome.fit.theta, after, &J)) {
    outcome.unseen_before = outcome.unseen_after = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  outcome.unseen_before = rms((before - truth.unseen).cwiseQuotient(sd));
  outcome.unseen_after = rms((after - truth.unseen).cwiseQuotient(sd));
  const VectorXd variance = (J * outcome.known.covariance).cwiseProduct(J).rowwise().sum();
  int covered = 0;
  for (Eigen::Index i = 0; i < sd.size(); ++i)
    covered +=
        std::abs(after[i] - truth.unseen[i]) <= 1.96 * std::sqrt(variance[i]) + 1e-12 ? 1 : 0;
  outcome.covered_unseen = static_cast<double>(covered) / static_cast<double>(sd.size());
}

/// Of a truth without noise every start but those that end in another least comes to a cost of nothing.
/// Starts have random numbers of their own, so that which truths follow does not hang on how many were tried.
void fit_truth(const LeastSquaresProblem& problem,
               const VectorXd& prior,
               const DrawPlan& plan,
               unsigned draw,
               DrawOutcome& outcome) {
  std::mt19937_64 engine(plan.seed + 1000003 * (draw + 1));
  LeastSquaresResult& best = outcome.fit;
  best = solve_least_squares(problem, VectorXd::Zero(prior.size()));
  outcome.starts = 1;
  const auto explains = [](const LeastSquaresResult& fit) {
    return fit.y.size() > 0 && fit.cost <= kNoCost;
  };
  for (; outcome.starts < plan.starts && !explains(best); ++outcome.starts) {
    const VectorXd from = plan.truth * prior.cwiseProduct(normal_numbers(engine, prior.size()));
    LeastSquaresResult other = solve_least_squares(problem, from);
    if (other.y.size() > 0 && (best.y.size() == 0 || other.cost < best.cost))
      best = std::move(other);
  }
}

/// The knee that is measured: tests of it, anew where each draw disturbs its scene.
class TrueKnee {
 public:
  TrueKnee(const StudyKnee& knee,
           const DrawPlan& plan,
           const std::vector<FreeParameter>& parameters,
           const std::function<void(Scene&, unsigned draw)>& disturb)
      : knee_(knee), plan_(plan), parameters_(parameters), disturb_(disturb) {
    build(knee.scene);
  }

  /// Nothing where some test has no pose.
  std::optional<Truth> at(const VectorXd& theta, unsigned draw) {
    try {
      if (disturb_) {
        Scene scene = knee_.scene;
        disturb_(scene, draw);
        build(scene);
      }
      return find_truth(*fitted_, *unseen_, theta);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

 private:
  void build(const Scene& scene) {
    fitted_ = std::make_unique<Tests>(knee_, scene, plan_.fitted, parameters_);
    unseen_ = std::make_unique<Tests>(knee_, scene, plan_.unseen, parameters_);
  }
  const StudyKnee& knee_;
  const DrawPlan& plan_;
  const std::vector<FreeParameter>& parameters_;
  const std::function<void(Scene&, unsigned draw)>& disturb_;
  std::unique_ptr<Tests> fitted_, unseen_;
};

LeastSquaresProblem problem_of(const VectorXd& d, const VectorXd& sd, const VectorXd& prior) {
  LeastSquaresProblem problem;
  problem.d = d;
  problem.sd = sd;
  problem.prior_sd = prior;
  problem.prior_mean = VectorXd::Zero(prior.size());
  problem.lower = VectorXd::Constant(prior.size(), -1e300);
  problem.upper = -problem.lower;
  return problem;
}

/// Truths that may be drawn again before a plan is given up.
int most_skipped(const DrawPlan& plan) { return 3 * plan.draws + 20; }

}  // namespace

Draws draw_and_fit(const StudyKnee& model,
                   const StudyKnee& truth_knee,
                   const DrawPlan& plan,
                   const std::function<void(Scene&, unsigned draw)>& disturb) {
  Draws draws;
  const MeasurementTable table = planned_table(model, plan.fitted);
  draws.parameters = free_parameters(model.scene, model.meshes, table);
  draws.rows = table.rows.size();
  const VectorXd prior = prior_sds(draws.parameters), sd = deviations(table);
  Tests fitted(model, plan.fitted, draws.parameters), unseen(model, plan.unseen, draws.parameters);
  TrueKnee measured(truth_knee, plan, draws.parameters, disturb);
  std::mt19937_64 engine(plan.seed);
  for (unsigned draw = 0;
       static_cast<int>(draws.outcomes.size()) < plan.draws && draws.skipped <= most_skipped(plan);
       ++draw) {
    const VectorXd theta = plan.truth * prior.cwiseProduct(normal_numbers(engine, prior.size()));
    const VectorXd noise = plan.noise * sd.cwiseProduct(normal_numbers(engine, sd.size()));
    const std::optional<Truth> truth = measured.at(theta, draw);
    if (!truth) {
      ++draws.skipped;
      continue;
    }
    LeastSquaresProblem problem = problem_of(truth->fitted + noise, sd, plan.prior * prior);
    if (plan.by_differences) {
      problem.evaluate = FromOutside(model, plan.fitted, draws.parameters);
    } else {
      fitted.predictions.reset();
      problem.evaluate = [&](const VectorXd& at, VectorXd& y, Eigen::MatrixXd* J) {
        return fitted.predictions.evaluate(at, y, J);
      };
    }
    DrawOutcome outcome;
    outcome.truth = theta;
    fit_truth(problem, prior, plan, draw, outcome);
    draws.failed += outcome.fit.converged ? 0 : 1;
    outcome.known = identifiability(outcome.fit.J, sd.cwiseInverse(), problem.prior_sd,
                                    std::vector<bool>(draws.parameters.size(), false));
    outcome.reduced_chi_square =
        outcome.fit.chi_square / (static_cast<double>(draws.rows) - outcome.known.effective);
    judge_unseen(unseen, *truth, outcome);
    draws.outcomes.push_back(std::move(outcome));
  }
  return draws;
}

Starts fit_from_starts(const StudyKnee& knee, const DrawPlan& plan, int starts) {
  MeasurementTable table = planned_table(knee, plan.fitted);
  const std::vector<FreeParameter> parameters = free_parameters(knee.scene, knee.meshes, table);
  const VectorXd prior = prior_sds(parameters), sd = deviations(table);
  Tests truth(knee, plan.fitted, parameters);
  std::mt19937_64 engine(plan.seed);
  VectorXd y;
  for (int skipped = 0;
       !truth.at(plan.truth * prior.cwiseProduct(normal_numbers(engine, prior.size())), y);
       ++skipped)
    if (skipped > most_skipped(plan)) return {};
  y += plan.noise * sd.cwiseProduct(normal_numbers(engine, sd.size()));
  for (Eigen::Index i = 0; i < y.size(); ++i) table.rows[static_cast<std::size_t>(i)].value = y[i];
  KneeFit fit(knee.scene, knee.surfaces, table, parameters, 0);
  StudyProgress progress({});
  const std::vector<LeastSquaresResult> fits = fit_from_prior(
      fit.problem(), starts + 1, plan.seed, [](const VectorXd&, double) {}, progress);
  const LeastSquaresResult* best = &fits.front();
  for (const LeastSquaresResult& each : fits)
    if (each.cost < best->cost) best = &each;
  Starts found;
  for (const LeastSquaresResult& each : fits) {
    ++found.starts;
    found.next = std::max(found.next, each.cost - best->cost);
    if (each.cost > best->cost + 1e-6) continue;
    ++found.same;
    found.distance = std::max(
        found.distance, (each.theta - best->theta).cwiseQuotient(prior).lpNorm<Eigen::Infinity>());
  }
  return found;
}

Coverage coverage_of(const Draws& draws) {
  const Eigen::Index count = static_cast<Eigen::Index>(draws.parameters.size());
  VectorXd held = VectorXd::Zero(count);
  for (const DrawOutcome& outcome : draws.outcomes)
    for (Eigen::Index j = 0; j < count; ++j)
      held[j] +=
          std::abs(outcome.fit.theta[j] - outcome.truth[j]) <= 1.96 * outcome.known.sd[j] ? 1 : 0;
  held /= static_cast<double>(draws.outcomes.size());
  return {held.mean(), held.minCoeff(), held.maxCoeff()};
}

}  // namespace condyle::calibration_study
