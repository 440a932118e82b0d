#pragma once

/// Ligaments and loads of a model at θ, and how derivatives by its own numbers become derivatives
/// by θ.

#include <Eigen/Core>

#include <string>
#include <vector>

#include "condyle/calibration/free_parameter.h"

namespace condyle {

/// Workspace of one thread. The slack length follows from strain and insertions in any order: of an
/// insertion whose strain is held the length at the start pose over the slack length stays.
class ChangedKnee {
 public:
  /// Refers to the model. Throws std::invalid_argument for numbers that are the model's own, and for
  /// the logarithm of a number that may be 0.
  ChangedKnee(const Model& model, const std::vector<FreeParameter>& parameters);

  /// False where no knee has such numbers (`objection`): a slack length, a stiffness that is not
  /// positive. What `parameters` then says means nothing until the next θ.
  bool set(const Eigen::VectorXd& theta);
  [[nodiscard]] const std::string& objection() const { return objection_; }

  [[nodiscard]] const Parameters& parameters() const { return changed_; }
  /// By loads: their scales are so many times as great.
  [[nodiscard]] const std::vector<double>& load_factors() const { return factors_; }

  /// By which derivatives are taken.
  [[nodiscard]] const std::vector<ModelParameter>& numbers() const { return numbers_; }

  /// θ_j moves that number at the rate `by`; a load's scale at `by` times its scale before factors.
  struct Link {
    std::size_t number, parameter;
    double by;
  };
  [[nodiscard]] const std::vector<Link>& links() const { return links_; }

 private:
  struct Move {
    std::size_t number, parameter;
    double factor;
    bool logarithmic;
  };
  [[nodiscard]] double change_of(const Move& move, double number, double theta) const;
  [[nodiscard]] double rate_of(const Move& move, double number, double theta) const;
  void set_laws(const Eigen::VectorXd& theta);
  void set_insertions(const Eigen::VectorXd& theta);
  void set_loads(const Eigen::VectorXd& theta);
  bool check();

  const Model& model_;
  Parameters nominal_, changed_;
  std::vector<ModelParameter> numbers_;
  std::vector<Move> moves_;
  std::vector<Link> links_;                ///< as moves_
  std::vector<std::size_t> elements_;      ///< that change
  std::vector<double> start_length_;       ///< nominal, by elements that change [mm]
  std::vector<bool> moved_, strain_held_;  ///< by all elements: which ends move, and how
  std::vector<double> factors_;
  std::string objection_;
};

}  // namespace condyle
